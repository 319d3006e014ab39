//! One vessel: against closed forms, a search over all balls, and differences.

use std::f64::consts::PI;

use mcm::vessel::Branch;
use nalgebra::{Rotation3, Vector3};

use super::{NEAR_AXIS, STEP, errors_of_derivatives, points_near, winding};
use crate::tolerance::{CLEARANCE, CLEARANCE_SLOPE};

/// An arc of 60 mm radius in the x-z plane, from the origin along +z, of the given length (m), with radius 3 mm.
fn arc(points: u32, length: f64) -> Branch {
    let place = |i: u32| {
        let turn = length * f64::from(i) / f64::from(points) / 0.06;
        Vector3::new(0.06 * (1.0 - turn.cos()), 0.0, 0.06 * turn.sin())
    };
    let centres: Vec<_> = (0..=points).map(place).collect();
    Branch::new("arc", &centres, &vec![3e-3; centres.len()]).unwrap()
}

#[test]
fn straight_and_tapered_tubes_are_those_of_geometry() {
    for taper in [0.0, 0.1, -0.2] {
        let centres = [0.0, 0.02, 0.05, 0.06].map(|z| Vector3::new(0.0, 0.0, z));
        let radius = |z: f64| 8e-3 + taper * (z - 0.03);
        let tube = Branch::new("tube", &centres, &centres.map(|c| radius(c.z))).unwrap();
        for (rho, z, turn) in [(5e-3_f64, 0.03_f64, 0.3_f64), (1e-3, 0.021, 2.0), (9e-3, 0.035, -1.0)] {
            let point = Vector3::new(rho * turn.cos(), rho * turn.sin(), z);
            let clearance = tube.clearance(&point);
            // The envelope of balls whose radius changes by `taper` per length is a cone.
            let exact = radius(z) - rho * (1.0 - taper * taper).sqrt();
            assert!((clearance.value - exact).abs() < 1e-15, "{taper}, {rho}: {}", clearance.value - exact);
            assert!((clearance.gradient.norm() - 1.0).abs() < 1e-12);
            assert!((clearance.gradient.z - taper).abs() < 1e-9, "{}", clearance.gradient.z);
        }
    }
}

#[test]
fn ends_are_half_balls() {
    let tube = Branch::new("tube", &[Vector3::zeros(), Vector3::new(0.0, 0.0, 0.05)], &[4e-3; 2]).unwrap();
    for point in [Vector3::new(1e-3, 0.0, 0.052_f64), Vector3::new(0.0, -2e-3, -1e-3)] {
        let end = Vector3::new(0.0, 0.0, point.z.clamp(0.0, 0.05));
        let clearance = tube.clearance(&point);
        assert!((clearance.value - (4e-3 - (point - end).norm())).abs() < 1e-15);
        let [slope, curve] = errors_of_derivatives(|x| tube.clearance(x), &point, STEP);
        assert!(slope < 1e-8 && curve < 1e-7, "{slope:e}, {curve:e}");
    }
}

#[test]
fn an_arc_through_points_is_a_torus_to_fourth_order() {
    let error = |count| {
        let tube = arc(count, 0.12);
        let mut worst: f64 = 0.0;
        for i in 0..200 {
            let (turn, side) = (0.05 + 1.9 * f64::from(i) / 200.0, 0.7 * f64::from(i));
            let outwards =
                Vector3::new(-turn.cos(), 0.0, turn.sin()) * side.cos() + Vector3::y() * side.sin();
            let centre = Vector3::new(0.06 * (1.0 - turn.cos()), 0.0, 0.06 * turn.sin());
            let rho = 3.2e-3 * f64::from(i % 17) / 17.0;
            let clearance = tube.clearance(&(centre + outwards * rho));
            worst = worst.max((clearance.value - (3e-3 - rho)).abs());
        }
        worst
    };
    let (coarse, fine) = (error(30), error(60));
    let order = (coarse / fine).log2();
    println!(
        "arc of 60 mm radius: {coarse:.1e} m by points 4 mm apart, {fine:.1e} by 2 mm, order {order:.2}"
    );
    assert!(fine < 1e-8 && order > 3.7, "{coarse:e}, {fine:e}");
}

#[test]
fn the_nearest_ball_is_that_of_a_search_over_all() {
    for number in 0..20 {
        let branch = winding(number);
        let length = *branch.range().end();
        for point in points_near(&branch, number, 40) {
            let told = branch.clearance(&point).value;
            let depth = |t: f64| {
                let (centre, radius) = branch.ball(t);
                radius - (point - centre).norm()
            };
            let all = (0..=20_000).map(|i| depth(length * f64::from(i) / 20_000.0));
            let best = all.fold(f64::NEG_INFINITY, f64::max);
            assert!(told >= best - CLEARANCE, "{number}, {point:?}: {told:e}, by search {best:e}");
            // Between two places of the search the depth changes by less than their distance.
            assert!(told - best < 1e-5, "{number}, {point:?}: {told:e}, by search {best:e}");
        }
    }
}

