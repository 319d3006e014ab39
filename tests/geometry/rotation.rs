//! The rotation vector and its derivatives, from angles of 1e-9 over the switch of formulas to beyond a turn.

use std::f64::consts::PI;

use mcm::geometry::{Pose, RotationVector, axial, hat, rotation_log};
use nalgebra::{Matrix3, Rotation3, Vector3};

use crate::tolerance::{LAW, ROTATION, ROTATION_DIFFERENCE, assert_close};

/// Angles, rad: tiny, small, either side of the formulas' switch at sqrt(12) and of pi, and more than a turn.
#[expect(clippy::approx_constant, reason = "both sides of pi, not pi")]
const ANGLES: [f64; 11] = [0.0, 1e-9, 1e-5, 0.1, 1.0, 3.0, 3.141_592, 3.142, 3.464_101_6, 3.464_101_7, 7.0];

/// Step of the differences, rad.
const STEP: f64 = 1e-4;

fn vectors() -> impl Iterator<Item = Vector3<f64>> {
    let axes = [Vector3::new(0.48, -0.6, 0.64), Vector3::x(), Vector3::new(-0.6, 0.0, 0.8)];
    ANGLES.into_iter().flat_map(move |angle| axes.map(|axis| axis * angle))
}

fn matrix() -> Matrix3<f64> {
    Matrix3::new(0.3, -1.1, 0.7, 0.9, 0.2, -0.4, -0.5, 1.3, 0.8)
}

/// Derivative along each axis by central differences of fourth order.
fn difference<T>(v: &Vector3<f64>, mut f: impl FnMut(&Vector3<f64>) -> T) -> [T; 3]
where
    T: core::ops::Sub<Output = T> + core::ops::Mul<f64, Output = T>,
{
    core::array::from_fn(|axis| {
        let mut central = |step: f64| {
            let d = Vector3::ith(axis, step);
            (f(&(v + d)) - f(&(v - d))) * (0.5 / step)
        };
        central(STEP) * (4.0 / 3.0) - central(2.0 * STEP) * (1.0 / 3.0)
    })
}

#[test]
fn the_exponential_is_the_rotation() {
    for v in vectors() {
        let expected = Rotation3::new(v).into_inner();
        let got = RotationVector::new(v).matrix();
        assert_close(v, got.as_slice(), expected.as_slice(), ROTATION);
        assert_close(v, (got.transpose() * got).as_slice(), Matrix3::identity().as_slice(), ROTATION);
    }
}

#[test]
fn the_logarithm_inverts_it_up_to_half_a_turn() {
    for v in vectors().filter(|v| v.norm() < PI - 1e-4) {
        let back = rotation_log(&RotationVector::new(v).matrix());
        assert!((back - v).norm() <= 1e-9 * v.norm().max(1.0), "{v}: got {back}");
    }
    // Half a turn exactly: either sign is right.
    let half = Vector3::new(0.6, 0.0, 0.8) * core::f64::consts::PI;
    let back = rotation_log(&RotationVector::new(half).matrix());
    assert!((back - half).norm().min((back + half).norm()) < 1e-7, "got {back}");
}

#[test]
fn the_jacobians_turn_a_change_of_the_vector_into_one_of_the_frame() {
    for v in vectors() {
        let at = RotationVector::new(v);
        let rotation = at.matrix();
        let changes = difference(&v, |v| RotationVector::new(*v).matrix());
        let spin = |m: Matrix3<f64>| axial(&m) * 0.5;
        let left = Matrix3::from_columns(&changes.map(|change| spin(change * rotation.transpose())));
        let right = Matrix3::from_columns(&changes.map(|change| spin(rotation.tr_mul(&change))));
        assert_close(("left", v), at.left_jacobian().as_slice(), left.as_slice(), ROTATION_DIFFERENCE);
        assert_close(("right", v), at.right_jacobian().as_slice(), right.as_slice(), ROTATION_DIFFERENCE);
        assert_close(("turned", v), (rotation * right).as_slice(), left.as_slice(), ROTATION_DIFFERENCE);
        let inverse = at.left_jacobian_inverse().expect("no full turn");
        assert_close(v, (inverse * at.left_jacobian()).as_slice(), Matrix3::identity().as_slice(), LAW);
    }
}

