//! Fields at many points, beside those at single points.

use mcm::error::Error;
use mcm::geometry::Pose;
use mcm::magnetics::{AxialMagnet, AxialSource, Cylinders, Jet, Source};
use nalgebra::Vector3;
use rand::rngs::StdRng;
use rand::{RngExt, SeedableRng};

use crate::tolerance::{BATCH, ROUNDING, assert_close};

/// The paper's ring, a washer, a tube with a thin wall, a cylinder, a needle and a plate.
fn sources() -> Vec<AxialSource> {
    let shapes = [
        [0.75e-3, 2.0e-3, 1.0e-3],
        [0.2e-3, 4.0e-3, 0.1e-3],
        [1.9e-3, 2.0e-3, 5.0e-3],
        [0.0, 22.5e-3, 30.0e-3],
        [0.0, 0.1e-3, 20.0e-3],
        [0.0, 0.5, 1e-3],
    ];
    shapes
        .map(|[inner, outer, length]| AxialSource::new(inner, outer, length, 1.3).expect("allowed"))
        .to_vec()
}

/// Points of all kinds around a source: inside and outside, near edges, on the axis, on the walls, in the planes of its
/// faces, and beyond the distance from which multipoles are used.
fn points(source: &AxialSource, count: usize, seed: u64) -> Vec<Vector3<f64>> {
    let mut random = StdRng::seed_from_u64(seed);
    let (outer, half) = (source.outer_radius(), 0.5 * source.length());
    let extent = outer.hypot(half);
    (0..count)
        .map(|number| {
            let angle = random.random_range(0.0..core::f64::consts::TAU);
            let mut rho = random.random_range(0.0..2.0) * extent;
            let mut z = random.random_range(-2.0..2.0) * extent;
            match number % 8 {
                0 => rho = 0.0,
                1 => rho = [outer, source.inner_radius()][number / 8 % 2],
                2 => z = half,
                3 => {
                    let near = 10_f64.powf(random.random_range(-9.0..-1.0)) * outer;
                    (rho, z) = (outer + near * angle.cos(), -half + near * angle.sin());
                }
                4 => (rho, z) = (6.0 * rho, 6.0 * z),
                5 => rho *= 1e-6,
                _ => {}
            }
            Vector3::new(rho * angle.cos(), rho * angle.sin(), z)
        })
        .collect()
}

/// Stops unless both differ by no more than the rounding of what the field is a difference of: that of single edges.
fn assert_same(case: &str, order: i32, source: &AxialSource, got: &[f64], expected: &[f64]) {
    let size = |values: &[f64]| values.iter().map(|value| value * value).sum::<f64>().sqrt();
    let apart: Vec<f64> = got.iter().zip(expected).map(|(a, b)| a - b).collect();
    let of_an_edge = source.remanence() / source.outer_radius().powi(order);
    let allowed = BATCH * size(expected) + ROUNDING * of_an_edge;
    assert!(size(&apart) <= allowed, "{case}, order {order}: {got:?}, alone {expected:?}");
}

#[test]
fn many_points_are_as_each_alone() {
    let (mut fields, mut jets) = (Vec::new(), Vec::new());
    for (number, source) in sources().iter().enumerate() {
        let points = points(source, 4000, number as u64);
        source.field_gradients(&points, &mut fields).expect("no point is on an edge");
        source.jets(&points, &mut jets).expect("no point is on an edge");
        assert_eq!((fields.len(), jets.len()), (points.len(), points.len()));
        for ((point, jet), (field, gradient)) in points.iter().zip(&jets).zip(&fields) {
            let same = |order, got: &[f64], expected: &[f64]| {
                assert_same(&format!("source {number} at {point:?}"), order, source, got, expected);
            };
            let alone = source.jet(point).expect("not on an edge");
            for field in [field, &jet.field] {
                same(0, field.as_slice(), alone.field.as_slice());
            }
            for gradient in [gradient, &jet.gradient] {
                same(1, gradient.as_slice(), alone.gradient.as_slice());
            }
            same(2, &jet.hessian.0, &alone.hessian.0);
        }
    }
}

#[test]
fn a_magnet_at_many_points_is_as_at_each_alone() {
    let cylinder =
        AxialMagnet { radius: 22.5e-3, inner_radius: 0.0, length: 30e-3, offset: -20e-3, remanence: 1.35 };
    let ring = AxialMagnet { inner_radius: 10e-3, offset: 30e-3, remanence: -1.1, ..cylinder };
    let magnet = Source::from(Cylinders::new(vec![cylinder, ring]).expect("apart"));
    let around = AxialSource::new(0.0, 22.5e-3, 80e-3, 1.0).expect("allowed");
    let points = points(&around, 1000, 11);
    // What was there before is written over.
    let (mut fields, mut jets) = (vec![Default::default(); points.len()], vec![Jet::zero(); points.len()]);
    magnet.gradients(&points, &mut fields).expect("no point is on an edge");
    magnet.gradients(&points, &mut fields).expect("no point is on an edge");
    magnet.jets(&points, &mut jets).expect("no point is on an edge");
    let mut plain = vec![Vector3::x(); points.len()];
    magnet.fields(&points, &mut plain).expect("no point is on an edge");
    assert!(
        plain.iter().zip(&fields).all(|(plain, (field, _))| (plain - field).norm() < 1e-12 * field.norm())
    );
    for ((point, jet), (field, gradient)) in points.iter().zip(&jets).zip(&fields) {
        let same = |order, got: &[f64], expected: &[f64]| {
            assert_same(&format!("magnet at {point:?}"), order, &around, got, expected);
        };
        let alone = magnet.jet(point).expect("not on an edge");
        same(0, field.as_slice(), alone.field.as_slice());
        same(1, gradient.as_slice(), alone.gradient.as_slice());
        same(0, jet.field.as_slice(), alone.field.as_slice());
        same(1, jet.gradient.as_slice(), alone.gradient.as_slice());
        same(2, &jet.hessian.0, &alone.hessian.0);
    }
}

