//! Heavy rods on the bottom of a tube.

use mcm::equilibrium::{Equilibrium, Inputs, Solution};
use mcm::geometry::Pose;
use nalgebra::{DVector, Vector3};

use super::held::{Free, Held};
use super::{GAP, LENGTH, STIFF, bending_stiffness, design, model, tube};
use crate::tolerance::WALL_CLOSED_FORM;

/// Acceleration of heavy rods, m/s2.
const GRAVITY: f64 = 10.0;

/// Load (times `sqrt(K w/c)`) at which a rod of weight `w` per length buckles sideways on the bottom of a tube, clamped at one end and
/// held at the other, of a length in units of `(K c/w)^(1/4)`: that of a beam on an elastic foundation `w/c`.
fn sinusoidal_buckling(length: f64) -> f64 {
    let determinant = |load: f64| {
        let root = (load * load - 4.0).sqrt();
        let [a, b] = [1.0, -1.0].map(|sign: f64| (0.5 * (load + sign * root)).sqrt());
        let (even, odd) =
            ((a * length).cos() - (b * length).cos(), (a * length).sin() - a / b * (b * length).sin());
        let bent = |x: f64, y: f64| b * b * y - a * a * x;
        let (even2, odd2) = (
            bent((a * length).cos(), (b * length).cos()),
            bent((a * length).sin(), a / b * (b * length).sin()),
        );
        even * odd2 - odd * even2
    };
    let (mut load, step) = (2.0 + 1e-6, 1e-6);
    while determinant(load) * determinant(load + step) > 0.0 {
        load += step;
    }
    load + 0.5 * step
}

/// A heavy rod on the bottom of a tube buckles sideways at `2 sqrt(K w/c)` if it is long.
#[test]
fn a_heavy_rod_in_a_tube_buckles_sideways_as_in_closed_form() {
    let stiffness = bending_stiffness();
    for (length, long) in [(8.0, 0.1), (12.0, 0.04)] {
        let weight = stiffness * GAP * (length / LENGTH).powi(4);
        let vessel = tube(STIFF);
        let mut model = model(&design(LENGTH, weight / GRAVITY), 8, &vessel);
        let unit = (stiffness * weight / GAP).sqrt();
        // It rests where the wall bears it.
        let [mut bears, mut yields] = [vessel.wall.onset() + weight / STIFF * 2.0, 0.0];
        for _ in 0..60 {
            let depth = 0.5 * (bears + yields);
            *(if vessel.wall.line(depth)[1] > weight { &mut bears } else { &mut yields }) = depth;
        }
        let wanted = sinusoidal_buckling(length);
        let aside = |model: &Equilibrium| model.tip().position.x;
        let bottom = Pose { position: Vector3::new(0.0, -GAP - bears, 0.0), ..Pose::identity() };
        let all = Free::all(&model);
        let straight = DVector::zeros(model.freedoms());
        let mut smallest = |load: f64| {
            let inputs = |held: f64| Inputs {
                tip_force: Vector3::new(held, 0.0, -load * unit),
                gravity: Vector3::new(0.0, -GRAVITY, 0.0),
                base: bottom,
                ..Inputs::unloaded(0)
            };
            Held::new(&mut model, &all, &inputs, &aside, unit).smallest(&straight, 0.0)
        };
        let [(below, stable), (above, unstable)] =
            [0.999, 1.001].map(|part| (part * wanted, smallest(part * wanted)));
        assert!(stable > 0.0 && unstable < 0.0, "{stable} {unstable}");
        let found = below + (above - below) * stable / (stable - unstable);
        println!("length {length}: {found} of sqrt(K w/c), {wanted}: {:.1e}", found / wanted - 1.0);
        assert!((found / wanted - 1.0).abs() < WALL_CLOSED_FORM, "{found} {wanted}");
        assert!(wanted < 2.0 * (1.0 + long), "{wanted}");
    }
}
