//! Every number of a scene that has a range is refused by its own key, however many others have its name or its value.

use core::f64::consts::PI;
use core::ops::Bound::{Excluded, Included, Unbounded};

use mcm::design::quantities::HELIX_WINDING_HEIGHT;
use mcm::error::{Interval, Quantity};
use mcm::magnetics::quantities::MULTIPOLE;
use mcm::manipulator::SceneFile;
use mcm::{design, equilibrium, magnetics, vessel};

/// Devices that together have every key. Several of their numbers are equal, such as the hardness of helix and shaft.
const SCENES: [&str; 9] = [
    "[design]\nkind = \"sections\"\n[[design.section]]\nlength_mm = 4.0\nouter_radius_mm = 0.5\nelastic_modulus_mpa = 2.0\n\
     [[design.section]]\nlength_mm = 4.0\nouter_radius_mm = 0.5\nelastic_modulus_mpa = 2.0\npoisson = 0.4\nremanence_t = 0.1\n\
     density_kg_m3 = 1000.0\n",
    "[design]\nkind = \"sections\"\n[[design.section]]\nlength_mm = 4.0\nouter_radius_mm = 0.5\nshore_a = 33.0\n\
     [[design.section]]\nlength_mm = 4.0\nouter_radius_mm = 0.5\nshore_a = 33.0\nvolume_fraction = 0.2\nparticle_remanence_t = 1.0\n",
    "[design]\nkind = \"sections\"\n[[design.section]]\nlength_mm = 4.0\nouter_radius_mm = 0.5\nshore_a = 33.0\n\
     [[design.section]]\nlength_mm = 4.0\nouter_radius_mm = 0.5\nbending_stiffness_n_m2 = 1e-7\n\
     torsional_stiffness_n_m2 = 1e-7\naxial_stiffness_n = 1.0\nshear_stiffness_n = 1.0\n",
    "[design]\nsegments = 2\n[design.helix]\nshore_a = 30.0\npoisson = 0.45\ndensity_kg_m3 = 1000.0\n[design.ring]\n\
     recoil_permeability = 1.05\n[design.backbone]\nouter_radius_mm = 0.5\ninner_radius_mm = 0.4\nshore_a = 30.0\npoisson = 0.45\n\
     density_kg_m3 = 1000.0\n[feed]\nmode = \"insertion\"\n[feed.shaft]\nouter_radius_mm = 0.5\ninner_radius_mm = 0.4\nshore_a = 30.0\n\
     poisson = 0.45\ndensity_kg_m3 = 1000.0\n[guidewire]\nradius_mm = 0.2\nelastic_modulus_mpa = 100.0\n\
     [[magnet]]\nposition_mm = [0.0, -120.0, 8.0]\n[[magnet]]\nposition_mm = [0.0, 120.0, 8.0]\n\
     cylinders = [{ radius_mm = 20.0, length_mm = 20.0, remanence_t = 1.0 }]\n\
     [[coil]]\nposition_mm = [200.0, 0.0, 0.0]\ninner_radius_mm = 1.0\nouter_radius_mm = 2.0\nlength_mm = 2.0\nturns = 2.0\n\
     [[coil]]\nposition_mm = [0.0, 0.0, 200.0]\ninner_radius_mm = 1.0\nouter_radius_mm = 2.0\nlength_mm = 2.0\nturns = 2.0\n\
     reach_mm = 2.0\nmultipoles = [1e-6]\n\
     [vessel]\nwall_modulus_mpa = 1.0\nfriction = 0.1\n[[vessel.branch]]\nname = \"a\"\npoints_mm = [[0, 0, -9], [0, 0, 99]]\nradius_mm = [9, 9]\n",
    "[design]\nsegments = 2\n[design.backbone]\nouter_radius_mm = 0.5\ninner_radius_mm = 0.4\nelastic_modulus_mpa = 1.0\npoisson = 0.45\n\
     [feed]\nmode = \"insertion\"\n[feed.shaft]\nouter_radius_mm = 0.5\ninner_radius_mm = 0.4\nelastic_modulus_mpa = 1.0\npoisson = 0.45\n",
    "[design]\nkind = \"cylinder\"\nlength_mm = 16.0\nradius_mm = 2.0\ninner_radius_mm = 0.5\nshore_a = 33.0\npoisson = 0.4\n\
     volume_fraction = 0.2\nparticle_remanence_t = 1.0\ndensity_kg_m3 = 1000.0\n",
    "[[magnet]]\nposition_mm = [0.0, -120.0, 8.0]\nshape = \"cuboid\"\nsize_mm = [9.0, 9.0, 9.0]\ndirection = [0.0, 0.0, 1.0]\n\
     remanence_t = 1.0\n[[magnet]]\nposition_mm = [0.0, 120.0, 8.0]\nshape = \"cuboid\"\nsize_mm = [9.0, 9.0, 9.0]\n\
     direction = [0.0, 0.0, 1.0]\nremanence_t = 1.0\n",
    "[[magnet]]\nposition_mm = [0.0, -120.0, 8.0]\nshape = \"sphere\"\nradius_mm = 9.0\nremanence_t = 1.0\n\
     [[magnet]]\nposition_mm = [0.0, 120.0, 8.0]\nshape = \"cylinder\"\nradius_mm = 9.0\ninner_radius_mm = 1.0\n\
     length_mm = 9.0\nremanence_t = 1.0\n",
    "[design]\nkind = \"cylinder\"\nlength_mm = 16.0\nradius_mm = 2.0\nelastic_modulus_mpa = 1.0\npoisson = 0.4\nremanence_t = 0.2\n",
];

