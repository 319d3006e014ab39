//! Every input of a device with its usual size, and inputs changed by one number.

use mcm::geometry::RotationVector;
use mcm::manipulator::{Input, Inputs};
use nalgebra::Vector3;

/// Every input with its usual size in its unit.
pub(super) fn inputs_and_sizes(rings: usize, sources: usize) -> Vec<(Input, f64)> {
    let mut all = vec![
        (Input::UniformField, 0.01),
        (Input::FieldGradient, 0.3),
        (Input::TipForce, 0.005),
        (Input::TipMoment, 1e-5),
        (Input::Gravity, 10.0),
        (Input::BasePosition, 0.05),
        (Input::BaseRotation, 1.0),
        (Input::Roll, 1.0),
    ];
    all.extend((0..rings).map(|ring| (Input::RingForce(ring), 0.005)));
    for source in 0..sources {
        all.extend([
            (Input::SourcePosition(source), 0.05),
            (Input::SourceRotation(source), 1.0),
            (Input::SourceStrength(source), 1.0),
        ]);
    }
    all
}

/// The inputs with one number changed; rotations turn about axes of the world.
pub(super) fn changed(inputs: &Inputs, input: Input, axis: usize, by: f64) -> Inputs {
    let mut out = inputs.clone();
    let turn = || RotationVector::new(Vector3::ith(axis, by)).matrix();
    match input {
        Input::SourcePosition(source) => out.sources[source].pose.position[axis] += by,
        Input::SourceRotation(source) => {
            let pose = &mut out.sources[source].pose;
            pose.rotation = turn() * pose.rotation;
        }
        Input::SourceStrength(source) => out.sources[source].strength += by,
        Input::UniformField => out.uniform_field[axis] += by,
        Input::FieldGradient => out.field_gradient[axis] += by,
        Input::TipForce => out.tip_force[axis] += by,
        Input::TipMoment => out.tip_moment[axis] += by,
        Input::Gravity => out.gravity[axis] += by,
        Input::BasePosition => out.base.position[axis] += by,
        Input::BaseRotation => out.base.rotation = turn() * out.base.rotation,
        Input::Roll => out.roll += by,
        Input::Insertion => out.insertion += by,
        Input::GuidewireInsertion => out.guidewire_insertion += by,
        Input::FeedForce => out.feed_force = out.feed_force.map(|force| force + by),
        Input::VesselPosition | Input::VesselRotation => unreachable!("not among the inputs"),
        Input::RingForce(ring) => out.ring_forces[ring][axis] += by,
    }
    out
}
