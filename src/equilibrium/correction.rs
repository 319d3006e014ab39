//! Newton's corrections of a shape, and what their factorisation tells about its stability.

use super::chain::Chain;
use super::deadline::Deadline;
use super::inputs::Inputs;
use super::outcome::Outcome;
use super::pair_quadrature::PairQuadrature;
use super::potential::{Potential, THOROUGH};
use super::settings::Settings;
use super::terms::Terms;
use super::workspace::Workspace;
use crate::magnetics::Assembly;
use crate::numerics::eigenvalue::{Lanczos, Search, inner};
use crate::numerics::trust_region::{Objective, dual_norm, norm, spread};

/// A Newton correction that shrinks by less than this from step to step is not trusted to stay on its branch.
const CONTRACTION: f64 = 0.5;

/// The same for steps with an earlier factorisation, which are only worth while if they contract better.
const CHORD_CONTRACTION: f64 = 0.1;

/// So close to the root (in the chain's unit) the Hessian of the next shape does for all that follow.
pub(super) const NEARLY: f64 = 1e-4;

/// How far loads and shape may drift from the last factorisation, relative to the margin, while it tells about stability.
pub(super) const KEPT: f64 = 0.1;

/// The look at the margin after every solve: enough to see a fold come.
pub(super) const GLANCE: Search = Search { vectors: 6, settled: 0.03 };

/// Part of every direction that is mixed into the last softest one before it is looked for again.
const EVERY_DIRECTION: f64 = 0.3;

/// Newton corrections at most for one part of an input change.
const CORRECTIONS: usize = 12;

/// How often the rules may change at a solved shape: a distance at which two rules meet could swap them for ever.
const RULE_CHOICES: u32 = 3;

/// Where rounding, not Newton's method, decides the length of a step (in the chain's unit).
pub(super) const ROUNDING: f64 = 1e-9;

/// Margin up to which nothing holds a shape: what the tolerance leaves open of it.
const FREE: f64 = 1e-7;

/// Margin below which a shape is looked at again with its own Hessian.
const DOUBTFUL: f64 = 1e-4;

/// What a solve did.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Report {
    /// How it ended; see [`Report::solved`].
    pub outcome: Outcome,
    /// How far along the change of the inputs it got, from 0 to 1; 1 where it is solved.
    pub progress: f64,
    /// Newton iterations.
    pub iterations: u32,
    /// Dual norm of the gradient, relative to turning one element by a radian.
    pub residual: f64,
    /// Upper bound, close near a fold, of the smallest eigenvalue of the Hessian relative to the elastic
    /// energy; see [`super::Equilibrium::margin`]. Along small steps it is that of the last factorisation, which the
    /// present one undercuts or exceeds by some percent at most.
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

impl<'a> Scene<'a> {
    /// The potential at `inputs` with the rules chosen last.
    pub(super) fn potential(
        &self,
        inputs: &'a Inputs,
        rules: &'a PairQuadrature,
        work: &'a mut Workspace,
    ) -> Potential<'a> {
        let Self { chain, settings, magnet } = *self;
        let mut terms = Terms::new(chain, settings, magnet, inputs, rules);
        terms.magnet = terms.magnet.seen_by(chain, settings.pair_accuracy);
        Potential { chain, settings, inputs, terms, rules, work }
    }
}

impl Report {
    /// Whether an equilibrium was found at the inputs asked for.
    #[must_use]
    pub fn solved(&self) -> bool {
        self.outcome.is_solved()
    }

    pub(crate) fn start() -> Self {
        Self {
            outcome: Outcome::BranchEnds,
            progress: 0.0,
            iterations: 0,
            residual: f64::INFINITY,
            margin: 0.0,
            stable: None,
            snaps: 0,
            energy: 0.0,
        }
    }
}

/// What a solve overwrites, kept so that a step along the branch allocates nothing.
#[derive(Debug, Clone)]
pub(super) struct Scratch {
    pub(super) last: Vec<f64>,
    pub(super) trial: Vec<f64>,
    /// The way between two shapes, and back.
    pub(super) between: Vec<f64>,
    /// Steps with one factorisation.
    steps: Vec<Vec<f64>>,
    lanczos: Lanczos,
}

