//! The external magnet: coaxial magnetised cylinders that move as one body.

use nalgebra::{Matrix3, Vector3};

use super::axial_source::AxialSource;
use super::jet::Jet;
use super::overlap::{Outline, depth};
use crate::error::{Error, check};
use crate::geometry::Pose;

/// One axially magnetised cylinder (or ring) of an assembly.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct AxialMagnet {
    /// Outer radius, m.
    pub radius: f64,
    /// Inner radius, m; 0 for a solid cylinder.
    pub inner_radius: f64,
    /// Length along the axis, m.
    pub length: f64,
    /// Axial position of its centre in the assembly's frame, m.
    pub offset: f64,
    /// Remanence along the axis, T.
    pub remanence: f64,
}

/// A checked assembly of coaxial cylinders; its frame's third axis is the common axis.
///
/// Its cylinders may touch but not overlap. All fields are in the assembly's frame and add up; see [`AxialSource`] for
/// their values inside the material and on its surface.
#[derive(Debug, Clone, PartialEq)]
pub struct Assembly {
    magnets: Vec<AxialMagnet>,
    sources: Vec<AxialSource>,
}

impl Assembly {
    /// Largest number of cylinders of an assembly.
    pub const MOST_MAGNETS: usize = 64;

    /// Checks the cylinders and makes the assembly of them.
    ///
    /// ```
    /// use mcm::magnetics::{Assembly, AxialMagnet};
    /// let cylinder = AxialMagnet { radius: 22.5e-3, inner_radius: 0.0, length: 30e-3, offset: 0.0, remanence: 1.35 };
    /// assert!(Assembly::new(vec![cylinder]).is_ok());
    /// assert!(Assembly::new(vec![cylinder, AxialMagnet { offset: 29e-3, ..cylinder }]).is_err()); // overlap
    /// ```
    ///
    /// # Errors
    /// [`Error::Range`] naming the first dimension out of range, [`Error::Count`] for an empty or too long list,
    /// [`Error::Unsupported`] for cylinders that overlap.
    pub fn new(magnets: Vec<AxialMagnet>) -> Result<Self, Error> {
        if magnets.is_empty() || magnets.len() > Self::MOST_MAGNETS {
            return Err(Error::Count {
                quantity: "list of the external magnet's cylinders".into(),
                given: magnets.len(),
                expected: format!("1 to {}", Self::MOST_MAGNETS),
            });
        }
        let mut sources = Vec::with_capacity(magnets.len());
        for magnet in &magnets {
            check("magnet offset (m)", magnet.offset, |v| v.abs() <= 1e3, "between -1e3 and 1e3")?;
            sources.push(AxialSource::new(
                magnet.inner_radius,
                magnet.radius,
                magnet.length,
                magnet.remanence,
            )?);
        }
        for (index, first) in magnets.iter().enumerate() {
            let body = |magnet: &AxialMagnet| Outline::new(magnet.inner_radius, magnet.radius, magnet.length);
            let above = |second: &AxialMagnet| Pose::identity().advanced(second.offset - first.offset);
            let overlaps = |second| depth(&body(first), &body(second), &above(second)) > 0.0;
            if magnets.iter().skip(index + 1).any(overlaps) {
                return Err(Error::Unsupported(format!(
                    "cylinder {} of the external magnet overlaps another one",
                    index + 1
                )));
            }
        }
        Ok(Self { magnets, sources })
    }

    /// The cylinders.
    #[must_use]
    pub fn magnets(&self) -> &[AxialMagnet] {
        &self.magnets
    }

    /// Flux density `B` (T) at a point (m).
    ///
    /// # Errors
    /// As [`AxialSource::field`].
    pub fn field(&self, point: &Vector3<f64>) -> Result<Vector3<f64>, Error> {
        let mut sum = Vector3::zeros();
        for (source, centre) in self.placed() {
            sum += source.field(&(point - centre))?;
        }
        Ok(sum)
    }

    /// `B` (T) and its gradient `dB_i/dx_j` (T/m) at a point (m).
    ///
    /// # Errors
    /// As [`AxialSource::field`].
    pub fn field_gradient(&self, point: &Vector3<f64>) -> Result<(Vector3<f64>, Matrix3<f64>), Error> {
        let mut sum = (Vector3::zeros(), Matrix3::zeros());
        for (source, centre) in self.placed() {
            let (field, gradient) = source.field_gradient(&(point - centre))?;
            sum.0 += field;
            sum.1 += gradient;
        }
        Ok(sum)
    }

    /// `B`, its gradient and its second derivative at a point (m).
    ///
    /// # Errors
    /// As [`AxialSource::field`].
    pub fn jet(&self, point: &Vector3<f64>) -> Result<Jet, Error> {
        let mut sum = Jet::zero();
        for (source, centre) in self.placed() {
            sum += source.jet(&(point - centre))?;
        }
        Ok(sum)
    }

    /// `B` (T) and its gradient `dB_i/dx_j` (T/m) at many points (m), written to `out` in their order; as
    /// [`AxialSource::field_gradients`].
    ///
    /// # Errors
    /// As [`AxialSource::field_gradients`].
    pub fn field_gradients(
        &self,
        points: &[Vector3<f64>],
        out: &mut Vec<(Vector3<f64>, Matrix3<f64>)>,
    ) -> Result<(), Error> {
        out.clear();
        out.resize(points.len(), (Vector3::zeros(), Matrix3::zeros()));
        self.placed().try_for_each(|(source, centre)| source.add_field_gradients(centre.z, points, out))
    }

    /// `B`, its gradient and its second derivative at many points (m), written to `out` in their order.
    ///
    /// # Errors
    /// As [`AxialSource::field_gradients`].
    pub fn jets(&self, points: &[Vector3<f64>], out: &mut Vec<Jet>) -> Result<(), Error> {
        out.clear();
        out.resize(points.len(), Jet::zero());
        self.placed().try_for_each(|(source, centre)| source.add_jets(centre.z, points, out))
    }

    /// Whether a point lies inside the material of one of the cylinders.
    #[must_use]
    pub fn contains(&self, point: &Vector3<f64>) -> bool {
        self.placed().any(|(source, centre)| source.contains(&(point - centre)))
    }

    /// Distance from a point to the nearest cylinder, m; 0 inside.
    #[must_use]
    pub fn distance(&self, point: &Vector3<f64>) -> f64 {
        self.placed().map(|(source, centre)| source.distance(&(point - centre))).fold(f64::INFINITY, f64::min)
    }

    /// Magnetic moment along the axis, A m2.
    #[must_use]
    pub fn moment(&self) -> f64 {
        self.sources.iter().map(AxialSource::moment).sum()
    }

    /// The outlines of the cylinders, each with its centre, m.
    pub fn outlines(&self) -> impl Iterator<Item = (Outline, Vector3<f64>)> {
        self.placed().map(|(source, centre)| (source.outline(), centre))
    }

    /// The sources, each with its centre, m.
    pub(super) fn placed(&self) -> impl Iterator<Item = (&AxialSource, Vector3<f64>)> {
        self.sources.iter().zip(&self.magnets).map(|(source, m)| (source, Vector3::new(0.0, 0.0, m.offset)))
    }
}
