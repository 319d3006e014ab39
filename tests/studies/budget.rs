//! The budget of tolerances and omissions: each number beside solves of scenes that state the change.

use std::sync::LazyLock;

use mcm::design::{Segmented, Specification, gent_modulus};
use mcm::manipulator::{Scene, Status};
use mcm::studies::{BUDGET_SCENES, BudgetKind, Contribution, budget, fig7b};

use super::{Counted, number, row as compared};
use crate::tolerance::{BUDGET_POINTS, BUDGET_SOLVES, BY_RECOIL};

static ROWS: LazyLock<Vec<Contribution>> = LazyLock::new(|| {
    let parts = Counted::default();
    let rows = budget(&parts).unwrap();
    parts.assert_complete(20);
    rows
});

const ONE: &str = BUDGET_SCENES[0].name;

/// The row of a quantity in one scene.
fn entry(quantity: &str, scene: &str) -> &'static Contribution {
    let found = ROWS.iter().find(|row| row.quantity.starts_with(quantity) && row.scene == Some(scene));
    found.unwrap_or_else(|| panic!("no row of {quantity} in {scene}"))
}

fn ends(quantity: &str, scene: &str) -> [f64; 2] {
    let row = entry(quantity, scene);
    [row.least_percent.unwrap(), row.largest_percent.unwrap()]
}

/// Tip angle (rad) of a scene as its file states it; none where it snaps.
fn tip_angle(scene: &Scene) -> Option<f64> {
    let mut manipulator = scene.manipulator(2).unwrap();
    let outputs = manipulator.solve(&scene.inputs).unwrap();
    matches!(outputs.status, Status::Solved | Status::NearFold).then_some(outputs.tip_angle)
}

fn stated(segments: usize, field_mt: f64, keys: &str) -> Scene {
    let text = format!(
        "[model]\ninteraction = \"full\"\n[design]\nsegments = {segments}\n[field]\nuniform_mt = [0, {field_mt}, 0]\n{keys}"
    );
    Scene::parse(&text, "test").unwrap()
}

/// Change of the tip angle by other keys, percent.
fn percent(segments: usize, field_mt: f64, [before, after]: [&str; 2]) -> Option<f64> {
    let angle = |keys| tip_angle(&stated(segments, field_mt, keys));
    Some(100.0 * (angle(after)? / angle(before)? - 1.0))
}

#[test]
fn every_change_is_that_of_a_scene_that_states_it() {
    let weight = "[gravity]\nacceleration_m_s2 = [0, 9.80665, 0]\n";
    // Quantity, what both sides share, and the changed keys in the order of the angle.
    let cases = [
        ("Shore A", "", ["[design.helix]\nshore_a = 34", "[design.helix]\nshore_a = 32"]),
        (
            "remanence of the rings",
            "",
            ["[design.ring]\nremanence_t = 1.323", "[design.ring]\nremanence_t = 1.377"],
        ),
        (
            "remanence of the particles",
            "",
            ["[design.helix]\nparticle_remanence_t = 0.95", "[design.helix]\nparticle_remanence_t = 1.05"],
        ),
        (
            "volume fraction",
            "",
            ["[design.helix]\nvolume_fraction = 0.26", "[design.helix]\nvolume_fraction = 0.24"],
        ),
        ("length of the rings", "", ["[design.ring]\nlength_mm = 0.95", "[design.ring]\nlength_mm = 1.05"]),
        (
            "outer radius of helix",
            "",
            ["[design.helix]\nradius_mm = 1.95", "[design.helix]\nradius_mm = 2.05"],
        ),
        (
            "density of the rings",
            weight,
            ["[design.ring]\ndensity_kg_m3 = 6300", "[design.ring]\ndensity_kg_m3 = 7700"],
        ),
        (
            "density of the composite",
            weight,
            ["[design.helix]\ndensity_kg_m3 = 2250", "[design.helix]\ndensity_kg_m3 = 2750"],
        ),
        (
            "weight",
            "",
            [
                "[gravity]\nacceleration_m_s2 = [0, -9.80665, 0]",
                "[gravity]\nacceleration_m_s2 = [0, 9.80665, 0]",
            ],
        ),
        ("Poisson's ratio", "", ["[design.helix]\npoisson = 0.49", "[design.helix]\npoisson = 0.499"]),
        ("rings of N48", "", ["[design.ring]\nremanence_t = 1.37", "[design.ring]\nremanence_t = 1.42"]),
        ("recoil", "", ["[design.ring]\nrecoil_permeability = 1.05"; 2]),
    ];
    for (quantity, shared, keys) in cases {
        for scene in BUDGET_SCENES {
            let field = 1e3 * scene.field;
            let got = ends(quantity, scene.name);
            for (got, keys) in got.into_iter().zip(keys) {
                let expected = percent(scene.segments, field, [shared, &format!("{shared}{keys}")]).unwrap();
                let case = format!("{quantity}, {}: {keys}", scene.name);
                assert!((got - expected).abs() <= BUDGET_SOLVES, "{case}: {got}, expected {expected}");
            }
        }
    }
}

