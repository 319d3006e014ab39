//! An instance in model exchange: its modes, and the steps that the host accepts.
//!
//! There are no continuous states, and the outputs follow from the inputs; but where several equilibria exist, the past decides. The
//! past is what the host has accepted: the equilibrium at the end of initialisation, of each iteration in event mode and of each
//! completed integrator step. Values for other inputs are sought from there, so that they do not depend on what else a host tries,
//! as its integrator or its optimiser does (FMI 2.0.4, section 3.1).

use super::instance::Instance;
use super::state::{Ending, State};
use crate::error::Error;

impl Instance {
    /// Begins in event mode with the first equilibrium.
    pub(super) fn start_in_event_mode(&mut self) {
        self.fmu_state.state = State::Event;
        self.accept();
    }

    /// Enters event mode.
    pub fn enter_event_mode(&mut self) -> Ending {
        self.fmu_state.state = State::Event;
        Ending::Ok
    }

    /// Enters continuous-time mode.
    pub fn enter_continuous_time_mode(&mut self) -> Ending {
        self.fmu_state.state = State::ContinuousTime;
        Ending::Ok
    }

    /// Accepts the equilibrium for the inputs now set; no event follows from it.
    pub fn new_discrete_states(&mut self) -> Ending {
        match self.ensure_solved() {
            Ok(()) => self.accept(),
            Err(ending) => return ending,
        }
        Ending::Ok
    }

    /// Accepts the equilibrium for the inputs now set. Whether the shape has snapped since the last accepted one: then integer and
    /// Boolean outputs have changed, which is an event.
    ///
    /// # Errors
    /// [`Ending::Discard`] or [`Ending::Error`], explained in the log, if there is none.
    pub fn completed_integrator_step(&mut self) -> Result<bool, Ending> {
        let before = self.fmu_state.snaps;
        self.ensure_solved()?;
        self.accept();
        Ok(self.fmu_state.snaps > before)
    }

    /// Sets the time, s; nothing depends on it.
    pub fn set_time(&mut self, time: f64) -> Ending {
        if !time.is_finite() {
            return self.refuse(&Error::range("time (s)", time, "finite").to_string());
        }
        self.fmu_state.time = time;
        Ending::Ok
    }

    /// Accepts arrays of length 0 for quantities that this FMU does not have.
    #[must_use]
    pub fn expect_none(&self, of: &str, length: usize) -> Ending {
        if length == 0 {
            Ending::Ok
        } else {
            self.refuse(&format!("there are no {of}, and {length} are asked for"))
        }
    }

    fn accept(&mut self) {
        let now = &mut self.fmu_state;
        now.snaps = now.manipulator.as_ref().map_or(0, |manipulator| manipulator.outputs().snaps);
        now.accepted.clone_from(&now.manipulator);
        self.log.step_done();
    }
}
