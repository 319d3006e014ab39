//! The tolerances of the tip, as a scene and a host set them.

use mcm::equilibrium::{Interaction, Settings};
use mcm::manipulator::{Inputs, Manipulator, Scene, SceneFile, Status, TipTolerance};
use nalgebra::Vector3;
use rand::rngs::StdRng;
use rand::{RngExt, SeedableRng};
use rayon::prelude::*;

use crate::tolerance::{ROUNDING, assert_close};

/// A cantilever of steel wire, 500 mm long and 10 mm thick, with 0.1 N at its tip.
const CANTILEVER: &str = "[design]\nkind = \"cylinder\"\nlength_mm = 500.0\nradius_mm = 5.0\nelastic_modulus_mpa = 50000.0\n\
                          poisson = 0.3\nremanence_t = 0.0\n[load]\ntip_force_n = [0.0, 0.1, 0.0]\n";

/// Deflection of that cantilever, m: bending, `F L^3 / (3 E I)`, and shear, `F L / (kappa G A)` with the library's shear correction of a
/// full circle. The slope is 5e-4, whose square is what the linear theory leaves out.
fn deflection() -> f64 {
    let (force, length, radius, modulus, poisson) = (0.1, 0.5_f64, 5e-3_f64, 50e9, 0.3);
    let area = core::f64::consts::PI * radius * radius;
    let bending = force * length.powi(3) / (3.0 * modulus * 0.25 * area * radius * radius);
    bending + force * length / (modulus / (2.0 * (1.0 + poisson)) * area)
}

#[test]
fn a_stiff_cantilever_comes_right_at_the_default() {
    let sideways = |more: &str| {
        let scene = Scene::parse(&format!("{CANTILEVER}{more}"), "cantilever").unwrap();
        let mut manipulator = scene.manipulator(2).unwrap();
        let outputs = manipulator.solve(&scene.inputs).unwrap();
        (outputs.tip.position.y, outputs.error_estimate)
    };
    let exact = deflection();
    assert!((exact - 1.698e-4).abs() < 1e-8, "{exact}");
    for level in ["auto", "rings", "full", "none"] {
        let (y, estimate) = sideways(&format!("[model]\ninteraction = \"{level}\""));
        println!("{level}: {:.5} mm, estimated error {estimate:.1e} m", y * 1e3);
        assert!((y - exact).abs() < 1e-3 * exact && estimate <= 1e-3 * y, "{level}: {y}, {estimate}");
    }
    // The relative tolerance is what decides here.
    let (y, _) = sideways("[model]\ntolerance_relative = 0.0");
    assert!((y - exact).abs() > 2e-3 * exact, "{y}");
    let (y, estimate) = sideways("[model]\ntolerance_relative = 0.0\ntolerance_position_mm = 0.0001");
    assert!((y - exact).abs() < 1e-7 && estimate <= 1e-7, "{y}");
}

#[test]
fn the_way_of_the_tip_is_that_of_the_device_and_not_of_its_base() {
    // Neither a base elsewhere, nor one that is turned, nor a shaft that is fed, is a way of the tip.
    let unloaded = |text: &str| {
        let scene = Scene::parse(text, "unloaded").unwrap();
        let mut manipulator = scene.manipulator(2).unwrap();
        manipulator.solve(&scene.inputs).unwrap().error_estimate
    };
    let device =
        "[design]\nsegments = 2\n[field]\nuniform_mt = [0, 0.05, 0]\n[model]\ninteraction = \"auto\"\n";
    let shaft = "[feed]\nmode = \"insertion\"\ninsertion_mm = 80.0\n[feed.shaft]\nouter_radius_mm = 0.9\ninner_radius_mm = 0.7\n\
                 elastic_modulus_mpa = 5000.0\npoisson = 0.45\n";
    let plain = unloaded(device);
    let base = "[base]\nposition_mm = [30.0, -70.0, 200.0]\nturn_deg = 25.0\n";
    let turned = "[base]\nposition_mm = [30.0, -70.0, 200.0]\nturn_deg = 25.0\n[field]\nuniform_mt = [0, 0.05, 0]\nturn_deg = 25.0\n\
                  [design]\nsegments = 2\n[model]\ninteraction = \"auto\"\n";
    let elsewhere = unloaded(turned);
    assert!((elsewhere / plain - 1.0).abs() < 1e-3, "{plain} and {elsewhere}");
    assert!(unloaded(&format!("{device}{base}")) < 1e-6);
    // The tip has moved by some tens of micrometres: the tolerance is some hundredths of one.
    assert!(plain < 1e-6 && unloaded(&format!("{device}{shaft}")) < 1e-6, "{plain}");
}

