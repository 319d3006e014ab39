//! Fields of one magnet at many points.

use nalgebra::{Matrix3, Vector3};

use super::axial_source::AxialSource;
use super::axisymmetric::{Components, Meridian};
use super::edge::{FIELD, GRADIENT, HESSIAN, SHEAR};
use super::jet::Jet;
use super::multipole;
use super::points::{self, COMPONENTS, Origin, Row, WIDTH};
use crate::error::Error;

/// Smallest number of points for which the lanes pay; fewer are evaluated one by one.
const FEWEST: usize = 4;

/// Farthest point that is evaluated side by side with others, in extents of the magnet; the single point tells what is too
/// far.
const FARTHEST: f64 = 1e6;

/// Points that wait until the lanes are full.
#[derive(Debug)]
struct Waiting {
    /// Whether they are so far away that multipoles serve.
    far: bool,
    count: usize,
    numbers: [usize; WIDTH],
    at: [Meridian; WIDTH],
    rho: Row,
    z: Row,
}

impl AxialSource {
    /// `B` (T) and its gradient `dB_i/dx_j` (T/m) at many points (m), written to `out` in their order.
    ///
    /// Agrees with [`AxialSource::field_gradient`] at each point to 1e-12, in less than two thirds of the time: eight points are
    /// evaluated side by side, by the widest instructions that the processor has.
    ///
    /// ```
    /// use mcm::magnetics::AxialSource;
    /// use nalgebra::Vector3;
    /// let ring = AxialSource::new(0.75e-3, 2.0e-3, 1.0e-3, 1.35)?;
    /// let points: Vec<_> = (0..20).map(|i| Vector3::new(1e-4 * f64::from(i), 2e-3, 3e-3)).collect();
    /// let mut fields = Vec::new();
    /// ring.field_gradients(&points, &mut fields)?;
    /// let (field, _) = ring.field_gradient(&points[7])?;
    /// assert!((fields[7].0 - field).norm() < 1e-12 * field.norm());
    /// # Ok::<(), mcm::error::Error>(())
    /// ```
    ///
    /// # Errors
    /// As [`AxialSource::field`], for the first point in question; `out` is then incomplete.
    pub fn field_gradients(
        &self,
        points: &[Vector3<f64>],
        out: &mut Vec<(Vector3<f64>, Matrix3<f64>)>,
    ) -> Result<(), Error> {
        out.clear();
        out.resize(points.len(), (Vector3::zeros(), Matrix3::zeros()));
        self.add_field_gradients(0.0, points, out)
    }

    /// `B`, its gradient and its second derivative at many points (m), written to `out` in their order.
    ///
    /// # Errors
    /// As [`AxialSource::field_gradients`].
    pub fn jets(&self, points: &[Vector3<f64>], out: &mut Vec<Jet>) -> Result<(), Error> {
        out.clear();
        out.resize(points.len(), Jet::zero());
        self.add_jets(0.0, points, out)
    }

    /// Adds the field at `points`, seen from a frame in which the magnet's centre is at `height` on the axis.
    pub(super) fn add_fields(
        &self,
        height: f64,
        points: &[Vector3<f64>],
        out: &mut [Vector3<f64>],
    ) -> Result<(), Error> {
        self.each::<FIELD, false>(height, points, |number, at, (components, _)| {
            out[number] += components.field(at);
        })
    }

    /// Adds the field and its gradient at `points`, seen from a frame in which the magnet's centre is at `height` on the axis.
    pub(super) fn add_field_gradients(
        &self,
        height: f64,
        points: &[Vector3<f64>],
        out: &mut [(Vector3<f64>, Matrix3<f64>)],
    ) -> Result<(), Error> {
        self.each::<GRADIENT, false>(height, points, |number, at, (components, _)| {
            out[number].0 += components.field(at);
            out[number].1 += components.gradient(at);
        })
    }

    /// Adds field, gradient and second derivative at the points, for a body whose centre is at that height, m.
    pub(super) fn add_jets(
        &self,
        height: f64,
        points: &[Vector3<f64>],
        out: &mut [Jet],
    ) -> Result<(), Error> {
        self.each::<HESSIAN, false>(height, points, |number, at, (components, _)| {
            out[number] += components.jet(at);
        })
    }

    /// Hands the components at each point, by its number, to `put`; the magnet's centre is at `height` on the axis.
    ///
    /// Beside them is the shear (T/m2) of magnetisation across the axis, 0 unless `ACROSS`.
    pub(super) fn each<const ORDER: u8, const ACROSS: bool>(
        &self,
        height: f64,
        points: &[Vector3<f64>],
        mut put: impl FnMut(usize, &Meridian, (&Components, f64)),
    ) -> Result<(), Error> {
        if points.len() < FEWEST {
            for (number, point) in points.iter().enumerate() {
                let found = self.alone::<ORDER, ACROSS>(&Vector3::new(point.x, point.y, point.z - height));
                let (at, shear, components) = found.map_err(|error| error.at((*point).into()))?;
                put(number, &at, (&components, shear));
            }
            return Ok(());
        }
        self.side_by_side::<ORDER, ACROSS>(height, points, put)
    }

