//! A coil without iron: its winding as thin solenoids at the Gauss points of its thickness.

use core::f64::consts::PI;
use core::fmt;
use core::slice::{from_mut, from_ref};

use nalgebra::{Matrix3, Vector3};

use super::coil::Coil;
use super::mutual::{Sum, around, directions};
use super::part::Part;
use super::source::{Drive, FieldSource, Source};
use crate::constants::VACUUM_PERMEABILITY;
use crate::error::Error;
use crate::geometry::Pose;
use crate::magnetics::axial_source::AxialSource;
use crate::magnetics::axisymmetric::{Components, Meridian};
use crate::magnetics::edge::{Edges, FIELD, GRADIENT, HESSIAN};
use crate::magnetics::jet::Jet;
use crate::magnetics::points::{COMPONENTS, WIDTH, nested_gradients, nested_jets};
use crate::magnetics::wrench::{Wrench, refined};
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

/// A thick solenoid: the field of one ampere in a winding without iron.
///
/// Its winding is a stack of thin solenoids at the Gauss points of its thickness, each of which has the field of a cylinder
/// magnetised along its axis. As many are taken as the nearest point needs, which leaves less than 1e-10 of the field farther
/// from the winding than a quarter of half its thickness.
#[derive(Debug, Clone, PartialEq)]
pub struct Solenoid {
    coil: Coil,
    /// The winding as a body, without a field.
    body: AxialSource,
    parts: [Part; 1],
    half_thickness: f64,
    /// Thin solenoids of its length for each of [`LAYERS`].
    layers: Vec<Vec<AxialSource>>,
    /// The edges of the same, [`TOGETHER`] at a time; the last group is filled up with edges of no strength.
    groups: Vec<Vec<Edges<WIDTH>>>,
}

impl Solenoid {
    /// The field source of a coil.
    ///
    /// ```
    /// use mcm::magnetics::{Coil, Solenoid, Source};
    /// use nalgebra::Vector3;
    /// let coil = Coil { inner_radius: 20e-3, outer_radius: 40e-3, length: 60e-3, turns: 600.0 };
    /// let field = Source::from(Solenoid::new(coil)?).field(&Vector3::zeros())?; // T/A
    /// // In the middle: mu_0 N / (2 (b - a)) ln((b + sqrt(b^2 + h^2)) / (a + sqrt(a^2 + h^2))), h half the length.
    /// let end = |r: f64| r + r.hypot(30e-3);
    /// let expected = 4e-7 * std::f64::consts::PI * 600.0 / (2.0 * 20e-3) * (end(40e-3) / end(20e-3)).ln();
    /// assert!((field.z / expected - 1.0).abs() < 1e-10);
    /// # Ok::<(), mcm::error::Error>(())
    /// ```
    ///
    /// # Errors
    /// [`Error::Range`] naming the first dimension out of range.
    pub fn new(coil: Coil) -> Result<Self, Error> {
        let Coil { inner_radius, outer_radius, length, turns } = coil.checked()?;
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
        let part = Part::winding(body.outline(), &moment(&layers[0]));
        Ok(Self { coil, body, parts: [part], half_thickness, layers, groups })
    }

