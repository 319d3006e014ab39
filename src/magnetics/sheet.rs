//! Energy of dipoles in a plane, all perpendicular to it, in the field of a magnet: the sums that its derivatives need.

use multiversion::multiversion;
use nalgebra::{Matrix3, Vector2, Vector3};

use super::axial_source::AxialSource;
use super::edge::{GRADIENT, HESSIAN};
use super::lanes::Lanes;
use super::points::{self, COMPONENTS, Origin, Row, WIDTH};
use crate::geometry::Pose;

/// Dipoles at points of a plane, all perpendicular to it.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct DipoleSheet {
    octets: Vec<Octet>,
}

/// Eight dipoles: positions in the plane (m) and moments (A m2). Those beyond the last one have no moment.
#[derive(Debug, Clone, Copy, PartialEq)]
struct Octet {
    x: Row,
    y: Row,
    moment: Row,
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

/// Sums over the dipoles of a sheet, in the axes of the magnet; `G` is the gradient of the field (T/m).
#[derive(Debug, Clone, PartialEq)]
pub struct SheetSums {
    /// Sum of moment times field, J.
    pub field: Vector3<f64>,
    /// Sums of moment times `G n`, weighted with 1, x, y, for the plane's normal `n`.
    pub force: [Vector3<f64>; 3],
    /// What the second derivatives need; zero unless asked for.
    pub second: SecondSums,
}

/// Sums for the second derivatives of the energy.
#[derive(Debug, Clone, PartialEq)]
pub struct SecondSums {
    /// Sums of moment times `G`, weighted with 1, x, y.
    pub gradient: [Matrix3<f64>; 3],
    /// Sums of moment times the second derivative of the field's component along `n`, weighted with 1, x, y, xx, xy,
    /// yy.
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

    /// The dipoles: positions (m) and moments (A m2).
    fn each(&self) -> impl Iterator<Item = (Vector2<f64>, f64)> + '_ {
        self.octets
            .iter()
            .flat_map(|octet| (0..WIDTH).map(|i| (Vector2::new(octet.x[i], octet.y[i]), octet.moment[i])))
    }
}

/// Sums by lane: of the field, and of the force weighted with 1, x and y.
#[derive(Debug)]
struct Slopes {
    field: [Row; 3],
    force: [[Row; 3]; 3],
}

/// Sums by lane: of the field, of the gradient weighted with 1, x and y, and of the second derivative weighted with 1, x, y,
/// xx, xy and yy; matrices as xx, xy, xz, yy, yz, zz.
#[derive(Debug)]
struct Curvatures {
    field: [Row; 3],
    gradient: [[Row; 6]; 3],
    along: [[Row; 6]; 6],
}

/// A sheet's place: its origin, its first two axes and its normal, in the frame of the magnet.
type Place = [[f64; 3]; 4];

/// Inner radius (negative without a bore), outer radius and half length, m.
type Body = [f64; 3];

/// What must not be negative, by lane: how far the points are from the edges, see [`points::components`], and their signed
/// distance from the magnet's surface (m).
type Least = [Row; 2];

