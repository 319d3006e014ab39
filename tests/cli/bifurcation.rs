//! `mcm study bifurcation`: folds on three ways, and predictions of snaps.

use super::{assert_status, folder, mcm, table};
use crate::tolerance::{CLOSED_FORM_OF_FOLDS, LOCATED, PREDICTED_AHEAD};

/// Spans of the paths, in the order of the rows.
const SPANS: [f64; 12] = [240.0, 240.0, 240.0, 240.0, 75.0, 75.0, 160.0, 160.0, 40.0, 40.0, 40.0, 40.0];

/// The cells of a Markdown table's rows, without its heading.
fn cells(table: &str) -> Vec<Vec<&str>> {
    table.lines().skip(2).map(|row| row.trim_matches('|').split('|').map(str::trim).collect()).collect()
}

#[test]
fn continuation_bisection_and_closed_forms_agree_and_snaps_are_seen_coming() {
    let here = folder("bifurcation");
    let output = mcm(&here, &["study", "bifurcation", "--out", "figures"]);
    assert_status(&output, 0);
    let said = String::from_utf8(output.stdout).unwrap();
    let file = |ending: &str| here.join("figures/bifurcation").with_extension(ending);
    assert_eq!(said, std::fs::read_to_string(file("md")).unwrap());
    let (places, predictions) = said.split_once("\n\n").unwrap();
    let page = include_str!("../../src/studies/README.md");
    for table in [places, predictions.trim_end()] {
        assert!(page.contains(table), "the page's table is not what the study writes:\n{table}");
    }
    let (places, predictions) = (cells(places), cells(predictions));
    assert_eq!((places.len(), predictions.len()), (SPANS.len(), 6));
    let (mut snaps, mut known) = (0, 0);
    for (row, span) in places.iter().zip(SPANS) {
        let number = |cell: usize| row[cell].parse::<f64>().ok();
        let continuation = number(1).unwrap();
        if let Some(bisection) = number(2) {
            assert!((continuation - bisection).abs() <= LOCATED * span, "{row:?}");
            snaps += 1;
        }
        if let Some(closed_form) = number(3) {
            assert!((continuation / closed_form - 1.0).abs() <= CLOSED_FORM_OF_FOLDS, "{row:?}");
            known += 1;
        }
    }
    assert_eq!((snaps, known), (8, 6));
    // Each fold and branching point is a mark on its diagram, whose columns have a value there.
    let (rows, marks) = (table(&file("csv")), table(&here.join("figures/bifurcation-marks.csv")));
    for mark in marks.iter().filter(|mark| !mark["x"].is_empty()) {
        let (kind, diagram) = mark["mark"].split_once(", ").unwrap();
        assert!(["fold", "branching point"].contains(&kind), "{mark:?}");
        let on = |row: &&std::collections::HashMap<String, String>| {
            let x = row.iter().any(|(name, cell)| {
                let unit = name.strip_prefix(diagram).and_then(|rest| rest.strip_prefix('_'));
                unit.is_some_and(|unit| ["mm", "mt", "deg"].contains(&unit)) && *cell == mark["x"]
            });
            x && row.iter().any(|(name, cell)| name.starts_with(diagram) && *cell == mark["y"])
        };
        assert!(rows.iter().any(|row| on(&row)), "{mark:?} is on no branch");
    }
    for row in &places {
        let marked = |mark: &&std::collections::HashMap<String, String>| {
            let x = mark["x"].parse::<f64>().unwrap_or(f64::NAN);
            format!("{x:.6}") == row[1]
        };
        assert!(marks.iter().any(|mark| marked(&mark)), "{row:?} has no mark");
    }
    assert!(
        marks.iter().any(|mark| mark["mark"] == "windings touch, gap" && mark["y"] == "40.0"),
        "{marks:?}"
    );
    for row in predictions {
        let errors: Vec<f64> =
            row[1..].iter().map(|cell| cell.trim_end_matches(" %").parse().unwrap_or(f64::NAN)).collect();
        let close = errors[2..].iter().zip(PREDICTED_AHEAD).all(|(error, most)| error.abs() / 100.0 <= most);
        assert!(close, "{row:?}");
    }
}
