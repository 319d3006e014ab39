//! Where the numbers of the pages come from: below every table with measured numbers a line in small print says which command made
//! them, or which test compares them. `tests/provenance.csv` has a row for each, in the order of the pages, with the states of the code
//! on which they were measured. `tests/python/test_pages.py` holds that these commands exist.

use std::fs;
use std::path::PathBuf;

use serde::Deserialize;

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
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Source<'a> {
    /// Made by a command.
    Made(&'a str),
    /// Computed again by a test, and compared.
    Compared(&'a str),
    /// Measured once, by what is no command of the project.
    ByHand,
}

impl<'a> Source<'a> {
    /// What the table of sources has under `kind` and `source`.
    fn cells(self) -> [&'a str; 2] {
        match self {
            Self::Made(command) => ["made", command],
            Self::Compared(test) => ["compared", test],
            Self::ByHand => ["by hand", ""],
        }
    }
}

/// A row of `tests/provenance.csv`.
#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
struct Row {
    /// The page, from the package's folder.
    page: String,
    /// The heading above the numbers.
    section: String,
    /// How they were obtained: `made`, `compared`, `by hand`.
    kind: String,
    /// The command, or the test; nothing if measured by hand.
    source: String,
    /// Commits on which they were measured, with blanks between them; nothing if a test compares them.
    states: String,
    /// Day of the last of these commits.
    date: String,
}

/// The table of sources.
fn recorded() -> Vec<Row> {
    let mut reader = csv::Reader::from_path(package().join("tests/provenance.csv")).unwrap();
    reader.deserialize().collect::<Result<_, _>>().unwrap()
}

/// Whether these are hashes of commits, with blanks between them.
fn are_hashes(states: &str) -> bool {
    let hex = |c: char| c.is_ascii_digit() || ('a'..='f').contains(&c);
    states.split(' ').all(|hash| (7..=12).contains(&hash.len()) && hash.chars().all(hex))
}

/// Whether this is a day, year first.
fn is_day(date: &str) -> bool {
    let parts: Vec<Option<u32>> = date.split('-').map(|part| part.parse().ok()).collect();
    matches!(parts[..], [Some(2020..), Some(1..=12), Some(1..=31)]) && date.len() == 10
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

/// What stands between backticks and ends a sentence, and what follows it.
fn quoted(text: &str) -> Option<(&str, &str)> {
    text.split_once("`.").filter(|(quoted, _)| !quoted.contains('`'))
}

/// What a line in small print says; nothing if it is not in this form.
fn sources(line: &str) -> Option<Vec<Source<'_>>> {
    let mut rest = line.strip_prefix("<sub>")?.strip_suffix("</sub>")?;
    let mut out = Vec::new();
    while !rest.is_empty() {
        let source;
        if let Some(said) = rest.strip_prefix("Made by `") {
            let (command, after) = quoted(said)?;
            (source, rest) = (Source::Made(command), after);
        } else if let Some(said) = rest.strip_prefix("Compared by `") {
            let (command, after) = quoted(said)?;
            (source, rest) = (Source::Compared(command), after);
        } else {
            (source, rest) = (Source::ByHand, rest.strip_prefix("Measured by hand.")?);
        }
        out.push(source);
        rest = rest.strip_prefix(' ').unwrap_or(rest);
    }
    (!out.is_empty()).then_some(out)
}

/// All that small print says on a page, in order, each with the heading above it.
fn small_print(page: &str) -> Vec<(&str, Source<'_>)> {
    let (mut section, mut out) = ("", Vec::new());
    for line in page.lines() {
        if line.starts_with('#') {
            section = line.trim_start_matches('#').trim();
        }
        out.extend(sources(line).unwrap_or_default().into_iter().map(|source| (section, source)));
    }
    out
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
fn every_source_has_its_row_and_every_row_its_source() {
    let text = |page: &PathBuf| {
        let name = page.strip_prefix(package()).unwrap().display().to_string();
        (name, prose(&fs::read_to_string(page).unwrap()))
    };
    let mut texts: Vec<(String, String)> = pages().iter().map(text).collect();
    texts.sort();

    let said: Vec<[&str; 4]> = texts
        .iter()
        .flat_map(|(name, text)| small_print(text).into_iter().map(move |found| (name, found)))
        .map(|(name, (section, source))| {
            let [kind, command] = source.cells();
            [name, section, kind, command]
        })
        .collect();

    let rows = recorded();
    let kept = rows.iter().map(|row| [&*row.page, &row.section, &row.kind, &row.source]);
    for (number, (said, kept)) in said.iter().zip(kept).enumerate() {
        assert_eq!(*said, kept, "a page, and row {} of the table", number + 2);
    }
    assert_eq!(said.len(), rows.len(), "sources on pages, and rows of the table");

    for row in &rows {
        let measured = row.kind != "compared";
        assert_eq!(are_hashes(&row.states), measured, "{row:?}");
        assert_eq!(is_day(&row.date), measured, "{row:?}");
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
    let made = "<sub>Made by `mcm study fig5 --out figures`. Measured by hand.</sub>";
    assert_eq!(sources(made), Some(vec![Source::Made("mcm study fig5 --out figures"), Source::ByHand]));
    assert_eq!(sources("<sub>Compared by `cargo test`.</sub>"), Some(vec![Source::Compared("cargo test")]));
    for wrong in [
        "Made by `cargo bench`.",
        "<sub></sub>",
        "<sub>Made by `cargo bench` at `0123abc`.</sub>",
        "<sub>Made by cargo bench.</sub>",
        "<sub>Measured at `0123abc`.</sub>",
        "<sub>Compared by `cargo test`, I think.</sub>",
    ] {
        assert_eq!(sources(wrong), None, "{wrong}");
    }
    let page = "# A\n<sub>Measured by hand.</sub>\n## B c\n<sub>Compared by `d`. Measured by hand.</sub>";
    let expected = [("A", Source::ByHand), ("B c", Source::Compared("d")), ("B c", Source::ByHand)];
    assert_eq!(small_print(page), expected);
}

#[test]
fn states_are_hashes_and_dates_are_days() {
    for (states, right) in
        [("0123abc", true), ("0123abc 89abcdef", true), ("", false), ("0123ab", false), ("0123abg", false)]
    {
        assert_eq!(are_hashes(states), right, "{states}");
    }
    for (date, right) in
        [("2026-11-26", true), ("", false), ("2026-13-01", false), ("26-11-2026", false), ("2026-1-1", false)]
    {
        assert_eq!(is_day(date), right, "{date}");
    }
}
