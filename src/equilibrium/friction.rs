//! Friction of the chain on the wall: its coefficient, and its memory.

use nalgebra::Vector3;
use serde::{Deserialize, Serialize};

use super::grip::{Grip, Place};

/// How far the friction of a branch has come.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize)]
pub(super) enum Stage {
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
    pub(super) stage: Stage,
    /// In the order of their places.
    pub(super) grips: Vec<Grip>,
}

impl FrictionMemory {
    pub(super) fn is_finite(&self) -> bool {
        self.grips.iter().all(Grip::is_finite)
    }
}

/// Where the wall presses on the chain.
#[derive(Debug, Clone, Copy)]
pub(super) enum Where {
    /// A place by itself.
    At(Place),
    /// Element, its piece, and the arc length along the element's tables, m.
    Along(usize, usize, f64),
}

/// A normal force of the wall on the chain.
#[derive(Debug, Clone, Copy)]
pub(super) struct Pressure {
    pub(super) on: Where,
    /// Force on the chain, N, world axes.
    pub(super) force: Vector3<f64>,
    /// From the frame's origin to where the wall is touched, m, world axes.
    pub(super) arm: Vector3<f64>,
}

/// Friction between the chain and the wall.
#[derive(Debug, Clone, Default)]
pub(super) struct Friction {
    /// Coefficient of friction; 0 without friction, which then costs nothing.
    pub(super) coefficient: f64,
    pub(super) memory: FrictionMemory,
    /// Normal forces at the shape evaluated last; not recorded without friction.
    pub(super) pressures: Vec<Pressure>,
    /// The memory before the present solve, and at the last equilibrium on its way.
    pub(super) before: FrictionMemory,
    pub(super) reached: FrictionMemory,
}

impl Friction {
    /// Whether there is friction.
    pub(super) fn acts(&self) -> bool {
        self.coefficient > 0.0
    }

    /// Whether a solve that begins now is under friction.
    pub(super) fn holds(&self) -> bool {
        self.acts() && self.memory.stage != Stage::Free
    }

    /// Forgets where the chain was held.
    pub(super) fn forget(&mut self) {
        self.memory = FrictionMemory::default();
    }

    /// Takes over coefficient and memory of another model of the same design. A first shape is not held for other models: each
    /// finds its own.
    pub(super) fn take_over(&mut self, other: &Self) {
        self.coefficient = other.coefficient;
        self.recall(&other.memory);
    }

    /// Takes over the memory of another model of the same design.
    pub(super) fn recall(&mut self, memory: &FrictionMemory) {
        self.memory.clone_from(memory);
        if self.memory.stage == Stage::Rested {
            self.forget();
        }
    }

    pub(super) fn press(&mut self, pressure: Pressure) {
        if self.acts() {
            self.pressures.push(pressure);
        }
    }
}
