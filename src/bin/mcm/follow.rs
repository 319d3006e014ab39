//! `mcm follow`: equilibria along a recorded path of inputs.

use std::path::PathBuf;
use std::process::ExitCode;

use mcm::fmi::Package;
use mcm::fmi::host_values::HostValues;
use mcm::fmi::value::Value;
use mcm::fmi::variable::{Causality, Variable};

use super::failure::{Failure, NOT_CONVERGED};
use super::files::{read_scene, refuse_same};
use super::numbers::{Numbers, did_you_mean};
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
        let fault = |title: &str| {
            let known = title == TIME || input(package, title).is_some();
            (!known).then(|| unknown(package, title))
        };
        let Numbers { titles, rows } = Numbers::read(&self.inputs, fault)?;

        let inputs: Vec<Option<&Variable>> = titles.iter().map(|title| input(package, title)).collect();
        let time = titles.iter().position(|title| title == TIME);
        let mut points: Vec<(Vec<f64>, HostValues)> = Vec::new();

        for row in rows {
            let mut values = package.start().clone();
            for (number, input) in row.cells.iter().zip(&inputs) {
                let set = input.map_or(Ok(()), |input| input.set(&mut values, Value::Real(*number)));
                set.map_err(|error| row.failure(error))?;
            }
            values.inputs().map_err(|error| row.failure(error))?;
            if let Some((time, (last, _))) = time.zip(points.last())
                && row.cells[time] <= last[time]
            {
                let (time, last) = (row.cells[time], last[time]);
                return Err(row.failure(format_args!("time = {time} does not come after {last}")));
            }
            points.push((row.cells, values));
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
    let suggested = did_you_mean(title, inputs.map(|row| row.name.clone()));
    format!("{title} is no input of this scene's FMU{suggested}")
}