#[test]
fn any_number_of_points_is_answered_in_order() {
    let source = &sources()[0];
    let all = points(source, 40, 7);
    let mut fields = vec![Default::default(); 3];
    for count in 0..all.len() {
        source.field_gradients(&all[..count], &mut fields).expect("no point is on an edge");
        assert_eq!(fields.len(), count);
        for (point, (field, _)) in all.iter().zip(&fields) {
            let alone = source.field(point).expect("not on an edge");
            assert_close(format!("{count} points, {point:?}"), field.as_slice(), alone.as_slice(), BATCH);
        }
    }
}

#[test]
fn points_without_a_field_are_refused() {
    let source = &sources()[0];
    let edge = Vector3::new(source.outer_radius(), 0.0, 0.5 * source.length());
    for (bad, on_edge) in
        [(edge, true), (Vector3::new(f64::NAN, 0.0, 0.0), false), (Vector3::new(0.0, 0.0, 1e10), false)]
    {
        for place in [0, 3, 7, 8, 12] {
            let mut points = points(source, 13, 5);
            points[place] = bad;
            let refused = source.field_gradients(&points, &mut Vec::new()).expect_err("no field there");
            assert_eq!(matches!(refused, Error::OnEdge { .. }), on_edge, "{refused}");
            assert!(source.jets(&points, &mut Vec::new()).is_err());
        }
    }
}

#[test]
fn the_field_scales_with_the_size_of_all() {
    // Lengths from nanometres to hundreds of metres must neither overflow nor vanish in products.
    let paper = sources()[0];
    let mut points = points(&paper, 64, 3);
    // Beside an edge the rounding of the coordinates counts, and on a wall it decides on which side a point lies.
    points = points
        .into_iter()
        .enumerate()
        .filter(|(number, _)| ![1, 3].contains(&(number % 8)))
        .map(|row| row.1)
        .collect();
    let mut expected = Vec::new();
    paper.field_gradients(&points, &mut expected).expect("no point is on an edge");
    for scale in [1e-5, 1e-2, 1e3, 1e5] {
        let lengths = [paper.inner_radius(), paper.outer_radius(), paper.length()].map(|l| l * scale);
        let [inner, outer, length] = lengths;
        let source = AxialSource::new(inner, outer, length, paper.remanence()).expect("allowed");
        let scaled: Vec<_> = points.iter().map(|point| point * scale).collect();
        let mut got = Vec::new();
        source.field_gradients(&scaled, &mut got).expect("no point is on an edge");
        for ((field, gradient), (same, steeper)) in got.iter().zip(&expected) {
            assert_close(format!("{scale}"), field.as_slice(), same.as_slice(), BATCH);
            assert_close(
                format!("{scale}"),
                (gradient * scale).as_slice(),
                steeper.as_slice(),
                1e3 * ROUNDING,
            );
        }
    }
}

#[test]
fn an_edge_is_named_in_the_frame_of_the_question() {
    let cylinder =
        |offset| AxialMagnet { radius: 4e-3, inner_radius: 0.0, length: 10e-3, offset, remanence: 1.0 };
    let magnet = Source::from(Cylinders::new(vec![cylinder(-10e-3), cylinder(10e-3)]).expect("allowed"));
    let edge = Vector3::new(4e-3, 0.0, 15e-3);
    let told = |refused: Error| match refused {
        Error::OnEdge { x, y, z } => Vector3::new(x, y, z),
        other => panic!("{other}"),
    };
    assert_eq!(told(magnet.field(&edge).expect_err("an edge")), edge);
    assert_eq!(told(magnet.field_gradient(&edge).expect_err("an edge")), edge);
    assert_eq!(told(magnet.jet(&edge).expect_err("an edge")), edge);
    for count in [1, 13] {
        let points = vec![edge; count];
        let (mut gradients, mut jets) = (vec![Default::default(); count], vec![Jet::zero(); count]);
        assert_eq!(told(magnet.fields(&points, &mut points.clone()).expect_err("an edge")), edge);
        assert_eq!(told(magnet.gradients(&points, &mut gradients).expect_err("an edge")), edge);
        assert_eq!(told(magnet.jets(&points, &mut jets).expect_err("an edge")), edge);
    }
    let pose = Pose::new([0.1, 0.2, 0.3], [0.5, 0.5, 0.5, 0.5]).expect("a unit quaternion");
    let there = pose.position + pose.rotation * edge;
    assert_eq!(told(magnet.field_gradient_from(&pose, &there).expect_err("an edge")), there);
}
