//! Field sources that move as one body: coaxial magnetised cylinders, or a coil.

use core::fmt;

use nalgebra::{Matrix3, Vector3};

use super::axial_source::AxialSource;
use super::axisymmetric::{Components, Meridian};
use super::coil::Coil;
use super::edge::{FIELD, GRADIENT, HESSIAN};
use super::iron_core::IronCore;
use super::jet::Jet;
use super::overlap::{Outline, depth};
use super::quantities::OFFSET;
use super::winding::Winding;
use crate::error::Error;
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

/// A checked assembly of coaxial cylinders, or a coil; its frame's third axis is the common axis.
///
/// Its cylinders may touch but not overlap. All fields are in the assembly's frame and add up; see [`AxialSource`] for
/// their values inside the material and on its surface. The fields of a coil are those of one ampere.
#[derive(Debug, Clone, PartialEq)]
pub struct Assembly {
    bodies: Bodies,
    sources: Vec<AxialSource>,
}

/// What an assembly consists of.
#[derive(Debug, Clone, PartialEq)]
enum Bodies {
    /// Cylinders, each with the source of the same number.
    Magnets(Vec<AxialMagnet>),
    /// A coil without iron; the assembly has no sources of its own.
    Winding(Coil, Box<Winding>),
    /// A coil with an iron core, and the outline of both; the assembly has no sources of its own.
    Iron(Coil, IronCore, Box<AxialSource>),
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
        for (number, magnet) in (1..).zip(&magnets) {
            let AxialMagnet { inner_radius, radius, length, offset, remanence } = *magnet;
            let source =
                OFFSET.check(offset).and_then(|_| AxialSource::new(inner_radius, radius, length, remanence));
            sources.push(source.map_err(|error| error.of_item(number))?);
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
        Ok(Self { bodies: Bodies::Magnets(magnets), sources })
    }

    /// The field source of a coil.
    ///
    /// Its winding is a stack of thin solenoids at the Gauss points of its thickness, each of which has the field of a cylinder
    /// magnetised along its axis. As many are taken as the nearest point needs, which leaves less than 1e-10 of the field farther
    /// from the winding than a quarter of half its thickness.
    ///
    /// ```
    /// use mcm::magnetics::{Assembly, Coil};
    /// use nalgebra::Vector3;
    /// let coil = Coil { inner_radius: 20e-3, outer_radius: 40e-3, length: 60e-3, turns: 600.0, core: None };
    /// let field = Assembly::of_coil(coil)?.field(&Vector3::zeros())?; // T/A
    /// // In the middle: mu_0 N / (2 (b - a)) ln((b + sqrt(b^2 + h^2)) / (a + sqrt(a^2 + h^2))), h half the length.
    /// let end = |r: f64| r + r.hypot(30e-3);
    /// let expected = 4e-7 * std::f64::consts::PI * 600.0 / (2.0 * 20e-3) * (end(40e-3) / end(20e-3)).ln();
    /// assert!((field.z / expected - 1.0).abs() < 1e-10);
    /// # Ok::<(), mcm::error::Error>(())
    /// ```
    ///
    /// With a core it has the field of that; core and winding are one body, and no part of the device may come into the sphere
    /// in which the multipoles say nothing.
    ///
    /// # Errors
    /// [`Error::Range`] naming the first dimension out of range.
    pub fn of_coil(coil: Coil) -> Result<Self, Error> {
        let coil = coil.checked()?;
        let bodies = match coil.core {
            Some(core) => {
                let outline = AxialSource::new(0.0, coil.outer_radius, coil.length, 0.0)?;
                Bodies::Iron(coil, core, Box::new(outline))
            }
            None => Bodies::Winding(coil, Box::new(Winding::new(&coil)?)),
        };
        Ok(Self { bodies, sources: Vec::new() })
    }

