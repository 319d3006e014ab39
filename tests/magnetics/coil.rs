//! Coils without iron.

use mcm::magnetics::{Coil, Jet, MultipoleCoil, MultipoleTable, Solenoid, Source};
use nalgebra::{Matrix3, Vector3};
use proptest::prelude::*;

/// The coil of `coil.csv`, which `tests/bench/coil_field.py` computed with mpmath.
const COIL: Coil = Coil { inner_radius: 20e-3, outer_radius: 40e-3, length: 60e-3, turns: 600.0 };

fn reference() -> Vec<[f64; 4]> {
    let path = concat!(env!("CARGO_MANIFEST_DIR"), "/tests/magnetics/coil.csv");
    let rows = csv::Reader::from_path(path).unwrap().into_deserialize();
    rows.map(|row| row.unwrap()).collect()
}

fn coil() -> Source {
    Solenoid::new(COIL).unwrap().into()
}

#[test]
fn its_field_is_that_of_its_current_loops() {
    let (coil, mut worst, mut near) = (coil(), 0.0_f64, 0.0_f64);
    let rows = reference();
    assert_eq!(rows.len(), 18);
    for [rho, z, across, along] in rows {
        let turn = Vector3::new(0.6, 0.8, 0.0);
        let point = turn * rho + Vector3::z() * z;
        let expected = turn * across + Vector3::z() * along;
        let error = (coil.field(&point).unwrap() - expected).norm() / expected.norm();
        // A quarter of half the winding's thickness is 2.5 mm: nearer points follow below.
        let is_near = coil.distance(&point) < 2.4e-3;
        println!("{rho} {z}: {error:.1e}");
        if is_near { near = near.max(error) } else { worst = worst.max(error) }
    }
    assert!(worst < 1e-9, "{worst:e}");
    assert!(near == 0.0, "the table has no nearer point");
}

#[test]
fn on_its_axis_the_field_is_the_closed_form() {
    let (coil, half) = (coil(), 0.5 * COIL.length);
    let density = COIL.turns / ((COIL.outer_radius - COIL.inner_radius) * COIL.length);
    let end = |u: f64| {
        let reach = |r: f64| r + r.hypot(u);
        u * (reach(COIL.outer_radius) / reach(COIL.inner_radius)).ln()
    };
    for z in [0.0, 0.01, 0.03, 0.05, 0.1, 0.3] {
        let expected = 2e-7 * core::f64::consts::PI * density * (end(z + half) - end(z - half));
        let got = coil.field(&Vector3::new(0.0, 0.0, z)).unwrap();
        assert!((got.z / expected - 1.0).abs() < 1e-10 && got.x == 0.0, "{z}: {got} {expected}");
    }
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 400, failure_persistence: None, ..ProptestConfig::default() })]

    /// The inner and the outer half of a winding, each with half its turns, make its field.
    #[test]
    fn two_halves_make_a_coil(
        inner in 0.05..20.0_f64, length in 0.2..40.0_f64, away in 0.25..60.0_f64, place in 0.0..1.0_f64
    ) {
        // In halves of the thickness.
        let unit = 5e-3;
        let coil = |from: f64, to: f64, turns| Source::from(Solenoid::new(Coil {
            inner_radius: unit * from, outer_radius: unit * to, length: unit * length, turns,
        }).unwrap());
        let whole = coil(inner, inner + 2.0, 200.0);
        let halves = [coil(inner, inner + 1.0, 100.0), coil(inner + 1.0, inner + 2.0, 100.0)];
        // Beside the winding, over its end, or off its corner.
        let (rho, z) = if place < 0.4 {
            (inner + 2.0 + away, place * length)
        } else if place < 0.8 {
            (inner + 5.0 * (place - 0.4), 0.5 * length + away)
        } else {
            (inner + 2.0 + 0.7072 * away, 0.5 * length + 0.7072 * away)
        };
        let point = Vector3::new(unit * rho, 0.0, unit * z);
        let expected: Vector3<f64> = halves.iter().map(|half| half.field(&point).unwrap()).sum();
        let error = (whole.field(&point).unwrap() - expected).norm() / expected.norm();
        prop_assert!(error < 1e-9, "{:e} at {}, {} away", error, point, away);
    }
}

