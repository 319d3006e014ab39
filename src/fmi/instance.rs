//! One instance of the FMU in safe Rust: each C function only translates its arguments and calls one method.

use std::collections::BTreeMap;
use std::sync::Arc;

use super::advice::{advice, why_not_solved};
use super::fmu_state::{FmuState, Search};
use super::log::Log;
use super::package::Package;
use super::search_report::SearchReport;
use super::state::{Call, Ending, Interface, State};
use super::value::Value;
use super::variable::Variable;
use crate::error::Error;
use crate::manipulator::{Inputs, Manipulator, Outcome, Outputs, Status, TipTolerance};

/// An instance of the FMU.
#[derive(Debug)]
pub struct Instance {
    pub(super) interface: Interface,
    pub(super) package: Arc<Package>,
    pub(super) log: Log,
    pub(super) fmu_state: FmuState,
    /// FMU states that the host has saved, by handle.
    pub(super) saved_states: BTreeMap<usize, FmuState>,
    /// Stop time of this run, s, if the host has defined one. A saved state does not carry it: the run that it is restored in may be
    /// longer.
    pub(super) stop_time: Option<f64>,
    /// Whether the host's last start or stop time was refused: a run that began all the same would have another one.
    pub(super) times_refused: bool,
    pub(super) told: Told,
}

/// What the log tells of once in a run, and has told of.
#[derive(Debug, Default)]
pub(super) struct Told {
    /// An unexpected communication point.
    pub(super) unexpected_time: bool,
    /// An orientation that nothing is connected to.
    pub(super) unconnected: bool,
    /// An orientation that is not of unit norm.
    pub(super) norm: bool,
}

/// What came of the search for an equilibrium.
#[derive(Debug, PartialEq, Eq)]
pub(super) enum Sought {
    /// It was found.
    Found,
    /// There is none.
    InVain,
    /// It was not sought, since inputs or parameters are not allowed: the reason.
    Refused(String),
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
        for odd in package.warnings() {
            log.notice(odd);
        }
        let fmu_state = FmuState::new(package.start());
        Self {
            interface,
            package,
            log,
            fmu_state,
            saved_states: BTreeMap::new(),
            stop_time: None,
            times_refused: false,
            told: Told::default(),
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

    /// The outputs of the last equilibrium as they stand, with the margin as [`Outputs::stability_margin`] says; `None` where none
    /// was found since the start or the last reset.
    #[must_use]
    pub fn outputs(&self) -> Option<&Outputs> {
        let manipulator = self.fmu_state.manipulator.as_ref();
        manipulator.filter(|manipulator| manipulator.has_shape()).map(Manipulator::outputs)
    }

    /// The value of a result as it stands: of the last equilibrium, or of the search for one; `None` where there is none.
    #[must_use]
    pub fn result(&self, variable: &Variable) -> Option<Value> {
        let outputs = self.fmu_state.manipulator.as_ref().map(Manipulator::outputs);
        let report = SearchReport::of(outputs, self.is_refused());
        variable.of_search(&report).or_else(|| variable.output(self.outputs()?))
    }

    /// Whether inputs or parameters that the host has set are not allowed: then the outputs are the last good ones.
    #[must_use]
    pub fn is_refused(&self) -> bool {
        !self.fmu_state.refused.is_empty() || matches!(self.fmu_state.search, Search::Refused(_))
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
            self.fmu_state.search = Search::Open;
        }
    }

    /// Solves the equilibrium for the inputs now set, unless that is done already or the outputs are those of the last communication
    /// point.
    ///
    /// # Errors
    /// As [`Self::ensure_solved`].
    pub(super) fn solve_if_live(&mut self) -> Result<(), Ending> {
        if self.is_live() { self.ensure_solved() } else { Ok(()) }
    }

    /// Whether outputs are those of the inputs now set, and not those of the last communication point.
    pub(super) fn is_live(&self) -> bool {
        matches!(self.state(), State::Initialization | State::Stepping | State::Event | State::ContinuousTime)
    }

    /// Solves the equilibrium for the inputs now set, unless that is done already.
    ///
    /// # Errors
    /// [`Ending::Discard`] or [`Ending::Error`], explained in the log, if there is none.
    pub(super) fn ensure_solved(&mut self) -> Result<(), Ending> {
        match self.seek() {
            Sought::Found => Ok(()),
            Sought::InVain => Err(self.tell_of_failed_trial()),
            Sought::Refused(reason) => Err(self.refuse(&reason)),
        }
    }

    /// Seeks the equilibrium for the inputs now set, unless what comes of that is known already.
    pub(super) fn seek(&mut self) -> Sought {
        if let Some(reason) = self.refused_values() {
            return Sought::Refused(reason);
        }
        match &self.fmu_state.search {
            Search::Found => Sought::Found,
            Search::InVain => Sought::InVain,
            Search::Refused(reason) => Sought::Refused(reason.clone()),
            Search::Open => {
                let waypoints = self.inputs_now().map(|inputs| vec![inputs]);
                self.sought(waypoints)
            }
        }
    }

    /// Seeks the equilibrium along these waypoints, and notes it where they, or the parameters, are not allowed.
    pub(super) fn sought(&mut self, waypoints: Result<Vec<Inputs>, Error>) -> Sought {
        let solved = waypoints.and_then(|waypoints| self.solve(&waypoints));
        solved.unwrap_or_else(|error| {
            let reason = error.to_string();
            self.fmu_state.search = Search::Refused(reason.clone());
            Sought::Refused(reason)
        })
    }

