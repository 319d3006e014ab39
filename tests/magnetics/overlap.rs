//! How deep bodies are inside one another: closed forms, symmetries, and points all through the bodies.

use core::f64::consts::{FRAC_PI_2, TAU};

use mcm::geometry::Pose;
use mcm::magnetics::{Outline, depth};
use nalgebra::{Rotation3, Vector3};
use proptest::prelude::*;

use crate::tolerance::{DEPTH, DEPTH_SAMPLED};

const MM: f64 = 1e-3;

fn pose(position: [f64; 3], turn: [f64; 3]) -> Pose {
    let position = Vector3::from(position) * MM;
    Pose { position, rotation: Rotation3::new(Vector3::from(turn)).into_inner() }
}

/// A ring's outline, a magnet, a flat disc, a magnet with a bore, a ring with its bore.
fn bodies() -> [Outline; 5] {
    let millimetres = |inner, outer, length| Outline::cylinder(inner * MM, outer * MM, length * MM);
    [
        millimetres(0.0, 2.0, 1.0),
        millimetres(0.0, 22.5, 30.0),
        millimetres(0.0, 2.0, 0.0),
        millimetres(3.0, 20.0, 30.0),
        millimetres(0.75, 2.0, 1.0),
    ]
}

#[test]
fn closed_forms_are_met() {
    let [ring, magnet, disc, bored, hollow] = bodies();
    let tilted = core::f64::consts::FRAC_PI_4;
    // Body, other, place of the body, turn, and how deep its deepest point lies below the other's surface, mm.
    let cases = [
        ("coaxial, face through face", ring, magnet, [0.0, 0.0, 15.4], [0.0; 3], 0.1),
        ("coaxial, apart", ring, magnet, [0.0, 0.0, 15.6], [0.0; 3], 0.0),
        ("faces touch", ring, magnet, [0.0, 0.0, 15.5], [0.0; 3], 0.0),
        ("side by side", ring, magnet, [0.0, 24.3, 0.0], [0.0; 3], 0.2),
        ("side by side, apart", ring, magnet, [17.4, 17.4, 0.0], [0.0; 3], 0.0),
        ("sides touch", ring, ring, [4.0, 0.0, 0.0], [0.0; 3], 0.0),
        ("turned by 90 deg, side on face", ring, magnet, [0.0, 0.0, 16.7], [FRAC_PI_2, 0.0, 0.0], 0.3),
        ("turned by 90 deg, face against side", ring, magnet, [22.9, 0.0, 0.0], [0.0, FRAC_PI_2, 0.0], 0.1),
        // The disc's rim comes in edge first: its lowest point is its radius times the sine below its centre.
        (
            "tilted, edge into face",
            disc,
            magnet,
            [5.0, 0.0, 16.0],
            [tilted, 0.0, 0.0],
            2.0 * tilted.sin() - 1.0,
        ),
        // A plane disc across the axis of a crossing cylinder touches it at a point.
        ("turned by 90 deg, edge into side", disc, magnet, [0.0, 24.4, 3.0], [0.0, FRAC_PI_2, 0.0], 0.1),
        ("all inside", disc, ring, [0.0; 3], [0.0; 3], 0.5),
        ("in the bore", ring, bored, [0.9, 0.0, 2.0], [0.0, 0.1, 0.0], 0.0),
        ("in the bore, touching", ring, bored, [0.0, -1.0, 2.0], [0.0; 3], 0.0),
        ("in the bore's wall", ring, bored, [0.0, 1.25, 0.0], [0.0; 3], 0.25),
        ("across the bore", ring, bored, [0.0, 0.0, 15.2], [0.0; 3], 0.0),
        ("over the mouth of the bore", magnet, bored, [0.0, 0.0, 29.8], [0.0; 3], 0.2),
        ("a rod through a ring", Outline::cylinder(0.0, 0.7 * MM, 9.0 * MM), hollow, [0.0; 3], [0.0; 3], 0.0),
        ("a ring around a rod", hollow, Outline::cylinder(0.0, 0.7 * MM, 9.0 * MM), [0.0; 3], [0.0; 3], 0.0),
        (
            "a ring on a rod too thick",
            hollow,
            Outline::cylinder(0.0, 0.8 * MM, 9.0 * MM),
            [0.0; 3],
            [0.0; 3],
            0.05,
        ),
    ];
    for (what, body, other, place, turn, expected) in cases {
        let found = body.depth_in(&other, &pose(place, turn)) / MM;
        assert!((found - expected).abs() <= DEPTH, "{what}: {found} mm, expected {expected} mm");
    }
}

