//! Measured rows from a table.

use std::path::Path;

use mcm::fit::{Data, Measured, Quantity};
use mcm::manipulator::SceneFile;

use crate::failure::Failure;
use crate::numbers::{Numbers, did_you_mean};

/// What comes before the name of an output whose standard deviation a column holds.
const DEVIATION: &str = "sd_";

/// The rows, and the names of what was measured in each.
pub(super) struct Rows {
    pub(super) data: Data,
    pub(super) names: Vec<String>,
}

/// Reads and checks all rows before anything is solved; where `used` names outputs, other columns that are no inputs are left aside.
pub(super) fn read(path: &Path, file: &SceneFile, used: &[String]) -> Result<Rows, Failure> {
    for name in used {
        Quantity::named(name).map_err(|error| Failure(format!("--use: {error}{}", suggested(name))))?;
    }
    let is_input = |title: &str| title.contains('.');
    let table = Numbers::read(path, |title| {
        let output = title.strip_prefix(DEVIATION).unwrap_or(title);
        let wrong = !is_input(title) && used.is_empty() && Quantity::named(output).is_err();
        wrong.then(|| format!("{title} is no input of the scene and no output{}", suggested(output)))
    })?;
    let places = |wanted: &dyn Fn(&str) -> bool| -> Vec<usize> {
        (0..table.titles.len()).filter(|&place| wanted(&table.titles[place])).collect()
    };
    let inputs = places(&is_input);
    let outputs = places(&|title| {
        Quantity::named(title).is_ok() && (used.is_empty() || used.iter().any(|name| name == title))
    });
    if let Some(missing) = used.iter().find(|name| !table.titles.contains(name)) {
        return Err(Failure(format!("{} has no column {missing}", path.display())));
    }
    if outputs.is_empty() {
        return Err(Failure(format!("{} has no column with a measured output", path.display())));
    }
    let keys: Vec<&String> = inputs.iter().map(|&place| &table.titles[place]).collect();
    let mut data = Data::new(file, &keys).map_err(|error| Failure(format!("{}: {error}", path.display())))?;
    let deviation = |name: &str| table.titles.iter().position(|title| *title == format!("{DEVIATION}{name}"));
    for line in &table.rows {
        let values: Vec<f64> = inputs.iter().map(|&place| line.cells[place]).collect();
        let measured = outputs.iter().map(|&place| {
            let name = &table.titles[place];
            let deviation = deviation(name).map(|place| line.cells[place]);
            Ok(Measured { quantity: Quantity::named(name)?, value: line.cells[place], deviation })
        });
        let measured = measured.collect::<Result<Vec<_>, mcm::error::Error>>()?;
        data.add(&values, &measured).map_err(|error| line.failure(error))?;
    }
    Ok(Rows { data, names: outputs.iter().map(|&place| table.titles[place].clone()).collect() })
}

fn suggested(name: &str) -> String {
    did_you_mean(name, Quantity::all().map(Quantity::name))
}
