//! What is said of a device that its rings pull shut.

use mcm::equilibrium::Interaction;
use mcm::manipulator::{Collapse, Remedy, Scene, SceneFile, Status};

fn said(bend: Option<f64>, remedy: Remedy) -> String {
    Collapse { bend, level: Interaction::Full, remedy }.to_string()
}

#[test]
fn a_remedy_is_one_line_with_key_and_value() {
    let shut = "unloaded, the rings pull this device shut (level full); ";
    let from = |under_loads| Remedy::From {
        key: "design.helix.shore_a",
        value: 26.1,
        downwards: false,
        under_loads,
    };
    let stands = format!("{shut}it stands from design.helix.shore_a = 26.1 on");
    assert_eq!(said(None, from(None)), stands);
    assert_eq!(said(None, from(Some(true))), stands);
    assert_eq!(said(Some(2.6), from(None)), format!("bent by 149 deg at rest: {stands}"));
    assert_eq!(
        said(None, from(Some(false))),
        format!("{stands}, but has no shape there under the loads of this scene")
    );

    let unknown = |late| Remedy::Unknown { key: "design.helix.shore_a", value: 95.0, late };
    let nothing = format!("{shut}no value found up to design.helix.shore_a = 95");
    assert_eq!(said(None, unknown(false)), nothing);
    assert_eq!(said(None, unknown(true)), format!("{nothing} within model.time_budget_s"));
}

/// What is said of a scene after a cold solve.
fn judged(text: &str) -> (Status, Option<Collapse>) {
    let file = SceneFile::parse(text, "judged").unwrap();
    let scene: Scene = file.scene().unwrap();
    let outputs = scene.manipulator(2).unwrap().solve(&scene.inputs).unwrap().clone();
    (outputs.status, Collapse::of(&file, &scene, &outputs).unwrap())
}

#[test]
fn devices_that_stand_or_whose_rings_do_nothing_are_not_judged() {
    for text in [
        "[design]\nsegments = 2",
        "[design]\nsegments = 2\n[model]\ninteraction = \"none\"",
        "[design]\nkind = \"cylinder\"\nlength_mm = 20.0\nradius_mm = 1.0",
        "[design]\nsegments = 1\n[field]\nuniform_mt = [0, 20, 0]",
    ] {
        let (status, collapse) = judged(text);
        assert!(status != Status::NotSolved && collapse.is_none(), "{text}: {collapse:?}");
    }
}

#[test]
fn without_time_for_a_search_none_is_invented() {
    let soft = "[design]\nsegments = 2\n[design.helix]\nshore_a = 5.0\n[model]\ninteraction = \"full\"\n";
    let (status, collapse) = judged(&format!("{soft}time_budget_s = 60.0"));
    assert_eq!(status, Status::NotSolved);
    assert!(matches!(collapse.unwrap().remedy, Remedy::From { key: "design.helix.shore_a", .. }));
    let (status, collapse) = judged(&format!("{soft}time_budget_s = 1e-6"));
    assert!(status == Status::NotSolved && collapse.is_none(), "{collapse:?}");
}
