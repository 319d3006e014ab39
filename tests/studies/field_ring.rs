//! Fig. 3E: field of a ring.

use mcm::studies::field_ring;

use super::column;
use crate::tolerance::{COARSE_DIFFERENCE, FIELD, assert_close};

/// Field of a solenoid of radius `a` on its axis over its remanence (mm).
fn solenoid(z: f64, a: f64) -> f64 {
    let end = |u: f64| u / u.hypot(a);
    0.5 * (end(z + 0.5) - end(z - 0.5))
}

#[test]
fn on_the_axis_it_is_the_closed_form() {
    let study = field_ring().unwrap();
    let mut seen = 0;
    for (z, field) in column(&study, "z_mm").iter().zip(column(&study, "axis_bz_exact_mt")) {
        if field.is_nan() {
            continue;
        }
        seen += 1;
        assert_close(z, &[*field], &[1350.0 * (solenoid(*z, 2.0) - solenoid(*z, 0.75))], FIELD);
    }
    assert_eq!(seen, 21);
}

#[test]
fn the_window_is_symmetric_and_its_gradients_are_its_slopes() {
    let study = field_ring().unwrap();
    let (y, size) = (column(&study, "y_mm"), column(&study, "b_mt"));
    let rows = y.len() / 21;
    assert_eq!((rows, y[0], y[y.len() - 1]), (61, -3.0, 3.0));
    let block = |values: &[f64], row: usize| values[21 * row..21 * (row + 1)].to_vec();
    for i in 0..rows {
        assert_close(("y", y[21 * i]), &block(size, i), &block(size, rows - 1 - i), FIELD);
        for (field, slope) in [("bz_mt", "dbz_dz_t_per_m"), ("by_mt", "dby_dz_t_per_m")] {
            let (field, slope) = (block(column(&study, field), i), block(column(&study, slope), i));
            let differences: Vec<f64> = field.windows(3).map(|v| (v[2] - v[0]) / 0.2).collect();
            if y[21 * i] != 0.0 || slope[0] != 0.0 {
                assert_close(("slope at y", y[21 * i]), &differences, &slope[1..20], COARSE_DIFFERENCE);
            }
        }
    }
}

#[test]
fn the_fits_are_as_far_off_as_stated() {
    let study = field_ring().unwrap();
    let exact = column(&study, "axis_bz_exact_mt");
    for (name, least, most) in [("7a", 0.04, 0.07), ("8", 0.0, 0.01)] {
        let errors: Vec<f64> = column(&study, &format!("axis_bz_fit_{name}_mt"))
            .iter()
            .zip(exact)
            .filter(|(fit, _)| !fit.is_nan())
            .map(|(fit, exact)| fit / exact - 1.0)
            .collect();
        assert_eq!(errors.len(), 5);
        assert!(errors.iter().all(|error| (least..most).contains(error)), "{name}: {errors:?}");
    }
}
