//! One instance of the FMU in safe Rust: each C function only translates its arguments and calls one method.

use std::collections::BTreeMap;
use std::path::PathBuf;
use std::sync::Arc;

use super::fmu_state::{FmuState, Search};
use super::log::Log;
use super::package::Package;
use super::state::{Call, Ending, Interface, State};
use crate::error::Error;
use crate::manipulator::{Inputs, Manipulator, Outcome, Outputs, Status};

/// Relative tolerance for communication points, with respect to the larger of time and step size: hosts compute times by
/// adding up step sizes, with rounding errors.
const TIME_TOLERANCE: f64 = 1e-9;

/// An instance of the FMU.
#[derive(Debug)]
pub struct Instance {
    interface: Interface,
    pub(super) package: Arc<Package>,
    pub(super) log: Log,
    pub(super) fmu_state: FmuState,
    /// FMU states that the host has saved, by handle.
    pub(super) saved_states: BTreeMap<usize, FmuState>,
    /// Stop time of this run, s, if the host has defined one. A saved state does not carry it: the run that it is restored in may be
    /// longer.
    stop_time: Option<f64>,
    /// Whether the log has told of an unexpected communication point, which it does once.
    told_of_unexpected_time: bool,
    /// Whether the log has told of an orientation that nothing is connected to, which it does once.
    told_of_unconnected: bool,
}

