//! Sums over the dipoles of a sheet, eight side by side: places them, evaluates the field and adds it up in one go.

#![expect(clippy::inline_always, reason = "these functions are compiled for several processors")]

use super::edge::{GRADIENT, HESSIAN};
use super::lanes::Lanes;
use super::points::{self, COMPONENTS, Origin, Row, WIDTH};
use crate::numerics::processor::for_each_processor;

/// Eight dipoles: positions in the plane (m) and moments (A m2). Those beyond the last one have no moment.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Octet {
    pub(super) x: Row,
    pub(super) y: Row,
    pub(super) moment: Row,
}

/// Sums by lane: of the field, and of the force weighted with 1, x and y.
#[derive(Debug)]
pub(super) struct Slopes {
    pub(super) field: [Row; 3],
    pub(super) force: [[Row; 3]; 3],
}

/// Sums by lane: of the field, of the gradient weighted with 1, x and y, and of the second derivative weighted with 1, x, y,
/// xx, xy and yy; matrices as xx, xy, xz, yy, yz, zz.
#[derive(Debug)]
pub(super) struct Curvatures {
    pub(super) field: [Row; 3],
    pub(super) gradient: [[Row; 6]; 3],
    pub(super) along: [[Row; 6]; 6],
}

/// A sheet's place: its origin, its first two axes and its normal, in the frame of the magnet.
pub(super) type Place = [[f64; 3]; 4];

/// Inner radius (negative without a bore), outer radius and half length, m.
pub(super) type Body = [f64; 3];

/// What must not be negative, by lane: how far the points are from the edges, see [`points::components`], and their signed
/// distance from the magnet's surface (m).
pub(super) type Least = [Row; 2];

/// A point of each lane, in the frame of the magnet.
struct Points {
    x: Lanes<WIDTH>,
    y: Lanes<WIDTH>,
    rho2: Lanes<WIDTH>,
}

/// Places eight dipoles and evaluates the field's components there.
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
#[inline(always)]
fn add(sum: &mut Row, weight: Lanes<WIDTH>, value: &Row) {
    *sum = (Lanes(*sum) + weight * Lanes(*value)).0;
}

/// Adds a weighted matrix to a sum. Neither here nor where it is called is there a loop over matrices or their entries: the
/// compiler would put those side by side instead of the points.
#[inline(always)]
fn add_matrix([xx, xy, xz, yy, yz, zz]: &mut [Row; 6], weight: Lanes<WIDTH>, value: &[Row; 6]) {
    add(xx, weight, &value[0]);
    add(xy, weight, &value[1]);
    add(xz, weight, &value[2]);
    add(yy, weight, &value[3]);
    add(yz, weight, &value[4]);
    add(zz, weight, &value[5]);
}

for_each_processor! {
    /// Adds to the sums for first derivatives.
    pub(super) fn slopes(
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
}

for_each_processor! {
    /// Adds to the sums for second derivatives.
    pub(super) fn curvatures(
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
}
