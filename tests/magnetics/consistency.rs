//! Laws that the fields obey whatever their values: Maxwell's equations, derivatives by differences, scaling, limits.

use mcm::magnetics::{AxialSource, Dipole, FieldHessian, Jet, LinearField};
use nalgebra::{Matrix3, Rotation3, Vector3};
use proptest::prelude::*;

use super::reference::ring;
use crate::given::pair;
use crate::tolerance::{DERIVATIVES, DIFFERENCE, FIELD, IDENTITY, ROUNDING, assert_close};

/// A ring or cylinder of any shape, and a point at 1.02 to 30 of its extents.
fn scene() -> impl Strategy<Value = (AxialSource, Vector3<f64>)> {
    let shape = (0.0..0.9_f64, 0.2e-3..50e-3_f64, 0.1..4.0_f64, -1.4..1.4_f64);
    let place = (1.02..30.0_f64, -1.0..1.0_f64, 0.0..6.3_f64);
    (shape, place).prop_map(|((bore, outer, aspect, remanence), (distance, cosine, azimuth))| {
        let (bore, length) = (if bore < 0.2 { 0.0 } else { bore }, aspect * outer);
        let source = AxialSource::new(bore * outer, outer, length, remanence + 0.1_f64.copysign(remanence))
            .expect("the strategy keeps to the allowed range");
        let r = distance * outer.hypot(0.5 * length);
        let rho = r * (1.0 - cosine * cosine).sqrt();
        (source, Vector3::new(rho * azimuth.cos(), rho * azimuth.sin(), r * cosine))
    })
}

proptest! {
    #[test]
    fn field_is_free_of_divergence_and_curl((source, point) in scene()) {
        let jet = source.jet(&point).expect("outside");
        let size = jet.gradient.norm();
        prop_assert!(jet.gradient.trace().abs() <= IDENTITY * size);
        prop_assert!((jet.gradient - jet.gradient.transpose()).norm() <= IDENTITY * size);
        for axis in [Vector3::x(), Vector3::y(), Vector3::z()] {
            let slice = jet.hessian_along(&axis);
            let size = full_norm(&jet.hessian);
            prop_assert!(slice.trace().abs() <= IDENTITY * size, "{} of {size}", slice.trace());
        }
    }

    #[test]
    fn derivatives_match_differences((source, point) in scene()) {
        let jet = source.jet(&point).expect("outside");
        let step = 1e-4 * source.distance(&point);
        let at = |axis: usize, side: f64| {
            let mut moved = point;
            moved[axis] += side * step;
            source.jet(&moved).expect("outside")
        };
        let mut gradient = Matrix3::zeros();
        for axis in 0..3 {
            let (ahead, behind) = (at(axis, 1.0), at(axis, -1.0));
            gradient.set_column(axis, &((ahead.field - behind.field) / (2.0 * step)));
            let slice = (ahead.gradient - behind.gradient) / (2.0 * step);
            let mut along = Vector3::zeros();
            along[axis] = 1.0;
            let error = (slice - jet.hessian_along(&along)).norm();
            prop_assert!(error <= DIFFERENCE * full_norm(&jet.hessian), "H along {axis}: {error}");
        }
        // The differences lose the field's own rounding over the step.
        let rounding = FIELD * 1e-2 * jet.field.norm() / step;
        prop_assert!((gradient - jet.gradient).norm() <= DIFFERENCE * jet.gradient.norm() + rounding);
    }

    #[test]
    fn field_depends_on_shape_and_direction_only((source, point) in scene(), factor in 0.1..10.0_f64) {
        let scaled = AxialSource::new(
            source.inner_radius() * factor,
            source.outer_radius() * factor,
            source.length() * factor,
            2.0 * source.remanence(),
        ).expect("allowed");
        let (one, two) = (source.jet(&point).expect("outside"), scaled.jet(&(point * factor)).expect("outside"));
        assert_close("B", (two.field * 0.5).as_slice(), one.field.as_slice(), FIELD);
        assert_close("G", (two.gradient * 0.5 * factor).as_slice(), one.gradient.as_slice(), DERIVATIVES);
        assert_close("H", &(two * (0.5 * factor * factor)).hessian.0, &one.hessian.0, DERIVATIVES);
    }

    #[test]
    fn field_turns_with_the_axis((source, point) in scene(), angle in -3.0..3.0_f64) {
        let turn = Rotation3::from_axis_angle(&Vector3::z_axis(), angle).into_inner();
        let (there, here) = (source.jet(&(turn * point)).expect("outside"), source.jet(&point).expect("outside"));
        let here = here.rotated(&turn);
        assert_close("B", there.field.as_slice(), here.field.as_slice(), FIELD);
        assert_close("G", there.gradient.as_slice(), here.gradient.as_slice(), DERIVATIVES);
        assert_close("H", &there.hessian.0, &here.hessian.0, DERIVATIVES);
    }

    #[test]
    fn a_ring_is_an_outer_minus_an_inner_cylinder((source, point) in scene()) {
        prop_assume!(source.inner_radius() > 0.0);
        let solid = |radius| AxialSource::new(0.0, radius, source.length(), source.remanence()).expect("allowed");
        let (outer, inner) = (solid(source.outer_radius()), solid(source.inner_radius()));
        let whole = outer.jet(&point).expect("outside") + inner.jet(&point).expect("outside") * -1.0;
        let ring = source.jet(&point).expect("outside");
        let large = outer.jet(&point).expect("outside");
        prop_assert!((whole.field - ring.field).norm() <= FIELD * large.field.norm());
        prop_assert!((whole.gradient - ring.gradient).norm() <= DERIVATIVES * large.gradient.norm());
    }
}

