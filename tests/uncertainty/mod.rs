//! Bands and samples of outputs where numbers of the scene are uncertain.

use mcm::manipulator::{Branch, Inputs, Manipulator, Outputs, SceneFile};
use mcm::uncertainty::{Bands, COVERAGE, Samples};

/// Two numbers that are known to a few percent and belong together.
const FAR: &str = "[design]\nsegments = 2\n[field]\nuniform_mt = [1.0, 5.0, 0.0]\n[magnet]\nposition_mm = [20.0, -130.0, 10.0]\n\
    [model]\ninteraction = \"rings\"\n[uncertainty]\n\"design.helix.shore_a\" = 1.0\n\"design.ring.remanence_t\" = 0.027\n\
    \"magnet.position_mm[2]\" = 0.5\n[correlation]\n\"design.helix.shore_a, design.ring.remanence_t\" = 0.6\n";

/// One segment, which its rings pull shut at 35.83 mT.
const NEAR: &str = "[design]\nsegments = 1\n[field]\nuniform_mt = [0.0, 35.3, 0.0]\n[model]\ninteraction = \"full\"\n\
    [uncertainty]\n\"design.helix.shore_a\" = 0.5\n";

fn file(text: &str) -> SceneFile {
    SceneFile::parse(text, "test").unwrap()
}

fn solved(file: &SceneFile) -> Manipulator {
    let scene = file.scene().unwrap();
    let mut manipulator = scene.manipulator(3).unwrap();
    manipulator.solve(&scene.inputs).unwrap();
    manipulator
}

#[test]
fn far_from_folds_samples_have_the_deviations_of_first_order() {
    let file = file(FAR);
    let manipulator = solved(&file);
    let bands = Bands::new(&file, &manipulator).unwrap();
    assert!(!bands.near_fold(), "{:?}", bands.distance_of_fold());
    let count = 4000;
    let samples = Samples::draw(&file, &manipulator, count, 1, || ()).unwrap();
    assert_eq!((samples.outputs().len(), samples.snap_probability()), (count, 0.0));
    let reads: [fn(&Outputs) -> f64; 5] = [
        |outputs| outputs.tip_angle,
        |outputs| outputs.tip.position.y,
        |outputs| outputs.magnetic_force.z,
        |outputs| outputs.reactions[0].torque.x,
        |outputs| outputs.core_angles[0],
    ];
    for (index, read) in reads.into_iter().enumerate() {
        let ([_, sampled], first) = (samples.moments(read), bands.deviation(read));
        // The deviation of 4000 samples is itself uncertain by 1.1 %; the rest is of second order.
        assert!(
            (sampled / first - 1.0).abs() < 0.04,
            "output {index}: {sampled} by samples, {first} by sensitivities"
        );
        let [low, high] = samples.band(read).unwrap();
        let half = bands.band(read);
        assert!(
            (0.5 * (high - low) / half - 1.0).abs() < 0.06,
            "output {index}: {low} to {high}, not {half}"
        );
    }
}

#[test]
fn equal_seeds_draw_equal_devices() {
    let file = file(FAR);
    let manipulator = solved(&file);
    let drawn = |seed| {
        let samples = Samples::draw(&file, &manipulator, 20, seed, || ()).unwrap();
        samples.outputs().iter().map(|outputs| outputs.tip_angle.to_bits()).collect::<Vec<_>>()
    };
    assert_eq!(drawn(7), drawn(7));
    assert_ne!(drawn(7), drawn(8));
}

/// The field (T) at which the device with this hardness snaps shut.
fn fold(file: &SceneFile, hardness: f64) -> f64 {
    let scene = file.with("design.helix.shore_a", hardness).unwrap().scene().unwrap();
    let field = |b: f64| Ok(Inputs { uniform_field: [0.0, b, 0.0].into(), ..Inputs::unloaded(2) });
    let mut branch = Branch::new(scene.manipulator(2).unwrap(), field, 0.05, 0.001).unwrap();
    branch.to(0.02).unwrap();
    branch.to(0.05).unwrap();
    branch.folds()[0].value
}

#[test]
fn near_a_fold_the_samples_tell_how_likely_a_snap_is() {
    let file = file(NEAR);
    let manipulator = solved(&file);
    let bands = Bands::new(&file, &manipulator).unwrap();
    assert!(bands.near_fold());
    // The hardness at which the fold lies at the field of the scene: the fold is all but linear in it.
    let [low, high] = [32.0, 33.0].map(|hardness| fold(&file, hardness));
    let hard = 32.0 + (35.3e-3 - low) / (high - low);
    let distance = (33.0 - hard) / 0.5;
    let told = bands.distance_of_fold().unwrap();
    assert!((told / distance - 1.0).abs() < 0.2, "{told} deviations told, {distance} true");
    let count = 500;
    let samples = Samples::draw(&file, &manipulator, count, 2, || ()).unwrap();
    let expected = below(-distance);
    let uncertain = 4.0 * (expected * (1.0 - expected) / count as f64).sqrt();
    let probability = samples.snap_probability();
    assert!(
        expected > 0.02 && (probability - expected).abs() < uncertain,
        "{probability}, expected {expected}"
    );
}

/// Probability of less than `x` under the standard normal distribution, by Simpson's rule from -8.
fn below(x: f64) -> f64 {
    let (count, from) = (2000, -8.0);
    let step = (x - from) / f64::from(count);
    let density = |t: f64| (-0.5 * t * t).exp() / core::f64::consts::TAU.sqrt();
    let weight = |i: i32| {
        if i == 0 || i == count {
            1.0
        } else if i % 2 == 1 {
            4.0
        } else {
            2.0
        }
    };
    (0..=count).map(|i| weight(i) * density(from + f64::from(i) * step)).sum::<f64>() * step / 3.0
}

#[test]
fn the_coverage_is_that_of_the_normal_distribution() {
    assert!((below(COVERAGE) - 0.975).abs() < 1e-10);
}

#[test]
fn what_cannot_be_told_is_refused() {
    let certain = file("[design]\nsegments = 1\n[field]\n");
    let message = "the scene does not say how well its numbers are known: it has no table [uncertainty]";
    assert_eq!(Bands::new(&certain, &solved(&certain)).unwrap_err().to_string(), message);
    let file = file(NEAR);
    let unsolved = file.scene().unwrap().manipulator(2).unwrap();
    assert_eq!(
        Bands::new(&file, &unsolved).unwrap_err().to_string(),
        "no derivatives: nothing is solved yet"
    );
    let none = Samples::draw(&file, &solved(&file), 0, 1, || ()).unwrap_err().to_string();
    assert!(none.starts_with("number of samples = 0 is not allowed"), "{none}");
    assert!(Samples::draw(&file, &unsolved, 1, 1, || ()).is_err());
}
