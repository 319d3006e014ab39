//! Bending stops: loads of touching windings on the ends of the cores.

use nalgebra::Vector3;

use crate::equilibrium::settings::Settings;
use crate::rod::{Element, StopLoads};

/// The bending stops of all cores, where the model has them. Their stiffness appears within a few degrees.
#[derive(Debug, Clone, Copy)]
pub(crate) struct BendingStops {
    act: bool,
}

impl BendingStops {
    pub(super) fn new(settings: &Settings) -> Self {
        Self { act: settings.bending_stop }
    }

    /// Whether touching windings stiffen the cores.
    pub(crate) fn act(self) -> bool {
        self.act
    }

    /// Loads on both ends of an element's core, given the tangents there; `None` where its windings are open.
    pub(crate) fn loads(self, element: &Element, tangents: &[Vector3<f64>; 2]) -> Option<StopLoads> {
        element.stop.as_ref().filter(|_| self.act)?.loads(tangents)
    }
}