#[test]
fn links_of_a_chain_share_no_volume() {
    let link = Outline::cylinder(4.0 * MM, 5.0 * MM, 1.0 * MM);
    let apart = depth(&link, &link, &pose([4.5, 0.0, 0.0], [FRAC_PI_2, 0.0, 0.0]));
    assert_eq!(apart.to_bits(), 0);
    assert!(depth(&link, &link, &pose([8.5, 0.0, 0.0], [FRAC_PI_2, 0.0, 0.0])) > 0.0);
}

/// The largest depth of points all through a body, without optimisation; always less than the depth.
fn sampled(body: [f64; 3], other: [f64; 3], pose: &Pose) -> f64 {
    let mut deepest = 0.0_f64;
    for i in 0..=40 {
        let height = body[2] * (f64::from(i) / 40.0 - 0.5);
        for j in 0..=20 {
            let radius = body[0] + (body[1] - body[0]) * f64::from(j) / 20.0;
            for k in 0..180 {
                let (sine, cosine) = (TAU * f64::from(k) / 180.0).sin_cos();
                let at = pose.transform(&Vector3::new(radius * cosine, radius * sine, height));
                let rho = at.x.hypot(at.y);
                let bore = if other[0] > 0.0 { rho - other[0] } else { f64::INFINITY };
                deepest = deepest.max((0.5 * other[2] - at.z.abs()).min(other[1] - rho).min(bore));
            }
        }
    }
    deepest
}

fn turn() -> impl Strategy<Value = [f64; 3]> {
    [-3.0..3.0, -3.0..3.0, -3.0..3.0]
}

fn body() -> impl Strategy<Value = [f64; 3]> {
    (0.5..4.0, 0.0..5.0, prop_oneof![Just(0.0), 0.1..0.8])
        .prop_map(|(outer, length, bore): (f64, f64, f64)| [bore * outer * MM, outer * MM, length * MM])
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 128, failure_persistence: None, ..ProptestConfig::default() })]

    #[test]
    fn both_orders_and_every_frame_give_the_same(
        first in body(), second in body(), at in [-5.0..5.0, -5.0..5.0, -5.0..5.0], turned in turn(),
        about in turn(), spin in -3.0..3.0_f64,
    ) {
        let outline = |b: [f64; 3]| Outline::cylinder(b[0], b[1], b[2]);
        let (one, two, place) = (outline(first), outline(second), pose(at, turned));
        let found = depth(&one, &two, &place);
        let inverse = Pose::identity().seen_from(&place);
        prop_assert!((found - depth(&two, &one, &inverse)).abs() <= DEPTH * MM);
        // Both moved alike, and each turned about its own axis.
        let moved = pose([7.0, -3.0, 2.0], about);
        let spun = Pose { rotation: Rotation3::from_axis_angle(&Vector3::z_axis(), spin).into_inner(), ..pose([0.0; 3], [0.0; 3]) };
        let again = moved.compose(&place).compose(&spun).seen_from(&moved.compose(&spun));
        let again = depth(&one, &two, &again);
        prop_assert!((found - again).abs() <= DEPTH * MM, "{found} and {again}");
    }

    #[test]
    fn no_point_of_the_body_lies_deeper_and_one_nearly_as_deep(
        first in body(), second in body(), at in [-5.0..5.0, -5.0..5.0, -5.0..5.0], turned in turn(),
    ) {
        let place = pose(at, turned);
        let found = Outline::cylinder(first[0], first[1], first[2]).depth_in(&Outline::cylinder(second[0], second[1], second[2]), &place);
        let sampled = sampled(first, second, &place);
        prop_assert!(sampled <= found + DEPTH * MM, "{found} where a point lies {sampled} deep");
        prop_assert!(found <= sampled + DEPTH_SAMPLED * MM, "{found} where points lie {sampled} deep at the most");
    }
}
