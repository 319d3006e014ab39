//! `mcm study`: tables, marks, the comparison in their page.

use std::collections::BTreeSet;
use std::path::Path;

use super::{assert_status, folder, mcm, stderr, table};

const STUDIES: [&str; 13] = [
    "field_ring",
    "fig4",
    "fig5",
    "fig7a",
    "fig7b",
    "fig7c",
    "fig7d",
    "fig8",
    "hysteresis",
    "bands",
    "rest",
    "coils",
    "communication-step",
];

/// Studies with marks, and how many.
const MARKS: [(&str, usize); 8] = [
    ("fig4", 1),
    ("fig5", 1),
    ("fig7a", 1),
    ("fig7b", 7),
    ("fig7c", 2),
    ("fig7d", 4),
    ("hysteresis", 4),
    ("bands", 3),
];

/// Beginnings of pure numbers' headers, and the ends of all others: their unit.
const PURE: [&str; 8] =
    ["mu_rel", "segments", "height_over_pitch", "score_", "gain", "steps", "snaps_", "refused_"];
const UNITS: [&str; 6] = ["_mm", "_deg", "_mt", "_t_per_m", "_n", "_unm"];

fn assert_table(path: &Path) {
    let rows = table(path);
    assert!(rows.len() > 3, "{} has {} rows", path.display(), rows.len());
    for row in &rows {
        for (header, cell) in row {
            let named = UNITS.iter().any(|unit| header.ends_with(unit))
                || PURE.iter().any(|pure| header.starts_with(pure));
            assert!(named, "{}: {header} names no unit", path.display());
            assert!(cell.is_empty() || cell.parse::<f64>().unwrap().is_finite(), "{header} = {cell}");
        }
    }
}

/// Marks have names of their own, and a place or a level.
fn assert_marks(path: &Path, count: usize) {
    let rows = table(path);
    let names: BTreeSet<&str> = rows.iter().map(|row| row["mark"].as_str()).collect();
    assert_eq!((rows.len(), names.len()), (count, count), "{}: {names:?}", path.display());
    for row in &rows {
        let number = |column: &str| row[column].parse::<f64>().is_ok_and(f64::is_finite);
        assert!(number("y") && (row["x"].is_empty() || number("x")), "{}: {row:?}", path.display());
    }
}

fn files(folder: &Path) -> BTreeSet<String> {
    let entries = std::fs::read_dir(folder).unwrap();
    entries.map(|entry| entry.unwrap().file_name().into_string().unwrap()).collect()
}

#[test]
fn every_study_leaves_tables_and_their_page_has_the_comparison() {
    let here = folder("study");
    let page = include_str!("../../src/studies/README.md");
    let output = mcm(&here, &["study", "all", "--out", "figures"]);
    assert_status(&output, 0);
    for name in STUDIES {
        assert_table(&here.join("figures").join(name).with_extension("csv"));
        let shown = format!("tests/charts/{name}.png");
        assert!(page.contains(&shown), "the page does not show {shown}");
        assert!(Path::new(env!("CARGO_MANIFEST_DIR")).join(&shown).is_file());
    }
    for (name, count) in MARKS {
        assert_marks(&here.join(format!("figures/{name}-marks.csv")), count);
    }
    let tables = STUDIES.map(|name| format!("{name}.csv"));
    let marks = MARKS.map(|(name, _)| format!("{name}-marks.csv"));
    let expected = tables.into_iter().chain(marks).chain(["comparison.md".to_owned()]).collect();
    assert_eq!(files(&here.join("figures")), expected, "a study leaves nothing else");
    let comparison = std::fs::read_to_string(here.join("figures/comparison.md")).unwrap();
    assert_eq!(String::from_utf8(output.stdout).unwrap(), comparison);
    assert!(
        page.contains(&comparison),
        "the page's comparison is not what `mcm study all` writes:\n{comparison}"
    );
}

#[test]
fn one_study_leaves_its_files_alone() {
    let here = folder("study_one");
    assert_status(&mcm(&here, &["study", "fig5", "--out", "a/b"]), 0);
    let left = files(&here.join("a/b"));
    assert_eq!(left.iter().map(String::as_str).collect::<Vec<_>>(), ["fig5-marks.csv", "fig5.csv"]);
}

#[test]
fn unknown_study_lists_the_known_ones() {
    let output = mcm(&folder("study_unknown"), &["study", "fig6", "--out", "figures"]);
    assert_status(&output, 1);
    let message = stderr(&output);
    assert!(message.contains("'fig6'") && STUDIES.iter().all(|name| message.contains(name)), "{message}");
}

#[test]
fn the_budget_leaves_a_table_and_markdown() {
    let here = folder("study_budget");
    let output = mcm(&here, &["study", "budget", "--out", "figures"]);
    assert_status(&output, 0);
    let rows = table(&here.join("figures/budget.csv"));
    assert!(rows.len() > 40, "{} rows", rows.len());
    let markdown = std::fs::read_to_string(here.join("figures/budget.md")).unwrap();
    assert_eq!(String::from_utf8(output.stdout).unwrap(), markdown);
    assert_eq!(markdown.lines().count(), rows.len() + 2);
}
