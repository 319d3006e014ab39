//! The fit, and what it tells.

use nalgebra::{Cholesky, DMatrix, DVector};

use super::data::Data;
use super::descent::Weighted;
use super::identifiability::{Untold, untold};
use super::noise::Noise;
use super::problem::Problem;
use super::profile::intervals;
use crate::error::Error;
use crate::manipulator::{SceneFile, Uncertainty};

/// Rounds in which the deviations of the measured numbers, or the weights of outliers, settle.
const ROUNDS: usize = 12;

/// Change of the deviations and weights that counts as settled.
const SETTLED: f64 = 1e-2;

/// Standard deviations beyond which a residual counts less by Huber's loss: 95 % as efficient for normal noise (Huber 1964,
/// doi 10.1214/aoms/1177703732).
const HUBER: f64 = 1.345;

/// Median of the absolute value of a normal variable of deviation 1.
const MEDIAN: f64 = 0.674_489_750_196_081_7;

/// How residuals count.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum Loss {
    /// By their squares.
    #[default]
    Squares,
    /// Beyond 1.345 deviations by their size only (Huber): single outliers do not spoil the fit.
    Huber,
}

/// What to compute.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Options {
    /// How residuals count.
    pub loss: Loss,
    /// Whether profile likelihood intervals are computed, which takes some more fits for each parameter.
    pub profiles: bool,
}

impl Default for Options {
    fn default() -> Self {
        Self { loss: Loss::Squares, profiles: true }
    }
}

/// Fitted parameters.
///
/// ```
/// use mcm::fit::{Data, Fit, Measured, Options, Quantity};
/// use mcm::manipulator::SceneFile;
/// let text = "[design]\nsegments = 1\n[field]\n[model]\ninteraction = \"rings\"";
/// let file = SceneFile::parse(text, "example")?;
/// let angle = Quantity::named("alpha_deg")?;
/// let mut data = Data::new(&file, &["field.uniform_mt[2]"])?;
/// for (field, value) in [(5.0, 10.2), (10.0, 19.6), (15.0, 27.9), (20.0, 35.1)] {
///     data.add(&[field], &[Measured { quantity: angle, value, deviation: Some(0.2) }])?;
/// }
/// let fit = Fit::new(&file, &["design.helix.shore_a"], &data, Options::default())?;
/// assert!((fit.values()[0] - 32.6).abs() < 0.2 && fit.deviations()[0] < 0.2);
/// # Ok::<(), mcm::error::Error>(())
/// ```
#[derive(Debug, Clone)]
pub struct Fit {
    keys: Vec<String>,
    start: DVector<f64>,
    values: DVector<f64>,
    covariance: Option<DMatrix<f64>>,
    intervals: Vec<Option<[f64; 2]>>,
    computed: DVector<f64>,
    residuals: DVector<f64>,
    noise: Noise,
    untold: Vec<Untold>,
    steps: usize,
    fitted: SceneFile,
}

impl Fit {
    /// Fits the numbers of the scene at `keys` to the data, from the scene's values.
    ///
    /// # Errors
    /// [`Error::Count`] for fewer measured numbers than parameters, or no parameters; [`Error::Unsupported`] where the model has no shape
    /// at a row to begin with; those of [`crate::manipulator::Neighbours::new`]; [`Error::NoDerivatives`] at a fold.
    pub fn new(
        file: &SceneFile,
        keys: &[impl AsRef<str>],
        data: &Data,
        options: Options,
    ) -> Result<Self, Error> {
        let keys: Vec<String> = keys.iter().map(|key| key.as_ref().to_owned()).collect();
        let count = data.measured().count();
        let too_few = |quantity: &str, given, expected: &str| {
            Err(Error::Count { quantity: quantity.into(), given, expected: expected.into() })
        };
        if keys.is_empty() {
            return too_few("parameters to fit", 0, "at least one");
        }
        if count < keys.len() {
            let expected = format!("at least {}, one for each parameter", keys.len());
            return too_few("measured numbers", count, &expected);
        }
        let start = keys.iter().map(|key| file.number(key)).collect::<Result<Vec<_>, _>>()?;
        let start = DVector::from_vec(start);
        let sizes = start.map(|value| if value == 0.0 { 1.0 } else { value.abs() });
        let mut noise = Noise::of(data)?;
        let problem = Problem { file, keys: &keys, data };
        let mut loss = DVector::repeat(count, 1.0);
        let (mut point, mut steps, mut round) = (problem.at(&start)?, 0, 0);
        let (weighted, minimum) = loop {
            let weights = loss.map(f64::sqrt).component_div(&noise.deviations);
            let weighted = Weighted { problem: problem.clone(), weights, sizes: sizes.clone() };
            let minimum = weighted.minimum(point, None)?;
            steps += minimum.steps;
            let missing =
                weighted.residuals(&minimum.point.answers.computed).component_div(&weighted.weights);
            let before = (noise.deviations.clone(), loss.clone());
            noise.estimated(data, &missing, &leverages(&weighted.scaled(&minimum.point.rates)));
            if options.loss == Loss::Huber {
                loss = huber(&missing.component_div(&noise.deviations), noise.known);
            }
            round += 1;
            // A common factor of all deviations moves nothing.
            let ratios = noise.deviations.component_div(&before.0);
            let moved = ratios.max() / ratios.min() - 1.0 + (&loss - &before.1).amax();
            if moved < SETTLED || round == ROUNDS {
                break (weighted, minimum);
            }
            point = minimum.point;
        };
        // From here on with the deviations and weights of the last round.
        let weights = loss.map(f64::sqrt).component_div(&noise.deviations);
        let weighted = Weighted { weights, ..weighted };
        let scaled = weighted.scaled(&minimum.point.rates);
        let untold = untold(&weighted, &minimum, &scaled)?;
        let covariance = if untold.is_empty() { covariance(&scaled, &sizes) } else { None };
        let computed = minimum.point.answers.computed.clone();
        let residuals = DVector::from_iterator(count, data.measured().map(|each| each.value)) - &computed;
        let mut fit = Self {
            start,
            covariance,
            intervals: vec![None; keys.len()],
            computed,
            residuals,
            noise,
            untold,
            steps,
            fitted: problem.scene(&minimum.point.values)?,
            values: minimum.point.values.clone(),
            keys: keys.clone(),
        };
        if options.profiles && fit.covariance.is_some() {
            let known = fit.noise.known;
            fit.intervals = intervals(&weighted, &minimum, &fit.deviations(), known)?;
        }
        if fit.covariance.is_some() {
            fit.fitted = fit.fitted.with_uncertainty(&fit.uncertainty()?)?;
        }
        Ok(fit)
    }

