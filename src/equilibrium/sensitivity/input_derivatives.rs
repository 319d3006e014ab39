//! Mixed derivatives of the potential: the contribution of each input to the gradient and to the clamp's wrench.

use nalgebra::{DMatrix, DMatrixView, Matrix3, Matrix6, Vector3};

use crate::equilibrium::model::{Counts, Frame, Input, Inputs, NearStation, Potential};
use crate::geometry::hat;
use crate::magnetics::LinearField;
use crate::rod::{Load, START};

/// Mixed derivatives at a fixed base, one column for each input; the base's own columns are zero.
#[derive(Debug, Clone)]
pub(crate) struct InputDerivatives {
    /// With respect to the unknowns.
    pub(crate) gradient: DMatrix<f64>,
    /// With respect to a rigid displacement (m) and rotation (rad, about the base) of the whole chain.
    pub(crate) clamp: DMatrix<f64>,
}

/// Rotates the vectors of a 6-row matrix by `rotation`.
pub(crate) fn turned(rotation: &Matrix3<f64>, twists: &DMatrix<f64>) -> DMatrix<f64> {
    let mut out = DMatrix::zeros(6, twists.ncols());
    for part in [0, 3] {
        out.rows_mut(part, 3).copy_from(&(rotation * twists.rows(part, 3)));
    }
    out
}

impl Potential<'_> {
    /// The mixed derivatives at the shape linearised last; `None` where a body lies inside or on an edge of a magnet,
    /// even if that is switched off.
    pub(crate) fn columns(&mut self, counts: &Counts) -> Option<InputDerivatives> {
        let mut gradient = DMatrix::zeros(self.chain.freedoms(), counts.inputs());
        let last = self.chain.elements.len();
        let mut clamp = self.on_node(last, counts)?;
        for k in (0..last).rev() {
            let axes = self.work.nodes[k].rotation;
            let mut block = self.end_motion(k) * turned(&axes.transpose(), &clamp);
            self.add_stations(k, &mut block, counts)?;
            self.add_placed(k, &mut block);

            gradient
                .rows_mut(self.chain.first[k], block.nrows() - START)
                .copy_from(&block.rows(START, block.nrows() - START));
            clamp = turned(&axes, &block.rows(0, START).into_owned()) + self.on_node(k, counts)?;
        }
        Some(InputDerivatives { gradient, clamp })
    }

    /// Adds the mixed derivatives of an element's stations to its block.
    fn add_stations(&mut self, k: usize, block: &mut DMatrix<f64>, counts: &Counts) -> Option<()> {
        let (element, into) = (&self.chain.elements[k], self.work.nodes[k].rotation.transpose());
        for (index, station) in element.stations.iter().enumerate() {
            let (frame, pose) = (Frame::Station(station, NearStation::NONE), self.work.station(k, index));
            let growth = self.work.configurations[k].growth;
            let load = turned(&into, &self.terms.input_derivatives(&frame, &pose, counts)?.matrix) * growth;

            let state = &self.work.configurations[k].stations[index];
            let tangent = &mut self.work.derivatives[k];
            let size = tangent.size;
            let motion = DMatrixView::from_slice(tangent.station_motion(element, index, state), size, 6);
            block.gemm(1.0, &motion, &load, 1.0);
        }
        Some(())
    }

    /// Adds the mixed derivatives of what surrounds an element, by the motion of that, to its block.
    fn add_placed(&mut self, k: usize, block: &mut DMatrix<f64>) {
        let (element, into) = (&self.chain.elements[k], self.work.nodes[k].rotation.transpose());
        for placed in &self.work.placed_loads[k].loads[self.work.placed_loads[k].own..] {
            let frame = &placed.frame;
            let arm = frame.pose.position + into * (self.work.nodes[k].position - self.inputs.base.position);
            let load = vessel_rates(&placed.load, &arm, &into);

            let tangent = &mut self.work.derivatives[k];
            let size = tangent.size;
            let motion = tangent.motion(element, &placed.row, &frame.pose.position, &frame.left);
            let motion = DMatrixView::from_slice(motion, size, 6);
            let mut columns = block.columns_range_mut(Input::of_vessel());
            columns.gemm(1.0, &motion, &load, 1.0);
        }
    }

    /// Displacement and rotation of an element's end with respect to the variables of its
    /// [`crate::rod::ElementDerivatives`], transposed.
    pub(crate) fn end_motion(&mut self, k: usize) -> DMatrix<f64> {
        let element = &self.chain.elements[k];
        let configuration = &self.work.configurations[k];
        let (left, row) = (configuration.end_theta.left_jacobian(), element.row(element.length));
        let tangent = &mut self.work.derivatives[k];
        let size = tangent.size;
        DMatrix::from_column_slice(size, 6, tangent.motion(element, &row, &configuration.end.position, &left))
    }

    /// Mixed derivatives of the loads on everything that a node carries.
    fn on_node(&self, node: usize, counts: &Counts) -> Option<DMatrix<f64>> {
        let pose = self.work.nodes[node];
        let mut out = DMatrix::zeros(6, counts.inputs());
        for (_, frame) in Frame::at_nodes(self.chain).filter(|(own, _)| *own == node) {
            out += self.terms.input_derivatives(&frame, &pose, counts)?.matrix;
        }
        for (_, load) in self.work.on_nodes_around.iter().filter(|(own, _)| *own == node) {
            let mut columns = out.columns_range_mut(Input::of_vessel());
            columns += vessel_rates(load, &(pose.position - self.inputs.base.position), &Matrix3::identity());
        }
        Some(out)
    }
}

