//! A magnet of coaxial cylinders and rings.

use core::fmt;

use nalgebra::{Matrix3, Vector3};

use super::part::Part;
use super::source::{Drive, FieldSource, Source};
use crate::error::Error;
use crate::geometry::Pose;
use crate::magnetics::axial_source::AxialSource;
use crate::magnetics::jet::Jet;
use crate::magnetics::overlap::depth;
use crate::magnetics::quantities::OFFSET;
use crate::magnetics::wrench::Wrench;

/// One axially magnetised cylinder (or ring) of a magnet.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct AxialMagnet {
    /// Outer radius, m.
    pub radius: f64,
    /// Inner radius, m; 0 for a solid cylinder.
    pub inner_radius: f64,
    /// Length along the axis, m.
    pub length: f64,
    /// Axial position of its centre in the magnet's frame, m.
    pub offset: f64,
    /// Remanence along the axis, T.
    pub remanence: f64,
}

/// A checked magnet of coaxial cylinders; its frame's third axis is the common axis.
///
/// Its cylinders may touch but not overlap. Their fields add up; see [`AxialSource`] for the values inside the material and on its
/// surface.
#[derive(Debug, Clone, PartialEq)]
pub struct Cylinders {
    dimensions: Vec<AxialMagnet>,
    /// The field of each.
    sources: Vec<AxialSource>,
    /// The solid of each.
    parts: Vec<Part>,
}

impl Cylinders {
    /// Largest number of cylinders of a magnet.
    pub const MOST: usize = 64;

    /// Checks the cylinders and makes the magnet of them.
    ///
    /// ```
    /// use mcm::magnetics::{AxialMagnet, Cylinders};
    /// let cylinder = AxialMagnet { radius: 22.5e-3, inner_radius: 0.0, length: 30e-3, offset: 0.0, remanence: 1.35 };
    /// assert!(Cylinders::new(vec![cylinder]).is_ok());
    /// assert!(Cylinders::new(vec![cylinder, AxialMagnet { offset: 29e-3, ..cylinder }]).is_err()); // overlap
    /// ```
    ///
    /// # Errors
    /// [`Error::Range`] naming the first dimension out of range, [`Error::Count`] for an empty or too long list,
    /// [`Error::Unsupported`] for cylinders that overlap.
    pub fn new(dimensions: Vec<AxialMagnet>) -> Result<Self, Error> {
        if dimensions.is_empty() || dimensions.len() > Self::MOST {
            return Err(Error::Count {
                quantity: "list of the external magnet's cylinders".into(),
                given: dimensions.len(),
                expected: format!("1 to {}", Self::MOST),
            });
        }

        let mut sources = Vec::with_capacity(dimensions.len());
        let mut parts = Vec::with_capacity(dimensions.len());
        for (number, magnet) in (1..).zip(&dimensions) {
            let AxialMagnet { inner_radius, radius, length, offset, remanence } = *magnet;
            let source = OFFSET
                .check(offset)
                .and_then(|_| AxialSource::new(inner_radius, radius, length, remanence))
                .map_err(|error| error.of_item(number))?;
            let (outline, centre) = (source.outline(), Vector3::z() * magnet.offset);
            parts.push(Part { outline, centre, remanence: Vector3::z() * magnet.remanence });
            sources.push(source);
        }

        check_apart(&parts)?;
        Ok(Self { dimensions, sources, parts })
    }

    /// The dimensions of each cylinder.
    #[must_use]
    pub fn dimensions(&self) -> &[AxialMagnet] {
        &self.dimensions
    }

    /// The field of each cylinder, with the height of its centre, m.
    fn placed(&self) -> impl Iterator<Item = (&AxialSource, f64)> {
        self.sources.iter().zip(self.dimensions.iter().map(|magnet| magnet.offset))
    }
}

/// Checks that no two cylinders overlap.
fn check_apart(parts: &[Part]) -> Result<(), Error> {
    for (index, first) in parts.iter().enumerate() {
        let above = |second: &Part| Pose::identity().advanced(second.centre.z - first.centre.z);
        let overlaps = |second: &Part| depth(&first.outline, &second.outline, &above(second)) > 0.0;
        if parts.iter().skip(index + 1).any(overlaps) {
            return Err(Error::Unsupported(format!(
                "cylinder {} of the external magnet overlaps another one",
                index + 1
            )));
        }
    }
    Ok(())
}

impl FieldSource for Cylinders {
    fn drive(&self) -> Drive {
        Drive::Factor
    }

    fn fields(&self, points: &[Vector3<f64>], out: &mut [Vector3<f64>]) -> Result<(), Error> {
        out.fill(Vector3::zeros());
        self.placed().try_for_each(|(source, height)| source.add_fields(height, points, out))
    }

    fn gradients(
        &self,
        points: &[Vector3<f64>],
        out: &mut [(Vector3<f64>, Matrix3<f64>)],
    ) -> Result<(), Error> {
        out.fill((Vector3::zeros(), Matrix3::zeros()));
        self.placed().try_for_each(|(source, height)| source.add_field_gradients(height, points, out))
    }

    fn jets(&self, points: &[Vector3<f64>], out: &mut [Jet]) -> Result<(), Error> {
        out.fill(Jet::zero());
        self.placed().try_for_each(|(source, height)| source.add_jets(height, points, out))
    }

    fn contains_any(&self, points: &[Vector3<f64>]) -> bool {
        let holds = |point: &Vector3<f64>| {
            self.sources.iter().zip(&self.parts).any(|(source, part)| source.contains(&(point - part.centre)))
        };
        points.iter().any(holds)
    }

    fn distance(&self, point: &Vector3<f64>) -> f64 {
        let each = self.sources.iter().zip(&self.parts);
        each.map(|(source, part)| source.distance(&(point - part.centre))).fold(f64::INFINITY, f64::min)
    }

    fn unknown_within(&self) -> f64 {
        0.0
    }

    fn parts(&self) -> &[Part] {
        &self.parts
    }

    fn moment(&self) -> Vector3<f64> {
        Vector3::z() * self.sources.iter().map(AxialSource::moment).sum::<f64>()
    }

    fn is_axisymmetric(&self) -> bool {
        true
    }

    /// The field on the magnetic charges of the faces of each cylinder.
    fn wrench_in(&self, other: &Source, pose: &Pose, accuracy: f64) -> Result<Wrench, Error> {
        let mut sum = Wrench::NONE;
        for (source, height) in self.placed() {
            let wrench = other.wrench_on(source, &pose.advanced(height), accuracy)?;
            sum.force += wrench.force;
            sum.torque += wrench.torque + (pose.rotation * Vector3::z() * height).cross(&wrench.force);
        }
        Ok(sum)
    }

    fn identity(&self) -> &dyn fmt::Debug {
        &self.dimensions
    }
}
