//! Following a stable branch while the inputs change, and falling to the next one past a fold.

use serde::{Deserialize, Serialize};

use super::chain::Chain;
use super::correction::{End, KEPT, NEARLY, ROUNDING, Report, Scene, Scratch, Walk};
use super::inputs::Inputs;
use super::outcome::Outcome;
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

/// Shapes before the present one that are kept to foresee the next.
const EARLIER: usize = 2;

/// Longest step (in the chain's unit) that is foreseen instead of found.
const FORESEEN: f64 = 0.1;

/// Part of a foreseen step by which it may have to be corrected.
const MISTAKEN: f64 = 0.1;

/// Part of the iterations, as one over this number, that is kept for a fall at the end of the way.
const RESERVE: u32 = 3;

/// How much further a fall is tried where it ends on a shape of neutral stability, neither held nor let go.
const FURTHER: f64 = 16.0;

/// The shape, and the inputs at which it is in equilibrium.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub(super) struct Branch {
    pub(super) unknowns: Vec<f64>,
    pub(super) inputs: Option<Inputs>,
    /// Shape and inputs of the solves before on this branch, the last one first.
    earlier: Vec<(Vec<f64>, Inputs)>,
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
        let unknowns = vec![0.0; chain.freedoms()];
        Self { unknowns, inputs: None, earlier: Vec::new(), margin: 0.0, stable: None, softest }
    }

    /// Whether that many unknowns are those of every shape, and all of them are finite.
    pub(super) fn fits(&self, freedoms: usize) -> bool {
        let earlier = self.earlier.iter().map(|earlier| &earlier.0);
        let mut lists = [&self.unknowns, &self.softest].into_iter().chain(earlier);
        lists.all(|list| are_finite(list, freedoms)) && self.earlier.len() <= EARLIER
    }

    /// All inputs.
    pub(super) fn all_inputs(&self) -> impl Iterator<Item = &Inputs> {
        self.inputs.iter().chain(self.earlier.iter().map(|earlier| &earlier.1))
    }

    /// Goes on to a shape at `inputs`; `last` is the shape before.
    fn advance(&mut self, inputs: &Inputs, last: &[f64], snapped: bool) {
        let Some(here) = &mut self.inputs else {
            self.inputs = Some(inputs.clone());
            return;
        };
        if snapped {
            self.earlier.clear();
        } else if self.earlier.len() < EARLIER {
            self.earlier.insert(0, (last.to_vec(), here.clone()));
        } else {
            self.earlier.rotate_right(1);
            let (shape, before) = &mut self.earlier[0];
            shape.copy_from_slice(last);
            before.copy_from(here);
        }
        here.copy_from(inputs);
    }

    /// Writes to `shape` where the last steps lead to at `target`, as far along as the inputs go on; the length of that step
    /// in the chain's unit. `None` where the inputs go elsewhere, or the way is too far or too near a fold to tell.
    ///
    /// The line through the last two shapes; the parabola through three (Newton's divided differences) where the inputs have
    /// gone on all the way and it differs by more than the tolerance, which the shapes themselves may be off.
    fn foresee(&self, target: &Inputs, scene: &Scene<'_>, shape: &mut [f64]) -> Option<f64> {
        let held = self.stable.is_none_or(|stable| stable && self.margin >= scene.settings.fold_margin);
        let (Some(here), [(last, before), older @ ..], true) = (&self.inputs, &self.earlier[..], held) else {
            return None;
        };
        let pace = target.pace(here, before)?;
        for ((x, now), then) in shape.iter_mut().zip(&self.unknowns).zip(last) {
            *x = pace * (now - then);
        }
        if let [(oldest, first), ..] = older
            && let Some(quickened) = here.pace(before, first).filter(|pace| *pace > 0.0)
        {
            let curved = pace * (pace + 1.0) / (1.0 + 1.0 / quickened);
            let bends = self.unknowns.iter().zip(last).zip(oldest);
            let bends = bends.map(|((now, then), old)| curved * ((now - then) - quickened * (then - old)));
            let squares = bends.clone().zip(&scene.chain.metric).map(|(bend, k)| k * bend * bend);
            if squares.sum::<f64>().sqrt() > scene.settings.tolerance * scene.chain.unit() {
                shape.iter_mut().zip(bends).for_each(|(x, bend)| *x += bend);
            }
        }
        let length = norm(&scene.chain.metric, shape) / scene.chain.unit();
        shape.iter_mut().zip(&self.unknowns).for_each(|(x, now)| *x += now);
        Some(length).filter(|length| *length <= FORESEEN)
    }
}

