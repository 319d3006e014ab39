//! Energy of dipoles in a plane, all perpendicular to it, in the field of a magnet: the sums that its derivatives need.

use nalgebra::{Matrix3, Vector2, Vector3};

use super::axial_source::AxialSource;
use super::multipole;
use super::points::{Origin, Row, WIDTH};
use super::sheet_lanes::{Body, Curvatures, Least, Octet, Place, Slopes, curvatures, slopes};
use crate::geometry::Pose;

/// Dipoles at points of a plane, all perpendicular to it.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct DipoleSheet {
    octets: Vec<Octet>,
}

/// How the field at a sheet is evaluated.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum FieldAccuracy {
    /// Relative error 1e-12.
    Exact,
    /// Relative error 1e-8, except close to edges, where it is smaller.
    Rough,
    /// By so many multipoles, 1 to 9.
    Multipoles(usize),
}

/// Error of the gradient by multipoles up to the degree `2 n - 1`, times `(r / s)^(2 n)` at the distance `r` from a magnet of
/// the extent `s` (measured: 6 to 8).
const MULTIPOLE_ERROR: f64 = 8.0;

impl FieldAccuracy {
    /// The fewest multipoles whose gradient has at most the relative error `allowed` where the square of a magnet's extent
    /// over the distance from its centre is at most `ratio2`; `None` where more than nine would be needed.
    pub(crate) fn far(ratio2: f64, allowed: f64) -> Option<Self> {
        let mut error = MULTIPOLE_ERROR;
        let enough = |_: &usize| {
            error *= ratio2;
            error <= allowed
        };
        (1..=multipole::TERMS).find(enough).map(Self::Multipoles)
    }
}

/// Sums over the dipoles of a sheet for the first derivatives of their energy, in the axes of the magnet.
#[derive(Debug, Clone, PartialEq)]
pub struct SheetSums {
    /// Sum of moment times field, J.
    pub field: Vector3<f64>,
    /// Sums of moment times the gradient of the field (T/m) times the plane's normal, weighted with 1, x, y.
    pub force: [Vector3<f64>; 3],
}

/// Sums over the dipoles of a sheet for the second derivatives of their energy, in the axes of the magnet.
#[derive(Debug, Clone, PartialEq)]
pub struct SecondSums {
    /// Sum of moment times field, J.
    pub field: Vector3<f64>,
    /// Sums of moment times the gradient of the field (T/m), weighted with 1, x, y.
    pub gradient: [Matrix3<f64>; 3],
    /// Sums of moment times the second derivative of the field's component along the plane's normal, weighted with 1, x, y,
    /// xx, xy, yy.
    pub along: [Matrix3<f64>; 6],
}

impl DipoleSheet {
    /// Dipoles at these positions (m) with these moments (A m2).
    #[must_use]
    pub fn new(dipoles: &[(Vector2<f64>, f64)]) -> Self {
        let octets = dipoles.chunks(WIDTH).map(|own| {
            let [mut x, mut y, mut moment] = [[0.0; WIDTH]; 3];
            for lane in 0..WIDTH {
                // The rest repeats the last point, where there is a field.
                let (position, own_moment) = own[lane.min(own.len() - 1)];
                (x[lane], y[lane]) = (position.x, position.y);
                moment[lane] = if lane < own.len() { own_moment } else { 0.0 };
            }
            Octet { x, y, moment }
        });
        Self { octets: octets.collect() }
    }

    /// The dipoles of a sheet at `pose`: positions in its plane and in space (m), moments (A m2).
    pub(crate) fn placed<'a>(
        &'a self,
        pose: &'a Pose,
    ) -> impl Iterator<Item = (Vector2<f64>, Vector3<f64>, f64)> + 'a {
        let each = self
            .octets
            .iter()
            .flat_map(|octet| (0..WIDTH).map(|i| [octet.x[i], octet.y[i], octet.moment[i]]));
        each.filter(|[.., moment]| *moment != 0.0).map(|[x, y, moment]| {
            let point = pose.position + pose.rotation * Vector3::new(x, y, 0.0);
            (Vector2::new(x, y), point, moment)
        })
    }
}

