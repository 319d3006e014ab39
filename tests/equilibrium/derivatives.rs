//! Gradient and Hessian against finite differences.

use mcm::design::{Design, Specification};
use mcm::equilibrium::{Equilibrium, Inputs, Interaction, PlacedSource, Settings};
use mcm::geometry::Pose;
use nalgebra::Vector3;

use crate::given::pair;
use crate::tolerance::{HESSIAN_DIFFERENCE, SLOPE_DIFFERENCE, assert_close};

/// Steps of the differences of energies and of gradients, in radians of the first mode.
const LONG_STEP: f64 = 1e-3;
const STEP: f64 = 1e-5;

/// A fixed number between -1 and 1.
fn pseudo(seed: usize, i: usize) -> f64 {
    (12.9898 * (i as f64 + 1.0) + 78.233 * seed as f64).sin()
}

fn everything(magnet: bool) -> Inputs {
    let mut inputs = Inputs::unloaded(4);
    inputs.uniform_field = Vector3::new(0.004, 0.012, -0.003);
    inputs.gravity = Vector3::new(1.0, -9.0, 2.0);
    inputs.tip_force = Vector3::new(0.003, 0.001, -0.002);
    inputs.ring_forces[1] = Vector3::new(0.002, -0.001, 0.004);
    inputs.base = Pose::new([0.001, 0.002, -0.003], [0.8, 0.36, -0.48, 0.0]).expect("a pose");
    if magnet {
        let pose = Pose::new([0.01, -0.06, 0.01], [0.6, 0.8, 0.0, 0.0]).expect("a pose");
        inputs.sources = vec![PlacedSource { pose, strength: 1.0 }];
        inputs.field_gradient = [0.1, 0.05, -0.2, 0.3, 0.15];
    }
    inputs
}

/// Name, equilibrium, inputs, a bent shape, a direction.
type Case = (String, Equilibrium, Inputs, Vec<f64>, Vec<f64>);

/// Every combination of level and field.
fn cases() -> Vec<Case> {
    let design = Design::new(Specification::paper(3)).expect("the paper's design is allowed");
    let mut out = Vec::new();
    for interaction in [Interaction::None, Interaction::Rings, Interaction::Full] {
        for (magnet, degree, closed) in
            [(false, 0, false), (false, 2, false), (true, 3, false), (true, 2, true)]
        {
            let settings =
                Settings { interaction, degree, bending_stop: Some(closed), ..Settings::default() };
            let assembly = pair();
            let equilibrium =
                Equilibrium::new(&design, magnet.then_some(&assembly), settings, 2).expect("allowed");
            let scale: Vec<f64> =
                equilibrium.metric().iter().map(|k| (equilibrium.metric()[0] / k).sqrt()).collect();
            let vector =
                |seed, size: f64| scale.iter().enumerate().map(|(i, s)| size * s * pseudo(seed, i)).collect();
            // Bent so far that windings of some cores touch, and of others are about to; and else so that no pair of rings changes
            // its quadrature nearby, at which the energy jumps.
            let bent = if closed { 0.5 } else { 0.13 };
            let (shape, direction) = (vector(1, bent), vector(2, 1.0));
            let name = format!("{interaction:?}, magnet {magnet}, degree {degree}, stop {closed}");
            out.push((name, equilibrium, everything(magnet), shape, direction));
        }
    }
    out
}

fn moved(shape: &[f64], direction: &[f64], distance: f64) -> Vec<f64> {
    shape.iter().zip(direction).map(|(x, d)| x + distance * d).collect()
}

#[test]
fn the_gradient_is_the_slope_of_the_energy() {
    for (name, mut equilibrium, inputs, shape, direction) in cases() {
        let mut at = |s: f64| equilibrium.gradient(&inputs, &moved(&shape, &direction, s)).expect("apart");
        // Of fourth order.
        let mut spread = |s: f64| (at(s).0 - at(-s).0) / (2.0 * s);
        let difference = (4.0 * spread(LONG_STEP) - spread(2.0 * LONG_STEP)) / 3.0;
        let slope: f64 = at(0.0).1.iter().zip(&direction).map(|(g, d)| g * d).sum();
        assert_close(&name, &[slope], &[difference], SLOPE_DIFFERENCE);
        println!("{name}: gradient {:e}", slope / difference - 1.0);
    }
}

#[test]
fn the_hessian_is_the_slope_of_the_gradient() {
    // `(H + shift K) d` by differences, solved by the exact factorisation, must give `d` back.
    let shift = 30.0;
    for (name, mut equilibrium, inputs, shape, direction) in cases() {
        let mut at = |s: f64| equilibrium.gradient(&inputs, &moved(&shape, &direction, s)).expect("apart").1;
        let (plus, minus) = (at(STEP), at(-STEP));
        let metric = equilibrium.metric().to_vec();
        let image = plus.iter().zip(&minus).map(|(a, b)| (a - b) / (2.0 * STEP));
        let rhs: Vec<f64> =
            image.zip(metric.iter().zip(&direction)).map(|(h, (k, d))| h + shift * k * d).collect();
        let solved = equilibrium.solve_at(&inputs, &shape, shift, &rhs).expect("positive definite");
        let weighted = |x: &[f64]| x.iter().zip(&metric).map(|(v, k)| v * k.sqrt()).collect::<Vec<f64>>();
        assert_close(&name, &weighted(&solved), &weighted(&direction), HESSIAN_DIFFERENCE);
        let error = solved.iter().zip(&direction).map(|(a, b)| ((a - b) / b).abs()).fold(0.0, f64::max);
        println!("{name}: Hessian {error:e}");
    }
}
