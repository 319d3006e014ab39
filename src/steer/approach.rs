//! The walk from a state to a target: sequential quadratic steps.

use nalgebra::{DMatrix, DVector};

use super::bounds::Bound;
use super::limits::Limit;
use super::moves::{Freedom, between, moved};
use super::quadratic;
use super::state::{Rules, State};
use super::target::{Target, Tolerances};
use crate::error::Error;
use crate::manipulator::{Inputs, Outputs};

/// Most steps of one walk.
const STEPS: usize = 400;

/// Shortest part of a step that is tried.
const SHORTEST: f64 = 1.0 / 1024.0;

/// Part of the predicted gain that a step must bring.
const GAIN: f64 = 1e-3;

/// Difference between predicted and found errors, relative to the errors before, up to which a Jacobian is kept and corrected.
const FAITHFUL: f64 = 0.5;

/// Number of steps in which a tenth of the misfit must go: a walk that creeps along a limit ends.
const PATIENCE: usize = 24;

/// Step, in longest steps, below which nothing moves.
const STILL: f64 = 1e-7;

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

/// Derivatives that may serve for several steps: those of the target's errors and the limits, at the freedoms of some inputs.
#[derive(Debug, Clone)]
pub(super) struct Linear {
    rates: DMatrix<f64>,
    freedoms: Vec<Freedom>,
    bounds: Vec<Bound>,
    /// Whether they are those of the present state.
    exact: bool,
    /// The target whose errors they belong to, but for its numbers.
    kind: [bool; 4],
}

impl Linear {
    /// Exact ones.
    pub(super) fn at(
        state: &State,
        target: &Target,
        tolerances: &Tolerances,
        rules: &Rules,
    ) -> Result<Self, Error> {
        let freedoms = state.freedoms(rules);
        let jacobian = state.manipulator.jacobian()?;
        let outputs = state.outputs();
        let rates = target.rates(&jacobian, outputs, tolerances, &freedoms);
        let mut bounds = rules.bodies.bounds(&rules.limits, &state.inputs, outputs, &jacobian, &freedoms);
        bounds.extend(state.margin_bound(rules, &freedoms)?);
        Ok(Self { rates, freedoms, bounds, exact: true, kind: kind(target) })
    }

    /// The part of a direction of the freedoms that changes none of the target's errors; `None` where nothing of it is left.
    pub(super) fn free(&self, direction: &DVector<f64>) -> Option<DVector<f64>> {
        /// Singular values and lengths below this part of the largest count as zero.
        const NOTHING: f64 = 1e-6;
        let decomposed = self.rates.clone().svd(false, true);
        let least = NOTHING * decomposed.singular_values.max();
        let mut out = direction.clone();
        for (value, row) in decomposed.singular_values.iter().zip(decomposed.v_t?.row_iter()) {
            if *value > least {
                let along = row.transpose();
                out -= &along * along.dot(direction);
            }
        }
        (out.norm() > NOTHING * direction.norm()).then_some(out)
    }

    /// Takes note of what a step has brought (Broyden 1965, doi 10.1090/S0025-5718-1965-0198670-6).
    fn learn(&mut self, step: &DVector<f64>, taken: &DVector<f64>) {
        let missed = taken - &self.rates * step;
        self.rates += missed * step.transpose() / step.norm_squared();
        for bound in &mut self.bounds {
            bound.slack += bound.gradient.dot(step);
        }
        self.exact = false;
    }
}

/// What a target asks for.
fn kind(target: &Target) -> [bool; 4] {
    let Target { position, direction, angle, force } = target;
    [position.is_some(), direction.is_some(), angle.is_some(), force.is_some()]
}

/// Walks from a state as near to the target as it can without a snap. `linear` holds the derivatives of an earlier walk that may
/// still serve, and those of this one when it has ended.
pub(super) fn approach(
    start: &State,
    target: &Target,
    tolerances: &Tolerances,
    rules: &Rules,
    linear: &mut Option<Linear>,
) -> Result<Attempt, Error> {
    let mut state = start.clone();
    let mut way = Vec::new();
    let mut known = linear.take().filter(|linear| linear.kind == kind(target));
    let mut stopped = Some(Limit::Nearest);
    let mut misfits: Vec<f64> = Vec::new();
    for _ in 0..STEPS {
        let misfit = target.misfit(state.outputs(), tolerances);
        if misfit <= 1.0 {
            stopped = None;
            break;
        }
        if misfits.len() >= PATIENCE && misfit > 0.9 * misfits[misfits.len() - PATIENCE] {
            break;
        }
        misfits.push(misfit);
        let mut here = match known.take() {
            Some(known) => known,
            None => Linear::at(&state, target, tolerances, rules)?,
        };
        match stride(&state, target, tolerances, rules, &mut here)? {
            Ok(next) => {
                way.push(Step::of(&next.state));
                state = next.state;
                stopped = Some(next.met.unwrap_or(Limit::Nearest));
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
    let misfit = target.misfit(state.outputs(), tolerances);
    Ok(Attempt { state, way, misfit, limit: stopped })
}

/// A step that has been taken.
struct Stride {
    state: State,
    /// Whether the derivatives have predicted it well enough to be used again.
    faithful: bool,
    /// A limit that shortens or turns it.
    met: Option<Limit>,
}

/// One step towards the target, as long as it gains, or what forbids any.
fn stride(
    state: &State,
    target: &Target,
    tolerances: &Tolerances,
    rules: &Rules,
    linear: &mut Linear,
) -> Result<Result<Stride, Limit>, Error> {
    let errors = target.errors(state.outputs(), tolerances);
    let Some(found) = quadratic::solve(&linear.rates, &errors, &linear.bounds) else {
        return Ok(Err(Limit::Nearest));
    };
    let met = found.met.first().copied();
    if found.step.amax() < STILL {
        return Ok(Err(met.unwrap_or(Limit::Nearest)));
    }
    let before = errors.norm();
    let whole = (&errors - &linear.rates * &found.step).norm();
    let (mut part, mut refused) = (1.0, None);
    while part >= SHORTEST {
        let step = &found.step * part;
        match state.stepped(rules, &linear.freedoms, &step)? {
            Ok(next) => {
                let left = target.errors(next.outputs(), tolerances);
                if left.norm() <= before - GAIN * part * (before - whole) && left.norm() < before {
                    let predicted = &errors - &linear.rates * &step;
                    let faithful = (&left - predicted).norm() <= FAITHFUL * before;
                    linear.learn(&step, &(&errors - &left));
                    return Ok(Ok(Stride { state: next, faithful, met: refused.or(met) }));
                }
            }
            Err(limit) => refused = Some(limit),
        }
        part *= 0.5;
    }
    Ok(Err(refused.or(met).unwrap_or(Limit::Nearest)))
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
