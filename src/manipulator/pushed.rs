//! A shaft under a constant push: the inserted length at which the device holds it.
//!
//! The length that a push `F` balances is a root of `R(l) - F`, with the push `R(l) = dU/dl` that holds the shaft at the length
//! `l`; it is stable where `R` increases. The roots are sought from outside, with the shape in equilibrium at every length on the
//! way: so each length has its verdict, and the way is one that a slowly released shaft would take.

use super::hierarchy::Hierarchy;
use crate::equilibrium::{Budget, Equilibrium, Inputs, LONGEST_INSERTION, Outcome, Report, Solution};
use crate::error::Error;

/// Longest change of the inserted length between two solves, m.
const STRIDE: f64 = 5e-3;

/// Change of the length within which it counts as found, m.
const FOUND: f64 = 1e-12;

/// Difference of two pushes that counts as none, N.
const BALANCED: f64 = 1e-12;

/// Difference that may be what the residual of the shapes leaves undetermined, N, where it no longer falls.
const UNDETERMINED: f64 = 1e-8;

/// Smallest change of the length from which the stiffness is taken by differences, m.
const DIFFERENT: f64 = 1e-6;

/// Stiffness, relative to the elastic one, that counts as none: the shaft is free to slide.
const FREE: f64 = 1e-6;

/// Largest number of solves on the way to one length.
const SOLVES: usize = 500;

/// A search for the inserted length.
struct Balance {
    /// Lengths between which the balance lies: the device is pushed in at the first and out at the second.
    between: [f64; 2],
    /// The last length, and the push that is missing there.
    last: Option<[f64; 2]>,
    stiffness: f64,
    /// Whether the shaft has run away on the way.
    ran: bool,
}

impl Hierarchy {
    /// As [`Self::solve`] for a shaft under the constant `push` (N); its length is then found in the inputs of the present model.
    ///
    /// At length 0 the port holds what is pulled out. A shaft that nothing holds ends as [`Outcome::BranchEnds`].
    ///
    /// # Errors
    /// As [`Self::solve`].
    pub(super) fn solve_pushed(&mut self, inputs: &Inputs, push: f64) -> Result<Report, Error> {
        self.present().check(inputs)?;
        let deadline = self.deadline();

        let known = self.present().inputs().map(|last| last.insertion);
        let mut length = known.unwrap_or(inputs.insertion);
        let mut balance =
            Balance { between: [0.0, LONGEST_INSERTION], last: None, stiffness: 0.0, ran: false };

        // A Newton step from the last solution, whose stiffness is known; useless where the shaft is free to
        // slide.
        if known.is_some()
            && let Some(response) = self.present().feed_response(Some(inputs))
            && response.stiffness > FREE * response.elastic
        {
            let missing = response.push + response.along - push;
            balance.stiffness = response.stiffness;
            length -= (missing / response.stiffness).clamp(-STRIDE, STRIDE);
            length = length.clamp(0.0, LONGEST_INSERTION);
        }

        let (mut iterations, mut snaps) = (0, 0);
        for _ in 0..SOLVES {
            let at = Inputs { insertion: length, ..inputs.clone() };
            let report = self.solve_before(&deadline, &at)?;
            (iterations, snaps) = (iterations + report.iterations, snaps + report.snaps);
            let report = Report { iterations, snaps, ..report };

            if !report.solved() {
                return Ok(report);
            }

            let model = self.present();
            let Some(held) = model.feed_reaction(&at) else { return Ok(report) };
            match balance.next(model, &at, held - push) {
                Some(next) if next > LONGEST_INSERTION => {
                    return Ok(Report { outcome: Outcome::BranchEnds, ..report });
                }
                Some(next) => length = next,
                None => {
                    let snaps = snaps + u32::from(balance.ran && known.is_some());
                    return Ok(assessed(model, &at, Report { snaps, ..report }));
                }
            }
        }

        Ok(Report { outcome: Outcome::OutOfBudget(Budget::Iterations), iterations, snaps, ..Report::start() })
    }
}

impl Balance {
    /// The next length to try, `None` where the present one, at `inputs`, balances the push; `missing` (N) is missing there.
    fn next(&mut self, model: &Equilibrium, inputs: &Inputs, missing: f64) -> Option<f64> {
        let here = inputs.insertion;
        if missing.abs() <= BALANCED || here == 0.0 && missing > 0.0 {
            return None;
        }

        // The residual of the shapes limits what can be balanced: a small difference that no longer halves is
        // the end.
        if self.last.is_some_and(|last| 2.0 * missing.abs() > last[1].abs()) && missing.abs() <= UNDETERMINED
        {
            return None;
        }

        // Secant slope, and only where there is none the response, which needs a factorised Hessian.
        if let Some([length, lacking]) = self.last.replace([here, missing])
            && (here - length).abs() >= DIFFERENT
        {
            self.stiffness = (missing - lacking) / (here - length);
        }
        if self.stiffness <= 0.0 {
            self.stiffness = model.feed_response(None).map_or(0.0, |response| response.stiffness);
        }

        self.between[usize::from(missing > 0.0)] = here;

        let step = if self.stiffness > 0.0 {
            (-missing / self.stiffness).clamp(-STRIDE, STRIDE)
        } else {
            self.ran = true;
            -STRIDE * missing.signum()
        };

        let [low, high] = self.between;
        if high - low <= FOUND || step.abs() <= FOUND {
            return None;
        }

        // Inside the bracket the step is taken, at its ends clamped where nothing was tried yet, else it is
        // halved.
        let next = here + step;
        if next > low && next < high {
            return Some(next);
        }
        match (missing > 0.0, next) {
            (true, next) if next <= 0.0 && low == 0.0 => Some(0.0),
            (false, next) if next >= LONGEST_INSERTION && high == LONGEST_INSERTION => Some(next),
            _ => Some(0.5 * (low + high)),
        }
    }
}

/// The report of a shaft in balance: stable where more length takes more push.
fn assessed(model: &Equilibrium, inputs: &Inputs, report: Report) -> Report {
    if inputs.insertion == 0.0 {
        return report;
    }
    let Some(response) = model.feed_response(None) else { return report };
    let relative = response.stiffness / response.elastic;
    Report {
        outcome: if relative.abs() <= FREE { Outcome::Neutral } else { report.outcome },
        margin: model.margin().unwrap_or_else(|| relative.min(0.0)),
        stable: report.stable.map(|stable| stable && relative >= -FREE),
        ..report
    }
}
