//! Surfaces, edges, the inside of the material, and what is refused.

use core::f64::consts::PI;

use mcm::constants::VACUUM_PERMEABILITY;
use mcm::error::Error;
use mcm::magnetics::{AxialMagnet, AxialSource, Cylinders, Source};
use nalgebra::Vector3;

use super::reference::ring;
use crate::given::{cylinder, pair};
use crate::tolerance::{FIELD, IDENTITY, assert_close};

#[test]
fn on_an_edge_the_field_is_refused() {
    let source = ring();
    for radius in [0.75e-3, 2.0e-3] {
        for z in [-0.5e-3, 0.5e-3] {
            let point = Vector3::new(0.0, radius, z);
            let refused = Err(Error::OnEdge { x: 0.0, y: radius, z });
            assert_eq!(source.field(&point), refused);
            assert!(source.field_gradient(&point).is_err() && source.jet(&point).is_err());
            // A picometre away it is an answer.
            let beside = Vector3::new(0.0, radius + 1e-12, z);
            let jet = source.jet(&beside).expect("not on the edge");
            assert!(jet.field.norm().is_finite() && jet.gradient.norm().is_finite());
            assert!(jet.hessian.0.iter().all(|entry| entry.is_finite()));
        }
    }
}

#[test]
fn the_field_crosses_every_surface_as_it_must() {
    let source = ring();
    let hair = 1e-12;
    let step = |point: Vector3<f64>, normal: Vector3<f64>| {
        let side = |sign: f64| source.field(&(point + normal * (sign * hair))).expect("no edge");
        side(1.0) - side(-1.0)
    };
    // Through the faces B is continuous, through the sides B_z falls by the remanence on leaving the material.
    let face = step(Vector3::new(1.2e-3, 0.3e-3, 0.5e-3), Vector3::z());
    assert!(face.norm() < 1e-8, "{face}");
    let outer = step(Vector3::new(2.0e-3, 0.0, 0.2e-3), Vector3::x());
    assert!((outer - Vector3::new(0.0, 0.0, -1.35)).norm() < 1e-8, "{outer}");
    let bore = step(Vector3::new(0.75e-3, 0.0, -0.1e-3), Vector3::x());
    assert!((bore - Vector3::new(0.0, 0.0, 1.35)).norm() < 1e-8, "{bore}");
    // On the side itself: the mean.
    let on = source.field(&Vector3::new(2.0e-3, 0.0, 0.2e-3)).expect("no edge");
    let beside = |sign: f64| source.field(&Vector3::new(2.0e-3 + sign * hair, 0.0, 0.2e-3)).expect("no edge");
    assert!((on - (beside(1.0) + beside(-1.0)) * 0.5).norm() < 1e-8);
}

#[test]
fn inside_a_long_magnet_the_flux_density_is_the_remanence() {
    let rod = AxialSource::new(0.0, 1e-3, 1.0, 1.35).expect("allowed");
    let field = rod.field(&Vector3::new(0.3e-3, 0.2e-3, 0.0)).expect("inside is answered");
    assert!((field - Vector3::new(0.0, 0.0, 1.35)).norm() < 1e-5, "{field}");
}

#[test]
fn flux_through_the_plane_of_symmetry_returns() {
    // The flux through the whole plane z = 0 is zero; outside the disc of radius r it is minus that inside.
    let source = ring();
    let (nodes, weights) = mcm::numerics::quadrature::gauss_legendre(60);
    let annulus = |from: f64, to: f64| -> f64 {
        nodes
            .iter()
            .zip(&weights)
            .map(|(x, w)| {
                let rho = 0.5 * (from + to) + 0.5 * (to - from) * x;
                let field = source.field(&Vector3::new(rho, 0.0, 0.0)).expect("no edge");
                0.5 * (to - from) * w * 2.0 * PI * rho * field.z
            })
            .sum()
    };
    let inside = annulus(0.0, 0.75e-3) + annulus(0.75e-3, 2.0e-3);
    let mut outside = 0.0;
    let (mut from, mut to) = (2.0e-3, 3.0e-3);
    while from < 1e3 {
        outside += annulus(from, to);
        (from, to) = (to, to * 1.5);
    }
    outside -= VACUUM_PERMEABILITY * source.moment() / (2.0 * from); // the rest is a dipole's
    assert_close("flux", &[-outside], &[inside], 1e-10);
}

