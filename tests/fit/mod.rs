//! Parameters from measured rows.

use mcm::fit::{Data, Fit, Loss, Measured, Options, Quantity};
use mcm::manipulator::SceneFile;
use rand::{RngExt, SeedableRng, rngs::StdRng};

const KEYS: [&str; 2] = ["design.helix.shore_a", "design.ring.remanence_t"];
const TRUE: [f64; 2] = [35.5, 1.29];

/// One segment at this level in a uniform field, with these numbers at [`KEYS`].
fn scene(level: &str, [hardness, remanence]: [f64; 2]) -> SceneFile {
    let text = format!(
        "[design]\nsegments = 1\n[design.helix]\nshore_a = {hardness}\n[design.ring]\nremanence_t = {remanence}\n\
         [field]\n[model]\ninteraction = \"{level}\"\n"
    );
    SceneFile::parse(&text, "fit").unwrap()
}

/// Inputs of the rows: a field, and a force across the tip, which tells stiffness and magnetisation apart.
const INPUTS: [&str; 2] = ["field.uniform_mt[2]", "load.tip_force_n[2]"];

/// Rows of tip angle and position in fields up to 15 mT, every second one with a force of 20 mN, as the true device gives them, with noise
/// of these deviations (deg, mm).
fn rows(level: &str, count: usize, noise: [f64; 2], given: bool, random: &mut StdRng) -> Data {
    let names = ["alpha_deg", "tip_y_mm", "tip_z_mm"];
    let truth = scene(level, TRUE);
    let mut data = Data::new(&scene(level, [33.0, 1.35]), &INPUTS).unwrap();
    let mut device = truth.scene().unwrap().manipulator(2).unwrap();
    for number in 0..count {
        let field = 15.0 * (number + 1) as f64 / count as f64;
        let force = if number % 2 == 0 { 0.0 } else { 20e-3 };
        let loaded = truth.with(INPUTS[0], field).unwrap().with(INPUTS[1], force).unwrap();
        let outputs = device.solve(&loaded.scene().unwrap().inputs).unwrap().clone();
        let measured = names.map(|name| {
            let quantity = Quantity::named(name).unwrap();
            let deviation = noise[usize::from(name != "alpha_deg")];
            let value = quantity.read(&outputs) + deviation * normal(random);
            Measured { quantity, value, deviation: given.then_some(deviation) }
        });
        data.add(&[field, force], &measured).unwrap();
    }
    data
}

/// A normal deviate, by the sum of twelve uniform ones.
fn normal(random: &mut StdRng) -> f64 {
    (0..12).map(|_| random.random::<f64>()).sum::<f64>() - 6.0
}

fn source(seed: u64) -> StdRng {
    StdRng::seed_from_u64(seed)
}

fn quick() -> Options {
    Options { profiles: false, ..Options::default() }
}

#[test]
fn without_noise_the_parameters_come_back() {
    for level in ["none", "rings", "full"] {
        let data = rows(level, 10, [0.0; 2], false, &mut source(1));
        let fit = Fit::new(&scene(level, [33.0, 1.35]), &KEYS, &data, quick()).unwrap();
        for (value, wanted) in fit.values().iter().zip(TRUE) {
            assert!((value / wanted - 1.0).abs() < 1e-6, "{level}: {value} instead of {wanted}");
        }
        println!("{level}: {:?}, {} steps", fit.values(), fit.steps());
        assert!(fit.untold().is_empty());
    }
}

