//! A cylinder or ring magnetised in any direction.

use core::f64::consts::PI;
use core::fmt;

use nalgebra::{Matrix3, Vector3};

use super::cylinders::{AxialMagnet, Cylinders};
use super::mutual::{Sum, around, directions};
use super::part::Part;
use super::shape::Shape;
use super::source::{Drive, FieldSource, Source};
use crate::constants::VACUUM_PERMEABILITY;
use crate::error::Error;
use crate::geometry::Pose;
use crate::magnetics::axial_source::AxialSource;
use crate::magnetics::axisymmetric::Meridian;
use crate::magnetics::edge::{FIELD, GRADIENT, HESSIAN, SHEAR};
use crate::magnetics::jet::Jet;
use crate::magnetics::quantities::{BORE, DIRECTED_REMANENCE, HEIGHT, RADIUS};
use crate::magnetics::shape_derivatives::AxisymmetricDerivatives;
use crate::magnetics::wrench::{Wrench, refined};
use crate::numerics::quadrature::gauss_legendre;

/// The shape of a cylinder or ring.
pub(super) static SHAPE: Shape = Shape {
    name: "cylinder",
    description: "A cylinder or ring about the z of its frame",
    dimensions: &[&RADIUS, &BORE, &HEIGHT],
    make,
};

fn make(dimensions: &[f64], remanence: Vector3<f64>) -> Result<Source, Error> {
    let [radius, inner_radius, length] = [0, 1, 2].map(|i| dimensions[i]);
    let any = ObliqueCylinder::new([inner_radius, radius], length, remanence)?;
    if !any.is_axisymmetric() {
        return Ok(any.into());
    }
    // Along the axis the field costs less.
    let axial = AxialMagnet { radius, inner_radius, length, offset: 0.0, remanence: remanence.z };
    Ok(Cylinders::new(vec![axial])?.into())
}

/// A cylinder or ring about its frame's `z`, centred at the origin, with a remanence in any direction.
///
/// The field is as accurate as that of an [`AxialSource`], which costs less for a remanence along `z`. On the curved surfaces it is the mean
/// of both sides, on the end faces the value outside.
///
/// ```
/// use mcm::magnetics::{ObliqueCylinder, Source};
/// use nalgebra::Vector3;
/// let magnet = Source::from(ObliqueCylinder::new([0.0, 22.5e-3], 30e-3, Vector3::new(1.35, 0.0, 0.0))?);
/// let field = magnet.field(&Vector3::new(0.0, 0.0, 60e-3))?;
/// assert!(field.x < 0.0 && field.y == 0.0 && field.z == 0.0); // beside a dipole
/// # Ok::<(), mcm::error::Error>(())
/// ```
#[derive(Debug, Clone, PartialEq)]
pub struct ObliqueCylinder {
    /// A body of these dimensions with 1 T along its axis.
    unit: AxialSource,
    remanence: Vector3<f64>,
    parts: [Part; 1],
}

impl ObliqueCylinder {
    /// A body of the inner (0: a solid cylinder) and outer radius and the length (m) with a remanence (T).
    ///
    /// # Errors
    /// [`Error::Range`] naming the first quantity out of range.
    pub fn new([inner, outer]: [f64; 2], length: f64, remanence: Vector3<f64>) -> Result<Self, Error> {
        RADIUS.check(outer)?;
        BORE.check_beside(inner, outer)?;
        HEIGHT.check(length)?;
        DIRECTED_REMANENCE.check(remanence.norm())?;
        let unit = AxialSource::new(inner, outer, length, 1.0)?;
        let part = Part { outline: unit.outline(), centre: Vector3::zeros(), remanence };
        Ok(Self { unit, remanence, parts: [part] })
    }

    /// Hands the derivatives at each point, by its number, to `put`, with how much of the point is inside.
    fn each<const ORDER: u8>(
        &self,
        points: &[Vector3<f64>],
        mut put: impl FnMut(usize, &Meridian, &AxisymmetricDerivatives, f64),
    ) -> Result<(), Error> {
        self.unit.each::<ORDER, true>(0.0, points, |number, at, (axial, shear)| {
            let inside = self.unit.share_inside(at.rho, points[number].z);
            put(number, at, &AxisymmetricDerivatives { axial: *axial, shear }, inside);
        })
    }