/// The norm of the whole tensor of 27 entries.
fn full_norm(hessian: &FieldHessian) -> f64 {
    (0..27).map(|i| hessian.entry(i / 9, i / 3 % 3, i % 3).powi(2)).sum::<f64>().sqrt()
}

#[test]
fn closed_form_and_multipoles_meet() {
    for source in [ring(), AxialSource::new(0.0, 22.5e-3, 30e-3, 1.35).expect("allowed")] {
        let seam = 6.0 * source.outer_radius().hypot(0.5 * source.length());
        for i in 0_i32..40 {
            let angle = 0.04 + 0.0785 * f64::from(i);
            let direction = Vector3::new(angle.sin() * 0.6, angle.sin() * 0.8, angle.cos());
            let inside = source.jet(&(direction * seam * (1.0 - 1e-15))).expect("outside");
            let beyond = source.jet(&(direction * seam * (1.0 + 1e-15))).expect("outside");
            assert_close(("B", angle), inside.field.as_slice(), beyond.field.as_slice(), FIELD);
            assert_close(("G", angle), inside.gradient.as_slice(), beyond.gradient.as_slice(), DERIVATIVES);
            assert_close(("H", angle), &inside.hessian.0, &beyond.hessian.0, DERIVATIVES);
        }
    }
}

#[test]
fn far_away_a_magnet_is_a_dipole() {
    let source = ring();
    let dipole = Dipole::new(Vector3::new(0.0, 0.0, source.moment())).expect("finite");
    let direction = Vector3::new(0.48, -0.6, 0.64);
    for distance in [0.1_f64, 1.0, 10.0, 1e5] {
        // The next multipole is 6.34 mm2 / r^2 of the dipole, times at most (l+1)(l+2)(l+3)/... = 15.
        let bound = 100.0 * 6.34e-6 / (distance * distance) + DERIVATIVES;
        let (exact, limit) = (source.jet(&(direction * distance)), dipole.jet(&(direction * distance)));
        let (exact, limit) = (exact.expect("outside"), limit.expect("outside"));
        assert_close(("B", distance), exact.field.as_slice(), limit.field.as_slice(), bound);
        assert_close(("G", distance), exact.gradient.as_slice(), limit.gradient.as_slice(), bound);
        assert_close(("H", distance), &exact.hessian.0, &limit.hessian.0, bound);
    }
}

#[test]
fn a_dipole_has_the_derivatives_that_differences_give() {
    let dipole = Dipole::new(Vector3::new(0.3, -0.2, 0.9)).expect("finite");
    let (point, step) = (Vector3::new(0.02, 0.03, -0.01), 1e-6);
    let jet = dipole.jet(&point).expect("not at the dipole");
    for (axis, unit) in [Vector3::x(), Vector3::y(), Vector3::z()].into_iter().enumerate() {
        let side = |sign: f64| dipole.field_gradient(&(point + unit * sign * step)).expect("not there");
        let (ahead, behind) = (side(1.0), side(-1.0));
        let column: Vector3<f64> = jet.gradient.column(axis).into();
        assert_close(axis, ((ahead.0 - behind.0) / (2.0 * step)).as_slice(), column.as_slice(), DIFFERENCE);
        let slice = (ahead.1 - behind.1) / (2.0 * step);
        assert_close(axis, slice.as_slice(), jet.hessian_along(&unit).as_slice(), DIFFERENCE);
    }
    assert!(dipole.field(&Vector3::zeros()).is_err());
    assert!(dipole.field(&Vector3::new(f64::NAN, 0.0, 0.0)).is_err());
    assert!(Dipole::new(Vector3::new(f64::INFINITY, 0.0, 0.0)).is_err());
}

#[test]
fn turning_a_jet_there_and_back_changes_nothing() {
    let jet = pair().jet(&Vector3::new(0.03, -0.02, 0.05)).expect("outside");
    let turn = Rotation3::from_euler_angles(0.3, -1.1, 2.0).into_inner();
    let back: Jet = jet.rotated(&turn).rotated(&turn.transpose());
    assert_close("B", back.field.as_slice(), jet.field.as_slice(), ROUNDING);
    assert_close("G", back.gradient.as_slice(), jet.gradient.as_slice(), ROUNDING);
    assert_close("H", &back.hessian.0, &jet.hessian.0, ROUNDING);
}

#[test]
fn a_linear_field_is_free_of_divergence_and_curl() {
    let field = LinearField::new(Vector3::new(0.01, 0.02, 0.03), [1.0, 2.0, 3.0, 4.0, 5.0]);
    let gradient = field.gradient();
    assert_eq!(gradient, gradient.transpose());
    assert!(gradient.trace().abs() <= ROUNDING);
    let [xx, xy, xz, yy, yz] = [(0, 0), (0, 1), (0, 2), (1, 1), (1, 2)].map(|index| gradient[index]);
    assert_close("entries", &[xx, xy, xz, yy, yz], &[1.0, 2.0, 3.0, 4.0, 5.0], ROUNDING);
    let point = Vector3::new(0.1, -0.2, 0.3);
    let jet = field.jet(&point);
    assert_eq!((jet.field, jet.gradient), (field.at(&point), gradient));
}