    /// The magnetised cylinders; none for a coil.
    #[must_use]
    pub fn magnets(&self) -> &[AxialMagnet] {
        if let Bodies::Magnets(magnets) = &self.bodies { magnets } else { &[] }
    }

    /// All numbers that it is made from.
    pub(crate) fn made_from(&self) -> impl fmt::Debug {
        (self.magnets(), self.coil())
    }

    /// The coil that it is; `None` for magnets.
    #[must_use]
    pub fn coil(&self) -> Option<&Coil> {
        match &self.bodies {
            Bodies::Magnets(_) => None,
            Bodies::Winding(coil, _) | Bodies::Iron(coil, ..) => Some(coil),
        }
    }

    /// Radius of the sphere about the centre in which the multipoles of an iron core say nothing, m; `None` without one.
    #[must_use]
    pub fn reach(&self) -> Option<f64> {
        self.core().map(|core| core.reach)
    }

    fn core(&self) -> Option<&IronCore> {
        if let Bodies::Iron(_, core, _) = &self.bodies { Some(core) } else { None }
    }

    /// Flux density `B` (T) at a point (m).
    ///
    /// # Errors
    /// As [`AxialSource::field`]; [`Error::Range`] for a point where the multipoles of a core say nothing.
    pub fn field(&self, point: &Vector3<f64>) -> Result<Vector3<f64>, Error> {
        if let Some((at, components)) = self.coil_components::<FIELD>(point)? {
            return Ok(components.field(&at));
        }
        let mut sum = Vector3::zeros();
        for (source, centre) in self.placed(core::slice::from_ref(point)) {
            sum += source.field(&(point - centre)).map_err(|error| error.at((*point).into()))?;
        }
        Ok(sum)
    }

    /// `B` (T) and its gradient `dB_i/dx_j` (T/m) at a point (m).
    ///
    /// # Errors
    /// As [`AxialSource::field`].
    pub fn field_gradient(&self, point: &Vector3<f64>) -> Result<(Vector3<f64>, Matrix3<f64>), Error> {
        if let Some((at, components)) = self.coil_components::<GRADIENT>(point)? {
            return Ok((components.field(&at), components.gradient(&at)));
        }
        let mut sum = (Vector3::zeros(), Matrix3::zeros());
        for (source, centre) in self.placed(core::slice::from_ref(point)) {
            let (field, gradient) =
                source.field_gradient(&(point - centre)).map_err(|error| error.at((*point).into()))?;
            sum.0 += field;
            sum.1 += gradient;
        }
        Ok(sum)
    }

    /// `B` (T) and its gradient `dB_i/dx_j` (T/m), in the world frame, at a point (m) of that frame, where the assembly has this pose.
    ///
    /// # Errors
    /// As [`AxialSource::field`].
    pub fn field_gradient_from(
        &self,
        pose: &Pose,
        point: &Vector3<f64>,
    ) -> Result<(Vector3<f64>, Matrix3<f64>), Error> {
        let turn = pose.rotation;
        let local = turn.tr_mul(&(point - pose.position));
        let (field, gradient) = self.field_gradient(&local).map_err(|error| error.at((*point).into()))?;
        Ok((turn * field, turn * gradient * turn.transpose()))
    }

