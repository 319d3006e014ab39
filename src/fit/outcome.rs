//! What a fit found.

use nalgebra::{DMatrix, DVector};

use super::devices::with;
use super::directions::{Direction, Told};
use super::estimate::{Estimate, Settings};
use super::experiments::{Experiment, proposed};
use super::intervals::Profile;
use super::loss::Loss;
use super::measurements::Measurements;
use super::problem::Problem;
use super::scatter::Scatter;
use crate::error::Error;
use crate::manipulator::{SceneFile, Status, Uncertainty};

/// A fitted parameter.
#[derive(Debug, Clone, PartialEq)]
pub struct Parameter {
    /// Its key in the scene.
    pub key: String,
    /// Its value in the scene, where the fit started.
    pub start: f64,
    /// Its fitted value, in the unit of the scene.
    pub value: f64,
    /// Its standard deviation; `None` where the rows do not tell it, and where nothing is left to estimate it from.
    pub deviation: Option<f64>,
    /// The ends of its interval of 95 %; `None` where its range ends first or the rows do not tell.
    pub interval: [Option<f64>; 2],
    /// Whether it lies at the end of its range, where the rows would have it beyond.
    pub at_limit: bool,
}

/// A measured value beside the computed one.
#[derive(Debug, Clone, PartialEq)]
pub struct Cell {
    /// Line of the row in the table.
    pub line: u64,
    /// Name of the output.
    pub output: &'static str,
    /// Its value as measured.
    pub measured: f64,
    /// Its value as computed for the fitted parameters.
    pub computed: f64,
    /// Measured minus computed, in standard deviations.
    pub residual: f64,
    /// How much it counts: 1, or less by a robust loss.
    pub weight: f64,
}

/// Parameters of a device from measured rows.
///
/// ```
/// use mcm::fit::{Fit, Measurements, Settings};
/// use mcm::manipulator::SceneFile;
/// let scene = SceneFile::parse("[design]\nsegments = 1\n[field]\n[model]\ninteraction = \"rings\"", "example")?;
/// // Three angles of a device that is softer than the scene says.
/// let mut softer = Vec::new();
/// for field in ["5", "10", "15"] {
///     let varied = scene.with("design.helix.shore_a", 31.0)?.with("field.uniform_mt[2]", field.parse().unwrap_or(0.0))?;
///     let varied = varied.scene()?;
///     let angle = varied.manipulator(2)?.solve(&varied.inputs)?.tip_angle.to_degrees();
///     softer.push((field, angle.to_string()));
/// }
/// let rows = softer.iter().zip(2..).map(|((field, angle), line)| (line, vec![*field, angle.as_str()]));
/// let measured = Measurements::parse(&scene, &["field.uniform_mt[2]", "alpha_deg"], rows)?;
/// let fit = Fit::new(&scene, &["design.helix.shore_a"], &measured, &Settings::default())?;
/// assert!((fit.parameters[0].value - 31.0).abs() < 1e-5);
/// # Ok::<(), mcm::error::Error>(())
/// ```
#[derive(Debug, Clone)]
pub struct Fit {
    /// The parameters, in the order given.
    pub parameters: Vec<Parameter>,
    /// Correlation of the parameters; rows of parameters without a deviation are those of the identity.
    pub correlation: DMatrix<f64>,
    /// Standard deviation of the residuals: in the unit of the outputs where none is stated, else relative to those stated.
    pub scatter: f64,
    /// Whether the deviations of the measured values are stated.
    pub stated: bool,
    /// Where they are stated, the probability that residuals are at least as large by chance.
    pub probability: Option<f64>,
    /// Measured values less parameters.
    pub freedoms: usize,
    /// The values that counted.
    pub cells: Vec<Cell>,
    /// Lines of rows that do not count, and why.
    pub lost: Vec<(u64, String)>,
    /// Lines of rows that count, with what makes them doubtful.
    pub doubtful: Vec<(u64, String)>,
    /// What the rows cannot tell apart.
    pub directions: Vec<Direction>,
    /// Further rows that would, best first.
    pub experiments: Vec<Experiment>,
    /// Number of steps.
    pub steps: usize,
    /// Whether the steps have come to an end.
    pub converged: bool,
    file: SceneFile,
}

