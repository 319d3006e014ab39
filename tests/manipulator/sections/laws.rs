//! Symmetries of devices made of sections, and a closed form.

use core::f64::consts::PI;

use mcm::geometry::Pose;
use mcm::manipulator::{Outputs, Scene};
use nalgebra::{Matrix3, Vector3};
use rand::rngs::StdRng;
use rand::{RngExt, SeedableRng};

use super::devices::Device;
use crate::given::direction;
use crate::tolerance::{CLOSED_FORM, MIRRORED, SAME_DEVICE};

/// Number of random devices at each level.
const DEVICES: u64 = 6;

fn solved(text: &str) -> Outputs {
    let scene = Scene::parse(text, "test").unwrap_or_else(|error| panic!("{error}\n{text}"));
    let outputs = scene.manipulator(2).expect("allowed").solve(&scene.inputs).expect("finite").clone();
    assert_eq!(outputs.stable, Some(true), "{:?}\n{text}", outputs.outcome);
    outputs
}

/// Solves random devices and what `change` makes of them, and compares the tips with what `expected` says.
fn compare(what: &str, change: impl Fn(&Device, &mut StdRng) -> (Device, Pose, bool)) {
    for level in ["none", "rings"] {
        for seed in 0..DEVICES {
            println!("{what}, level {level}, seed {seed}");
            let mut random = StdRng::seed_from_u64(seed);
            let device = Device::random(&mut random, level);
            let (changed, moved, mirrored) = change(&device, &mut random);

            let (own, other) = (solved(&device.text()), solved(&changed.text()));
            let mirror = Matrix3::from_diagonal(&Vector3::new(if mirrored { -1.0 } else { 1.0 }, 1.0, 1.0));
            let tip =
                Pose { position: mirror * own.tip.position, rotation: mirror * own.tip.rotation * mirror };
            let tip = moved.compose(&tip);
            let apart = (other.tip.position - tip.position).norm() / device.length();
            assert!(apart <= MIRRORED, "{what}, level {level}, seed {seed}: {apart:e} of the length");
            let turned = (other.tip.rotation - tip.rotation).norm();
            assert!(turned <= 10.0 * MIRRORED, "{what}, level {level}, seed {seed}: turned by {turned:e}");
        }
    }
}

#[test]
fn a_mirror_image_bends_as_the_mirror_shows() {
    compare("mirrored", |device, _| (device.mirrored(), Pose::identity(), true));
}

#[test]
fn a_scene_moved_as_a_whole_bends_alike() {
    compare("moved", |device, random| {
        let [x, y, z] = direction(random).into();
        let position = (direction(random) * random.random_range(0.0..0.1)).into();
        let by = Pose::new(position, [0.0, x, y, z]).expect("a unit quaternion");
        (device.moved(&by), by, false)
    });
}

#[test]
fn with_all_magnets_and_fields_reversed_it_bends_alike() {
    compare("reversed", |device, _| (device.reversed(), Pose::identity(), false));
}

