//! Where the numbers of the pages come from: below every table with measured numbers a line in small print says which command made
//! them, on which state of the code, or which test compares them. `tests/python/test_pages.py` holds that these commands exist.

use std::fs;

use crate::documents::{package, pages, prose};

/// Headers of tables that define, describe or count what is given, and measure nothing, by how they begin.
const DEFINITIONS: [&str; 4] =
    ["| page | answers |", "| symbol | code name |", "| file | rows | content |", "| key | unit | default |"];

/// Units of measured numbers, after a blank.
const UNITS: [&str; 22] = [
    "%", "um", "mm", "m", "ns", "us", "ms", "s", "min", "h", "deg", "rad", "mT", "T", "T/m", "mN", "N",
    "MPa", "N/m", "kB", "MB", "GB",
];

/// What a line in small print says of the numbers above it.
#[derive(Debug, PartialEq)]
enum Source {
    /// Made by a command on these states of the code.
    Made(String, Vec<String>),
    /// Computed again by a test, and compared.
    Compared(String),
    /// Measured once on these states, by what is no command of the project.
    ByHand(Vec<String>),
}

/// Whether a cell holds a number with a decimal point, an exponent or a unit, or is a number.
fn is_measured(cell: &str) -> bool {
    let plain: String = cell.split('`').step_by(2).collect();
    let words: Vec<&str> = plain.split_whitespace().collect();
    let digits = |word: &str| word.contains(|c: char| c.is_ascii_digit());
    let number =
        |word: &str| digits(word) && word.trim_matches(|c: char| "(),;+-".contains(c)).parse::<f64>().is_ok();
    let precise = |word: &str| number(word) && (word.contains('.') || word.contains('e'));
    let unit = |word: &str| UNITS.contains(&word.trim_matches(|c: char| "(),;.:".contains(c)));
    words.iter().any(|word| precise(word))
        || words.windows(2).any(|pair| number(pair[0]) && unit(pair[1]))
        || (!words.is_empty() && words.iter().all(|word| number(word)))
}

/// Hashes between backticks, with commas between them, and the full stop after them; what follows.
fn hashes(text: &str) -> Option<(Vec<String>, &str)> {
    let (listed, rest) = text.split_once('.')?;
    let hash = |part: &str| {
        let hash = part.strip_prefix('`')?.strip_suffix('`')?;
        let letters = hash.chars().all(|c| c.is_ascii_digit() || ('a'..='f').contains(&c));
        ((7..=12).contains(&hash.len()) && letters).then(|| hash.to_owned())
    };
    Some((listed.split(", ").map(hash).collect::<Option<_>>()?, rest))
}

/// What a line in small print says; nothing if it is not in this form.
fn sources(line: &str) -> Option<Vec<Source>> {
    let mut rest = line.strip_prefix("<sub>")?.strip_suffix("</sub>")?;
    let mut out = Vec::new();
    while !rest.is_empty() {
        let source;
        if let Some(said) = rest.strip_prefix("Made by `") {
            let (command, after) = said.split_once("` at ")?;
            let (states, after) = hashes(after)?;
            (source, rest) = (Source::Made(command.into(), states), after);
        } else if let Some(said) = rest.strip_prefix("Compared by `") {
            let (command, after) = said.split_once("`.")?;
            (source, rest) = (Source::Compared(command.into()), after);
        } else {
            let (states, after) = hashes(rest.strip_prefix("Measured by hand at ")?)?;
            (source, rest) = (Source::ByHand(states), after);
        }
        out.push(source);
        rest = rest.strip_prefix(' ').unwrap_or(rest);
    }
    (!out.is_empty()).then_some(out)
}

/// A table of a page: its header, whether it measures something, and the line below it.
struct Table<'a> {
    header: &'a str,
    measured: bool,
    below: &'a str,
}

