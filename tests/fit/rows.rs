//! What tables may hold, and rows without a shape.

use mcm::fit::{Fit, Measurements, Settings};

use super::{ONE, fitted, measure, scene, table};

#[test]
fn rows_beyond_a_fold_are_told() {
    let file = scene(ONE).with("design.helix.shore_a", 33.0).unwrap();
    let mut rows: Vec<Vec<f64>> = [5.0, 10.0, 15.0]
        .map(|field| measure(&file, &[], &[("field.uniform_mt[2]", field)], &["alpha_deg"]))
        .to_vec();
    // Beyond the field at which the rings pull the segment shut.
    rows.push(vec![500.0, 90.0]);
    let measured = table(&file, &["field.uniform_mt[2]", "alpha_deg"], &rows);
    let fit = fitted(&file, &["design.helix.shore_a"], &measured);
    println!("{:?} {:?}", fit.lost, fit.doubtful);
    let told: Vec<u64> = fit.lost.iter().chain(&fit.doubtful).map(|(line, _)| *line).collect();
    assert_eq!(told, [5]);
}

#[test]
fn bad_tables_are_refused() {
    let file = scene(ONE);
    let refused = |titles: &[&str], rows: &[&[&str]]| {
        let rows = rows.iter().zip(2..).map(|(row, line)| (line, row.to_vec()));
        let measured = Measurements::parse(&file, titles, rows);
        let fit = measured.and_then(|m| {
            Fit::new(&file, &["design.helix.shore_a", "design.ring.remanence_t"], &m, &Settings::default())
        });
        fit.unwrap_err().to_string()
    };
    let field = "field.uniform_mt[2]";
    for (titles, rows, expected) in [
        (&[field, "alpha_deg"][..], &[][..], "has no rows"),
        (&[field], &[&["1"][..]][..], "no column is an output"),
        (&[field, "alpha_deg"], &[&["1", ""]], "no row holds a measured value"),
        (&[field, "alpha_deg"], &[&["1", "NaN"]], "line 2: alpha_deg = \"NaN\" is not a finite number"),
        (&[field, "alpha_deg"], &[&["x", "1"]], "line 2: field.uniform_mt[2] = \"x\" is not a finite number"),
        (&[field, "alpha_dge"], &[&["1", "1"]], "did you mean `alpha_deg`?"),
        (&["field.unifrom_mt[2]", "alpha_deg"], &[&["1", "1"]], "did you mean `uniform_mt`?"),
        (&[field, "alpha_deg", "alpha_deg"], &[&["1", "1", "1"]], "two columns `alpha_deg`"),
        (
            &[field, "alpha_deg"],
            &[&["1", "1"]],
            "2 parameters need as many measured values: there are only 1",
        ),
        (&[field, "alpha_deg", "tip_y_mm"], &[&["1", "1", "1"]], "different units"),
        (
            &[field, "alpha_deg", "sd_alpha_deg"],
            &[&["1", "1", "0.1"], &["2", "2", ""]],
            "some values have one",
        ),
        (&[field, "alpha_deg", "sd_alpha_deg"], &[&["1", "1", "-1"]], "sd_alpha_deg = -1 is not allowed"),
        (&[field, "alpha_deg", "sd_tip_y_mm"], &[&["1", "1", "1"]], "without a column `tip_y_mm`"),
        (&["design.helix.shore_a", "alpha_deg"], &[&["30", "1"], &["31", "2"]], "the rows give its values"),
        (&["design.helix.length_mm", "alpha_deg"], &[&["4", "1"], &["-4", "2"]], "line 3"),
    ] {
        let message = refused(titles, rows);
        assert!(message.contains(expected), "{titles:?} {rows:?}: {message}");
    }
}
