//! Gradient and Hessian against finite differences.

use mcm::design::{Design, Specification};
use mcm::equilibrium::{Equilibrium, Inputs, Interaction, Settings};
use mcm::geometry::Pose;
use mcm::magnetics::{Assembly, AxialMagnet};
use nalgebra::Vector3;

fn pair() -> Assembly {
    let magnet =
        |offset| AxialMagnet { radius: 0.0225, inner_radius: 0.0, length: 0.03, offset, remanence: 1.35 };
    Assembly::new(vec![magnet(-0.02), magnet(0.02)]).unwrap()
}

fn pseudo(seed: usize, i: usize) -> f64 {
    (12.9898 * (i as f64 + 1.0) + 78.233 * seed as f64).sin()
}

#[test]
fn gradient_and_hessian_meet_finite_differences() {
    for (level, magnet) in [
        (Interaction::None, false),
        (Interaction::None, true),
        (Interaction::Rings, false),
        (Interaction::Rings, true),
    ] {
        let design = Design::new(Specification::paper(3)).unwrap();
        let settings = Settings { interaction: level, degree: 2, ..Settings::default() };
        let assembly = pair();
        let mut equilibrium = Equilibrium::new(&design, magnet.then_some(&assembly), settings, 2).unwrap();
        let mut inputs = Inputs::unloaded(4);
        inputs.uniform_field = Vector3::new(0.004, 0.012, -0.003);
        inputs.gravity = Vector3::new(1.0, -9.0, 2.0);
        inputs.tip_force = Vector3::new(0.003, 0.001, -0.002);
        inputs.ring_forces[1] = Vector3::new(0.002, -0.001, 0.004);
        inputs.base = Pose::new([0.001, 0.002, -0.003], [0.8, 0.36, -0.48, 0.0]).unwrap();
        if magnet {
            inputs.magnet = Pose::new([0.01, -0.06, 0.01], [0.6, 0.8, 0.0, 0.0]).unwrap();
            inputs.magnet_strength = 1.0;
            inputs.field_gradient = [0.1, 0.05, -0.2, 0.3, 0.15];
        }
        let n = equilibrium.freedoms();
        let metric = equilibrium.metric().to_vec();
        let scale: Vec<f64> = metric.iter().map(|k| (metric[0] / k).sqrt()).collect();
        let x: Vec<f64> = (0..n).map(|i| 0.12 * pseudo(1, i) * scale[i]).collect();
        let d: Vec<f64> = (0..n).map(|i| pseudo(2, i) * scale[i]).collect();
        let h = 1e-5;
        let moved = |s: f64| -> Vec<f64> { x.iter().zip(&d).map(|(a, b)| a + s * b).collect() };
        let (energy_plus, gradient_plus) = equilibrium.gradient(&inputs, &moved(h)).unwrap();
        let (energy_minus, gradient_minus) = equilibrium.gradient(&inputs, &moved(-h)).unwrap();
        let (_, gradient) = equilibrium.gradient(&inputs, &x).unwrap();
        let slope: f64 = gradient.iter().zip(&d).map(|(g, v)| g * v).sum();
        let difference = (energy_plus - energy_minus) / (2.0 * h);
        println!(
            "{level:?} {magnet} slope {slope:e} difference {difference:e} rel {:e}",
            slope / difference - 1.0
        );
        let image: Vec<f64> =
            gradient_plus.iter().zip(&gradient_minus).map(|(a, b)| (a - b) / (2.0 * h)).collect();
        // (H + shift K) d, solved, must give d back.
        let shift = 30.0;
        let rhs: Vec<f64> = (0..n).map(|i| image[i] + shift * metric[i] * d[i]).collect();
        let solved = equilibrium.solve_at(&inputs, &x, shift, &rhs).expect("positive definite");
        let worst = solved.iter().zip(&d).map(|(a, b)| ((a - b) / b).abs()).fold(0.0, f64::max);
        println!("worst {worst:e}");
        assert!((slope / difference - 1.0).abs() < 1e-6);
        assert!(worst < 1e-5, "{level:?} magnet {magnet}: {worst:e}");
    }
}
