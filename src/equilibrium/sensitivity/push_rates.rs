//! Rates of the push that holds a shaft in its port, by all inputs.

use nalgebra::{DMatrix, Vector3};

use super::response::{Response, transport_base};
use crate::equilibrium::model::{Input, Inputs};
use crate::equilibrium::search::{ByInsertion, Equilibrium};

impl Equilibrium {
    /// Rates of the push, one for each input.
    ///
    /// Second derivatives are symmetric: what the shape changes in the push is what the length changes in the gradient.
    pub(crate) fn push_rates(
        &self,
        response: &Response,
        inputs: &Inputs,
        by_insertion: &ByInsertion,
    ) -> DMatrix<f64> {
        let Response { unknowns, by_base, .. } = response;
        let mut out = self.weighted_rates(inputs, unknowns.ncols());
        transport_base(&mut out, by_base);
        out[Input::Insertion.columns().start] = by_insertion.push;
        out[Input::GuidewireInsertion.columns().start] = self.work.lining_push_by_reach(&self.chain);
        out + DMatrix::from_row_slice(1, unknowns.nrows(), &by_insertion.gradient) * unknowns
    }

    /// Rates of the push where every body stays in place: more length weighs more and touches more.
    fn weighted_rates(&self, inputs: &Inputs, columns: usize) -> DMatrix<f64> {
        let (chain, work) = (&self.chain, &self.work);
        let growth = chain.growth(inputs.insertion);
        let (mut by_gravity, mut by_shift, mut by_spin) =
            (Vector3::zeros(), Vector3::zeros(), Vector3::zeros());
        for (k, element) in chain.elements[..chain.shaft].iter().enumerate() {
            let node = &work.nodes[k];
            for (station, state) in element.stations.iter().zip(&work.configurations[k].stations) {
                let mass =
                    station.material.line_mass + station.material.density * station.material.moments.volume;
                by_gravity -= (node.transform(&state.position) - inputs.base.position) * (growth * mass);
            }

            for placed in &work.placed_loads[k].loads {
                let arm = node.transform(&placed.frame.pose.position) - inputs.base.position;
                let force = node.rotation * placed.load.force;
                by_shift -= force;
                by_spin -= arm.cross(&force) + node.rotation * placed.load.moment();
            }
        }

        let mut out = DMatrix::zeros(1, columns);
        let inserted = chain.inserted(growth);
        for (input, rates) in [
            (Input::Gravity, by_gravity),
            (Input::VesselPosition, by_shift),
            (Input::VesselRotation, by_spin),
        ] {
            out.columns_range_mut(input.columns()).copy_from(&(rates / inserted).transpose());
        }
        out
    }
}