impl AxialSource {
    /// Sums over the dipoles of a sheet whose frame is at `pose` (third axis: the normal) in the frame of this magnet.
    /// `None` inside the magnet and on its edges.
    ///
    /// ```
    /// use mcm::geometry::Pose;
    /// use mcm::magnetics::{AxialSource, DipoleSheet, FieldAccuracy};
    /// use nalgebra::{Vector2, Vector3};
    /// let ring = AxialSource::new(0.75e-3, 2.0e-3, 1.0e-3, 1.35)?;
    /// let sheet = DipoleSheet::new(&[(Vector2::new(1e-3, 0.0), 2e-6), (Vector2::new(0.0, -1e-3), 1e-6)]);
    /// let sums = ring.on_sheet(&sheet, &Pose::identity().advanced(3e-3), FieldAccuracy::Exact);
    /// let expected = ring.field(&Vector3::new(1e-3, 0.0, 3e-3))? * 2e-6
    ///     + ring.field(&Vector3::new(0.0, -1e-3, 3e-3))? * 1e-6;
    /// assert!(sums.is_some_and(|sums| (sums.field - expected).norm() < 1e-12 * expected.norm()));
    /// # Ok::<(), mcm::error::Error>(())
    /// ```
    #[must_use]
    pub fn on_sheet(&self, sheet: &DipoleSheet, pose: &Pose, accuracy: FieldAccuracy) -> Option<SheetSums> {
        self.sum(sheet, pose, accuracy)
    }

    /// Sums of the second derivatives of the field over the dipoles of a sheet.
    #[must_use]
    pub fn second_on_sheet(
        &self,
        sheet: &DipoleSheet,
        pose: &Pose,
        accuracy: FieldAccuracy,
    ) -> Option<SecondSums> {
        self.sum(sheet, pose, accuracy)
    }

    fn sum<S: Sums>(&self, sheet: &DipoleSheet, pose: &Pose, accuracy: FieldAccuracy) -> Option<S> {
        if let FieldAccuracy::Multipoles(terms) = accuracy {
            let (_, sums) = self.sum_from(&Origin::Multipole(self.multipole(), terms), sheet, pose);
            return Some(sums);
        }
        let rough = accuracy == FieldAccuracy::Rough;
        for rough in [true, false].into_iter().skip(usize::from(!rough)) {
            let ([apart, gap], sums) =
                self.with_edges(|edges| self.sum_from(&Origin::Edges { edges, rough }, sheet, pose));
            if gap < 0.0 {
                return None;
            }
            if apart >= 0.0 {
                return Some(sums);
            }
        }
        S::one_by_one(self, sheet, pose)
    }

    /// The least of both, see [`Least`], and the sums.
    fn sum_from<S: Sums>(&self, origin: &Origin<'_>, sheet: &DipoleSheet, pose: &Pose) -> ([f64; 2], S) {
        let column = |i: usize| pose.rotation.column(i).into_owned().into();
        let place = [pose.position.into(), column(0), column(1), column(2)];
        let bore = if self.inner_radius() > 0.0 { self.inner_radius() } else { -1.0 };
        let body = [bore, self.outer_radius(), 0.5 * self.length()];
        let mut least = [[f64::MAX; WIDTH]; 2];
        let sums = S::eight_by_eight(&PlacedSheet { origin, body, place, octets: &sheet.octets }, &mut least);
        (least.map(|row| row.into_iter().fold(f64::INFINITY, smaller)), sums)
    }
}

/// A sheet in the frame of a magnet, and where the field comes from.
struct PlacedSheet<'a> {
    origin: &'a Origin<'a>,
    body: Body,
    place: Place,
    octets: &'a [Octet],
}