/// A uniformly magnetised rod, magnetised across its axis in a field along it: the elastica of a pendulum,
/// `EI theta'' = -M A B cos(theta)`, so that `EI theta'^2 / 2 = M A B (sin(theta_end) - sin(theta))`.
#[test]
fn a_rod_magnetised_across_bends_as_a_pendulum_swings() {
    let (length, radius, modulus, remanence, field) = (30e-3, 0.5e-3_f64, 2e6, 0.1, 10e-3);
    let bending = modulus * PI * radius.powi(4) / 4.0;
    let text = format!(
        "[design]\nkind = \"sections\"\n[[design.section]]\nlength_mm = 30.0\nouter_radius_mm = 0.5\n\
         bending_stiffness_n_m2 = {bending:e}\ntorsional_stiffness_n_m2 = {bending:e}\naxial_stiffness_n = 1e6\n\
         remanence_t = 0.1\ndirection = [0.0, 1.0, 0.0]\n[field]\nuniform_mt = [0.0, 0.0, 10.0]\n[model]\n\
         interaction = \"none\"\ntolerance_position_mm = 1e-6\ntolerance_relative = 0.0\n"
    );
    let outputs = solved(&text);

    // The end angle by bisection of the length that the quadrature of d s = d theta / theta' gives, in t with theta = end (1 - t^2).
    let load = remanence / mcm::constants::VACUUM_PERMEABILITY * PI * radius * radius * field / bending;
    let (nodes, weights) = mcm::numerics::quadrature::gauss_legendre(60);
    let along = |end: f64, of: &dyn Fn(f64) -> f64| -> f64 {
        let point = |(x, w): (&f64, &f64)| {
            let t = 0.5 * (1.0 + x);
            let theta = end * (1.0 - t * t);
            let rate = (2.0 * load * (end.sin() - theta.sin())).sqrt();
            0.5 * w * 2.0 * end * t / rate * of(theta)
        };
        nodes.iter().zip(&weights).map(point).sum()
    };
    let (mut low, mut high) = (0.1, 1.5);
    for _ in 0..60 {
        let middle = 0.5 * (low + high);
        if along(middle, &|_| 1.0) < length { low = middle } else { high = middle }
    }
    let end = 0.5 * (low + high);
    assert!((end.to_degrees() - 72.6045).abs() < 1e-4, "{}", end.to_degrees());
    let expected = Vector3::new(0.0, -along(end, &f64::sin), along(end, &f64::cos));
    let apart = (outputs.tip.position - expected).norm() / length;
    assert!(apart < CLOSED_FORM, "{} instead of {expected}: {apart:e}", outputs.tip.position);
    assert!((outputs.tip_angle - end).abs() < CLOSED_FORM, "{} instead of {end}", outputs.tip_angle);
}

/// The device of the paper with the spirals spread, written as segments and as sections with the same moments.
#[test]
fn segments_written_as_sections_are_the_same_device() {
    let (segments, fraction, elastic) = (2, 0.25, mcm::design::gent_modulus(33.0));
    let modulus = 2.0 * 1.4 * mcm::design::composite_shear_modulus(elastic, 0.4, fraction);
    let helix = mcm::design::Helix::paper();
    let geometry = helix.geometry().expect("allowed");
    let tube = |outer: f64| outer * outer - helix.core_inner_radius * helix.core_inner_radius;
    let core = tube(helix.core_outer_radius);
    let spiral = geometry.sector_angle / (2.0 * PI)
        * (helix.radius * helix.radius - helix.core_outer_radius * helix.core_outer_radius);

    let soft = |length: f64, outer: f64, remanence: f64| {
        format!(
            "[[design.section]]\nlength_mm = {:e}\nouter_radius_mm = {:e}\ninner_radius_mm = 0.75\n\
             elastic_modulus_mpa = {:e}\npoisson = 0.4\nremanence_t = {remanence:e}\n",
            1e3 * length,
            1e3 * outer,
            1e-6 * modulus
        )
    };
    let ring = "[[design.section]]\nlength_mm = 1.0\nouter_radius_mm = 2.0\ninner_radius_mm = 0.75\nrigid = true\n\
                remanence_t = 1.35\n";
    let disc = soft(geometry.height, helix.radius, fraction);
    let middle = soft(geometry.core_length, helix.core_outer_radius, fraction * (core + spiral) / core);
    let one = format!("{disc}{middle}{disc}{ring}");
    let sections = format!("[design]\nkind = \"sections\"\n{ring}{}", one.repeat(segments));
    let rest = "[field]\nuniform_mt = [3.0, 12.0, 4.0]\n[model]\ninteraction = \"rings\"\n";
    let written = format!("[design]\nsegments = {segments}\nspiral = \"axisymmetric\"\n{rest}");

    let (own, other) = (solved(&written), solved(&format!("{sections}{rest}")));
    let apart = (own.tip.position - other.tip.position).norm();
    assert!(apart < SAME_DEVICE, "{apart:e} m");
    assert!((own.energy / other.energy - 1.0).abs() < 1e-9, "{} and {}", own.energy, other.energy);
}
