//! Energy and wrench of one magnet in the field of another one, by adaptive cubature over its charged faces.

use core::f64::consts::TAU;

use mcm::constants::VACUUM_PERMEABILITY;
use mcm::geometry::Pose;
use mcm::magnetics::{AxialSource, Wrench};
use mcm::numerics::quadrature::gauss_legendre;
use nalgebra::{SVector, Vector3};

/// Gauss nodes along each side of a panel.
const NODES: usize = 8;

/// Difference of a panel and its quarters at which these are good, relative to the size of the whole.
const SETTLED: f64 = 1e-10;

/// Energy (J), force (N), torque (N m).
type Sums = SVector<f64, 7>;

/// Energy (J) and wrench about its centre on `body` at `pose` in the frame of `source`.
pub(crate) fn by_faces(source: &AxialSource, body: &AxialSource, pose: &Pose) -> (f64, Wrench) {
    let charge = body.remanence() / VACUUM_PERMEABILITY;
    let rule = gauss_legendre(NODES);
    let mut total = Sums::zeros();
    for side in [-1.0, 1.0] {
        // By `s = rho^2` and the angle, with the area `ds dphi / 2`.
        let density = |s: f64, angle: f64| {
            let local =
                Vector3::new(s.sqrt() * angle.cos(), s.sqrt() * angle.sin(), side * 0.5 * body.length());
            let arm = pose.rotation * local;
            let (potential, field) = source.potential_field(&(pose.position + arm)).expect("outside");
            let (force, scale) = (field * (0.5 * side * charge), 0.5 * side * charge);
            let torque = arm.cross(&force);
            Sums::from_iterator(
                [scale * potential].into_iter().chain(force.iter().copied()).chain(torque.iter().copied()),
            )
        };
        let panel = |[s, t, from, to]: [f64; 4]| {
            let mut sum = Sums::zeros();
            for (x, u) in rule.0.iter().zip(&rule.1) {
                for (y, v) in rule.0.iter().zip(&rule.1) {
                    let at = (0.5 * (s + t + (t - s) * x), 0.5 * (from + to + (to - from) * y));
                    sum += density(at.0, at.1) * (0.25 * (t - s) * (to - from) * u * v);
                }
            }
            sum
        };
        let whole = [body.inner_radius().powi(2), body.outer_radius().powi(2), 0.0, TAU];
        let size = quarters(whole).map(panel).iter().fold(Sums::zeros(), |sum, part| sum + part.abs());
        let mut open = vec![(whole, panel(whole))];
        while let Some((rectangle, coarse)) = open.pop() {
            let parts = quarters(rectangle).map(|part| (part, panel(part)));
            let fine: Sums = parts.iter().map(|(_, sum)| sum).sum();
            let force = size.fixed_rows::<3>(1).norm();
            let scales = [size[0], force, body.outer_radius() * force];
            let settled = (0..7).all(|i| {
                let scale = scales[if i == 0 { 0 } else { 1 + (i - 1) / 3 }];
                (fine[i] - coarse[i]).abs() <= SETTLED * scale
            });
            if settled {
                total += fine;
            } else {
                open.extend(parts);
            }
        }
    }
    let [force, torque] = [1, 4].map(|row| total.fixed_rows::<3>(row).into_owned());
    (total[0], Wrench { force, torque })
}

fn quarters([s, t, from, to]: [f64; 4]) -> [[f64; 4]; 4] {
    let (m, middle) = (0.5 * (s + t), 0.5 * (from + to));
    [[s, m, from, middle], [m, t, from, middle], [s, m, middle, to], [m, t, middle, to]]
}
