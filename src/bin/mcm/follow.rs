//! `mcm follow`: equilibria along a recorded path of inputs.

use std::path::PathBuf;
use std::process::ExitCode;

use mcm::fmi::Package;
use mcm::fmi::host_values::HostValues;
use mcm::fmi::value::Value;
use mcm::fmi::variable::{Causality, Variable};

use super::failure::{Failure, NOT_CONVERGED};
use super::files::{bad_table, open_table, read_scene, refuse_same};
use super::nearest::nearest;
use super::output::{Table, print, warn};
use super::progress::progress_bar;
use super::sweep::{Columns, Row, Way};

/// Name of the column that orders the rows and is no input.
const TIME: &str = "time";

/// Fewest points of the centreline that a table of variables can have; none of them is written.
const SHAPE_POINTS: usize = 2;

/// Follows the equilibrium along a path of inputs, row by row, as an FMU of the scene does
#[derive(clap::Args)]
#[command(
    after_help = "PATH.csv has a row for each point of the path and a column for each input that moves, by its name in the FMU and in \
SI units: magnet.position[1], magnet.orientation[1], field.uniform[2], feed.insertion, ... Other inputs keep the scene's values. \
A column time (s) must grow; without it rows have none. It is the table that fmpy takes as input and that the live page exports.\n\n\
The first row is solved from the unloaded shape, every further one from the shape of the row before. The table written has the \
columns of PATH.csv, then those of `mcm sweep`. After a row that does not converge the next one starts from the last good shape.\n\n\
Example: mcm follow scene.toml --inputs path.csv --out shapes.csv\n\n\
Exit status: 0 done, 1 bad input, 2 some rows did not converge (the table is written)."
)]
pub(crate) struct Follow {
    /// Scene file (TOML)
    scene: PathBuf,
    /// CSV file with the inputs
    #[arg(long, value_name = "PATH.csv")]
    inputs: PathBuf,
    /// CSV file for the results
    #[arg(long, value_name = "OUT.csv")]
    out: PathBuf,
}

impl Follow {
    /// Runs the command.
    pub(crate) fn run(&self) -> Result<ExitCode, Failure> {
        refuse_same(&[&self.scene, &self.inputs], &[&self.out])?;
        let file = read_scene(&self.scene)?;
        let package = Package::of(&file, SHAPE_POINTS)?;
        let path = self.path(&package)?;
        let mut table = Table::at(&self.out)?;
        let columns = Columns::of(&file.scene()?);
        table.header(columns.header(path.titles.iter().map(String::as_str)))?;
        let mut manipulator = package.start().manipulator(SHAPE_POINTS)?;
        let bar = progress_bar(path.points.len() as u64, "points");
        let mut lost = Vec::new();
        for (cells, values) in path.points {
            let outputs = manipulator.solve(&values.inputs()?)?;
            let row = Row::new(columns, cells, Way::Forth, outputs, None);
            table.row(row.cells())?;
            if !row.converged() {
                lost.push(row);
            }
            bar.inc(1);
        }
        bar.finish_and_clear();
        table.complete()?;
        let snaps = manipulator.outputs().snaps;
        print(format!("{}: {} rows, snaps: {snaps}\n", self.out.display(), bar.position()))?;
        let Some(first) = lost.first() else { return Ok(ExitCode::SUCCESS) };
        let (count, key, value, reason) = (lost.len(), &path.titles[0], first.value(), first.reason());
        warn(&format!(
            "{count} rows did not converge and hold no shape; the first at {key} = {value}: {reason}"
        ));
        Ok(NOT_CONVERGED.into())
    }

    /// Reads and checks the whole path before anything is solved.
    fn path(&self, package: &Package) -> Result<Path, Failure> {
        let name = self.inputs.display();
        let mut table = open_table(&self.inputs)?;
        let header = table.headers().map_err(|error| bad_table(&self.inputs, &error))?.clone();
        let titles: Vec<String> = header.iter().map(str::to_owned).collect();
        let inputs = titles.iter().enumerate().map(|(number, title)| match input(package, title) {
            _ if titles[..number].contains(title) => Err(Failure(format!("{name} has two columns {title}"))),
            None if title != TIME => Err(Failure(format!("{name}: {}", unknown(package, title)))),
            found => Ok(found),
        });
        let inputs = inputs.collect::<Result<Vec<_>, _>>()?;
        let mut points: Vec<(Vec<f64>, HostValues)> = Vec::new();
        for record in table.records() {
            let record = record.map_err(|error| bad_table(&self.inputs, &error))?;
            let at = || format!("{name}, line {}", record.position().map_or(0, csv::Position::line));
            let (mut cells, mut values) = (Vec::new(), package.start().clone());
            for ((text, title), input) in record.iter().zip(&titles).zip(&inputs) {
                let number = text.parse().ok().filter(|number: &f64| number.is_finite());
                let number = number.ok_or_else(|| {
                    Failure(format!("{}: {title} = \"{text}\" is not a finite number", at()))
                })?;
                let set = input.map_or(Ok(()), |input| input.set(&mut values, Value::Real(number)));
                set.map_err(|error| Failure(format!("{}: {error}", at())))?;
                cells.push(number);
            }
            values.inputs().map_err(|error| Failure(format!("{}: {error}", at())))?;
            if let (Some(time), Some((last, _))) =
                (titles.iter().position(|title| title == TIME), points.last())
                && cells[time] <= last[time]
            {
                return Err(Failure(format!(
                    "{}: time = {} does not come after {}",
                    at(),
                    cells[time],
                    last[time]
                )));
            }
            points.push((cells, values));
        }
        if points.is_empty() {
            return Err(Failure(format!("{name} has no rows")));
        }
        Ok(Path { titles, points })
    }
}

/// The path that is followed.
struct Path {
    titles: Vec<String>,
    /// The cells of each row as they were read, and the values that they mean.
    points: Vec<(Vec<f64>, HostValues)>,
}

/// The input with this name.
fn input<'a>(package: &'a Package, name: &str) -> Option<&'a Variable> {
    let variable = package.table().find(package.table().reference(name)?)?;
    (variable.causality == Causality::Input).then_some(variable)
}

fn unknown(package: &Package, title: &str) -> String {
    let inputs = package.table().variables().iter().filter(|row| row.causality == Causality::Input);
    let nearest = nearest(title, inputs.map(|row| row.name.clone()));
    let suggested = nearest.map_or(String::new(), |name| format!("; did you mean {name}?"));
    format!("{title} is no input of this scene's FMU{suggested}")
}