/// The package that a host wants to instantiate.
///
/// It is read from the first of the directories `resources` that holds one; if none does, it is the built-in default
/// design.
///
/// # Errors
/// [`Error::Syntax`] for resources that were altered, and for a GUID that is not that of the package.
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
    /// A new instance of a package for one of the two interfaces, which writes to this log.
    #[must_use]
    pub fn new(interface: Interface, package: Arc<Package>, log: Log) -> Self {
        let counts = package.table().counts();
        log.event(&format!(
            "design {} with {} rings and {} cores",
            package.guid(),
            counts.rings,
            counts.cores
        ));
        let fmu_state = FmuState::new(package.start());
        Self {
            interface,
            package,
            log,
            fmu_state,
            saved_states: BTreeMap::new(),
            stop_time: None,
            told_of_unexpected_time: false,
            told_of_unconnected: false,
        }
    }

    /// What this instance is for.
    #[must_use]
    pub fn interface(&self) -> Interface {
        self.interface
    }

    /// State of the calling sequence.
    #[must_use]
    pub fn state(&self) -> State {
        self.fmu_state.state
    }

    /// Time of the last communication point, s.
    #[must_use]
    pub fn time(&self) -> f64 {
        self.fmu_state.time
    }

    /// Writes to the log why a call is refused, and returns the ending of that call.
    #[must_use]
    pub fn refuse(&self, reason: &str) -> Ending {
        self.log.error(reason);
        Ending::Error
    }

    /// Whether `call` is allowed in the present state; if not, the log says so and calls it by `name`.
    #[must_use]
    pub fn allows(&self, call: Call, name: &str) -> bool {
        let reason = if let Some(other) = call.interface().filter(|other| *other != self.interface) {
            let (own, other) = (self.interface.in_words(), other.in_words());
            format!("{name} is a function of {other}, and this instance is for {own}")
        } else if call == Call::CancelStep {
            format!("{name}: no step is under way, as every step is finished when it returns")
        } else if !self.state().allows(call) {
            format!("{name} is not allowed {}", self.state().in_words())
        } else {
            return true;
        };
        self.log.error(&reason);
        false
    }

    /// Discards everything after a panic, which may have left it inconsistent; only a reset makes the instance usable again.
    pub fn break_down(&mut self, message: &str) -> Ending {
        self.fmu_state = FmuState { state: State::Broken, ..FmuState::new(self.package.start()) };
        self.saved_states.clear();
        self.refuse(&format!("internal failure, reset or free the instance: {message}"))
    }

    /// Switches log categories on or off, as [`Log::choose`].
    pub fn set_debug_logging(&mut self, on: bool, categories: &[&str]) -> Ending {
        match self.log.choose(on, categories) {
            Ok(()) => Ending::Ok,
            Err(name) => self.refuse(&format!("there is no log category {name}")),
        }
    }

    /// Sets start time and stop time, s. The tolerance of the standard has no use here: every solve converges tightly.
    pub fn setup_experiment(&mut self, start: f64, stop: Option<f64>) -> Ending {
        if !start.is_finite() {
            return self.refuse(&Error::range("start time (s)", start, "finite").to_string());
        }
        if let Some(stop) = stop.filter(|stop| stop.is_nan() || *stop < start) {
            return self.refuse(&Error::range("stop time (s)", stop, "the start time or later").to_string());
        }
        self.fmu_state.time = start;
        self.stop_time = stop;
        Ending::Ok
    }

    /// Enters initialisation mode.
    pub fn enter_initialization(&mut self) -> Ending {
        self.fmu_state.state = State::Initialization;
        Ending::Ok
    }

    /// Leaves initialisation mode: checks the parameters and solves the first equilibrium.
    ///
    /// Parameters that are refused can be corrected, as the instance stays in initialisation mode then.
    pub fn exit_initialization(&mut self) -> Ending {
        let found = self.fmu_state.search == Search::Found;
        let ending = if found { Ok(Ending::Ok) } else { self.solve_at_host_values() };
        match ending {
            Ok(Ending::Ok) => {
                match self.interface {
                    Interface::CoSimulation => self.fmu_state.state = State::Stepping,
                    Interface::ModelExchange => self.start_in_event_mode(),
                }
                self.log.event(&format!("initialised at t = {}", self.fmu_state.time));
                Ending::Ok
            }
            Ok(failed) => {
                self.fmu_state.state = State::Failed;
                failed
            }
            Err(error) => self.refuse(&error.to_string()),
        }
    }

    /// Terminates the simulation.
    pub fn terminate(&mut self) -> Ending {
        self.fmu_state.state = State::Terminated;
        Ending::Ok
    }

    /// Returns to the state after instantiation. States that the host has saved are kept.
    pub fn reset(&mut self) -> Ending {
        self.fmu_state = FmuState::new(self.package.start());
        self.stop_time = None;
        self.told_of_unexpected_time = false;
        self.told_of_unconnected = false;
        self.log.forget_repetitions();
        Ending::Ok
    }

    /// Steps from the communication point `time` by `step_size`, both in s.
    ///
    /// The new equilibrium is that for the inputs now set. Where inputs have time derivatives, the equilibrium follows the
    /// inputs along their path, and the inputs keep the values at its end.
    pub fn do_step(&mut self, time: f64, step_size: f64) -> Ending {
        let end = time + step_size;
        if !time.is_finite() || !end.is_finite() || step_size < 0.0 {
            return self.refuse(&format!(
                "cannot step from t = {time} by {step_size}: both must be finite, and the step size not negative"
            ));
        }
        let tolerance = TIME_TOLERANCE * time.abs().max(self.fmu_state.time.abs()).max(step_size);
        if let Some(stop) = self.stop_time.filter(|stop| end > stop + tolerance) {
            return self.refuse(&format!("a step to t = {end} goes beyond the stop time {stop}"));
        }
        let unexpected = (time - self.fmu_state.time).abs() > tolerance;
        if unexpected && !self.told_of_unexpected_time {
            let expected = self.fmu_state.time;
            self.log.notice(&format!("step from t = {time}, but the last one ended at t = {expected}"));
            self.told_of_unexpected_time = true;
        }
        // Unchanged inputs are solved again, because the status `Snapped` holds for one step only.
        if !self.fmu_state.solved_ahead {
            self.fmu_state.search = Search::Open;
        }
        let moving = self.fmu_state.input_derivatives.move_inputs() && step_size > 0.0;
        let ending = if moving {
            self.follow_inputs(step_size)
        } else {
            self.ensure_solved().err().unwrap_or(Ending::Ok)
        };
        if ending != Ending::Ok {
            return ending;
        }
        let manipulator = self.fmu_state.manipulator.as_ref();
        self.fmu_state.snaps = manipulator.map_or(0, |manipulator| manipulator.outputs().snaps);
        self.fmu_state.input_derivatives.mark_used();
        self.fmu_state.solved_ahead = false;
        self.fmu_state.time = end;
        self.log.forget_repetitions();
        Ending::Ok
    }

    /// The outputs of the last equilibrium as they stand, with the margin as [`Outputs::stability_margin`] says; `None` where none
    /// was found since the start or the last reset.
    #[must_use]
    pub fn outputs(&self) -> Option<&Outputs> {
        let manipulator = self.fmu_state.manipulator.as_ref();
        manipulator.filter(|manipulator| manipulator.has_shape()).map(Manipulator::outputs)
    }

    /// Why no equilibrium was found, if the last step or the first solve failed for that; without what a host can do.
    #[must_use]
    pub fn why_failed(&self) -> Option<String> {
        let manipulator = self.fmu_state.manipulator.as_ref()?;
        (self.state() == State::Failed).then(|| why_not_solved(manipulator))
    }

    /// Goes on from the last good equilibrium after a step that failed, for a host that need not reset or restore a state, as the
    /// standard demands; without effect where there is none.
    pub fn recover(&mut self) {
        if self.state() == State::Failed && self.outputs().is_some() {
            self.fmu_state.state = State::Stepping;
        }
    }

    /// Follows the equilibrium while the inputs move along their path for `duration` (s).
    fn follow_inputs(&mut self, duration: f64) -> Ending {
        let FmuState { host_values, input_derivatives, search, .. } = &self.fmu_state;
        let path = host_values.inputs().and_then(|start| {
            let (mut waypoints, end) = input_derivatives.path(self.package.table(), host_values, duration)?;
            if *search != Search::Found {
                waypoints.insert(0, start);
            }
            Ok((waypoints, end))
        });
        match path.and_then(|(waypoints, end)| Ok((self.solve(&waypoints)?, end))) {
            Ok((Ending::Ok, end)) => {
                self.fmu_state.host_values = end;
                Ending::Ok
            }
            Ok((failed, _)) => failed,
            Err(error) => self.refuse(&error.to_string()),
        }
    }

    /// Solves the equilibrium for the inputs now set, unless that is done already or the outputs are those of the last communication
    /// point.
    ///
    /// # Errors
    /// As [`Self::ensure_solved`].
    pub(super) fn solve_if_live(&mut self) -> Result<(), Ending> {
        let live = [State::Initialization, State::Stepping, State::Event, State::ContinuousTime];
        if live.contains(&self.state()) { self.ensure_solved() } else { Ok(()) }
    }

    /// Solves the equilibrium for the inputs now set, unless that is done already.
    ///
    /// # Errors
    /// [`Ending::Discard`] or [`Ending::Error`], explained in the log, if there is none.
    pub(super) fn ensure_solved(&mut self) -> Result<(), Ending> {
        let ending = match self.fmu_state.search {
            Search::Found => Ending::Ok,
            Search::InVain => Ending::Discard, // the log has told why
            Search::Open => {
                self.solve_at_host_values().unwrap_or_else(|error| self.refuse(&error.to_string()))
            }
        };
        if ending == Ending::Ok { Ok(()) } else { Err(ending) }
    }

    fn solve_at_host_values(&mut self) -> Result<Ending, Error> {
        let values = &self.fmu_state.host_values;
        let inputs = values.inputs()?;
        if values.has_unconnected() && !self.told_of_unconnected {
            self.log.notice("an orientation of four zeros counts as not connected: its start value holds");
            self.told_of_unconnected = true;
        }
        self.solve(&[inputs])
    }

    /// Follows the equilibrium along a path of inputs, given by its waypoints.
    fn solve(&mut self, waypoints: &[Inputs]) -> Result<Ending, Error> {
        let now = &mut self.fmu_state;
        let counts = self.package.table().counts();
        let mut manipulator = if let Some(manipulator) = now.manipulator.take() {
            manipulator
        } else {
            let values = &now.host_values;
            let made = values.manipulator(counts.shape_points);
            made.map_err(|error| self.package.table().named(error, values))?
        };
        if now.state == State::Initialization {
            manipulator.reset(); // the first equilibrium must not depend on what was read before
        } else if let Some(accepted) = &now.accepted {
            manipulator.clone_from(accepted);
        }
        now.jacobian = None;
        let manipulator = now.manipulator.insert(manipulator);
        let settings = &now.host_values.settings;
        manipulator.set_tolerances(settings.tolerance_position, settings.tolerance_angle)?;
        let friction = manipulator.set_friction(now.host_values.friction);
        friction.map_err(|error| self.package.table().named(error, &now.host_values))?;
        let snaps = manipulator.outputs().snaps;
        let outputs = manipulator.follow(waypoints, now.snaps)?;
        let lengths = [outputs.rings.len(), outputs.core_angles.len(), outputs.shape.len()];
        if lengths != [counts.rings, counts.cores, counts.shape_points] {
            return Err(Error::Unsupported(format!(
                "the model answers with {} rings, {} cores and {} points: not those of the table",
                lengths[0], lengths[1], lengths[2]
            )));
        }
        let (was_near_fold, time, margin) = (now.near_fold, now.time, outputs.stability_margin);
        let (status, outcome, snapped) = (outputs.status, outputs.outcome, outputs.snaps > snaps);
        if status == Status::NotSolved {
            if now.state == State::Stepping {
                now.state = State::Failed;
            }
            let reason = format!("after t = {time}: {}", why_not_solved(manipulator));
            if matches!(now.state, State::Event | State::ContinuousTime) {
                now.search = Search::InVain;
                self.log.discard(&format!("{reason}; try inputs closer to those of the last accepted step"));
                return Ok(Ending::Discard);
            }
            let reason = format!("{reason}; {}", advice(manipulator));
            return Ok(self.refuse(&reason));
        }
        now.search = Search::Found;
        now.solved_ahead = true;
        now.near_fold = status == Status::NearFold;
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

/// What a host can do where no equilibrium was found.
fn advice(manipulator: &Manipulator) -> &'static str {
    if manipulator.has_shape() {
        "the last good outputs can be read, reset or restore a state"
    } else {
        "there are no outputs, reset and start elsewhere"
    }
}

/// Why no equilibrium was found.
fn why_not_solved(manipulator: &Manipulator) -> String {
    let (outcome, percent) = (manipulator.outputs().outcome, 100.0 * manipulator.outputs().progress);
    let inputs = if manipulator.has_shape() { "" } else { " for the first inputs" };
    let from = if manipulator.has_shape() { "" } else { " from the unloaded shape" };
    format!("no equilibrium found{inputs}, {percent:.0} % of the way{from}: {outcome}")
}
