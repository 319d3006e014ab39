//! Measured rows: inputs, outputs and how well each output is known.

use super::columns::Column;
use super::measurable::Measurable;
use crate::error::{Error, check};
use crate::manipulator::SceneFile;

/// A table of measured rows.
///
/// Columns are inputs (keys of the scene such as `field.uniform_mt[2]`, or inputs of the FMU such as `field.uniform[2]`), outputs by
/// the names of `mcm sweep` ([`Measurable`]), and `sd_` before the name of an output: the standard deviation of its values. An empty
/// cell of an output was not measured.
///
/// ```
/// use mcm::fit::Measurements;
/// use mcm::manipulator::SceneFile;
/// let scene = SceneFile::parse("[design]\nsegments = 1", "example")?;
/// let titles = ["field.uniform_mt[2]", "alpha_deg", "sd_alpha_deg"];
/// let rows = [(2, vec!["5", "8.1", "0.2"]), (3, vec!["10", "16.3", "0.2"])];
/// let measured = Measurements::parse(&scene, &titles, rows)?;
/// assert_eq!(measured.rows().len(), 2);
/// let refused = Measurements::parse(&scene, &titles, [(2, vec!["5", "nan", "0.2"])]).unwrap_err();
/// assert_eq!(refused.to_string(), "line 2: alpha_deg = \"nan\" is not a finite number");
/// # Ok::<(), mcm::error::Error>(())
/// ```
#[derive(Debug, Clone)]
pub struct Measurements {
    keys: Vec<String>,
    outputs: Vec<Measurable>,
    rows: Vec<Row>,
    ignored: Vec<String>,
}

/// One measured row.
#[derive(Debug, Clone, PartialEq)]
pub struct Row {
    /// Line of the table, for messages.
    pub line: u64,
    /// Values of the inputs, in the units of the scene.
    pub inputs: Vec<f64>,
    /// Values of the outputs; `None` where not measured.
    pub measured: Vec<Option<f64>>,
    /// Their standard deviations; `None` where not stated.
    pub deviations: Vec<Option<f64>>,
}

impl Measurements {
    /// Reads rows of cells, each with its line, under these titles.
    ///
    /// # Errors
    /// [`Error::Unsupported`] for a title that means nothing or stands twice, a table without rows or without measured values;
    /// [`Error::Syntax`] naming line and column of a cell that is no finite number, or of a deviation that is missing or not positive.
    pub fn parse<'a>(
        scene: &SceneFile,
        titles: &[&str],
        rows: impl IntoIterator<Item = (u64, Vec<&'a str>)>,
    ) -> Result<Self, Error> {
        let columns = titles.iter().enumerate().map(|(number, title)| {
            if titles[..number].contains(title) {
                return Err(Error::Unsupported(format!("two columns `{title}`")));
            }
            Column::of(title, scene)
        });
        let columns = columns.collect::<Result<Vec<_>, _>>()?;

        let mut out = Self { keys: Vec::new(), outputs: Vec::new(), rows: Vec::new(), ignored: Vec::new() };
        for (column, title) in columns.iter().zip(titles) {
            match column {
                Column::Input { key, .. } => out.keys.push(key.clone()),
                Column::Measured(output) => out.outputs.push(*output),
                Column::Ignored => out.ignored.push((*title).to_owned()),
                Column::Deviation(_) => {}
            }
        }

        if out.outputs.is_empty() {
            return Err(Error::Unsupported(
                "no column is an output that can be measured, such as alpha_deg or tip_y_mm".into(),
            ));
        }

        for column in &columns {
            if let Column::Deviation(output) = column
                && out.place(output.name()).is_none()
            {
                let name = output.name();
                return Err(Error::Unsupported(format!("column `sd_{name}` without a column `{name}`")));
            }
        }

        for (line, cells) in rows {
            let row = out.row(line, &cells, titles, &columns)?;
            out.rows.push(row);
        }
        if out.rows.is_empty() {
            return Err(Error::Unsupported("the table of measured values has no rows".into()));
        }
        if out.count() == 0 {
            return Err(Error::Unsupported("no row holds a measured value".into()));
        }

        Ok(out)
    }

