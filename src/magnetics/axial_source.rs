//! One axially magnetised cylinder or ring: its exact field, and its multipoles far away.

use nalgebra::{Matrix3, Vector3};

use super::axisymmetric::{Components, Meridian};
use super::edge::{Edges, FIELD, GRADIENT, HESSIAN, NOTHING, POTENTIAL, SHEAR};
use super::jet::Jet;
use super::multipole::{Multipole, TERMS};
use super::overlap::Outline;
use super::points::Edge;
use super::quantities::{MAGNET_INNER, MAGNET_LENGTH, MAGNET_OUTER, REMANENCE};
use crate::constants::VACUUM_PERMEABILITY;
use crate::error::Error;

/// Distance, relative to the extent `s = sqrt(a^2 + h^2)`, from which the multipoles are used: there the closed form of
/// `B_z` begins to lose digits (about `eps (r/a)^2 (r/h)`), and the degrees above 17 are below 1e-14.
const FAR: f64 = 6.0;

/// Largest coordinate of a point, m: beyond it, powers of the distance overflow.
pub(super) const FARTHEST: f64 = 1e9;

/// A cylinder or ring magnetised along its axis, centred at the origin of its frame, axis `z`, `mu_r = 1`.
///
/// The field is exact (relative error about 1e-14, 1e-12 in the worst case) everywhere except on the edges, where it is
/// singular:
///
/// - outside the material and in the bore it is the flux density `B`, with gradient and second derivative;
/// - inside the material it is `B` too (`H = B / mu_0 - M`), the field of the equivalent current sheets;
/// - on the curved surfaces (`rho` exactly the radius), where `B_z` jumps by the remanence, it is the mean of both
///   sides.
///
/// ```
/// use mcm::magnetics::AxialSource;
/// use nalgebra::Vector3;
/// let ring = AxialSource::new(0.75e-3, 2.0e-3, 1.0e-3, 1.35)?;
/// let (field, gradient) = ring.field_gradient(&Vector3::new(0.0, 0.0, 5.6691526387351639e-3))?;
/// assert!((field.z - 1.0516057758751352e-2).abs() < 1e-15);
/// assert!((gradient[(0, 0)] - 2.4380113373834331).abs() < 1e-12);
/// assert!(ring.field(&Vector3::new(2.0e-3, 0.0, 0.5e-3)).is_err()); // on the edge
/// # Ok::<(), mcm::error::Error>(())
/// ```
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct AxialSource {
    inner: f64,
    outer: f64,
    half: f64,
    remanence: f64,
    edges: SourceEdges,
    multipole: Multipole,
    /// Square of the distance from which the multipoles are used, m2.
    far2: f64,
}

/// A cylinder has two edges, a ring four.
#[derive(Debug, Clone, Copy, PartialEq)]
enum SourceEdges {
    Cylinder(Edges<2>),
    Ring(Edges<4>),
}

impl AxialSource {
    /// A source of the radii `inner` (0: a solid cylinder) and `outer`, the length along the axis (m) and the remanence
    /// (T).
    ///
    /// A negative remanence means magnetisation along `-z`.
    ///
    /// # Errors
    /// [`Error::Range`] naming the first quantity out of range.
    pub fn new(inner: f64, outer: f64, length: f64, remanence: f64) -> Result<Self, Error> {
        MAGNET_OUTER.check(outer)?;
        MAGNET_INNER.check_beside(inner, outer)?;
        MAGNET_LENGTH.check(length)?;
        REMANENCE.check(remanence)?;
        let half = 0.5 * length;
        let edges = if inner > 0.0 {
            SourceEdges::Ring(Edges {
                radius: [outer, outer, inner, inner],
                position: [-half, half, -half, half],
                strength: [remanence, -remanence, -remanence, remanence],
            })
        } else {
            SourceEdges::Cylinder(Edges {
                radius: [outer, outer],
                position: [-half, half],
                strength: [remanence, -remanence],
            })
        };
        let multipole = Multipole::new(inner, outer, half, remanence);
        let far2 = FAR * FAR * (outer * outer + half * half);
        Ok(Self { inner, outer, half, remanence, edges, multipole, far2 })
    }

    /// Flux density `B` (T) at a point (m).
    ///
    /// # Errors
    /// [`Error::OnEdge`] on an edge, [`Error::Range`] for a point that is not finite or beyond 1e9 m.
    pub fn field(&self, point: &Vector3<f64>) -> Result<Vector3<f64>, Error> {
        let (at, components) = self.components::<FIELD>(point)?;
        Ok(components.field(&at))
    }

    /// `B` (T) and its gradient `dB_i/dx_j` (T/m) at a point (m).
    ///
    /// # Errors
    /// As [`AxialSource::field`].
    pub fn field_gradient(&self, point: &Vector3<f64>) -> Result<(Vector3<f64>, Matrix3<f64>), Error> {
        let (at, components) = self.components::<GRADIENT>(point)?;
        Ok((components.field(&at), components.gradient(&at)))
    }

