//! Following a stable branch while the inputs change, and falling to the next one past a fold.

use serde::{Deserialize, Serialize};

use super::chain::Chain;
use super::inputs::Inputs;
use super::potential::{Potential, Workspace};
use super::rules::PairRules;
use super::settings::Settings;
use super::source::Source;
use crate::magnetics::Assembly;
use crate::numerics::eigenvalue::{self, Search};
use crate::numerics::trust_region::{self, Objective, Region, dual_norm, norm, spread};

/// A Newton correction that shrinks by less than this from step to step is not trusted to stay on its branch.
const CONTRACTION: f64 = 0.5;

/// The same for steps with an earlier factorisation, which are only worth while if they contract better.
const CHORD_CONTRACTION: f64 = 0.1;

/// So close to the root (in the chain's unit) the Hessian of the next shape does for all that follow.
const NEARLY: f64 = 1e-4;

/// The look at the margin after every solve: enough to see a fold come.
const GLANCE: Search = Search { vectors: 6, settled: 0.03 };

/// The look at the margin when it is asked for.
const THOROUGH: Search = Search { vectors: 120, settled: 1e-6 };

/// Part of every direction that is mixed into the last softest one before it is looked for again.
const EVERY_DIRECTION: f64 = 0.3;

/// Largest first step from the straight shape to the one that the internal forces alone leave: there is no
/// branch to lose yet.
const SETTLING: f64 = 4.0;

/// Newton corrections at most for one part of an input change.
const CORRECTIONS: u32 = 12;

/// How often the rules may change at a solved shape: a distance at which two rules meet could swap them for ever.
const RULE_CHOICES: u32 = 3;

/// Where rounding, not Newton's method, decides the length of a step (in the chain's unit).
const ROUNDING: f64 = 1e-9;

/// First radius of the trust region past a fold, in the chain's unit: small, so that the fall is followed.
const FALL_RADIUS: f64 = 0.1;

/// A fall further than this (in the chain's unit) is a snap, a shorter one a bend in the branch.
const SNAP: f64 = 0.25;

/// How much further a fall is tried where it ends on a shape of neutral stability, neither held nor let go.
const FURTHER: f64 = 16.0;

/// Parts of one input change at most.
const PARTS: u32 = 2000;

/// The shape, and the inputs at which it is in equilibrium.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub(super) struct Branch {
    pub(super) unknowns: Vec<f64>,
    pub(super) inputs: Option<Inputs>,
    /// Direction of least stiffness, the first guess for the next search.
    pub(super) softest: Vec<f64>,
}

impl Branch {
    pub(super) fn new(chain: &Chain) -> Self {
        let mut softest = vec![0.0; chain.freedoms()];
        spread(&chain.metric, &mut softest, 1.0);
        Self { unknowns: vec![0.0; chain.freedoms()], inputs: None, softest }
    }
}

/// What a solve did.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Report {
    /// Whether an equilibrium was found at the inputs asked for.
    pub solved: bool,
    /// Newton iterations.
    pub iterations: u32,
    /// Dual norm of the gradient, relative to turning one element by a radian.
    pub residual: f64,
    /// Upper bound, close near a fold, of the smallest eigenvalue of the Hessian relative to the elastic
    /// energy; see [`super::Equilibrium::margin`].
    pub margin: f64,
    /// Whether the equilibrium is stable; `None` where the forces have no potential to tell.
    pub stable: Option<bool>,
    /// Jumps to another branch in this solve.
    pub snaps: u32,
    /// Potential energy, J.
    pub energy: f64,
}

/// The parts that do not change from solve to solve.
#[derive(Debug, Clone, Copy)]
pub(super) struct Scene<'a> {
    pub(super) chain: &'a Chain,
    pub(super) settings: &'a Settings,
    pub(super) magnet: Option<&'a Assembly>,
}

impl Scene<'_> {
    /// Moves `branch` to the equilibrium at `target`; on failure the branch stays where it was.
    pub(super) fn follow(
        &self,
        branch: &mut Branch,
        target: &Inputs,
        work: &mut Workspace,
        rules: &mut PairRules,
    ) -> Report {
        let mut walk = Walk { scene: *self, work, rules, report: Report::start() };
        let mut unknowns = branch.unknowns.clone();
        let end = walk.run(branch.inputs.as_ref(), target, &mut unknowns);
        if end != End::Lost {
            walk.report.solved = true;
            branch.unknowns.copy_from_slice(&unknowns);
            branch.inputs = Some(target.clone());
        }
        match end {
            End::Held => walk.judge(target, &mut branch.softest),
            End::Neutral => walk.report.stable = Some(false),
            End::Lost => {}
        }
        // Else the factorisation is that of a shape on the way.
        walk.work.factored &= end == End::Held;
        walk.report
    }
}

