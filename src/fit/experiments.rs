//! Which further rows would tell apart what these rows cannot: candidates are solved, and their effect on the weakest direction compared.

use nalgebra::DMatrix;
use rayon::prelude::*;

use super::constants::{PROPOSED, REPEATED, WORTH};
use super::directions::weakest;
use super::estimate::Estimate;
use super::measurements::{Measurements, Row};
use super::problem::{Problem, Refused, Shapes};
use crate::error::Error;
use crate::manipulator::SceneFile;

/// Candidates: a table's key, its values, and whether these are added to what acts already.
const CANDIDATES: [(&str, &[f64], bool); 4] = [
    ("gravity.acceleration_m_s2", &[9.81], false),
    ("load.tip_force_n", &[2e-3, 2e-2], false),
    ("field.uniform_mt", &[-10.0, 10.0], true),
    ("load.tip_moment_nm", &[2e-5], false),
];

/// Further rows that would help: some of the measured ones again, with a change.
#[derive(Debug, Clone, PartialEq)]
pub struct Experiment {
    /// The key of the scene that changes.
    pub key: String,
    /// Its new value, or what is added to it.
    pub value: f64,
    /// Whether the value is added to what acts already.
    pub added: bool,
    /// Number of rows repeated.
    pub rows: usize,
    /// Strength of the weakest direction before and after, in standard deviations for a relative change of length 1.
    pub strength: [f64; 2],
}

impl Experiment {
    /// In words.
    #[must_use]
    pub fn words(&self) -> String {
        let how = if self.added && self.value > 0.0 {
            "more by"
        } else if self.added {
            "less by"
        } else {
            "at"
        };
        let value = if self.added { self.value.abs() } else { self.value };
        let [before, after] = self.strength;
        format!(
            "{} of these rows again with `{}` {how} {value}: the weakest combination counts {after:.3} instead of {before:.3} \
             standard deviations",
            self.rows, self.key
        )
    }
}

/// The best candidates at the parameters that were found, best first; the residuals have standard deviation `scale`.
///
/// # Errors
/// Those of a scene that cannot hold the fitted values.
pub(super) fn proposed(
    file: &SceneFile,
    keys: &[String],
    measured: &Measurements,
    found: &Estimate,
    scale: f64,
) -> Result<Vec<Experiment>, Error> {
    let Estimate { shapes, jacobian, parameters, .. } = found;
    let kept: Vec<&Row> =
        measured.rows().iter().zip(shapes).filter(|(_, shape)| shape.is_some()).map(|(row, _)| row).collect();
    let spacing = kept.len().div_ceil(REPEATED).max(1);
    let chosen: Vec<&Row> = kept.into_iter().rev().step_by(spacing).collect();
    let before = weakest(jacobian, parameters) / scale;
    let mut candidates = Vec::new();
    for (name, values, added) in CANDIDATES {
        for axis in 1..=3 {
            let key = format!("{name}[{axis}]");
            if !keys.contains(&key) {
                candidates.extend(values.iter().map(|value| (key.clone(), *value, added)));
            }
        }
    }
    let tried = |(key, value, added): (String, f64, bool)| -> Result<Option<Experiment>, Error> {
        let acting = file.number(&key)?;
        let changed =
            measured.repeated(&chosen, &key, acting, |before| if added { before + value } else { value });
        let Ok(problem) = Problem::new(file, keys, &changed) else { return Ok(None) };
        let Ok(found) = problem.first(parameters) else { return Ok(None) };
        let found: Shapes = found.into_iter().map(Result::ok).collect();
        let rows = found.iter().flatten().count();
        let more = match problem.jacobian(&found, parameters) {
            Ok(more) => more,
            Err(Refused::Row(..) | Refused::Range(_)) => return Ok(None),
        };
        let joined = DMatrix::from_fn(jacobian.nrows() + more.nrows(), parameters.len(), |i, j| {
            if i < jacobian.nrows() { jacobian[(i, j)] } else { more[(i - jacobian.nrows(), j)] }
        });
        let strength = [before, weakest(&joined, parameters) / scale];
        Ok(Some(Experiment { key, value, added, rows, strength }))
    };
    let tried = candidates.into_par_iter().map(tried).collect::<Result<Vec<_>, Error>>()?;
    let worth = |each: &Experiment| each.rows > 0 && each.strength[1] > WORTH * each.strength[0].max(1e-6);
    let mut out: Vec<Experiment> = tried.into_iter().flatten().filter(worth).collect();
    out.sort_by(|a, b| b.strength[1].total_cmp(&a.strength[1]));
    // Of one kind the best.
    let kind = |each: &Experiment| each.key.split('[').next().unwrap_or_default().to_owned();
    let kinds: Vec<String> = out.iter().map(kind).collect();
    let mut number = 0..;
    out.retain(|each| number.next().is_some_and(|place: usize| !kinds[..place].contains(&kind(each))));
    out.truncate(PROPOSED);
    Ok(out)
}
