//! Gradient and Hessian against finite differences.

use mcm::design::{Design, Specification};
use mcm::equilibrium::{Equilibrium, Inputs, Interaction, PlacedSource, Settings};
use mcm::geometry::Pose;
use nalgebra::Vector3;

use crate::differences::{Direction, assert_derivatives};
use crate::given::pair;
use crate::tolerance::{HESSIAN_DIFFERENCE, SLOPE_DIFFERENCE};

/// Steps of the differences of energies and of gradients, in radians of the first mode.
const STEPS: [f64; 2] = [1e-3, 1e-5];

/// Multiple of the elastic stiffness that makes the Hessian away from equilibrium definite.
const SHIFT: f64 = 30.0;

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

/// Name, equilibrium, inputs, a direction through a bent shape.
type Case = (String, Equilibrium, Inputs, Direction);

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
            let (shape, along) = (vector(1, bent), vector(2, 1.0));
            let allowed = [SLOPE_DIFFERENCE, HESSIAN_DIFFERENCE];
            let direction = Direction { shape, along, steps: STEPS, shift: SHIFT, allowed };
            let name = format!("{interaction:?}, magnet {magnet}, degree {degree}, stop {closed}");
            out.push((name, equilibrium, everything(magnet), direction));
        }
    }
    out
}

#[test]
fn gradient_and_hessian_are_those_of_the_energy() {
    for (name, mut equilibrium, inputs, direction) in cases() {
        assert_derivatives(name, &mut equilibrium, &inputs, &direction);
    }
}
