//! A magnet passes with its field against a manipulator, which turns over, and comes back: where it snaps depends on the way.
//! `cargo run --release --example snap`
#![allow(clippy::print_stdout, reason = "a program that prints a table")]

use mcm::error::Error;
use mcm::manipulator::{Scene, Status};

/// Nine segments and the magnet pair of the paper, 120 mm from axis to axis, magnetised along +z; windings may touch.
const SCENE: &str = "
[magnet]
position_mm = [0.0, -120.0, -40.0]
orientation_wxyz = [1.0, 0.0, 0.0, 0.0]

[model]
interaction = \"rings\"
bending_stop = true
";

fn main() -> Result<(), Error> {
    let scene = Scene::parse(SCENE, "example snap")?;
    let mut manipulator = scene.manipulator(2)?;
    let mut inputs = scene.inputs.clone();

    println!("step   magnet z (mm)   tip angle (deg)   margin (1)   snaps");
    let forth = (-10..=0).map(|place| 4 * place);
    for (step, place) in forth.clone().chain(forth.rev().skip(1)).enumerate() {
        inputs.sources[0].pose.position.z = 1e-3 * f64::from(place);
        manipulator.solve(&inputs)?;
        // 1 without loads and interaction, 0 at a fold: the closer to 0, the sooner it snaps.
        let outputs = manipulator.measure_margin();
        let (angle, margin) = (outputs.tip_angle.to_degrees(), outputs.stability_margin);
        let note = match outputs.status {
            Status::Solved => "",
            Status::NearFold => "   close to a fold",
            Status::Snapped => "   snapped in this step",
            Status::NotSolved => "   not solved: the last shape",
        };
        println!("{step:4} {place:15} {angle:17.2} {margin:12.4} {:7}{note}", outputs.snaps);
    }
    Ok(())
}
