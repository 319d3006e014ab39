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

use mcm::equilibrium::Equilibrium;
use mcm::vessel::{Branch, Clearance};

use crate::differences::{Direction, derivative};

/// Step of differences of clearances, m.
const STEP: f64 = 1e-6;

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

/// A direction with all components, through the shape that lies `far` times it beyond the model's last one: elsewhere against the wall.
fn into_the_wall(model: &Equilibrium, far: f64, allowed: [f64; 2]) -> Direction {
    let metric = model.metric();
    let unit = metric.iter().copied().fold(0.0, f64::max).sqrt();
    let component = |(i, k): (usize, &f64)| unit / k.sqrt() * (1.3 * i as f64).sin() / 20.0;
    let along: Vec<f64> = metric.iter().enumerate().map(component).collect();
    let shape = model.unknowns().iter().zip(&along).map(|(x, d)| x + far * d).collect();
    Direction { shape, along, steps: [1e-6; 2], shift: 1.0, allowed }
}

/// Differences between the derivatives told and central differences (fourth order) over a step (m) of the values and gradients,
/// relative to a unit gradient and to the second derivative.
fn errors_of_derivatives(
    clearance: impl Fn(&Vector3<f64>) -> Clearance,
    point: &Vector3<f64>,
    step: f64,
) -> [f64; 2] {
    let told = clearance(point);
    let (mut gradient, mut hessian) = (Vector3::zeros(), Matrix3::zeros());
    for axis in 0..3 {
        let at = |by: f64| clearance(&(point + Vector3::ith(axis, by)));
        gradient[axis] = derivative(step, |by| at(by).value);
        hessian.set_column(axis, &derivative(step, |by| at(by).gradient));
    }
    let scale = told.hessian.norm().max(1.0);
    [(told.gradient - gradient).norm(), (told.hessian - hessian).norm() / scale]
}
