//! Rows of the Jacobian: derivatives of every output with respect to shape and inputs.
//!
//! Wrenches are derivatives of the energy with respect to rigid motions of the field, of the magnet or of everything that
//! surrounds the chain. Second derivatives are symmetric, so that the derivatives of wrenches with respect to the shape
//! are columns of the inputs.

use nalgebra::{DMatrix, DMatrixView, Dim, Dyn, Matrix, Matrix3, RawStorage, Vector3};

use super::input_derivatives::turned;
use super::inputs::Inputs;
use super::layout::{Counts, Input, Output};
use super::response::{Motion, Response, inside, transport_base};
use super::shape_points::Site;
use super::solution::Solution;
use super::solver::Equilibrium;
use crate::error::Error;
use crate::geometry::{Pose, hat};
use crate::magnetics::Wrench;
use crate::rod::Row;

/// Sine of an angle below which it counts as not differentiable.
const CORNER: f64 = 1e-9;

/// Behaviour of a quantity under a rigid motion of the whole scene.
#[derive(Debug, Clone, Copy)]
enum Transport {
    Not,
    Vector(Vector3<f64>),
    Position(Vector3<f64>),
    Rotation,
}

/// The rows of all outputs.
pub(super) struct OutputDerivatives<'a> {
    matrix: DMatrix<f64>,
    counts: Counts,
    inputs: &'a Inputs,
}

impl<'a> OutputDerivatives<'a> {
    pub(super) fn new(inputs: &'a Inputs, counts: &Counts) -> Self {
        Self { matrix: DMatrix::zeros(counts.outputs(), counts.inputs()), counts: *counts, inputs }
    }

    pub(super) fn into_matrix(self) -> DMatrix<f64> {
        self.matrix
    }

    /// Sets the rows of an output; in the base's columns, `rates` are given relative to the base.
    fn set<R: Dim, S: RawStorage<f64, R, Dyn>>(
        &mut self,
        output: Output,
        rates: &Matrix<f64, R, Dyn, S>,
        kind: Transport,
    ) {
        let Some(range) = self.counts.rows(output) else { return };
        let mut rows = self.matrix.rows_mut(range.start, range.len());
        rows.iter_mut().zip(rates.iter()).for_each(|(entry, rate)| *entry = *rate);
        let (shift, spin) = (Input::BasePosition.columns().start, Input::BaseRotation.columns().start);
        let mut add = |column: usize, block: Matrix3<f64>| {
            let mut part = rows.columns_mut(column, 3);
            part += block;
        };
        match kind {
            Transport::Not => {}
            Transport::Vector(vector) => add(spin, -hat(&vector)),
            Transport::Rotation => add(spin, Matrix3::identity()),
            Transport::Position(point) => {
                add(shift, Matrix3::identity());
                add(spin, -hat(&(point - self.inputs.base.position)));
            }
        }
    }

    fn set_wrench(&mut self, [force, torque]: [Output; 2], rates: &DMatrix<f64>, wrench: &Wrench) {
        self.set(force, &rates.rows(0, 3), Transport::Vector(wrench.force));
        self.set(torque, &rates.rows(3, 3), Transport::Vector(wrench.torque));
    }
}

impl Equilibrium {
    /// Angle, position and rotation of the tip.
    pub(super) fn add_tip(&self, rows: &mut OutputDerivatives<'_>, response: &Response) {
        let tip = self.tip();
        let rates = self.tip_rates(response);
        let open = bending(&rows.inputs.base.axis(), &tip.axis());
        rows.set(Output::TipAngle, &(open.transpose() * rates.rows(3, 3)), Transport::Not);
        rows.set(Output::TipPosition, &rates.rows(0, 3), Transport::Position(tip.position));
        rows.set(Output::TipRotation, &rates.rows(3, 3), Transport::Rotation);
    }

