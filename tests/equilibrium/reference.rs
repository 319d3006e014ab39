//! The rows of `statics_dev.json`.

use mcm::design::{Design, Segmented, Specification, SpiralKind};
use mcm::equilibrium::{Equilibrium, Inputs, Interaction, Settings};
use mcm::geometry::Pose;
use mcm::magnetics::{Assembly, AxialMagnet};
use nalgebra::Vector3;
use serde_json::Value;

fn vector(value: &Value) -> Vector3<f64> {
    Vector3::from_fn(|i, _| value[i].as_f64().unwrap())
}

#[test]
fn rows() {
    let text = std::fs::read_to_string("tests/reference/statics_dev.json").unwrap();
    let file: Value = serde_json::from_str(&text).unwrap();
    for case in file["cases"].as_array().unwrap() {
        let setup = &case["setup"];
        let level = match setup["level"].as_str().unwrap() {
            "none" => Interaction::None,
            "rings" => Interaction::Rings,
            _ => continue,
        };
        let Specification::Segmented(paper) = Specification::paper(setup["S"].as_u64().unwrap() as usize)
        else {
            unreachable!()
        };
        let axisymmetric = setup["spiral"] == "axisymmetric";
        let mut spec = Segmented {
            base_magnet: setup["base_ring"].as_bool().unwrap(),
            spiral: if axisymmetric { SpiralKind::Axisymmetric } else { SpiralKind::Helical },
            ..paper
        };
        let input = &case["inputs"];
        if let Some(d) = input["rho_mpc"].as_f64() {
            spec.helix.density = Some(d);
        }
        let rings = spec.segments + usize::from(spec.base_magnet);
        let design = Design::new(Specification::Segmented(spec)).unwrap();
        let mut inputs = Inputs::unloaded(rings);
        if input["B"].is_array() {
            inputs.uniform_field = vector(&input["B"]);
        }
        if input["gravity"].is_array() {
            inputs.gravity = vector(&input["gravity"]);
        }
        let mut assembly = None;
        if input["magnet_pair"].is_object() {
            let m = &input["magnet_pair"];
            let half = 0.5 * (m["length_each"].as_f64().unwrap() + m["gap"].as_f64().unwrap());
            let magnet = |offset| AxialMagnet {
                radius: 0.5 * m["diameter"].as_f64().unwrap(),
                inner_radius: 0.0,
                length: m["length_each"].as_f64().unwrap(),
                offset,
                remanence: m["Br"].as_f64().unwrap(),
            };
            assembly = Some(Assembly::new(vec![magnet(-half), magnet(half)]).unwrap());
            let flip = if m["polarity"].as_f64().unwrap() > 0.0 {
                [1.0, 0.0, 0.0, 0.0]
            } else {
                [0.0, 1.0, 0.0, 0.0]
            };
            inputs.magnet = Pose::new(vector(&m["centre"]).into(), flip).unwrap();
            inputs.magnet_strength = 1.0;
        }
        let degree = std::env::var("DEGREE").map_or(3, |d| d.parse().unwrap());
        let pair_accuracy = std::env::var("ACC").map_or(1e-8, |d| d.parse().unwrap());
        let settings = Settings { interaction: level, degree, pair_accuracy, ..Settings::default() };
        let mut eq = Equilibrium::new(&design, assembly.as_ref(), settings, 11).unwrap();
        let now = std::time::Instant::now();
        let report = eq.solve(&inputs).unwrap();
        let time = now.elapsed().as_micros();
        let out = &case["outputs"];
        let id = case["id"].as_str().unwrap();
        if out["alpha_deg"].is_f64() {
            let tip = eq.tip();
            let alpha = tip.axis().angle(&Vector3::z()).to_degrees();
            let t = vector(&out["tip_p"]);
            let w = eq.magnetic_wrench();
            let (f, q) = (vector(&out["force"]), vector(&out["torque_about_base"]));
            println!(
                "{id:28} dalpha {:9.1e} dtip/L {:8.1e} df {:8.1e} dt {:8.1e} margin {:.3} it {} snaps {} {} us digits {}",
                alpha - out["alpha_deg"].as_f64().unwrap(),
                (tip.position - t).norm() / design.length(),
                (w.force - f).norm() / f.norm().max(1e-30),
                (w.torque - q).norm() / q.norm(),
                report.margin,
                report.iterations,
                report.snaps,
                time,
                out["converged_digits"]
            );
        } else {
            println!("{id:28} {report:?} {} {time} us", out);
        }
    }
}
