//! How the external field changes with the inputs that make it.

use nalgebra::{Matrix3, Vector3};

use super::inputs::Inputs;
use crate::geometry::hat;
use crate::magnetics::{Assembly, Jet, LinearField};

/// Inputs that make the field: the magnet's displacement (3), rotation (3) and strength, the uniform field (3)
/// and the linear one (5), in the order of the Jacobian's columns.
pub(super) const FIELD_INPUTS: usize = 15;

/// Derivative of the field (T) and of its gradient (T/m) by one input.
pub(super) type FieldRate = (Vector3<f64>, Matrix3<f64>);

/// The derivatives at a point of the world, in its axes; `None` inside the magnet and on its edges.
///
/// A field that moves as a body with velocity `v(x) = t + w x (x - c)` changes at a fixed point by
/// `w x B - G v`, and its gradient by `hat(w) G - G hat(w) - H v`.
pub(super) fn field_rates(
    magnet: Option<&Assembly>,
    inputs: &Inputs,
    point: &Vector3<f64>,
) -> Option<[FieldRate; FIELD_INPUTS]> {
    let turn = &inputs.magnet.rotation;
    let arm = point - inputs.magnet.position;
    let own = match magnet {
        None => Jet::zero(),
        Some(magnet) => {
            let local = turn.tr_mul(&arm);
            if magnet.contains(&local) {
                return None;
            }
            magnet.jet(&local).ok()?.rotated(turn)
        }
    };
    let jet = own * inputs.magnet_strength;
    Some(core::array::from_fn(|column| {
        let unit = Vector3::ith(column % 3, 1.0);
        match column {
            0..3 => (-jet.gradient * unit, -jet.hessian_along(&unit)),
            3..6 => {
                let (spin, velocity) = (hat(&unit), unit.cross(&arm));
                let gradient = spin * jet.gradient - jet.gradient * spin - jet.hessian_along(&velocity);
                (spin * jet.field - jet.gradient * velocity, gradient)
            }
            6 => (own.field, own.gradient),
            7..10 => (Vector3::ith(column - 7, 1.0), Matrix3::zeros()),
            _ => {
                let entry = core::array::from_fn(|i| f64::from(u8::from(i == column - 10)));
                let gradient = LinearField::new(Vector3::zeros(), entry).gradient();
                (gradient * point, gradient)
            }
        }
    }))
}
