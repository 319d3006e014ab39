//! Targets from a table.

use std::path::Path;

use mcm::steer::Target;
use nalgebra::Vector3;

use crate::failure::Failure;
use crate::numbers::{Numbers, did_you_mean};

/// All columns that a table of targets may have.
const COLUMNS: [&str; 7] = [
    "tip_x_mm",
    "tip_y_mm",
    "tip_z_mm",
    "tip_direction_x",
    "tip_direction_y",
    "tip_direction_z",
    "alpha_deg",
];

/// Reads and checks all targets before anything moves.
pub(super) fn targets(path: &Path) -> Result<Vec<Target>, Failure> {
    let table = Numbers::read(path, |title| {
        let suggested = did_you_mean(title, COLUMNS.map(String::from));
        let known = COLUMNS.contains(&title);
        (!known).then(|| format!("{title} is no column of a table of targets{suggested}"))
    })?;

    let place = |column: &str| table.titles.iter().position(|title| title == column);
    let mut out = Vec::new();

    for line in &table.rows {
        let number = |column: &str| place(column).map(|place| line.cells[place]);
        let vector =
            |columns: &[&str]| match columns.iter().map(|column| number(column)).collect::<Vec<_>>()[..] {
                [Some(x), Some(y), Some(z)] => Ok(Some(Vector3::new(x, y, z))),
                [None, None, None] => Ok(None),
                _ => Err(line.failure(format_args!("not all of {}", columns.join(", ")))),
            };

        let target = Target {
            position: vector(&COLUMNS[..3])?.map(|position| position / 1e3),
            direction: vector(&COLUMNS[3..6])?,
            angle: number(COLUMNS[6]).map(f64::to_radians),
            force: None,
        };
        target.check().map_err(|error| line.failure(error))?;
        out.push(target);
    }
    Ok(out)
}
