//! Mixed derivatives of the potential: the contribution of each input to the gradient and to the clamp's wrench.

use nalgebra::{DMatrix, DMatrixView, Matrix3, Vector3};

use super::inputs::Inputs;
use super::layout::{Counts, Input};
use super::potential::Potential;
use super::terms::Frame;
use crate::geometry::hat;
use crate::magnetics::LinearField;
use crate::rod::START;

/// Mixed derivatives at a fixed base, one column for each input; the base's own columns are zero.
#[derive(Debug, Clone)]
pub(super) struct InputDerivatives {
    /// With respect to the unknowns.
    pub(super) gradient: DMatrix<f64>,
    /// With respect to a rigid displacement (m) and rotation (rad, about the base) of the whole chain.
    pub(super) clamp: DMatrix<f64>,
}

/// Rotates the vectors of a 6-row matrix by `rotation`.
pub(super) fn turned(rotation: &Matrix3<f64>, twists: &DMatrix<f64>) -> DMatrix<f64> {
    let mut out = DMatrix::zeros(6, twists.ncols());
    for part in [0, 3] {
        out.rows_mut(part, 3).copy_from(&(rotation * twists.rows(part, 3)));
    }
    out
}

impl Potential<'_> {
    /// The mixed derivatives at the shape linearised last; `None` where a body lies inside or on an edge of the magnet,
    /// even if that is switched off.
    pub(super) fn columns(&mut self, counts: &Counts) -> Option<InputDerivatives> {
        let mut gradient = DMatrix::zeros(self.chain.freedoms(), counts.inputs());
        let last = self.chain.elements.len();
        let mut clamp = self.on_node(last, counts)?;
        for k in (0..last).rev() {
            let axes = self.work.nodes[k].rotation;
            let into = axes.transpose();
            let mut block = self.end_motion(k) * turned(&into, &clamp);
            let element = &self.chain.elements[k];
            for (index, station) in element.stations.iter().enumerate() {
                let (frame, pose) = (Frame::Station(station, &[]), self.work.station(k, index));
                let load = turned(&into, &self.terms.input_derivatives(&frame, &pose, counts.inputs())?.0);
                let state = &self.work.configurations[k].stations[index];
                let tangent = &mut self.work.derivatives[k];
                let size = tangent.size;
                let motion = DMatrixView::from_slice(tangent.station_motion(element, index, state), size, 6);
                block.gemm(1.0, &motion, &load, 1.0);
            }
            gradient
                .rows_mut(self.chain.first[k], block.nrows() - START)
                .copy_from(&block.rows(START, block.nrows() - START));
            clamp = turned(&axes, &block.rows(0, START).into_owned()) + self.on_node(k, counts)?;
        }
        Some(InputDerivatives { gradient, clamp })
    }

    /// Displacement and rotation of an element's end with respect to the variables of its
    /// [`crate::rod::ElementDerivatives`], transposed.
    pub(super) fn end_motion(&mut self, k: usize) -> DMatrix<f64> {
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
            out += self.terms.input_derivatives(&frame, &pose, counts.inputs())?.0;
        }
        Some(out)
    }
}

/// Rates of the inputs when everything fixed in the world moves along each axis (m) and rotates about it at the base
/// position (rad): six columns, a row for each input.
pub(super) fn base_transport(inputs: &Inputs, counts: &Counts) -> DMatrix<f64> {
    let Inputs {
        magnet,
        magnet_strength: _, // does not change
        uniform_field,
        field_gradient,
        base,
        tip_force,
        tip_moment,
        ring_forces,
        gravity,
        widening: _, // these do not change
        softening: _,
    } = inputs;
    let base = base.position;
    let field_gradient = LinearField::new(*uniform_field, *field_gradient).gradient();
    let mut out = DMatrix::zeros(counts.inputs(), 6);
    for column in 0..6 {
        let unit = Vector3::ith(column % 3, 1.0);
        let (shift, spin) = if column < 3 { (unit, Vector3::zeros()) } else { (Vector3::zeros(), unit) };
        let mut set = |input: Input, rate: &[f64]| {
            out.view_mut((input.columns().start, column), (rate.len(), 1)).copy_from_slice(rate);
        };
        let velocity = |point: &Vector3<f64>| shift + spin.cross(&(point - base));
        set(Input::MagnetPosition, velocity(&magnet.position).as_slice());
        set(Input::MagnetRotation, spin.as_slice());
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
    out
}
