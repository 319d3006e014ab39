//! What an equilibrium remembers, to be taken up by another one, also in another process.

use serde::{Deserialize, Serialize};

use super::follow::Branch;
use super::potential::Potential;
use super::solver::Equilibrium;
use super::source::Source;
use crate::error::Error;
use crate::numerics::trust_region::Objective;

/// What an equilibrium remembers of its past, in numbers; from it another one of the same design goes on bit for bit.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Snapshot {
    branch: Branch,
    /// Where the Hessian was factorised that the next solve begins with.
    factorised: Option<Vec<f64>>,
    /// The rules of the ring pairs there.
    rules: Vec<usize>,
}

impl Equilibrium {
    /// What it remembers.
    #[must_use]
    pub fn snapshot(&self) -> Snapshot {
        Snapshot {
            branch: self.branch.clone(),
            factorised: self.work.factored.then(|| self.work.linearised.clone()),
            rules: self.rules.chosen(),
        }
    }

    /// Remembers what another equilibrium of the same design and settings did.
    ///
    /// # Errors
    /// [`Error::Unsupported`] for a snapshot that is not of this design; the branch is then forgotten.
    pub fn restore(&mut self, snapshot: &Snapshot) -> Result<(), Error> {
        self.reset();
        let Snapshot { branch, factorised, rules } = snapshot;
        let lists = [Some(&branch.unknowns), Some(&branch.softest), factorised.as_ref()];
        let fits = (lists.iter().flatten())
            .all(|list| list.len() == self.chain.freedoms() && list.iter().all(|entry| entry.is_finite()));
        let foreign = || Error::Unsupported("the snapshot is not of this design".into());
        if !fits || !self.rules.restore(rules) {
            return Err(foreign());
        }
        let Some(inputs) = &branch.inputs else { return Ok(()) };
        inputs.check(self.chain.rings.len())?;
        let mut potential = Potential {
            chain: &self.chain,
            settings: &self.settings,
            inputs,
            field: Source::external(self.magnet.as_ref(), inputs),
            rules: &self.rules,
            work: &mut self.work,
        };
        let factorised = factorised
            .as_ref()
            .is_none_or(|shape| potential.linearise(shape).is_some() && potential.factorise(0.0));
        if !factorised || potential.slope(&branch.unknowns).is_none() {
            self.reset();
            return Err(foreign());
        }
        self.branch = branch.clone();
        Ok(())
    }
}