impl Fit {
    /// Fits the numbers of the scene `file` at these keys, from their values there.
    ///
    /// # Errors
    /// [`Error::Unsupported`] for no key, keys that are no numbers or that the rows give, more parameters than measured values,
    /// deviations that are stated for some values only, and a method without derivatives; those of the scenes of rows.
    pub fn new(
        file: &SceneFile,
        keys: &[impl AsRef<str>],
        measured: &Measurements,
        settings: &Settings,
    ) -> Result<Self, Error> {
        let keys: Vec<String> = keys.iter().map(|key| key.as_ref().to_owned()).collect();
        checked(&keys, measured)?;
        let stated = measured.stated()?;
        let start = keys.iter().map(|key| file.number(key)).collect::<Result<Vec<_>, _>>()?;
        let start = DVector::from_vec(start);
        // Refuses keys without derivatives before anything is solved.
        crate::manipulator::Neighbours::new(file, &keys)?;
        let problem = Problem::new(file, &keys, measured)?;
        let found = Estimate::of(&problem, &start, settings, stated)?;
        let task = Task { file, keys: &keys, start: &start, measured, settings, problem: &problem };
        Self::told(&task, &found)
    }

    fn told(task: &Task<'_>, found: &Estimate) -> Result<Self, Error> {
        let &Task { file, keys, measured, settings, problem, .. } = task;
        let Estimate { parameters, shapes, .. } = found;
        let scatter = Scatter::of(found, settings.loss, measured.stated()?);
        let told = Told::of(&counted(found, settings.loss), parameters, keys, scatter.scale);
        let covariance = &told.covariance * (scatter.scale * scatter.scale);
        let out = task.parameters(found, &told, &covariance, &scatter);

        let experiments = if told.directions.is_empty() {
            Vec::new()
        } else {
            let scale = if scatter.scale > 0.0 { scatter.scale } else { 1.0 };
            proposed(file, keys, measured, found, scale)?
        };

        let rows = measured.rows();
        let reasons = rows.iter().zip(&found.reasons);
        let lost = reasons.filter_map(|(row, reason)| Some((row.line, reason.clone()?))).collect();
        let doubt =
            |(row, shape): (&super::Row, &Option<_>)| doubt(shape.as_ref()?).map(|why| (row.line, why));

        Ok(Self {
            correlation: correlation(&covariance, &out),
            parameters: out,
            scatter: scatter.residuals,
            stated: scatter.stated,
            probability: scatter.probability(settings.loss),
            freedoms: scatter.freedoms,
            cells: cells(problem, found, measured, settings.loss),
            lost,
            doubtful: rows.iter().zip(shapes).filter_map(doubt).collect(),
            directions: told.directions,
            experiments,
            steps: found.steps,
            converged: found.converged,
            file: with(file, keys, parameters.as_slice())?,
        })
    }

    /// The scene with the fitted values, and their standard deviations and correlations in place of any that it had.
    ///
    /// Parameters that the rows do not tell are not among those of `[uncertainty]`.
    ///
    /// # Errors
    /// As [`SceneFile::with_uncertainty`].
    pub fn scene(&self) -> Result<SceneFile, Error> {
        let known =
            |index: &usize| self.parameters[*index].deviation.is_some_and(|deviation| deviation > 0.0);
        let known: Vec<usize> = (0..self.parameters.len()).filter(known).collect();
        let keys: Vec<String> = known.iter().map(|&index| self.parameters[index].key.clone()).collect();
        let deviations: Vec<f64> =
            known.iter().filter_map(|&index| self.parameters[index].deviation).collect();
        let correlation =
            DMatrix::from_fn(known.len(), known.len(), |i, j| self.correlation[(known[i], known[j])]);
        self.file.with_uncertainty(&Uncertainty::new(&keys, &deviations, &correlation)?)
    }
}

/// What is fitted to what.
#[derive(Clone, Copy)]
struct Task<'a> {
    file: &'a SceneFile,
    keys: &'a [String],
    /// Values of the scene at these keys.
    start: &'a DVector<f64>,
    measured: &'a Measurements,
    settings: &'a Settings,
    problem: &'a Problem<'a>,
}

