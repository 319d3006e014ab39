//! The communication steps of an instance in co-simulation.

use super::fmu_state::{FmuState, Search};
use super::instance::{Instance, Sought};
use super::state::{Ending, State};

/// Relative tolerance for communication points, with respect to the larger of time and step size: hosts compute times by
/// adding up step sizes, with rounding errors.
const TIME_TOLERANCE: f64 = 1e-9;

impl Instance {
    /// Steps from the communication point `time` by `step_size`, both in s.
    ///
    /// The new equilibrium is that for the inputs now set. Where inputs have time derivatives, the equilibrium follows the
    /// inputs along their path, and the inputs keep the values at its end.
    pub fn do_step(&mut self, time: f64, step_size: f64) -> Ending {
        let end = time + step_size;
        if let Some(reason) = self.refused_step(time, step_size) {
            return self.refuse(&reason);
        }
        self.tell_of_unexpected(time, step_size);

        // Unchanged inputs are solved again, because the status `Snapped` holds for one step only.
        if !self.fmu_state.solved_ahead && self.fmu_state.search == Search::Found {
            self.fmu_state.search = Search::Open;
        }
        let moving = self.fmu_state.input_derivatives.move_inputs() && step_size > 0.0;
        match if moving { self.follow_inputs(step_size) } else { self.seek() } {
            Sought::Found => {}
            Sought::InVain => {
                self.fmu_state.state = State::Failed;
                return self.tell_of_failed_step();
            }
            Sought::Refused(reason) => return self.refuse(&reason),
        }

        let manipulator = self.fmu_state.manipulator.as_ref();
        self.fmu_state.snaps = manipulator.map_or(0, |manipulator| manipulator.outputs().snaps);
        self.fmu_state.input_derivatives.mark_used();
        self.fmu_state.solved_ahead = false;
        self.fmu_state.time = end;
        self.log.step_done();
        Ending::Ok
    }

    fn tolerance_of(&self, time: f64, step_size: f64) -> f64 {
        TIME_TOLERANCE * time.abs().max(self.fmu_state.time.abs()).max(step_size)
    }

    /// Why a step cannot be done, whatever the inputs are.
    fn refused_step(&self, time: f64, step_size: f64) -> Option<String> {
        let end = time + step_size;
        if !time.is_finite() || !end.is_finite() || step_size < 0.0 {
            return Some(format!(
                "cannot step from t = {time} by {step_size}: both must be finite, and the step size not negative"
            ));
        }
        let beyond = |stop: &f64| end > stop + self.tolerance_of(time, step_size);
        self.stop_time
            .filter(beyond)
            .map(|stop| format!("a step to t = {end} goes beyond the stop time {stop}"))
    }

    fn tell_of_unexpected(&mut self, time: f64, step_size: f64) {
        let expected = self.fmu_state.time;
        if (time - expected).abs() > self.tolerance_of(time, step_size) && !self.told.unexpected_time {
            self.log.notice(&format!("step from t = {time}, but the last one ended at t = {expected}"));
            self.told.unexpected_time = true;
        }
    }

    /// Seeks the equilibrium while the inputs move along their path for `duration` (s).
    fn follow_inputs(&mut self, duration: f64) -> Sought {
        if self.is_refused() {
            return self.seek(); // for the reason
        }
        let FmuState { host_values, input_derivatives, search, .. } = &self.fmu_state;
        let path = host_values.inputs().and_then(|start| {
            let (mut waypoints, end) = input_derivatives.path(self.package.table(), host_values, duration)?;
            if *search != Search::Found {
                waypoints.insert(0, start);
            }
            Ok((waypoints, end))
        });
        let (waypoints, end) = match path {
            Ok((waypoints, end)) => (Ok(waypoints), Some(end)),
            Err(error) => (Err(error), None),
        };
        let sought = self.sought(waypoints);
        if let (Sought::Found, Some(end)) = (&sought, end) {
            self.fmu_state.host_values = end;
        }
        sought
    }
}
