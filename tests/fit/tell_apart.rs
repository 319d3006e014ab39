//! What rows cannot tell apart, and which further rows would.

use super::{ONE, fitted, measure, scene, table};

/// The magnetisation of the helix is their product.
const PAIR: [&str; 2] = ["design.ring.remanence_t", "design.helix.particle_remanence_t"];

#[test]
fn a_pair_that_acts_alike_is_named() {
    // Without rings nor interaction, the moment of a plain rod is to its modulus as the angle says.
    let file = scene(
        "[design]\nkind = \"cylinder\"\nlength_mm = 20\nradius_mm = 1\nelastic_modulus_mpa = 1\npoisson = 0.45\nremanence_t = 0.1\n\
         density_kg_m3 = 2000\n[field]\n[model]\ninteraction = \"none\"",
    );
    let keys = ["design.elastic_modulus_mpa", "design.remanence_t"];
    let rows: Vec<Vec<f64>> = (1..=5)
        .map(|step| measure(&file, &[], &[("field.uniform_mt[2]", 2.0 * f64::from(step))], &["alpha_deg"]))
        .collect();
    let measured = table(&file, &["field.uniform_mt[2]", "alpha_deg"], &rows);
    let measured = measured.with_deviation("alpha_deg", 0.1).unwrap();
    let fit = fitted(&file, &keys, &measured);
    println!("{:?}\n{:?}\n{:?}", fit.parameters, fit.directions, fit.experiments);
    assert_eq!(fit.directions.len(), 1);
    let words = fit.directions[0].words();
    assert_eq!(words, format!("`{}` and `{}` cannot be distinguished by these rows", keys[0], keys[1]));
    assert!(fit.parameters.iter().all(|parameter| parameter.deviation.is_none()));
    // Twice the modulus with twice the remanence is the same device in a field.
    let changes = &fit.directions[0].changes;
    assert!((changes[0] / changes[1] - 1.0).abs() < 1e-3, "{changes:?}");
    // Weight or a force tell the modulus alone, another field does not.
    let best = &fit.experiments[0];
    assert!(best.key.starts_with("gravity") || best.key.starts_with("load"), "{best:?}");
    assert!(
        !fit.experiments.iter().any(|each| each.key.starts_with("field.uniform")),
        "{:?}",
        fit.experiments
    );
    assert!(fit.scene().unwrap().uncertainty().unwrap().keys.is_empty());
    // With such rows they are told apart indeed.
    let titles = ["field.uniform_mt[2]", &best.key, "alpha_deg"];
    let rows: Vec<Vec<f64>> = (1..=5)
        .flat_map(|step| [0.0, best.value].map(|value| (2.0 * f64::from(step), value)))
        .map(|(field, value)| measure(&file, &[], &[(titles[0], field), (titles[1], value)], &["alpha_deg"]))
        .collect();
    let measured = table(&file, &titles, &rows).with_deviation("alpha_deg", 0.1).unwrap();
    let fit = fitted(&file, &keys, &measured);
    println!("{:?} {:?}", fit.parameters, fit.directions);
    assert!(fit.parameters.iter().all(|parameter| parameter.deviation.is_some()), "{:?}", fit.directions);
}

#[test]
fn a_parameter_without_effect_is_named() {
    let file = scene(ONE);
    let rows: Vec<Vec<f64>> = [5.0, 10.0]
        .map(|field| measure(&file, &[], &[("field.uniform_mt[2]", field)], &["alpha_deg"]))
        .to_vec();
    let measured = table(&file, &["field.uniform_mt[2]", "alpha_deg"], &rows);
    let measured = measured.with_deviation("alpha_deg", 0.1).unwrap();
    let fit = fitted(&file, &["design.helix.shore_a", "design.ring.density_kg_m3"], &measured);
    println!("{:?}\n{:?}\n{:?}", fit.parameters, fit.directions, fit.experiments);
    assert_eq!(fit.directions.len(), 1);
    assert_eq!(fit.directions[0].keys, ["design.ring.density_kg_m3"]);
    assert!(fit.parameters[0].deviation.is_some() && fit.parameters[1].deviation.is_none());
    assert!(
        fit.experiments.iter().all(|each| each.key.starts_with("gravity")) && !fit.experiments.is_empty()
    );
    // The scene says of the one that is known how well it is.
    assert_eq!(fit.scene().unwrap().uncertainty().unwrap().keys, ["design.helix.shore_a"]);
}

#[test]
fn parameters_that_differ_are_not_named() {
    let file = scene(ONE);
    let rows: Vec<Vec<f64>> = [5.0, 10.0, 15.0, 20.0]
        .map(|field| {
            measure(&file, &[], &[("field.uniform_mt[2]", field)], &["alpha_deg", "magnetic_torque_x_nm"])
        })
        .to_vec();
    let measured = table(&file, &["field.uniform_mt[2]", "alpha_deg", "magnetic_torque_x_nm"], &rows);
    let measured = measured.with_deviation("alpha_deg", 0.1).unwrap();
    let measured = measured.with_deviation("magnetic_torque_x_nm", 1e-6).unwrap();
    let fit = fitted(&file, &["design.helix.shore_a", PAIR[0]], &measured);
    assert!(fit.directions.is_empty() && fit.experiments.is_empty(), "{:?}", fit.directions);
}