    /// Which values the host wanted to set and that were not taken, if there are any.
    fn refused_values(&self) -> Option<String> {
        let found =
            self.fmu_state.refused.iter().filter_map(|&reference| self.package.table().find(reference));
        let names: Vec<&str> = found.map(|variable| variable.name.as_str()).collect();
        let [first, others @ ..] = &names[..] else { return None };
        let others = if others.is_empty() { String::new() } else { format!(" and {} others", others.len()) };
        Some(format!(
            "the last value of {first}{others} was refused: nothing is solved until an allowed one is set"
        ))
    }

    fn inputs_now(&mut self) -> Result<Inputs, Error> {
        let values = &self.fmu_state.host_values;
        let inputs = values.inputs()?;
        if values.has_unconnected() && !self.told.unconnected {
            self.log.notice(
                "an orientation whose norm is below 0.001, as that of four zeros, counts as not connected: its start value holds",
            );
            self.told.unconnected = true;
        }
        if !self.told.norm
            && let Some((name, norm)) = values.off_unit_norm()
        {
            self.log.notice(&format!("{name} has the norm {norm:.4}: orientations are normalised"));
            self.told.norm = true;
        }
        Ok(inputs)
    }

    /// Follows the equilibrium along a path of inputs, given by its waypoints.
    ///
    /// # Errors
    /// Those of the parameters and of the inputs, which are then not allowed; the last good equilibrium stays.
    fn solve(&mut self, waypoints: &[Inputs]) -> Result<Sought, Error> {
        let now = &mut self.fmu_state;
        let mut manipulator = if let Some(manipulator) = now.manipulator.take() {
            manipulator
        } else {
            let made = now.host_values.manipulator(self.package.table().counts().shape_points);
            made.map_err(|error| self.package.table().named(error))?
        };
        let first = now.state == State::Initialization;
        let before = first.then(|| manipulator.clone());
        if first {
            manipulator.reset(); // the first equilibrium must not depend on what was read before
        } else if let Some(accepted) = &now.accepted {
            manipulator.clone_from(accepted);
        }

        now.jacobian = None;
        let followed = self.follow(&mut manipulator, waypoints);
        let kept = before.filter(|_| followed.is_err()).unwrap_or(manipulator);
        self.fmu_state.manipulator = Some(kept);
        followed
    }

    fn follow(&mut self, manipulator: &mut Manipulator, waypoints: &[Inputs]) -> Result<Sought, Error> {
        let now = &self.fmu_state;
        let counts = self.package.table().counts();
        let settings = &now.host_values.settings;
        manipulator.set_tolerance(TipTolerance::of(settings))?;
        let friction = manipulator.set_friction(now.host_values.friction);
        friction.map_err(|error| self.package.table().named(error))?;

        let snaps = manipulator.outputs().snaps;
        let outputs = manipulator.follow(waypoints, now.snaps)?;
        let lengths = [outputs.rings.len(), outputs.core_angles.len(), outputs.shape.len()];
        if lengths != [counts.rings, counts.cores, counts.shape_points] {
            return Err(Error::Unsupported(format!(
                "the model answers with {} rings, {} cores and {} points: not those of the table",
                lengths[0], lengths[1], lengths[2]
            )));
        }
        if outputs.status == Status::NotSolved {
            self.fmu_state.search = Search::InVain;
            return Ok(Sought::InVain);
        }
        self.note(outputs, outputs.snaps > snaps);
        Ok(Sought::Found)
    }

    /// Notes that an equilibrium was found, and tells what a user should know about it.
    fn note(&mut self, outputs: &Outputs, snapped: bool) {
        let now = &mut self.fmu_state;
        let (time, margin, near_fold) =
            (now.time, outputs.stability_margin, outputs.status == Status::NearFold);
        let was_near_fold = std::mem::replace(&mut now.near_fold, near_fold);
        now.search = Search::Found;
        now.solved_ahead = true;

        if snapped {
            self.log.notice_once(&format!("snapped to another branch after t = {time}"));
        } else if outputs.outcome == Outcome::Neutral && !was_near_fold {
            self.log.notice_once(&format!("after t = {time}: {}", outputs.outcome));
        } else if near_fold && !was_near_fold {
            self.log.notice_once(&format!("near a fold after t = {time}: stability margin {margin:.3}"));
        }
    }

    /// Tells why a step, or the first solve, found no equilibrium.
    pub(super) fn tell_of_failed_step(&self) -> Ending {
        let Some(manipulator) = &self.fmu_state.manipulator else { return Ending::Error };
        let (time, why, advice) = (self.fmu_state.time, why_not_solved(manipulator), advice(manipulator));
        self.refuse(&format!("after t = {time}: {why}; {advice}"))
    }

    /// Tells why there is no equilibrium for inputs that a host tries between steps.
    pub(super) fn tell_of_failed_trial(&self) -> Ending {
        let Some(manipulator) = &self.fmu_state.manipulator else { return Ending::Error };
        let reason = format!("after t = {}: {}", self.fmu_state.time, why_not_solved(manipulator));
        if matches!(self.state(), State::Event | State::ContinuousTime) {
            let advice = "try inputs closer to those of the last accepted step";
            self.log.discard_once(&format!("{reason}; {advice}"));
            return Ending::Discard;
        }
        self.refuse(&format!("{reason}; set other inputs"))
    }
}