impl Task<'_> {
    /// The parameters that were found, with deviations and intervals; `covariance` is that of residuals with this scatter.
    fn parameters(
        &self,
        found: &Estimate,
        told: &Told,
        covariance: &DMatrix<f64>,
        scatter: &Scatter,
    ) -> Vec<Parameter> {
        let quantile = scatter.quantile();
        let profile = Profile {
            problem: self.problem,
            parameters: &found.parameters,
            shapes: &found.shapes,
            jacobian: &found.jacobian,
            covariance: &told.covariance,
            smallest: scatter.sum,
            threshold: (quantile * scatter.scale).powi(2),
        };
        // Profiles follow the sum of squares: other losses, and directions that nothing determines, have none.
        let Settings { loss, profiles, .. } = self.settings;
        let profiles = *profiles && *loss == Loss::Squares && told.directions.is_empty();

        let mut out = Vec::new();
        for (index, key) in self.keys.iter().enumerate() {
            let (value, at_limit) = (found.parameters[index], found.at_limit[index]);
            let known = told.known[index] && scatter.is_known() && !at_limit;
            let deviation = known.then(|| covariance[(index, index)].sqrt());
            let interval = match deviation {
                Some(deviation) if !profiles || profile.threshold == 0.0 => {
                    [-1.0, 1.0].map(|side| Some(value + side * quantile * deviation))
                }
                Some(_) => profile.interval(index),
                None => [None; 2],
            };
            let (key, start) = (key.clone(), self.start[index]);
            out.push(Parameter { key, start, value, deviation, interval, at_limit });
        }
        out
    }
}

fn checked(keys: &[String], measured: &Measurements) -> Result<(), Error> {
    if keys.is_empty() {
        return Err(Error::Unsupported("nothing to fit: no key is named".into()));
    }
    if let Some(given) = keys.iter().find(|key| measured.keys().contains(key)) {
        return Err(Error::Unsupported(format!("`{given}` cannot be fitted: the rows give its values")));
    }
    if measured.count() < keys.len() {
        let (count, values) = (keys.len(), measured.count());
        return Err(Error::Unsupported(format!(
            "{count} parameters need as many measured values: there are only {values}"
        )));
    }
    Ok(())
}

/// The derivatives of the residuals that count in full.
fn counted(found: &Estimate, loss: Loss) -> DMatrix<f64> {
    let mut out = found.jacobian.clone();
    for (mut row, residual) in out.row_iter_mut().zip(&found.residuals) {
        if !loss.is_inside(residual / found.scale) {
            row.fill(0.0);
        }
    }
    out
}

fn correlation(covariance: &DMatrix<f64>, parameters: &[Parameter]) -> DMatrix<f64> {
    let deviation = |index: usize| parameters[index].deviation.filter(|deviation| *deviation > 0.0);
    DMatrix::from_fn(parameters.len(), parameters.len(), |i, j| match (deviation(i), deviation(j)) {
        _ if i == j => 1.0,
        (Some(a), Some(b)) => (covariance[(i, j)] / (a * b)).clamp(-1.0, 1.0),
        _ => 0.0,
    })
}

fn cells(problem: &Problem, found: &Estimate, measured: &Measurements, loss: Loss) -> Vec<Cell> {
    let observed = problem.observations(&found.shapes).zip(&found.residuals);
    let cell = |(each, residual): (&super::problem::Observation, &f64)| Cell {
        line: measured.rows()[each.row].line,
        output: each.output.name(),
        measured: each.value,
        computed: each.value + residual * each.deviation,
        residual: -residual / found.scale,
        weight: loss.weight(residual / found.scale),
    };
    observed.map(cell).collect()
}

/// What makes a solved row doubtful.
fn doubt(shape: &crate::manipulator::Manipulator) -> Option<String> {
    let outputs = shape.outputs();
    if outputs.snaps > 0 {
        Some("lies past a fold: the shape snaps on the way from the unloaded one".into())
    } else if outputs.status == Status::NearFold {
        Some("lies near a fold".into())
    } else {
        None
    }
}