    /// `B`, its gradient and its second derivative at a point (m).
    ///
    /// # Errors
    /// As [`AxialSource::field`].
    pub fn jet(&self, point: &Vector3<f64>) -> Result<Jet, Error> {
        let (at, components) = self.components::<HESSIAN>(point)?;
        Ok(components.jet(&at))
    }

    /// The scalar potential `psi` (T m) and `B` (T) at a point (m); `B = -grad psi` outside the material.
    ///
    /// Everywhere `-grad psi` is `mu_0 H`, which `B` exceeds by the remanence inside the material. `psi` is the
    /// potential of the magnetic charges on the end faces.
    ///
    /// ```
    /// use mcm::magnetics::AxialSource;
    /// use nalgebra::Vector3;
    /// let disc = AxialSource::new(0.0, 2.0e-3, 1.0e-3, 1.35)?;
    /// let (above, _) = disc.potential_field(&Vector3::new(0.0, 0.0, 2.0e-3))?;
    /// // On the axis, a charged disc's potential is half the difference of the distances to its rim and centre.
    /// let end = |u: f64| 0.5 * 1.35 * (u.hypot(2.0e-3) - u);
    /// assert!((above / (end(1.5e-3) - end(2.5e-3)) - 1.0).abs() < 1e-14);
    /// # Ok::<(), mcm::error::Error>(())
    /// ```
    ///
    /// # Errors
    /// As [`AxialSource::field`].
    pub fn potential_field(&self, point: &Vector3<f64>) -> Result<(f64, Vector3<f64>), Error> {
        let (at, potential, components) = self.with_beside::<FIELD, POTENTIAL>(point)?;
        Ok((potential, components.field(&at)))
    }

    /// As [`AxialSource::potential_field`], with the gradient `dB_i/dx_j` (T/m).
    ///
    /// # Errors
    /// As [`AxialSource::field`].
    pub fn potential_field_gradient(
        &self,
        point: &Vector3<f64>,
    ) -> Result<(f64, Vector3<f64>, Matrix3<f64>), Error> {
        let (at, potential, components) = self.with_beside::<GRADIENT, POTENTIAL>(point)?;
        Ok((potential, components.field(&at), components.gradient(&at)))
    }

    /// `B` (T) at a point (m) by the axial multipoles up to an odd `degree`, from 1 (the dipole) to 17.
    ///
    /// It serves for comparison: [`AxialSource::field`] uses the closed form near the magnet, and far away as many
    /// multipoles as are needed.
    ///
    /// ```
    /// use mcm::magnetics::AxialSource;
    /// use nalgebra::Vector3;
    /// let ring = AxialSource::new(0.75e-3, 2.0e-3, 1.0e-3, 1.35)?;
    /// let next = Vector3::new(0.0, 0.0, 5.0e-3); // the next ring of the paper's manipulator
    /// let dipole = ring.multipole_field(&next, 1)?;
    /// assert!((dipole.z / ring.field(&next)?.z - 1.28).abs() < 0.01);
    /// # Ok::<(), mcm::error::Error>(())
    /// ```
    ///
    /// # Errors
    /// [`Error::Range`] for another degree, and for a point no further from the centre than the edges, where the series
    /// diverges.
    pub fn multipole_field(&self, point: &Vector3<f64>, degree: usize) -> Result<Vector3<f64>, Error> {
        let (at, components) = self.multipoles::<FIELD>(point, degree)?;
        Ok(components.field(&at))
    }

    /// As [`AxialSource::multipole_field`], with the gradient `dB_i/dx_j` (T/m).
    ///
    /// # Errors
    /// As [`AxialSource::multipole_field`].
    pub fn multipole_field_gradient(
        &self,
        point: &Vector3<f64>,
        degree: usize,
    ) -> Result<(Vector3<f64>, Matrix3<f64>), Error> {
        let (at, components) = self.multipoles::<GRADIENT>(point, degree)?;
        Ok((components.field(&at), components.gradient(&at)))
    }

    /// Whether a point lies inside the material (not on its surface).
    #[must_use]
    pub fn contains(&self, point: &Vector3<f64>) -> bool {
        let rho2 = point.x * point.x + point.y * point.y;
        let bore = self.inner > 0.0 && rho2 <= self.inner * self.inner;
        point.z.abs() < self.half && rho2 < self.outer * self.outer && !bore
    }

    /// Distance from a point to the material, m; 0 inside and on its surface.
    #[must_use]
    pub fn distance(&self, point: &Vector3<f64>) -> f64 {
        let rho = (point.x * point.x + point.y * point.y).sqrt();
        let across = (rho - self.outer).max(self.inner - rho).max(0.0);
        let along = (point.z.abs() - self.half).max(0.0);
        (across * across + along * along).sqrt()
    }