    /// `B`, its gradient and its second derivative at a point (m).
    ///
    /// # Errors
    /// As [`AxialSource::field`].
    pub fn jet(&self, point: &Vector3<f64>) -> Result<Jet, Error> {
        if let Some((at, components)) = self.coil_components::<HESSIAN>(point)? {
            return Ok(components.jet(&at));
        }
        let mut sum = Jet::zero();
        for (source, centre) in self.placed(core::slice::from_ref(point)) {
            sum += source.jet(&(point - centre)).map_err(|error| error.at((*point).into()))?;
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
        if self.core().is_some() {
            return points.iter().zip(out).try_for_each(|(point, out)| {
                *out = self.field_gradient(point)?;
                Ok(())
            });
        }
        self.placed(points).try_for_each(|(source, centre)| source.add_field_gradients(centre.z, points, out))
    }

    /// `B`, its gradient and its second derivative at many points (m), written to `out` in their order.
    ///
    /// # Errors
    /// As [`AxialSource::field_gradients`].
    pub fn jets(&self, points: &[Vector3<f64>], out: &mut Vec<Jet>) -> Result<(), Error> {
        out.clear();
        out.resize(points.len(), Jet::zero());
        if self.core().is_some() {
            return points.iter().zip(out).try_for_each(|(point, out)| {
                *out = self.jet(point)?;
                Ok(())
            });
        }
        self.placed(points).try_for_each(|(source, centre)| source.add_jets(centre.z, points, out))
    }

    /// Whether a point lies inside the material of one of the cylinders, inside the winding, or inside the sphere in which the
    /// multipoles of a core say nothing.
    #[must_use]
    pub fn contains(&self, point: &Vector3<f64>) -> bool {
        if let Some(core) = self.core() {
            return point.norm_squared() < core.reach * core.reach;
        }
        self.solid().any(|(source, centre)| source.contains(&(point - centre)))
    }

    /// Distance from a point to what [`Assembly::contains`] it, m; 0 inside.
    #[must_use]
    pub fn distance(&self, point: &Vector3<f64>) -> f64 {
        if let Some(core) = self.core() {
            return (point.norm() - core.reach).max(0.0);
        }
        self.solid().map(|(source, centre)| source.distance(&(point - centre))).fold(f64::INFINITY, f64::min)
    }

    /// Magnetic moment along the axis, A m2; of a coil that of one ampere.
    #[must_use]
    pub fn moment(&self) -> f64 {
        let of_sources: f64 = self.placed(&[]).map(|(source, _)| source.moment()).sum();
        of_sources + self.core().map_or(0.0, IronCore::moment)
    }

    /// The outlines of the cylinders, or of the winding, each with its centre, m.
    pub fn outlines(&self) -> impl Iterator<Item = (Outline, Vector3<f64>)> {
        self.solid().map(|(source, centre)| (source.outline(), centre))
    }

    /// The components of the field of a coil at a point; `None` for magnets, and where the sources are to be evaluated one by one.
    fn coil_components<const ORDER: u8>(
        &self,
        point: &Vector3<f64>,
    ) -> Result<Option<(Meridian, Components)>, Error> {
        match &self.bodies {
            Bodies::Magnets(_) => Ok(None),
            Bodies::Winding(_, winding) => Ok(winding.components::<ORDER>(point)),
            Bodies::Iron(_, core, _) => core.components::<ORDER>(point).map(Some),
        }
    }

    /// The sources that serve at all of `points`, each with its centre, m.
    pub(super) fn placed(
        &self,
        points: &[Vector3<f64>],
    ) -> impl Iterator<Item = (&AxialSource, Vector3<f64>)> {
        let chosen = match &self.bodies {
            Bodies::Magnets(_) | Bodies::Iron(..) => &self.sources[..],
            Bodies::Winding(_, winding) => winding.solenoids(points),
        };
        chosen.iter().enumerate().map(|(number, source)| (source, self.centre(number)))
    }

    /// The bodies that a point can be inside of, each with its centre, m.
    fn solid(&self) -> impl Iterator<Item = (&AxialSource, Vector3<f64>)> {
        let solid = match &self.bodies {
            Bodies::Magnets(_) => &self.sources[..],
            Bodies::Winding(_, winding) => core::slice::from_ref(&winding.body),
            Bodies::Iron(_, _, outline) => core::slice::from_ref(&**outline),
        };
        solid.iter().enumerate().map(|(number, source)| (source, self.centre(number)))
    }

    /// Centre of a source, m.
    fn centre(&self, number: usize) -> Vector3<f64> {
        Vector3::z() * self.magnets().get(number).map_or(0.0, |magnet| magnet.offset)
    }
}
