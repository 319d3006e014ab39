//! The winding of a coil as thin solenoids at the Gauss points of its thickness.

use nalgebra::Vector3;

use super::axial_source::AxialSource;
use super::axisymmetric::{Components, Meridian};
use super::coil::Coil;
use super::edge::{Edges, HESSIAN};
use super::points::{COMPONENTS, WIDTH, nested_gradients, nested_jets};
use crate::constants::VACUUM_PERMEABILITY;
use crate::error::Error;
use crate::numerics::quadrature::gauss_legendre;

/// Numbers of Gauss points across the winding of a coil, and the distance from it, in halves of its thickness, from which each
/// leaves less than 1e-10 of the field.
///
/// A sheet's field, seen as a function of its radius, is singular at the distance `d` from the winding; `n` points leave
/// `rho^(-2 n)`, where `(rho - 1 / rho) / 2 = d` (Trefethen, Approximation Theory and Approximation Practice, theorem 19.3). Far
/// away, where the field itself fades as `(r / d)^2`, the first power of `r / d` that the rule does not integrate counts.
const LAYERS: [(usize, f64); 5] = [(4, 24.0), (6, 5.0), (12, 1.3), (24, 0.55), (48, 0.0)];

/// Number of solenoids, each with two edges, that are evaluated side by side.
const TOGETHER: usize = WIDTH / 2;

/// A winding, by the field of one ampere.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Winding {
    /// Its outline, without a field.
    pub(super) body: AxialSource,
    half_thickness: f64,
    /// Thin solenoids of its length for each of [`LAYERS`].
    layers: Vec<Vec<AxialSource>>,
    /// The edges of the same, [`TOGETHER`] at a time; the last group is filled up with edges of no strength.
    groups: Vec<Vec<Edges<WIDTH>>>,
}

impl Winding {
    /// The winding of a coil whose dimensions are checked.
    pub(super) fn new(coil: &Coil) -> Result<Self, Error> {
        let &Coil { inner_radius, outer_radius, length, turns, .. } = coil;
        let (middle, half_thickness) =
            (0.5 * (outer_radius + inner_radius), 0.5 * (outer_radius - inner_radius));
        let remanence = VACUUM_PERMEABILITY * turns / length; // of all layers together
        let layer = |(points, _): (usize, f64)| {
            let (nodes, weights) = gauss_legendre(points);
            let each = nodes.iter().zip(&weights).map(|(node, weight)| {
                AxialSource::new(0.0, middle + half_thickness * node, length, 0.5 * weight * remanence)
            });
            each.collect::<Result<Vec<_>, _>>()
        };
        let layers = LAYERS.into_iter().map(layer).collect::<Result<Vec<_>, _>>()?;
        let groups = layers.iter().map(|layer| layer.chunks(TOGETHER).map(group).collect()).collect();
        let body = AxialSource::new(inner_radius, outer_radius, length, 0.0)?;
        Ok(Self { body, half_thickness, layers, groups })
    }

    /// The solenoids that serve at all of `points`.
    pub(super) fn solenoids(&self, points: &[Vector3<f64>]) -> &[AxialSource] {
        let nearest = points.iter().map(|point| self.body.distance(point)).fold(f64::INFINITY, f64::min);
        &self.layers[self.layer(nearest)]
    }

    /// Number of the layer that serves at this distance from the winding, m.
    fn layer(&self, distance: f64) -> usize {
        let reach = distance / self.half_thickness;
        LAYERS.iter().position(|(_, from)| reach >= *from).unwrap_or(LAYERS.len() - 1)
    }

    /// The components of the field at a point by many edges side by side; `None` where the solenoids are to be evaluated one by
    /// one, because the point is close to an edge or so far away that multipoles serve.
    pub(super) fn components<const ORDER: u8>(&self, point: &Vector3<f64>) -> Option<(Meridian, Components)> {
        let number = self.layer(self.body.distance(point));
        if !self.layers[number].last()?.is_near(point.norm_squared()) {
            return None;
        }
        let (at, mut rows) = (Meridian::of(point.x, point.y), [[0.0; WIDTH]; COMPONENTS]);
        let kernel = if ORDER == HESSIAN { nested_jets } else { nested_gradients };
        if !kernel(&self.groups[number], at.rho, point.z, &mut rows) {
            return None;
        }
        let [radial, axial, radial_dz, axial_dz, radial_dzz, axial_dzz, twist] =
            rows.map(|row| row.iter().sum());
        Some((at, Components { radial, axial, radial_dz, axial_dz, radial_dzz, axial_dzz, twist }))
    }
}

/// The edges of at most [`TOGETHER`] solenoids.
fn group(solenoids: &[AxialSource]) -> Edges<WIDTH> {
    // The rest repeats the last edge, where there is a field, without strength.
    let mut out = Edges { radius: [0.0; WIDTH], position: [0.0; WIDTH], strength: [0.0; WIDTH] };
    let edges = solenoids.iter().flat_map(|solenoid| solenoid.with_edges(<[_]>::to_vec));
    let mut last = [0.0; 3];
    let mut edges = edges.fuse();
    for lane in 0..WIDTH {
        let [radius, position, strength] = edges.next().unwrap_or([last[0], last[1], 0.0]);
        last = [radius, position, strength];
        (out.radius[lane], out.position[lane], out.strength[lane]) = (radius, position, strength);
    }
    out
}
