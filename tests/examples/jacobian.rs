//! The actuation Jacobian: how the tip moves and turns when the magnet does, beside a solve with the magnet moved.
//! `cargo run --release --example jacobian`
#![allow(clippy::print_stdout, reason = "a program that prints a table")]

use mcm::error::Error;
use mcm::manipulator::Scene;

fn main() -> Result<(), Error> {
    // Three segments of the paper beside its magnet pair, which is turned by 40 degrees.
    let scene = Scene::parse(
        "[design]\nsegments = 3\n[magnet]\nposition_mm = [0.0, -110.0, 30.0]\nturn_deg = 40.0",
        "example jacobian",
    )?;
    let mut manipulator = scene.manipulator(2)?;
    let tip = manipulator.solve(&scene.inputs)?.tip;

    // Rows: displacement (m) and rotation (rad) of the tip. Columns: the same of the magnet about its centre.
    let Some(jacobian) = manipulator.jacobian()?.tip_by_source(0) else { return Ok(()) };
    println!("tip by magnet    along x    along y    along z    about x    about y    about z");
    println!("(columns: of the magnet, per mm and per deg; rows: of the tip, in um and mdeg)");
    let per = [1e-3, 1e-3, 1e-3, 1f64.to_radians(), 1f64.to_radians(), 1f64.to_radians()];
    for (row, name) in ["along x", "along y", "along z", "about x", "about y", "about z"].iter().enumerate() {
        print!("{name:13}");
        for (column, step) in per.iter().enumerate() {
            let change = jacobian[(row, column)] * step;
            print!(" {:10.3}", if row < 3 { 1e6 * change } else { 1e3 * change.to_degrees() });
        }
        println!();
    }

    // The magnet moves on by 0.1 mm.
    let step = 1e-4;
    let mut inputs = scene.inputs.clone();
    inputs.sources[0].pose.position.z += step;
    let moved = manipulator.solve(&inputs)?.tip.position - tip.position;
    let expected = jacobian.fixed_view::<3, 1>(0, 2) * step;
    for (axis, moved, expected) in [("y", moved.y, expected.y), ("z", moved.z, expected.z)] {
        println!(
            "magnet 0.1 mm along z: tip along {axis} {:.3} um, by the Jacobian {:.3} um",
            1e6 * moved,
            1e6 * expected
        );
    }
    Ok(())
}