#[test]
fn a_full_turn_has_no_inverse_jacobian() {
    let turn = RotationVector::new(Vector3::new(0.6, 0.0, 0.8) * core::f64::consts::TAU);
    assert!(turn.left_jacobian_inverse().is_none());
}

#[test]
fn contracted_rotation_has_its_slope_and_curvature() {
    let n = matrix();
    for v in vectors() {
        let (slope, curve) = RotationVector::new(v).contract_rotation(&n);
        let energy = |v: &Vector3<f64>| n.dot(&RotationVector::new(*v).matrix());
        assert_close(("slope", v), slope.as_slice(), &difference(&v, energy), ROTATION_DIFFERENCE);
        let columns = difference(&v, |v| RotationVector::new(*v).contract_rotation(&n).0);
        let expected = Matrix3::from_columns(&columns);
        assert_close(("curve", v), curve.as_slice(), expected.as_slice(), ROTATION_DIFFERENCE);
    }
}

#[test]
fn contracted_curvature_and_products_have_their_derivatives() {
    let (m, rate) = (Vector3::new(0.7, -0.2, 1.1), Vector3::new(-0.4, 0.9, 0.3));
    for v in vectors() {
        let at = RotationVector::new(v);
        let left = Matrix3::from_columns(&difference(&v, |v| RotationVector::new(*v).left_jacobian() * m));
        assert_close(
            ("left", v),
            at.left_product_derivative(&m).as_slice(),
            left.as_slice(),
            ROTATION_DIFFERENCE,
        );
        let right = Matrix3::from_columns(&difference(&v, |v| RotationVector::new(*v).right_jacobian() * m));
        let got = at.right_product_derivative(&m);
        assert_close(("right", v), got.as_slice(), right.as_slice(), ROTATION_DIFFERENCE);
        // Gradient of m . J_r rate is (dJ_r rate)^T m.
        let columns = difference(&v, |v| RotationVector::new(*v).right_product_derivative(&rate).tr_mul(&m));
        let expected = Matrix3::from_columns(&columns);
        let got = at.contract_curvature(&m, &rate);
        assert_close(("curvature", v), got.as_slice(), expected.as_slice(), ROTATION_DIFFERENCE);
    }
}

#[test]
fn hat_and_axial_are_each_others_inverse() {
    let (a, b) = (Vector3::new(1.0, -2.0, 3.0), Vector3::new(0.5, 4.0, -1.0));
    assert_close("cross", (hat(&a) * b).as_slice(), a.cross(&b).as_slice(), ROTATION);
    assert_close("axial", axial(&hat(&a)).as_slice(), (a * 2.0).as_slice(), ROTATION);
}

#[test]
fn halfway_between_two_poses_is_half_the_turn() {
    let from = Pose::new([1.0, 2.0, 3.0], [0.8, 0.36, -0.48, 0.0]).expect("a pose");
    let turn = Vector3::new(0.3, -2.0, 1.5);
    let to = Pose {
        position: Vector3::new(3.0, 2.0, -1.0),
        rotation: from.rotation * RotationVector::new(turn).matrix(),
    };
    let half = from.between(&to, 0.5);
    assert_close("position", half.position.as_slice(), &[2.0, 2.0, 1.0], ROTATION);
    let expected = from.rotation * RotationVector::new(turn * 0.5).matrix();
    assert_close("rotation", half.rotation.as_slice(), expected.as_slice(), ROTATION);
    let [w, x, y, z] = to.quaternion();
    let again = Pose::new(to.position.into(), [w, x, y, z]).expect("a unit quaternion");
    assert!(w >= 0.0, "{w}");
    assert_close("quaternion", again.rotation.as_slice(), to.rotation.as_slice(), ROTATION);
}
