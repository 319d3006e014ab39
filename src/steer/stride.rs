//! One step of a walk: how far it goes, and how it is corrected where the way bends.

use nalgebra::DVector;

use super::aim::Aim;
use super::constants::{CORRECTIONS, FAITHFUL, GAIN, SHORTEST_PART, SHRINKS, STILL};
use super::limits::Limit;
use super::linear::Linear;
use super::quadratic_program;
use super::state::State;
use crate::error::Error;

/// A step that has been taken.
pub(super) struct Stride {
    pub(super) state: State,
    /// Whether the derivatives have predicted it well enough to be used again.
    pub(super) faithful: bool,
    /// A limit that shortens or turns it.
    pub(super) met: Option<Limit>,
}

/// One step towards the target, as long as it gains, or what forbids any.
pub(super) fn stride(
    state: &State,
    aim: &Aim<'_>,
    linear: &mut Linear,
) -> Result<Result<Stride, Limit>, Error> {
    let errors = aim.errors(state);
    let Some(found) = quadratic_program::solve(&linear.rates, &errors, &linear.bounds) else {
        return Ok(Err(Limit::Nearest));
    };
    let met = found.met.first().copied();
    if found.step.amax() < STILL {
        return Ok(Err(met.unwrap_or(Limit::Nearest)));
    }

    let before = errors.norm();
    let whole = linear.left(&errors, &found.step).norm();
    let (mut part, mut refused) = (1.0, None);
    while part >= SHORTEST_PART {
        let most = before - GAIN * part * (before - whole);
        let first = &found.step * part;
        match (Trial { state, errors: &errors, most }).corrected(aim, linear, &first)? {
            Ok(Some(stride)) => return Ok(Ok(Stride { met: refused.or(met), ..stride })),
            Ok(None) => {}
            Err(limit) => refused = Some(limit),
        }
        part *= 0.5;
    }
    Ok(Err(refused.or(met).unwrap_or(Limit::Nearest)))
}

/// Where a step begins, what is missing there, and what may be left after it.
struct Trial<'a> {
    state: &'a State,
    errors: &'a DVector<f64>,
    most: f64,
}

impl Trial<'_> {
    /// Takes a step, and corrects it while too much is left; `None` where that does not help.
    ///
    /// A magnet that moves far can change one component of the tip a thousand times more than another: a step that gains a micrometre
    /// along the tip's axis bends aside by tens of micrometres. Halved until that is less than the gain, it would hardly move. So the
    /// sideways error is taken away first, by a second-order correction (Fletcher 1982, doi 10.1007/BFb0120930), and the corrected
    /// step is what is measured.
    fn corrected(
        &self,
        aim: &Aim<'_>,
        linear: &mut Linear,
        first: &DVector<f64>,
    ) -> Result<Result<Option<Stride>, Limit>, Error> {
        let (before, wanted) = (self.errors.norm(), linear.left(self.errors, first));
        let (mut step, mut last) = (first.clone(), f64::INFINITY);
        for _ in 0..=CORRECTIONS {
            let next = match self.state.stepped(aim.rules, &linear.freedoms, &step)? {
                Ok(next) => next,
                Err(limit) => return Ok(Err(limit)),
            };
            let left = aim.errors(&next);
            if left.norm() <= self.most && left.norm() < before {
                let surprise = (&left - linear.left(self.errors, &step)).norm();
                linear.learn(&step, &(self.errors - &left));
                return Ok(Ok(Some(Stride {
                    state: next,
                    faithful: surprise <= FAITHFUL * before,
                    met: None,
                })));
            }

            let missed = &left - &wanted;
            if missed.norm() > SHRINKS * last {
                break;
            }
            last = missed.norm();
            match quadratic_program::correct(&linear.rates, &missed, &linear.bounds, &step) {
                Some(again) => step = again,
                None => break,
            }
        }
        Ok(Ok(None))
    }
}