impl Report {
    pub(super) fn start() -> Self {
        Self {
            solved: false,
            iterations: 0,
            residual: f64::INFINITY,
            margin: 0.0,
            stable: None,
            snaps: 0,
            energy: 0.0,
        }
    }
}

/// How a search for an equilibrium ended.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum End {
    /// At a shape that Newton's method confirms.
    Held,
    /// At a shape whose Hessian is singular to rounding, as where a bent manipulator may turn freely about the axis of
    /// an antiparallel field: an equilibrium that nothing holds.
    Neutral,
    /// Nowhere.
    Lost,
}

/// One solve under way.
struct Walk<'a> {
    scene: Scene<'a>,
    work: &'a mut Workspace,
    rules: &'a mut PairRules,
    report: Report,
}

impl Walk<'_> {
    fn run(&mut self, from: Option<&Inputs>, target: &Inputs, unknowns: &mut Vec<f64>) -> End {
        let start = if let Some(inputs) = from {
            inputs.clone()
        } else {
            // The unloaded shape: its internal forces alone, found from straight.
            let unloaded = target.without_loads();
            if self.correct(&unloaded, unknowns, SETTLING).is_none()
                && self.fall(&unloaded, unknowns) != End::Held
            {
                return End::Lost;
            }
            // Settling under its own forces is no jump.
            self.report.snaps = 0;
            unloaded
        };
        let (mut done, mut part, mut falling) = (0.0, 1.0, false);
        for _ in 0..PARTS {
            let next = f64::min(1.0, done + part);
            let inputs = if next >= 1.0 { target.clone() } else { start.between(target, next) };
            let mut trial = unknowns.clone();
            let settings = self.scene.settings;
            if !falling && self.correct(&inputs, &mut trial, settings.follow_step).is_some() {
                *unknowns = trial;
            } else if !falling && part > settings.smallest_part {
                part *= 0.5;
                continue;
            } else {
                match self.fall(&inputs, unknowns) {
                    End::Held => falling = false,
                    End::Neutral if next < 1.0 => {
                        falling = true;
                        part *= FURTHER;
                        continue;
                    }
                    End::Neutral if self.report.residual <= ROUNDING => return End::Neutral,
                    _ => return End::Lost,
                }
            }
            done = next;
            part *= 2.0;
            if done >= 1.0 {
                return End::Held;
            }
        }
        End::Lost
    }

    fn potential<'b>(&'b mut self, inputs: &'b Inputs) -> Potential<'b> {
        Potential {
            chain: self.scene.chain,
            settings: self.scene.settings,
            inputs,
            field: Source::external(self.scene.magnet, inputs),
            rules: self.rules,
            work: self.work,
        }
    }

    /// Newton's method without safeguards, abandoned as soon as it does not behave as it does near a root.
    ///
    /// Steps with the last factorisation come first and last: the Hessian is made anew once on the way.
    fn correct(&mut self, inputs: &Inputs, unknowns: &mut [f64], reach: f64) -> Option<()> {
        let Scene { chain, settings, .. } = self.scene;
        let unit = chain.unit();
        self.choose_rules(inputs, unknowns);
        if self.work.factored {
            self.chord(inputs, unknowns, settings.follow_step, NEARLY);
        }
        let mut step = vec![0.0; unknowns.len()];
        let first = reach / CONTRACTION;
        let (mut previous, mut choices) = (first, RULE_CHOICES);
        for _ in 0..CORRECTIONS {
            let mut potential = self.potential(inputs);
            let energy = potential.linearise(unknowns)?;
            let residual = dual_norm(potential.metric(), potential.gradient()) / unit;
            if !potential.factorise(0.0) {
                return None;
            }
            let mut settled = residual <= settings.tolerance;
            (self.report.residual, self.report.energy) = (residual, energy);
            if !settled {
                let length = self.step(inputs, &mut step);
                self.report.iterations += 1;
                if length <= CONTRACTION * previous {
                    apply(unknowns, &step);
                    settled =
                        length <= NEARLY && self.chord(inputs, unknowns, CHORD_CONTRACTION * length, 0.0);
                    previous = length;
                } else if length < ROUNDING {
                    settled = true;
                } else {
                    return None;
                }
            }
            if settled {
                // The rules must be those of the solved shape, or the answer would depend on the way to it.
                if choices == 0 || !self.choose_rules(inputs, unknowns) {
                    return Some(());
                }
                (previous, choices) = (first, choices - 1);
            }
        }
        None
    }

    /// The step from the last gradient with the last factorisation; its length in the chain's unit.
    fn step(&mut self, inputs: &Inputs, step: &mut [f64]) -> f64 {
        let metric = &self.scene.chain.metric;
        let mut potential = self.potential(inputs);
        for (s, g) in step.iter_mut().zip(potential.gradient()) {
            *s = -g;
        }
        potential.solve(step);
        norm(metric, step) / self.scene.chain.unit()
    }

    /// Steps with the last factorisation, as long as they contract well: cheap, for small changes.
    ///
    /// The first may be as long as `longest`; they end when what is left should be within `until`. Whether the
    /// shape is solved, and evaluated.
    fn chord(&mut self, inputs: &Inputs, unknowns: &mut [f64], mut longest: f64, until: f64) -> bool {
        let Scene { chain, settings, .. } = self.scene;
        let mut step = vec![0.0; unknowns.len()];
        for _ in 0..CORRECTIONS {
            let mut potential = self.potential(inputs);
            let Some(energy) = potential.slope(unknowns) else { return false };
            let residual = dual_norm(potential.metric(), potential.gradient()) / chain.unit();
            (self.report.residual, self.report.energy) = (residual, energy);
            if residual <= settings.tolerance {
                return true;
            }
            let length = self.step(inputs, &mut step);
            if length.is_nan() || length > longest {
                return length < ROUNDING;
            }
            apply(unknowns, &step);
            self.report.iterations += 1;
            longest = CHORD_CONTRACTION * length;
            if longest <= until {
                return false;
            }
        }
        false
    }

    /// Downhill to the next minimum; counts a snap if it is far.
    fn fall(&mut self, inputs: &Inputs, unknowns: &mut Vec<f64>) -> End {
        if !self.potential(inputs).conservative() {
            return End::Lost;
        }
        let Scene { chain, settings, .. } = self.scene;
        let unit = chain.unit();
        self.choose_rules(inputs, unknowns);
        let region = Region {
            radius: FALL_RADIUS * unit,
            largest: unit,
            tolerance: settings.tolerance.max(ROUNDING) * unit,
            iterations: settings.iterations,
        };
        let mut fallen = unknowns.clone();
        let minimum = trust_region::minimise(&mut self.potential(inputs), &mut fallen, &region);
        self.report.iterations += minimum.iterations;
        let residual = minimum.residual / unit;
        self.report.residual = residual;
        if !minimum.converged {
            return if residual <= NEARLY { End::Neutral } else { End::Lost };
        }
        let mut corrected = fallen.clone();
        let end = if self.correct(inputs, &mut corrected, settings.follow_step).is_some() {
            fallen = corrected;
            End::Held
        } else {
            self.report.residual = residual;
            End::Neutral
        };
        let moved: Vec<f64> = fallen.iter().zip(unknowns.iter()).map(|(a, b)| a - b).collect();
        if norm(&chain.metric, &moved) / unit > SNAP {
            self.report.snaps += 1;
        }
        *unknowns = fallen;
        end
    }

    /// Whether any rule is another one than before.
    fn choose_rules(&mut self, inputs: &Inputs, unknowns: &[f64]) -> bool {
        self.work.place(self.scene.chain, &inputs.base, unknowns);
        self.rules.choose(self.scene.chain, &self.work.nodes)
    }

    /// An upper bound of the margin at the shape where the last correction has factorised.
    fn judge(&mut self, inputs: &Inputs, softest: &mut [f64]) {
        let metric = &self.scene.chain.metric;
        // A little of every direction, or a mode that the last one is orthogonal to would go unseen.
        spread(metric, softest, EVERY_DIRECTION);
        let mut potential = self.potential(inputs);
        if !potential.has_verdict() {
            return;
        }
        let margin = eigenvalue::smallest(metric, 0.0, softest, GLANCE, |x| potential.solve_symmetric(x));
        if margin.is_finite() {
            // The correction has found the Hessian positive definite, if only by rounding.
            let held = margin > ROUNDING;
            (self.report.margin, self.report.stable) = (if held { margin } else { 0.0 }, Some(held));
        } else {
            softest.fill(0.0);
        }
    }
}

/// Adds a step to the unknowns.
fn apply(unknowns: &mut [f64], step: &[f64]) {
    for (x, s) in unknowns.iter_mut().zip(step) {
        *x += s;
    }
}

/// The margin at the shape and with the factorisation of `potential`, to about nine digits.
pub(super) fn measure(potential: &mut Potential<'_>) -> f64 {
    let metric = &potential.chain.metric;
    let mut softest = vec![0.0; metric.len()];
    spread(metric, &mut softest, 1.0);
    eigenvalue::smallest(metric, 0.0, &mut softest, THOROUGH, |x| potential.solve_symmetric(x))
}
