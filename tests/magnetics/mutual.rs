//! The wrench of magnets and coils on one another.

use core::f64::consts::PI;

use mcm::geometry::Pose;
use mcm::magnetics::{
    AxialMagnet, Coil, Cylinders, MultipoleCoil, MultipoleTable, Solenoid, Source, Sources, Wrench,
};
use nalgebra::Vector3;

use crate::given::pair;

const ACCURACY: f64 = 1e-7;

const COIL: Coil = Coil { inner_radius: 20e-3, outer_radius: 40e-3, length: 60e-3, turns: 600.0 };

fn coil() -> Source {
    Solenoid::new(COIL).unwrap().into()
}

/// A ring, with its centre at `offset` (m) on the axis.
fn ring(offset: f64) -> Source {
    let cylinder = AxialMagnet { radius: 8e-3, inner_radius: 2e-3, length: 12e-3, offset, remanence: 1.3 };
    Cylinders::new(vec![cylinder]).unwrap().into()
}

fn magnet() -> Source {
    ring(3e-3)
}

/// A coil with a core that makes the field of a dipole of `moment` (A m2) for each ampere.
fn iron(moment: f64) -> Source {
    let table = MultipoleTable::new(60e-3, &[2e-7 * moment]).unwrap();
    MultipoleCoil::new(COIL, table).unwrap().into()
}

fn pose(position: [f64; 3]) -> Pose {
    Pose::new(position, [0.36, 0.48, 0.0, 0.8]).unwrap()
}

/// The wrench on `second`, and that on `first` with the places exchanged, in the frame of `first`.
fn both(first: &Source, second: &Source, at: &Pose) -> [Wrench; 2] {
    let back = Pose::identity().seen_from(at);
    let there = second.wrench_on_source(first, &back, ACCURACY).unwrap();
    let turned = Wrench { force: at.rotation * there.force, torque: at.rotation * there.torque };
    [first.wrench_on_source(second, at, ACCURACY).unwrap(), turned]
}

/// Asserts that action is reaction: each wrench is about the own centre of its source.
fn assert_balanced([second, first]: [Wrench; 2], at: &Pose, allowed: f64) {
    let size = second.force.norm();
    let torque = second.torque + first.torque + at.position.cross(&second.force);
    assert!(size > 0.0);
    assert!((second.force + first.force).norm() < allowed * size, "{second:?} {first:?}");
    assert!(torque.norm() < allowed * (size * at.position.norm() + second.torque.norm()), "{torque}");
}

/// A magnet feels a coil by the charges on its faces, and the coil feels the magnet by its current.
#[test]
fn action_is_reaction_by_two_formulas() {
    for at in [[0.07, 0.02, 0.03], [0.0, 0.01, 0.09], [0.002, -0.001, 0.004], [0.2, 0.1, -0.3]] {
        let at = pose(at);
        assert_balanced(both(&coil(), &magnet(), &at), &at, 1e-6);
    }
    // A magnet in the bore, askew: its torque would be wrong by charges on solenoids.
    let at = Pose::new([3e-3, 0.0, -5e-3], [0.8, 0.6, 0.0, 0.0]).unwrap();
    assert_balanced(both(&coil(), &magnet(), &at), &at, 1e-6);
}

#[test]
fn two_of_a_kind_balance_too() {
    let at = pose([0.09, 0.03, 0.05]);
    assert_balanced(both(&coil(), &coil(), &at), &at, 1e-6);
    assert_balanced(both(&magnet(), &pair(), &at), &at, 1e-6);
    let at = pose([0.11, 0.05, 0.06]);
    assert_balanced(both(&iron(3.0), &iron(-2.0), &at), &at, 1e-6);
}

/// Force and torque of one dipole on another at `r`, of the moments `a` and `b`.
fn dipoles(a: &Vector3<f64>, b: &Vector3<f64>, r: &Vector3<f64>) -> Wrench {
    let (distance, n) = (r.norm(), r.normalize());
    let field = (3.0 * n * n.dot(a) - a) * 1e-7 / distance.powi(3);
    let force = (a * n.dot(b) + b * n.dot(a) + n * a.dot(b) - 5.0 * n * n.dot(a) * n.dot(b)) * 3e-7;
    Wrench { force: force / distance.powi(4), torque: b.cross(&field) }
}

#[test]
fn far_away_all_are_dipoles() {
    let at = pose([1.4, -0.8, 1.9]);
    let magnet = || ring(0.0);
    for (first, second) in [(coil(), magnet()), (magnet(), coil()), (coil(), coil()), (magnet(), magnet())] {
        let (a, b) = (first.moment(), at.rotation * second.moment());
        let expected = dipoles(&a, &b, &at.position);
        let found = first.wrench_on_source(&second, &at, ACCURACY).unwrap();
        assert!((found.force - expected.force).norm() < 1e-2 * expected.force.norm(), "{found:?}");
        assert!((found.torque - expected.torque).norm() < 1e-2 * expected.torque.norm(), "{found:?}");
    }
}

