//! What a host is told where no equilibrium was found.

use crate::manipulator::Manipulator;

/// What a host can do where no equilibrium was found.
pub(super) fn advice(manipulator: &Manipulator) -> &'static str {
    if manipulator.has_shape() {
        "the last good outputs can be read, reset or restore a state"
    } else {
        "there are no outputs, reset and start elsewhere"
    }
}

/// Why no equilibrium was found.
pub(super) fn why_not_solved(manipulator: &Manipulator) -> String {
    let (outcome, percent) = (manipulator.outputs().outcome, 100.0 * manipulator.outputs().progress);
    let inputs = if manipulator.has_shape() { "" } else { " for the first inputs" };
    let from = if manipulator.has_shape() { "" } else { " from the unloaded shape" };
    format!("no equilibrium found{inputs}, {percent:.0} % of the way{from}: {outcome}")
}
