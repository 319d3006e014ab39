//! One instance of the FMU, safe: the C functions are its thin twins.

use std::collections::BTreeMap;
use std::path::PathBuf;
use std::sync::Arc;

use super::condition::Condition;
use super::log::Log;
use super::package::Package;
use super::state::{Call, Ending, State};
use super::variable::{Role, Value, Variable};
use super::variables::MARGIN;
use crate::error::Error;
use crate::manipulator::{Inputs, Manipulator, Outcome, Status};

/// Times closer than this, relative to the larger of time and step, are the same: hosts add up their steps.
const TIME_SLACK: f64 = 1e-9;

/// An instance of the FMU.
#[derive(Debug)]
pub struct Instance {
    pub(super) package: Arc<Package>,
    pub(super) log: Log,
    pub(super) condition: Condition,
    pub(super) saved: BTreeMap<usize, Condition>,
    surprised: bool,
}

/// The package that a host means by GUID and resource paths.
///
/// # Errors
/// [`Error::Syntax`] for resources that are altered or of another GUID, and for a GUID that is not the built-in
/// design's when there are no resources.
pub fn identify(guid: &str, resources: &[PathBuf]) -> Result<Package, Error> {
    let mut found = None;
    for path in resources {
        found = Package::read(path)?;
        if found.is_some() {
            break;
        }
    }
    let from =
        if found.is_some() { "the resources" } else { "the built-in default design (no resources found)" };
    let package = found.map_or_else(Package::built_in, Ok)?;
    if package.guid() == guid.trim() {
        Ok(package)
    } else {
        Err(Error::Syntax {
            what: format!("GUID {guid}"),
            reason: format!("it is not {}, that of {from}", package.guid()),
        })
    }
}

impl Instance {
    /// A fresh instance.
    #[must_use]
    pub fn new(package: Arc<Package>, log: Log) -> Self {
        let counts = package.table().counts();
        log.event(&format!(
            "design {} with {} rings and {} cores",
            package.guid(),
            counts.rings,
            counts.cores
        ));
        let condition = Condition::new(package.start());
        Self { package, log, condition, saved: BTreeMap::new(), surprised: false }
    }

    /// Where it stands.
    #[must_use]
    pub fn state(&self) -> State {
        self.condition.state
    }

    /// Time of the last communication point.
    #[must_use]
    pub fn time(&self) -> f64 {
        self.condition.time
    }

    /// Tells the log why a call is refused.
    #[must_use]
    pub fn refuse(&self, reason: &str) -> Ending {
        self.log.error(reason);
        Ending::Error
    }

    /// Whether `call` is allowed now; if not, the log says so.
    #[must_use]
    pub fn allows(&self, call: Call, name: &str) -> bool {
        let allowed = self.state().allows(call);
        if call == Call::CancelStep {
            self.log
                .error(&format!("{name}: no step is under way, as every step is finished when it returns"));
        } else if !allowed {
            self.log.error(&format!("{name} is not allowed in state {:?}", self.state()));
        }
        allowed
    }

    /// After a panic: nothing is trusted any more; only a reset gives a fresh start.
    pub fn break_down(&mut self, message: &str) -> Ending {
        self.condition = Condition { state: State::Broken, ..Condition::new(self.package.start()) };
        self.saved.clear();
        self.refuse(&format!("internal failure, reset or free the instance: {message}"))
    }

    /// Chooses what the host hears.
    pub fn set_debug_logging(&mut self, on: bool, categories: &[&str]) -> Ending {
        match self.log.choose(on, categories) {
            Ok(()) => Ending::Ok,
            Err(name) => self.refuse(&format!("there is no log category {name}")),
        }
    }

    /// Takes start and stop time. A tolerance is of no use here: solves always converge tightly.
    pub fn setup_experiment(&mut self, start: f64, stop: Option<f64>) -> Ending {
        if !start.is_finite() || stop.is_some_and(|stop| stop.is_nan() || stop < start) {
            return self.refuse(&format!("start time {start} and stop time {stop:?} are no interval"));
        }
        self.condition.time = start;
        self.condition.stop = stop;
        Ending::Ok
    }

    /// Enters initialisation.
    pub fn enter_initialization(&mut self) -> Ending {
        self.condition.state = State::Initialization;
        Ending::Ok
    }

    /// Checks the parameters, finds the first equilibrium, and stands at the first communication point.
    pub fn exit_initialization(&mut self) -> Ending {
        let ending = if self.condition.solved { Ok(Ending::Ok) } else { self.solve_here() };
        match ending {
            Ok(Ending::Ok) => {
                self.condition.state = State::Stepping;
                self.log.event(&format!("initialised at t = {}", self.condition.time));
                Ending::Ok
            }
            Ok(failed) => {
                self.condition.state = State::Failed;
                failed
            }
            Err(error) => self.refuse(&error.to_string()),
        }
    }

