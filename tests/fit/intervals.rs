//! Intervals hold the truth as often as they say.

use mcm::fit::{Fit, Measurements, Settings};
use rand::rngs::StdRng;
use rand::{RngExt, SeedableRng};

use super::{ONE, fitted, measure, scene, table};

/// Number of fits of the test; the recorded run has more.
const FITS: usize = 200;

/// Two standard normal numbers (G. E. P. Box and M. E. Muller, Ann. Math. Stat. 29 (1958) 610).
fn normal(random: &mut StdRng) -> f64 {
    let (a, b): (f64, f64) = (random.random_range(f64::MIN_POSITIVE..1.0), random.random_range(0.0..1.0));
    (-2.0 * a.ln()).sqrt() * (core::f64::consts::TAU * b).cos()
}

#[test]
fn intervals_of_noisy_fits_cover_the_truth() {
    let file = scene(ONE);
    let truth = [("design.helix.shore_a", 33.0), ("design.helix.length_mm", 4.0)];
    let names = ["tip_y_mm", "tip_z_mm"];
    let exact: Vec<Vec<f64>> = (1..=4)
        .map(|step| measure(&file, &truth, &[("field.uniform_mt[2]", 5.0 * f64::from(step))], &names))
        .collect();
    let mut random = StdRng::seed_from_u64(11);
    let mut covered = [0; 2];
    for _ in 0..FITS {
        let rows: Vec<Vec<f64>> = exact
            .iter()
            .map(|row| vec![row[0], row[1] + 0.05 * normal(&mut random), row[2] + 0.05 * normal(&mut random)])
            .collect();
        let measured: Measurements = table(&file, &["field.uniform_mt[2]", "tip_y_mm", "tip_z_mm"], &rows);
        let fit: Fit = fitted(&file, &truth.map(|(key, _)| key), &measured);
        for (count, (parameter, (_, value))) in covered.iter_mut().zip(fit.parameters.iter().zip(truth)) {
            let [low, high] = parameter.interval.map(Option::unwrap);
            *count += usize::from(low <= value && value <= high);
        }
    }
    // 95 % within three standard deviations of the number of hits.
    let uncertain = 3.0 * (0.95 * 0.05 / FITS as f64).sqrt();
    for count in covered {
        let part = count as f64 / FITS as f64;
        println!("covered: {part}");
        assert!((part - 0.95).abs() < uncertain, "{part} of the intervals hold the truth");
    }
}

#[test]
fn profiles_of_a_small_error_are_the_deviations() {
    let file = scene(ONE);
    let rows: Vec<Vec<f64>> = [5.0, 10.0, 15.0]
        .map(|field| measure(&file, &[], &[("field.uniform_mt[2]", field)], &["alpha_deg"]))
        .to_vec();
    let measured = table(&file, &["field.uniform_mt[2]", "alpha_deg"], &rows);
    let measured = measured.with_deviation("alpha_deg", 0.01).unwrap();
    let keys = ["design.helix.shore_a"];
    let ends = |profiles| {
        let settings = Settings { profiles, ..Settings::default() };
        Fit::new(&file, &keys, &measured, &settings).unwrap().parameters[0].interval.map(Option::unwrap)
    };
    let (profile, plain) = (ends(true), ends(false));
    let width = plain[1] - plain[0];
    println!("{profile:?} {plain:?}");
    for (a, b) in profile.iter().zip(plain) {
        assert!((a - b).abs() < 5e-3 * width, "{profile:?} {plain:?}");
    }
}
