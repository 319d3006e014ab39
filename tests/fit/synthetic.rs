//! Measurements that a device of known parameters would give.

use mcm::fit::{Fit, Loss, Settings};

use super::{ONE, fitted, measure, scene, table};

/// Largest relative error of a parameter fitted to exact values.
const EXACT: f64 = 1e-6;

fn assert_found(fit: &Fit, truth: &[(&str, f64)]) {
    for (parameter, (key, value)) in fit.parameters.iter().zip(truth) {
        assert_eq!(parameter.key, *key);
        let error = (parameter.value / value - 1.0).abs();
        assert!(error < EXACT, "{key}: {} instead of {value}, {:?}", parameter.value, fit.steps);
    }
    assert!(fit.converged);
}

#[test]
fn exact_values_give_the_parameters_back() {
    let file = scene(ONE);
    let truth = [("design.helix.shore_a", 29.0), ("design.ring.remanence_t", 1.21)];
    let names = ["alpha_deg", "magnetic_torque_x_nm"];
    let rows: Vec<Vec<f64>> = (1..=6)
        .map(|step| measure(&file, &truth, &[("field.uniform_mt[2]", 3.0 * f64::from(step))], &names))
        .collect();
    let measured = table(&file, &["field.uniform_mt[2]", "alpha_deg", "magnetic_torque_x_nm"], &rows);
    let measured = measured.with_deviation("alpha_deg", 0.1).unwrap();
    let measured = measured.with_deviation("magnetic_torque_x_nm", 1e-6).unwrap();
    let keys = truth.map(|(key, _)| key);
    assert_found(&fitted(&file, &keys, &measured), &truth);
}

#[test]
fn rows_may_move_a_magnet_near_one_whose_place_is_fitted() {
    // The rows turn the magnet whose position is fitted: each row is a scene of its own.
    let file = scene(
        "[design]\nsegments = 2\n[magnet]\nposition_mm = [0, -110, 5]\n[model]\ninteraction = \"rings\"",
    );
    let truth = [("magnet.position_mm[2]", -108.5), ("design.helix.shore_a", 35.0)];
    let names = ["tip_x_mm", "tip_y_mm", "tip_z_mm"];
    let turns = [20.0, 40.0, 60.0, 80.0];
    let rows: Vec<Vec<f64>> =
        turns.iter().map(|turn| measure(&file, &truth, &[("magnet.turn_deg", *turn)], &names)).collect();
    let measured = table(&file, &["magnet.turn_deg", "tip_x_mm", "tip_y_mm", "tip_z_mm"], &rows);
    assert_found(&fitted(&file, &truth.map(|(key, _)| key), &measured), &truth);
}

#[test]
fn rows_may_move_further_magnets_and_drive_coils() {
    let sources = "[design]\nsegments = 2\n[model]\ninteraction = \"rings\"\n\
                   [[magnet]]\nposition_mm = [0, -120, 5]\n[[magnet]]\nposition_mm = [150, 0, 5]\n\
                   [[coil]]\nposition_mm = [0, 90, 5]\norientation_wxyz = [0.7071067811865476, 0.7071067811865476, 0, 0]\n\
                   inner_radius_mm = 20\nouter_radius_mm = 40\nlength_mm = 60\nturns = 600\ncurrent_a = 0";
    let file = scene(sources);
    let truth = [("design.helix.shore_a", 35.0)];
    for (key, values) in [
        ("magnet[2].position_mm[1]", [150.0, 120.0, 130.0, 150.0]),
        ("coil[1].current_a", [0.0, 5.0, -5.0, 0.0]),
    ] {
        // What the rows move stands in the first and the last of them where the scene has it.
        let rows: Vec<Vec<f64>> = values
            .iter()
            .map(|value| measure(&file, &truth, &[(key, *value)], &["tip_x_mm", "tip_y_mm"]))
            .collect();
        assert!(
            (rows[1][1] - rows[0][1]).abs() + (rows[1][2] - rows[0][2]).abs() > 1e-3,
            "{key} moves the tip"
        );
        let measured = table(&file, &[key, "tip_x_mm", "tip_y_mm"], &rows);
        assert_found(&fitted(&file, &truth.map(|(key, _)| key), &measured), &truth);
    }
}

#[test]
fn columns_by_the_names_of_the_fmu_are_those_of_the_scene() {
    let file = scene(ONE);
    let truth = [("design.helix.shore_a", 36.0)];
    let rows: Vec<Vec<f64>> = [4.0, 8.0, 12.0]
        .iter()
        .map(|field| measure(&file, &truth, &[("field.uniform_mt[2]", *field)], &["tip_y_mm"]))
        .collect();
    let host: Vec<Vec<f64>> = rows.iter().map(|row| vec![1e-3 * row[0], row[1]]).collect();
    let [by_key, by_name] =
        [("field.uniform_mt[2]", &rows), ("field.uniform[2]", &host)].map(|(title, rows)| {
            fitted(&file, &["design.helix.shore_a"], &table(&file, &[title, "tip_y_mm"], rows)).parameters[0]
                .value
        });
    assert!((by_key - by_name).abs() < 1e-7 && (by_key - 36.0).abs() < 1e-5, "{by_key} {by_name}");
}

#[test]
fn outliers_hardly_move_a_robust_fit() {
    let file = scene(ONE);
    let truth = [("design.helix.shore_a", 30.0)];
    let mut rows: Vec<Vec<f64>> = (1..=20)
        .map(|step| measure(&file, &truth, &[("field.uniform_mt[2]", f64::from(step))], &["alpha_deg"]))
        .collect();
    for (number, row) in rows.iter_mut().enumerate() {
        // Errors without a mean, and three readings that are wrong.
        row[1] += 0.05 * if number % 2 == 0 { 1.0 } else { -1.0 };
        if number % 7 == 3 {
            row[1] += 15.0;
        }
    }
    let measured = table(&file, &["field.uniform_mt[2]", "alpha_deg"], &rows);
    let error = |loss| {
        let settings = Settings { loss, ..Settings::default() };
        let fit = Fit::new(&file, &["design.helix.shore_a"], &measured, &settings).unwrap();
        let light = fit.cells.iter().filter(|cell| cell.weight < 0.1).count();
        (fit.parameters[0].value - 30.0, light, fit.parameters[0].deviation.unwrap())
    };
    let (squares, robust) = (error(Loss::Squares), error(Loss::Huber));
    println!("squares {squares:?}, robust {robust:?}");
    assert!(squares.0.abs() > 1.0 && robust.0.abs() < 0.1, "{squares:?} {robust:?}");
    assert_eq!((squares.1, robust.1), (0, 3));
    assert!(robust.2 < 0.1 * squares.2);
}

#[test]
fn parameters_stay_in_their_ranges() {
    let file = scene(ONE);
    // Magnets that are stronger than those of the scene: its permeability, 1 at least, can only weaken them.
    let strong = [("design.ring.remanence_t", 1.5)];
    let rows: Vec<Vec<f64>> = [5.0, 10.0]
        .map(|field| measure(&file, &strong, &[("field.uniform_mt[2]", field)], &["alpha_deg"]))
        .to_vec();
    let measured = table(&file, &["field.uniform_mt[2]", "alpha_deg"], &rows);
    let key = "design.ring.recoil_permeability";
    for start in [1.0, 1.05] {
        let fit = fitted(&file.with(key, start).unwrap(), &[key], &measured);
        let parameter = &fit.parameters[0];
        println!("{parameter:?}");
        assert!((1.0..1.0001).contains(&parameter.value) && parameter.at_limit, "{parameter:?}");
        assert_eq!(parameter.deviation, None);
    }
}