/// All numbers whose key holds one.
fn numbers() -> impl Iterator<Item = &'static Quantity> {
    let tables = [
        design::quantities::ALL,
        equilibrium::quantities::ALL,
        magnetics::quantities::ALL,
        vessel::quantities::ALL,
    ];
    let all = tables.into_iter().flatten().copied();
    // What may be any number is refused with others beside it: components of vectors, and turns of a whole section.
    let any = |quantity: &&Quantity| quantity.interval == Interval::FINITE;
    let all = all.filter(move |quantity| !any(quantity));
    all.filter(|quantity| ![&HELIX_WINDING_HEIGHT, &MULTIPOLE].contains(quantity))
}

/// A whole number that is not allowed, in the unit of its key.
fn outside(quantity: &Quantity) -> f64 {
    let si = match (quantity.interval.low, quantity.interval.high) {
        (Included(low) | Excluded(low), _) => low - 1.0,
        (Unbounded, Included(high) | Excluded(high)) => high + 1.0,
        (Unbounded, Unbounded) => panic!("{} may be anything", quantity.key),
    };
    let per_si = match quantity.key.trim_end_matches("[*]").rsplit('_').next() {
        Some("mm") => 1e3,
        Some("deg") => 180.0 / PI,
        Some("mpa") => 1e-6,
        _ => 1.0,
    };
    (si * per_si).floor()
}

#[test]
fn every_number_out_of_its_range_is_refused_by_its_own_key() {
    let scenes = SCENES.map(|text| SceneFile::parse(text, "test").expect("allowed"));
    let mut tried = 0;
    for quantity in numbers() {
        let key = quantity.key.replacen("cylinders[*]", "cylinders[1]", 1).replace('*', "2");
        let value = outside(quantity);
        let varied = scenes.iter().filter_map(|scene| scene.with(&key, value).ok());
        let refused: Vec<String> =
            varied.filter_map(|scene| scene.scene().err()).map(|error| error.to_string()).collect();
        let expected = format!("{key} = {value} is not allowed: it must be ");
        assert!(refused.iter().any(|said| said.starts_with(&expected)), "{key}: {refused:?}");
        tried += 1;
    }
    assert!(tried > 50, "{tried}");
}

#[test]
fn no_two_numbers_have_a_key_or_a_variable_in_common() {
    for own in [|quantity: &Quantity| quantity.key, |quantity: &Quantity| quantity.variable] {
        let mut names: Vec<&str> = numbers().map(own).filter(|name| !name.is_empty()).collect();
        let count = names.len();
        names.sort_unstable();
        names.dedup();
        assert_eq!(names.len(), count);
    }
}
