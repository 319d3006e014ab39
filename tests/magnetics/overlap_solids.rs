//! How deep cuboids and spheres are inside other bodies: closed forms, and points all through the bodies.

use core::f64::consts::{FRAC_PI_2, FRAC_PI_4, TAU};

use mcm::geometry::Pose;
use mcm::magnetics::{Outline, depth};
use nalgebra::{Rotation3, Vector3};
use proptest::prelude::*;

use crate::tolerance::{DEPTH, DEPTH_SAMPLED};

const MM: f64 = 1e-3;

fn pose(position: [f64; 3], turn: [f64; 3]) -> Pose {
    let rotation = Rotation3::new(Vector3::from(turn)).into_inner();
    Pose { position: Vector3::from(position) * MM, rotation }
}

fn cuboid(size: [f64; 3]) -> Outline {
    Outline::Cuboid(Vector3::from(size) * (0.5 * MM))
}

#[test]
fn closed_forms_are_met() {
    let ring = Outline::cylinder(0.0, 2.0 * MM, MM);
    let disc = Outline::cylinder(0.0, 2.0 * MM, 0.0);
    let bored = Outline::cylinder(8.0 * MM, 20.0 * MM, 30.0 * MM);
    let (block, ball) = (cuboid([10.0, 12.0, 20.0]), Outline::Sphere(5.0 * MM));
    let half = 0.5_f64.sqrt();
    // Body, other, place of the body, turn, and how deep its deepest point lies below the other's surface, mm.
    let cases = [
        ("face through face", ring, block, [0.0, 0.0, 10.3], [0.0; 3], 0.2),
        ("apart", ring, block, [0.0, 0.0, 10.6], [0.0; 3], 0.0),
        ("faces touch", ring, block, [0.0, 0.0, 10.5], [0.0; 3], 0.0),
        ("side into face", ring, block, [6.9, 0.0, 0.0], [0.0; 3], 0.1),
        ("beyond the edge, though within its box", ring, block, [6.5, 7.5, 0.0], [0.0; 3], 0.0),
        // The rim comes nearest to the edge at 45 degrees.
        ("into the edge", ring, block, [5.0 + 2.0 * half - 0.1, 6.0 + 2.0 * half - 0.1, 0.0], [0.0; 3], 0.1),
        ("disc, edge into face", disc, block, [0.0, 0.0, 11.0], [FRAC_PI_4, 0.0, 0.0], 2.0 * half - 1.0),
        ("disc, upright", disc, block, [0.0, 0.0, 11.5], [FRAC_PI_2, 0.0, 0.0], 0.5),
        ("all inside", ring, block, [0.0; 3], [0.0; 3], 5.0),
        ("a block in a block", cuboid([2.0; 3]), block, [5.5, 0.0, 0.0], [0.0; 3], 0.5),
        (
            "a turned block, edge into face",
            cuboid([2.0; 3]),
            block,
            [6.2, 0.0, 0.0],
            [0.0, 0.0, FRAC_PI_4],
            2.0 * half - 1.2,
        ),
        ("a block in the bore", cuboid([11.0, 11.0, 20.0]), bored, [0.0; 3], [0.0; 3], 0.0),
        ("a ring around a block", bored, cuboid([11.0, 11.0, 20.0]), [0.0; 3], [0.0; 3], 0.0),
        (
            "a block too wide for the bore",
            bored,
            cuboid([11.4, 11.4, 20.0]),
            [0.0; 3],
            [0.0; 3],
            5.7 - 8.0 * half,
        ),
        ("a ball on a face", ball, block, [0.0, 0.0, 14.9], [0.0; 3], 0.1),
        (
            "a ball at a corner",
            ball,
            block,
            [5.0 + 2.8, 6.0 + 2.8, 10.0 + 2.8],
            [0.0; 3],
            5.0 - 2.8 * 3.0_f64.sqrt(),
        ),
        ("a ball beyond a corner", ball, block, [5.0 + 2.9, 6.0 + 2.9, 10.0 + 2.9], [0.0; 3], 0.0),
        ("a ball in the middle", ball, block, [0.0; 3], [0.0; 3], 10.0),
        ("a ball in a bore", ball, bored, [2.9, 0.0, 0.0], [0.0; 3], 0.0),
        ("a ball in a wall", ball, bored, [3.1, 0.0, 0.0], [0.0; 3], 0.1),
        ("a ring on a ball", ring, ball, [0.0, 0.0, 5.4], [0.0; 3], 0.1),
        ("a disc on a ball", disc, ball, [3.0, 0.0, 4.5], [0.0; 3], 5.0 - 1.0_f64.hypot(4.5)),
        ("two balls", ball, ball, [6.0, 0.0, 8.0 - 0.1], [0.0; 3], 10.0 - 6.0_f64.hypot(7.9)),
    ];
    for (name, body, other, at, turn, expected) in cases {
        let found = body.depth_in(&other, &pose(at, turn)) / MM;
        assert!((found - expected).abs() < 1e-8, "{name}: {found}, expected {expected}");
    }
}

/// Deepest of many points of a cylinder (inner and outer radius and length, m) in a cuboid.
fn sampled(body: [f64; 3], half: &Vector3<f64>, place: &Pose) -> f64 {
    let mut deepest = f64::NEG_INFINITY;
    for i in 0..=40 {
        for j in 0..=30 {
            let radius = body[0] + (body[1] - body[0]) * f64::from(j) / 30.0;
            for k in 0..120 {
                let (sine, cosine) = (TAU * f64::from(k) / 120.0).sin_cos();
                let height = body[2] * (f64::from(i) / 40.0 - 0.5);
                let at = place.transform(&Vector3::new(radius * cosine, radius * sine, height));
                deepest = deepest.max((half - at.abs()).min());
            }
        }
    }
    deepest.max(0.0)
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 64, failure_persistence: None, ..ProptestConfig::default() })]

    #[test]
    fn no_point_lies_deeper_and_one_nearly_as_deep(
        outer in 0.5..4.0_f64, length in 0.0..5.0_f64, bore in prop_oneof![Just(0.0), 0.1..0.8],
        half in [0.5..4.0, 0.5..4.0, 0.5..4.0], at in [-5.0..5.0, -5.0..5.0, -5.0..5.0],
        turned in [-3.0..3.0, -3.0..3.0, -3.0..3.0],
    ) {
        let (body, half) = ([bore * outer * MM, outer * MM, length * MM], Vector3::from(half) * MM);
        let (outline, block) = (Outline::cylinder(body[0], body[1], body[2]), Outline::Cuboid(half));
        let place = pose(at, turned);
        let found = outline.depth_in(&block, &place);
        let points = sampled(body, &half, &place);
        prop_assert!(points <= found + DEPTH * MM, "{found} where a point lies {points} deep");
        prop_assert!(found <= points + 3.0 * DEPTH_SAMPLED * MM, "{found} where points lie {points} deep at the most");
        let inverse = Pose::identity().seen_from(&place);
        prop_assert!((depth(&block, &outline, &place) - depth(&outline, &block, &inverse)).abs() <= DEPTH * MM);
    }
}