#[test]
fn cores_of_dipoles_are_dipoles_at_any_distance() {
    let at = pose([0.11, 0.05, 0.06]);
    let expected = dipoles(&(Vector3::z() * 3.0), &(at.axis() * -2.0), &at.position);
    let found = iron(3.0).wrench_on_source(&iron(-2.0), &at, ACCURACY).unwrap();
    assert!((found.force - expected.force).norm() < 1e-6 * expected.force.norm(), "{found:?} {expected:?}");
    assert!((found.torque - expected.torque).norm() < 1e-6 * expected.torque.norm(), "{found:?}");
    // With a magnet and with a winding, in either order.
    for other in [magnet(), coil()] {
        assert_balanced(both(&iron(3.0), &other, &at), &at, 1e-6);
        assert_balanced(both(&other, &iron(3.0), &at), &at, 1e-6);
    }
}

/// The pull of two coaxial coils is the derivative of their mutual inductance, here by thin windings: Maxwell's coils of one turn.
#[test]
fn coaxial_loops_attract_as_maxwell_has_it() {
    let (radius, thin) = (30e-3, 1e-4);
    let ring =
        Coil { inner_radius: radius - thin, outer_radius: radius + thin, length: 2.0 * thin, turns: 1.0 };
    let ring = Source::from(Solenoid::new(ring).unwrap());
    // Of two equal loops at the distance z: mu_0 z k / (2 r sqrt(1 - ...)) by elliptic integrals, here by the sum over angles.
    let height = 20e-3;
    let count = 4000;
    let along: f64 = (0..count)
        .map(|step| {
            let cosine = (2.0 * PI * (f64::from(step) + 0.5) / f64::from(count)).cos();
            let r2 = 2.0 * radius * radius * (1.0 - cosine) + height * height;
            cosine * height / r2.powf(1.5)
        })
        .sum();
    let expected = -1e-7 * 2.0 * PI * radius * radius * (2.0 * PI / f64::from(count)) * along;
    let found = ring.wrench_on_source(&ring, &Pose::identity().advanced(height), 1e-6).unwrap();
    assert!((found.force.z / expected - 1.0).abs() < 1e-4, "{} {expected}", found.force.z);
}

#[test]
fn all_sources_together_feel_nothing() {
    let sources = Sources::new(vec![pair(), magnet(), coil(), iron(2.0)]).unwrap();
    let placed = [
        (pose([0.0, -0.12, 0.0]), 1.0),
        (pose([0.1, 0.0, 0.02]), -0.5),
        (pose([-0.02, 0.1, 0.04]), 8.0),
        (pose([-0.2, -0.03, 0.0]), 3.0),
    ];
    let found = sources.mutual_wrenches(|number| placed.get(number).copied()).unwrap();
    assert_eq!(found.len(), 4);
    let (mut force, mut torque) = (Vector3::zeros(), Vector3::zeros());
    for (wrench, (pose, _)) in found.iter().zip(&placed) {
        assert!(wrench.force.norm() > 1e-4, "{wrench:?}");
        force += wrench.force;
        torque += wrench.torque + pose.position.cross(&wrench.force);
    }
    assert!(force.norm() < 1e-12 && torque.norm() < 1e-12, "{force} {torque}");
    // What is switched off, or not there, neither acts nor feels.
    let off = |number: usize| (number != 3).then(|| (placed[number].0, f64::from(u8::from(number != 1))));
    let found = sources.mutual_wrenches(off).unwrap();
    assert_eq!([found[1], found[3]], [Wrench::NONE; 2]);
    let alone = pair().wrench_on_source(&coil(), &placed[2].0.seen_from(&placed[0].0), 1e-6).unwrap();
    let turned = placed[0].0.rotation * alone.force;
    assert!((found[2].force - turned).norm() < 1e-12 * turned.norm());
}

#[test]
fn what_has_no_answer_is_named() {
    let sources = Sources::new(vec![magnet(), coil(), iron(1.0)]).unwrap();
    let at = |places: [[f64; 3]; 3]| {
        let placed = places.map(|place| (pose(place), 1.0));
        sources.mutual_wrenches(|number| placed.get(number).copied()).unwrap_err().to_string()
    };
    let message = at([[0.03, 0.0, 0.0], [0.0, 0.0, 0.0], [0.0, 0.0, 0.4]]);
    assert!(message.contains("the external magnet and coil 1: the bodies overlap by"), "{message}");
    // Beside the core, between its winding and its sphere.
    let beside = pose([0.0; 3]).rotation.column(0) * 0.052;
    let message = at([beside.into(), [0.4, 0.0, 0.0], [0.0; 3]]);
    assert!(
        message.contains("the external magnet and coil 2") && message.contains("coil with iron"),
        "{message}"
    );
}
