//! A cuboid magnetised in any direction.

use core::fmt;

use nalgebra::{Matrix3, Vector3};

use super::mutual::{Sum, around};
use super::part::Part;
use super::shape::Shape;
use super::source::{Drive, FieldSource, Source};
use crate::constants::VACUUM_PERMEABILITY;
use crate::error::Error;
use crate::geometry::Pose;
use crate::magnetics::axial_source::{FARTHEST, refused};
use crate::magnetics::box_potential::Corners;
use crate::magnetics::jet::Jet;
use crate::magnetics::overlap::Outline;
use crate::magnetics::quantities::{DIRECTED_REMANENCE, EDGE};
use crate::magnetics::shape_derivatives as derivatives;
use crate::magnetics::solid_harmonics::SolidHarmonics;
use crate::magnetics::wrench::{Wrench, refined};
use crate::numerics::quadrature::gauss_legendre;

/// The shape of a cuboid.
pub(super) static SHAPE: Shape = Shape {
    name: "cuboid",
    description: "Edges along the axes of its frame",
    dimensions: &[&EDGE, &EDGE, &EDGE],
    make: |edges, remanence| Ok(Cuboid::new(Vector3::from_column_slice(edges), remanence)?.into()),
};

/// Distance, in halves of the diagonal, from which solid harmonics are used: there the closed form has lost three digits, and the degrees
/// that are left out are below 1e-15.
const FAR: f64 = 12.0;

/// A cuboid with edges along the axes of its frame, centred at the origin, with a remanence in any direction.
///
/// Field, gradient and second derivative are exact, with a relative error below 1e-12, except on edges, where they are singular. On a face
/// they have the values outside.
///
/// ```
/// use mcm::magnetics::{Cuboid, Source};
/// use nalgebra::Vector3;
/// let cube = Cuboid::new(Vector3::repeat(10e-3), Vector3::new(0.0, 0.0, 1.45))?;
/// let cube = Source::from(cube);
/// // In the middle of a cube the field is two thirds of the remanence, as in a sphere.
/// assert!((cube.field(&Vector3::zeros())?.z - 1.45 * 2.0 / 3.0).abs() < 1e-15);
/// assert!(cube.field(&Vector3::new(5e-3, 5e-3, 1e-3)).is_err()); // on an edge
/// # Ok::<(), mcm::error::Error>(())
/// ```
#[derive(Debug, Clone, PartialEq)]
pub struct Cuboid {
    half: Vector3<f64>,
    remanence: Vector3<f64>,
    far: SolidHarmonics,
    /// Square of the distance from which they are used, m2.
    far2: f64,
    parts: [Part; 1],
    identity: (&'static str, [f64; 3], [f64; 3]),
}

impl Cuboid {
    /// A cuboid with these edges (m) and this remanence (T).
    ///
    /// # Errors
    /// [`Error::Range`] naming the first quantity out of range.
    pub fn new(size: Vector3<f64>, remanence: Vector3<f64>) -> Result<Self, Error> {
        for (number, edge) in (1..).zip(&size) {
            EDGE.check(*edge).map_err(|error| error.of_item(number))?;
        }
        DIRECTED_REMANENCE.check(remanence.norm())?;
        let half = 0.5 * size;
        let part = Part { outline: Outline::Cuboid(half), centre: Vector3::zeros(), remanence };
        Ok(Self {
            half,
            remanence,
            far: SolidHarmonics::of_cuboid(&half, &remanence),
            far2: FAR * FAR * half.norm_squared(),
            parts: [part],
            identity: ("cuboid", size.into(), remanence.into()),
        })
    }

    /// What `near` makes of the corners at each point, or `far` of points far away.
    fn each<T>(
        &self,
        points: &[Vector3<f64>],
        out: &mut [T],
        near: impl Fn(&Corners, &Vector3<f64>) -> T,
        far: impl Fn(&Vector3<f64>) -> T,
    ) -> Result<(), Error> {
        for (point, out) in points.iter().zip(out) {
            if !point.iter().all(|coordinate| coordinate.abs() <= FARTHEST) {
                return Err(refused(point));
            }
            *out = if point.norm_squared() > self.far2 {
                far(point)
            } else {
                let on_edge = Error::OnEdge { x: point.x, y: point.y, z: point.z };
                near(&Corners::new(&self.half, point).ok_or(on_edge)?, point)
            };
        }
        Ok(())
    }

