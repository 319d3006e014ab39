//! The deviations come from the derivatives of the residuals, and these meet differences of whole fits' outputs.

use super::{ONE, fitted, measure, scene, table};

#[test]
fn covariance_is_that_of_differences() {
    let file = scene(ONE);
    let truth = [("design.helix.shore_a", 33.0), ("design.helix.length_mm", 4.0)];
    let names = ["tip_y_mm", "tip_z_mm"];
    let fields = [4.0, 9.0, 14.0];
    let rows: Vec<Vec<f64>> = fields
        .iter()
        .map(|field| measure(&file, &truth, &[("field.uniform_mt[2]", *field)], &names))
        .collect();
    let measured = table(&file, &["field.uniform_mt[2]", "tip_y_mm", "tip_z_mm"], &rows);
    let measured = measured.with_deviation("tip_y_mm", 0.1).unwrap().with_deviation("tip_z_mm", 0.2).unwrap();
    let fit = fitted(&file, &truth.map(|(key, _)| key), &measured);
    // The same by central differences of whole solves.
    let mut normal = nalgebra::Matrix2::zeros();
    for field in fields {
        for (output, deviation) in [(1, 0.1), (2, 0.2)] {
            let slope = |index: usize| {
                let step = [0.05, 0.002][index];
                let side = |sign: f64| {
                    let mut moved = truth;
                    moved[index].1 += sign * step;
                    measure(&file, &moved, &[("field.uniform_mt[2]", field)], &names)[output]
                };
                (side(1.0) - side(-1.0)) / (2.0 * step * deviation)
            };
            let row = nalgebra::Vector2::new(slope(0), slope(1));
            normal += row * row.transpose();
        }
    }
    let covariance = normal.try_inverse().unwrap();
    for (index, parameter) in fit.parameters.iter().enumerate() {
        let (own, by_differences) = (parameter.deviation.unwrap(), covariance[(index, index)].sqrt());
        assert!((own / by_differences - 1.0).abs() < 1e-4, "{}: {own}, not {by_differences}", parameter.key);
    }
    let coupled = covariance[(0, 1)] / (covariance[(0, 0)] * covariance[(1, 1)]).sqrt();
    assert!((fit.correlation[(0, 1)] - coupled).abs() < 1e-4, "{} {coupled}", fit.correlation[(0, 1)]);
}
