//! The bending stop: adjacent windings touch when a core is bent by its boundary angle.

use nalgebra::{Matrix3, Vector3};

use super::load::Load;
use super::piece::Piece;
use crate::design::SpanKind;
use crate::geometry::hat;
use crate::numerics::onset::onset;

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
pub struct BendingStop {
    /// Boundary angle, rad.
    angle: f64,
    /// Stiffness that the closed windings add, N m/rad.
    stiffness: f64,
}

/// Energy of a bending stop as loads on the frames at both ends of the core.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct StopLoads {
    /// Loads on the near and the far end, couples alone; the energy is that of the second, infinite where the core is
    /// bent by half a turn or more.
    pub loads: [Load; 2],
    /// Mixed second derivative with respect to the rotations of the near and the far end, N m.
    pub mixed: Matrix3<f64>,
    /// Stiffness that the closed windings add, N m/rad: it appears within a few degrees.
    pub stiffness: f64,
}

impl BendingStop {
    /// The bending stop of an element's core; `None` if it has no windings.
    pub(super) fn new(pieces: &[Piece<'_>]) -> Option<Self> {
        let core = pieces.iter().find(|piece| piece.span.kind == SpanKind::Core)?;
        let spiral = core.span.spiral?;
        let added = spiral.closed_bending - core.span.stiffness.bending;
        Some(Self { angle: spiral.boundary_angle, stiffness: added / core.length })
    }

    /// Energy (J) at the bending angle `angle` (rad), with its first two derivatives; `None` where the windings are open.
    #[must_use]
    pub fn energy(&self, angle: f64) -> Option<[f64; 3]> {
        let derivatives = onset(angle - self.angle, TRANSITION * self.angle)?;
        Some(derivatives.map(|value| self.stiffness * value))
    }

    /// Fraction of the closed section's stiffness that is reached at the bending angle `angle` (rad), from 0 (open) to 1.
    #[must_use]
    pub fn closed(&self, angle: f64) -> f64 {
        onset(angle - self.angle, TRANSITION * self.angle).map_or(0.0, |[_, _, second]| second)
    }

    /// Loads on the ends of a core with these unit tangents `d3`; `None` where the windings are open.
    #[must_use]
    pub fn loads(&self, tangents: &[Vector3<f64>; 2]) -> Option<StopLoads> {
        let theta = bending_angle(tangents);
        let [energy, first, second] = self.energy(theta)?;
        let mut out = StopLoads { loads: [Load::zero(); 2], mixed: Matrix3::zeros(), stiffness: second };
        if theta > HALF_TURN * core::f64::consts::PI {
            out.loads[1].energy = f64::INFINITY;
            return Some(out);
        }
        // The angle as a function of its cosine c: d theta / d c = -1 / sine, d2 theta / d c2 = -cosine / sine^3.
        let (sine, cosine) = theta.sin_cos();
        let by_cosine = -first / sine;
        let by_cosine_twice = second / (sine * sine) - first * cosine / sine.powi(3);
        let [near, far] = tangents;
        let across = near.cross(far);
        let own = across * across.transpose() * by_cosine_twice;
        for (load, (tangent, other)) in out.loads.iter_mut().zip([(near, far), (far, near)]) {
            load.couple = other * tangent.transpose() * by_cosine;
            load.rotation_rotation = own;
            load.stiff = true;
        }
        out.loads[1].energy = energy;
        out.mixed = hat(near).tr_mul(&hat(far)) * by_cosine - own;
        Some(out)
    }
}

/// Angle between two unit tangents, rad.
fn bending_angle([near, far]: &[Vector3<f64>; 2]) -> f64 {
    near.cross(far).norm().atan2(near.dot(far))
}
