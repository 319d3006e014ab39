//! A change of the level is no snap.

use mcm::manipulator::{Branch, Scene, SceneFile};

/// Steps of the way, of each of which the count must be the same.
const STEPS: [usize; 3] = [10, 23, 46];

/// Two magnets whose second one grows: the device climbs to a finer model of level `full` far from any fold.
const SCENE: &str = "
[design]
segments = 2
[design.helix]
shore_a = 29.9
[[magnet]]
position_mm = [14.653598862721855, -59.536736996234815, 8.619585000681292]
orientation_wxyz = [-0.12091289257807912, -0.5439022831131252, 0.8210550938008989, 0.12417291079913123]
strength = 0.45
[[magnet]]
position_mm = [34.0, 50.0, 7.3]
orientation_wxyz = [-0.5357794293484762, 0.7013426925041133, 0.09665991219472274, 0.46012573513400723]
strength = 0.58
[model]
time_budget_s = 60
tolerance_relative = 0
";

#[test]
fn climbing_to_a_richer_level_is_no_snap() {
    let file = SceneFile::parse(SCENE, "two magnets").unwrap();
    let at = |strength: f64| -> Result<Scene, mcm::error::Error> {
        file.with("magnet[2].strength", strength)?.scene()
    };
    let mut angles = Vec::new();
    for steps in STEPS {
        let manipulator = at(0.0).unwrap().manipulator(2).unwrap();
        let mut branch = Branch::new(manipulator, |strength| Ok(at(strength)?.inputs), 1.15, 0.0115).unwrap();
        for step in 0..=steps {
            let outputs = branch.to(1.15 * step as f64 / steps as f64).unwrap();
            assert_eq!(outputs.snaps, 0, "{steps} steps: at step {step}");
        }
        assert!(branch.folds().is_empty(), "{steps} steps: {:?}", branch.folds());
        angles.push(branch.outputs().tip_angle);
    }
    assert!(angles.iter().all(|angle| (angle - angles[0]).abs() < 1e-3), "{angles:?}");
}
