//! `mcm study`: tables, pictures, the comparison in their page.

use std::fs::File;
use std::io::BufReader;
use std::path::Path;

use super::{assert_status, folder, mcm, stderr, table};

/// Largest size of a picture that a page shows, bytes.
const LARGEST_PICTURE: u64 = 100_000;

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

/// Beginnings of pure numbers' headers, and the ends of all others: their unit.
const PURE: [&str; 8] =
    ["mu_rel", "segments", "height_over_pitch", "score_", "gain", "steps", "snaps_", "refused_"];
const UNITS: [&str; 6] = ["_mm", "_deg", "_mt", "_t_per_m", "_n", "_unm"];

fn assert_picture(path: &Path) {
    let name = path.display();
    assert!(path.metadata().unwrap().len() < LARGEST_PICTURE, "{name} is too large");
    let mut picture = png::Decoder::new(BufReader::new(File::open(path).unwrap())).read_info().unwrap();
    let mut pixels = vec![0; picture.output_buffer_size().unwrap()];
    let frame = picture.next_frame(&mut pixels).unwrap();
    assert_eq!((frame.width, frame.height), (900, 600), "{name}");
    let background = pixels.chunks(3).filter(|pixel| *pixel == [255; 3]).count();
    let share = background as f64 / f64::from(900 * 600);
    assert!((0.2..0.99).contains(&share), "{name}: {share} of the picture is white");
}

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

#[test]
fn every_study_leaves_table_and_picture_and_their_page_has_the_comparison() {
    let here = folder("study");
    let page = include_str!("../../src/studies/README.md");
    let output = mcm(&here, &["study", "all", "--out", "figures"]);
    assert_status(&output, 0);
    for name in STUDIES {
        assert_table(&here.join("figures").join(name).with_extension("csv"));
        assert_picture(&here.join("figures").join(name).with_extension("png"));
        let shown = format!("tests/charts/{name}.png");
        assert!(page.contains(&shown), "the page does not show {shown}");
        assert!(Path::new(env!("CARGO_MANIFEST_DIR")).join(&shown).is_file());
    }
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
    let mut left: Vec<String> = std::fs::read_dir(here.join("a/b"))
        .unwrap()
        .map(|entry| entry.unwrap().file_name().into_string().unwrap())
        .collect();
    left.sort();
    assert_eq!(left, ["fig5.csv", "fig5.png"]);
}

#[test]
fn unknown_study_lists_the_known_ones() {
    let output = mcm(&folder("study_unknown"), &["study", "fig6", "--out", "figures"]);
    assert_status(&output, 1);
    let message = stderr(&output);
    assert!(message.contains("'fig6'") && STUDIES.iter().all(|name| message.contains(name)), "{message}");
}

#[test]
fn a_table_of_peers_is_read_before_anything_is_measured() {
    let here = folder("peers");
    let known = include_str!("../charts/peers.csv");
    let (header, _) = known.split_once('\n').unwrap();
    assert_eq!(header, "case,solver,variant,time_us,error");
    for case in ["tip dipole", "ring near", "ring far"] {
        assert!(known.lines().any(|row| row.starts_with(case)), "{case} is missing");
    }
    for (text, expected) in [
        (format!("{header}\nrope,mcm,cold,1,1\n"), "there is no case rope"),
        (format!("{header}\ntip dipole,mcm,cold,fast,1\n"), "cannot read"),
    ] {
        std::fs::write(here.join("peers.csv"), text).unwrap();
        let output = mcm(&here, &["study", "accuracy", "--out", "figures", "--peers", "peers.csv"]);
        assert_status(&output, 1);
        assert!(stderr(&output).contains(expected), "{}", stderr(&output));
    }
}

#[test]
fn the_budget_leaves_table_picture_and_markdown() {
    let here = folder("study_budget");
    let output = mcm(&here, &["study", "budget", "--out", "figures"]);
    assert_status(&output, 0);
    let rows = table(&here.join("figures/budget.csv"));
    assert!(rows.len() > 40, "{} rows", rows.len());
    let markdown = std::fs::read_to_string(here.join("figures/budget.md")).unwrap();
    assert_eq!(String::from_utf8(output.stdout).unwrap(), markdown);
    assert_eq!(markdown.lines().count(), rows.len() + 2);
    let picture = here.join("figures/budget.png");
    let size = png::Decoder::new(BufReader::new(File::open(&picture).unwrap())).read_info().unwrap();
    let (width, height) = (size.info().width, size.info().height);
    assert!(width == 900 && height >= 600, "{width} x {height}");
    // The limit is one of 900 by 600 pixels; a chart of more rows is as much higher.
    assert!(picture.metadata().unwrap().len() < LARGEST_PICTURE * u64::from(height) / 600);
}