    /// The keys of the parameters.
    #[must_use]
    pub fn keys(&self) -> &[String] {
        &self.keys
    }

    /// The scene's values, from which the fit began, in the units of the keys.
    #[must_use]
    pub fn start(&self) -> &[f64] {
        self.start.as_slice()
    }

    /// The fitted values.
    #[must_use]
    pub fn values(&self) -> &[f64] {
        self.values.as_slice()
    }

    /// Covariance of the fitted values; `None` where the rows do not tell them, see [`Self::untold`].
    #[must_use]
    pub fn covariance(&self) -> Option<&DMatrix<f64>> {
        self.covariance.as_ref()
    }

    /// Standard deviations of the fitted values; infinite without a covariance.
    #[must_use]
    pub fn deviations(&self) -> Vec<f64> {
        let own = |index| self.covariance.as_ref().map_or(f64::INFINITY, |c| c[(index, index)].sqrt());
        (0..self.keys.len()).map(own).collect()
    }

    /// Profile likelihood intervals of 95 %; `None` where a limit was not found, or not asked for.
    #[must_use]
    pub fn intervals(&self) -> &[Option<[f64; 2]>] {
        &self.intervals
    }

    /// What the fitted model gives for each measured number, row by row, in its unit.
    #[must_use]
    pub fn computed(&self) -> &[f64] {
        self.computed.as_slice()
    }

    /// Measured less computed numbers.
    #[must_use]
    pub fn residuals(&self) -> &[f64] {
        self.residuals.as_slice()
    }

    /// Standard deviations of the measured numbers: those given, or those estimated from the residuals of their quantity.
    #[must_use]
    pub fn noise(&self) -> &[f64] {
        self.noise.deviations.as_slice()
    }

    /// Combinations of parameters that the rows do not tell.
    #[must_use]
    pub fn untold(&self) -> &[Untold] {
        &self.untold
    }

    /// Steps of the descent.
    #[must_use]
    pub fn steps(&self) -> usize {
        self.steps
    }

    /// The scene with the fitted values, and their deviations and correlations where the rows tell them.
    #[must_use]
    pub fn scene(&self) -> &SceneFile {
        &self.fitted
    }

    fn uncertainty(&self) -> Result<Uncertainty, Error> {
        let deviations = self.deviations();
        let count = deviations.len();
        let correlation = self.covariance.as_ref().map_or_else(
            || DMatrix::identity(count, count),
            |c| {
                DMatrix::from_fn(count, count, |i, j| {
                    if i == j { 1.0 } else { c[(i, j)] / deviations[i] / deviations[j] }
                })
            },
        );
        Uncertainty::new(&self.keys, &deviations, &correlation)
    }
}

/// Weights by Huber's loss of residuals in deviations. Estimated deviations are those of the outliers too: their median takes their place.
fn huber(residuals: &DVector<f64>, known: bool) -> DVector<f64> {
    let mut sizes: Vec<f64> = residuals.iter().map(|r| r.abs()).collect();
    sizes.sort_by(f64::total_cmp);
    let median = sizes[sizes.len() / 2] / MEDIAN;
    let unit = if known || median == 0.0 { 1.0 } else { median };
    residuals.map(|residual| (HUBER * unit / residual.abs()).min(1.0))
}

/// How much the fitted value of each number follows that number itself: the diagonal of `J (J^T J)^-1 J^T`; their sum is the number of
/// parameters that the rows tell.
fn leverages(scaled: &DMatrix<f64>) -> DVector<f64> {
    /// Singular values below this part of the largest tell nothing.
    const NOTHING: f64 = 1e-8;
    let decomposed = scaled.clone().svd(true, false);
    let least = NOTHING * decomposed.singular_values.max();
    let mut out = DVector::zeros(scaled.nrows());
    for (value, column) in
        decomposed.singular_values.iter().zip(decomposed.u.iter().flat_map(|u| u.column_iter()))
    {
        if *value > least {
            out += column.map(|entry| entry * entry);
        }
    }
    out
}

/// `(J^T J)^-1` of weighted derivatives by relative changes of parameters of these sizes; `None` where that is singular.
fn covariance(scaled: &DMatrix<f64>, sizes: &DVector<f64>) -> Option<DMatrix<f64>> {
    let inverse = Cholesky::new(scaled.tr_mul(scaled))?.inverse();
    Some(DMatrix::from_fn(sizes.len(), sizes.len(), |i, j| inverse[(i, j)] * sizes[i] * sizes[j]))
}
