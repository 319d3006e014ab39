//! A plain tube is the same tube however long the discs are that its magnets are bonded to.

use mcm::manipulator::Scene;
use nalgebra::Vector3;

use crate::tolerance::LONG_DISCS;

/// Tip (m) by an independent rod, to 0.01 um.
const TIP: [f64; 2] = [31.900_05e-3, -33.847_50e-3];

fn tube(windings: u32) -> Scene {
    let text = format!(
        "[design]
segments = 1
base_magnet = false
spiral = \"axisymmetric\"
[design.helix]
length_mm = 30.0
radius_mm = 0.75
core_outer_radius_mm = 0.7499999
core_inner_radius_mm = 0.0
windings = {windings}
boundary_angle_deg = 180.0
shore_a = 40.0
poisson = 0.45
volume_fraction = 0.0
[design.ring]
length_mm = 30.0
remanence_t = 0.13
[load]
tip_force_n = [0.0, 0.0, -0.003]
[field]
uniform_mt = [0.0, 5.0, 0.0]
[model]
bending_stop = false
time_budget_s = 60
"
    );
    Scene::parse(&text, "tube").unwrap()
}

#[test]
fn a_tube_does_not_depend_on_its_windings() {
    for windings in [1, 3, 10, 100] {
        let scene = tube(windings);
        let mut manipulator = scene.manipulator(2).unwrap();
        let found = manipulator.solve(&scene.inputs).unwrap();
        let error = (found.tip.position - Vector3::new(0.0, TIP[0], TIP[1])).norm();
        println!("{windings} windings: off {error:.1e} m, estimated {:.1e} m", found.error_estimate);
        assert!(error <= LONG_DISCS && error <= found.error_estimate, "{windings} windings: {found:?}");
    }
}