    /// Wrenches of the external field on the chain, of the clamp on the chain, and of the chain on the magnet.
    pub(super) fn add_wrenches(&self, rows: &mut OutputDerivatives<'_>, response: &Response) {
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

        self.add_source_wrench(
            rows,
            response,
            0,
            [Output::MagnetReactionForce, Output::MagnetReactionTorque],
        );
        for further in 0..response.counts.further {
            let outputs = [Output::SourceReactionForce(further), Output::SourceReactionTorque(further)];
            self.add_source_wrench(rows, response, further + 1, outputs);
        }
    }

    /// Wrench of the chain on the source of this number.
    fn add_source_wrench(
        &self,
        rows: &mut OutputDerivatives<'_>,
        response: &Response,
        number: usize,
        outputs: [Output; 2],
    ) {
        let Response { by_base, columns, unknowns, counts, .. } = response;
        let inputs = rows.inputs;
        let Some(placed) = inputs.source(number) else { return };
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
        rows.set_wrench(outputs, &(on_source - by_shape), &reaction);
    }

    /// Length of the shaft, and the push that holds it.
    pub(super) fn add_feed(&self, rows: &mut OutputDerivatives<'_>, response: &Response) {
        if self.chain.shaft > 0 {
            let mut length = DMatrix::zeros(1, response.counts.inputs());
            length.columns_range_mut(Input::Insertion.columns()).fill(1.0);
            rows.set(Output::FeedLength, &length, Transport::Not);
            rows.set(Output::FeedReaction, &response.push, Transport::Not);
        }
    }

    /// The external field at the tip.
    pub(super) fn add_tip_field(
        &self,
        rows: &mut OutputDerivatives<'_>,
        response: &Response,
    ) -> Result<(), Error> {
        let (inputs, tip) = (rows.inputs, self.tip().position);
        let here = self.field_at(inputs, &tip).ok_or_else(inside)?;
        let mut terms = self.terms(inputs);
        if !response.with_idle {
            terms.magnets = terms.magnets.without_idle();
        }
        let rates = terms.field_rates(&tip, &response.counts).ok_or_else(inside)?;
        let mut field = DMatrix::zeros(3, response.counts.inputs());
        let mut gradient = terms.background.gradient();
        for (first, rates) in &rates {
            for (number, (rate, _)) in rates.iter().enumerate() {
                field.set_column(first + number, rate);
                if *first != Input::UniformField.columns().start && number < 3 {
                    // The field moves with the magnet: its derivative is minus its gradient.
                    gradient.set_column(number, &(gradient.column(number) - rate));
                }
            }
        }
        transport_base(&mut field, &response.by_base);
        let moved = gradient * self.tip_rates(response).rows(0, 3);
        rows.set(Output::TipField, &(field + moved), Transport::Vector(here));
        Ok(())
    }

    /// Positions of the centreline points.
    pub(super) fn add_shape(&mut self, rows: &mut OutputDerivatives<'_>, response: &Response) {
        let last = (self.shape.len() - 1) as f64;
        for (number, point) in self.shape.clone().iter().enumerate() {
            let (pose, mut rates) = match &point.place {
                Site::Rigid(node, distance) => {
                    let pose = self.work.nodes[*node];
                    let rates = moved(&response.motion.nodes[*node], &(pose.axis() * *distance));
                    (pose.advanced(*distance), rates)
                }
                Site::Elastic(element, row) => self.place(*element, row, &response.motion),
            };
            if self.chain.shaft > 0 {
                // The points stay at equal parts of the length.
                let slide = self.slide(&point.place, number as f64 / last);
                let mut by_insertion = rates.fixed_view_mut::<3, 1>(0, Input::Insertion.columns().start);
                by_insertion += slide;
            }
            rows.set(Output::ShapePoint(number), &rates.rows(0, 3), Transport::Position(pose.position));
        }
    }

