//! Field of one magnet at eight points side by side, exact or by multipoles, and of nested cylinders at one point.
//!
//! The formulas are those of single points, with points instead of edges in the lanes; the functions are compiled for
//! several processors, and the fastest that runs is chosen. No product is fused with a sum, so that all give the same
//! bits.

#![expect(clippy::inline_always, reason = "these functions are compiled for several processors")]

use super::edge::{Edges, GRADIENT, HESSIAN, Parts, Place};
use super::integrals::Integrals;
use super::lanes::Lanes;
use super::multipole::Multipole;
use crate::numerics::processor::for_each_processor;

/// Number of points side by side.
pub(super) const WIDTH: usize = 8;

/// Numbers of so many points.
pub(super) type Row = [f64; WIDTH];

/// Radius (m), axial position (m) and signed strength (T) of an edge.
pub(super) type Edge = [f64; 3];

/// Number of components; see [`Parts`], whose order this is.
pub(super) const COMPONENTS: usize = 7;

/// Steps of the elliptic integrals' means, and the smallest `kc` for which they leave a relative error of 1e-12 and of
/// 1e-8.
const EXACT: (u32, f64) = (5, 0.071);
const ROUGH: (u32, f64) = (4, 0.096);

/// Where the field comes from.
#[derive(Debug, Clone, Copy)]
pub(super) enum Origin<'a> {
    /// The edges; with more error where `rough`.
    Edges { edges: &'a [Edge], rough: bool },
    /// As many terms of the multipoles.
    Multipole(&'a Multipole, usize),
}

for_each_processor! {
    /// Field and gradient: `B_rho / rho`, `B_z`, `dB_rho/dz / rho` and `dB_z/dz` at the distances `rho` from the axis and the
    /// heights `z` (m), the others zero. `false` where a point is so near to an edge that it must be evaluated alone.
    pub(super) fn gradients(origin: &Origin<'_>, rho: &Row, z: &Row, out: &mut [Row; COMPONENTS]) -> bool {
        let mut apart = [f64::MAX; WIDTH];
        components::<GRADIENT>(origin, rho, z, out, &mut apart);
        apart.iter().all(|excess| *excess >= 0.0)
    }
}

for_each_processor! {
    /// As [`gradients`], with the second derivatives.
    pub(super) fn jets(origin: &Origin<'_>, rho: &Row, z: &Row, out: &mut [Row; COMPONENTS]) -> bool {
        let mut apart = [f64::MAX; WIDTH];
        components::<HESSIAN>(origin, rho, z, out, &mut apart);
        apart.iter().all(|excess| *excess >= 0.0)
    }
}

for_each_processor! {
    /// As [`gradients`], with the shear (T/m2) that magnetisation across the axis needs.
    pub(super) fn gradients_across(
        origin: &Origin<'_>,
        rho: &Row,
        z: &Row,
        out: &mut [Row; COMPONENTS],
        shear: &mut Row,
    ) -> bool {
        with_shear::<GRADIENT>(origin, rho, z, out, shear)
    }
}

for_each_processor! {
    /// As [`gradients_across`], with the second derivatives.
    pub(super) fn jets_across(
        origin: &Origin<'_>,
        rho: &Row,
        z: &Row,
        out: &mut [Row; COMPONENTS],
        shear: &mut Row,
    ) -> bool {
        with_shear::<HESSIAN>(origin, rho, z, out, shear)
    }
}

for_each_processor! {
    /// As [`gradients`] at one point, with eight edges of each group in the lanes, over which the components are to be added up.
    pub(super) fn nested_gradients(
        groups: &[Edges<WIDTH>],
        rho: f64,
        z: f64,
        out: &mut [Row; COMPONENTS],
    ) -> bool {
        of_groups::<GRADIENT>(groups, rho, z, out)
    }
}

for_each_processor! {
    /// As [`nested_gradients`], with the second derivatives.
    pub(super) fn nested_jets(groups: &[Edges<WIDTH>], rho: f64, z: f64, out: &mut [Row; COMPONENTS]) -> bool {
        of_groups::<HESSIAN>(groups, rho, z, out)
    }
}

/// The components up to the order `ORDER`, to be called by functions that are compiled for several processors; `apart` is
/// lowered to a number that is negative or NaN where a lane is too near to an edge.
#[inline(always)]
pub(super) fn components<const ORDER: u8>(
    origin: &Origin<'_>,
    rho: &Row,
    z: &Row,
    out: &mut [Row; COMPONENTS],
    apart: &mut Row,
) {
    match origin {
        Origin::Edges { edges, rough: false } => {
            of_edges::<ORDER, { EXACT.0 }>(edges, EXACT.1, rho, z, out, apart);
        }
        Origin::Edges { edges, rough: true } => {
            of_edges::<ORDER, { ROUGH.0 }>(edges, ROUGH.1, rho, z, out, apart);
        }
        Origin::Multipole(multipole, terms) => {
            let r2 = Lanes(*rho).squared() + Lanes(*z).squared();
            let parts = multipole.parts::<ORDER, WIDTH>(Lanes(*z), r2, *terms);
            *out = rows(&parts).map(|part| part.0);
        }
    }
}

/// As [`components`], with the shear; `false` where a lane is too near to an edge.
#[inline(always)]
fn with_shear<const ORDER: u8>(
    origin: &Origin<'_>,
    rho: &Row,
    z: &Row,
    out: &mut [Row; COMPONENTS],
    shear: &mut Row,
) -> bool {
    match origin {
        Origin::Multipole(multipole, terms) => {
            let r2 = Lanes(*rho).squared() + Lanes(*z).squared();
            *out = rows(&multipole.parts::<ORDER, WIDTH>(Lanes(*z), r2, *terms)).map(|part| part.0);
            *shear = multipole.shear_of(Lanes(*z), r2, *terms).0;
            true
        }
        Origin::Edges { edges, .. } => {
            *out = [[0.0; WIDTH]; COMPONENTS];

            let (mut within, mut wall) = (Lanes::all(0.0), Lanes::all(0.0));
            let mut excess = Lanes::all(f64::MAX);
            for [radius, position, strength] in *edges {
                let place = Place::new(Lanes::all(*radius), Lanes(*z) - *position, Lanes(*rho));
                excess = excess.min(place.excess(EXACT.1));
                let (integrals, parts) = evaluated::<ORDER, { EXACT.0 }>(&place);
                within = within + *strength * place.shear(&integrals, parts.radial, parts.axial);
                wall = wall + *strength * place.wall();
                accumulate::<ORDER>(&parts, &[*strength; WIDTH], out);
            }

            // Over all edges the walls' part is exactly zero above and below the body: it is added up before it is divided.
            let rho4 = Lanes(*rho).squared().squared().max(Lanes::all(f64::MIN_POSITIVE));
            *shear = (within - wall / rho4).0;
            excess.0.iter().all(|excess| *excess >= 0.0)
        }
    }
}

#[inline(always)]
fn of_edges<const ORDER: u8, const STEPS: u32>(
    edges: &[Edge],
    least: f64,
    rho: &Row,
    z: &Row,
    out: &mut [Row; COMPONENTS],
    apart: &mut Row,
) {
    *out = [[0.0; WIDTH]; COMPONENTS];
    // Kept in a vector until the end: numbers taken out of vectors one by one make all formulas before them scalar.
    let mut excess = Lanes(*apart);
    for [radius, position, strength] in edges {
        let place = Place::new(Lanes::all(*radius), Lanes(*z) - *position, Lanes(*rho));
        excess = excess.min(place.excess(least));
        add::<ORDER, STEPS>(&place, &[*strength; WIDTH], out);
    }
    *apart = excess.0;
}

#[inline(always)]
fn of_groups<const ORDER: u8>(
    groups: &[Edges<WIDTH>],
    rho: f64,
    z: f64,
    out: &mut [Row; COMPONENTS],
) -> bool {
    *out = [[0.0; WIDTH]; COMPONENTS];
    let mut excess = Lanes::all(f64::MAX);
    for group in groups {
        let place = Place::new(Lanes(group.radius), z - Lanes(group.position), Lanes::all(rho));
        excess = excess.min(place.excess(EXACT.1));
        add::<ORDER, { EXACT.0 }>(&place, &group.strength, out);
    }
    excess.0.iter().all(|excess| *excess >= 0.0)
}

/// Adds the components at these places, each weighted with its strength (T).
#[inline(always)]
fn add<const ORDER: u8, const STEPS: u32>(place: &Place<WIDTH>, strength: &Row, out: &mut [Row; COMPONENTS]) {
    let (_, parts) = evaluated::<ORDER, STEPS>(place);
    accumulate::<ORDER>(&parts, strength, out);
}

/// The integrals and the components at these places.
#[inline(always)]
fn evaluated<const ORDER: u8, const STEPS: u32>(place: &Place<WIDTH>) -> (Integrals<WIDTH>, Parts<WIDTH>) {
    let ratio = [place.difference * place.inverse_far, place.sum * place.inverse_far];
    let integrals = Integrals::with_steps::<STEPS>(place.parameter(), place.complement(), ratio);
    let parts = place.components::<ORDER, true>(&integrals);
    (integrals, parts)
}

/// Adds components, each weighted with the strength (T) of its lane.
#[inline(always)]
fn accumulate<const ORDER: u8>(parts: &Parts<WIDTH>, strength: &Row, out: &mut [Row; COMPONENTS]) {
    let parts = rows(parts);
    let count = if ORDER == HESSIAN { COMPONENTS } else { 4 };
    for (row, part) in out.iter_mut().zip(parts).take(count) {
        for ((entry, value), strength) in row.iter_mut().zip(part.0).zip(strength) {
            *entry += strength * value;
        }
    }
}

#[inline(always)]
fn rows(parts: &Parts<WIDTH>) -> [Lanes<WIDTH>; COMPONENTS] {
    let Parts { radial, axial, radial_dz, axial_dz, radial_dzz, axial_dzz, twist } = parts;
    [*radial, *axial, *radial_dz, *axial_dz, *radial_dzz, *axial_dzz, *twist]
}
