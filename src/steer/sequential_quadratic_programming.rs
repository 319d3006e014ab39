//! The walk from a state to a target by sequential quadratic programming.

use super::aim::Aim;
use super::constants::{MOST_STEPS, PACE, STILL};
use super::limits::Limit;
use super::linear::Linear;
use super::moves::{between, moved};
use super::state::{Rules, State};
use super::stride::stride;
use crate::error::Error;
use crate::manipulator::{Inputs, Outputs};

/// One step of a way: the inputs to set and the device's answer.
#[derive(Debug, Clone, PartialEq)]
pub struct Step {
    /// The inputs.
    pub inputs: Inputs,
    /// The outputs there.
    pub outputs: Outputs,
}

impl Step {
    pub(super) fn of(state: &State) -> Self {
        Self { inputs: state.inputs.clone(), outputs: state.outputs().clone() }
    }
}

/// Where a walk has ended.
#[derive(Debug, Clone)]
pub(super) struct Attempt {
    pub(super) state: State,
    pub(super) way: Vec<Step>,
    /// In tolerances.
    pub(super) misfit: f64,
    /// What stopped it; `None` where the target is reached.
    pub(super) limit: Option<Limit>,
}

/// Walks from a state as near to the target as it can without a snap. `linear` holds the derivatives of an earlier walk that may
/// still serve, and those of this one when it has ended.
///
/// It ends at the target, where nothing brings the tip nearer, and where it comes nearer so slowly that at this pace [`MOST_STEPS`] more
/// steps would not reach the target.
pub(super) fn approach(start: &State, aim: &Aim<'_>, linear: &mut Option<Linear>) -> Result<Attempt, Error> {
    let mut state = start.clone();
    let mut way = Vec::new();
    let mut known = linear.take().filter(|linear| linear.is_of(aim.target));
    let mut stopped = Some(Limit::Slow);
    let mut misfits: Vec<f64> = Vec::new();
    for _ in 0..MOST_STEPS {
        let misfit = aim.misfit(&state);
        if misfit <= 1.0 {
            stopped = None;
            break;
        }
        if is_slow(&misfits, misfit) {
            break;
        }
        misfits.push(misfit);

        let mut here = match known.take() {
            Some(known) => known,
            None => Linear::at(&state, aim)?,
        };
        match stride(&state, aim, &mut here)? {
            Ok(next) => {
                way.push(Step::of(&next.state));
                state = next.state;
                stopped = Some(next.met.unwrap_or(Limit::Slow));
                known = next.faithful.then_some(here);
            }
            // Derivatives of another place may mislead.
            Err(_) if !here.exact => {}
            Err(limit) => {
                stopped = Some(limit);
                break;
            }
        }
    }
    *linear = known;
    let misfit = aim.misfit(&state);
    Ok(Attempt { state, way, misfit, limit: stopped })
}

/// Whether the target would not be reached within [`MOST_STEPS`] more steps that each gain as much as the last ones.
fn is_slow(misfits: &[f64], now: f64) -> bool {
    let Some(before) = misfits.len().checked_sub(PACE).map(|at| misfits[at]) else { return false };
    (before - now) / PACE as f64 * MOST_STEPS as f64 <= now
}

/// Walks straight towards other inputs, in the longest steps allowed; ends there, or before what forbids the next step.
pub(super) fn straight(
    start: &State,
    goal: &Inputs,
    rules: &Rules,
    most: usize,
) -> Result<(State, Vec<Step>, Option<Limit>), Error> {
    let (mut state, mut way) = (start.clone(), Vec::new());

    for _ in 0..most {
        let freedoms = state.freedoms(rules);
        let rest = between(&state.inputs, &freedoms, goal);
        let far = rest.amax();
        if far < STILL {
            return Ok((state, way, None));
        }

        let inputs = moved(&state.inputs, &freedoms, &(rest / far.max(1.0)));

        match state.at(rules, inputs)? {
            Ok(next) => {
                state = next;
                way.push(Step::of(&state));
            }
            Err(limit) => return Ok((state, way, Some(limit))),
        }
    }
    Ok((state, way, Some(Limit::Nearest)))
}
