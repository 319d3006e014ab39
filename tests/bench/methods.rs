//! Accuracy and time of every method beside the potential one, and where each fails:
//! `cargo run --release --example methods`.
#![allow(clippy::unwrap_used, clippy::expect_used, clippy::print_stdout, missing_docs, reason = "a program that stops when a scene is wrong")]

use std::time::Instant;

use mcm::design::{Design, Specification};
use mcm::equilibrium::{Discretisation, Inputs, Interaction, Method, Settings, Solver};
use mcm::manipulator::Scene;
use nalgebra::{Rotation3, Vector3};

fn scene(segments: usize, interaction: &str, field: &str) -> Scene {
    let text = format!("{field}\n[design]\nsegments = {segments}\n[model]\ninteraction = \"{interaction}\"");
    Scene::parse(&text, "bench").expect("a valid scene")
}

fn main() {
    for (name, table) in [("uniform", "[field]\nuniform_mt=[0,20,0]"), ("pair", "[magnet]\norientation_wxyz = [0, 1, 0, 0]"), ("loads", "[field]\nuniform_mt=[0,5,0]\n[gravity]\nacceleration_m_s2=[0,-9.81,0]\n[load]\ntip_force_n=[0.0,0.005,-0.01]")] {
        for segments in [1, 3, 9] {
            for interaction in ["none", "preceding", "rings"] {
                let scene = scene(segments, interaction, table);
                let design = scene.design().unwrap();
                let magnet = scene.assembly().unwrap();
                let fine = Settings { degree: 6, ..scene.settings };
                let mut reference = Solver::new(&design, magnet.as_ref(), fine, 2).unwrap();
                let report = reference.solve(&scene.inputs).unwrap();
                println!("{name} S={segments} {interaction}: reference solved {} energy {:.6e} residual {:.1e}", report.solved, report.energy, report.residual);
                let tip = reference.tip();
                let base = reference.base_reaction();
                let force = reference.magnetic_wrench();
                for (method, label, levels) in Method::ALL {
                    if !levels.contains(&scene.settings.interaction) { continue; }
                    let settings = Settings { method: *method, ..scene.settings };
                    let mut solver = Solver::new(&design, magnet.as_ref(), settings, 21).unwrap();
                    let start = Instant::now();
                    let report = match solver.solve(&scene.inputs) { Ok(r) => r, Err(e) => { println!("   {label}: {e}"); continue } };
                    let cold = start.elapsed().as_secs_f64() * 1e6;
                    let error = (solver.tip().position - tip.position).norm() / design.length();
                    let got = solver.base_reaction();
                    let eb = (got.force - base.force).norm() / base.force.norm().max(1e-3) + (got.torque - base.torque).norm() / base.torque.norm().max(1e-6);
                    let gf = solver.magnetic_wrench();
                    let em = (gf.force - force.force).norm() / force.force.norm().max(1e-3) + (gf.torque - force.torque).norm() / force.torque.norm().max(1e-6);
                    let mut inputs = scene.inputs.clone();
                    inputs.uniform_field = Rotation3::from_axis_angle(&Vector3::x_axis(), 0.1_f64.to_radians()) * inputs.uniform_field;
                    if magnet.is_some() { inputs.magnet.position.z += 1e-4; }
                    let start = Instant::now();
                    let warm = solver.solve(&inputs).unwrap();
                    let warm_time = start.elapsed().as_secs_f64() * 1e6;
                    println!("   {label:20} solved {} it {:3} res {:.1e} tip {error:.1e} base {eb:.1e} mag {em:.1e} energy {:.6e} cold {cold:.0} us; warm {} it {} {warm_time:.0} us", report.solved, report.iterations, report.residual, report.energy, warm.solved, warm.iterations);
                }
            }
        }
    }
    let _ = (Discretisation::default(), Interaction::None, Inputs::unloaded(0), Specification::paper(1), Design::new);
}
