//! Which parameters the rows cannot tell apart.

use nalgebra::DMatrix;

use super::descent::{Minimum, Weighted};
use super::experiments::helpful;
use super::spectrum::spectrum;
use crate::error::Error;

/// Singular value, relative to the largest, below which rows do not tell a combination: their derivatives are exact to 1e-8.
const SINGULAR: f64 = 1e-6;

/// Share of a parameter in a combination from which it is named.
const NAMED: f64 = 0.2;

/// A combination of parameters that changes nothing that was measured.
#[derive(Debug, Clone, PartialEq)]
pub struct Untold {
    /// Its parameters, with their relative changes.
    pub combination: Vec<(String, f64)>,
    /// The row that would tell them best, in words, if one was found.
    pub experiment: Option<&'static str>,
}

impl core::fmt::Display for Untold {
    fn fmt(&self, f: &mut core::fmt::Formatter<'_>) -> core::fmt::Result {
        let names: Vec<String> = self.combination.iter().map(|(key, _)| format!("`{key}`")).collect();
        match names.as_slice() {
            [single] => write!(f, "{single} changes nothing that was measured")?,
            several => write!(f, "{} cannot be told apart by these rows", several.join(" and "))?,
        }
        match self.experiment {
            Some(experiment) => write!(f, "; add a row with {experiment}"),
            None => write!(f, "; no single row that was tried tells them: fix one of them"),
        }
    }
}

/// The combinations that weighted derivatives by relative changes do not tell.
pub(super) fn untold(
    weighted: &Weighted<'_>,
    minimum: &Minimum,
    scaled: &DMatrix<f64>,
) -> Result<Vec<Untold>, Error> {
    let (values, directions) = spectrum(scaled);
    let least = SINGULAR * values.max();
    let keys = weighted.problem.keys;
    let mut out = Vec::new();
    for (value, direction) in values.iter().zip(directions.row_iter()) {
        if *value > least {
            continue;
        }
        let largest = direction.amax();
        let named = keys.iter().zip(direction.iter()).filter(|(_, share)| share.abs() > NAMED * largest);
        let combination = named.map(|(key, share)| (key.clone(), *share)).collect();
        out.push(Untold { combination, experiment: helpful(weighted, minimum, scaled, least)? });
    }
    Ok(out)
}