    /// `B` near the cuboid, T.
    fn field_at(&self, corners: &Corners, point: &Vector3<f64>) -> Vector3<f64> {
        let outside = derivatives::field(&corners.second(), &self.remanence);
        if self.contains(point) { outside + self.remanence } else { outside }
    }

    fn contains(&self, point: &Vector3<f64>) -> bool {
        (0..3).all(|axis| point[axis].abs() < self.half[axis])
    }

    /// Nodes on the faces with the magnetic charge of each, A m: `M . n dA`.
    fn charges(&self, count: usize, mut put: impl FnMut(Vector3<f64>, f64)) {
        let magnetisation = self.remanence / VACUUM_PERMEABILITY;
        let (nodes, weights) = gauss_legendre(count);
        for axis in (0..3).filter(|axis| magnetisation[*axis] != 0.0) {
            let [one, two] = [(axis + 1) % 3, (axis + 2) % 3];
            for (u, by_u) in nodes.iter().zip(&weights) {
                for (v, by_v) in nodes.iter().zip(&weights) {
                    let charge = magnetisation[axis] * self.half[one] * self.half[two] * by_u * by_v;
                    for side in [-1.0, 1.0] {
                        let mut place = Vector3::zeros();
                        place[axis] = side * self.half[axis];
                        (place[one], place[two]) = (u * self.half[one], v * self.half[two]);
                        put(place, side * charge);
                    }
                }
            }
        }
    }
}

impl FieldSource for Cuboid {
    fn drive(&self) -> Drive {
        Drive::Factor
    }

    fn fields(&self, points: &[Vector3<f64>], out: &mut [Vector3<f64>]) -> Result<(), Error> {
        self.each(points, out, |corners, point| self.field_at(corners, point), |point| self.far.field(point))
    }

    fn gradients(
        &self,
        points: &[Vector3<f64>],
        out: &mut [(Vector3<f64>, Matrix3<f64>)],
    ) -> Result<(), Error> {
        let near = |corners: &Corners, point: &Vector3<f64>| {
            (self.field_at(corners, point), derivatives::gradient(&corners.third(), &self.remanence))
        };
        self.each(points, out, near, |point| self.far.field_gradient(point))
    }

    fn jets(&self, points: &[Vector3<f64>], out: &mut [Jet]) -> Result<(), Error> {
        let near = |corners: &Corners, point: &Vector3<f64>| Jet {
            field: self.field_at(corners, point),
            gradient: derivatives::gradient(&corners.third(), &self.remanence),
            hessian: derivatives::hessian(&corners.fourth(), &self.remanence),
        };
        self.each(points, out, near, |point| self.far.jet(point))
    }

    fn contains_any(&self, points: &[Vector3<f64>]) -> bool {
        points.iter().any(|point| self.contains(point))
    }

    fn distance(&self, point: &Vector3<f64>) -> f64 {
        self.parts[0].outline.signed_distance(point).max(0.0)
    }

    fn unknown_within(&self) -> f64 {
        0.0
    }

    fn parts(&self) -> &[Part] {
        &self.parts
    }

    fn moment(&self) -> Vector3<f64> {
        self.remanence * (self.parts[0].outline.volume() / VACUUM_PERMEABILITY)
    }

    fn is_axisymmetric(&self) -> bool {
        false
    }

    /// The field on the magnetic charges of the faces.
    fn wrench_in(&self, other: &Source, pose: &Pose, accuracy: f64) -> Result<Wrench, Error> {
        let extent = self.half.norm();
        refined(around(extent, other, pose), extent, accuracy, |(_, turns)| {
            Sum::on_charges(other, pose, |put| self.charges(turns / 2, put))
        })
    }

    fn identity(&self) -> &dyn fmt::Debug {
        &self.identity
    }
}
