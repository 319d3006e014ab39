//! Every tolerance of the tests, each with its reason. Relative to the size of the value unless said.

mod equilibrium;
mod magnetics;
mod numerics;
mod vessel;

use core::fmt::Debug;

pub(crate) use equilibrium::*;
pub(crate) use magnetics::*;
pub(crate) use numerics::*;
pub(crate) use vessel::*;

/// Whether `got` is within `tolerance` of `expected`, relative to the Euclidean norm of `expected`; never for NaN.
pub(crate) fn is_close(got: &[f64], expected: &[f64], tolerance: f64) -> bool {
    got.len() == expected.len() && distance(got, expected) <= tolerance * norm(expected)
}

/// Stops unless `got` [`is_close`] to `expected`; says which case it was.
#[track_caller]
pub(crate) fn assert_close(case: impl Debug, got: &[f64], expected: &[f64], tolerance: f64) {
    let error = distance(got, expected) / norm(expected);
    assert!(
        is_close(got, expected, tolerance),
        "{case:?}: got {got:?}, expected {expected:?}: relative error {error:e} > {tolerance:e}"
    );
}

fn norm(values: &[f64]) -> f64 {
    values.iter().map(|v| v * v).sum::<f64>().sqrt()
}

fn distance(got: &[f64], expected: &[f64]) -> f64 {
    got.iter().zip(expected).map(|(a, b)| (a - b) * (a - b)).sum::<f64>().sqrt()
}

#[test]
fn the_comparison_sees_what_it_must() {
    assert!(is_close(&[1.0, 2.0], &[1.0, 2.0 + 1e-13], 1e-12));
    assert!(!is_close(&[1.0, 2.0], &[1.0, 2.1], 1e-2), "a wrong digit");
    assert!(!is_close(&[-1.0, -2.0], &[1.0, 2.0], 1e-2), "a wrong sign");
    assert!(!is_close(&[f64::NAN, 2.0], &[1.0, 2.0], 1e-2), "NaN in the result");
    assert!(!is_close(&[1.0, 2.0], &[f64::NAN, 2.0], 1e-2), "NaN in the reference");
    assert!(!is_close(&[f64::INFINITY, 2.0], &[1.0, 2.0], 1e-2), "infinity");
    assert!(!is_close(&[1.0], &[1.0, 2.0], 1e-2), "a missing entry");
    assert!(!is_close(&[1e-30], &[0.0], 1e-2), "zero has no size to be relative to");
}
