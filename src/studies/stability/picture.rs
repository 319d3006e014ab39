//! Chart of the map of failures.

use super::{Attempt, SEGMENTS, Verdict};
use crate::methods::Method;
use crate::studies::study::{AtlasRow, Kind, Panel, Study, Tint};

/// The map, with methods and levels as rows, starts and numbers of segments as columns.
#[must_use]
pub fn stability_picture(attempts: &[Attempt]) -> Study {
    let map = |method: &str, level: &str, (start, segments): (&str, usize)| {
        let own = |attempt: &&Attempt| {
            (attempt.method, attempt.interaction, attempt.start, attempt.segments)
                == (method, level, start, segments)
        };
        let kind =
            |attempt: &Attempt| Verdict::ALL.iter().position(|row| row.0 == attempt.verdict).unwrap_or(0);
        attempts
            .iter()
            .filter(own)
            .map(|attempt| ([attempt.direction_deg, attempt.field_mt], kind(attempt)))
            .collect()
    };
    let columns = ["cold", "warm"].into_iter().flat_map(|start| SEGMENTS.map(|segments| (start, segments)));
    let columns: Vec<(&str, usize)> = columns.collect();
    let mut rows = Vec::new();
    for (_, method) in Method::ALL {
        for (number, level) in levels(attempts, method).into_iter().enumerate() {
            let group = if number == 0 { (*method).into() } else { String::new() };
            let maps = columns.iter().map(|column| map(method, level, *column)).collect();
            rows.push(AtlasRow { group, label: level.into(), maps });
        }
    }
    let kinds = Verdict::ALL.map(|(verdict, label)| Kind { label: label.into(), tint: tint(verdict) });
    let names = [
        SEGMENTS.iter().map(|segments| format!("S = {segments}")).collect(),
        vec!["cold, from the straight shape".into(), "warm, field raised in steps of 1 mT".into()],
    ];
    Study {
        title: "Which shape a method finds, and whether it says when it has none",
        columns: vec![],
        panels: vec![Panel::Atlas {
            x: "direction of the field from the axis (deg)".into(),
            y: "field (mT)".into(),
            kinds: kinds.into(),
            columns: names,
            rows,
        }],
        comparison: vec![],
    }
}

/// The levels of interaction at which a method has attempts.
fn levels(attempts: &[Attempt], method: &str) -> Vec<&'static str> {
    let mut out = Vec::new();
    for attempt in attempts.iter().filter(|attempt| attempt.method == method) {
        if !out.contains(&attempt.interaction) {
            out.push(attempt.interaction);
        }
    }
    out.sort_by_key(|level| super::LEVELS.iter().position(|known| known.name() == *level));
    out
}

fn tint(verdict: Verdict) -> Tint {
    match verdict {
        Verdict::Branch => Tint::Colour(2),
        Verdict::OtherStable => Tint::Colour(5),
        Verdict::Stalled => Tint::Light,
        Verdict::Diverged => Tint::Dark,
        Verdict::Unstable => Tint::Colour(4),
        Verdict::Wrong => Tint::Colour(1),
    }
}
