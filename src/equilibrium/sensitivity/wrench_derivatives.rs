//! Rows of the Jacobian for the wrenches on the chain and on the sources of the field.

use nalgebra::DMatrix;

use super::output_derivatives::{Output, OutputDerivatives};
use super::response::{Response, transport_base};
use crate::equilibrium::search::{Equilibrium, Solution};
use crate::geometry::hat;

impl Equilibrium {
    /// Wrenches of the external field on the chain, of the clamp on the chain, and of the chain on magnets and coils.
    pub(crate) fn add_wrenches(&self, rows: &mut OutputDerivatives<'_>, response: &Response) {
        let Response { by_base, columns, unknowns, .. } = response;
        let mut with_field = by_base.clone();
        for row in (0..by_base.nrows()).filter(|row| !response.counts.is_of_field(*row)) {
            with_field.row_mut(row).fill(0.0);
        }
        let by_shape = (&columns.gradient * with_field).tr_mul(unknowns);
        let mut on_field = only(&columns.clamp, |column| response.counts.is_of_field(column));
        transport_base(&mut on_field, by_base);
        let magnetic = [Output::MagneticForce, Output::MagneticTorque];
        rows.set_wrench(magnetic, &(by_shape - on_field), &self.magnetic_wrench());
        let clamp = [Output::BaseReactionForce, Output::BaseReactionMoment];
        rows.set_wrench(clamp, &response.clamp, &self.base_reaction());

        for number in 0..response.counts.sources {
            self.add_source_wrench(rows, response, number);
        }
    }

    /// Wrench of the chain on the source of this number.
    fn add_source_wrench(&self, rows: &mut OutputDerivatives<'_>, response: &Response, number: usize) {
        let Response { by_base, columns, unknowns, counts, .. } = response;
        let inputs = rows.inputs;
        let Some(placed) = inputs.sources.get(number) else { return };
        let reaction = self.source_reaction(number, inputs);
        let own = counts.of_source(number);
        let (position, motion) = (own.start..own.start + 3, own.start..own.start + 6);
        let by_shape = columns.gradient.columns_range(motion).tr_mul(unknowns);
        let mut on_source = only(&columns.clamp, |column| own.contains(&column));
        // The torque is moved from the base to the centre of the source, which may move.
        let moved = hat(&(placed.pose.position - inputs.base.position)) * on_source.rows(0, 3);
        let mut torque = on_source.rows_mut(3, 3);
        torque -= moved;
        let mut by_position = torque.columns_range_mut(position);
        by_position += hat(&reaction.force);
        transport_base(&mut on_source, by_base);
        let outputs = [Output::SourceReactionForce(number), Output::SourceReactionTorque(number)];
        rows.set_wrench(outputs, &(on_source - by_shape), &reaction);
    }
}

/// The columns that are kept; the others are zero.
fn only(rates: &DMatrix<f64>, is_kept: impl Fn(usize) -> bool) -> DMatrix<f64> {
    let mut out = rates.clone();
    for column in (0..rates.ncols()).filter(|column| !is_kept(*column)) {
        out.column_mut(column).fill(0.0);
    }
    out
}