#[test]
fn derivatives_are_those_of_differences() {
    let (mut slopes, mut curves, mut count) = (0.0_f64, 0.0_f64, 0);
    for number in 0..20 {
        let branch = winding(number);
        for point in points_near(&branch, 100 + number, 40) {
            let clearance = branch.clearance(&point);
            if clearance.hessian.norm() > NEAR_AXIS {
                continue;
            }
            let [slope, curve] = errors_of_derivatives(|x| branch.clearance(x), &point, STEP);
            (slopes, curves, count) = (slopes.max(slope), curves.max(curve), count + 1);
        }
    }
    println!("{count} points: gradients to {slopes:.1e}, second derivatives to {curves:.1e}");
    assert!(count > 500 && slopes < CLEARANCE_SLOPE && curves < CLEARANCE_SLOPE, "{slopes:e}, {curves:e}");
}

#[test]
fn on_the_centreline_nothing_is_infinite() {
    let branch = winding(3);
    for i in 0..=50 {
        let (centre, radius) = branch.ball(branch.range().end() * f64::from(i) / 50.0);
        for offset in [0.0, 1e-18, 1e-12] {
            let clearance = branch.clearance(&(centre + Vector3::x() * offset));
            assert!((clearance.value - radius).abs() < 0.02 * radius, "{}", clearance.value);
            assert!(clearance.gradient.iter().chain(&clearance.hessian).all(|entry| entry.is_finite()));
        }
    }
}

#[test]
fn a_motion_of_the_whole_changes_nothing() {
    let turn = Rotation3::from_euler_angles(0.4, -1.1, 2.0).into_inner();
    let shift = Vector3::new(0.3, -0.2, 0.1);
    let moved = |x: &Vector3<f64>| turn * x + shift;
    let branch = winding(5);
    let knots: Vec<f64> = (0..=200).map(|i| branch.range().end() * f64::from(i) / 200.0).collect();
    let (centres, radii): (Vec<_>, Vec<_>) = knots.iter().map(|t| branch.ball(*t)).unzip();
    let own = Branch::new("own", &centres, &radii).unwrap();
    let other = Branch::new("other", &centres.iter().map(moved).collect::<Vec<_>>(), &radii).unwrap();
    for point in points_near(&branch, 7, 40) {
        let (a, b) = (own.clearance(&point), other.clearance(&moved(&point)));
        assert!((a.value - b.value).abs() < CLEARANCE, "{:e}", a.value - b.value);
        assert!((turn * a.gradient - b.gradient).norm() < 1e-10);
        let difference = (turn * a.hessian * turn.transpose() - b.hessian).norm();
        assert!(difference < 1e-7 * a.hessian.norm(), "{difference:e}");
    }
}

#[test]
fn what_is_no_vessel_is_refused_with_its_place() {
    let line = |count: usize| (0..count).map(|i| Vector3::new(0.0, 0.0, 5e-3 * i as f64)).collect::<Vec<_>>();
    let bend: Vec<Vector3<f64>> = (0..=30)
        .map(|i| f64::from(i) * PI / 30.0)
        .map(|t| Vector3::new(t.cos(), t.sin(), 0.0) * 4e-3)
        .collect();
    let mut twice = line(4);
    twice[2] = twice[1];
    let mut unknown = line(4);
    unknown[1].y = f64::NAN;
    for (points, radii, expected) in [
        (line(1), vec![1e-3], "has 1 entries, expected 1, one for each of at least 2 points"),
        (line(4), vec![1e-3; 3], "list of radii of vessel branch \"bad\" has 3 entries, expected 4"),
        (unknown, vec![1e-3; 4], "coordinate or radius (m) of vessel branch \"bad\" = NaN"),
        (line(4), vec![1e-3, f64::INFINITY, 1e-3, 1e-3], "= inf is not allowed"),
        (twice, vec![1e-3; 4], "distance (m) of point 3 of vessel branch \"bad\" from the one before = 0"),
        (line(4), vec![1e-3, 1e-3, -1e-3, 1e-3], "radius (m) of vessel branch \"bad\" at (0.0, 0.0, "),
        (line(3), vec![2e-3, 6e-3, 13e-3], "change of the radius per length of vessel branch \"bad\""),
        (bend, vec![5e-3; 31], "radius times curvature of the centreline of vessel branch \"bad\""),
    ] {
        let refused = Branch::new("bad", &points, &radii).unwrap_err().to_string();
        assert!(refused.contains(expected), "{refused}");
    }
}
