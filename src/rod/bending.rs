//! Elastic bending and torsion energy of a station as a function of the rotation vector and its rate.
//!
//! The curvature is `J_r(theta) theta'`, so that the energy density `1/2 u^T K_bt u` (Richter et al., Eq. 12) depends on
//! both.

use nalgebra::{Matrix3, Matrix3xX, Vector3};

use super::curvature_stiffness::curvature_stiffness;
use super::element::{Element, Station};
use super::kinematics::{Configuration, StationState};
use super::row::{ROTATIONS, Row};
use crate::design::Stiffness;

/// First and second derivatives of the energy with respect to rotation vector and rate.
pub(super) struct Bending {
    pub(super) slope: Vector3<f64>,
    pub(super) rate_slope: Vector3<f64>,
    pub(super) curve: Matrix3<f64>,
    pub(super) mixed: Matrix3<f64>,
    pub(super) rate_curve: Matrix3<f64>,
}

/// Derivatives of a station's curvature with respect to rotation vector and rate.
pub(super) struct CurvatureDerivatives {
    pub(super) by_vector: Matrix3<f64>,
    pub(super) by_rate: Matrix3<f64>,
}

impl CurvatureDerivatives {
    pub(super) fn of(state: &StationState) -> Self {
        let by_vector = state.theta.right_product_derivative(&state.rate);
        Self { by_vector, by_rate: state.left.transpose() }
    }
}

/// Derivatives of the curvature (1/m, material frame, per arc length of the element's tables) at a tabulated arc length by each
/// amplitude of an element; zero for those of shear and extension.
#[must_use]
pub fn curvature_rates(
    configuration: &Configuration,
    element: &Element,
    row: &Row,
    amplitudes: &[f64],
) -> Matrix3xX<f64> {
    let (theta, rate) = configuration.turned_at(element, row, amplitudes);
    let (by_vector, by_rate) = (theta.right_product_derivative(&rate), theta.left_jacobian().transpose());

    let mut out = Matrix3xX::zeros(element.freedoms());
    for (i, c) in element.component.iter().enumerate().filter(|(_, c)| **c < ROTATIONS) {
        out.set_column(i, &(by_vector.column(*c) * row.integral[i] + by_rate.column(*c) * row.rate[i]));
    }
    out
}

/// Derivative of the curvature by arc length (1/m2, material frame, by that of the element's tables) at a tabulated arc length, where
/// the mode values have these `slopes` (1/m2, by degree of freedom).
#[must_use]
pub fn curvature_slope(
    configuration: &Configuration,
    element: &Element,
    (row, slopes): (&Row, &[f64]),
    amplitudes: &[f64],
) -> Vector3<f64> {
    let (theta, rate) = configuration.turned_at(element, row, amplitudes);
    let mut second = Vector3::zeros();
    for ((c, slope), amplitude) in element.component.iter().zip(slopes).zip(amplitudes) {
        if *c < ROTATIONS {
            second[*c] += slope * amplitude;
        }
    }
    // u = J_r(theta) theta'
    theta.right_product_derivative(&rate) * rate + theta.left_jacobian().tr_mul(&second)
}

impl Bending {
    /// Derivatives at a station, of the energy per `growth`.
    pub(super) fn new(state: &StationState, station: &Station, growth: f64) -> Self {
        let weight = station.weight / growth;
        let CurvatureDerivatives { by_vector, by_rate: right } = CurvatureDerivatives::of(state);
        let stiffness = curvature_stiffness(&station.stiffness.lined(state.lining), weight);
        let relaxed = curvature_stiffness(&station.stiffness, weight).component_mul(&state.rest);
        let moment = stiffness.component_mul(&(right * state.rate)) - relaxed;
        let weighted = Matrix3::from_diagonal(&stiffness);

        Self {
            slope: by_vector.tr_mul(&moment),
            rate_slope: right.tr_mul(&moment),
            curve: by_vector.tr_mul(&(weighted * by_vector))
                + state.theta.contract_curvature(&moment, &state.rate),
            mixed: by_vector.tr_mul(&(weighted * right))
                + state.theta.left_product_derivative(&moment).transpose(),
            rate_curve: right.tr_mul(&(weighted * right)),
        }
    }
}

/// Derivatives of a station's bending and torsion energy with respect to rotation vector and rate, for these stiffnesses of what
/// bends and of what is bent without loads.
pub(super) fn gradient(
    state: &StationState,
    [stiffness, of_rest]: [&Stiffness; 2],
    weight: f64,
) -> (Vector3<f64>, Vector3<f64>) {
    let curvature = state.left.tr_mul(&state.rate);
    let moment = curvature_stiffness(stiffness, weight).component_mul(&curvature)
        - curvature_stiffness(of_rest, weight).component_mul(&state.rest);
    (state.theta.right_product_derivative(&state.rate).tr_mul(&moment), state.left * moment)
}
