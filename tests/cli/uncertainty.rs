//! `mcm solve --uncertainty`.

use serde_json::Value;

use super::{assert_status, stderr, stdout, with_scene};

/// One segment whose hardness is known to a Shore degree, in this field (mT).
fn uncertain(field: f64, hardness: f64) -> String {
    format!(
        "[design]\nsegments = 1\n[design.helix]\nshore_a = {hardness}\n[field]\nuniform_mt = [0.0, {field}, 0.0]\n\
         [model]\ninteraction = \"full\"\n[uncertainty]\n\"design.helix.shore_a\" = 1.0\n"
    )
}

#[test]
fn bands_are_those_of_two_other_solves() {
    let json = |name: &str, hardness: f64, more: &[&str]| -> Value {
        let arguments = [&["solve", "scene.toml", "--json", "--shape-points", "3"], more].concat();
        let (_, output) = with_scene(name, &uncertain(10.0, hardness), &arguments);
        assert_status(&output, 0);
        serde_json::from_str(&stdout(&output)).unwrap()
    };
    let (softer, harder) = (json("softer", 32.9, &[]), json("harder", 33.1, &[]));
    assert!(softer.get("uncertainty").is_none(), "not asked for");
    let told = json("uncertain", 33.0, &["--uncertainty", "--samples", "300"]);
    let told = &told["uncertainty"];
    let number = |value: &Value| value.as_f64().unwrap();
    for path in ["/alpha_rad", "/tip_position_m/1", "/shape_m/1/2", "/core_angles_rad/0"] {
        let slope = (number(harder.pointer(path).unwrap()) - number(softer.pointer(path).unwrap())) / 0.2;
        let band = number(told["band_95"].pointer(path).unwrap());
        assert!((band / (1.96 * slope.abs()) - 1.0).abs() < 1e-3, "{path}: {band}, slope {slope}");
        let sensitivity = number(told["sensitivities"]["design.helix.shore_a"].pointer(path).unwrap());
        assert!((sensitivity / slope - 1.0).abs() < 1e-3, "{path}: {sensitivity}, slope {slope}");
    }
    assert_eq!(told["band_95"]["contact_force_n"], Value::Null);
    assert_eq!(told["deviations"]["design.helix.shore_a"], 1.0);
    assert_eq!(told["near_fold"], false);
    let samples = &told["samples"];
    assert_eq!((number(&samples["hold_the_shape"]), number(&samples["snap_probability"])), (300.0, 0.0));
    let [low, high] = [0, 1].map(|end| number(&samples["band_95"]["alpha_rad"][end]));
    // The limits of 300 samples are uncertain by a tenth.
    assert!((0.5 * (high - low) / number(&told["band_95"]["alpha_rad"]) - 1.0).abs() < 0.25);
}

#[test]
fn near_a_fold_bands_say_that_they_do_not_hold() {
    let (_, output) = with_scene("near", &uncertain(35.3, 33.0), &["solve", "scene.toml", "--uncertainty"]);
    assert_status(&output, 0);
    let text = stdout(&output);
    assert!(text.contains("these bands do not hold; only samples show it"), "{text}");
    assert!(text.contains("tip angle") && text.contains('\u{b1}'), "{text}");
}

#[test]
fn bands_without_a_table_of_deviations_are_refused() {
    let (_, output) =
        with_scene("certain", "[design]\nsegments = 1\n", &["solve", "scene.toml", "--uncertainty"]);
    assert_status(&output, 1);
    assert!(stderr(&output).contains("it has no table [uncertainty]"), "{}", stderr(&output));
    let (_, output) = with_scene("alone", "", &["solve", "scene.toml", "--samples", "3"]);
    assert_status(&output, 1);
    let shooting = uncertain(10.0, 33.0).replace("\"full\"", "\"rings\"\nmethod = \"shooting\"");
    let (_, output) = with_scene("shooting", &shooting, &["solve", "scene.toml", "--uncertainty"]);
    assert_status(&output, 0);
    assert!(stderr(&output).contains("no bands: they need method \"potential\""), "{}", stderr(&output));
}