    fn row(&self, line: u64, cells: &[&str], titles: &[&str], columns: &[Column]) -> Result<Row, Error> {
        let at = |reason: String| Error::Syntax { what: format!("line {line}"), reason };

        if cells.len() != titles.len() {
            return Err(at(format!("{} cells under {} titles", cells.len(), titles.len())));
        }
        let count = self.outputs.len();
        let mut row =
            Row { line, inputs: Vec::new(), measured: vec![None; count], deviations: vec![None; count] };

        for ((cell, title), column) in cells.iter().zip(titles).zip(columns) {
            let number = || {
                let number = cell.trim().parse().ok().filter(|number: &f64| number.is_finite());
                number.ok_or_else(|| at(format!("{title} = \"{cell}\" is not a finite number")))
            };

            let place = |output: &Measurable| self.place(output.name()).unwrap_or_default();
            match column {
                Column::Input { factor, .. } => row.inputs.push(number()? * factor),
                Column::Measured(output) if !cell.trim().is_empty() => {
                    row.measured[place(output)] = Some(number()?);
                }
                Column::Deviation(output) if !cell.trim().is_empty() => {
                    let value = check(title, number()?, |v| v > 0.0, "> 0");
                    row.deviations[place(output)] = Some(value.map_err(|error| at(error.to_string()))?);
                }
                _ => {}
            }
        }

        Ok(row)
    }

    fn place(&self, output: &str) -> Option<usize> {
        self.outputs.iter().position(|own| own.name() == output)
    }

    /// These rows where values of `output` without a deviation of their own have this one.
    ///
    /// # Errors
    /// [`Error::Unsupported`] for an output that is not measured, [`Error::Range`] for a deviation that is not positive.
    pub fn with_deviation(mut self, output: &str, deviation: f64) -> Result<Self, Error> {
        check(&format!("standard deviation of {output}"), deviation, |v| v > 0.0, "> 0")?;
        let place = self.place(output);
        let place = place.ok_or_else(|| Error::Unsupported(format!("`{output}` is no measured column")))?;
        for row in &mut self.rows {
            row.deviations[place].get_or_insert(deviation);
        }
        Ok(self)
    }

    /// The keys of the inputs.
    #[must_use]
    pub fn keys(&self) -> &[String] {
        &self.keys
    }

    /// What was measured.
    #[must_use]
    pub fn outputs(&self) -> &[Measurable] {
        &self.outputs
    }

    /// The rows.
    #[must_use]
    pub fn rows(&self) -> &[Row] {
        &self.rows
    }

    /// Titles of columns that are neither inputs nor measured.
    #[must_use]
    pub fn ignored(&self) -> &[String] {
        &self.ignored
    }

    /// Some rows again, with another value of an input.
    pub(super) fn repeated(
        &self,
        rows: &[&Row],
        key: &str,
        otherwise: f64,
        change: impl Fn(f64) -> f64,
    ) -> Self {
        let mut keys = self.keys.clone();
        let place = keys.iter().position(|own| own == key).unwrap_or(keys.len());
        if place == keys.len() {
            keys.push(key.to_owned());
        }
        let changed = |row: &&Row| {
            let mut row = (*row).clone();
            row.inputs.resize(keys.len(), otherwise);
            row.inputs[place] = change(row.inputs[place]);
            row
        };
        let rows = rows.iter().map(changed).collect();
        Self { keys, rows, outputs: self.outputs.clone(), ignored: Vec::new() }
    }

    /// Number of measured values.
    #[must_use]
    pub fn count(&self) -> usize {
        self.rows.iter().flat_map(|row| &row.measured).flatten().count()
    }

    /// Whether the deviations are stated: of all values or of none.
    ///
    /// # Errors
    /// [`Error::Unsupported`] where some are, or none is and the outputs have different units.
    pub fn stated(&self) -> Result<bool, Error> {
        let values = self.rows.iter().flat_map(|row| row.measured.iter().zip(&row.deviations));
        let (count, with) = values.fold((0, 0), |(count, with), (measured, deviation)| {
            (
                count + usize::from(measured.is_some()),
                with + usize::from(measured.is_some() && deviation.is_some()),
            )
        });
        let units_differ = self.outputs.iter().any(|output| output.unit() != self.outputs[0].unit());
        if count == with {
            return Ok(true);
        }
        if with > 0 || units_differ {
            let why = if with > 0 { "some values have one" } else { "the outputs have different units" };
            let name = self.outputs[0].name();
            return Err(Error::Unsupported(format!(
                "say how well each output is measured, by columns such as sd_{name} or by --sigma {name}=0.1, ...: {why}"
            )));
        }
        Ok(false)
    }
}
