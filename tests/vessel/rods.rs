//! Rods in vessels with rigid walls, computed independently: the limit of stiff walls.

use mcm::equilibrium::{Equilibrium, Inputs, Settings, Solution};
use mcm::manipulator::Scene;
use mcm::vessel::{Vessel, Wall};
use nalgebra::Vector3;
use serde_json::Value;

use crate::tolerance::{FEED_FORCE, STIFF_FORCE, STIFF_TIP};

/// Wall moduli (Pa): silicone, and two stiffer ones that approach the rigid wall.
const MODULI: [f64; 3] = [1e6, 1e7, 3e8];

/// Modulus (Pa) for a rod of 5e8 Pa.
const FOR_STIFF_RODS: f64 = 1e10;

/// Modulus (Pa) at forks.
const AT_FORKS: f64 = 1e8;

struct Rod {
    name: String,
    scene: Scene,
    length: f64,
    results: Value,
}

fn rods() -> Vec<Rod> {
    let text = include_str!("../reference/vessel_dev.json");
    let file: Value = serde_json::from_str(text).expect("JSON");
    let rod = |case: &Value| Rod {
        name: case["id"].as_str().expect("name").into(),
        scene: Scene::parse(case["scene"]["toml"].as_str().expect("text"), "rod").expect("a scene"),
        length: case["scene"]["rod"]["total_length_m"].as_f64().expect("length"),
        results: case["results"].clone(),
    };
    file["cases"].as_array().expect("list").iter().map(rod).collect()
}

impl Rod {
    fn number(&self, key: &str) -> f64 {
        self.results[key].as_f64().expect("number")
    }

    fn vector(&self, key: &str) -> Vector3<f64> {
        Vector3::from_fn(|i, _| self.results[key][i].as_f64().expect("number"))
    }

    /// Unsolved, with a wall of this modulus (Pa).
    fn with_wall(&self, modulus: f64) -> Equilibrium {
        let vessel = self.scene.vessel.as_ref().expect("a vessel");
        let vessel = Vessel { wall: Wall::new(modulus).expect("allowed"), ..vessel.clone() };
        let settings = Settings {
            cylinder_elements: 16,
            time_budget: 300.0,
            iterations: 20_000,
            interaction: mcm::equilibrium::Interaction::None,
            ..Settings::default()
        };
        let design = self.scene.design().expect("allowed");
        Equilibrium::new(&design, None, settings, 2).expect("allowed").in_vessel(&vessel)
    }

    /// Errors of the tip, relative to the length, and of the sum of wall forces, relative to itself.
    fn errors(&self, solved: &Equilibrium) -> [f64; 2] {
        let tip = (solved.tip().position - self.vector("tip_position_m")).norm() / self.length;
        let wall = solved.wall().expect("in a vessel");
        let sum = self.number("sum_abs_contact_force_n");
        [tip, (wall.sum / sum - 1.0).abs()]
    }
}

fn solve(model: &mut Equilibrium, inputs: &Inputs) {
    let report = model.solve(inputs).expect("finite");
    assert!(report.solved() && report.stable == Some(true), "{report:?}");
}

#[test]
fn stiff_walls_lead_to_the_rigid_limit() {
    let reached_otherwise = ["st_helix_2", "y_field_branch", "y_tipforce_carina"];
    for rod in rods().iter().filter(|rod| !reached_otherwise.contains(&rod.name.as_str())) {
        let moduli =
            if rod.name == "arc_stiff" { MODULI.map(|e| e * FOR_STIFF_RODS / MODULI[2]) } else { MODULI };
        let mut before = f64::INFINITY;
        for (number, modulus) in moduli.into_iter().enumerate() {
            let mut model = rod.with_wall(modulus);
            solve(&mut model, &rod.scene.inputs);
            let [tip, sum] = rod.errors(&model);
            println!(
                "{:18} {modulus:8.0e} Pa: tip {tip:.1e} of the length, sum of forces {sum:.1e}",
                rod.name
            );
            // Depths of contact, and with them the errors, fall as the modulus to the power of -2/3 (points) or -1 (lines).
            assert!(tip < 0.5 * before || tip < STIFF_TIP, "{}: {tip} after {before}", rod.name);
            before = tip;
            if number == 2 {
                assert!(tip < STIFF_TIP && sum < STIFF_FORCE, "{}: {tip} {sum}", rod.name);
            }
        }
    }
}

#[test]
fn rods_at_a_fork_agree_on_the_branch_of_the_reference() {
    for rod in rods().iter().filter(|rod| rod.name.starts_with("y_")) {
        let mut model = rod.with_wall(AT_FORKS);
        // In a wide lumen the rod bends towards the side branch, and stays there when the lumen narrows.
        let mut inputs = rod.scene.inputs.clone();
        let aside = rod.name == "y_tipforce_carina";
        if aside {
            inputs.tip_force = Vector3::new(4e-3, 0.0, 0.0);
        }
        for part in (0..=60).rev() {
            inputs.widening = 0.03 * f64::from(part) / 60.0;
            solve(&mut model, &inputs);
        }
        let wanted = rod.scene.inputs.tip_force;
        let from = inputs.tip_force;
        for part in 1..=20 {
            inputs.tip_force = from.lerp(&wanted, f64::from(part) / 20.0);
            solve(&mut model, &inputs);
        }
        let [tip, sum] = rod.errors(&model);
        println!("{:18} tip {tip:.1e} of the length, sum of forces {sum:.1e}", rod.name);
        assert!(tip < STIFF_TIP && sum < STIFF_FORCE, "{}: {tip} {sum}", rod.name);
    }
}

#[test]
fn fed_rod_is_held_by_the_push_of_the_reference() {
    let all = rods();
    let rod = all.iter().find(|rod| rod.name == "feed_60").expect("in the file");
    let mut model = rod.with_wall(MODULI[2]);
    solve(&mut model, &rod.scene.inputs);
    let push = model.feed_reaction(&rod.scene.inputs).expect("a shaft");
    let wanted = rod.number("feed_force_n");
    assert!(
        (push - wanted).abs() < FEED_FORCE * rod.vector("port_reaction_force_n").norm(),
        "{push} {wanted}"
    );
    // The push is the derivative of the energy.
    let mut energy = |by: f64| {
        let inputs = Inputs { insertion: rod.scene.inputs.insertion + by, ..rod.scene.inputs.clone() };
        model.solve(&inputs).expect("finite").energy
    };
    let step = 2e-5;
    let slope = (energy(step) - energy(-step)) / (2.0 * step);
    assert!((slope - push).abs() < FEED_FORCE * push.abs(), "{slope} {push}");
}
