//! Close to a fold the estimated error still covers the error.

use mcm::equilibrium::{Equilibrium, Settings, Solution};
use mcm::manipulator::{Scene, SceneFile};

/// Angles of the second turn, deg: the branch ends at some 104.4 deg.
const ANGLES: [f64; 8] = [0.0, 28.8, 57.6, 79.2, 90.0, 93.6, 97.2, 100.8];

/// Largest ratio of an estimated error above this size (m) to the error, at these shapes. Below it the reference errs as much.
const PESSIMISM: f64 = 5.0;
const COUNTS: f64 = 2e-6;

const SCENE: &str = "
[design]
segments = 3
[design.helix]
shore_a = 33.2
[load]
tip_force_n = [-0.0010729939364102447, -0.0017965898201906343, -0.0003477914987641382]
tip_moment_nm = [4.537643675442486e-07, 8.718063069524335e-07, -1.8453092398058306e-07]
[[magnet]]
position_mm = [57.09078564398162, -58.28287190681111, 4.782307534189848]
orientation_wxyz = [-0.5510453036486681, 0.08754861148642781, -0.8249716225132815, -0.09003408244298061]
strength = 0.8693147661504801
[[magnet]]
position_mm = [6.1430467430128095, 92.20355523715656, 8.091698388624536]
orientation_wxyz = [-0.6212798118928535, 0.38204377282849816, 0.34770944810559623, -0.5891961393928589]
strength = 0.5432054800109491
[model]
interaction = \"full\"
time_budget_s = 600
";

#[test]
fn the_estimated_error_covers_the_error_up_to_the_fold() {
    let file = SceneFile::parse(SCENE, "a fold beside two magnets").unwrap();
    let at = |angle: f64| -> Scene { file.with("magnet.turn_deg", angle).unwrap().scene().unwrap() };
    let start = at(0.0);
    let judge = Settings { degree: 5, pair_accuracy: 1e-9, fine_stations: true, ..start.settings };
    let design = start.design().unwrap();
    let mut converged = Equilibrium::new(&design, &start.sources, judge, 2).unwrap();
    let mut manipulator = start.manipulator(2).unwrap();

    for angle in ANGLES {
        let inputs = at(angle).inputs;
        let found = manipulator.solve(&inputs).unwrap().clone();
        assert!(converged.solve(&inputs).unwrap().solved(), "{angle} deg");
        let error = (found.tip.position - converged.tip().position).norm();
        let ratio = found.error_estimate / error;
        println!(
            "{angle} deg: margin {:.3}, off {error:.2e} m, estimated {:.2e} m",
            found.stability_margin, found.error_estimate
        );
        assert!(ratio >= 1.0, "{angle} deg: off {error:e} m, estimated {:e} m", found.error_estimate);
        assert!(ratio <= PESSIMISM || found.error_estimate < COUNTS, "{angle} deg: {ratio} times too large");
    }
}
