//! Rows of the Jacobian: one ordered table of outputs, and the derivatives of every output with respect to shape and inputs.
//!
//! Wrenches are derivatives of the energy with respect to rigid motions of the field, of the magnet or of everything that
//! surrounds the chain. Second derivatives are symmetric, so that the derivatives of wrenches with respect to the shape
//! are columns of the inputs.

use core::ops::Range;

use nalgebra::{DMatrix, DMatrixView, Dim, Dyn, Matrix, Matrix3, RawStorage, Vector3};

use super::input_derivatives::turned;
use super::response::{Motion, Response, inside, transport_base};
use crate::equilibrium::model::{Counts, Input, Inputs, VECTOR};
use crate::equilibrium::search::{Equilibrium, Solution};
use crate::error::Error;
use crate::geometry::{Pose, hat};
use crate::magnetics::Wrench;
use crate::rod::Row;

/// Sine of an angle below which it counts as not differentiable.
const CORNER: f64 = 1e-9;

/// A continuous output: a group of rows of a [`super::Jacobian`]. Points and bodies are counted from 0.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Output {
    /// Angle between the axes of tip and base, rad; its derivative is set to 0 at 0 and pi, where it is not
    /// differentiable.
    TipAngle,
    /// Position of the tip, m.
    TipPosition,
    /// Rotation of the tip, rad, world axes; see [`crate::geometry::Pose::quaternion_rate`].
    TipRotation,
    /// External magnetic force, N.
    MagneticForce,
    /// External magnetic torque about the base position, N m.
    MagneticTorque,
    /// Force that the clamp exerts, N.
    BaseReactionForce,
    /// Moment that the clamp exerts about the base position, N m.
    BaseReactionMoment,
    /// Force on a magnet or coil, N.
    SourceReactionForce(usize),
    /// Torque on a magnet or coil about its centre, N m.
    SourceReactionTorque(usize),
    /// External field at the tip, T.
    TipField,
    /// Length of shaft inside the port, m.
    FeedLength,
    /// Push that holds the shaft, N.
    FeedReaction,
    /// Point of the centreline, m.
    ShapePoint(usize),
    /// Centre of a ring, m.
    RingPosition(usize),
    /// Rotation of a ring, rad, world axes.
    RingRotation(usize),
    /// Axis `d3` of a ring, 1.
    RingAxis(usize),
    /// Bending angle of a core, rad; its derivative is set to 0 where the core is straight and the angle is not
    /// differentiable.
    CoreAngle(usize),
    /// Director `d3` at a point of the centreline, 1.
    ShapeTangent(usize),
    /// Curvature about `d1` and `d2`, and twist about `d3`, at a point of the centreline, material frame, 1/m.
    ShapeCurvature(usize),
}

/// Outputs of every design in the order of their rows; the [`BLOCKS`] follow.
const OUTPUTS: [Output; 10] = [
    Output::TipAngle,
    Output::TipPosition,
    Output::TipRotation,
    Output::MagneticForce,
    Output::MagneticTorque,
    Output::BaseReactionForce,
    Output::BaseReactionMoment,
    Output::TipField,
    Output::FeedLength,
    Output::FeedReaction,
];

/// An output of the point or body with this number.
type OfBody = fn(usize) -> Output;

/// Outputs of points and bodies in the order of their rows. Of each block, all rows of the first point or body come first.
const BLOCKS: [&[OfBody]; 5] = [
    &[Output::ShapePoint],
    &[Output::RingPosition, Output::RingRotation, Output::RingAxis],
    &[Output::CoreAngle],
    &[Output::SourceReactionForce, Output::SourceReactionTorque],
    &[Output::ShapeTangent, Output::ShapeCurvature],
];

/// What an output is one of, with its number.
#[derive(Debug, Clone, Copy)]
enum Owner {
    Device,
    Point(usize),
    Ring(usize),
    Core(usize),
    Source(usize),
}

impl Output {
    fn owner(self) -> Owner {
        match self {
            Self::ShapePoint(point) | Self::ShapeTangent(point) | Self::ShapeCurvature(point) => {
                Owner::Point(point)
            }
            Self::RingPosition(ring) | Self::RingRotation(ring) | Self::RingAxis(ring) => Owner::Ring(ring),
            Self::CoreAngle(core) => Owner::Core(core),
            Self::SourceReactionForce(source) | Self::SourceReactionTorque(source) => Owner::Source(source),
            _ => Owner::Device,
        }
    }

    /// Number of rows of this output.
    fn width(self) -> usize {
        match self {
            Self::TipAngle | Self::CoreAngle(_) | Self::FeedLength | Self::FeedReaction => 1,
            _ => VECTOR,
        }
    }
}

impl Counts {
    /// Number of an owner, and how many of its kind there are.
    fn numbered(&self, owner: Owner) -> (usize, usize) {
        match owner {
            Owner::Device => (0, 1),
            Owner::Point(point) => (point, self.shape_points),
            Owner::Ring(ring) => (ring, self.rings),
            Owner::Core(core) => (core, self.cores),
            Owner::Source(source) => (source, self.sources),
        }
    }

