//! Sums over the dipoles of a sheet, beside sums of the fields at its points.

use mcm::geometry::Pose;
use mcm::magnetics::{AxialSource, DipoleSheet, FieldAccuracy, SheetSums};
use nalgebra::{Matrix3, Vector2, Vector3};
use rand::rngs::StdRng;
use rand::{RngExt, SeedableRng};

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
fn one_by_one(source: &AxialSource, dipoles: &[(Vector2<f64>, f64)], pose: &Pose) -> SheetSums {
    let axis: Vector3<f64> = pose.rotation.column(2).into();
    let mut sums = SheetSums::zero();
    for (at, moment) in dipoles {
        let point = pose.position + pose.rotation * Vector3::new(at.x, at.y, 0.0);
        let jet = source.jet(&point).expect("not on an edge");
        sums.field += jet.field * *moment;
        for (number, weight) in [1.0, at.x, at.y].into_iter().enumerate() {
            sums.force[number] += jet.gradient * axis * (moment * weight);
            sums.second.gradient[number] += jet.gradient * (moment * weight);
        }
        let weights = [1.0, at.x, at.y, at.x * at.x, at.x * at.y, at.y * at.y];
        for (number, weight) in weights.into_iter().enumerate() {
            sums.second.along[number] += jet.hessian_along(&axis) * (moment * weight);
        }
    }
    sums
}

/// Largest differences over the largest sums of the kind: field, forces, gradients, second derivatives.
fn apart(got: &SheetSums, expected: &SheetSums) -> [f64; 4] {
    let of_vectors = |got: &[Vector3<f64>], expected: &[Vector3<f64>]| {
        let parts = got.iter().zip(expected).map(|(a, b)| (a - b).norm() / b.norm());
        parts.fold(0.0, f64::max)
    };
    let of_matrices = |got: &[Matrix3<f64>], expected: &[Matrix3<f64>]| {
        let parts = got.iter().zip(expected).map(|(a, b)| (a - b).norm() / b.norm());
        parts.fold(0.0, f64::max)
    };
    [
        of_vectors(&[got.field], &[expected.field]),
        of_vectors(&got.force, &expected.force),
        of_matrices(&got.second.gradient, &expected.second.gradient),
        of_matrices(&got.second.along, &expected.second.along),
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
            let slopes = ring.on_sheet(&sheet, &pose, accuracy, false).expect("outside");
            let second = ring.on_sheet(&sheet, &pose, accuracy, true).expect("outside");
            let [field, force, ..] = apart(&slopes, &expected);
            // The sums may cancel to a tenth of their terms.
            let errors = apart(&second, &expected);
            let worst = errors.into_iter().chain([field, force]).fold(0.0, f64::max);
            assert!(worst <= 1e1 * allowed, "{accuracy:?}, {count}: {errors:?}, {field:e}, {force:e}");
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
            let sums = ring.on_sheet(&DipoleSheet::new(&one), &pose, FieldAccuracy::Multipoles(terms), true);
            let errors = apart(&sums.expect("outside"), &one_by_one(&ring, &one, &pose));
            let allowed = LEFT_OUT * ratio.powi(-2 * terms as i32) + BATCH;
            assert!(errors[2] <= allowed, "{terms} terms at {ratio}: {errors:?}, allowed {allowed:e}");
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
            let second = ring.on_sheet(&DipoleSheet::new(&dipoles), &pose, accuracy, true).expect("outside");
            let slopes = ring.on_sheet(&DipoleSheet::new(&dipoles), &pose, accuracy, false).expect("outside");
            for (sums, kinds) in [(slopes, 2), (second, 4)] {
                let size = [expected.field.norm(), expected.force[0].norm()];
                let errors = [
                    (sums.field - expected.field).norm() / size[0],
                    (sums.force[0] - expected.force[0]).norm() / size[1],
                    (sums.second.gradient[0] - expected.second.gradient[0]).norm()
                        / expected.second.gradient[0].norm(),
                    (sums.second.along[0] - expected.second.along[0]).norm()
                        / expected.second.along[0].norm(),
                ];
                let worst = errors.into_iter().take(kinds).fold(0.0, f64::max);
                assert!(worst <= ROUGH_SHEET, "{accuracy:?} at {radius}, {height}: {errors:?}");
            }
        }
    }
}

#[test]
fn inside_the_magnet_there_is_no_sum() {
    let [inner, outer, _] = RING;
    let inside = [(Vector2::new(0.5 * (inner + outer), 0.0), 1e-6)];
    let sheet = |dipoles: &[(Vector2<f64>, f64)]| DipoleSheet::new(dipoles);
    for accuracy in [FieldAccuracy::Exact, FieldAccuracy::Rough] {
        assert!(ring().on_sheet(&sheet(&inside), &Pose::identity(), accuracy, false).is_none());
        let nowhere = Pose { position: Vector3::new(f64::NAN, 0.0, 0.0), ..Pose::identity() };
        assert!(ring().on_sheet(&sheet(&inside), &nowhere, accuracy, false).is_none());
        let nothing = ring().on_sheet(&sheet(&[]), &Pose::identity(), accuracy, false);
        assert_eq!(nothing, Some(SheetSums::zero()));
        // In the bore of the ring, on its axis; not in a solid cylinder.
        let middle = sheet(&[(Vector2::zeros(), 1e-6)]);
        assert!(ring().on_sheet(&middle, &Pose::identity(), accuracy, false).is_some());
        let solid = AxialSource::new(0.0, outer, 1e-3, 1.0).expect("allowed");
        assert!(solid.on_sheet(&middle, &Pose::identity(), accuracy, false).is_none());
    }
}
