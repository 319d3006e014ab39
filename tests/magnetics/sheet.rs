//! Sums over the dipoles of a sheet, beside sums of the fields at its points.

use mcm::geometry::Pose;
use mcm::magnetics::{AxialSource, DipoleSheet, FieldAccuracy, SecondSums, SheetSums};
use mcm::numerics::processor::Instructions;
use nalgebra::{Matrix3, SMatrix, Vector2, Vector3};
use rand::rngs::StdRng;
use rand::{RngExt, SeedableRng};

use crate::instructions::with_instructions;
use crate::tolerance::{BATCH, LEFT_OUT, ROUGH_SHEET};

const RING: [f64; 3] = [0.75e-3, 2.0e-3, 1.0e-3];

fn ring() -> AxialSource {
    let [inner, outer, length] = RING;
    AxialSource::new(inner, outer, length, 1.35).expect("allowed")
}

fn dipoles(count: usize, random: &mut StdRng) -> Vec<(Vector2<f64>, f64)> {
    let mut one = |_| {
        let position = Vector2::from_fn(|_, _| random.random_range(-1.5e-3..1.5e-3));
        (position, random.random_range(-1e-6..3e-6))
    };
    (0..count).map(&mut one).collect()
}

/// A pose at a distance (m) from the origin, turned at random.
fn pose(distance: f64, random: &mut StdRng) -> Pose {
    let mut vector = || Vector3::<f64>::from_fn(|_, _| random.random_range(-1.0..1.0));
    let (towards, axis) = (vector().normalize(), vector());
    let rotation = nalgebra::Rotation3::new(axis).into_inner();
    Pose { position: towards * distance, rotation }
}

/// The sums from the fields at the points.
fn one_by_one(source: &AxialSource, dipoles: &[(Vector2<f64>, f64)], pose: &Pose) -> (SheetSums, SecondSums) {
    let axis: Vector3<f64> = pose.rotation.column(2).into();
    let (none, zero) = (Vector3::zeros(), Matrix3::zeros());
    let mut sums = SheetSums { field: none, force: [none; 3] };
    let mut second = SecondSums { field: none, gradient: [zero; 3], along: [zero; 6] };
    for (at, moment) in dipoles {
        let point = pose.position + pose.rotation * Vector3::new(at.x, at.y, 0.0);
        let jet = source.jet(&point).expect("not on an edge");
        sums.field += jet.field * *moment;
        for (number, weight) in [1.0, at.x, at.y].into_iter().enumerate() {
            sums.force[number] += jet.gradient * axis * (moment * weight);
            second.gradient[number] += jet.gradient * (moment * weight);
        }
        let weights = [1.0, at.x, at.y, at.x * at.x, at.x * at.y, at.y * at.y];
        for (number, weight) in weights.into_iter().enumerate() {
            second.along[number] += jet.hessian_along(&axis) * (moment * weight);
        }
    }
    second.field = sums.field;
    (sums, second)
}

/// The largest, or NaN.
fn worst(errors: impl IntoIterator<Item = f64>) -> f64 {
    errors.into_iter().fold(0.0, |worst, error| if error <= worst { worst } else { error })
}

/// Largest difference of two vectors or matrices over the expected one.
fn apart<const C: usize>(got: &[SMatrix<f64, 3, C>], expected: &[SMatrix<f64, 3, C>]) -> f64 {
    let one = |(a, b): (&SMatrix<f64, 3, C>, &SMatrix<f64, 3, C>)| {
        if a == b { 0.0 } else { (a - b).norm() / b.norm() }
    };
    worst(got.iter().zip(expected).map(one))
}

/// Errors of field, forces, and of field, gradients and second derivatives.
fn errors(slopes: &SheetSums, second: &SecondSums, expected: &(SheetSums, SecondSums)) -> [f64; 5] {
    let (first, curved) = expected;
    [
        apart(&[slopes.field], &[first.field]),
        apart(&slopes.force, &first.force),
        apart(&[second.field], &[curved.field]),
        apart(&second.gradient, &curved.gradient),
        apart(&second.along, &curved.along),
    ]
}

#[test]
fn sums_are_those_of_single_points() {
    let mut random = StdRng::seed_from_u64(4);
    let ring = ring();
    for (accuracy, allowed) in [(FieldAccuracy::Exact, BATCH), (FieldAccuracy::Rough, ROUGH_SHEET)] {
        for count in (1..30).chain([64, 100]) {
            let (dipoles, pose) = (dipoles(count, &mut random), pose(4.5e-3, &mut random));
            let sheet = DipoleSheet::new(&dipoles);
            let expected = one_by_one(&ring, &dipoles, &pose);
            let slopes = ring.on_sheet(&sheet, &pose, accuracy).expect("outside");
            let second = ring.second_on_sheet(&sheet, &pose, accuracy).expect("outside");
            // The sums may cancel to a tenth of their terms.
            let errors = errors(&slopes, &second, &expected);
            let worst = worst(errors);
            assert!(worst <= 1e1 * allowed, "{accuracy:?}, {count}: {errors:?}");
        }
    }
}