    /// The components at one point, with the shear if `ACROSS`.
    fn alone<const ORDER: u8, const ACROSS: bool>(
        &self,
        point: &Vector3<f64>,
    ) -> Result<(Meridian, f64, Components), Error> {
        if ACROSS {
            return self.with_beside::<ORDER, SHEAR>(point);
        }
        let (at, components) = self.components::<ORDER>(point)?;
        Ok((at, 0.0, components))
    }

    /// Evaluates points that fill the lanes side by side, and hands each to `put` by its number.
    fn side_by_side<const ORDER: u8, const ACROSS: bool>(
        &self,
        height: f64,
        points: &[Vector3<f64>],
        mut put: impl FnMut(usize, &Meridian, (&Components, f64)),
    ) -> Result<(), Error> {
        let (rows, at) = ([0.0; WIDTH], [Meridian::of(0.0, 0.0); WIDTH]);
        let lanes = |far| Waiting { far, count: 0, numbers: [0; WIDTH], at, rho: rows, z: rows };
        let (mut near, mut far) = (lanes(false), lanes(true));
        let farthest2 = FARTHEST * FARTHEST * self.outer_radius().powi(2);

        for (number, point) in points.iter().enumerate() {
            let rho2 = point.x * point.x + point.y * point.y;
            let z = point.z - height;
            let r2 = rho2 + z * z;
            let waiting = if self.is_near(r2) {
                &mut near
            } else if r2 <= farthest2 {
                &mut far
            } else {
                let (at, shear, components) =
                    self.alone::<ORDER, ACROSS>(&Vector3::new(point.x, point.y, z))?;
                put(number, &at, (&components, shear));
                continue;
            };

            let (lane, at) = (waiting.count, Meridian::of(point.x, point.y));
            (waiting.numbers[lane], waiting.at[lane]) = (number, at);
            (waiting.rho[lane], waiting.z[lane]) = (at.rho, z);
            waiting.count += 1;
            if waiting.count == WIDTH {
                self.flush::<ORDER, ACROSS>(waiting, height, points, &mut put)?;
            }
        }

        self.flush::<ORDER, ACROSS>(&mut near, height, points, &mut put)?;
        self.flush::<ORDER, ACROSS>(&mut far, height, points, &mut put)
    }

    /// Evaluates the waiting points.
    fn flush<const ORDER: u8, const ACROSS: bool>(
        &self,
        waiting: &mut Waiting,
        height: f64,
        points: &[Vector3<f64>],
        put: &mut impl FnMut(usize, &Meridian, (&Components, f64)),
    ) -> Result<(), Error> {
        let count = std::mem::take(&mut waiting.count);
        let Waiting { far, numbers, at, rho, z, .. } = waiting;
        let (mut rows, mut shear) = ([[0.0; WIDTH]; COMPONENTS], [0.0; WIDTH]);
        let together = count >= FEWEST && {
            rho.copy_within(0..WIDTH - count, count);
            z.copy_within(0..WIDTH - count, count);
            let mut kernel = |origin: &Origin<'_>| match (ORDER, ACROSS) {
                (HESSIAN, true) => points::jets_across(origin, rho, z, &mut rows, &mut shear),
                (_, true) => points::gradients_across(origin, rho, z, &mut rows, &mut shear),
                (HESSIAN, false) => points::jets(origin, rho, z, &mut rows),
                (_, false) => points::gradients(origin, rho, z, &mut rows),
            };
            if *far {
                kernel(&Origin::Multipole(self.multipole(), multipole::TERMS))
            } else {
                self.with_edges(|edges| kernel(&Origin::Edges { edges, rough: false }))
            }
        };

        for (lane, (number, at)) in numbers.iter().zip(at).enumerate().take(count) {
            if !together {
                let point = points[*number] - Vector3::new(0.0, 0.0, height);
                let found = self.alone::<ORDER, ACROSS>(&point);
                let (at, shear, components) = found.map_err(|error| error.at(points[*number].into()))?;
                put(*number, &at, (&components, shear));
                continue;
            }

            let [radial, axial, radial_dz, axial_dz, radial_dzz, axial_dzz, twist] =
                rows.each_ref().map(|row| row[lane]);
            let components = Components { radial, axial, radial_dz, axial_dz, radial_dzz, axial_dzz, twist };
            put(*number, at, (&components, shear[lane]));
        }
        Ok(())
    }
}
