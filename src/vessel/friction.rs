//! Coulomb's law of friction, smoothed where it changes from sticking to sliding.

use super::quantities::FRICTION;
use crate::error::Error;

/// Tangential displacement (m) over which friction builds up: sticking contacts give way by up to this much. It is well below what
/// matters of a device of millimetres, and above what the solver leaves undetermined of its shape.
pub const GIVE: f64 = 10e-6;

/// Checks a coefficient of friction and returns it.
///
/// # Errors
/// [`Error::Range`] unless it is from 0 to 10.
pub fn checked(coefficient: f64) -> Result<f64, Error> {
    FRICTION.check(coefficient)
}

/// Energy (m) of friction for a unit friction force at this slip `y` (m), its slope over `y` (1/m), and its second derivative
/// (1/m).
///
/// ```text
/// f = y^2/e - y^3/(3 e^2)   for y < e,      f = y - e/3   beyond
/// ```
///
/// with `e =` [`GIVE`]: twice continuously differentiable; the force rises from 0 to 1 and stays there.
///
/// M. Li et al., Incremental Potential Contact, ACM Trans. Graph. 39 (2020) 49, section 5, doi:10.1145/3386569.3392425.
///
/// ```
/// use mcm::vessel::friction::{GIVE, smoothed};
/// let slip = 0.5 * GIVE;
/// let [_, slope, _] = smoothed(slip);
/// assert!((slope * slip - 0.75).abs() < 1e-12);
/// assert_eq!(smoothed(2.0 * GIVE)[2], 0.0);
/// ```
#[must_use]
pub fn smoothed(slip: f64) -> [f64; 3] {
    if slip >= GIVE {
        return [slip - GIVE / 3.0, 1.0 / slip, 0.0];
    }
    let part = slip / GIVE;
    [slip * part * (1.0 - part / 3.0), (2.0 - part) / GIVE, 2.0 * (1.0 - part) / GIVE]
}
