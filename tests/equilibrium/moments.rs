//! A moment that is fixed in space has no potential, and does not choose the branch.

use mcm::manipulator::{Outputs, Scene};

use crate::tolerance::VANISHING_MOMENT_DEG;

/// Three segments in a field that turns them far over.
fn turned_over(interaction: &str, moment: f64) -> Outputs {
    let text = format!(
        "[design]\nsegments = 3\n[field]\nuniform_mt = [0, 5.17638, -19.31852]\n[load]\n\
         tip_moment_nm = [0, 0, {moment:e}]\n[model]\ninteraction = \"{interaction}\""
    );
    let mut scene = Scene::parse(&text, "turned over").expect("a scene");
    scene.settings.time_budget = 60.0;
    let mut manipulator = scene.manipulator(2).expect("allowed");
    manipulator.solve(&scene.inputs).expect("finite inputs").clone()
}

#[test]
fn a_vanishing_moment_leaves_the_answer_without_it() {
    for (interaction, expected) in [("none", 140.316), ("auto", 126.712)] {
        let without = turned_over(interaction, 0.0);
        assert!((without.tip_angle.to_degrees() - expected).abs() < 1e-2, "{interaction}: {without:?}");
        for moment in [1e-12, -1e-11] {
            let with = turned_over(interaction, moment);
            let apart = (with.tip_angle - without.tip_angle).to_degrees().abs();
            assert!(with.stable == Some(true) && apart <= VANISHING_MOMENT_DEG, "{interaction}: {apart}");
        }
    }
}
