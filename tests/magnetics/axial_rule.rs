//! The axial rule against a brute-force volume integral.

use core::f64::consts::PI;

use mcm::magnetics::{AxialRule, Jet};
use mcm::numerics::quadrature::gauss_legendre;
use nalgebra::{Rotation3, Vector3};

use super::reference::ring;
use crate::given::pair;
use crate::tolerance::{ROUNDING, assert_close};

const INNER: f64 = 0.75e-3;
const OUTER: f64 = 2.0e-3;
const LENGTH: f64 = 1.0e-3;

/// A body's frame: position of its centre and axes.
type Frame = (Vector3<f64>, Rotation3<f64>);

/// Mean of the field over the ring by 8 x 8 Gauss points in `rho^2` and `z` and 48 around.
fn mean_by_volume(at: &Frame, field: impl Fn(&Vector3<f64>) -> Vector3<f64>) -> Vector3<f64> {
    let (nodes, weights) = gauss_legendre(8);
    let around = 48_u32;
    let mut sum = Vector3::zeros();
    for (x, wx) in nodes.iter().zip(&weights) {
        let rho = (0.5 * (OUTER.powi(2) + INNER.powi(2)) + 0.5 * (OUTER.powi(2) - INNER.powi(2)) * x).sqrt();
        for (z, wz) in nodes.iter().zip(&weights) {
            for k in 0..around {
                let (sine, cosine) = (2.0 * PI * f64::from(k) / f64::from(around)).sin_cos();
                let local = Vector3::new(rho * cosine, rho * sine, 0.5 * LENGTH * z);
                sum += field(&(at.0 + at.1 * local)) * (0.25 * wx * wz / f64::from(around));
            }
        }
    }
    sum
}

/// Mean of the field over the ring by the rule.
fn mean_by_rule(rule: &AxialRule, at: &Frame, field: impl Fn(&Vector3<f64>) -> Vector3<f64>) -> Vector3<f64> {
    let volume: f64 = rule.points().map(|(_, weight)| weight).sum();
    rule.points().map(|(z, w)| field(&(at.0 + at.1 * Vector3::new(0.0, 0.0, z))) * (w / volume)).sum()
}

/// Largest relative error of the mean field over bent pairs of rings with centres `distance` apart.
fn ring_error(nodes: usize, distance: f64) -> f64 {
    let (source, rule) = (ring(), AxialRule::new(INNER, OUTER, LENGTH, nodes));
    let field = |point: &Vector3<f64>| source.field(point).expect("no edge");
    [0.0, 10.0, 20.0, 30.0, 40.0_f64]
        .into_iter()
        .map(|degrees| {
            // The chord of an arc of two clamped segments leans by half the bend.
            let bend = degrees.to_radians();
            let chord = Rotation3::new(Vector3::x() * (0.5 * bend)) * Vector3::z();
            let at = (chord * distance, Rotation3::new(Vector3::x() * bend));
            let exact = mean_by_volume(&at, field);
            (mean_by_rule(&rule, &at, field) - exact).norm() / exact.norm()
        })
        .fold(0.0, f64::max)
}

#[test]
fn error_over_a_ring_by_distance_and_nodes() {
    // Measured with bends of 0 to 40 degrees, rounded up by at most two; rows: distance of the centres.
    let table = [
        (4.0e-3, [(1, 3e-1), (3, 5e-2), (5, 2e-2), (7, 5e-3), (9, 1e-3), (11, 5e-5)]),
        (5.0e-3, [(1, 2e-1), (3, 4e-2), (5, 4e-3), (7, 6e-4), (9, 1e-4), (11, 6e-6)]),
        (6.0e-3, [(1, 2e-1), (3, 2e-2), (5, 2e-3), (7, 1e-4), (9, 1e-5), (11, 6e-7)]),
        (10.0e-3, [(1, 8e-2), (3, 5e-3), (5, 2e-4), (7, 5e-6), (9, 1e-7), (11, 8e-10)]),
        (30.0e-3, [(1, 1e-2), (3, 1e-4), (5, 4e-7), (7, 2e-9), (9, 5e-12), (11, 4e-12)]),
    ];
    let mut report = Vec::new();
    let mut good = true;
    for (distance, row) in table {
        for (nodes, bound) in row {
            let error = ring_error(nodes, distance);
            good &= error <= bound;
            report.push(format!("{:.0} mm, {nodes} nodes: {error:.1e} (bound {bound:.0e})", distance * 1e3));
        }
    }
    assert!(good, "{report:#?}");
}