    /// Position, rotation and axis of each ring.
    pub(super) fn add_rings(&self, rows: &mut OutputDerivatives<'_>, response: &Response) {
        for (number, (body, pose)) in self.chain.rings.iter().zip(self.rings()).enumerate() {
            let arm = pose.position - self.work.nodes[body.node].position;
            let rates = moved(&response.motion.nodes[body.node], &arm);
            let axis = pose.axis();
            rows.set(Output::RingPosition(number), &rates.rows(0, 3), Transport::Position(pose.position));
            rows.set(Output::RingRotation(number), &rates.rows(3, 3), Transport::Rotation);
            rows.set(Output::RingAxis(number), &(-hat(&axis) * rates.rows(3, 3)), Transport::Vector(axis));
        }
    }

    /// Bending angle of each core.
    pub(super) fn add_cores(&mut self, rows: &mut OutputDerivatives<'_>, response: &Response) {
        let chain = self.chain.clone();
        for (number, (start, stop)) in chain.cores.iter().enumerate() {
            let [first, _] = &chain.elements[*start].core_ends;
            let [_, last] = &chain.elements[*stop].core_ends;
            let (from, from_rates) = self.place(*start, first, &response.motion);
            let (to, to_rates) = self.place(*stop, last, &response.motion);
            let open = bending(&from.axis(), &to.axis());
            let rates = open.transpose() * (to_rates - from_rates).rows(3, 3);
            rows.set(Output::CoreAngle(number), &rates, Transport::Not);
        }
    }

    /// Displacement of a shape point along the chain as the shaft grows, per length: `share` is the part of the whole length before
    /// it.
    fn slide(&self, place: &Site, share: f64) -> Vector3<f64> {
        match place {
            Site::Rigid(node, _) => self.work.nodes[*node].axis() * (share - 1.0),
            Site::Elastic(element, row) => {
                let (chain, k) = (&self.chain, *element);
                let amplitudes = chain.part(k, &self.branch.unknowns);
                let (_, local) = self.work.configurations[k].curve_at(&chain.elements[k], row, amplitudes);
                // Of a tabulated length: that of the shaft's elements has grown.
                let along = if k < chain.shaft {
                    -share * chain.length() / (chain.inserted(self.work.growth) * self.work.growth)
                } else {
                    share - 1.0
                };
                self.work.nodes[k].rotation * local * along
            }
        }
    }

    fn tip_rates(&self, response: &Response) -> DMatrix<f64> {
        let last = self.chain.elements.len();
        moved(&response.motion.nodes[last], &(self.tip().position - self.work.nodes[last].position))
    }

    /// Pose at a point of an element, and its displacement and rotation for each input.
    fn place(&mut self, k: usize, row: &Row, motion: &Motion) -> (Pose, DMatrix<f64>) {
        let element = &self.chain.elements[k];
        let amplitudes = self.chain.part(k, &self.branch.unknowns);
        let frame = self.work.configurations[k].frame_at(element, row, amplitudes);
        let tangent = &mut self.work.derivatives[k];
        let size = tangent.size;
        let columns =
            DMatrixView::from_slice(tangent.motion(element, row, &frame.pose.position, &frame.left), size, 6);
        let node = self.work.nodes[k];
        (node.compose(&frame.pose), turned(&node.rotation, &columns.tr_mul(&motion.elements[k])))
    }
}

/// Keeps the first columns and sets the others to zero.
fn only(rates: &DMatrix<f64>, is_kept: impl Fn(usize) -> bool) -> DMatrix<f64> {
    let mut out = rates.clone();
    for column in (0..rates.ncols()).filter(|column| !is_kept(*column)) {
        out.column_mut(column).fill(0.0);
    }
    out
}

/// Displacement and rotation of a point at `arm` from a body with these twists.
fn moved(twists: &DMatrix<f64>, arm: &Vector3<f64>) -> DMatrix<f64> {
    let mut out = twists.clone();
    let mut position = out.rows_mut(0, 3);
    position -= hat(arm) * twists.rows(3, 3);
    out
}

/// The axis about which a rotation of `to` increases its angle from `from`; zero where the angle is not differentiable.
fn bending(from: &Vector3<f64>, to: &Vector3<f64>) -> Vector3<f64> {
    from.cross(to).try_normalize(CORNER).unwrap_or_default()
}
