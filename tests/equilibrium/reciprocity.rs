//! Rings in each other's and the magnet's field, against the wrench on charged faces, an independent formula.

use mcm::design::{Design, Specification};
use mcm::equilibrium::{Equilibrium, Inputs, Interaction, PlacedSource, Settings, Solution};
use mcm::geometry::Pose;
use mcm::magnetics::{AxialSource, Wrench};
use nalgebra::Vector3;

use crate::given::pair;
use crate::tolerance::{PAIRS, RECIPROCITY, WRENCH_ACCURACY, assert_close};

/// Chains in which only the rings are magnetised.
fn rings_alone(segments: usize) -> Design {
    let Specification::Segmented(mut chain) = Specification::paper(segments) else { unreachable!() };
    chain.helix.particle_remanence = 0.0;
    Design::new(Specification::Segmented(chain)).expect("allowed")
}

fn source(design: &Design) -> AxialSource {
    let ring = design.rings().next().expect("the design has rings");
    AxialSource::new(ring.inner_radius, ring.outer_radius, ring.length, ring.remanence).expect("allowed")
}

/// `pose` as seen from `frame`.
fn seen_from(frame: &Pose, pose: &Pose) -> Pose {
    Pose {
        position: frame.rotation.tr_mul(&(pose.position - frame.position)),
        rotation: frame.rotation.tr_mul(&pose.rotation),
    }
}

fn solved(equilibrium: &mut Equilibrium, inputs: &Inputs) {
    let report = equilibrium.solve(inputs).expect("finite inputs");
    assert!(report.solved() && report.snaps == 0, "{report:?}");
}

#[test]
fn the_magnet_feels_minus_what_the_rings_feel() {
    let (design, magnet) = (rings_alone(3), pair());
    let mut inputs = Inputs::unloaded(4);
    let pose = Pose::new([0.01, -0.06, 0.01], [0.6, 0.8, 0.0, 0.0]).expect("a pose");
    inputs.sources = vec![PlacedSource { pose, strength: 1.0 }];
    inputs.uniform_field = Vector3::new(0.0, 0.003, 0.001); // must not enter the magnet's reaction
    inputs.base = Pose::new([0.001, 0.002, -0.003], [0.8, 0.36, -0.48, 0.0]).expect("a pose");
    let settings = Settings { interaction: Interaction::Rings, pair_accuracy: PAIRS, ..Settings::default() };
    let mut equilibrium = Equilibrium::new(&design, Some(&magnet), settings, 2).expect("allowed");
    solved(&mut equilibrium, &inputs);
    let body = source(&design);
    let (mut on_magnet, mut on_rings) = (zero(), zero());
    for ring in equilibrium.rings() {
        let seen = seen_from(&inputs.sources[0].pose, &ring);
        let wrench = magnet.wrench_on(&body, &seen, WRENCH_ACCURACY).expect("apart");
        let turn = inputs.sources[0].pose.rotation;
        let back = wrench.reaction(&seen.position);
        on_magnet.force += turn * back.force;
        on_magnet.torque += turn * back.torque;
        let force = turn * wrench.force;
        on_rings.force += force;
        on_rings.torque += turn * wrench.torque + (ring.position - inputs.base.position).cross(&force);
        // The background pulls at no ring, but turns it.
        on_rings.torque += (ring.axis() * body.moment()).cross(&inputs.uniform_field);
    }
    let got = equilibrium.source_reaction(0, &inputs);
    assert_close("force on the magnet", got.force.as_slice(), on_magnet.force.as_slice(), RECIPROCITY);
    assert_close("torque on the magnet", got.torque.as_slice(), on_magnet.torque.as_slice(), RECIPROCITY);
    let got = equilibrium.magnetic_wrench();
    assert_close("force on the rings", got.force.as_slice(), on_rings.force.as_slice(), RECIPROCITY);
    assert_close("torque on the rings", got.torque.as_slice(), on_rings.torque.as_slice(), RECIPROCITY);
}

fn zero() -> Wrench {
    Wrench { force: Vector3::zeros(), torque: Vector3::zeros() }
}

#[test]
fn the_rings_attraction_is_a_load_like_any_other() {
    // What the base ring does to the tip ring, by charged faces, put on as a dead load instead: the same shape.
    let design = rings_alone(1);
    let mut inputs = Inputs::unloaded(2);
    inputs.uniform_field = Vector3::new(0.005, 0.02, -0.01);
    let settings = Settings { interaction: Interaction::Rings, pair_accuracy: PAIRS, ..Settings::default() };
    let mut with_rings = Equilibrium::new(&design, None, settings, 2).expect("allowed");
    solved(&mut with_rings, &inputs);
    let rings: Vec<Pose> = with_rings.rings().collect();
    let body = source(&design);
    let wrench = body.wrench_on(&body, &seen_from(&rings[0], &rings[1]), WRENCH_ACCURACY).expect("apart");
    inputs.ring_forces[1] = rings[0].rotation * wrench.force;
    inputs.tip_moment = rings[0].rotation * wrench.torque;
    let settings = Settings { interaction: Interaction::None, ..settings };
    let mut with_loads = Equilibrium::new(&design, None, settings, 2).expect("allowed");
    solved(&mut with_loads, &inputs);
    let (one, two) = (with_rings.tip(), with_loads.tip());
    assert_close("position", two.position.as_slice(), one.position.as_slice(), RECIPROCITY);
    assert_close("rotation", two.rotation.as_slice(), one.rotation.as_slice(), RECIPROCITY);
    assert!(wrench.force.norm() > 0.05, "{wrench:?}: no test of the attraction");
}

#[test]
fn the_attraction_shortens_the_core_by_hookes_law() {
    let design = rings_alone(1);
    let settings = Settings { interaction: Interaction::Rings, pair_accuracy: PAIRS, ..Settings::default() };
    let mut equilibrium = Equilibrium::new(&design, None, settings, 2).expect("allowed");
    solved(&mut equilibrium, &Inputs::unloaded(2));
    let rings: Vec<Pose> = equilibrium.rings().collect();
    let body = source(&design);
    let force =
        body.wrench_on(&body, &seen_from(&rings[0], &rings[1]), WRENCH_ACCURACY).expect("apart").force;
    let compliance: f64 =
        design.segments()[0].spans.iter().map(|span| span.length / span.stiffness.axial).sum();
    let shortening = design.length() - equilibrium.tip().position.z;
    assert_close("shortening", &[shortening], &[-force.z * compliance], RECIPROCITY);
}
