//! Multipoles by degree: the first is the dipole, and each further one pushes the error on by two orders of the distance.

use mcm::error::Error;
use mcm::magnetics::Dipole;
use nalgebra::Vector3;

use super::reference::ring;
use crate::tolerance::{IDENTITY, MULTIPOLE_ORDER, assert_close};

const DIRECTION: Vector3<f64> = Vector3::new(0.48, 0.36, 0.8);

/// Largest coordinate of the ring's edges from its centre, m.
const EXTENT: f64 = 2.0616e-3;

#[test]
fn the_first_multipole_is_the_dipole() {
    let (ring, point) = (ring(), DIRECTION * 2.0 * EXTENT);
    let dipole = Dipole::new(Vector3::z() * ring.moment()).unwrap();
    let (field, gradient) = ring.multipole_field_gradient(&point, 1).unwrap();
    let expected = dipole.field_gradient(&point).unwrap();
    assert_close("B", field.as_slice(), expected.0.as_slice(), IDENTITY);
    assert_close("G", gradient.as_slice(), expected.1.as_slice(), IDENTITY);
    assert_eq!(ring.multipole_field(&point, 1).unwrap(), field);
}

#[test]
fn what_a_degree_leaves_out_falls_with_its_order_in_the_distance() {
    let ring = ring();
    for degree in [1, 3, 5, 9] {
        let errors = [4.0, 5.0].map(|distance| {
            let point = DIRECTION * (distance * EXTENT);
            let (field, gradient) = ring.multipole_field_gradient(&point, degree).unwrap();
            let exact = ring.field_gradient(&point).unwrap();
            [(field - exact.0).norm() / exact.0.norm(), (gradient - exact.1).norm() / exact.1.norm()]
        });
        for (what, [near, far]) in [("B", [errors[0][0], errors[1][0]]), ("G", [errors[0][1], errors[1][1]])]
        {
            let order = (near / far).ln() / 1.25_f64.ln();
            println!("{what}, degree {degree}: {near:e}, {far:e}, order {order}");
            assert!((order - (degree + 1) as f64).abs() <= MULTIPOLE_ORDER, "{what}, {degree}: {order}");
        }
    }
}

#[test]
fn other_degrees_and_points_within_the_edges_are_refused() {
    let ring = ring();
    for (degree, distance) in [(0, 3.0), (2, 3.0), (19, 3.0), (3, 0.99), (3, f64::NAN), (3, 1e13)] {
        let found = ring.multipole_field(&(DIRECTION * (distance * EXTENT)), degree);
        assert!(matches!(found, Err(Error::Range { .. })), "{degree}, {distance}: {found:?}");
    }
}
