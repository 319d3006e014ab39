//! An instance from its set-up to its end: the calls that a host makes once, or to begin again.

use super::fmu_state::FmuState;
use super::instance::{Instance, Sought, Told};
use super::state::{Ending, Interface, State};
use crate::error::Error;

impl Instance {
    /// Switches log categories on or off, as [`super::log::Log::choose`].
    pub fn set_debug_logging(&mut self, on: bool, categories: &[&str]) -> Ending {
        match self.log.choose(on, categories) {
            Ok(()) => Ending::Ok,
            Err(name) => self.refuse(&format!("there is no log category {name}")),
        }
    }

    /// Sets start time and stop time, s. The tolerance of the standard has no use here: every solve converges tightly.
    ///
    /// Where one of them is refused neither is set, and initialisation does not begin until both are allowed.
    pub fn setup_experiment(&mut self, start: f64, stop: Option<f64>) -> Ending {
        self.times_refused = true;
        if !start.is_finite() {
            return self.refuse(&Error::range("start time (s)", start, "finite").to_string());
        }
        if let Some(stop) = stop.filter(|stop| stop.is_nan() || *stop < start) {
            return self.refuse(&Error::range("stop time (s)", stop, "the start time or later").to_string());
        }
        self.fmu_state.time = start;
        self.stop_time = stop;
        self.times_refused = false;
        Ending::Ok
    }

    /// Enters initialisation mode.
    pub fn enter_initialization(&mut self) -> Ending {
        if self.times_refused {
            return self.refuse(
                "the start or stop time was refused: set up the experiment with times that are allowed",
            );
        }
        self.fmu_state.state = State::Initialization;
        Ending::Ok
    }

    /// Leaves initialisation mode: checks the parameters and solves the first equilibrium.
    ///
    /// Parameters that are refused can be corrected, as the instance stays in initialisation mode then.
    pub fn exit_initialization(&mut self) -> Ending {
        let odd = self.package.table().warnings(&self.fmu_state.host_values, self.package.start());
        for odd in &odd {
            self.log.notice(odd);
        }
        match self.seek() {
            Sought::Found => {}
            Sought::InVain => {
                self.fmu_state.state = State::Failed;
                return self.tell_of_failed_step();
            }
            Sought::Refused(reason) => return self.refuse(&reason),
        }
        match self.interface {
            Interface::CoSimulation => self.fmu_state.state = State::Stepping,
            Interface::ModelExchange => self.start_in_event_mode(),
        }
        self.log.event(&format!("initialised at t = {}", self.fmu_state.time));
        Ending::Ok
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
        self.times_refused = false;
        self.told = Told::default();
        self.log.step_done();
        Ending::Ok
    }
}