    /// Number of rows.
    pub(crate) fn outputs(&self) -> usize {
        self.first(None)
    }

    /// The rows of an output; `None` for a point or body that the design does not have.
    pub(crate) fn rows(&self, output: Output) -> Option<Range<usize>> {
        let (number, count) = self.numbered(output.owner());
        let first = (number < count).then(|| self.first(Some(output)))?;
        Some(first..first + output.width())
    }

    /// The first row of an output; for `None`, the row after all.
    fn first(&self, output: Option<Output>) -> usize {
        let mut row = 0;
        for known in OUTPUTS {
            if Some(known) == output {
                return row;
            }
            row += known.width();
        }

        let number = output.map_or(0, |output| self.numbered(output.owner()).0);
        for block in BLOCKS {
            let width: usize = block.iter().map(|of| of(0).width()).sum();
            let mut within = number * width;
            for of in block {
                if Some(of(number)) == output {
                    return row + within;
                }
                within += of(0).width();
            }
            row += self.numbered(block[0](0).owner()).1 * width;
        }
        row
    }
}

/// Behaviour of a quantity under a rigid motion of the whole scene.
#[derive(Debug, Clone, Copy)]
pub(crate) enum Transport {
    Not,
    Vector(Vector3<f64>),
    Position(Vector3<f64>),
    Rotation,
}

/// The rows of all outputs.
pub(crate) struct OutputDerivatives<'a> {
    matrix: DMatrix<f64>,
    counts: Counts,
    pub(crate) inputs: &'a Inputs,
}

impl<'a> OutputDerivatives<'a> {
    pub(crate) fn new(inputs: &'a Inputs, counts: &Counts) -> Self {
        Self { matrix: DMatrix::zeros(counts.outputs(), counts.inputs()), counts: *counts, inputs }
    }

    pub(crate) fn into_matrix(self) -> DMatrix<f64> {
        self.matrix
    }

    /// Sets the rows of an output; in the base's columns, `rates` are given relative to the base.
    pub(crate) fn set<R: Dim, S: RawStorage<f64, R, Dyn>>(
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

    pub(crate) fn set_wrench(&mut self, [force, torque]: [Output; 2], rates: &DMatrix<f64>, wrench: &Wrench) {
        self.set(force, &rates.rows(0, 3), Transport::Vector(wrench.force));
        self.set(torque, &rates.rows(3, 3), Transport::Vector(wrench.torque));
    }
}

impl Equilibrium {
    /// Angle, position and rotation of the tip.
    pub(crate) fn add_tip(&self, rows: &mut OutputDerivatives<'_>, response: &Response) {
        let tip = self.tip();
        let rates = self.tip_rates(response);
        let open = bending(&rows.inputs.base.axis(), &tip.axis());
        rows.set(Output::TipAngle, &(open.transpose() * rates.rows(3, 3)), Transport::Not);
        rows.set(Output::TipPosition, &rates.rows(0, 3), Transport::Position(tip.position));
        rows.set(Output::TipRotation, &rates.rows(3, 3), Transport::Rotation);
    }

    /// Length of the shaft, and the push that holds it.
    pub(crate) fn add_feed(&self, rows: &mut OutputDerivatives<'_>, response: &Response) {
        if self.chain.shaft > 0 {
            let mut length = DMatrix::zeros(1, response.counts.inputs());
            length.columns_range_mut(Input::Insertion.columns()).fill(1.0);
            rows.set(Output::FeedLength, &length, Transport::Not);
            rows.set(Output::FeedReaction, &response.push, Transport::Not);
        }
    }

    /// The external field at the tip.
    pub(crate) fn add_tip_field(
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

    /// Position, rotation and axis of each ring.
    pub(crate) fn add_rings(&self, rows: &mut OutputDerivatives<'_>, response: &Response) {
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
    pub(crate) fn add_cores(&mut self, rows: &mut OutputDerivatives<'_>, response: &Response) {
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

    fn tip_rates(&self, response: &Response) -> DMatrix<f64> {
        let last = self.chain.elements.len();
        moved(&response.motion.nodes[last], &(self.tip().position - self.work.nodes[last].position))
    }

    /// Pose at a point of an element, and its displacement and rotation for each input.
    pub(crate) fn place(&mut self, k: usize, row: &Row, motion: &Motion) -> (Pose, DMatrix<f64>) {
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

/// Displacement and rotation of a point at `arm` from a body with these twists.
pub(crate) fn moved(twists: &DMatrix<f64>, arm: &Vector3<f64>) -> DMatrix<f64> {
    let mut out = twists.clone();
    let mut position = out.rows_mut(0, 3);
    position -= hat(arm) * twists.rows(3, 3);
    out
}

/// The axis about which a rotation of `to` increases its angle from `from`; zero where the angle is not differentiable.
fn bending(from: &Vector3<f64>, to: &Vector3<f64>) -> Vector3<f64> {
    from.cross(to).try_normalize(CORNER).unwrap_or_default()
}
