//! Laws that need no reference: objectivity, balance of forces and moments, no net internal force.

use mcm::design::{Design, Specification};
use mcm::equilibrium::{Equilibrium, Inputs, Interaction, PlacedSource, Settings, Solution};
use mcm::geometry::{Pose, RotationVector, hat};
use nalgebra::{Matrix3, Vector3};

use crate::given::{pair, unloaded_beside_pair};
use crate::tolerance::{BALANCE, DIFFERENCE, LAW, assert_close};

const SEGMENTS: usize = 3;

fn design() -> Design {
    Design::new(Specification::paper(SEGMENTS)).expect("the paper's design is allowed")
}

fn manipulator(interaction: Interaction) -> Equilibrium {
    let settings = Settings { interaction, ..Settings::default() };
    Equilibrium::new(&design(), Some(&pair()), settings, 2).expect("default settings")
}

/// Everything acts: magnet, field, gradient, weight, loads, on a turned base.
fn everything() -> Inputs {
    let mut inputs = Inputs::unloaded(SEGMENTS + 1);
    inputs.uniform_field = Vector3::new(0.003, 0.008, -0.002);
    inputs.field_gradient = [0.1, 0.05, -0.2, 0.3, 0.15];
    inputs.gravity = Vector3::new(1.0, -9.0, 2.0);
    inputs.tip_force = Vector3::new(0.003, 0.001, -0.002);
    inputs.tip_moment = Vector3::new(1e-5, -2e-5, 3e-5);
    inputs.ring_forces[1] = Vector3::new(0.002, -0.001, 0.004);
    inputs.ring_forces[3] = Vector3::new(-0.001, 0.001, 0.002);
    inputs.base = Pose::new([0.001, 0.002, -0.003], [0.8, 0.36, -0.48, 0.0]).expect("a pose");
    let pose = Pose::new([0.01, -0.09, 0.01], [0.6, 0.8, 0.0, 0.0]).expect("a pose");
    inputs.sources = vec![PlacedSource { pose, strength: 0.7 }];
    inputs
}

fn solve(equilibrium: &mut Equilibrium, inputs: &Inputs) -> f64 {
    let report = equilibrium.solve(inputs).expect("finite inputs");
    assert!(report.solved() && report.snaps == 0 && report.margin > 0.0, "{report:?}");
    report.energy
}

/// The whole scene turned by `turn` about the origin, then shifted.
fn moved(inputs: &Inputs, turn: &Matrix3<f64>, shift: &Vector3<f64>) -> Inputs {
    let pose = |pose: &Pose| Pose { position: turn * pose.position + shift, rotation: turn * pose.rotation };
    let [xx, xy, xz, yy, yz] = inputs.field_gradient;
    let g = turn * Matrix3::new(xx, xy, xz, xy, yy, yz, xz, yz, -xx - yy) * turn.transpose();
    Inputs {
        sources: inputs.sources.iter().map(|own| PlacedSource { pose: pose(&own.pose), ..*own }).collect(),
        uniform_field: turn * inputs.uniform_field - g * shift,
        field_gradient: [g.m11, g.m12, g.m13, g.m22, g.m23],
        base: pose(&inputs.base),
        tip_force: turn * inputs.tip_force,
        tip_moment: turn * inputs.tip_moment,
        ring_forces: inputs.ring_forces.iter().map(|force| turn * force).collect(),
        gravity: turn * inputs.gravity,
        ..inputs.clone()
    }
}

/// All outputs as seen from the base: positions and rotations, then forces, then torques.
fn from_the_base(equilibrium: &Equilibrium, inputs: &Inputs) -> [Vec<f64>; 4] {
    let axes = inputs.base.rotation.transpose();
    let (mut positions, mut rotations) = (Vec::new(), Vec::new());
    for pose in equilibrium.rings().skip(1).chain([equilibrium.tip()]) {
        positions.extend((axes * (pose.position - inputs.base.position)).iter());
        rotations.extend((axes * pose.rotation).iter());
    }
    let (mut forces, mut torques) = (Vec::new(), Vec::new());
    for wrench in
        [equilibrium.magnetic_wrench(), equilibrium.base_reaction(), equilibrium.source_reaction(0, inputs)]
    {
        forces.extend((axes * wrench.force).iter());
        torques.extend((axes * wrench.torque).iter());
    }
    [positions, rotations, forces, torques]
}

#[test]
fn nothing_changes_when_the_whole_scene_is_moved() {
    let turn = RotationVector::new(Vector3::new(1.1, -0.7, 1.9)).matrix();
    let shift = Vector3::new(0.31, -0.17, 0.23);
    for interaction in [Interaction::None, Interaction::Rings] {
        let (mut here, mut there) = (manipulator(interaction), manipulator(interaction));
        let inputs = everything();
        let other = moved(&inputs, &turn, &shift);
        let (energy, elsewhere) = (solve(&mut here, &inputs), solve(&mut there, &other));
        let (one, two) = (from_the_base(&here, &inputs), from_the_base(&there, &other));
        for (name, (a, b)) in ["positions", "rotations", "forces", "torques"].iter().zip(one.iter().zip(&two))
        {
            assert_close((interaction, name), b, a, LAW);
        }
        // Only forces that are dead in the world have an energy that the shift changes.
        let dead = inputs.tip_force
            + inputs.ring_forces.iter().sum::<Vector3<f64>>()
            + inputs.gravity * design().mass();
        let expected = energy - (turn * dead).dot(&shift);
        assert_close((interaction, "energy"), &[elsewhere], &[expected], LAW);
    }
}

