//! Friction of the chain on the wall: its coefficient, and its memory.

use nalgebra::Vector3;
use serde::{Deserialize, Serialize};

use super::friction_contact::{FrictionContact, Place};

/// How far the friction of a branch has come.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize)]
pub(crate) enum Stage {
    /// No shape has been found yet: the first one is without friction.
    #[default]
    Free,
    /// The wall holds the first shape as it was found.
    Rested,
    /// The chain has moved under friction.
    Moved,
}

/// What friction remembers from shape to shape.
#[derive(Debug, Clone, PartialEq, Default, Serialize, Deserialize)]
pub(crate) struct FrictionMemory {
    pub(crate) stage: Stage,
    /// In the order of their places.
    pub(crate) contacts: Vec<FrictionContact>,
}

impl FrictionMemory {
    pub(crate) fn is_finite(&self) -> bool {
        self.contacts.iter().all(FrictionContact::is_finite)
    }
}

/// Where the wall presses on the chain.
#[derive(Debug, Clone, Copy)]
pub(crate) enum Where {
    /// A place by itself.
    At(Place),
    /// Element, its piece, and the arc length along the element's tables, m.
    Along(usize, usize, f64),
}

/// A normal force of the wall on the chain.
#[derive(Debug, Clone, Copy)]
pub(crate) struct NormalForce {
    pub(crate) on: Where,
    /// Force on the chain, N, world axes.
    pub(crate) force: Vector3<f64>,
    /// From the frame's origin to where the wall is touched, m, world axes.
    pub(crate) arm: Vector3<f64>,
}

/// Friction between the chain and the wall.
#[derive(Debug, Clone, Default)]
pub(crate) struct Friction {
    /// Coefficient of friction; 0 without friction, which then costs nothing.
    pub(crate) coefficient: f64,
    pub(crate) memory: FrictionMemory,
    /// Normal forces at the shape evaluated last; not recorded without friction.
    pub(super) normal_forces: Vec<NormalForce>,
    /// The memory before the present solve, and at the last equilibrium on its way.
    before: FrictionMemory,
    reached: FrictionMemory,
}

impl Friction {
    /// Friction of this coefficient, which has not held anything yet.
    pub(super) fn new(coefficient: f64) -> Self {
        Self { coefficient, ..Self::default() }
    }

    /// Whether there is friction.
    pub(crate) fn acts(&self) -> bool {
        self.coefficient > 0.0
    }

    /// Whether a solve that begins now is under friction.
    pub(crate) fn holds(&self) -> bool {
        self.acts() && self.memory.stage != Stage::Free
    }

    /// Forgets where the chain was held.
    pub(crate) fn forget(&mut self) {
        self.memory = FrictionMemory::default();
    }

    /// Takes over coefficient and memory of another model of the same design. A first shape is not held for other models: each
    /// finds its own.
    pub(crate) fn take_over(&mut self, other: &Self) {
        self.coefficient = other.coefficient;
        self.recall(&other.memory);
    }

    /// Whether the chain was or is held somewhere in the present solve.
    pub(crate) fn has_held(&self) -> bool {
        !(self.memory.contacts.is_empty() && self.before.contacts.is_empty())
    }

    /// Whether nothing presses or is held at the shape evaluated last.
    pub(crate) fn is_idle(&self) -> bool {
        self.memory.contacts.is_empty() && self.normal_forces.is_empty()
    }

    /// Takes over the memory of another model of the same design.
    pub(crate) fn recall(&mut self, memory: &FrictionMemory) {
        self.memory.clone_from(memory);
        if self.memory.stage == Stage::Rested {
            self.forget();
        }
    }

    /// Begins a solve: keeps the memory for the case that it fails.
    pub(crate) fn begin(&mut self) {
        if self.acts() {
            self.before.clone_from(&self.memory);
        }
    }

    /// Keeps the memory at an equilibrium on the way.
    pub(crate) fn note(&mut self) {
        if self.acts() {
            self.reached.clone_from(&self.memory);
        }
    }

    /// Gives the memory back that it had before a solve that failed or, if asked, at the last equilibrium on its way.
    pub(crate) fn go_back(&mut self, on_the_way: bool) {
        if self.acts() {
            let from = if on_the_way { &self.reached } else { &self.before };
            self.memory.clone_from(from);
        }
    }

    pub(super) fn press(&mut self, force: NormalForce) {
        if self.acts() {
            self.normal_forces.push(force);
        }
    }
}