/// An estimate by another model: hardness -5/+6 %, remanence -2.9 %, 3.5 % less stiffness about +5 %.
#[test]
fn one_segment_changes_as_an_independent_model_says() {
    let [harder, softer] = ends("Shore A", ONE);
    let [weaker, _] = ends("remanence of the rings", ONE);
    let [least, _] = ends("spans on spans", ONE);
    for (got, expected) in [(harder, -5.0), (softer, 6.0), (weaker, -2.9), (least * 3.5 / 3.1, 5.0)] {
        assert!((got - expected).abs() <= BUDGET_POINTS, "{got}, expected {expected}");
    }
    let angle = entry("Shore A", ONE).tip_angle_deg.unwrap();
    assert!((angle - 42.56).abs() < crate::tolerance::TWO_DECIMALS_DEG, "{angle}");
}

/// The shape depends on `M B / E` and `M^2 / E` alone: a softer device is one of more magnetisation in more field.
#[test]
fn softer_spans_bend_as_more_magnetisation_in_more_field_does() {
    let [least, largest] = ends("spans on spans", ONE);
    let [harder, softer] = ends("Shore A", ONE);
    let [stiffest, stiffer] = ends("stiffness of the spiral", ONE);
    let by_hardness = |hardness| gent_modulus(hardness) / gent_modulus(33.0) - 1.0;
    let changes = [
        (least, -0.031),
        (largest, -0.076),
        (stiffest, 0.221),
        (stiffer, 0.168),
        (harder, by_hardness(34.0)),
        (softer, by_hardness(32.0)),
    ];
    for (got, change) in changes {
        let gain = (1.0 + change).powf(-0.5_f64);
        let keys = format!(
            "[design.ring]\nremanence_t = {}\n[design.helix]\nparticle_remanence_t = {gain}",
            1.35 * gain
        );
        let before = tip_angle(&stated(1, 20.0, "")).unwrap();
        let after = tip_angle(&stated(1, 20.0 * gain, &keys)).unwrap();
        let expected = 100.0 * (after / before - 1.0);
        assert!((got - expected).abs() <= BUDGET_SOLVES, "{change}: {got}, expected {expected}");
    }
}

/// The mean magnetisation is that of `tests/bench/recoil_permeability.csv`.
#[test]
fn recoil_permeability_acts_by_the_moment_alone() {
    let mean = 0.972_899_699;
    let weaker = format!("[design.ring]\nremanence_t = {}", 1.35 * mean);
    for scene in BUDGET_SCENES {
        let [got, _] = ends("recoil", scene.name);
        let expected = percent(scene.segments, 1e3 * scene.field, ["", &weaker]).unwrap();
        assert!((got / expected - 1.0).abs() <= BY_RECOIL, "{}: {got}, expected {expected}", scene.name);
        println!("{}: {got:.3} %", scene.name);
    }
}