fn tables(page: &str) -> Vec<Table<'_>> {
    let lines: Vec<&str> = page.lines().collect();
    let mut out = Vec::new();
    let mut at = 0;
    while at < lines.len() {
        let end =
            lines[at..].iter().position(|line| !line.starts_with('|')).map_or(lines.len(), |rows| at + rows);
        if end > at + 2 {
            let cells = lines[at + 2..end].iter().flat_map(|row| row.split('|'));
            let below = lines[end..].iter().find(|line| !line.is_empty()).unwrap_or(&"");
            out.push(Table { header: lines[at], measured: cells.map(str::trim).any(is_measured), below });
        }
        at = end.max(at + 1);
    }
    out
}

#[test]
fn below_every_measured_table_stands_where_its_numbers_come_from() {
    let (mut faults, mut needed, mut measured) = (Vec::new(), Vec::new(), 0);
    for page in pages() {
        let text = prose(&fs::read_to_string(&page).unwrap());
        let name = page.strip_prefix(package()).unwrap().display();
        for table in tables(&text).into_iter().filter(|table| table.measured) {
            if let Some(definition) = DEFINITIONS.iter().find(|begin| table.header.starts_with(**begin)) {
                needed.push(definition);
                continue;
            }
            measured += 1;
            if sources(table.below).is_none() {
                faults.push(format!(
                    "{name}: nothing says where the numbers come from below\n{}",
                    table.header
                ));
            }
        }
        let small = text.lines().filter(|line| line.contains("<sub>"));
        faults.extend(
            small.filter(|line| sources(line).is_none()).map(|line| format!("{name}: what is\n{line}")),
        );
    }
    assert!(faults.is_empty(), "{}", faults.join("\n"));
    assert!(measured > 30, "only {measured} tables");
    for definition in DEFINITIONS {
        assert!(needed.contains(&&definition), "no table that begins with {definition} has a number");
    }
}

#[test]
fn what_measures_is_told_from_what_defines() {
    for cell in ["0.5 N/m", "1e-9", "12", "-4.5 %", "40 800", "off by 2e-11 mN", "GLIBC, 3.6 MB", "(17.82)"] {
        assert!(is_measured(cell), "{cell}");
    }
    for cell in ["", "`pairs 1e-3`", "S = 3", "three segments", "K_bt, K_se", "9 segments", "Eq. (12)"] {
        assert!(!is_measured(cell), "{cell}");
    }
    let page =
        "| a | b |\n| --- | --- |\n| x | 1.5 |\n\n<sub>Compared by `c d`.</sub>\n| a |\n| --- |\n| x |\nend";
    let found: Vec<(bool, &str)> = tables(page).iter().map(|table| (table.measured, table.below)).collect();
    assert_eq!(found, [(true, "<sub>Compared by `c d`.</sub>"), (false, "end")]);
}

#[test]
fn small_print_has_one_form() {
    let made = "<sub>Made by `mcm study fig5 --out figures` at `0123abc`, `1234567`. Measured by hand at `89abcdef`.</sub>";
    let states = ["0123abc", "1234567"].map(String::from).to_vec();
    let first = Source::Made("mcm study fig5 --out figures".into(), states);
    assert_eq!(sources(made), Some(vec![first, Source::ByHand(vec!["89abcdef".into()])]));
    let compared = Some(vec![Source::Compared("cargo test".into())]);
    assert_eq!(sources("<sub>Compared by `cargo test`.</sub>"), compared);
    for wrong in [
        "Made by `cargo bench` at `0123abc`.",
        "<sub></sub>",
        "<sub>Made by `cargo bench`.</sub>",
        "<sub>Made by `cargo bench` at `0123ab`.</sub>",
        "<sub>Made by `cargo bench` at `0123abg`.</sub>",
        "<sub>Made by cargo bench at `0123abc`.</sub>",
        "<sub>Measured at `0123abc`.</sub>",
        "<sub>Compared by `cargo test`, I think.</sub>",
    ] {
        assert_eq!(sources(wrong), None, "{wrong}");
    }
}
