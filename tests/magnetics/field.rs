//! Field, gradient and second derivative on every row of the reference tables.

use mcm::magnetics::{AxialMagnet, AxialSource, Cylinders, Jet, Source};
use nalgebra::Vector3;

use super::reference::{Row, ring, table};
use crate::given::{cylinder, pair};
use crate::tolerance::{DERIVATIVES, DERIVATIVES_NEAR_EDGE, FIELD, ZERO_GRADIENT, assert_close};

/// A point this close to an edge is held to the wider tolerance, m.
const NEAR_EDGE: f64 = 10e-6;

#[test]
fn ring_matches_the_reference() {
    let source = ring();
    let edges = [(2.0e-3, 0.5e-3), (0.75e-3, 0.5e-3)];
    compare_fields("ring_field_dev.csv", &edges, |p| source.jet(p).expect("no edge"));
    compare_hessians("ring_hessian_dev.csv", &edges, |p| source.jet(p).expect("no edge"));
}

#[test]
fn cylinder_pair_matches_the_reference() {
    let source = pair();
    let edges = [(22.5e-3, 5.0e-3), (22.5e-3, 35.0e-3)];
    compare_fields("cylinder_pair_field_dev.csv", &edges, |p| source.jet(p).expect("no edge"));
    compare_hessians("cylinder_pair_hessian_dev.csv", &edges, |p| source.jet(p).expect("no edge"));
}

#[test]
fn the_shorter_answers_are_the_same() {
    let (source, two) = (ring(), pair());
    let rows: Vec<Row<12>> = table("ring_field_dev.csv");
    for Row { point, .. } in &rows {
        let jet = source.jet(point).expect("no edge");
        assert_eq!(source.field(point), Ok(jet.field), "{point:?}");
        assert_eq!(source.field_gradient(point), Ok((jet.field, jet.gradient)), "{point:?}");
        let far = point * 20.0;
        let jet = two.jet(&far).expect("no edge");
        assert_eq!(two.field(&far), Ok(jet.field), "{far:?}");
        assert_eq!(two.field_gradient(&far), Ok((jet.field, jet.gradient)), "{far:?}");
    }
}

#[test]
fn an_assembly_of_one_is_its_cylinder_moved_along_the_axis() {
    let magnet = AxialMagnet { offset: 7.0e-3, ..cylinder() };
    let assembly = Source::from(Cylinders::new(vec![magnet]).expect("allowed"));
    let source = AxialSource::new(magnet.inner_radius, magnet.radius, magnet.length, magnet.remanence)
        .expect("allowed");
    let point = Vector3::new(20e-3, -5e-3, 40e-3);
    assert_eq!(assembly.jet(&point), source.jet(&(point - Vector3::new(0.0, 0.0, 7.0e-3))));
}

fn compare_fields(file: &str, edges: &[(f64, f64)], jet: impl Fn(&Vector3<f64>) -> Jet) {
    let rows: Vec<Row<12>> = table(file);
    for Row { point, values } in &rows {
        let Jet { field, gradient, .. } = jet(point);
        assert_close(("B", point), field.as_slice(), &values[..3], FIELD);
        let by_rows = gradient.transpose();
        if values[3..].iter().all(|&entry| entry == 0.0) {
            assert!(gradient.norm() <= ZERO_GRADIENT, "{point:?}: {gradient}");
        } else {
            assert_close(("G", point), by_rows.as_slice(), &values[3..], tolerance(point, edges));
        }
    }
}

fn compare_hessians(file: &str, edges: &[(f64, f64)], jet: impl Fn(&Vector3<f64>) -> Jet) {
    let rows: Vec<Row<10>> = table(file);
    for Row { point, values } in &rows {
        let hessian = jet(point).hessian;
        assert_close(("H", point), &hessian.0, values, tolerance(point, edges));
    }
}

/// The edges are circles of a radius at the heights `+-z`.
fn tolerance(point: &Vector3<f64>, edges: &[(f64, f64)]) -> f64 {
    let rho = point.x.hypot(point.y);
    let near = edges.iter().any(|&(radius, z)| (rho - radius).hypot(point.z.abs() - z) < NEAR_EDGE);
    if near { DERIVATIVES_NEAR_EDGE } else { DERIVATIVES }
}