#[test]
fn keys_of_a_scene_are_the_settings() {
    let text = "[model]\ntolerance_position_mm = 0.002\ntolerance_angle_deg = 0.5\ntolerance_relative = 0.01\niterations = 77\n";
    let file = SceneFile::parse(text, "test").unwrap();
    let settings = file.scene().unwrap().settings;
    let tolerances = [settings.tolerance_position, settings.tolerance_angle, settings.tolerance_relative];
    assert_close("tolerances", &tolerances, &[2e-6, 0.5_f64.to_radians(), 0.01], ROUNDING);
    assert_eq!(settings.iterations, 77);
    assert_eq!(SceneFile::parse(&file.to_toml().unwrap(), "again").unwrap(), file);
    let usual = Scene::parse("", "usual").unwrap().settings;
    assert_eq!(Settings { interaction: Interaction::Auto, ..Settings::default() }, usual);
    for (key, value) in [
        ("tolerance_position_mm", "0.0"),
        ("tolerance_angle_deg", "-1.0"),
        ("tolerance_relative", "1.5"),
        ("tolerance_relative", "-0.1"),
        ("iterations", "0"),
    ] {
        let refused = SceneFile::parse(&format!("[model]\n{key} = {value}"), "test").unwrap_err().to_string();
        assert!(refused.starts_with(&format!("test, line 2: model.{key} = ")), "{refused}");
    }
}

#[test]
fn few_iterations_end_a_solve() {
    let scene = "[design]\nsegments = 3\n[field]\nuniform_mt = [0, 15, 0]\n[model]\ninteraction = \"rings\"\niterations = ";
    let status = |iterations: u32| {
        let scene = Scene::parse(&format!("{scene}{iterations}"), "few").unwrap();
        let mut manipulator = scene.manipulator(2).unwrap();
        manipulator.solve(&scene.inputs).unwrap().status
    };
    assert_eq!((status(2), status(1500)), (Status::NotSolved, Status::Solved));
}

#[test]
fn by_default_the_tip_is_within_a_thousandth_of_its_way() {
    const SCENES: u64 = 300;
    let settings = Settings { interaction: Interaction::Auto, time_budget: 60.0, ..Settings::default() };
    let worst = (0..SCENES).into_par_iter().filter_map(|number| {
        let mut random = StdRng::seed_from_u64(number);
        let segments = random.random_range(1..=3);
        let spiral = if random.random_bool(0.5) { "helical" } else { "axisymmetric" };
        let shore = random.random_range(30.0..60.0);
        let text = format!("[design]\nsegments = {segments}\nspiral = \"{spiral}\"\n[design.helix]\nshore_a = {shore}\n[magnet]");
        let scene = Scene::parse(&text, "random").unwrap();
        // From motions of a micrometre to some of several millimetres.
        let mut inputs: Inputs = scene.inputs.clone();
        let far = 10_f64.powf(random.random_range(-0.9..0.5));
        inputs.sources[0].pose.position = Vector3::from_fn(|_, _| random.random_range(-1.0..1.0_f64)).normalize() * far;
        inputs.tip_force = Vector3::from_fn(|_, _| random.random_range(-1.0..1.0)) * 10_f64.powf(random.random_range(-7.0..-3.3));
        let (design, sources) = (scene.design().unwrap(), scene.sources);
        let device = |settings| Manipulator::new(&design, &sources, settings, 2).unwrap();
        let mut own = device(settings);
        let own = own.solve(&inputs).ok().filter(|outputs| outputs.status == Status::Solved)?.clone();

        let exact = Settings { interaction: Interaction::Full, bending_stop: Some(true), degree: 6, pair_accuracy: 1e-9, ..settings };
        let mut exact = device(exact.as_discretised());
        let exact = exact.solve(&inputs).ok().filter(|outputs| outputs.status == Status::Solved)?.clone();
        let travel = (exact.tip.position - Vector3::z() * design.length()).norm();
        let allowed = (1e-3 * travel).max(1e-8).min(settings.tolerance_position);
        Some(((own.tip.position - exact.tip.position).norm() / allowed, number, travel))
    });
    let mut worst: Vec<(f64, u64, f64)> = worst.collect();
    worst.sort_by(|a, b| b.0.total_cmp(&a.0));
    println!("{} solved; parts of the tolerance, scene, way of the tip (m): {:?}", worst.len(), &worst[..5]);
    assert!(worst.len() as u64 > SCENES * 9 / 10 && worst[0].0 <= 1.0, "{:?}", &worst[..5]);
    let ways = [
        worst.iter().map(|row| row.2).fold(f64::MAX, f64::min),
        worst.iter().map(|row| row.2).fold(0.0, f64::max),
    ];
    assert!(ways[0] < 1e-4 && ways[1] > 2e-3, "{ways:?}");
}

#[test]
fn tolerances_are_checked_and_set_anew() {
    let scene = Scene::parse("[design]\nsegments = 2\n[field]\nuniform_mt = [0, 8, 0]", "set").unwrap();
    let mut manipulator = scene.manipulator(2).unwrap();
    let loose = TipTolerance { position: 1e-3, angle: 0.1, relative: 0.0 };
    manipulator.set_tolerance(loose).unwrap();
    let before = manipulator.solve(&scene.inputs).unwrap().error_estimate;
    manipulator.set_tolerance(TipTolerance { relative: 1e-6, ..loose }).unwrap();
    let after = manipulator.solve(&scene.inputs).unwrap().clone();
    assert!(before > 1e-7 && after.error_estimate < 1e-7, "{before}, {}", after.error_estimate);
    for bad in [
        TipTolerance { position: 0.0, ..loose },
        TipTolerance { angle: f64::NAN, ..loose },
        TipTolerance { relative: -1e-3, ..loose },
        TipTolerance { relative: 1.1, ..loose },
    ] {
        assert!(manipulator.set_tolerance(bad).is_err(), "{bad:?}");
    }
    assert_eq!(manipulator.solve(&scene.inputs).unwrap().tip, after.tip);
}
