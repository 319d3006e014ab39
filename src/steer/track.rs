//! Targets one after the other.

use super::constants::{COMFORTABLE_MARGIN, MARGIN_STEP};
use super::linear::Linear;
use super::sequential_quadratic_programming::{Attempt, Step, approach};
use super::state::State;
use super::steering::{Answer, Steering};
use super::target::Target;
use crate::error::Error;

impl Steering {
    /// Follows targets by continuation: each is approached from the one before, and where more may move than the target needs, the
    /// rest is used to stay away from folds.
    ///
    /// It ends with the first target that is not reached, whose answer is the last one.
    ///
    /// # Errors
    /// As [`Steering::to`], before the first step for all targets.
    pub fn track(&mut self, targets: &[Target]) -> Result<Vec<Answer>, Error> {
        targets.iter().try_for_each(Target::check)?;
        let mut answers = Vec::new();
        for target in targets {
            let mut found = self.approach(target)?;
            if found.limit.is_none() {
                found = self.aside(target, found)?;
            }
            let answer = self.accept(target, found);
            let reached = answer.reached;
            answers.push(answer);
            if !reached {
                break;
            }
        }
        Ok(answers)
    }

    /// This target with a larger margin, where that is small and there is a way.
    fn aside(&self, target: &Target, found: Attempt) -> Result<Attempt, Error> {
        if found.state.outputs().stability_margin >= COMFORTABLE_MARGIN {
            return Ok(found);
        }

        // The margin known so far is a bound: here it is measured.
        let mut measured = found.state.clone();
        let margin = measured.manipulator.measure_margin().stability_margin;
        let freedoms = measured.freedoms(&self.rules);
        let Some(gradient) = measured.margin_gradient(&freedoms)?.filter(|_| margin < COMFORTABLE_MARGIN)
        else {
            return Ok(found);
        };

        // A step along what the target leaves free, then back to the target from there.
        let aim = self.aim(target);
        let linear = Linear::at(&measured, &aim)?;
        let Some(direction) = linear.free(&gradient) else { return Ok(found) };
        let step = &direction * (MARGIN_STEP / direction.amax());
        let Ok(moved) = measured.stepped(&self.rules, &freedoms, &step)? else { return Ok(found) };
        let back = approach(&moved, &aim, &mut Some(linear))?;
        if back.limit.is_some() || margin_of(&back.state) <= margin {
            return Ok(found);
        }

        let mut way = found.way;
        way.push(Step::of(&moved));
        way.extend(back.way);
        Ok(Attempt { way, ..back })
    }
}

/// The stability margin, computed.
fn margin_of(state: &State) -> f64 {
    state.manipulator.clone().measure_margin().stability_margin
}
