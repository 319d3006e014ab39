//! How fast the answer settles with the degree of the strain modes, the elements of a plain rod and the accuracy
//! of the ring pairs.

use mcm::design::{Cylinder, CylinderMaterial, Design, Specification};
use mcm::equilibrium::{Equilibrium, Inputs, Interaction, Settings, Solution};
use mcm::manipulator::Scene;
use nalgebra::Vector3;

use crate::tolerance::{
    ANGLE_BY_ACCURACY, BETWEEN_REFERENCES, DEGREE_NONE, DEGREE_RINGS, FULL_BY_DEFAULT, PAIRS,
    PAIRS_BY_DEFAULT,
};

const RICHEST: usize = 8;

fn tip(design: &Design, settings: Settings, field: f64) -> Vector3<f64> {
    let mut equilibrium = Equilibrium::new(design, None, settings, 2).expect("allowed");
    let inputs =
        Inputs { uniform_field: Vector3::new(0.0, field, 0.0), ..Inputs::unloaded(design.rings().count()) };
    let report = equilibrium.solve(&inputs).expect("finite inputs");
    assert!(report.solved() && report.snaps == 0, "{report:?}");
    equilibrium.tip().position
}

/// Tip errors over the length for degrees 0 to 6, against the richest.
fn by_degree(segments: usize, interaction: Interaction, field: f64) -> Vec<f64> {
    let design = Design::new(Specification::paper(segments)).expect("allowed");
    let at = |degree| {
        let settings = Settings { interaction, degree, pair_accuracy: PAIRS, ..Settings::default() };
        tip(&design, settings, field)
    };
    let exact = at(RICHEST);
    let errors: Vec<f64> = (0..=6).map(|degree| (at(degree) - exact).norm() / design.length()).collect();
    let columns: Vec<String> = errors.iter().map(|error| format!("{error:8.1e}")).collect();
    println!("{interaction:?} S = {segments}, {:4.0} mT: {}", 1e3 * field, columns.join(" "));
    errors
}

#[test]
fn the_default_degree_is_enough_and_more_is_better() {
    println!("tip error over the length by degree 0 to 6, against {RICHEST}");
    let default = Settings::default().degree;
    for (interaction, field, bound) in
        [(Interaction::None, 0.02, DEGREE_NONE), (Interaction::Rings, 0.01, DEGREE_RINGS)]
    {
        for segments in [1, 3, 9] {
            let errors = by_degree(segments, interaction, field);
            assert!(
                errors[default] <= bound,
                "{interaction:?}, {segments} segments: {:e} of the length at the default degree, allowed {bound:e}",
                errors[default]
            );
            // Two degrees more leave at most a tenth, down to where the shear that varies along a disc (which no
            // mode has: 2e-9 with ring pairs) or rounding is all that is left.
            let floor = if interaction == Interaction::None { 1e-11 } else { 1e-8 };
            for (coarse, fine) in errors.iter().zip(&errors[2..]) {
                assert!(
                    *fine <= 0.1 * coarse || *fine < floor,
                    "{interaction:?}, {segments} segments: no convergence: {errors:?}"
                );
            }
        }
    }
}

#[test]
fn the_elements_of_a_plain_rod_converge() {
    // The solid cylinder of Fig. 7B, in a field six times stronger, held across it.
    let design = Design::new(Specification::Cylinder(Cylinder {
        length: 16e-3,
        radius: 2e-3,
        inner_radius: 0.0,
        material: CylinderMaterial::Composite {
            shore_a: 33.0,
            poisson: 0.4,
            volume_fraction: 0.2,
            particle_remanence: 1.0,
        },
        density: None,
    }))
    .expect("allowed");
    for (degree, order) in [(0, 2), (1, 4), (2, 5)] {
        let at = |elements| {
            let settings = Settings { degree, cylinder_elements: elements, ..Settings::default() };
            tip(&design, settings, 0.12)
        };
        let exact = tip(&design, Settings { degree: 6, cylinder_elements: 16, ..Settings::default() }, 0.12);
        let errors: Vec<f64> = [1, 2, 4, 8, 16].map(|n| (at(n) - exact).norm() / design.length()).to_vec();
        println!("degree {degree}, 1 2 4 8 16 elements: {errors:?}");
        for pair in errors.windows(2).skip(1) {
            let expected = 0.5_f64.powi(order);
            assert!(
                pair[1] <= 1.6 * expected * pair[0] || pair[1] < 1e-11,
                "degree {degree}: halved elements should leave {expected} of the error: {errors:?}"
            );
        }
    }
}