impl Scratch {
    pub(super) fn new(chain: &Chain) -> Self {
        let zeros = vec![0.0; chain.freedoms()];
        Self {
            last: zeros.clone(),
            trial: zeros.clone(),
            between: zeros.clone(),
            steps: vec![zeros; CORRECTIONS],
            lanczos: Lanczos::default(),
        }
    }
}

/// How a search for an equilibrium ended.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum End {
    /// At a shape so close to the last factorisation that what it told about stability still holds.
    Kept,
    /// At a shape that Newton's method confirms.
    Held,
    /// At a shape whose Hessian is singular to rounding, as where a bent manipulator may turn freely about the axis of
    /// an antiparallel field: an equilibrium that nothing holds.
    Neutral,
    /// Nowhere.
    Lost,
}

/// One solve under way.
pub(super) struct Walk<'a> {
    pub(super) scene: Scene<'a>,
    pub(super) work: &'a mut Workspace,
    pub(super) rules: &'a mut PairQuadrature,
    pub(super) scratch: &'a mut Scratch,
    pub(super) report: Report,
    pub(super) deadline: &'a Deadline,
    /// The last equilibrium on the way to the target.
    pub(super) reached: Option<(Inputs, Vec<f64>)>,
    /// How far loads and shape may drift from the last factorisation.
    pub(super) reach: f64,
}

