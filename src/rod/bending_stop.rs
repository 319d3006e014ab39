//! The bending stop: adjacent windings touch when a core is bent by its boundary angle.

use nalgebra::{Matrix3, Matrix6, Vector3, Vector6};

use super::piece::Piece;
use super::row::{ROTATIONS, Row};
use crate::design::SpanKind;
use crate::geometry::{RotationVector, hat};

/// Half the width of the transition from open to closed windings, relative to the boundary angle: the real windings
/// of a core do not all touch at once.
const TRANSITION: f64 = 0.05;

/// Fraction of a half turn beyond which a bent core is rejected: its bending plane is no longer defined.
const HALF_TURN: f64 = 0.999;

/// Contact energy that the closed windings of a core add to its elastic energy.
///
/// With the angle `theta` between the tangents `d3` at both ends of the core, the boundary angle `Theta` and the
/// bending stiffnesses `EI` of core and closed section (annulus from `r_ic` to `R`),
///
/// ```text
/// E = (EI_closed - EI_core) / L_core P(theta - Theta)
/// P'' = 0 before, 1 after, 6 t^5 - 15 t^4 + 10 t^3 with t = (theta - Theta + w) / 2 w in between
/// ```
///
/// and `w` a twentieth of `Theta`: beyond the transition the core as a whole is as stiff as the closed section. The energy has
/// four continuous derivatives and is exactly zero below `Theta - w`.
///
/// Boundary angle: Richter et al., Fig. 2B, D; their model has no bending stop.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Stop {
    /// Boundary angle, rad.
    angle: f64,
    /// Stiffness that the closed windings add, N m/rad.
    stiffness: f64,
}

/// Energy of a bending stop and its derivatives with respect to the rotation vectors at both ends of the core.
pub(super) struct Contact {
    /// Energy, J.
    pub(super) energy: f64,
    /// First derivatives with respect to both vectors, J/rad.
    pub(super) slope: Vector6<f64>,
    /// Second derivatives, J/rad2.
    pub(super) curve: Matrix6<f64>,
}

impl Stop {
    /// The bending stop of an element's core; `None` if it has no windings.
    pub(super) fn new(pieces: &[Piece<'_>]) -> Option<Self> {
        let core = pieces.iter().find(|piece| piece.span.kind == SpanKind::Core)?;
        let spiral = core.span.spiral?;
        let added = spiral.closed_bending - core.span.stiffness.bending;
        Some(Self { angle: spiral.boundary_angle, stiffness: added / core.length })
    }

    /// Contact of the windings of a core with these end rows; `None` where they are open.
    pub(super) fn contact(
        &self,
        ends: &[Row; 2],
        amplitudes: &[f64],
        component: &[usize],
    ) -> Option<Contact> {
        let vectors = ends.each_ref().map(|row| rotation_vector(row, amplitudes, component));
        let matrices = vectors.each_ref().map(RotationVector::matrix);
        let tangents = matrices.each_ref().map(|matrix| matrix.column(2).into_owned());
        let cosine = tangents[0].dot(&tangents[1]);
        let sine = tangents[0].cross(&tangents[1]).norm();
        let theta = sine.atan2(cosine);
        let [potential, first, second] = transition(theta - self.angle, TRANSITION * self.angle)?;
        if theta > HALF_TURN * core::f64::consts::PI {
            return Some(Contact { energy: f64::INFINITY, slope: Vector6::zeros(), curve: Matrix6::zeros() });
        }
        // The angle as a function of its cosine c: d theta / d c = -1 / sine, d2 theta / d c2 = -cosine / sine^3.
        let by_cosine = -first / sine;
        let by_cosine_twice = second / (sine * sine) - first * cosine / sine.powi(3);
        let end = Vector3::z().transpose();
        let (slope_near, curve_near) = vectors[0].contract_rotation(&(tangents[1] * end));
        let (slope_far, curve_far) = vectors[1].contract_rotation(&(tangents[0] * end));
        let turned = |i: usize| -> Matrix3<f64> { hat(&tangents[i]) * vectors[i].left_jacobian() };
        let mixed = turned(0).tr_mul(&turned(1));
        let mut slope = Vector6::zeros();
        slope.fixed_rows_mut::<3>(0).copy_from(&slope_near);
        slope.fixed_rows_mut::<3>(3).copy_from(&slope_far);
        let mut curve = slope * slope.transpose() * by_cosine_twice;
        for (row, column, block) in
            [(0, 0, curve_near), (0, 3, mixed), (3, 0, mixed.transpose()), (3, 3, curve_far)]
        {
            let mut target = curve.fixed_view_mut::<3, 3>(row, column);
            target += block * by_cosine;
        }
        Some(Contact {
            energy: self.stiffness * potential,
            slope: slope * (self.stiffness * by_cosine),
            curve: curve * self.stiffness,
        })
    }
}

fn rotation_vector(row: &Row, amplitudes: &[f64], component: &[usize]) -> RotationVector {
    let mut vector = Vector3::zeros();
    for ((c, integral), amplitude) in component.iter().zip(&row.integral).zip(amplitudes) {
        if *c < ROTATIONS {
            vector[*c] += integral * amplitude;
        }
    }
    RotationVector::new(vector)
}

/// `P` and its first two derivatives at `x`, with a transition from `-width` to `width`; `None` before it.
fn transition(x: f64, width: f64) -> Option<[f64; 3]> {
    let t = 0.5 * (x / width + 1.0);
    if t <= 0.0 {
        return None;
    }
    if t >= 1.0 {
        return Some([0.5 * x * x + width * width / 14.0, x, 1.0]);
    }
    let (full, cube) = (2.0 * width, t * t * t);
    Some([
        full * full * cube * t * t * (t * t / 7.0 - 0.5 * t + 0.5),
        full * cube * t * (t * t - 3.0 * t + 2.5),
        cube * (6.0 * t * t - 15.0 * t + 10.0),
    ])
}
