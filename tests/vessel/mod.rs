//! Distance to the wall of a vessel.

mod aorta;
mod branch;
mod closed_forms;
mod contact;
mod feed;
mod friction;
mod friction_memory;
mod grid;
mod guidewire;
mod lumen;
mod mesh;
mod push;
mod rods;
mod scene;
mod stl;
pub(crate) mod tube;

use nalgebra::{Matrix3, Vector3};
use rand::rngs::StdRng;
use rand::{RngExt, SeedableRng};

use mcm::vessel::{Branch, Clearance};

/// Second derivative (1/m) above which a point is within 0.3 mm of a centreline, too near for differences.
const NEAR_AXIS: f64 = 5e3;

/// A winding vessel that narrows, other for every number.
fn winding(number: u64) -> Branch {
    let mut random = StdRng::seed_from_u64(number);
    let mut along = || random.random_range(-1.0..1.0_f64);
    let (wide, high, phase) = (8e-3 * along(), 8e-3 * along(), 3.0 * along());
    let (taper, narrow) = (0.04 * along(), 0.4e-3 * along());
    let place = |i: i32| {
        let t = 0.1 * f64::from(i) / 25.0;
        let turn = 60.0 * t + phase;
        let radius = 4e-3 + taper * (t - 0.05) + narrow * (90.0 * t).sin();
        (Vector3::new(wide * turn.sin(), high * (0.7 * turn).cos(), t), radius)
    };
    let (points, radii): (Vec<_>, Vec<_>) = (0..=25).map(place).unzip();
    Branch::new(&format!("number {number}"), &points, &radii).unwrap()
}

/// Random points inside and a little outside of a branch.
fn points_near(branch: &Branch, number: u64, count: usize) -> Vec<Vector3<f64>> {
    let mut random = StdRng::seed_from_u64(number);
    let length = *branch.range().end();
    let mut any = |_| {
        let (centre, radius) = branch.ball(length * random.random_range(-0.02..1.02_f64));
        let mut side = || random.random_range(-1.0..1.0_f64);
        centre + Vector3::new(side(), side(), side()) * (1.1 * radius)
    };
    (0..count).map(&mut any).collect()
}

/// Differences between the derivatives told and central differences (fourth order) of the values and gradients, relative to a
/// unit gradient and to the second derivative.
fn errors_of_derivatives(clearance: impl Fn(&Vector3<f64>) -> Clearance, point: &Vector3<f64>) -> [f64; 2] {
    const STEP: f64 = 1e-6;
    let told = clearance(point);
    let (mut gradient, mut hessian) = (Vector3::zeros(), Matrix3::zeros());
    for axis in 0..3 {
        let at = |steps: f64| clearance(&(point + Vector3::ith(axis, steps * STEP)));
        let [a, b, c, d] = [-2.0, -1.0, 1.0, 2.0].map(at);
        gradient[axis] = (8.0 * (c.value - b.value) - (d.value - a.value)) / (12.0 * STEP);
        let turn = ((c.gradient - b.gradient) * 8.0 - (d.gradient - a.gradient)) / (12.0 * STEP);
        hessian.set_column(axis, &turn);
    }
    let scale = told.hessian.norm().max(1.0);
    [(told.gradient - gradient).norm(), (told.hessian - hessian).norm() / scale]
}