impl Walk<'_> {
    pub(super) fn potential<'b>(&'b mut self, inputs: &'b Inputs) -> Potential<'b> {
        self.scene.potential(inputs, self.rules, self.work)
    }

    /// Newton's method without safeguards, abandoned as soon as it does not behave as it does near a root.
    ///
    /// Steps with the last factorisation come first, and do alone while that still holds; else the Hessian is made anew
    /// once on the way.
    pub(super) fn correct(&mut self, inputs: &Inputs, unknowns: &mut [f64], reach: f64) -> Option<End> {
        let Scene { chain, settings, .. } = self.scene;
        let unit = chain.radian_norm();
        self.choose_rules(inputs, unknowns);
        for _ in 0..RULE_CHOICES {
            if self.work.factorisation.is_none()
                || !self.chord(inputs, unknowns, reach.min(settings.follow_step), NEARLY)
            {
                break;
            }
            if !self.choose_rules_here() {
                return Some(End::Kept);
            }
        }
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
                let length = self.step(inputs, 0);
                self.report.iterations += 1;
                if length <= CONTRACTION * previous {
                    apply(unknowns, &self.scratch.steps[0]);
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
                if choices == 0 || !self.choose_rules_here() {
                    // Without a potential a root may be an unstable shape.
                    return self.potential(inputs).is_stable().then_some(End::Held);
                }
                (previous, choices) = (first, choices - 1);
            }
        }
        None
    }

    /// The step from the last gradient with the last factorisation, corrected by what the last `done` steps of this kind
    /// have shown; its length in the chain's unit.
    ///
    /// Broyden's method in its form without matrices, in the metric of the elastic energy (C. T. Kelley, Iterative Methods
    /// for Linear and Nonlinear Equations, SIAM 1995, section 7.3).
    fn step(&mut self, inputs: &Inputs, done: usize) -> f64 {
        let metric = &self.scene.chain.metric;
        let mut steps = std::mem::take(&mut self.scratch.steps);
        let (earlier, rest) = steps.split_at_mut(done);
        let step = &mut rest[0];
        let mut potential = self.potential(inputs);
        for (s, g) in step.iter_mut().zip(potential.gradient()) {
            *s = -g;
        }
        potential.solve(step);
        let along = |s: &[f64], z: &[f64]| inner(metric, s, z) / inner(metric, s, s);
        for pair in earlier.windows(2) {
            let factor = along(&pair[0], step);
            step.iter_mut().zip(&pair[1]).for_each(|(z, s)| *z += factor * s);
        }
        if let Some(last) = earlier.last() {
            let stretch = 1.0 / (1.0 - along(last, step));
            for z in &mut *step {
                *z *= stretch;
            }
        }
        let length = norm(metric, step) / self.scene.chain.radian_norm();
        self.scratch.steps = steps;
        length
    }

    /// Steps with the last factorisation, as long as they contract well: cheap, for small changes.
    ///
    /// The first may be as long as `longest`. Where the factorisation no longer holds, they end when what is left should
    /// be within `until`. Whether the shape is solved, and evaluated.
    fn chord(&mut self, inputs: &Inputs, unknowns: &mut [f64], mut longest: f64, until: f64) -> bool {
        let Scene { chain, settings, .. } = self.scene;
        for done in 0..CORRECTIONS {
            let mut potential = self.potential(inputs);
            let Some(energy) = potential.chord_slope(unknowns) else { return false };
            let residual = dual_norm(potential.metric(), potential.gradient()) / chain.radian_norm();
            (self.report.residual, self.report.energy) = (residual, energy);
            let holds = until == 0.0 || self.holds(unknowns);
            if residual <= settings.tolerance {
                return holds;
            }
            let length = self.step(inputs, done);
            if length.is_nan() || length > longest {
                return holds && length < ROUNDING;
            }
            apply(unknowns, &self.scratch.steps[done]);
            self.report.iterations += 1;
            longest = CHORD_CONTRACTION * length;
            if !holds && longest <= until {
                return false;
            }
        }
        false
    }

    /// Whether what the last factorisation tells about stability holds for the present loads and `unknowns`.
    fn holds(&self, unknowns: &[f64]) -> bool {
        let last = self.work.factorisation.as_ref();
        last.is_some_and(|last| last.holds_at(self.scene.chain, unknowns, self.work.loads(), self.reach))
    }

    /// Chooses the rules for a shape.
    pub(super) fn choose_rules(&mut self, inputs: &Inputs, unknowns: &[f64]) {
        self.work.place(self.scene.chain, &inputs.base, unknowns);
        self.choose_rules_here();
    }

    /// The same for the shape evaluated last; whether any rule is another one than before.
    fn choose_rules_here(&mut self) -> bool {
        self.rules.choose(self.scene.chain, &self.work.nodes)
    }

    /// An upper bound of the margin at the shape `unknowns`, which the last correction has found.
    pub(super) fn judge(&mut self, inputs: &Inputs, unknowns: &[f64], softest: &mut [f64], search: Search) {
        let mut margin = if self.work.factorisation.is_some() {
            self.estimate_margin(inputs, softest, search)
        } else {
            f64::NAN
        };
        if margin.is_nan() || margin < DOUBTFUL {
            // The Hessian is that of a shape one step earlier, which may be held by what it was off.
            let mut potential = self.potential(inputs);
            let regular = potential.linearise(unknowns).is_some() && potential.factorise(0.0);
            margin = if regular { self.estimate_margin(inputs, softest, search) } else { 0.0 };
        }
        if let Some(factorisation) = &mut self.work.factorisation {
            factorisation.set_judged(true);
        }
        if margin.is_finite() {
            let held = margin > FREE;
            (self.report.margin, self.report.stable) = (if held { margin } else { 0.0 }, Some(held));
            self.report.outcome = if held { Outcome::Solved } else { Outcome::Neutral };
        } else {
            self.report.outcome = Outcome::Solved;
            softest.fill(0.0);
        }
    }

    /// An upper bound of the margin at the shape that was factorised last; not a number where none is found.
    fn estimate_margin(&mut self, inputs: &Inputs, softest: &mut [f64], search: Search) -> f64 {
        let metric = &self.scene.chain.metric;
        // A little of every direction, or a mode that the last one is orthogonal to would go unseen.
        spread(metric, softest, EVERY_DIRECTION);
        let mut lanczos = std::mem::take(&mut self.scratch.lanczos);
        let margin = self.potential(inputs).margin(&mut lanczos, softest, search);
        self.scratch.lanczos = lanczos;
        margin
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
    let mut softest = vec![0.0; potential.chain.freedoms()];
    spread(&potential.chain.metric, &mut softest, 1.0);
    potential.margin(&mut Lanczos::default(), &mut softest, THOROUGH)
}
