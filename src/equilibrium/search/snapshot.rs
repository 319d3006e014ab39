//! Snapshots of a branch, from which another equilibrium continues, also in another process.

use serde::{Deserialize, Serialize};

use super::history::{History, are_finite};
use super::solver::Equilibrium;
use crate::equilibrium::contact::FrictionMemory;
use crate::equilibrium::model::Origin;
use crate::error::Error;
use crate::numerics::trust_region::Objective;

/// Stored state of a branch, from which another equilibrium of the same design in the same vessel continues bit for bit.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct BranchSnapshot {
    /// What tells the equilibria of one design, discretisation, magnet and vessel from others.
    device: u32,
    branch: History,
    friction: FrictionMemory,
    /// Shape and inputs of the Hessian whose factorisation the next solve starts with.
    origin: Option<Origin>,
    /// Quadrature rules of the ring pairs at the present shape of the branch.
    rules: Vec<usize>,
}

impl Equilibrium {
    /// Takes a snapshot of the branch.
    #[must_use]
    pub fn snapshot(&self) -> BranchSnapshot {
        BranchSnapshot {
            device: self.mark(),
            branch: self.branch.clone(),
            friction: self.friction_memory(),
            origin: self.work.factorisation.as_ref().map(|last| last.origin().clone()),
            rules: self.rules.chosen().collect(),
        }
    }

    /// Restores the snapshot of another equilibrium of the same design, discretisation, magnet and vessel.
    ///
    /// # Errors
    /// [`Error::Unsupported`] for a snapshot of another design or vessel, or with friction that is not finite; the branch is then
    /// forgotten.
    pub fn restore(&mut self, snapshot: &BranchSnapshot) -> Result<(), Error> {
        self.reset();
        let BranchSnapshot { device, branch, friction, origin, rules } = snapshot;
        let fits = *device == self.mark()
            && branch.fits(self.chain.freedoms())
            && origin.as_ref().is_none_or(|origin| are_finite(&origin.unknowns, self.chain.freedoms()));
        let foreign = || Error::Unsupported("the snapshot is not of this design, magnet and vessel".into());
        if !fits || !self.rules.restore(rules) {
            return Err(foreign());
        }
        if !friction.is_finite() {
            return Err(Error::Unsupported("the snapshot's friction is not finite".into()));
        }

        let Some(inputs) = &branch.inputs else { return Ok(()) };
        for inputs in branch.all_inputs().chain(origin.as_ref().map(|origin| &origin.inputs)) {
            inputs.check(self.chain.rings.len())?;
        }

        // The factorisation is that of the shape where it was made; friction held nothing there that it knows of.
        self.lay_out(inputs);
        let refactorised = origin.as_ref().is_none_or(|origin| self.refactorise(origin));
        self.work.free_turn = branch.turn;
        if let Some(contact) = &mut self.contact {
            contact.friction.memory = friction.clone();
        }
        let replaced = refactorised && self.rules.restore(rules);
        if !replaced || self.potential_as_ruled(inputs).slope(&branch.unknowns).is_none() {
            self.reset();
            return Err(foreign());
        }
        self.branch = branch.clone();
        Ok(())
    }

    /// A number that equilibria of one design, discretisation, magnet and vessel have in common: a checksum of all their numbers.
    fn mark(&self) -> u32 {
        let sources: Vec<_> = self.sources.list().iter().map(|source| source.identity()).collect();
        let vessel = self.vessel().map(|vessel| (vessel.lumen.checksum(), vessel.wall.modulus()));
        crc32fast::hash(format!("{:?} {sources:?} {vessel:?}", self.chain.made_from()).as_bytes())
    }

    /// Computes and factorises the Hessian of `origin` again.
    fn refactorise(&mut self, origin: &Origin) -> bool {
        if !self.rules.restore(&origin.rules) {
            return false;
        }
        self.work.free_turn = origin.turn;
        let mut potential = self.potential_as_ruled(&origin.inputs);
        let done = potential.linearise(&origin.unknowns).is_some() && potential.factorise(0.0);
        if let Some(factorisation) = &mut self.work.factorisation {
            factorisation.set_assessed(origin.assessed);
        }
        done
    }
}
