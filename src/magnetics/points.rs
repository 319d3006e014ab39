//! Exact field of a magnet's edges at eight points side by side.
//!
//! The formulas are those of single points, with points instead of edges in the lanes; the functions are compiled for
//! several processors, and the fastest that runs is chosen. No product is fused with a sum, so that all give the same
//! bits.

use multiversion::multiversion;

use super::edge::{GRADIENT, HESSIAN, Parts, Place};
use super::integrals::Integrals;
use super::lanes::Lanes;

/// Number of points side by side.
pub(super) const WIDTH: usize = 8;

/// Numbers of so many points.
pub(super) type Row = [f64; WIDTH];

/// Radius (m), axial position (m) and signed strength (T) of an edge.
pub(super) type Edge = [f64; 3];

/// Number of components; see [`Parts`], whose order this is.
pub(super) const COMPONENTS: usize = 7;

/// Field and gradient of edges: `B_rho / rho`, `B_z`, `dB_rho/dz / rho` and `dB_z/dz` at the distances `rho` from the axis
/// and the heights `z` (m), the others zero. `false` where a point is so near to an edge that it must be evaluated alone.
#[multiversion(targets("x86_64+avx+avx2"))]
pub(super) fn gradients(edges: &[Edge], rho: &Row, z: &Row, out: &mut [Row; COMPONENTS]) -> bool {
    sum::<GRADIENT>(edges, rho, z, out)
}

/// As [`gradients`], with the second derivatives.
#[multiversion(targets("x86_64+avx+avx2"))]
pub(super) fn jets(edges: &[Edge], rho: &Row, z: &Row, out: &mut [Row; COMPONENTS]) -> bool {
    sum::<HESSIAN>(edges, rho, z, out)
}

#[expect(clippy::inline_always, reason = "compiled for several processors")]
#[inline(always)]
fn sum<const ORDER: u8>(edges: &[Edge], rho: &Row, z: &Row, out: &mut [Row; COMPONENTS]) -> bool {
    *out = [[0.0; WIDTH]; COMPONENTS];
    for [radius, position, strength] in edges {
        let place = Place::new(Lanes::all(*radius), Lanes(*z) - *position, Lanes(*rho));
        let kc = place.complement();
        let Some(steps) = Integrals::steps(&kc) else { return false };
        let ratio = [place.difference * place.inverse_far, place.sum * place.inverse_far];
        let integrals = Integrals::with_steps(place.parameter(), kc, ratio, steps);
        let Parts { radial, axial, radial_dz, axial_dz, radial_dzz, axial_dzz, twist } =
            place.components::<ORDER>(&integrals);
        let parts = [radial, axial, radial_dz, axial_dz, radial_dzz, axial_dzz, twist];
        let count = if ORDER == HESSIAN { COMPONENTS } else { 4 };
        for (row, part) in out.iter_mut().zip(parts).take(count) {
            for (entry, value) in row.iter_mut().zip(part.0) {
                *entry += strength * value;
            }
        }
    }
    true
}