#[test]
fn the_accuracy_of_the_pairs_is_held() {
    let design = Design::new(Specification::paper(3)).expect("allowed");
    let at = |pair_accuracy| tip(&design, Settings { pair_accuracy, ..Settings::default() }, 0.01);
    let exact = at(1e-13);
    let error = |accuracy| (at(accuracy) - exact).norm() / design.length();
    let errors = [1e-3, Settings::default().pair_accuracy, PAIRS].map(error);
    println!("pair accuracy 1e-3, default, {PAIRS:e}: tip error over the length {errors:?}");
    assert!(errors[1] <= PAIRS_BY_DEFAULT, "default: {errors:?}");
    assert!(errors[0] <= 1e-3 && errors[2] <= errors[1] && errors[1] <= errors[0], "{errors:?}");
}

#[test]
fn full_by_default_is_close_to_its_own_refinement() {
    for (segments, field) in [(1, 0.02), (3, 0.01), (9, 0.002)] {
        let design = Design::new(Specification::paper(segments)).expect("allowed");
        let full = Settings { interaction: Interaction::Full, ..Settings::default() };
        let exact = tip(&design, Settings { degree: 4, pair_accuracy: PAIRS, ..full }, field);
        let error = (tip(&design, full, field) - exact).norm() / design.length();
        println!("full, S = {segments}, {:.0} mT: tip error over the length {error:.1e}", 1e3 * field);
        assert!(error <= FULL_BY_DEFAULT, "{segments} segments: {error:e}");
    }
}

/// The tip of three segments beside the magnet pair, with rings acting on spans: off by no more than was asked for.
#[test]
fn the_accuracy_of_rings_and_spans_is_held() {
    let scene =
        Scene::parse("[design]\nsegments = 3\n[magnet]\norientation_wxyz = [0, 1, 0, 0]", "test scene")
            .unwrap();
    let length = scene.design().unwrap().length();
    let tip = |pair_accuracy: f64| {
        let mut scene = scene.clone();
        scene.settings = Settings { pair_accuracy, interaction: Interaction::Full, ..scene.settings };
        let mut manipulator = scene.manipulator(2).unwrap();
        manipulator.solve(&scene.inputs).unwrap().tip
    };
    let exact = tip(1e-8);
    for accuracy in [1e-5, 2e-5, 3e-5, 4e-5, 6e-5, 1e-4, 2e-4, 3e-4, 1e-3] {
        let tip = tip(accuracy);
        let (distance, angle) =
            ((tip.position - exact.position).norm() / length, tip.axis().angle(&exact.axis()));
        println!("accuracy {accuracy:.0e}: tip {distance:.1e} of the length, {angle:.1e} rad");
        assert!(distance <= accuracy && angle <= ANGLE_BY_ACCURACY * accuracy, "{accuracy:e}");
    }
}

/// Far from the magnet a section counts as one point: within the accuracy asked for, and only if that allows it.
#[test]
fn sections_are_as_coarse_as_the_accuracy_allows() {
    let text = "[design]\nsegments = 3\n[magnet]\nposition_mm = [0.0, 120.0, 10.0]\norientation_wxyz = [0.8, 0.6, 0, 0]";
    let scene = Scene::parse(text, "test scene").unwrap();
    let magnet = scene.sources.magnet().cloned();
    let energy = |pair_accuracy: f64| {
        let settings = Settings { pair_accuracy, interaction: Interaction::None, ..scene.settings };
        let mut equilibrium =
            Equilibrium::new(&scene.design().unwrap(), magnet.as_ref(), settings, 2).unwrap();
        let straight = vec![0.0; equilibrium.freedoms()];
        equilibrium.gradient(&scene.inputs, &straight).unwrap().0
    };
    let fine = energy(1e-9);
    for (accuracy, coarse) in [(1e-5, false), (5e-3, true)] {
        let error = (energy(accuracy) / fine - 1.0).abs();
        println!("accuracy {accuracy:.0e}: {error:.1e}");
        assert!(error <= accuracy);
        assert_eq!(error > 1e-5, coarse);
    }
}

#[test]
fn references_beside_the_magnet_pair_agree() {
    for level in ["none", "rings"] {
        let text = format!("[magnet]\n[model]\ninteraction = \"{level}\"\ntime_budget_s = 60.0");
        let scene = Scene::parse(&text, level).unwrap();
        let tip = |degree, pair_accuracy| {
            let settings =
                Settings { degree, pair_accuracy, fine_stations: true, ..scene.settings.as_discretised() };
            let mut manipulator = Scene { settings, ..scene.clone() }.manipulator(2).unwrap();
            manipulator.solve(&scene.inputs).unwrap().tip.position
        };
        let apart = (tip(8, 1e-10) - tip(7, 5e-10)).norm() / scene.design().unwrap().length();
        println!("{level}: {apart:.1e} of the length");
        assert!(apart <= BETWEEN_REFERENCES, "{level}: {apart:e} of the length");
    }
}