    /// The solenoids that serve at all of `points`.
    fn solenoids(&self, points: &[Vector3<f64>]) -> &[AxialSource] {
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
    fn components<const ORDER: u8>(&self, point: &Vector3<f64>) -> Option<(Meridian, Components)> {
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

    /// Writes to `out`, which is zero, what `of_components` makes of the components at each point; `add` adds the same of one
    /// solenoid at several points.
    ///
    /// A point has the edges of many solenoids side by side; many points are side by side themselves.
    fn each<const ORDER: u8, T>(
        &self,
        points: &[Vector3<f64>],
        out: &mut [T],
        of_components: impl Fn(&Components, &Meridian) -> T,
        add: impl Fn(&AxialSource, &[Vector3<f64>], &mut [T]) -> Result<(), Error>,
    ) -> Result<(), Error> {
        if points.len() >= WIDTH {
            return self.solenoids(points).iter().try_for_each(|solenoid| add(solenoid, points, out));
        }

        for (point, out) in points.iter().zip(out) {
            if let Some((at, components)) = self.components::<ORDER>(point) {
                *out = of_components(&components, &at);
                continue;
            }
            let (point, out) = (from_ref(point), from_mut(out));
            self.solenoids(point).iter().try_for_each(|solenoid| add(solenoid, point, out))?;
        }
        Ok(())
    }
}

/// Magnetic moment of a stack of solenoids, A m2.
fn moment(layer: &[AxialSource]) -> Vector3<f64> {
    Vector3::z() * layer.iter().map(AxialSource::moment).sum::<f64>()
}

impl FieldSource for Solenoid {
    fn drive(&self) -> Drive {
        Drive::Current
    }

    fn fields(&self, points: &[Vector3<f64>], out: &mut [Vector3<f64>]) -> Result<(), Error> {
        out.fill(Vector3::zeros());
        let add = |solenoid: &AxialSource, points: &[_], out: &mut [_]| solenoid.add_fields(0.0, points, out);
        self.each::<FIELD, _>(points, out, Components::field, add)
    }

    fn gradients(
        &self,
        points: &[Vector3<f64>],
        out: &mut [(Vector3<f64>, Matrix3<f64>)],
    ) -> Result<(), Error> {
        out.fill((Vector3::zeros(), Matrix3::zeros()));
        let both = |components: &Components, at: &Meridian| (components.field(at), components.gradient(at));
        let add = |solenoid: &AxialSource, points: &[_], out: &mut [_]| {
            solenoid.add_field_gradients(0.0, points, out)
        };
        self.each::<GRADIENT, _>(points, out, both, add)
    }

    fn jets(&self, points: &[Vector3<f64>], out: &mut [Jet]) -> Result<(), Error> {
        out.fill(Jet::zero());
        let add = |solenoid: &AxialSource, points: &[_], out: &mut [_]| solenoid.add_jets(0.0, points, out);
        self.each::<HESSIAN, _>(points, out, Components::jet, add)
    }

    fn contains_any(&self, points: &[Vector3<f64>]) -> bool {
        points.iter().any(|point| self.body.contains(point))
    }

    fn distance(&self, point: &Vector3<f64>) -> f64 {
        self.body.distance(point)
    }

    fn unknown_within(&self) -> f64 {
        0.0
    }

    fn parts(&self) -> &[Part] {
        &self.parts
    }

    fn moment(&self) -> Vector3<f64> {
        moment(&self.layers[0])
    }

    fn is_axisymmetric(&self) -> bool {
        true
    }

    /// The sum of current times field over the winding.
    fn wrench_in(&self, other: &Source, pose: &Pose, accuracy: f64) -> Result<Wrench, Error> {
        let Coil { inner_radius, outer_radius, length, turns } = self.coil;
        let (middle, half) = (0.5 * (outer_radius + inner_radius), 0.5 * (outer_radius - inner_radius));
        let density = turns / (2.0 * half * length);

        let by = |(along, around): (usize, usize)| {
            let (radii, weights) = gauss_legendre(along);
            let (heights, shares) = gauss_legendre(2 * along);
            let mut sum = Sum::NONE;
            for (height, share) in heights.iter().zip(&shares) {
                for (radius, weight) in radii.iter().zip(&weights) {
                    let rho = middle + half * radius;
                    let area = 0.5 * half * length * weight * share;
                    let current = density * area * rho * 2.0 * PI / around as f64;
                    for (sine, cosine) in directions(around) {
                        let arm = Vector3::new(rho * cosine, rho * sine, 0.5 * length * height);
                        let arm = pose.rotation * arm;
                        let along = pose.rotation * Vector3::new(-sine, cosine, 0.0);
                        let field = other.field(&(pose.position + arm))?;
                        sum.add(&arm, &(along.cross(&field) * current));
                    }
                }
            }
            Ok(sum.wrench_and_size())
        };
        refined(around(outer_radius.hypot(0.5 * length), other, pose), outer_radius, accuracy, by)
    }

    fn identity(&self) -> &dyn fmt::Debug {
        &self.coil
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
