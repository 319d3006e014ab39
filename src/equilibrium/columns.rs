//! What a unit of each input adds to the gradient and to the clamp: mixed derivatives of the potential.

use nalgebra::{DMatrix, DMatrixView, Matrix3, Vector3};

use super::dead::weight;
use super::field_rates::{FieldRate, field_rates};
use super::inputs::Inputs;
use super::jacobian::{Counts, Input};
use super::potential::Potential;
use crate::geometry::hat;
use crate::magnetics::{Assembly, LinearField};
use crate::rod::START;

/// Mixed derivatives at a fixed base, one column an input; the base's own columns are zero.
#[derive(Debug, Clone)]
pub(super) struct Columns {
    /// By the unknowns.
    pub(super) gradient: DMatrix<f64>,
    /// By a rigid displacement (m) and rotation (rad, about the base) of the whole chain.
    pub(super) clamp: DMatrix<f64>,
}

/// Derivatives of a load's energy by the position and rotation of its frame (world axes), one column an input.
struct Wrenches(DMatrix<f64>);

impl Wrenches {
    fn none(counts: &Counts) -> Self {
        Self(DMatrix::zeros(6, counts.inputs()))
    }

    fn add(&mut self, column: usize, force: &Vector3<f64>, moment: &Vector3<f64>) {
        for axis in 0..3 {
            self.0[(axis, column)] += force[axis];
            self.0[(3 + axis, column)] += moment[axis];
        }
    }

    /// Adds a dipole (A m2) at `arm` from the frame's origin.
    fn add_dipole(&mut self, moment: &Vector3<f64>, arm: &Vector3<f64>, rates: &[FieldRate]) {
        for (column, (field, gradient)) in rates.iter().enumerate() {
            let force = -gradient * moment;
            self.add(column, &force, &(arm.cross(&force) - moment.cross(field)));
        }
    }

    /// Adds `size` times a unit dead force along each axis, at `arm` from the frame's origin.
    fn add_dead(&mut self, input: Input, size: f64, arm: &Vector3<f64>) {
        for (axis, column) in input.columns().enumerate() {
            let force = Vector3::ith(axis, -size);
            self.add(column, &force, &arm.cross(&force));
        }
    }
}

/// The vectors of a 6-row matrix turned by `rotation`.
pub(super) fn turned(rotation: &Matrix3<f64>, twists: &DMatrix<f64>) -> DMatrix<f64> {
    let mut out = DMatrix::zeros(6, twists.ncols());
    for part in [0, 3] {
        out.rows_mut(part, 3).copy_from(&(rotation * twists.rows(part, 3)));
    }
    out
}