#[test]
fn its_derivatives_are_those_of_its_field_and_it_has_neither_curl_nor_divergence() {
    let coil = coil();
    for point in [[0.01, 0.004, 0.02], [0.03, -0.01, 0.05], [0.06, 0.03, 0.0], [0.2, 0.1, 0.4]] {
        let (point, step) = (Vector3::from(point), 1e-4);
        let Jet { field, gradient, hessian: _ } = coil.jet(&point).unwrap();
        let at = |axis: usize, by: f64| coil.field(&(point + Vector3::ith(axis, by))).unwrap();
        let slope = |axis: usize| {
            let difference = |h: f64| (at(axis, h) - at(axis, -h)) / (2.0 * h);
            (difference(step) * 4.0 - difference(2.0 * step)) / 3.0
        };
        let expected = Matrix3::from_columns(&[slope(0), slope(1), slope(2)]);
        let size = gradient.norm();
        assert!((gradient - expected).norm() < 1e-6 * size, "{point}");
        assert!(
            (gradient - gradient.transpose()).norm() < 1e-9 * size && gradient.trace().abs() < 1e-9 * size
        );
        assert!((coil.field(&point).unwrap() - field).norm() < 1e-12 * field.norm());
    }
}

#[test]
fn its_bore_is_free_and_its_winding_is_not() {
    let coil = coil();
    for (rho, inside) in [(0.0, false), (0.0199, false), (0.0201, true), (0.0399, true), (0.0401, false)] {
        assert_eq!(coil.contains(&Vector3::new(rho, 0.0, 0.0)), inside, "{rho}");
    }
    assert!((coil.distance(&Vector3::new(0.0, 0.015, 0.0)) - 0.005).abs() < 1e-15);
    // N I pi (b^2 + a b + a^2) / 3
    let moment = 600.0 * core::f64::consts::PI * (1600.0 + 800.0 + 400.0) * 1e-6 / 3.0;
    assert!((coil.moment().z / moment - 1.0).abs() < 1e-13, "{}", coil.moment().z);
}

#[test]
fn bad_dimensions_are_named() {
    let refused = |coil: Coil| Solenoid::new(coil).unwrap_err().to_string();
    assert!(refused(Coil { inner_radius: 0.05, ..COIL }).contains("coil inner radius (m) = 0.05"));
    assert!(refused(Coil { inner_radius: 0.0, ..COIL }).contains("coil inner radius (m) = 0"));
    assert!(refused(Coil { turns: 0.0, ..COIL }).contains("coil turns = 0"));
    assert!(refused(Coil { length: f64::NAN, ..COIL }).contains("coil length (m)"));
}

/// A coil with a core whose field is that of a dipole on its axis, off its centre: multipoles of all degrees.
fn with_dipole_at(height: f64) -> Source {
    // On the axis 2 c / (r - h)^3 = 2 c sum (l + 1) l / 2 h^(l - 1) / r^(l + 2), with c = 1e-6 T m3 / A.
    let coefficients = (1..=17).map(|l: i32| 1e-6 * f64::from(l * (l + 1)) * height.powi(l - 1));
    let table = MultipoleTable::new(0.05, &coefficients.collect::<Vec<_>>()).unwrap();
    MultipoleCoil::new(COIL, table).unwrap().into()
}