#[test]
fn deviations_are_those_of_many_noisy_fits_and_intervals_cover() {
    for given in [true, false] {
        let (count, mut random) = (50, source(3));
        let (mut covered, mut squares) = ([0.0; 2], [0.0; 2]);
        for _ in 0..count {
            let data = rows("none", 12, [0.3, 0.06], given, &mut random);
            let fit = Fit::new(&scene("none", [33.0, 1.35]), &KEYS, &data, Options::default()).unwrap();
            for index in 0..2 {
                let [low, high] = fit.intervals()[index].unwrap();
                covered[index] += f64::from(u8::from((low..=high).contains(&TRUE[index])));
                squares[index] += ((fit.values()[index] - TRUE[index]) / fit.deviations()[index]).powi(2);
            }
        }
        for index in 0..2 {
            // Three deviations of the binomial and of the chi-square distribution.
            let (part, spread) = (covered[index] / f64::from(count), squares[index] / f64::from(count));
            println!("given {given}: {}: {part} covered, chi square {spread}", KEYS[index]);
            assert!((0.85..=1.0).contains(&part), "{}: {part}", KEYS[index]);
            assert!((spread - 1.0).abs() < 0.6, "{}: {spread}", KEYS[index]);
        }
    }
}

#[test]
fn an_outlier_spoils_squares_and_not_hubers_loss() {
    let mut data = rows("none", 20, [0.1, 0.02], true, &mut source(4));
    let angle = Quantity::named("alpha_deg").unwrap();
    data.add(&[10.0, 0.0], &[Measured { quantity: angle, value: 60.0, deviation: Some(0.1) }]).unwrap();
    let apart = |loss| {
        let options = Options { loss, profiles: false };
        let fit = Fit::new(&scene("none", [33.0, 1.35]), &KEYS, &data, options).unwrap();
        (fit.values()[0] / TRUE[0] - 1.0).abs()
    };
    let plain = apart(Loss::Squares);
    let robust = apart(Loss::Huber);
    println!("{plain} {robust}");
    assert!(robust < 0.3 * plain, "{robust} beside {plain}");
}

#[test]
fn what_the_rows_cannot_tell_is_named_with_a_row_that_would() {
    // The angle of a magnetised rod in a field depends on the ratio of its magnetisation and its stiffness alone.
    let text = "[design]\nkind = \"cylinder\"\nlength_mm = 40.0\nradius_mm = 1.0\nelastic_modulus_mpa = 2.0\n\
                remanence_t = 0.2\n[field]\n[model]\ninteraction = \"none\"";
    let file = SceneFile::parse(text, "rod").unwrap();
    let keys = ["design.elastic_modulus_mpa", "design.remanence_t"];
    let quantity = Quantity::named("alpha_deg").unwrap();
    let angle = |value| Measured { quantity, value, deviation: Some(0.1) };
    let mut data = Data::new(&file, &INPUTS).unwrap();
    let mut device = file.scene().unwrap().manipulator(2).unwrap();
    let mut add = |data: &mut Data, field: f64, force: f64| {
        let loaded = file.with(INPUTS[0], field).unwrap().with(INPUTS[1], force).unwrap();
        let value = quantity.read(device.solve(&loaded.scene().unwrap().inputs).unwrap());
        data.add(&[field, force], &[angle(value)]).unwrap();
    };
    for field in [2.0, 4.0, 6.0] {
        add(&mut data, field, 0.0);
    }
    let one = Fit::new(&file, &keys[..1], &data, quick()).unwrap();
    assert!(one.untold().is_empty() && one.covariance().is_some());
    let fit = Fit::new(&file, &keys, &data, quick()).unwrap();
    let [untold] = fit.untold() else { panic!("{:?}", fit.untold()) };
    let said = untold.to_string();
    println!("{said}");
    assert!(said.starts_with("`design.elastic_modulus_mpa` and `design.remanence_t` cannot be told apart by these rows; add a row with"));
    assert!(said.contains("mN") || said.contains("gravity"), "{said}");
    assert!(fit.covariance().is_none() && fit.deviations().iter().all(|each| each.is_infinite()));
    assert!(fit.scene().uncertainty().unwrap().keys.is_empty());
    // With such a row they are told.
    add(&mut data, 2.0, 1e-3);
    let fit = Fit::new(&file, &keys, &data, quick()).unwrap();
    assert!(fit.untold().is_empty() && fit.covariance().is_some());
}

