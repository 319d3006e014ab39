//! Contact of the chain with a vessel: what of it lasts from shape to shape, and what it was at the last one.

use std::sync::Arc;

use super::friction::{Friction, Stage};
use super::loading::Loading;
use super::surface::Surface;
use super::wall_contacts::WallContacts;
use super::wall_forces::WallForces;
use crate::equilibrium::model::{Chain, Inputs, Surroundings, Workspace};
use crate::geometry::Pose;
use crate::vessel::Vessel;

/// A vessel around a chain: its wall, the contacts with it at the shape evaluated last, and friction with its memory.
#[derive(Debug, Clone)]
pub(crate) struct VesselContact {
    surroundings: Arc<(Vessel, Surface)>,
    pub(crate) walls: WallContacts,
    pub(crate) friction: Friction,
}

impl VesselContact {
    pub(crate) fn new(vessel: &Vessel, chain: &Chain) -> Self {
        Self {
            surroundings: Arc::new((vessel.clone(), Surface::new(chain))),
            walls: WallContacts::default(),
            friction: Friction::new(vessel.wall.friction()),
        }
    }

    pub(crate) fn vessel(&self) -> &Vessel {
        &self.surroundings.0
    }

    pub(crate) fn surface(&self) -> &Surface {
        &self.surroundings.1
    }

    /// Forgets all contacts, and where friction held the chain.
    pub(crate) fn forget(&mut self) {
        self.walls = WallContacts::default();
        self.friction.forget();
    }

    /// Whether nothing changes when a chain turns about the axis of this frame.
    pub(crate) fn is_symmetric_about(&self, axis: &Pose) -> bool {
        !self.friction.holds() && self.vessel().lumen.is_symmetric_about(axis)
    }

    /// The widening (m) of the lumen with which the chain would nowhere touch the wall.
    pub(crate) fn missing_width(
        &mut self,
        chain: &Chain,
        inputs: &Inputs,
        unknowns: &[f64],
        work: &mut Workspace,
    ) -> f64 {
        work.place(chain, inputs, unknowns);
        self.loading(chain, inputs, unknowns, work).missing_width()
    }

    /// What the wall does to a chain of `rings` rings.
    pub(crate) fn forces(&self, rings: usize) -> WallForces {
        WallForces::of(&self.walls, rings)
    }

    /// Holds a chain that was free by friction where it is, from the next solve on; with a coefficient of 0 it is let go.
    pub(crate) fn set_friction(&mut self, coefficient: f64, solved: bool) {
        if coefficient == 0.0 {
            self.friction.forget();
        } else if !self.friction.acts() && solved {
            self.friction.memory.stage = Stage::Moved;
        }
        self.friction.coefficient = coefficient;
    }

    fn loading<'a>(
        &'a mut self,
        chain: &'a Chain,
        inputs: &Inputs,
        unknowns: &'a [f64],
        work: &'a mut Workspace,
    ) -> Loading<'a> {
        let Self { surroundings, walls, friction } = self;
        let (vessel, surface) = &**surroundings;
        Loading::new((vessel, surface), (chain, inputs, unknowns), work, (walls, friction))
    }
}

impl Surroundings for VesselContact {
    fn load(&mut self, chain: &Chain, inputs: &Inputs, unknowns: &[f64], work: &mut Workspace) -> f64 {
        self.walls.clear();
        self.friction.normal_forces.clear();
        self.loading(chain, inputs, unknowns, work).load()
    }
}