#[test]
fn multipoles_of_a_core_are_those_of_a_dipole_off_centre() {
    let height = 0.01;
    let coil = with_dipole_at(height);
    let dipole = |point: &Vector3<f64>| {
        let r = point - Vector3::z() * height;
        1e-6 * (3.0 * r * r.z / r.norm().powi(5) - Vector3::z() / r.norm().powi(3))
    };
    for point in [[0.0, 0.0, 0.12], [0.0, 0.0, -0.12], [0.09, -0.05, 0.07], [0.13, 0.02, -0.03]] {
        let point = Vector3::from(point);
        let expected = dipole(&point);
        let Jet { field, gradient, .. } = coil.jet(&point).unwrap();
        assert!((field - expected).norm() < 1e-13 * expected.norm(), "{point} {field} {expected}");
        let mut several = [Default::default(); 3];
        coil.gradients(&[point; 3], &mut several).unwrap();
        assert_eq!(
            (several[2], coil.field_gradient(&point).unwrap()),
            ((field, gradient), (field, gradient))
        );
        let step = 1e-5;
        for axis in 0..3 {
            let moved = |by: f64| {
                let mut moved = point;
                moved[axis] += by;
                moved
            };
            let slope = (dipole(&moved(step)) - dipole(&moved(-step))) / (2.0 * step);
            let error = (gradient.column(axis) - slope).norm();
            assert!(error < 1e-6 * gradient.norm(), "{axis}: {error:e}");
            let sides = [step, -step].map(|by| coil.field_gradient(&moved(by)).unwrap().1);
            let second = (sides[0] - sides[1]) / (2.0 * step);
            let of = coil.jet(&point).unwrap();
            let along = |i: usize| of.hessian_along(&Vector3::ith(i, 1.0)).column(axis).into_owned();
            for i in 0..3 {
                let error = (along(i) - second.row(i).transpose()).norm();
                assert!(error < 1e-6 * second.norm(), "{axis} {i}: {error:e}");
            }
        }
    }
    // The dipole's moment is 4 pi c / mu_0 = 1e7 c.
    assert!((coil.moment().z / 10.0 - 1.0).abs() < 1e-9, "{}", coil.moment().z);
}

#[test]
fn where_multipoles_say_nothing_there_is_no_field() {
    let coil = with_dipole_at(0.0);
    let inside = Vector3::new(0.0, 0.03, 0.03);
    assert!(coil.contains(&inside) && coil.distance(&inside) == 0.0);
    let said = coil.field(&inside).unwrap_err().to_string();
    assert!(
        said.contains("distance from the centre of a coil with iron") && said.contains(">= 0.05"),
        "{said}"
    );
    assert!((coil.distance(&Vector3::new(0.0, 0.08, 0.0)) - 0.03).abs() < 1e-15);
    assert!(MultipoleTable::new(0.05, &[1e-7; 18]).unwrap_err().to_string().contains("at most 17"));
    assert!(MultipoleTable::new(0.0, &[1e-7]).unwrap_err().to_string().contains("coil reach (m) = 0"));
    assert!(MultipoleTable::new(0.05, &[f64::NAN]).is_err() && MultipoleTable::new(0.05, &[0.0; 3]).is_err());
}

/// Solenoids side by side are the sum of the same, one by one.
#[test]
fn edges_side_by_side_are_those_one_by_one() {
    let coil = coil();
    // In the bore, beside the winding, close to its corner, where edges are evaluated one by one, and as far as multipoles serve.
    for point in [
        [0.0, 0.0, 0.0],
        [0.006, -0.009, 0.021],
        [0.0, 0.05, 0.01],
        [0.0405, 0.0, 0.0305],
        [0.06, 0.03, 0.05],
        [0.15, -0.1, 0.12],
        [0.3, 0.2, -0.5],
    ] {
        let (point, mut several) = (Vector3::from(point), [Default::default(); 8]);
        coil.gradients(&[point; 8], &mut several).unwrap();
        let (field, gradient) = several[7];
        let found = coil.field_gradient(&point).unwrap();
        assert!((found.0 - field).norm() < 1e-11 * field.norm(), "{point} {field} {}", found.0);
        assert!((found.1 - gradient).norm() < 1e-10 * gradient.norm().max(field.norm()), "{point}");
    }
}