#[test]
fn the_fitted_scene_carries_its_uncertainty() {
    let data = rows("rings", 12, [0.2, 0.05], true, &mut source(5));
    let fit = Fit::new(&scene("rings", [33.0, 1.35]), &KEYS, &data, Options::default()).unwrap();
    let text = fit.scene().to_toml().unwrap();
    let file = SceneFile::parse(&text, "fitted").unwrap();
    for (index, key) in KEYS.iter().enumerate() {
        assert!((file.number(key).unwrap() / fit.values()[index] - 1.0).abs() < 1e-12);
    }
    let uncertainty = file.uncertainty().unwrap();
    assert_eq!(uncertainty.keys, KEYS);
    let covariance = fit.covariance().unwrap();
    assert!((uncertainty.covariance() - covariance).amax() < 1e-12 * covariance.amax());
    // In the middle of a nearly linear problem the profile is the ellipse.
    for (index, interval) in fit.intervals().iter().enumerate() {
        let [low, high] = interval.unwrap();
        let half = 1.96 * fit.deviations()[index];
        assert!((0.5 * (high - low) / half - 1.0).abs() < 0.05, "{low} {high} {half}");
    }
}

#[test]
fn every_quantity_has_one_name() {
    let all: Vec<Quantity> = Quantity::all().collect();
    assert_eq!(all.len(), 26);
    for quantity in all {
        assert_eq!(Quantity::named(&quantity.name()).unwrap(), quantity);
    }
    assert!(Quantity::named("alpha").is_err());
}

#[test]
fn bad_data_is_refused_with_a_reason() {
    let file = scene("none", [33.0, 1.35]);
    let key = |key: &str| Data::new(&file, &[key]).map(|_| ()).unwrap_err().to_string();
    assert!(key("design.helix.shore_a").contains("is no input"));
    assert!(key("field.uniform").contains("field.uniform"));
    let mut data = Data::new(&file, &["field.uniform_mt[2]"]).unwrap();
    assert!(data.is_empty());
    let quantity = Quantity::named("alpha_deg").unwrap();
    let angle = |value, deviation| Measured { quantity, value, deviation };
    let mut add =
        |values: &[f64], measured: &[Measured]| data.add(values, measured).map_err(|e| e.to_string());
    assert!(add(&[], &[angle(1.0, None)]).unwrap_err().contains("inputs of a row"));
    assert!(add(&[1.0], &[]).unwrap_err().contains("measured outputs of a row"));
    assert!(add(&[1.0], &[angle(f64::NAN, None)]).unwrap_err().contains("alpha_deg"));
    assert!(add(&[1.0], &[angle(1.0, Some(0.0))]).unwrap_err().contains("standard deviation of alpha_deg"));
    assert!(add(&[f64::NAN], &[angle(1.0, None)]).is_err());
    add(&[5.0], &[angle(9.0, None)]).unwrap();
    let fit = |keys: &[&str], data: &Data| {
        Fit::new(&file, keys, data, quick()).map(|_| ()).unwrap_err().to_string()
    };
    assert!(fit(&[], &data).contains("parameters to fit"));
    assert!(fit(&KEYS, &data).contains("at least 2, one for each parameter"));
    assert!(fit(&["design.helix.shoreA"], &data).contains("shoreA"));
    data.add(&[6.0], &[angle(9.0, Some(1.0))]).unwrap();
    assert!(fit(&KEYS[..1], &data).contains("give it for all, or for none"));
    let full = scene("full", [33.0, 1.35]);
    let mut beyond = Data::new(&full, &["field.uniform_mt[2]"]).unwrap();
    beyond.add(&[60.0], &[angle(90.0, None)]).unwrap();
    let said = Fit::new(&full, &KEYS[..1], &beyond, quick()).unwrap_err().to_string();
    assert!(said.contains("no shape at measured row 1"), "{said}");
}