    /// The scalar potential `psi` (T m) at a point (m) outside the material: `B` is minus its gradient.
    ///
    /// With the Newtonian potential `V` of the volume it is `-b_i d_i V`, of which [`AxialSource`] has the part along the axis, and
    /// `V_rho / rho` follows from the shear, see [`crate::magnetics::transverse`].
    ///
    /// # Errors
    /// As the field.
    pub(in crate::magnetics) fn potential(&self, point: &Vector3<f64>) -> Result<f64, Error> {
        let (along, _) = self.unit.potential_field(point)?;
        let (at, shear, axial) = self.unit.with_beside::<FIELD, SHEAR>(point)?;
        let slope = 0.5 * (at.rho * at.rho * shear - axial.axial);

        let b = &self.remanence;
        Ok(b.z * along - (b.x * at.x + b.y * at.y) * slope)
    }

    /// Nodes on the surface with the magnetic charge of each, A m: `M . n dA`.
    fn charges(&self, (along, turns): (usize, usize), mut put: impl FnMut(Vector3<f64>, f64)) {
        let (inner, outer, half) =
            (self.unit.inner_radius(), self.unit.outer_radius(), 0.5 * self.unit.length());
        let magnetisation = self.remanence / VACUUM_PERMEABILITY;
        let (mean, spread) = (0.5 * (outer * outer + inner * inner), 0.5 * (outer * outer - inner * inner));

        // The end faces, with Gauss nodes in the square of the radius.
        let (nodes, weights) = gauss_legendre(along);
        for (node, weight) in nodes.iter().zip(&weights) {
            let rho = (mean + spread * node).sqrt();
            let area = PI * spread * weight / turns as f64;
            for (sine, cosine) in directions(turns) {
                for side in [-1.0, 1.0] {
                    let place = Vector3::new(rho * cosine, rho * sine, side * half);
                    put(place, side * magnetisation.z * area);
                }
            }
        }

        // The curved surfaces; the normal of the inner one points to the axis.
        let (heights, shares) = gauss_legendre(2 * along);
        for (radius, outward) in [(outer, 1.0), (inner, -1.0)].into_iter().filter(|(radius, _)| *radius > 0.0)
        {
            for (height, share) in heights.iter().zip(&shares) {
                let area = half * share * radius * 2.0 * PI / turns as f64;
                for (sine, cosine) in directions(turns) {
                    let place = Vector3::new(radius * cosine, radius * sine, half * height);
                    let across = magnetisation.x * cosine + magnetisation.y * sine;
                    put(place, outward * across * area);
                }
            }
        }
    }
}

impl FieldSource for ObliqueCylinder {
    fn drive(&self) -> Drive {
        Drive::Factor
    }

    fn fields(&self, points: &[Vector3<f64>], out: &mut [Vector3<f64>]) -> Result<(), Error> {
        self.each::<FIELD>(points, |number, at, derivatives, inside| {
            out[number] = derivatives.field(at, &self.remanence, inside);
        })
    }

    fn gradients(
        &self,
        points: &[Vector3<f64>],
        out: &mut [(Vector3<f64>, Matrix3<f64>)],
    ) -> Result<(), Error> {
        self.each::<GRADIENT>(points, |number, at, derivatives, inside| {
            let b = &self.remanence;
            out[number] = (derivatives.field(at, b, inside), derivatives.gradient(at, b));
        })
    }

    fn jets(&self, points: &[Vector3<f64>], out: &mut [Jet]) -> Result<(), Error> {
        self.each::<HESSIAN>(points, |number, at, derivatives, inside| {
            out[number] = derivatives.jet(at, &self.remanence, inside);
        })
    }

    fn contains_any(&self, points: &[Vector3<f64>]) -> bool {
        points.iter().any(|point| self.unit.contains(point))
    }

    fn distance(&self, point: &Vector3<f64>) -> f64 {
        self.unit.distance(point)
    }

    fn unknown_within(&self) -> f64 {
        0.0
    }

    fn parts(&self) -> &[Part] {
        &self.parts
    }

    fn moment(&self) -> Vector3<f64> {
        self.remanence * self.unit.moment()
    }

    fn is_axisymmetric(&self) -> bool {
        self.remanence.xy() == nalgebra::Vector2::zeros()
    }

    /// The field on the magnetic charges of all surfaces.
    fn wrench_in(&self, other: &Source, pose: &Pose, accuracy: f64) -> Result<Wrench, Error> {
        let outer = self.unit.outer_radius();
        let extent = outer.hypot(0.5 * self.unit.length());
        refined(around(extent, other, pose), outer, accuracy, |rule| {
            Sum::on_charges(other, pose, |put| self.charges(rule, put))
        })
    }

    fn identity(&self) -> &dyn fmt::Debug {
        self
    }
}