#[test]
fn distance_and_inside() {
    let source = ring();
    let distance = |x: f64, z: f64| source.distance(&Vector3::new(0.0, x, z));
    assert_close("bore", &[distance(0.0, 0.0)], &[0.75e-3], IDENTITY);
    assert_close("over the face", &[distance(1e-3, 2e-3)], &[1.5e-3], IDENTITY);
    assert_close("off the edge", &[distance(5e-3, -4.5e-3)], &[5e-3], IDENTITY);
    assert_eq!(distance(1e-3, 0.1e-3).to_bits(), 0.0_f64.to_bits());
    assert!(source.contains(&Vector3::new(1e-3, 0.0, 0.1e-3)));
    assert!(!source.contains(&Vector3::zeros()), "the bore");
    let two = pair();
    assert!(!two.contains(&Vector3::zeros()), "the gap");
    assert!(two.contains(&Vector3::new(0.0, 0.0, -20e-3)));
    assert_close("gap", &[two.distance(&Vector3::zeros())], &[5e-3], IDENTITY);
    assert_close("paper", &[two.distance(&Vector3::new(0.0, 62.5e-3, 20e-3))], &[40e-3], IDENTITY);
    assert_close("moment", &[two.moment().z], &[102.52], 1e-4);
}

#[test]
fn points_that_are_no_points_are_refused() {
    let (one, two) = (ring(), pair());
    for bad in [f64::NAN, f64::INFINITY, f64::NEG_INFINITY, 1e200] {
        for axis in 0..3 {
            let mut point = Vector3::new(0.01, 0.02, 0.03);
            point[axis] = bad;
            assert!(one.field(&point).is_err() && one.jet(&point).is_err(), "{point}");
            assert!(two.field_gradient(&point).is_err(), "{point}");
        }
    }
    // Huge and tiny ones are points.
    for size in [1e-300, 1e-200, 1e-20, 1e3, 1e8] {
        let jet = one.jet(&Vector3::new(size, -size, 0.5 * size)).expect("a point");
        assert!(jet.field.iter().chain(jet.gradient.iter()).chain(&jet.hessian.0).all(|v| v.is_finite()));
    }
}

#[test]
fn sources_out_of_range_are_refused() {
    let cases = [
        ([0.0, f64::NAN, 1e-3, 1.0], "outer radius"),
        ([0.0, -1e-3, 1e-3, 1.0], "outer radius"),
        ([0.0, 0.0, 1e-3, 1.0], "outer radius"),
        ([2e-3, 2e-3, 1e-3, 1.0], "inner radius"),
        ([-1e-3, 2e-3, 1e-3, 1.0], "inner radius"),
        ([0.0, 2e-3, 0.0, 1.0], "length"),
        ([0.0, 2e-3, f64::INFINITY, 1.0], "length"),
        ([0.0, 2e-3, 1e-3, f64::NAN], "remanence"),
    ];
    for ([inner, outer, length, remanence], named) in cases {
        let error = AxialSource::new(inner, outer, length, remanence).expect_err(named).to_string();
        assert!(error.contains(named), "{error}");
    }
}

#[test]
fn assemblies_that_cannot_be_built_are_refused() {
    let one = cylinder();
    let moved = |offset| AxialMagnet { offset, ..one };
    assert!(matches!(Cylinders::new(Vec::new()), Err(Error::Count { .. })));
    assert!(Cylinders::new(vec![one; 65]).is_err());
    assert!(Cylinders::new(vec![moved(f64::NAN)]).is_err());
    assert!(matches!(Cylinders::new(vec![one, one]), Err(Error::Unsupported(_))));
    assert!(Cylinders::new(vec![one, moved(-29e-3)]).is_err());
    assert!(Cylinders::new(vec![one, moved(30e-3)]).is_ok(), "touching is allowed");
    let around = AxialMagnet { inner_radius: 22.5e-3, radius: 30e-3, ..one };
    let stacked = Source::from(Cylinders::new(vec![one, around]).expect("a tube around a cylinder"));
    let whole = AxialSource::new(0.0, 30e-3, one.length, one.remanence).expect("allowed");
    let point = Vector3::new(0.01, 0.04, 0.02);
    let (sum, expected) = (stacked.field(&point).expect("outside"), whole.field(&point).expect("outside"));
    assert_close("tube and cylinder", sum.as_slice(), expected.as_slice(), FIELD);
}