    /// The end.
    pub fn terminate(&mut self) -> Ending {
        self.condition.state = State::Terminated;
        Ending::Ok
    }

    /// Back to the state after instantiation; saved states stay.
    pub fn reset(&mut self) -> Ending {
        self.condition = Condition::new(self.package.start());
        self.surprised = false;
        self.log.relieve();
        Ending::Ok
    }

    /// Steps from `time` to `time + step`: finds the equilibrium for the inputs now set or, where they have time
    /// derivatives, follows it along their path.
    pub fn do_step(&mut self, time: f64, step: f64) -> Ending {
        let end = time + step;
        if !time.is_finite() || !end.is_finite() || step < 0.0 {
            return self.refuse(&format!("a step from t = {time} by {step} is none"));
        }
        let slack = TIME_SLACK * time.abs().max(self.condition.time.abs()).max(step);
        if let Some(stop) = self.condition.stop.filter(|stop| end > stop + slack) {
            return self.refuse(&format!("a step to t = {end} goes beyond the stop time {stop}"));
        }
        let unexpected = (time - self.condition.time).abs() > slack && !self.surprised;
        if unexpected {
            let expected = self.condition.time;
            self.log.notice(&format!("step from t = {time}, but the last one ended at t = {expected}"));
            self.surprised = true;
        }
        // Inputs that have not changed are solved again: `Snapped` must not outlive its step.
        self.condition.solved &= self.condition.ahead;
        let moving = self.condition.rates.move_inputs() && step > 0.0;
        let ending = if moving { self.travel(step) } else { self.ensure_solved() };
        if ending != Ending::Ok {
            return ending;
        }
        self.condition.rates.spend();
        self.condition.ahead = false;
        self.condition.time = end;
        self.condition.snaps = self.condition.device.as_ref().map_or(0, |device| device.outputs().snaps);
        self.log.relieve();
        Ending::Ok
    }

    /// Follows the inputs' path for `duration`; then they keep the values reached.
    fn travel(&mut self, duration: f64) -> Ending {
        let condition = &self.condition;
        let path = condition.given.inputs().and_then(|start| {
            let (mut points, end) = condition.rates.path(self.package.table(), &condition.given, duration)?;
            if !condition.solved {
                points.insert(0, start);
            }
            Ok((points, end))
        });
        match path.and_then(|(points, end)| Ok((self.solve(&points)?, end))) {
            Ok((Ending::Ok, end)) => {
                self.condition.given = end;
                Ending::Ok
            }
            Ok((failed, _)) => failed,
            Err(error) => self.refuse(&error.to_string()),
        }
    }

    /// Whether outputs follow what is set.
    pub(super) fn is_live(&self) -> bool {
        matches!(self.state(), State::Initialization | State::Stepping)
    }

    /// The variables with these value references; if one is unknown, the log says so.
    pub(super) fn find(&self, references: &[u32]) -> Option<Vec<&Variable>> {
        let find = |&reference: &u32| {
            let found = self.package.table().find(reference);
            if found.is_none() {
                self.log.error(&format!("there is no variable with value reference {reference}"));
            }
            found
        };
        references.iter().map(find).collect()
    }

    /// The values with these references, read by `read`, which knows values of one type (`kind` in words).
    ///
    /// Solves first if an output is asked for and inputs have changed. Where no equilibrium was ever found, only what tells
    /// of the search can be read.
    ///
    /// # Errors
    /// The ending, when there are no values.
    pub fn get<T>(
        &mut self,
        references: &[u32],
        kind: &str,
        read: fn(Value) -> Option<T>,
    ) -> Result<Vec<T>, Ending> {
        let variables = self.find(references).ok_or(Ending::Error)?;
        let margin = variables.iter().any(|variable| variable.name == MARGIN);
        if self.is_live() && variables.iter().any(|variable| variable.role == Role::Output) {
            let ending = self.ensure_solved();
            if ending != Ending::Ok {
                return Err(ending);
            }
        }
        if let Some(device) = self.condition.device.as_mut().filter(|_| margin) {
            device.measure_margin();
        }
        let device = self.condition.device.as_ref();
        let (outputs, has_shape) =
            (device.map(Manipulator::outputs), device.is_some_and(Manipulator::has_shape));
        let variables = self.find(references).ok_or(Ending::Error)?;
        let mut values = Vec::with_capacity(variables.len());
        for variable in variables {
            if variable.role == Role::Output && !has_shape && !variable.tells_of_search() {
                return Err(
                    self.refuse(&format!("{} has no value: no equilibrium was found yet", variable.name))
                );
            }
            let value = variable.given(&self.condition.given).or_else(|| variable.answer(outputs?));
            match value.and_then(read) {
                Some(value) => values.push(value),
                None => return Err(self.refuse(&format!("{} is no {kind}", variable.name))),
            }
        }
        Ok(values)
    }

