//! Tables `[uncertainty]` and `[correlation]`: how well the numbers of a scene are known.

use std::collections::BTreeMap;

use nalgebra::{Cholesky, DMatrix};

use super::SceneFile;
use super::ranges::{CORRELATION, DEVIATION};
use crate::error::Error;

/// Between the two keys of a correlation.
const SEPARATOR: &str = ", ";

/// Standard deviations of some numbers of a scene, in the units of the scene, and their correlation.
///
/// ```
/// use mcm::manipulator::SceneFile;
/// let text = "[uncertainty]\n\"design.helix.shore_a\" = 1.0\n\"design.ring.remanence_t\" = 0.02\n\
///             [correlation]\n\"design.helix.shore_a, design.ring.remanence_t\" = 0.5";
/// let uncertainty = SceneFile::parse(text, "example")?.uncertainty()?;
/// assert_eq!(uncertainty.keys, ["design.helix.shore_a", "design.ring.remanence_t"]);
/// assert_eq!(uncertainty.covariance()[(0, 1)], 0.5 * 1.0 * 0.02);
/// # Ok::<(), mcm::error::Error>(())
/// ```
#[derive(Debug, Clone, PartialEq)]
pub struct Uncertainty {
    /// The keys of the numbers, in alphabetical order.
    pub keys: Vec<String>,
    /// The standard deviation of each.
    pub deviations: Vec<f64>,
    /// Correlation matrix: 1 on its diagonal, positive definite.
    pub correlation: DMatrix<f64>,
}

impl Uncertainty {
    /// Numbers that are known independently of one another; unordered lists are put in order.
    ///
    /// # Errors
    /// [`Error::Count`] for lists of different lengths or a matrix of another size, [`Error::Range`] for a deviation that is not
    /// positive, or a correlation outside of -1 to 1; [`Error::Unsupported`] for a matrix that is not positive definite.
    pub fn new(keys: &[String], deviations: &[f64], correlation: &DMatrix<f64>) -> Result<Self, Error> {
        let count = keys.len();
        for (quantity, given) in [
            ("standard deviations", deviations.len()),
            ("rows of the correlation", correlation.nrows()),
            ("columns of the correlation", correlation.ncols()),
        ] {
            if given != count {
                let expected = format!("{count}, one for each key");
                return Err(Error::Count { quantity: quantity.into(), given, expected });
            }
        }

        for (key, deviation) in keys.iter().zip(deviations) {
            DEVIATION.check(&format!("`{key}`"), *deviation)?;
        }
        for (index, value) in correlation.iter().enumerate() {
            let [row, column] = [index % count, index / count].map(|at| &keys[at]);
            let name = format!("`{row}{SEPARATOR}{column}`");
            CORRELATION.check(&name, *value)?;
        }

        if Cholesky::new(correlation.clone()).is_none() {
            return Err(Error::Unsupported(
                "the correlations contradict one another: their matrix is not positive definite".into(),
            ));
        }

        // A file's tables have no order: sorted by key, equal lists compare equal.
        let mut order: Vec<usize> = (0..count).collect();
        order.sort_by_key(|&index| &keys[index]);
        Ok(Self {
            keys: order.iter().map(|&index| keys[index].clone()).collect(),
            deviations: order.iter().map(|&index| deviations[index]).collect(),
            correlation: DMatrix::from_fn(count, count, |i, j| correlation[(order[i], order[j])]),
        })
    }

    /// Covariance matrix, in the squared units of the scene.
    #[must_use]
    pub fn covariance(&self) -> DMatrix<f64> {
        let scale = &self.deviations;
        DMatrix::from_fn(scale.len(), scale.len(), |i, j| scale[i] * self.correlation[(i, j)] * scale[j])
    }
}

impl SceneFile {
    /// The uncertainty that the scene states; without keys where it states none.
    ///
    /// # Errors
    /// [`Error::Syntax`] naming the table at fault, for a key that is not one of the scene's numbers, and as [`Uncertainty::new`].
    pub fn uncertainty(&self) -> Result<Uncertainty, Error> {
        let keys: Vec<String> = self.uncertainty.keys().cloned().collect();
        let deviations: Vec<f64> = self.uncertainty.values().copied().collect();
        keys.iter()
            .try_for_each(|key| self.number(key).map(|_| ()))
            .map_err(|reason| in_table("uncertainty", &reason))?;
        let mut correlation = DMatrix::identity(keys.len(), keys.len());
        Uncertainty::new(&keys, &deviations, &correlation)
            .map_err(|reason| in_table("uncertainty", &reason))?;
        for (pair, value) in &self.correlation {
            let place = |key: &str| keys.iter().position(|own| own == key.trim());
            let places = pair.split_once(',').map(|(first, second)| [place(first), place(second)]);
            let Some([Some(first), Some(second)]) = places.filter(|[first, second]| first != second) else {
                let reason =
                    format!("`{pair}` does not name two keys of [uncertainty], as \"key, other key\"");
                return Err(Error::Syntax { what: "correlation".into(), reason });
            };
            (correlation[(first, second)], correlation[(second, first)]) = (*value, *value);
        }
        Uncertainty::new(&keys, &deviations, &correlation).map_err(|reason| in_table("correlation", &reason))
    }

    /// This file with this uncertainty instead of its own.
    ///
    /// # Errors
    /// As [`Self::uncertainty`].
    pub fn with_uncertainty(&self, uncertainty: &Uncertainty) -> Result<Self, Error> {
        let Uncertainty { keys, deviations, correlation } = uncertainty;
        let mut pairs = BTreeMap::new();
        for (i, first) in keys.iter().enumerate() {
            for (j, second) in keys.iter().enumerate().skip(i + 1) {
                if correlation[(i, j)] != 0.0 {
                    pairs.insert(format!("{first}{SEPARATOR}{second}"), correlation[(i, j)]);
                }
            }
        }
        let deviations = keys.iter().cloned().zip(deviations.iter().copied()).collect();
        let file = Self { uncertainty: deviations, correlation: pairs, ..self.clone() };
        file.uncertainty()?;
        Ok(file)
    }
}

fn in_table(table: &str, reason: &Error) -> Error {
    Error::Syntax { what: table.into(), reason: reason.to_string() }
}