    /// Shape of the body, without its magnetisation.
    #[must_use]
    pub fn outline(&self) -> Outline {
        Outline::cylinder(self.inner, self.outer, self.length())
    }

    /// Inner radius, m; 0 for a solid cylinder.
    #[must_use]
    pub fn inner_radius(&self) -> f64 {
        self.inner
    }

    /// Outer radius, m.
    #[must_use]
    pub fn outer_radius(&self) -> f64 {
        self.outer
    }

    /// Length along the axis, m.
    #[must_use]
    pub fn length(&self) -> f64 {
        2.0 * self.half
    }

    /// Remanence along the axis, T.
    #[must_use]
    pub fn remanence(&self) -> f64 {
        self.remanence
    }

    /// Magnetic moment `B_r V / mu_0` along the axis, A m2.
    #[must_use]
    pub fn moment(&self) -> f64 {
        let area = core::f64::consts::PI * (self.outer - self.inner) * (self.outer + self.inner);
        self.remanence * area * self.length() / VACUUM_PERMEABILITY
    }

    /// Whether a point at the squared distance `r2` from the centre is near enough for the closed form.
    #[inline]
    pub(super) fn is_near(&self, r2: f64) -> bool {
        r2 <= self.far2
    }

    /// The multipoles.
    pub(super) fn multipole(&self) -> &Multipole {
        &self.multipole
    }

    /// Calls `function` with all edges.
    #[inline]
    pub(super) fn with_edges<T>(&self, function: impl FnOnce(&[Edge]) -> T) -> T {
        match &self.edges {
            SourceEdges::Cylinder(edges) => function(&edges.each()),
            SourceEdges::Ring(edges) => function(&edges.each()),
        }
    }

    fn multipoles<const ORDER: u8>(
        &self,
        point: &Vector3<f64>,
        degree: usize,
    ) -> Result<(Meridian, Components), Error> {
        if degree.is_multiple_of(2) || degree >= 2 * TERMS {
            return Err(Error::range("degree of the multipoles", degree as f64, "odd, from 1 to 17"));
        }
        let r2 = point.norm_squared();
        if !(r2 > self.outer * self.outer + self.half * self.half && r2 <= FARTHEST * FARTHEST) {
            let allowed = "greater than that of the edges and at most 1e9";
            return Err(Error::range("distance from the magnet's centre (m)", r2.sqrt(), allowed));
        }
        Ok((Meridian::of(point.x, point.y), self.multipole.sum::<ORDER>(point.z, r2, degree.div_ceil(2))))
    }

    /// The components up to the order `ORDER`, after the number beside them that `BESIDE` names, see [`super::edge`].
    #[inline]
    pub(super) fn with_beside<const ORDER: u8, const BESIDE: u8>(
        &self,
        point: &Vector3<f64>,
    ) -> Result<(Meridian, f64, Components), Error> {
        if !point.iter().all(|coordinate| coordinate.abs() <= FARTHEST) {
            return Err(refused(point));
        }
        let at = Meridian::of(point.x, point.y);
        let r2 = at.rho * at.rho + point.z * point.z;
        if r2 > self.far2 {
            let beside = match BESIDE {
                POTENTIAL => self.multipole.potential(point.z, r2),
                SHEAR => self.multipole.shear(point.z, r2),
                _ => 0.0,
            };
            return Ok((at, beside, self.multipole.components::<ORDER>(point.z, r2)));
        }

        let sum = match &self.edges {
            SourceEdges::Cylinder(edges) => edges.sum::<ORDER, BESIDE>(at.rho, point.z),
            SourceEdges::Ring(edges) => edges.sum::<ORDER, BESIDE>(at.rho, point.z),
        };
        match sum {
            Some((beside, components)) => Ok((at, beside, components)),
            None => Err(Error::OnEdge { x: point.x, y: point.y, z: point.z }),
        }
    }

    /// How much of a point is inside the material, as the field takes it: 1 inside, half on a curved surface, else 0.
    #[inline]
    pub(super) fn share_inside(&self, rho: f64, z: f64) -> f64 {
        if z.abs() >= self.half || rho > self.outer || rho < self.inner {
            return 0.0;
        }
        let is_on = |radius: f64| rho.to_bits() == radius.to_bits();
        if is_on(self.outer) || (self.inner > 0.0 && is_on(self.inner)) { 0.5 } else { 1.0 }
    }

    #[inline]
    pub(super) fn components<const ORDER: u8>(
        &self,
        point: &Vector3<f64>,
    ) -> Result<(Meridian, Components), Error> {
        let (at, _, components) = self.with_beside::<ORDER, NOTHING>(point)?;
        Ok((at, components))
    }
}

/// The error for a point that is not finite or too far away.
#[cold]
pub(super) fn refused(point: &Vector3<f64>) -> Error {
    let value = point.iter().copied().find(|c| c.is_nan()).unwrap_or_else(|| point.amax());
    Error::range("coordinate of a field point (m)", value, "finite and at most 1e9 in size")
}