/// Derivatives of a wall's load with respect to a displacement (m) of the vessel and its rotation (rad) about the base
/// position: six columns, with three rows of force and three of moment, in the axes of the load, to which `into` turns from those
/// of the world. `arm` (m) leads from the base position to the frame.
///
/// Moved with the vessel, the frame would keep its load, which would turn with both; less what the frame's own motion changes.
fn vessel_rates(load: &Load, arm: &Vector3<f64>, into: &Matrix3<f64>) -> Matrix6<f64> {
    let (force, moment, turning) = (load.force, load.moment(), load.rotation_hessian());
    let mut out = Matrix6::zeros();
    for column in 0..6 {
        let unit = into.column(column % 3).into_owned();
        let (shift, spin) = if column < 3 { (unit, Vector3::zeros()) } else { (unit.cross(arm), unit) };
        let by_force = spin.cross(&force) - load.position_position * shift - load.position_rotation * spin;
        let by_moment = spin.cross(&moment) * 0.5 - load.position_rotation.tr_mul(&shift) - turning * spin;
        for axis in 0..3 {
            (out[(axis, column)], out[(3 + axis, column)]) = (by_force[axis], by_moment[axis]);
        }
    }
    out
}

/// Rates of the inputs when everything fixed in the world moves along each axis (m) and rotates about it at the base
/// position (rad): six columns, a row for each input.
pub(crate) fn base_transport(inputs: &Inputs, counts: &Counts) -> DMatrix<f64> {
    let mut out = DMatrix::zeros(counts.inputs(), 6);
    for column in 0..6 {
        let unit = Vector3::ith(column % 3, 1.0);
        let moved = if column < 3 { [unit, Vector3::zeros()] } else { [Vector3::zeros(), unit] };
        moved_rates(inputs, moved, |input, rate| {
            let Some(rows) = counts.columns(input) else { return };
            out.view_mut((rows.start, column), (rate.len(), 1)).copy_from_slice(rate);
        });
    }
    out
}

/// Sets the rates of all inputs that change when everything moves with this velocity and angular velocity about the base.
fn moved_rates(inputs: &Inputs, [shift, spin]: [Vector3<f64>; 2], mut set: impl FnMut(Input, &[f64])) {
    // Every input is named, so that a new one is not forgotten.
    let Inputs {
        sources,
        uniform_field,
        field_gradient,
        base,
        insertion: _, // these do not change
        feed_force: _,
        roll: _,
        guidewire_insertion: _,
        tip_force,
        tip_moment,
        ring_forces,
        gravity,
        widening: _,
        softening: _,
    } = inputs;

    let base = base.position;
    let field_gradient = LinearField::new(*uniform_field, *field_gradient).gradient();
    let velocity = |point: &Vector3<f64>| shift + spin.cross(&(point - base));
    set(Input::VesselPosition, shift.as_slice());
    set(Input::VesselRotation, spin.as_slice());
    for (number, source) in sources.iter().enumerate() {
        set(Input::SourcePosition(number), velocity(&source.pose.position).as_slice());
        set(Input::SourceRotation(number), spin.as_slice());
    }

    // The background field is that at the origin: it changes with what moves there.
    let field = spin.cross(uniform_field) - field_gradient * velocity(&Vector3::zeros());
    set(Input::UniformField, field.as_slice());
    let turn = hat(&spin) * field_gradient - field_gradient * hat(&spin);
    set(Input::FieldGradient, &[turn.m11, turn.m12, turn.m13, turn.m22, turn.m23]);

    set(Input::TipForce, spin.cross(tip_force).as_slice());
    set(Input::TipMoment, spin.cross(tip_moment).as_slice());
    set(Input::Gravity, spin.cross(gravity).as_slice());
    for (ring, force) in ring_forces.iter().enumerate() {
        set(Input::RingForce(ring), spin.cross(force).as_slice());
    }
}
