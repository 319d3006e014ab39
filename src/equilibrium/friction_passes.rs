//! Friction in a solve: normal forces follow the shape in passes, then anchors follow the places that slide.

use nalgebra::Vector3;

use super::friction::{Pressure, Stage};
use super::friction_places::{KeptShape, Placing};
use super::grip::{Grip, Place};
use super::history::History;
use super::inputs::Inputs;
use super::outcome::Outcome;
use super::search::Search;
use crate::numerics::trust_region::Objective;

/// Change of the friction forces from pass to pass at which they have settled, relative to the largest that they could be.
const SETTLED: f64 = 1e-4;

/// Change of a friction force at which it has settled, N: far below what matters.
const NOTHING: f64 = 1e-8;

/// Normal force (N) below which there is none: its square could underflow.
const LEAST: f64 = 1e-30;

/// Most passes.
const PASSES: usize = 40;

impl Search<'_> {
    /// Begins a solve: keeps the memory for the case that it fails.
    pub(super) fn begin_friction(&mut self) {
        let friction = &mut self.work.friction;
        if friction.acts() {
            friction.before.clone_from(&friction.memory);
        }
    }

    /// Gives the memory back that the branch had before a solve that failed, or at the last equilibrium on its way.
    pub(super) fn recall_friction(&mut self, on_the_way: bool) {
        let friction = &mut self.work.friction;
        if friction.acts() {
            let from = if on_the_way { &friction.reached } else { &friction.before };
            friction.memory.clone_from(from);
        }
    }

    /// Keeps the memory at an equilibrium on the way.
    pub(super) fn note_friction(&mut self) {
        let friction = &mut self.work.friction;
        if friction.acts() {
            friction.reached.clone_from(&friction.memory);
        }
    }

    /// Ends a solve at an equilibrium: the first one is held as it is.
    pub(super) fn end_friction(&mut self, inputs: &Inputs, unknowns: &[f64]) {
        if !self.work.friction.acts() {
            return;
        }
        if self.work.friction.memory.stage == Stage::Free {
            self.potential(inputs).slope(unknowns);
            let here = KeptShape::of(self.work);
            self.work.friction.memory.grips = self.pressed(&here);
        }
        let friction = &mut self.work.friction;
        friction.memory.stage =
            if friction.memory.stage == Stage::Free { Stage::Rested } else { Stage::Moved };
        if !(friction.memory.grips.is_empty() && friction.before.grips.is_empty()) {
            // It belongs to an earlier state of the friction, which is not kept.
            self.work.factorisation = None;
        }
    }

    /// Lets normal forces and their directions follow a shape just found at `inputs`, coming from the shape `start` at `before`,
    /// until friction changes no more, and drags the anchors along; `false` where it does not settle: the shape then is `start`
    /// again. With `downhill` it may descend, as a shape may that was found by a descent.
    pub(super) fn settle_friction(
        &mut self,
        [before, inputs]: [&Inputs; 2],
        start: &[f64],
        unknowns: &mut [f64],
        downhill: bool,
    ) -> bool {
        let friction = &self.work.friction;
        if !friction.holds() || friction.memory.grips.is_empty() && friction.pressures.is_empty() {
            return true;
        }
        self.work.place(self.model.chain, before, start);
        let from = KeptShape::of(self.work);
        let kept = self.work.friction.memory.clone();
        for _ in 0..PASSES {
            if !self.may_go_on() || self.potential(inputs).slope(unknowns).is_none() {
                break;
            }
            let next = self.pressed(&from);
            if self.change(&next) <= 1.0 {
                self.work.friction.memory.grips = next;
                self.drag();
                return true;
            }
            self.work.friction.memory.grips = next;
            let mut trial = unknowns.to_vec();
            if self.correct(inputs, &mut trial, self.model.settings.follow_step) {
                unknowns.copy_from_slice(&trial);
            } else if !downhill || self.descend(inputs, unknowns, self.resting()) != Outcome::Solved {
                break;
            }
        }
        self.work.friction.memory = kept;
        unknowns.copy_from_slice(start);
        false
    }

    /// Settles the friction of a shape just found from the last one of the branch.
    pub(super) fn settle_friction_of(&mut self, branch: &mut History, target: &Inputs) -> bool {
        if !self.work.friction.holds() {
            return true;
        }
        let start = self.scratch.last.clone();
        let Some(before) = &branch.inputs else { return true };
        self.settle_friction([before, target], &start, &mut branch.unknowns, false)
    }

    /// The grips under the normal forces of the shape evaluated last; new ones are anchored where their places were in the shape
    /// `from`.
    fn pressed(&self, from: &KeptShape) -> Vec<Grip> {
        let (chain, friction) = (self.model.chain, &self.work.friction);
        let Some(surface) = self.model.around.map(|around| &around.surface) else { return Vec::new() };
        let (here, from) = (self.work.placing(chain, surface), from.placing(chain, surface));
        let earlier = &friction.memory.grips;
        let mut out = Vec::new();
        for sum in summed(&friction.pressures, &here) {
            let Some(frame) = here.frame(sum.place) else { continue };
            let Sum { place, force, normal, arm } = sum;
            let (normal, arm) = (normal.normalize(), frame.rotation.tr_mul(&(arm / force)));
            let start = from.frame_or_outside(place);
            let grip = if let Ok(number) = earlier.binary_search_by_key(&place, |grip| grip.place) {
                let mut grip = earlier[number];
                grip.on_arm(&arm, &start.rotation);
                Grip { normal, force, ..grip }
            } else {
                let anchor = start.position + start.rotation * arm;
                Grip { place, anchor, arm, normal, force }
            };
            out.push(grip);
        }
        out
    }

    /// Change of the friction forces at the present shape to those of `next`, relative to what counts as settled.
    fn change(&self, next: &[Grip]) -> f64 {
        let coefficient = self.work.friction.coefficient;
        let Some(around) = self.model.around else { return 0.0 };
        let here = self.work.placing(self.model.chain, &around.surface);
        let pull = |grip: &Grip| {
            here.frame(grip.place).map_or_else(Vector3::zeros, |frame| grip.pull(&frame, coefficient))
        };
        let (mut change, mut largest) = (0.0, 0.0);
        let mut gone = self.work.friction.memory.grips.iter().peekable();
        for grip in next {
            while let Some(lost) = gone.next_if(|old| old.place < grip.place) {
                change += pull(lost).norm();
            }
            let before = gone.next_if(|old| old.place == grip.place).map_or_else(Vector3::zeros, pull);
            change += (pull(grip) - before).norm();
            largest += coefficient * grip.force;
        }
        change += gone.map(|lost| pull(lost).norm()).sum::<f64>();
        change / (SETTLED * largest + NOTHING)
    }

    fn drag(&mut self) {
        let Some(around) = self.model.around else { return };
        let mut grips = std::mem::take(&mut self.work.friction.memory.grips);
        let here = self.work.placing(self.model.chain, &around.surface);
        for grip in &mut grips {
            if let Some(frame) = here.frame(grip.place) {
                grip.drag(&frame);
            }
        }
        self.work.friction.memory.grips = grips;
    }
}

/// Normal forces on one place.
struct Sum {
    place: Place,
    /// Sum of their magnitudes, N.
    force: f64,
    /// Their sum, those to the other side turned round: opposite walls are alike for friction.
    normal: Vector3<f64>,
    /// Sum of magnitudes times arms, N m.
    arm: Vector3<f64>,
}

/// The normal forces, shared among the places and summed there, in the order of the places.
fn summed(pressures: &[Pressure], here: &Placing<'_>) -> Vec<Sum> {
    let mut parts: Vec<Sum> = Vec::new();
    for Pressure { on, force, arm } in pressures {
        for (place, share) in here.shares(*on) {
            let size = share * force.norm();
            if size > LEAST {
                parts.push(Sum { place, force: size, normal: force * share, arm: arm * size });
            }
        }
    }
    parts.sort_by_key(|sum| sum.place);
    let mut out: Vec<Sum> = Vec::new();
    for part in parts {
        match out.last_mut().filter(|last| last.place == part.place) {
            Some(last) => {
                let side = if last.normal.dot(&part.normal) < 0.0 { -1.0 } else { 1.0 };
                last.force += part.force;
                last.normal += part.normal * side;
                last.arm += part.arm;
            }
            None => out.push(part),
        }
    }
    out
}
