//! Settings that a scene states: what they are called, what they are, and what they may be.

use crate::error::{Interval, quantities};

quantities! {
    // Name in errors, key in a scene, variable of the FMU, description, interval in the unit of the library.
    TOLERANCE_POSITION: "tolerance of the tip position (m)", "model.tolerance_position_mm", "model.tolerance_position",
        "How far the tip may be from the converged answer of the model; the relative tolerance may ask for less",
        Interval::above(0.0);
    TOLERANCE_ANGLE: "tolerance of the tip angle (rad)", "model.tolerance_angle_deg", "model.tolerance_angle",
        "How far the tip may be turned against the converged answer of the model", Interval::above(0.0);
    TOLERANCE_RELATIVE: "relative tolerance of the tip position", "model.tolerance_relative", "model.tolerance_relative",
        "How far the tip may be from the converged answer of the model, relative to its distance from its unloaded place; 0: the other two alone count",
        Interval::at_least(0.0).at_most(1.0);
    ITERATIONS: "number of iterations", "model.iterations", "", "Iterations that one solve may take",
        Interval::at_least(1.0).at_most(1e6);
    TIME_BUDGET: "processor time of a solve (s)", "model.time_budget_s", "model.time_budget",
        "Processor time that a solve may take before it ends as out of budget", Interval::above(0.0);
}