#[test]
fn all_forces_and_moments_on_the_manipulator_are_in_balance() {
    for interaction in [Interaction::None, Interaction::Rings] {
        for weight in [false, true] {
            let mut inputs = everything();
            if !weight {
                inputs.gravity = Vector3::zeros();
            }
            let mut equilibrium = manipulator(interaction);
            solve(&mut equilibrium, &inputs);
            let (base, magnetic) = (equilibrium.base_reaction(), equilibrium.magnetic_wrench());
            let mut force = base.force + magnetic.force + inputs.gravity * design().mass();
            let mut moment = base.torque + magnetic.torque + inputs.tip_moment;
            let rings: Vec<Pose> = equilibrium.rings().collect();
            let tip = equilibrium.tip();
            let loads = rings.iter().zip(&inputs.ring_forces).chain([(&tip, &inputs.tip_force)]);
            for (pose, load) in loads {
                force += load;
                moment += (pose.position - inputs.base.position).cross(load);
            }
            let case = format!("{interaction:?} weight {weight}");
            let error = force.norm() / base.force.norm();
            assert!(error <= BALANCE, "{case}: {force} N left over, {error:e} of the reaction");
            if !weight {
                // The weight's moment is checked by the energy, below.
                let error = moment.norm() / base.torque.norm();
                assert!(error <= BALANCE, "{case}: {moment} N m left over, {error:e} of the reaction");
            }
        }
    }
}

#[test]
fn the_reaction_is_the_slope_of_the_energy_by_the_base_pose() {
    for interaction in [Interaction::None, Interaction::Rings] {
        // A moment that is dead in space has no energy: it stays away.
        let inputs = Inputs { tip_moment: Vector3::zeros(), ..everything() };
        let mut equilibrium = manipulator(interaction);
        solve(&mut equilibrium, &inputs);
        let reaction = equilibrium.base_reaction();
        let shape = equilibrium.unknowns().to_vec();
        let mut energy = |base: Pose| {
            let at = Inputs { base, ..inputs.clone() };
            equilibrium.gradient(&at, &shape).expect("nothing touches").0
        };
        let (step, angle) = (1e-6, 1e-4);
        let (mut force, mut moment) = (Vector3::zeros(), Vector3::zeros());
        for axis in 0..3 {
            let direction = Vector3::ith(axis, 1.0);
            let mut shifted = |sign: f64| {
                energy(Pose { position: inputs.base.position + direction * (sign * step), ..inputs.base })
            };
            force[axis] = (shifted(1.0) - shifted(-1.0)) / (2.0 * step);
            let mut turned = |sign: f64| {
                let turn = RotationVector::new(direction * (sign * angle)).matrix();
                energy(Pose { rotation: turn * inputs.base.rotation, ..inputs.base })
            };
            moment[axis] = (turned(1.0) - turned(-1.0)) / (2.0 * angle);
        }
        assert_close((interaction, "force"), force.as_slice(), reaction.force.as_slice(), DIFFERENCE);
        assert_close((interaction, "moment"), moment.as_slice(), reaction.torque.as_slice(), DIFFERENCE);
    }
}

#[test]
fn internal_forces_cancel() {
    // In a uniform field nothing but the clamp's moment is left over, however the rings pull at each other.
    let mut inputs = unloaded_beside_pair(SEGMENTS + 1);
    inputs.uniform_field = Vector3::new(0.002, 0.009, 0.001);
    let mut equilibrium = manipulator(Interaction::Rings);
    solve(&mut equilibrium, &inputs);
    let (base, magnetic) = (equilibrium.base_reaction(), equilibrium.magnetic_wrench());
    let attraction = 0.1; // N, the least force between two neighbouring rings
    let left_over = base.force.norm() / attraction;
    assert!(left_over <= BALANCE, "the clamp holds {} N against internal forces", base.force.norm());
    assert_close("moment", (-base.torque).as_slice(), magnetic.torque.as_slice(), BALANCE);
    assert!(magnetic.torque.norm() > 1e-4, "{magnetic:?}: no test of the balance");
}

#[test]
fn the_torque_of_a_uniform_field_is_moment_cross_field() {
    // Of the straight manipulator, known without any quadrature.
    let design = design();
    let field = Vector3::new(1e-9, 2e-9, 3e-9);
    let mut inputs = Inputs { uniform_field: field, ..unloaded_beside_pair(SEGMENTS + 1) };
    inputs.base = Pose::new([0.0; 3], [0.8, 0.36, -0.48, 0.0]).expect("a pose");
    let mut equilibrium = manipulator(Interaction::None);
    solve(&mut equilibrium, &inputs);
    let expected = hat(&(inputs.base.axis() * design.moment())) * field;
    let got = equilibrium.magnetic_wrench().torque;
    assert_close("straight", got.as_slice(), expected.as_slice(), 1e-5); // it bends by 1e-6 rad
}
