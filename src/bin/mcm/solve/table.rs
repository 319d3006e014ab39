//! The report of a solve as a table for people.

use mcm::manipulator::{Outputs, Status};
use nalgebra::Vector3;

use super::uncertainty::Told;
use crate::verdict;

/// A quantity with its components in a unit.
pub(super) struct Quantity {
    name: &'static str,
    pub(super) components: Vec<f64>,
    unit: &'static str,
}

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
        "unknown" => "stability unknown: this model has no potential",
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
            None => quantity.unit.into(),
        };
        let numbers: String = quantity.components.iter().map(|number| format!("{number:>12.4}")).collect();
        out += &row(quantity.name, &numbers, &unit);
    }
    if let Some(wall) = &outputs.wall {
        out += &row("contacts with the wall", &wall.count.to_string(), "");
    }
    out + &[
        row("stability margin", &format!("{:.4}", outputs.stability_margin), "of the unloaded shape's"),
        row("error estimate", &format!("{:.4}", outputs.error_estimate * 1e6), "um, of the tip position"),
        row("snaps", &outputs.snaps.to_string(), ""),
        row("energy", &format!("{:.4}", outputs.energy * 1e6), "uJ"),
    ]
    .concat()
}

fn row(name: &str, value: &str, unit: &str) -> String {
    format!("{name:<22} {value:>36}  {unit}\n")
}

/// What the shape and its forces are, in the units of the table.
pub(super) fn quantities(outputs: &Outputs) -> Vec<Quantity> {
    let number = |name, number: f64, unit| Quantity { name, components: vec![number], unit };
    let vector = |name, v: &Vector3<f64>, factor: f64, unit| Quantity {
        name,
        components: (v * factor).as_slice().to_vec(),
        unit,
    };
    let largest = outputs.core_angles.iter().copied().fold(0.0, f64::max);
    let mut out = vec![
        number("tip angle", outputs.tip_angle.to_degrees(), "deg"),
        vector("tip position", &outputs.tip.position, 1e3, "mm"),
        vector("tip direction", &outputs.tip.axis(), 1.0, ""),
        number("largest core angle", largest.to_degrees(), "deg"),
        vector("magnetic force", &outputs.magnetic_force, 1e3, "mN"),
        vector("magnetic torque", &outputs.magnetic_torque, 1e6, "mN.mm, about the base"),
        vector("base reaction force", &outputs.base_reaction_force, 1e3, "mN"),
        vector("base reaction moment", &outputs.base_reaction_moment, 1e6, "mN.mm"),
        vector("magnet reaction force", &outputs.magnet_reaction_force, 1e3, "mN"),
        vector("magnet reaction torque", &outputs.magnet_reaction_torque, 1e6, "mN.mm, about its centre"),
        vector("external field at tip", &outputs.tip_field, 1e3, "mT"),
    ];
    if let Some(wall) = &outputs.wall {
        out.push(vector("force of the wall", &wall.force, 1e3, "mN"));
        out.push(number("largest contact force", 1e3 * wall.largest_force, "mN"));
        out.push(number("largest indentation", 1e6 * wall.largest_indentation, "um"));
    }
    if let Some((length, push)) = outputs.feed_length.zip(outputs.feed_reaction) {
        out.push(number("inserted length", 1e3 * length, "mm"));
        out.push(number("push at the port", 1e3 * push, "mN"));
    }
    out
}