/// Whether these are so many finite numbers.
pub(super) fn are_finite(list: &[f64], count: usize) -> bool {
    list.len() == count && list.iter().all(|x| x.is_finite())
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
        let foreseen = walk.foreseen(branch, target);
        let end = foreseen.unwrap_or_else(|| walk.run(branch.inputs.as_ref(), target, &mut branch.unknowns));
        match end {
            End::Kept => {
                (walk.report.margin, walk.report.stable) = (branch.margin, branch.stable);
                let free = walk.report.stable == Some(false);
                walk.report.outcome = if free { Outcome::Neutral } else { Outcome::Solved };
            }
            End::Held => {
                walk.judge(target, &branch.unknowns, &mut branch.softest);
                // Newton's method ends where the Hessian is definite: what is not stable there is free to rounding.
                let free = walk.report.stable == Some(false);
                walk.report.outcome = if free { Outcome::Neutral } else { Outcome::Solved };
            }
            End::Neutral => {
                // The factorisation is that of a shape on the way.
                walk.work.factored = false;
                walk.report.stable = Some(false);
                walk.report.outcome = Outcome::Neutral;
            }
            End::Lost => {
                // The last shape that was tried may say why.
                let contact = walk.scene.contact(target, walk.work).map(Outcome::Contact);
                walk.report.outcome = contact.unwrap_or(walk.report.outcome);
                walk.work.factored = false;
                branch.unknowns.copy_from_slice(&walk.scratch.last);
                return walk.report;
            }
        }
        walk.work.place(self.chain, &target.base, &branch.unknowns);
        if let Some(contact) = walk.scene.contact(target, walk.work) {
            walk.report.outcome = Outcome::Contact(contact);
            walk.work.factored = false;
            branch.unknowns.copy_from_slice(&walk.scratch.last);
            return walk.report;
        }
        walk.report.progress = 1.0;
        (branch.margin, branch.stable) = (walk.report.margin, walk.report.stable);
        branch.advance(target, &walk.scratch.last, walk.report.snaps > 0);
        walk.report
    }
}

impl Walk<'_> {
    /// Corrects the shape that the last step leads to expect, if there is one and it is nearly right.
    fn foreseen(&mut self, branch: &mut Branch, target: &Inputs) -> Option<End> {
        let mut trial = std::mem::take(&mut self.scratch.trial);
        let expected = branch.foresee(target, &self.scene, &mut trial);
        let end =
            expected.and_then(|length| self.correct(target, &mut trial, (MISTAKEN * length).max(NEARLY)));
        if end.is_some() {
            branch.unknowns.copy_from_slice(&trial);
        }
        self.scratch.trial = trial;
        end
    }

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
        while self.left() > self.scene.settings.iterations / RESERVE {
            let next = f64::min(1.0, done + part);
            let between;
            let inputs = if next >= 1.0 {
                target
            } else {
                between = start.between(target, next);
                &between
            };
            let settings = self.scene.settings;
            let corrected = if falling { None } else { self.try_to_correct(inputs, unknowns) };
            let end = if let Some(end) = corrected {
                end
            } else if !falling && part > settings.smallest_part {
                part *= 0.5;
                continue;
            } else {
                self.fall(inputs, unknowns)
            };
            match end {
                End::Kept | End::Held => falling = false,
                End::Neutral if next < 1.0 => {
                    falling = true;
                    part *= FURTHER;
                    continue;
                }
                End::Neutral if self.report.residual <= ROUNDING => return End::Neutral,
                _ => return End::Lost,
            }
            done = next;
            part *= 2.0;
            if done >= 1.0 {
                return end;
            }
        }
        // Too many small steps along the branch: downhill all the way.
        match self.fall(target, unknowns) {
            End::Neutral if self.report.residual > ROUNDING => End::Lost,
            end => end,
        }
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