#[test]
fn multipoles_err_by_what_they_leave_out() {
    let mut random = StdRng::seed_from_u64(5);
    let ring = ring();
    let extent = RING[1].hypot(0.5 * RING[2]);
    for terms in 3..=9 {
        for ratio in [2.5, 4.0, 6.0] {
            let one = [(Vector2::new(0.0, 0.0), 1e-6)];
            let pose = pose(ratio * extent, &mut random);
            let (sheet, accuracy) = (DipoleSheet::new(&one), FieldAccuracy::Multipoles(terms));
            let sums = ring.second_on_sheet(&sheet, &pose, accuracy).expect("outside");
            let (_, expected) = one_by_one(&ring, &one, &pose);
            let error = apart(&sums.gradient[..1], &expected.gradient[..1]);
            let allowed = LEFT_OUT * ratio.powi(-2 * terms as i32) + BATCH;
            assert!(error <= allowed, "{terms} terms at {ratio}: {error:e}, allowed {allowed:e}");
        }
    }
}

#[test]
fn points_on_the_axis_and_beside_edges_are_right() {
    let (ring, upright) = (ring(), Pose::identity());
    let [inner, outer, length] = RING;
    let dipoles = |radius: f64| [(Vector2::zeros(), 1e-6), (Vector2::new(radius, 0.0), 2e-6)];
    // In the bore, in the planes of the faces, and a micrometre beside an edge, where points are evaluated alone.
    for (radius, height) in [(0.5 * inner, 0.1e-3), (1.5 * outer, 0.5 * length), (outer + 1e-6, 0.5 * length)]
    {
        let (dipoles, pose) = (dipoles(radius), upright.advanced(height));
        let expected = one_by_one(&ring, &dipoles, &pose);
        for accuracy in [FieldAccuracy::Exact, FieldAccuracy::Rough] {
            let sheet = DipoleSheet::new(&dipoles);
            let slopes = ring.on_sheet(&sheet, &pose, accuracy).expect("outside");
            let second = ring.second_on_sheet(&sheet, &pose, accuracy).expect("outside");
            let errors = errors(&slopes, &second, &expected);
            let worst = worst(errors);
            assert!(worst <= ROUGH_SHEET, "{accuracy:?} at {radius}, {height}: {errors:?}");
        }
    }
}

#[test]
fn inside_the_magnet_there_is_no_sum() {
    let [inner, outer, _] = RING;
    let inside = [(Vector2::new(0.5 * (inner + outer), 0.0), 1e-6)];
    let sheet = |dipoles: &[(Vector2<f64>, f64)]| DipoleSheet::new(dipoles);
    for accuracy in [FieldAccuracy::Exact, FieldAccuracy::Rough] {
        assert!(ring().on_sheet(&sheet(&inside), &Pose::identity(), accuracy).is_none());
        let nowhere = Pose { position: Vector3::new(f64::NAN, 0.0, 0.0), ..Pose::identity() };
        assert!(ring().on_sheet(&sheet(&inside), &nowhere, accuracy).is_none());
        let nothing = ring().on_sheet(&sheet(&[]), &Pose::identity(), accuracy);
        let (none, _) = one_by_one(&ring(), &[], &Pose::identity());
        assert_eq!(nothing, Some(none));
        // In the bore of the ring, on its axis; not in a solid cylinder.
        let middle = sheet(&[(Vector2::zeros(), 1e-6)]);
        assert!(ring().on_sheet(&middle, &Pose::identity(), accuracy).is_some());
        let solid = AxialSource::new(0.0, outer, 1e-3, 1.0).expect("allowed");
        assert!(solid.on_sheet(&middle, &Pose::identity(), accuracy).is_none());
    }
}

#[test]
fn every_processor_gives_the_same_bits() {
    let (ring, mut random) = (ring(), StdRng::seed_from_u64(6));
    let mut cases = Vec::new();
    for _ in 0..200 {
        let far: f64 = random.random_range(3e-3..2e-2);
        cases.push((DipoleSheet::new(&dipoles(11, &mut random)), pose(far, &mut random)));
    }
    let points: Vec<Vector3<f64>> = cases.iter().map(|(_, pose)| pose.position).collect();
    let all = || {
        let accuracies = [FieldAccuracy::Exact, FieldAccuracy::Rough, FieldAccuracy::Multipoles(7)];
        let sums: Vec<_> = accuracies
            .into_iter()
            .flat_map(|accuracy| cases.iter().map(move |(sheet, pose)| (sheet, pose, accuracy)))
            .map(|(sheet, pose, accuracy)| {
                (ring.on_sheet(sheet, pose, accuracy), ring.second_on_sheet(sheet, pose, accuracy))
            })
            .collect();
        let (mut fields, mut jets) = (Vec::new(), Vec::new());
        ring.field_gradients(&points, &mut fields).unwrap();
        ring.jets(&points, &mut jets).unwrap();
        format!("{sums:?} {fields:?} {jets:?}")
    };
    let (portable, detected) = (with_instructions(true, all), with_instructions(false, all));
    println!("portable and {}", Instructions::in_use());
    assert!(portable.len() > 100_000);
    assert_eq!(portable, detected);
}