impl AxialSource {
    /// Sums over the dipoles of a sheet whose frame is at `pose` (third axis: the normal) in the frame of this magnet;
    /// `second` tells whether second derivatives are asked for. `None` inside the magnet and on its edges.
    ///
    /// ```
    /// use mcm::geometry::Pose;
    /// use mcm::magnetics::{AxialSource, DipoleSheet, FieldAccuracy};
    /// use nalgebra::{Vector2, Vector3};
    /// let ring = AxialSource::new(0.75e-3, 2.0e-3, 1.0e-3, 1.35)?;
    /// let sheet = DipoleSheet::new(&[(Vector2::new(1e-3, 0.0), 2e-6), (Vector2::new(0.0, -1e-3), 1e-6)]);
    /// let sums = ring.on_sheet(&sheet, &Pose::identity().advanced(3e-3), FieldAccuracy::Exact, false);
    /// let expected = ring.field(&Vector3::new(1e-3, 0.0, 3e-3))? * 2e-6
    ///     + ring.field(&Vector3::new(0.0, -1e-3, 3e-3))? * 1e-6;
    /// assert!(sums.is_some_and(|sums| (sums.field - expected).norm() < 1e-12 * expected.norm()));
    /// # Ok::<(), mcm::error::Error>(())
    /// ```
    #[must_use]
    pub fn on_sheet(
        &self,
        sheet: &DipoleSheet,
        pose: &Pose,
        accuracy: FieldAccuracy,
        second: bool,
    ) -> Option<SheetSums> {
        if let FieldAccuracy::Multipoles(terms) = accuracy {
            let (_, sums) = self.sum_sheet(&Origin::Multipole(self.multipole(), terms), sheet, pose, second);
            return Some(sums);
        }
        let rough = accuracy == FieldAccuracy::Rough;
        for rough in [true, false].into_iter().skip(usize::from(!rough)) {
            let ([apart, gap], sums) =
                self.with_edges(|edges| self.sum_sheet(&Origin::Edges { edges, rough }, sheet, pose, second));
            if gap < 0.0 {
                return None;
            }
            if apart >= 0.0 {
                return Some(sums);
            }
        }
        self.sum_one_by_one(sheet, pose, second)
    }

    /// The least of both, see [`Least`], and the sums.
    fn sum_sheet(
        &self,
        origin: &Origin<'_>,
        sheet: &DipoleSheet,
        pose: &Pose,
        second: bool,
    ) -> ([f64; 2], SheetSums) {
        let column = |i: usize| pose.rotation.column(i).into_owned().into();
        let place = [pose.position.into(), column(0), column(1), column(2)];
        let bore = if self.inner_radius() > 0.0 { self.inner_radius() } else { -1.0 };
        let body = [bore, self.outer_radius(), 0.5 * self.length()];
        let mut least = [[f64::MAX; WIDTH]; 2];
        let mut sums = SheetSums::zero();
        let zero = [0.0; WIDTH];
        if second {
            let mut lanes = Curvatures { field: [zero; 3], gradient: [[zero; 6]; 3], along: [[zero; 6]; 6] };
            curvatures(origin, &body, &place, &sheet.octets, &mut lanes, &mut least);
            sums.field = vector(&lanes.field);
            sums.second.gradient = lanes.gradient.each_ref().map(symmetric);
            sums.second.along = lanes.along.each_ref().map(symmetric);
            sums.force = sums.second.gradient.each_ref().map(|gradient| gradient * pose.axis());
        } else {
            let mut lanes = Slopes { field: [zero; 3], force: [[zero; 3]; 3] };
            slopes(origin, &body, &place, &sheet.octets, &mut lanes, &mut least);
            sums.field = vector(&lanes.field);
            sums.force = lanes.force.each_ref().map(vector);
        }
        (least.map(|row| row.into_iter().fold(f64::INFINITY, smaller)), sums)
    }

    /// The sums where a point is close to an edge.
    #[cold]
    fn sum_one_by_one(&self, sheet: &DipoleSheet, pose: &Pose, second: bool) -> Option<SheetSums> {
        let axis = pose.axis();
        let mut sums = SheetSums::zero();
        for (position, moment) in sheet.each().filter(|(_, moment)| *moment != 0.0) {
            let point = pose.position + pose.rotation * Vector3::new(position.x, position.y, 0.0);
            let (x, y) = (position.x, position.y);
            let (field, gradient, along) = if second {
                let jet = self.jet(&point).ok()?;
                (jet.field, jet.gradient, jet.hessian_along(&axis))
            } else {
                let (field, gradient) = self.field_gradient(&point).ok()?;
                (field, gradient, Matrix3::zeros())
            };
            sums.field += field * moment;
            let weights = [1.0, x, y, x * x, x * y, y * y].map(|weight| weight * moment);
            for (number, weight) in weights.into_iter().enumerate().take(3) {
                sums.force[number] += gradient * axis * weight;
                sums.second.gradient[number] += gradient * weight;
            }
            sums.second.along.iter_mut().zip(weights).for_each(|(sum, weight)| *sum += along * weight);
        }
        Some(sums)
    }
}

