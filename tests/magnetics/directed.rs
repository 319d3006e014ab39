//! Magnets across their axis and balls as parts of a device: potential against field, and charges on all of their surfaces.

use mcm::constants::VACUUM_PERMEABILITY;
use mcm::geometry::Pose;
use mcm::magnetics::{DirectedMagnet, FaceRule, ObliqueCylinder, Source, WallRule};
use nalgebra::Vector3;
use rand::SeedableRng;
use rand::rngs::StdRng;

use crate::given::direction;
use crate::tolerance::{SLOPE_DIFFERENCE, assert_close};

const RADII: [f64; 2] = [0.3e-3, 1.2e-3];
const LENGTH: f64 = 2e-3;
const REMANENCE: [f64; 3] = [0.7, -0.4, 0.5];

/// Step of the differences, m.
const STEP: f64 = 1e-8;

#[test]
fn the_field_is_minus_the_slope_of_the_potential() {
    let remanence = Vector3::from(REMANENCE);
    let cylinder = DirectedMagnet::cylinder(RADII, LENGTH, remanence).expect("allowed");
    let ball = DirectedMagnet::ball(1e-3, remanence).expect("allowed");
    let mut random = StdRng::seed_from_u64(5);
    for magnet in [cylinder, ball] {
        for distance in [1.7e-3, 3e-3, 8e-3, 40e-3] {
            let point = direction(&mut random) * distance;
            let (field, _) = magnet.field_gradient(&point).expect("outside");
            let at = |step: Vector3<f64>| magnet.potential(&(point + step)).expect("outside");
            let slope = Vector3::from_fn(|axis, _| {
                let step = Vector3::ith(axis, STEP);
                (at(-step) - at(step)) / (2.0 * STEP)
            });
            assert_close((&magnet, point), slope.as_slice(), field.as_slice(), SLOPE_DIFFERENCE);
        }
    }
}

/// Charges on faces and walls, far enough for the rules, against the wrench by the charges of the other module.
#[test]
fn charges_on_all_surfaces_feel_the_wrench() {
    let mut random = StdRng::seed_from_u64(6);
    let other =
        Source::from(ObliqueCylinder::new(RADII, LENGTH, Vector3::new(0.2, 0.9, -0.3)).expect("allowed"));
    let remanence = Vector3::from(REMANENCE);
    let body = Source::from(ObliqueCylinder::new(RADII, LENGTH, remanence).expect("allowed"));
    for distance in [3.2e-3, 5e-3] {
        let place = direction(&mut random) * distance;
        let [x, y, z] = direction(&mut random).into();
        let pose = Pose::new(place.into(), [0.0, x, y, z]).expect("a unit quaternion");
        let expected = other.wrench_on_source(&body, &pose, 1e-9).expect("apart");

        let (faces, walls) = (
            FaceRule::new(RADII[0], RADII[1], 0.5e-3, 1e-8),
            WallRule::new(RADII[0], RADII[1], LENGTH, 0.5e-3, 1e-8),
        );
        let magnetisation = remanence / VACUUM_PERMEABILITY;
        let (mut force, mut torque) = (Vector3::zeros(), Vector3::zeros());
        let mut add = |local: Vector3<f64>, charge: f64| {
            let arm = pose.rotation * local;
            let own = other.field(&(pose.position + arm)).expect("outside") * charge;
            force += own;
            torque += arm.cross(&own);
        };
        for side in [-1.0, 1.0] {
            for (at, area) in faces.points() {
                add(Vector3::new(at.x, at.y, 0.5 * side * LENGTH), side * magnetisation.z * area);
            }
        }
        for (at, area) in walls.points() {
            add(*at, magnetisation.xy().dot(area));
        }
        assert_close(("force", distance), force.as_slice(), expected.force.as_slice(), 1e-6);
        assert_close(("torque", distance), torque.as_slice(), expected.torque.as_slice(), 1e-6);
    }
}