    /// Sets all of these variables, or none.
    pub fn set(&mut self, references: &[u32], values: impl Iterator<Item = Value>) -> Ending {
        let Some(variables) = self.find(references) else { return Ending::Error };
        let mut given = self.condition.given.clone();
        let mut rebuild = false;
        for (variable, value) in variables.into_iter().zip(values) {
            let name = &variable.name;
            if !self.state().may_set(variable.role) {
                let role = variable.role;
                return self.refuse(&format!("{name} ({role:?}) cannot be set in state {:?}", self.state()));
            }
            if !variable.holds(value) {
                return self.refuse(&format!("{name} is of another type than the value {value:?}"));
            }
            if !variable.set(&mut given, value) {
                return self.refuse(&match value {
                    Value::Real(value) => Error::range(name, value, "finite").to_string(),
                    other => format!("{name} has no item {other:?}"),
                });
            }
            rebuild |= variable.role == Role::Fixed;
        }
        if given != self.condition.given {
            self.condition.given = given;
            self.condition.solved = false;
            if rebuild {
                self.condition.device = None;
            }
        }
        Ending::Ok
    }

    /// Solves for the inputs now set, unless that was done.
    pub(super) fn ensure_solved(&mut self) -> Ending {
        if self.condition.solved {
            return Ending::Ok;
        }
        match self.solve_here() {
            Ok(ending) => ending,
            Err(error) => self.refuse(&error.to_string()),
        }
    }

    /// Solves for the inputs now set.
    fn solve_here(&mut self) -> Result<Ending, Error> {
        let inputs = self.condition.given.inputs()?;
        self.solve(&[inputs])
    }

    /// Follows the equilibrium along a path of inputs.
    fn solve(&mut self, path: &[Inputs]) -> Result<Ending, Error> {
        let condition = &mut self.condition;
        let counts = self.package.table().counts();
        let mut device = match condition.device.take() {
            Some(device) => device,
            None => condition.given.manipulator(counts.shape_points)?,
        };
        if condition.state == State::Initialization {
            device.reset(); // the first equilibrium does not depend on what was read before
        }
        condition.jacobian = None;
        let device = condition.device.insert(device);
        let settings = &condition.given.settings;
        device.set_tolerances(settings.tolerance_position, settings.tolerance_angle)?;
        let snaps = device.outputs().snaps;
        let outputs = device.follow(path, condition.snaps)?;
        let lengths = [outputs.rings.len(), outputs.core_angles.len(), outputs.shape.len()];
        if lengths != [counts.rings, counts.cores, counts.shape_points] {
            return Err(Error::Unsupported(format!("the model answers with other lengths: {lengths:?}")));
        }
        let (was_near_fold, time, margin) = (condition.near_fold, condition.time, outputs.stability_margin);
        let (status, outcome, snapped) = (outputs.status, outputs.outcome, outputs.snaps > snaps);
        if status == Status::NotSolved {
            if condition.state == State::Stepping {
                condition.state = State::Failed;
            }
            let reason = reason(device, time);
            return Ok(self.refuse(&reason));
        }
        condition.solved = true;
        condition.ahead = true;
        condition.near_fold = status == Status::NearFold;
        if snapped {
            self.log.notice(&format!("snapped to another branch after t = {time}"));
        } else if outcome == Outcome::Neutral && !was_near_fold {
            self.log.notice(&format!("after t = {time}: {outcome}"));
        } else if status == Status::NearFold && !was_near_fold {
            self.log.notice(&format!("near a fold after t = {time}: stability margin {margin:.3}"));
        }
        Ok(Ending::Ok)
    }
}

/// Why there is no equilibrium, and what is left.
fn reason(device: &Manipulator, time: f64) -> String {
    let (outcome, percent) = (device.outputs().outcome, 100.0 * device.outputs().progress);
    if device.has_shape() {
        format!(
            "no equilibrium found after t = {time}, {percent:.0} % of the way: {outcome}; the last good outputs can be read, \
             reset or restore a state"
        )
    } else {
        format!(
            "no equilibrium found for the first inputs, {percent:.0} % of the way from the unloaded shape: {outcome}; there \
             are no outputs, reset and start elsewhere"
        )
    }
}
