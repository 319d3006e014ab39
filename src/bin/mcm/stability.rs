//! `mcm study stability`: the map of failures as a table, and its counts in Markdown.

use std::path::Path;
use std::process::ExitCode;

use mcm::error::Error;
use mcm::studies::{Attempt, Verdict, stability_rays};
use rayon::prelude::*;

use super::failure::Failure;
use super::progress::progress_bar;
use super::study_files::leave;

/// Computes and writes stability.csv and stability.md to `out`; prints the counts as well.
pub(super) fn run(out: &Path) -> Result<ExitCode, Failure> {
    let rays = stability_rays();
    let bar = progress_bar(rays.len() as u64, "directions");
    let attempts = rays.par_iter().map(|ray| {
        let attempts = ray.attempts();
        bar.inc(1);
        attempts
    });
    let attempts = attempts.collect::<Result<Vec<_>, Error>>()?.concat();
    bar.finish_and_clear();
    leave(out, "stability", &attempts, &counts(&attempts))
}

/// Number of attempts by method, level, start and verdict, in Markdown.
fn counts(attempts: &[Attempt]) -> String {
    let mut rows: Vec<(&str, &str, &str)> = Vec::new();
    for attempt in attempts {
        let row = (attempt.method, group(attempt), attempt.start);
        if !rows.contains(&row) {
            rows.push(row);
        }
    }
    rows.sort_by_key(|row| {
        (row.1 == "`full`", mcm::methods::Method::named(row.0).map(|m| m as usize), row.2)
    });
    let labels = Verdict::ALL.map(|(_, label)| label);
    let header = format!("| method | level | start | attempts | {} |\n", labels.join(" | "));
    let rule = format!("|{}\n", " --- |".repeat(4 + labels.len()));
    let line = |row: &(&str, &str, &str)| {
        let own: Vec<&Attempt> = attempts.iter().filter(|a| (a.method, group(a), a.start) == *row).collect();
        let count = |verdict| own.iter().filter(|attempt| attempt.verdict == verdict).count().to_string();
        let counts = Verdict::ALL.map(|(verdict, _)| count(verdict)).join(" | ");
        format!("| `{}` | {} | {} | {} | {counts} |\n", row.0, row.1, row.2, own.len())
    };
    header + &rule + &rows.iter().map(line).collect::<String>()
}

/// Levels that are counted together.
fn group(attempt: &Attempt) -> &'static str {
    if attempt.interaction == "full" { "`full`" } else { "`none`, `rings`" }
}