#[test]
fn one_to_three_nodes_do_in_the_external_field() {
    let source = pair();
    let field = |point: &Vector3<f64>| source.field(point).expect("no edge");
    let mut worst = [0.0_f64; 2];
    for z in [0.0, 20e-3, 35e-3, 50e-3] {
        let at = (Vector3::new(0.0, 52.5e-3, z), Rotation3::new(Vector3::new(0.7, 0.2, 0.0)));
        let exact = mean_by_volume(&at, field);
        for (nodes, worst) in [1, 3].into_iter().zip(&mut worst) {
            let rule = AxialRule::new(INNER, OUTER, LENGTH, nodes);
            *worst = worst.max((mean_by_rule(&rule, &at, field) - exact).norm() / exact.norm());
        }
    }
    assert!(worst[0] <= 2e-3 && worst[1] <= 1e-5, "30 mm from the surface: {worst:?}");
}

#[test]
fn rule_integrates_solid_harmonics_of_its_degree() {
    // A dipole's far field is dominated by low degrees; here each degree by itself: Re (x + i z)^l is harmonic.
    for nodes in 1..=AxialRule::MOST_NODES {
        let rule = AxialRule::new(INNER, OUTER, LENGTH, nodes);
        assert_eq!(rule.points().len(), nodes);
        let degree = if nodes % 2 == 1 { nodes } else { nodes - 1 };
        for l in 0..=u32::try_from(degree).expect("small") {
            let harmonic = |point: &Vector3<f64>| {
                let (radius, angle) = (point.x.hypot(point.z) / OUTER, point.x.atan2(point.z));
                Vector3::new(radius.powi(l.cast_signed()) * (f64::from(l) * angle).cos(), 0.0, 0.0)
            };
            let at = (Vector3::zeros(), Rotation3::identity());
            let (exact, got) = (mean_by_volume(&at, harmonic).x, mean_by_rule(&rule, &at, harmonic).x);
            assert!((got - exact).abs() <= 1e-12, "{nodes} nodes, degree {l}: {got} for {exact}");
        }
    }
}

#[test]
fn rule_for_an_accuracy_holds_it() {
    for (distance, tolerance) in [(5e-3, 1e-3), (10e-3, 1e-6), (30e-3, 1e-3), (30e-3, 1e-9), (0.1, 1e-2)] {
        let rule = AxialRule::for_accuracy(INNER, OUTER, LENGTH, distance, tolerance).expect("reachable");
        assert!(rule.error(distance) <= tolerance);
        let dipole = mcm::magnetics::Dipole::new(Vector3::new(0.3, 0.0, 1.0)).expect("finite");
        let source = Vector3::new(0.0, 0.0, distance);
        let field = |point: &Vector3<f64>| dipole.field(&(point - source)).expect("apart");
        let at = (Vector3::zeros(), Rotation3::identity());
        let exact = mean_by_volume(&at, field);
        let error = (mean_by_rule(&rule, &at, field) - exact).norm() / exact.norm();
        assert!(error <= tolerance, "{distance} m, {tolerance:e}: {error:e} with {}", rule.points().len());
    }
    assert_eq!(
        AxialRule::for_accuracy(INNER, OUTER, LENGTH, 1.0, 1e-3).map(|rule| rule.points().len()),
        Ok(1)
    );
    assert!(AxialRule::for_accuracy(INNER, OUTER, LENGTH, 2.5e-3, 1e-9).is_err(), "too close");
    assert!(AxialRule::for_accuracy(INNER, OUTER, LENGTH, f64::NAN, 1e-3).is_err());
    assert!(AxialRule::for_accuracy(OUTER, INNER, LENGTH, 1.0, 1e-3).is_err(), "inside out");
}

#[test]
fn a_uniform_field_is_its_mean() {
    let rule = AxialRule::new(0.0, OUTER, 5.0 * OUTER, 11);
    let jet = Jet { field: Vector3::new(0.0, 0.02, 0.01), ..Jet::zero() };
    let at = (Vector3::new(1.0, 2.0, 3.0), Rotation3::identity());
    let mean = mean_by_rule(&rule, &at, |_| jet.field);
    assert_close("mean", mean.as_slice(), jet.field.as_slice(), 100.0 * ROUNDING);
}
