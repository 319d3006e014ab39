//! The shape that a manipulator of three segments takes in the field of a magnet beside it.
//! `cargo run --release --example shape`
#![allow(clippy::print_stdout, reason = "a program that prints a table")]

use mcm::error::Error;
use mcm::manipulator::Scene;

/// What is left out is the paper's: the segments, and the magnet, a pair of cylinders.
const SCENE: &str = "
[design]
segments = 3

[magnet]
position_mm = [0.0, -100.0, 0.0]
orientation_wxyz = [0.70710678118654752, 0.70710678118654752, 0.0, 0.0] # its axis along -y
";

fn main() -> Result<(), Error> {
    let scene = Scene::parse(SCENE, "example shape")?;
    let mut manipulator = scene.manipulator(11)?; // 11 points of the centreline
    let outputs = manipulator.solve(&scene.inputs)?;

    println!("arc length (mm)     x (mm)     y (mm)     z (mm)");
    for (arc_length, point) in outputs.shape_arc_length.iter().zip(&outputs.shape) {
        let [x, y, z] = [point.x, point.y, point.z].map(|metres| 1e3 * metres);
        println!("{:15.2} {x:10.3} {y:10.3} {z:10.3}", 1e3 * arc_length);
    }
    let force = outputs.magnetic_force * 1e3;
    println!("tip angle {:.2} deg, {:?}", outputs.tip_angle.to_degrees(), outputs.status);
    println!("force of the magnet ({:.3}, {:.3}, {:.3}) mN", force.x, force.y, force.z);
    Ok(())
}
