//! Following a stable branch while the inputs change, and falling to the next one past a fold.

use serde::{Deserialize, Serialize};

use super::chain::Chain;
use super::correction::{End, KEPT, NEARLY, ROUNDING, Report, Scene, Scratch, Walk};
use super::inputs::Inputs;
use super::potential::Workspace;
use super::rules::PairRules;
use crate::numerics::trust_region::{self, Region, norm, spread};

/// Largest first step from the straight shape to the one that the internal forces alone leave: there is no
/// branch to lose yet.
const SETTLING: f64 = 4.0;

/// First radius of the trust region past a fold, in the chain's unit: small, so that the fall is followed.
const FALL_RADIUS: f64 = 0.1;

/// A fall further than this (in the chain's unit) is a snap, a shorter one a bend in the branch.
const SNAP: f64 = 0.25;

/// How much further than the smallest part a fall is tried, and again where it ends on a shape of neutral stability, neither
/// held nor let go.
const FURTHER: f64 = 64.0;

/// The shape, and the inputs at which it is in equilibrium.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub(super) struct Branch {
    pub(super) unknowns: Vec<f64>,
    pub(super) inputs: Option<Inputs>,
    /// Margin and verdict at the last factorisation.
    margin: f64,
    stable: Option<bool>,
    /// Direction of least stiffness, the first guess for the next search.
    pub(super) softest: Vec<f64>,
}

impl Branch {
    pub(super) fn new(chain: &Chain) -> Self {
        let mut softest = vec![0.0; chain.freedoms()];
        spread(&chain.metric, &mut softest, 1.0);
        Self { unknowns: vec![0.0; chain.freedoms()], inputs: None, margin: 0.0, stable: None, softest }
    }
}

impl Scene<'_> {
    /// Moves `branch` to the equilibrium at `target`; on failure the branch stays where it was.
    pub(super) fn follow(
        &self,
        branch: &mut Branch,
        target: &Inputs,
        work: &mut Workspace,
        rules: &mut PairRules,
        scratch: &mut Scratch,
    ) -> Report {
        let reach = KEPT * if branch.stable.is_some() { branch.margin } else { 1.0 };
        let mut walk = Walk { scene: *self, work, rules, scratch, report: Report::start(), reach };
        walk.scratch.last.copy_from_slice(&branch.unknowns);
        let end = walk.run(branch.inputs.as_ref(), target, &mut branch.unknowns);
        match end {
            End::Kept => (walk.report.margin, walk.report.stable) = (branch.margin, branch.stable),
            End::Held => walk.judge(target, &mut branch.softest),
            End::Neutral => {
                // The factorisation is that of a shape on the way.
                walk.work.factored = false;
                walk.report.stable = Some(false);
            }
            End::Lost => {
                walk.work.factored = false;
                branch.unknowns.copy_from_slice(&walk.scratch.last);
                return walk.report;
            }
        }
        walk.report.solved = true;
        (branch.margin, branch.stable) = (walk.report.margin, walk.report.stable);
        match &mut branch.inputs {
            Some(inputs) => inputs.copy_from(target),
            None => branch.inputs = Some(target.clone()),
        }
        walk.report
    }
}

impl Walk<'_> {
    fn run(&mut self, from: Option<&Inputs>, target: &Inputs, unknowns: &mut [f64]) -> End {
        let unloaded;
        let start = if let Some(inputs) = from {
            inputs
        } else {
            // The unloaded shape: its internal forces alone, found from straight.
            unloaded = target.without_loads();
            if self.correct(&unloaded, unknowns, SETTLING).is_none()
                && self.fall(&unloaded, unknowns) != End::Held
            {
                return End::Lost;
            }
            // Settling under its own forces is no jump.
            self.report.snaps = 0;
            &unloaded
        };
        let (mut done, mut part, mut falling) = (0.0, 1.0, false);
        while self.left() > 0 {
            let next = f64::min(1.0, done + part);
            let between;
            let inputs = if next >= 1.0 {
                target
            } else {
                between = start.between(target, next);
                &between
            };
            let settings = self.scene.settings;
            let end = if falling {
                self.fall(inputs, unknowns)
            } else if let Some(end) = self.try_to_correct(inputs, unknowns) {
                end
            } else {
                // Right behind a fold, once it is found, a fall would begin too slowly.
                falling = part <= settings.smallest_part;
                part *= if falling { FURTHER } else { 0.5 };
                continue;
            };
            match end {
                End::Kept | End::Held => {}
                End::Neutral if next < 1.0 => {
                    falling = true;
                    part *= FURTHER;
                    continue;
                }
                End::Neutral if self.report.residual <= ROUNDING => return End::Neutral,
                _ => return End::Lost,
            }
            done = next;
            // Past a fold there is no reason to go on in steps as small as those that led to it.
            part = if falling { 1.0 } else { 2.0 * part };
            falling = false;
            if done >= 1.0 {
                return end;
            }
        }
        End::Lost
    }

    /// Iterations that this solve may still take.
    fn left(&self) -> u32 {
        self.scene.settings.iterations.saturating_sub(self.report.iterations)
    }

    /// Corrects a copy of `unknowns`, and takes it over if that ends at an equilibrium.
    fn try_to_correct(&mut self, inputs: &Inputs, unknowns: &mut [f64]) -> Option<End> {
        let mut trial = std::mem::take(&mut self.scratch.trial);
        trial.copy_from_slice(unknowns);
        let end = self.correct(inputs, &mut trial, self.scene.settings.follow_step);
        if end.is_some() {
            unknowns.copy_from_slice(&trial);
        }
        self.scratch.trial = trial;
        end
    }

    /// Downhill to the next minimum; counts a snap if it is far.
    fn fall(&mut self, inputs: &Inputs, unknowns: &mut [f64]) -> End {
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
            iterations: self.left(),
        };
        let mut fallen = unknowns.to_vec();
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
        unknowns.copy_from_slice(&fallen);
        end
    }
}
