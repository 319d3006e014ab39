//! The tabulated field of a ring, against the exact one.

use mcm::magnetics::{AxialSource, FieldTable};
use nalgebra::Vector3;

use crate::tolerance::TABLE_MEAN;

/// Points along each direction.
const STEPS: u32 = 150;

#[test]
fn the_table_is_as_exact_as_it_says() {
    for [inner, outer, length] in
        [[0.75e-3, 2e-3, 1e-3], [0.0, 2e-3, 1e-3], [1.5e-3, 2e-3, 3e-3], [0.2, 2.0, 0.5]]
    {
        let ring = AxialSource::new(inner, outer, length, -1.35).unwrap();
        let table = FieldTable::new(&ring);
        let (mut points, mut squares, mut worst) = (0_u32, 0.0, 0.0_f64);
        for i in 0..STEPS * STEPS {
            // 0.3 to 10 outer radii from the face, up to 6 from the axis, all around it, before and behind.
            let part = |k: u32| (f64::from(k) + 0.5) / f64::from(STEPS);
            let distance = 0.3 * (5.0 * part(i / STEPS)).exp2();
            let (rho, azimuth) = (6.0 * part(i % STEPS), 0.7 * f64::from(i));
            let z = (0.5 * length / outer + distance) * if i % 2 == 0 { 1.0 } else { -1.0 };
            let point = Vector3::new(rho * azimuth.cos(), rho * azimuth.sin(), z) * outer;
            let Some((field, gradient)) = table.field_gradient(&point) else { continue };
            let exact = ring.field_gradient(&point).unwrap();
            let apart = (field - exact.0).norm() / exact.0.norm();
            let error = apart.max((gradient - exact.1).norm() / exact.1.norm());
            assert!(error <= FieldTable::ERROR, "{error:e} at {point:?}");
            (points, squares, worst) = (points + 1, squares + error * error, worst.max(error));
        }
        let mean = (squares / f64::from(points)).sqrt();
        println!(
            "{inner}, {outer}, {length}: {points} points, error {worst:.1e} at most, {mean:.1e} in the mean"
        );
        assert!(points > STEPS * STEPS / 3, "only {points} points are in the table");
        assert!(mean <= TABLE_MEAN, "{mean:e}");
    }
}

#[test]
fn beside_the_ring_and_far_away_nothing_is_tabulated() {
    let table = FieldTable::new(&AxialSource::new(0.75e-3, 2e-3, 1e-3, 1.35).unwrap());
    for point in
        [[3e-3, 0.0, 0.0], [0.0, 0.0, 0.9e-3], [8e-3, 0.0, 2e-3], [0.0, 0.0, 1.0], [f64::NAN, 0.0, 2e-3]]
    {
        assert!(table.field_gradient(&Vector3::from(point)).is_none(), "{point:?}");
    }
}
