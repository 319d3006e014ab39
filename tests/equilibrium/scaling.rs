//! Scaling laws: magnetostatics and linear elasticity have no length of their own.

use mcm::design::{Backbone, Design, Modulus, Segmented, Specification, gent_modulus};
use mcm::equilibrium::{Equilibrium, Inputs, Interaction, PlacedSource, Report, Settings, Solution};
use mcm::geometry::Pose;
use mcm::magnetics::{AxialMagnet, Cylinders, Outline, Source};
use nalgebra::Vector3;

use crate::given::pair;
use crate::tolerance::{LAW, assert_close};

/// A scene with everything in it.
struct Scene {
    segmented: Segmented,
    magnet: Source,
    inputs: Inputs,
}

fn scene() -> Scene {
    let Specification::Segmented(segmented) = Specification::paper(2) else { unreachable!() };
    let mut inputs = Inputs::unloaded(3);
    inputs.uniform_field = Vector3::new(0.004, 0.012, -0.003);
    inputs.field_gradient = [0.1, 0.05, -0.2, 0.3, 0.15];
    inputs.gravity = Vector3::new(1.0, -9.0, 2.0);
    inputs.tip_force = Vector3::new(0.003, 0.001, -0.002);
    inputs.tip_moment = Vector3::new(1e-5, -2e-5, 3e-5);
    inputs.ring_forces[1] = Vector3::new(0.002, -0.001, 0.004);
    inputs.base = Pose::new([0.001, 0.002, -0.003], [0.8, 0.36, -0.48, 0.0]).expect("a pose");
    let pose = Pose::new([0.01, -0.09, 0.01], [0.6, 0.8, 0.0, 0.0]).expect("a pose");
    inputs.sources = vec![PlacedSource { pose, strength: 0.7 }];
    let backbone = Some(Backbone { modulus: Modulus::Elastic(2e6), ..Backbone::silicone() });
    Scene { segmented: Segmented { backbone, ..segmented }, magnet: pair(), inputs }
}

impl Scene {
    fn solve(&self) -> (Equilibrium, Report) {
        let design = Design::new(Specification::Segmented(self.segmented.clone())).expect("allowed");
        let settings = Settings { interaction: Interaction::Rings, ..Settings::default() };
        let mut equilibrium = Equilibrium::new(&design, Some(&self.magnet), settings, 2).expect("allowed");
        let report = equilibrium.solve(&self.inputs).expect("finite inputs");
        assert!(report.solved() && report.snaps == 0, "{report:?}");
        (equilibrium, report)
    }
}

/// The magnet with its cylinders changed.
fn changed(magnet: &Source, change: impl Fn(AxialMagnet) -> AxialMagnet) -> Source {
    let cylinders = magnet.parts().iter().map(|part| {
        let Outline::Cylinder(outline) = &part.outline else { panic!("a cylinder") };
        change(AxialMagnet {
            radius: outline.outer_radius(),
            inner_radius: outline.inner_radius(),
            length: outline.length(),
            offset: part.centre.z,
            remanence: part.remanence.z,
        })
    });
    Cylinders::new(cylinders.collect()).expect("allowed").into()
}

/// Compares two solves whose lengths, forces and torques are expected in these ratios.
fn compare(case: &str, first: &Scene, second: &Scene, length: f64, force: f64) {
    let ((one, report), (two, scaled)) = (first.solve(), second.solve());
    let torque = force * length;
    for (a, b) in one.rings().chain([one.tip()]).zip(two.rings().chain([two.tip()])) {
        assert_close(case, b.position.as_slice(), (a.position * length).as_slice(), LAW);
        assert_close(case, b.rotation.as_slice(), a.rotation.as_slice(), LAW);
    }
    let wrenches = |equilibrium: &Equilibrium, inputs: &Inputs| {
        [equilibrium.magnetic_wrench(), equilibrium.base_reaction(), equilibrium.source_reaction(0, inputs)]
    };
    for (a, b) in wrenches(&one, &first.inputs).iter().zip(&wrenches(&two, &second.inputs)) {
        assert_close(case, b.force.as_slice(), (a.force * force).as_slice(), LAW);
        assert_close(case, b.torque.as_slice(), (a.torque * torque).as_slice(), LAW);
    }
    assert_close(case, &[scaled.energy], &[report.energy * torque], LAW);
    // The margin is an eigenvalue found by iteration, to the accuracy that a verdict needs.
    assert_close(case, &[scaled.margin], &[report.margin], 1e-3);
}

#[test]
fn a_larger_device_of_the_same_materials_in_the_same_field_bends_alike() {
    // Energies of elasticity and of magnetisation both go with the volume: forces with c^2, torques with c^3.
    let factor = 2.5;
    let first = scene();
    let mut second = scene();
    let helix = &mut second.segmented.helix;
    for length in
        [&mut helix.length, &mut helix.radius, &mut helix.core_inner_radius, &mut helix.core_outer_radius]
    {
        *length *= factor;
    }
    second.segmented.ring.length *= factor;
    let tube = second.segmented.backbone.as_mut().expect("the scene has one");
    tube.outer_radius *= factor;
    tube.inner_radius *= factor;
    let larger = |m: AxialMagnet| AxialMagnet {
        radius: m.radius * factor,
        length: m.length * factor,
        offset: m.offset * factor,
        ..m
    };
    second.magnet = changed(&first.magnet, larger);
    let inputs = &mut second.inputs;
    inputs.base.position *= factor;
    inputs.sources[0].pose.position *= factor;
    inputs.field_gradient.iter_mut().for_each(|gradient| *gradient /= factor);
    inputs.gravity /= factor;
    inputs.tip_force *= factor.powi(2);
    inputs.tip_moment *= factor.powi(3);
    inputs.ring_forces.iter_mut().for_each(|force| *force *= factor.powi(2));
    compare("larger", &first, &second, factor, factor.powi(2));
}

#[test]
fn moduli_go_with_the_square_of_all_fields() {
    let factor = 0.9_f64;
    let square = factor * factor;
    let first = scene();
    let mut second = scene();
    let helix = &mut second.segmented.helix;
    helix.shore_a = hardness(gent_modulus(helix.shore_a) * square);
    helix.particle_remanence *= factor;
    second.segmented.ring.remanence *= factor;
    second.segmented.backbone.as_mut().expect("the scene has one").modulus = Modulus::Elastic(2e6 * square);
    let weaker = |m: AxialMagnet| AxialMagnet { remanence: m.remanence * factor, ..m };
    second.magnet = changed(&first.magnet, weaker);
    let inputs = &mut second.inputs;
    inputs.uniform_field *= factor;
    inputs.field_gradient.iter_mut().for_each(|gradient| *gradient *= factor);
    inputs.gravity *= square;
    inputs.tip_force *= square;
    inputs.tip_moment *= square;
    inputs.ring_forces.iter_mut().for_each(|force| *force *= square);
    compare("softer and weaker", &first, &second, 1.0, square);
}

/// The Shore A hardness of a modulus: Gent's relation solved for it.
fn hardness(modulus: f64) -> f64 {
    let k = modulus * 0.137_505 / 0.0981e6;
    (254.0 * k - 56.0) / (7.66 + 2.54 * k)
}