#[test]
fn a_thinner_core_is_pulled_shut() {
    for (quantity, keys) in [
        ("outer radius of the core", "core_outer_radius_mm = 0.9"),
        ("inner radius", "core_inner_radius_mm = 0.8"),
    ] {
        for scene in BUDGET_SCENES {
            let row = entry(quantity, scene.name);
            assert!(row.pulled_shut && row.largest_percent.is_none() && row.least_percent.unwrap() < -5.0);
            let thin = stated(scene.segments, 1e3 * scene.field, &format!("[design.helix]\n{keys}"));
            assert_eq!(tip_angle(&thin), None, "{quantity}, {}", scene.name);
        }
    }
}

/// A helix of another spacing has the same core, spiral section and rings.
#[test]
fn rings_further_apart_bend_less() {
    for scene in BUDGET_SCENES {
        let [least, largest] = ends("spacing", scene.name);
        assert!(least < -1.0 && largest > -least, "{}: {least}, {largest}", scene.name);
    }
    let Specification::Segmented(Segmented { helix, .. }) = Specification::paper(1) else { panic!("rings") };
    let before = helix.geometry().unwrap();
    // 0.1 mm more, half of it in each closed end.
    let height = before.height + 0.05e-3;
    let pitch = before.pitch * height / before.height;
    let windings = before.core_length / (height + pitch);
    let keys = format!(
        "[design.helix]\nlength_mm = 4.1\nwindings = {windings}\nboundary_angle_deg = {}",
        (pitch * windings / helix.radius).to_degrees()
    );
    let apart = stated(1, 20.0, &keys);
    let Specification::Segmented(chain) = &apart.specification else { panic!("rings") };
    let after = chain.helix.geometry().unwrap();
    for (after, before) in
        [(after.core_length, before.core_length), (after.sector_angle, before.sector_angle)]
    {
        assert!((after / before - 1.0).abs() < 1e-12, "{after}, {before}");
    }
    let got = percent(1, 20.0, ["", &keys]).unwrap();
    assert!((got - ends("spacing", ONE)[0]).abs() <= BUDGET_SOLVES, "{got}");
}

#[test]
fn tolerances_add_by_squares() {
    for scene in BUDGET_SCENES {
        let own =
            ROWS.iter().filter(|row| row.kind == BudgetKind::Tolerance && row.scene == Some(scene.name));
        let below: f64 = own.map(|row| row.least_percent.unwrap().min(0.0).powi(2)).sum();
        let all = entry("all tolerances", scene.name);
        assert!((all.least_percent.unwrap() + below.sqrt()).abs() < 1e-9);
        assert!(all.pulled_shut && all.largest_percent.is_none());
    }
}

#[test]
fn the_papers_measurements_stand_beside() {
    let paper: Vec<&Contribution> = ROWS.iter().filter(|row| row.kind == BudgetKind::Paper).collect();
    assert_eq!(paper.len(), 3);
    let study = fig7b(&()).unwrap();
    let cylinder = 100.0 * (number(&compared(&study, "solid cylinder").exact) / 16.0 - 1.0);
    let found = paper.iter().find(|row| row.quantity.contains("solid cylinder")).unwrap();
    assert!((found.least_percent.unwrap() - cylinder).abs() < 1e-9, "{cylinder}");
}

#[test]
fn rows_of_a_kind_are_sorted_by_their_size_in_the_first_scene() {
    let first = |row: &&Contribution| row.scene.is_none_or(|scene| scene == BUDGET_SCENES[0].name);
    let rows: Vec<&Contribution> = ROWS.iter().filter(first).collect();
    let kinds: Vec<BudgetKind> = rows.iter().map(|row| row.kind).collect();
    assert!(
        kinds.is_sorted() && kinds.windows(2).filter(|pair| pair[0] != pair[1]).count() == 3,
        "{kinds:?}"
    );
    for pair in rows.windows(2).filter(|pair| pair[0].kind == pair[1].kind) {
        let [before, after] = [pair[0], pair[1]];
        assert!(before.size() >= after.size(), "{} before {}", before.quantity, after.quantity);
    }
}