impl SheetSums {
    /// No dipoles.
    #[must_use]
    pub fn zero() -> Self {
        let second = SecondSums { gradient: [Matrix3::zeros(); 3], along: [Matrix3::zeros(); 6] };
        Self { field: Vector3::zeros(), force: [Vector3::zeros(); 3], second }
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

/// A point of each lane, in the frame of the magnet.
struct Points {
    x: Lanes<WIDTH>,
    y: Lanes<WIDTH>,
    rho2: Lanes<WIDTH>,
}

/// Places eight dipoles and evaluates the field's components there.
#[expect(clippy::inline_always, reason = "compiled for several processors")]
#[inline(always)]
fn evaluate<const ORDER: u8>(
    origin: &Origin<'_>,
    [inner, outer, half]: &Body,
    [at, d1, d2, _]: &Place,
    octet: &Octet,
    parts: &mut [Row; COMPONENTS],
    [apart, gap]: &mut Least,
) -> Points {
    let (px, py) = (Lanes(octet.x), Lanes(octet.y));
    let [x, y, z] = core::array::from_fn(|i| px * d1[i] + py * d2[i] + at[i]);
    let rho2 = x.squared() + y.squared();
    let rho = rho2.sqrt();
    let across = (rho - *outer).max(*inner - rho);
    *gap = (z.map(f64::abs) - *half).max(across).min(Lanes(*gap)).0;
    points::components::<ORDER>(origin, &rho.0, &z.0, parts, apart);
    Points { x, y, rho2 }
}

/// Adds a weighted value to a sum.
#[expect(clippy::inline_always, reason = "compiled for several processors")]
#[inline(always)]
fn add(sum: &mut Row, weight: Lanes<WIDTH>, value: &Row) {
    *sum = (Lanes(*sum) + weight * Lanes(*value)).0;
}

/// Adds a weighted matrix to a sum. Neither here nor where it is called is there a loop over matrices or their entries: the
/// compiler would put those side by side instead of the points.
#[expect(clippy::inline_always, reason = "compiled for several processors")]
#[inline(always)]
fn add_matrix([xx, xy, xz, yy, yz, zz]: &mut [Row; 6], weight: Lanes<WIDTH>, value: &[Row; 6]) {
    add(xx, weight, &value[0]);
    add(xy, weight, &value[1]);
    add(xz, weight, &value[2]);
    add(yy, weight, &value[3]);
    add(yz, weight, &value[4]);
    add(zz, weight, &value[5]);
}

/// Adds to the sums for first derivatives.
#[multiversion(targets("x86_64+avx+avx2+avx512f+avx512dq+avx512vl", "x86_64+avx+avx2"))]
fn slopes(
    origin: &Origin<'_>,
    body: &Body,
    place: &Place,
    octets: &[Octet],
    sums: &mut Slopes,
    least: &mut Least,
) {
    let normal = &place[3];
    for octet in octets {
        let mut parts = [[0.0; WIDTH]; COMPONENTS];
        let Points { x, y, rho2 } = evaluate::<GRADIENT>(origin, body, place, octet, &mut parts, least);
        let [radial, axial, radial_dz, axial_dz, ..] = parts.map(Lanes);
        // The gradient across is `radial + x x shear`; on the axis, where `shear` has no limit here, the rest counts.
        let shear = (-1.0 * axial_dz - 2.0 * radial) / rho2.max(Lanes::all(f64::MIN_POSITIVE));
        let beside = x * normal[0] + y * normal[1];
        let turn = shear * beside + radial_dz * normal[2];
        let force = [
            (x * turn + radial * normal[0]).0,
            (y * turn + radial * normal[1]).0,
            (radial_dz * beside + axial_dz * normal[2]).0,
        ];
        let field = [(x * radial).0, (y * radial).0, axial.0];
        let moment = Lanes(octet.moment);
        for i in 0..3 {
            add(&mut sums.field[i], moment, &field[i]);
            add(&mut sums.force[0][i], moment, &force[i]);
            add(&mut sums.force[1][i], moment * Lanes(octet.x), &force[i]);
            add(&mut sums.force[2][i], moment * Lanes(octet.y), &force[i]);
        }
    }
}

/// Adds to the sums for second derivatives.
#[multiversion(targets("x86_64+avx+avx2+avx512f+avx512dq+avx512vl", "x86_64+avx+avx2"))]
fn curvatures(
    origin: &Origin<'_>,
    body: &Body,
    place: &Place,
    octets: &[Octet],
    sums: &mut Curvatures,
    least: &mut Least,
) {
    let [nx, ny, nz] = place[3];
    for octet in octets {
        let mut parts = [[0.0; WIDTH]; COMPONENTS];
        let Points { x, y, rho2 } = evaluate::<HESSIAN>(origin, body, place, octet, &mut parts, least);
        let [radial, axial, radial_dz, axial_dz, radial_dzz, axial_dzz, twist] = parts.map(Lanes);
        let (x2, y2, xy) = (x.squared(), y.squared(), x * y);
        let field = [(x * radial).0, (y * radial).0, axial.0];
        let gradient = [
            (radial - x2 * twist).0,
            (-1.0 * xy * twist).0,
            (x * radial_dz).0,
            (radial - y2 * twist).0,
            (y * radial_dz).0,
            axial_dz.0,
        ];
        // The second derivative, by cos^2, sin^2 and their product over the distance from the axis.
        let inverse = 1.0 / rho2.max(Lanes::all(f64::MIN_POSITIVE));
        let (s2, cs) = (y2 * inverse, xy * inverse);
        let c2 = 1.0 - s2; // also on the axis, where the azimuth is arbitrary
        let (zrr, rrr) = (-1.0 * axial_dzz - radial_dz, twist - radial_dzz);
        let xxx = x * (c2 * rrr - 3.0 * s2 * twist);
        let xxy = y * (c2 * rrr - (s2 - 2.0 * c2) * twist);
        let xyy = x * (s2 * rrr - (c2 - 2.0 * s2) * twist);
        let yyy = y * (s2 * rrr - 3.0 * c2 * twist);
        let (xxz, yyz) = (c2 * zrr + s2 * radial_dz, s2 * zrr + c2 * radial_dz);
        let (xyz, xzz, yzz) = (cs * (zrr - radial_dz), x * radial_dzz, y * radial_dzz);
        let along = [
            (nx * xxx + ny * xxy + nz * xxz).0,
            (nx * xxy + ny * xyy + nz * xyz).0,
            (nx * xxz + ny * xyz + nz * xzz).0,
            (nx * xyy + ny * yyy + nz * yyz).0,
            (nx * xyz + ny * yyz + nz * yzz).0,
            (nx * xzz + ny * yzz + nz * axial_dzz).0,
        ];
        let (px, py, moment) = (Lanes(octet.x), Lanes(octet.y), Lanes(octet.moment));
        let (by_x, by_y) = (moment * px, moment * py);
        let [of_x, of_y, of_z] = &mut sums.field;
        add(of_x, moment, &field[0]);
        add(of_y, moment, &field[1]);
        add(of_z, moment, &field[2]);
        add_matrix(&mut sums.gradient[0], moment, &gradient);
        add_matrix(&mut sums.gradient[1], by_x, &gradient);
        add_matrix(&mut sums.gradient[2], by_y, &gradient);
        add_matrix(&mut sums.along[0], moment, &along);
        add_matrix(&mut sums.along[1], by_x, &along);
        add_matrix(&mut sums.along[2], by_y, &along);
        add_matrix(&mut sums.along[3], by_x * px, &along);
        add_matrix(&mut sums.along[4], by_x * py, &along);
        add_matrix(&mut sums.along[5], by_y * py, &along);
    }
}
