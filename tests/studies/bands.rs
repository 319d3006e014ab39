//! Bands of what the paper measured, against differences of whole solves.

use mcm::manipulator::SceneFile;
use mcm::studies::{Value, bands, fig7a};

const SCENE: &str =
    "[design]\nsegments = 1\n[model]\ninteraction = \"full\"\n[field]\nuniform_mt = [0, 20, 0]\n";

#[test]
fn bands_of_one_segment_are_those_of_solves_and_one_measured_value_lies_inside() {
    let study = bands().unwrap();
    let [low, middle, high] =
        ["alpha_low_deg", "alpha_deg", "alpha_high_deg"].map(|name| study.column(name).unwrap()[19]); // at 20 mT
    let figure = fig7a().unwrap().column("alpha_both_full_deg").unwrap()[20];
    assert!((middle / figure - 1.0).abs() < 1e-6, "{middle}, {figure} in Fig. 7A");
    let file = SceneFile::parse(SCENE, "test").unwrap();
    let angle = |key: &str, by: f64| {
        let varied = file.with(key, file.number(key).unwrap() + by).unwrap().scene().unwrap();
        varied.manipulator(2).unwrap().solve(&varied.inputs).unwrap().tip_angle.to_degrees()
    };
    let numbers = [
        ("design.helix.shore_a", 1.0),
        ("design.ring.remanence_t", 0.02 * 1.35),
        ("design.helix.length_mm", 0.05),
    ];
    let part = |(key, size): (&str, f64)| (angle(key, 0.05 * size) - angle(key, -0.05 * size)) / 0.1;
    let deviation = numbers.map(part).iter().map(|part| part * part).sum::<f64>().sqrt();
    for half in [high - middle, middle - low] {
        // Differences over a twentieth of the deviations.
        assert!((half / (1.959_964 * deviation) - 1.0).abs() < 2e-3, "{half}, {deviation} by solves");
    }
    let inside: Vec<bool> = study.comparison.iter().map(|row| row.remark.starts_with("inside")).collect();
    assert_eq!(inside, [true, false, false, false]);
    for row in &study.comparison {
        let (Value::Number(paper), Value::Number(exact)) = (&row.paper, &row.exact) else {
            panic!("no numbers")
        };
        let words = row.remark.rsplit(", the measured value ").next().unwrap();
        let widths: f64 = words.split(' ').next().unwrap().parse().unwrap();
        assert_eq!(widths <= 1.0, row.remark.starts_with("inside"), "{}: {paper}, {exact}", row.remark);
    }
}