impl Potential<'_> {
    /// The columns at the shape that was linearised last; `None` where a body lies inside or on an edge of
    /// the magnet, be it switched off.
    pub(super) fn columns(&mut self, magnet: Option<&Assembly>, counts: &Counts) -> Option<Columns> {
        let mut gradient = DMatrix::zeros(self.chain.freedoms(), counts.inputs());
        let last = self.chain.elements.len();
        let mut clamp = self.on_node(last, magnet, counts)?;
        for k in (0..last).rev() {
            let axes = self.work.nodes[k].rotation;
            let into = axes.transpose();
            let mut block = self.end_motion(k) * turned(&into, &clamp);
            for station in 0..self.chain.elements[k].stations.len() {
                let load = turned(&into, &self.on_station(k, station, magnet, counts)?);
                let element = &self.chain.elements[k];
                let state = &self.work.configurations[k].stations[station];
                let tangent = &mut self.work.tangents[k];
                let size = tangent.size;
                let motion =
                    DMatrixView::from_slice(tangent.station_motion(element, station, state), size, 6);
                block.gemm(1.0, &motion, &load, 1.0);
            }
            gradient
                .rows_mut(self.chain.first[k], block.nrows() - START)
                .copy_from(&block.rows(START, block.nrows() - START));
            clamp = turned(&axes, &block.rows(0, START).into_owned()) + self.on_node(k, magnet, counts)?;
        }
        Some(Columns { gradient, clamp })
    }

    /// Displacement and rotation of an element's end by the columns of its [`crate::rod::Tangent`], transposed.
    pub(super) fn end_motion(&mut self, k: usize) -> DMatrix<f64> {
        let element = &self.chain.elements[k];
        let configuration = &self.work.configurations[k];
        let (left, row) = (configuration.end_theta.left_jacobian(), element.row(element.length));
        let tangent = &mut self.work.tangents[k];
        let size = tangent.size;
        DMatrix::from_column_slice(size, 6, tangent.motion(element, &row, &configuration.end.position, &left))
    }

    /// Loads on a station, in world axes about its own position.
    fn on_station(
        &self,
        k: usize,
        index: usize,
        magnet: Option<&Assembly>,
        counts: &Counts,
    ) -> Option<DMatrix<f64>> {
        let station = &self.chain.elements[k].stations[index];
        let pose = self.work.station(k, index);
        let mut out = Wrenches::none(counts);
        let matter = &station.matter;
        if matter.magnetisation != 0.0 {
            let points = self.field.points(station);
            let moment = pose.axis() * (matter.magnetisation * matter.moments.volume / points.len() as f64);
            for point in points {
                let arm = pose.rotation * Vector3::new(point.x, point.y, 0.0);
                out.add_dipole(&moment, &arm, &field_rates(magnet, self.inputs, &(pose.position + arm))?);
            }
        }
        for (axis, column) in Input::Gravity.columns().enumerate() {
            let load = weight(&station.matter, &pose, &Vector3::ith(axis, 1.0));
            out.add(column, &load.force, &load.moment());
        }
        Some(out.0)
    }

    /// Loads on a node: its ring's, and the tip's.
    fn on_node(&self, node: usize, magnet: Option<&Assembly>, counts: &Counts) -> Option<DMatrix<f64>> {
        let pose = self.work.nodes[node];
        let axis = pose.axis();
        let mut out = Wrenches::none(counts);
        for (index, body) in self.chain.rings.iter().enumerate().filter(|(_, body)| body.node == node) {
            let half = body.half_length();
            let centre = axis * half;
            let local =
                self.inputs.magnet.rotation.tr_mul(&(pose.position + centre - self.inputs.magnet.position));
            let reach = magnet.map_or(f64::INFINITY, |magnet| magnet.distance(&local));
            for (height, volume) in self.rules.external(index, reach).points() {
                let arm = axis * (half + height);
                let rates = field_rates(magnet, self.inputs, &(pose.position + arm))?;
                out.add_dipole(&(axis * (body.magnetisation * volume)), &arm, &rates);
            }
            out.add_dead(Input::Gravity, body.ring.mass, &centre);
            out.add_dead(Input::RingForce(index), 1.0, &centre);
        }
        if node == self.chain.elements.len() {
            out.add_dead(Input::TipForce, 1.0, &(axis * self.chain.tip_offset));
            for (axis, column) in Input::TipMoment.columns().enumerate() {
                out.add(column, &Vector3::zeros(), &Vector3::ith(axis, -1.0));
            }
        }
        Some(out.0)
    }
}

/// How the inputs change when all that is fixed in the world moves along each axis (m) and turns about it at the
/// base position (rad): six columns, a row for each input.
pub(super) fn carried(inputs: &Inputs, counts: &Counts) -> DMatrix<f64> {
    let base = inputs.base.position;
    let linear = LinearField::new(inputs.uniform_field, inputs.field_gradient);
    let gradient = linear.gradient();
    let mut out = DMatrix::zeros(counts.inputs(), 6);
    for column in 0..6 {
        let unit = Vector3::ith(column % 3, 1.0);
        let (shift, spin) = if column < 3 { (unit, Vector3::zeros()) } else { (Vector3::zeros(), unit) };
        let mut set = |input: Input, rate: &[f64]| {
            out.view_mut((input.columns().start, column), (rate.len(), 1)).copy_from_slice(rate);
        };
        let velocity = |point: &Vector3<f64>| shift + spin.cross(&(point - base));
        set(Input::MagnetPosition, velocity(&inputs.magnet.position).as_slice());
        set(Input::MagnetRotation, spin.as_slice());
        let field = spin.cross(&inputs.uniform_field) - gradient * velocity(&Vector3::zeros());
        set(Input::UniformField, field.as_slice());
        let turn = hat(&spin) * gradient - gradient * hat(&spin);
        set(Input::FieldGradient, &[turn.m11, turn.m12, turn.m13, turn.m22, turn.m23]);
        set(Input::TipForce, spin.cross(&inputs.tip_force).as_slice());
        set(Input::TipMoment, spin.cross(&inputs.tip_moment).as_slice());
        set(Input::Gravity, spin.cross(&inputs.gravity).as_slice());
        for (ring, force) in inputs.ring_forces.iter().enumerate() {
            set(Input::RingForce(ring), spin.cross(force).as_slice());
        }
    }
    out
}
