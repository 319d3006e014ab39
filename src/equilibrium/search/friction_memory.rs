//! The memory of friction: how models of a design hand it on.

use super::solver::Equilibrium;
use crate::equilibrium::contact::FrictionMemory;
use crate::error::Error;
use crate::vessel::friction;

impl Equilibrium {
    /// Sets the coefficient of friction between chain and wall, from the next solve on. A chain that was free is held by its stick
    /// points where it is. Without a vessel nothing holds.
    ///
    /// # Errors
    /// [`Error::Range`] unless it is from 0 to 10.
    pub fn set_friction(&mut self, coefficient: f64) -> Result<(), Error> {
        let coefficient = friction::checked(coefficient)?;
        let solved = self.branch.inputs.is_some();
        if let Some(contact) = &mut self.contact {
            contact.set_friction(coefficient, solved);
        }
        Ok(())
    }

    /// What friction remembers; nothing without a vessel.
    pub(crate) fn friction_memory(&self) -> FrictionMemory {
        self.contact.as_ref().map(|contact| contact.friction.memory.clone()).unwrap_or_default()
    }

    /// Takes over what friction of another model of the same design remembered.
    pub(crate) fn recall_friction(&mut self, memory: &FrictionMemory) {
        if let Some(contact) = &mut self.contact {
            contact.friction.recall(memory);
        }
    }

    /// Takes over coefficient, memory and contacts of a model of the same design in the same vessel.
    pub(crate) fn copy_friction(&mut self, other: &Self) {
        if let (Some(own), Some(other)) = (&mut self.contact, &other.contact) {
            own.friction.clone_from(&other.friction);
        }
    }
}
