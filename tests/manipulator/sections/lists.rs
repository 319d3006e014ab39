//! Numbers of helices and rings as lists with one value for each segment or ring.

use mcm::manipulator::{Outputs, Scene, SceneFile};

const REST: &str = "[field]\nuniform_mt = [1.0, 9.0, 2.0]\n[gravity]\nacceleration_m_s2 = [0.0, 0.0, -9.81]\n\
                    [model]\ninteraction = \"full\"\ntime_budget_s = 60.0\n";

fn solved(design: &str) -> Outputs {
    let scene = Scene::parse(&format!("[design]\nsegments = 2\n{design}{REST}"), "test").expect("allowed");
    scene.manipulator(3).expect("allowed").solve(&scene.inputs).expect("finite").clone()
}

/// Every key of both tables, with the number of its default.
const HELIX: [(&str, f64); 11] = [
    ("length_mm", 4.0),
    ("boundary_angle_deg", 40.0),
    ("radius_mm", 2.0),
    ("windings", 2.0),
    ("core_outer_radius_mm", 0.95),
    ("core_inner_radius_mm", 0.75),
    ("shore_a", 33.0),
    ("poisson", 0.4),
    ("volume_fraction", 0.25),
    ("particle_remanence_t", 1.0),
    ("density_kg_m3", 2500.0),
];
const RING: [(&str, f64); 4] =
    [("length_mm", 1.0), ("remanence_t", 1.35), ("recoil_permeability", 1.0), ("density_kg_m3", 7000.0)];

#[test]
fn a_list_of_equal_numbers_is_that_number_bit_for_bit() {
    let table = |lists: bool| {
        let number = |value: f64, count: usize| {
            if lists { format!("{:?}", vec![value; count]) } else { format!("{value:?}") }
        };
        let rows = |keys: &[(&str, f64)], count: usize| {
            let rows = keys.iter().map(|(key, value)| format!("{key} = {}", number(*value, count)));
            rows.collect::<Vec<_>>().join("\n") + "\n"
        };
        format!(
            "spiral_start_deg = {}\n[design.helix]\n{}[design.ring]\n{}",
            number(20.0, 2),
            rows(&HELIX, 2),
            rows(&RING, 3)
        )
    };
    let (one, list) = (solved(&table(false)), solved(&table(true)));
    assert_eq!(one.tip, list.tip);
    assert_eq!(one.energy.to_bits(), list.energy.to_bits());
    assert_eq!(one.rings, list.rings);
}

#[test]
fn each_value_is_that_of_its_own_segment_or_ring() {
    let own = solved("[design.helix]\nshore_a = [33.0, 60.0]\n");
    let soft = solved("");
    let hard = solved("[design.helix]\nshore_a = 60.0\n");
    let angle = |outputs: &Outputs, core: usize| outputs.core_angles[core];
    assert!(angle(&own, 1) < 0.6 * angle(&soft, 1), "the harder core bends less");
    assert!(angle(&own, 0) > 1.2 * angle(&hard, 0), "the softer core bends more");

    let reversed = solved("[design.ring]\nremanence_t = [1.35, -1.35, 1.35]\n");
    let turned = solved("[design.ring]\ndirection = [[0.0, 0.0, 1.0], [0.0, 0.0, -1.0], [0.0, 0.0, 1.0]]\n");
    assert_eq!(reversed.tip, turned.tip, "a negative remanence is the reversed direction");
}

#[test]
fn an_entry_of_a_list_can_be_varied_where_the_file_has_one_number() {
    let file =
        SceneFile::parse(&format!("[design]\nsegments = 3\n[design.helix]\nshore_a = 40.0\n{REST}"), "test");
    let file = file.expect("allowed");
    for key in ["design.helix.shore_a", "design.helix.volume_fraction", "design.ring.remanence_t"] {
        let varied = file.with(&format!("{key}[2]"), 0.3).expect("a key").to_toml().expect("text");
        let count = if key.contains("ring") { 4 } else { 3 };
        assert!(SceneFile::parse(&varied, "test").is_ok(), "{varied}");
        let number = file.with(&format!("{key}[2]"), 0.3).unwrap().number(&format!("{key}[{count}]"));
        assert_eq!(number, file.number(key), "{key}: the others stay");
        assert!(file.with(&format!("{key}[{}]", count + 1), 0.3).is_err(), "{key} has {count} entries");
    }
}

#[test]
fn a_list_of_the_wrong_length_names_both_lengths() {
    for (design, expected) in [
        (
            "[design.helix]\nvolume_fraction = [0.2, 0.3]",
            "test, line 4: design.helix.volume_fraction has 2 entries, expected 3, one for each segment",
        ),
        (
            "[design.ring]\nremanence_t = [1.35, -1.35, 1.35]",
            "test, line 4: design.ring.remanence_t has 3 entries, expected 4, one for each ring",
        ),
        (
            "base_magnet = false\n[design.ring]\nlength_mm = [1.0, 1.0]",
            "test, line 5: design.ring.length_mm has 2 entries, expected 3, one for each ring",
        ),
        (
            "[design.ring]\ndirection = [[1.0, 0.0, 0.0]]",
            "test, line 4: design.ring.direction has 1 entries, expected 4, one for each ring",
        ),
        (
            "[design.helix]\nshore_a = [33.0, 120.0, 33.0]",
            "test, line 4: design.helix.shore_a[2] = 120 is not allowed: it must be > 0 and < 100",
        ),
        (
            "[design.ring]\nremanence_t = [1.35, 1.35, 1.35, -30.0]",
            "test, line 4: design.ring.remanence_t[4] = -30 is not allowed: it must be from -20 to 20",
        ),
        (
            "[design.ring]\nremanence_t = -1.35",
            "test, line 4: design.ring.remanence_t = -1.35 is not allowed: it must be from 0 to 20",
        ),
        (
            "[design.ring]\nlength_mm = \"long\"",
            "test, line 4: `design.ring.length_mm`: invalid type: string \"long\", expected a number, or a list with one \
             number for each ring",
        ),
    ] {
        let text = format!("[design]\nsegments = 3\n{design}");
        assert_eq!(super::super::refusals::refusal(&text), expected);
    }
}
