//! The report of a solve as a table for people.

use mcm::manipulator::{Outputs, Status};

use super::quantities::quantities;
use super::uncertainty::Told;
use crate::verdict;

/// The table; with the bands of its quantities where they are told.
pub(super) fn as_table(outputs: &Outputs, told: Option<&Told>) -> String {
    let search = format!(
        "{} iterations, residual {:.1e}, interaction {}\n",
        outputs.iterations,
        outputs.residual,
        outputs.interaction.name()
    );

    let Some(stability) = verdict::stability(outputs) else {
        return format!(
            "not converged; {search}\n{}{}",
            row("outcome", &outputs.outcome.name().replace('_', " "), ""),
            row(
                "progress",
                &format!("{:.1}", 100.0 * outputs.progress),
                "% of the way from the unloaded shape"
            )
        );
    };

    let status = match (outputs.status, stability) {
        (Status::NearFold, "stable") => "solved, close to a fold: a little more load and the shape snaps",
        (Status::Snapped, _) => "solved, after a snap to another branch",
        _ => "solved",
    };
    let stable = match stability {
        "neutral" => "neutral: one direction is free",
        "unknown" => "stability unknown: this method does not compute it",
        known => known,
    };

    let mut out = format!("{status}; {stable}; {search}\n");
    let bands = told.map(Told::of_table);
    for (index, quantity) in quantities(outputs).iter().enumerate() {
        let unit = match bands.as_ref().and_then(|bands| bands.get(index)) {
            Some(band) => {
                let band: Vec<String> = band.iter().map(|half| format!("{half:.4}")).collect();
                format!("\u{b1} {}  {}", band.join(" "), quantity.unit)
            }
            None => quantity.unit.clone(),
        };
        let numbers: Vec<String> =
            quantity.components.iter().map(|number| format!("{number:>12.4}")).collect();
        out += &row(&quantity.name, &numbers.concat(), &unit);
    }

    if let Some(wall) = &outputs.wall {
        out += &row("contacts with the wall", &wall.count.to_string(), "");
    }
    out + &[
        row("stability margin", &format!("{:.4}", outputs.stability_margin), "of the elastic stiffness"),
        row("error estimate", &format!("{:.4}", outputs.error_estimate * 1e6), "um, of the tip position"),
        row("snaps", &outputs.snaps.to_string(), ""),
        row("energy", &format!("{:.4}", outputs.energy * 1e6), "uJ"),
    ]
    .concat()
}

fn row(name: &str, value: &str, unit: &str) -> String {
    format!("{name:<22} {value:>36}  {unit}\n")
}
