//! Bending stops: loads of touching windings on the ends of the cores.

use super::super::settings::Settings;
use crate::rod::{BendingStop, Element};

/// The bending stops of all cores, where the model has them. Their stiffness appears within a few degrees.
#[derive(Debug, Clone, Copy)]
pub(crate) struct BendingStops {
    act: bool,
}

impl BendingStops {
    pub(crate) fn new(settings: &Settings) -> Self {
        Self { act: settings.has_bending_stop() }
    }

    /// The bending stop of an element's core; `None` where it has no windings, or where the model has no stops.
    pub(crate) fn of(self, element: &Element) -> Option<&BendingStop> {
        element.stop.as_ref().filter(|_| self.act)
    }
}