/// Sums over the dipoles of a sheet.
trait Sums: Sized {
    /// The sums by lanes.
    fn eight_by_eight(sheet: &PlacedSheet<'_>, least: &mut Least) -> Self;

    /// The sums point by point, where one is close to an edge; `None` on an edge.
    fn one_by_one(source: &AxialSource, sheet: &DipoleSheet, pose: &Pose) -> Option<Self>;
}

impl Sums for SheetSums {
    fn eight_by_eight(sheet: &PlacedSheet<'_>, least: &mut Least) -> Self {
        let zero = [0.0; WIDTH];
        let mut lanes = Slopes { field: [zero; 3], force: [[zero; 3]; 3] };
        slopes(sheet.origin, &sheet.body, &sheet.place, sheet.octets, &mut lanes, least);
        Self { field: vector(&lanes.field), force: lanes.force.each_ref().map(vector) }
    }

    #[cold]
    fn one_by_one(source: &AxialSource, sheet: &DipoleSheet, pose: &Pose) -> Option<Self> {
        let mut sums = Self { field: Vector3::zeros(), force: [Vector3::zeros(); 3] };
        for (position, point, moment) in sheet.placed(pose) {
            let (field, gradient) = source.field_gradient(&point).ok()?;
            sums.field += field * moment;
            for (sum, weight) in sums.force.iter_mut().zip([1.0, position.x, position.y]) {
                *sum += gradient * pose.axis() * (weight * moment);
            }
        }
        Some(sums)
    }
}

impl Sums for SecondSums {
    fn eight_by_eight(sheet: &PlacedSheet<'_>, least: &mut Least) -> Self {
        let zero = [0.0; WIDTH];
        let mut lanes = Curvatures { field: [zero; 3], gradient: [[zero; 6]; 3], along: [[zero; 6]; 6] };
        curvatures(sheet.origin, &sheet.body, &sheet.place, sheet.octets, &mut lanes, least);
        Self {
            field: vector(&lanes.field),
            gradient: lanes.gradient.each_ref().map(symmetric),
            along: lanes.along.each_ref().map(symmetric),
        }
    }

    #[cold]
    fn one_by_one(source: &AxialSource, sheet: &DipoleSheet, pose: &Pose) -> Option<Self> {
        let (none, zero) = (Vector3::zeros(), Matrix3::zeros());
        let mut sums = Self { field: none, gradient: [zero; 3], along: [zero; 6] };
        for (position, point, moment) in sheet.placed(pose) {
            let jet = source.jet(&point).ok()?;
            sums.field += jet.field * moment;
            let (x, y, along) = (position.x, position.y, jet.hessian_along(&pose.axis()));
            let weights = [1.0, x, y, x * x, x * y, y * y].map(|weight| weight * moment);
            sums.gradient.iter_mut().zip(weights).for_each(|(sum, weight)| *sum += jet.gradient * weight);
            sums.along.iter_mut().zip(weights).for_each(|(sum, weight)| *sum += along * weight);
        }
        Some(sums)
    }
}

fn vector(rows: &[Row; 3]) -> Vector3<f64> {
    Vector3::from(rows.each_ref().map(total))
}

/// A symmetric matrix from xx, xy, xz, yy, yz, zz.
fn symmetric(rows: &[Row; 6]) -> Matrix3<f64> {
    let [xx, xy, xz, yy, yz, zz] = rows.each_ref().map(total);
    Matrix3::new(xx, xy, xz, xy, yy, yz, xz, yz, zz)
}

/// The sum of a row, in pairs.
fn total([a, b, c, d, e, f, g, h]: &Row) -> f64 {
    ((a + e) + (c + g)) + ((b + f) + (d + h))
}

/// The smaller one, or NaN.
fn smaller(a: f64, b: f64) -> f64 {
    if a <= b { a } else { b }
}
