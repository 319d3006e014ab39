//! What friction adds to the push that holds a shaft, and how models of a design hand friction on.

use super::friction::{FrictionMemory, Stage};
use super::friction_places::Carrier;
use super::solver::Equilibrium;
use crate::rod::Configuration;
use crate::vessel::friction;

impl Equilibrium {
    /// Derivative of the energy of friction with respect to the inserted length, N: at fixed places of the shaft's curve, what
    /// holds on to its anchor moves along that curve.
    pub(super) fn friction_push(&self) -> f64 {
        let (chain, work) = (&self.chain, &self.work);
        let Some(around) = self.around.as_deref().filter(|_| work.friction.acts()) else { return 0.0 };
        let (length, inserted) = (chain.inserted(1.0), chain.inserted(work.growth));
        let mut push = 0.0;
        for grip in &work.friction.memory.grips {
            let Some(behind) = grip.place.behind() else { continue };
            let Some(Carrier::Row(k, row)) = grip.place.carrier(chain, &around.surface, work.growth) else {
                continue;
            };
            let (element, amplitudes) = (&chain.elements[k], chain.part(k, &work.placed));
            let configuration = &work.configurations[k];
            let (_, tangent) = configuration.curve_at(element, &row, amplitudes);
            let turning = Configuration::turning_at(element, &row, amplitudes);
            let node = &work.nodes[k];
            let frame = node.compose(&configuration.pose_at(element, &row, amplitudes));
            let (load, _) = grip.load(&frame, work.friction.coefficient);
            let per_arc =
                load.force.dot(&(node.rotation * tangent)) + load.moment().dot(&(node.rotation * turning));
            push += per_arc * length * behind / (inserted * inserted);
        }
        push
    }

    /// Sets the coefficient of friction between chain and wall, from the next solve on. A chain that was free is held by its anchors
    /// where it is.
    ///
    /// # Errors
    /// [`Error::Range`](crate::error::Error::Range) unless it is from 0 to 10.
    pub fn set_friction(&mut self, coefficient: f64) -> Result<(), crate::error::Error> {
        let coefficient = friction::checked(coefficient)?;
        let friction = &mut self.work.friction;
        if coefficient == 0.0 {
            friction.forget();
        } else if !friction.acts() && self.branch.inputs.is_some() {
            friction.memory.stage = Stage::Moved;
        }
        friction.coefficient = coefficient;
        Ok(())
    }

    /// What friction remembers.
    pub(crate) fn friction_memory(&self) -> &FrictionMemory {
        &self.work.friction.memory
    }

    /// Takes over what friction of another model of the same design remembered.
    pub(crate) fn recall_friction(&mut self, memory: &FrictionMemory) {
        self.work.friction.recall(memory);
    }
}
