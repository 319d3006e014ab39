//! Which inputs and parameters each output depends on: `dependencies` and `dependenciesKind` of the model structure.
//!
//! Both sides carry a tag: an input or parameter says what it acts on ([`Known`]), an output by what path it is reached
//! ([`Dependency`]). The words are the standard's (FMI 2.0.4, section 2.2.8): an *unknown* depends on *knowns*.

use super::derivative_role::DerivativeRole;
use crate::manipulator::Output;

/// What an input or parameter acts on, as far as some output distinguishes it from the others.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Known {
    /// The position of the base.
    BasePosition,
    /// The orientation of the base.
    BaseOrientation,
    /// The force on a ring magnet that is clamped. The clamp bears it directly; no other part of the manipulator does.
    ClampedRingForce,
    /// The length of the ring magnets.
    RingLength,
    /// The length of another body of the chain.
    BodyLength,
    /// Pose, strength or shape of a magnet or coil.
    Source,
    /// How accurately an equilibrium is computed, or for how long: it moves no equilibrium, but what is found of it.
    Accuracy,
    /// Friction, whose effect depends on the way to a shape.
    Friction,
    /// Anything else that acts on the equilibrium.
    Other,
}

/// How an output depends on inputs and parameters.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Dependency {
    /// Through the equilibrium: on everything but the force on a clamped ring.
    Equilibrium,
    /// As the force of the clamp: on everything; the force on a clamped ring is taken from it as it is.
    ClampForce,
    /// As the moment of the clamp: on everything.
    ClampMoment,
    /// As the first point of the centreline, which is the position of the base.
    BasePoint,
    /// As the centre of a clamped ring: on the pose of the base and the length of the ring.
    ClampedCentre,
    /// As the axis of a clamped ring or of the base: on the orientation of the base.
    ClampedAxis,
    /// As an arc length: on the lengths of the bodies.
    Lengths,
    /// As the wrench of magnets and coils on one another: on those alone.
    Sources,
}

/// The standard's kind of a dependency.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum DependencyKind {
    /// A dependency without particular structure.
    Dependent,
    /// The output is a constant factor times the known variable, plus other terms.
    Constant,
}

impl DependencyKind {
    /// The name in `dependenciesKind`.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            Self::Dependent => "dependent",
            Self::Constant => "constant",
        }
    }
}

impl Dependency {
    /// That of an output with this role, in a device with so many clamped rings, with or without a shaft.
    pub(super) fn of(role: DerivativeRole, clamped_rings: usize, shaft: bool) -> Self {
        match role {
            DerivativeRole::Unaffected => Self::Lengths,
            DerivativeRole::MutualWrench(_) => Self::Sources,
            DerivativeRole::Output(output) => match output {
                Output::BaseReactionForce => Self::ClampForce,
                Output::BaseReactionMoment => Self::ClampMoment,
                // With a shaft, the port's place in the shape is the sum of many parts.
                Output::ShapePoint(0) if !shaft => Self::BasePoint,
                Output::ShapeTangent(0) if !shaft => Self::ClampedAxis,
                Output::RingPosition(ring) if ring < clamped_rings => Self::ClampedCentre,
                Output::RingAxis(ring) if ring < clamped_rings => Self::ClampedAxis,
                _ => Self::Equilibrium,
            },
            _ => Self::Equilibrium,
        }
    }

    /// The kind of this dependency on a known variable; `None` if the output does not depend on it.
    ///
    /// `same_component` says whether both are the same component of their vectors.
    #[must_use]
    pub fn on(self, known: Known, same_component: bool) -> Option<DependencyKind> {
        let depends = match (self, known) {
            (Self::BasePoint | Self::ClampedCentre, Known::BasePosition)
            | (Self::ClampForce, Known::ClampedRingForce) => {
                return same_component.then_some(DependencyKind::Constant);
            }
            (Self::Equilibrium, known) => known != Known::ClampedRingForce,
            (Self::ClampForce | Self::ClampMoment, _) => true,
            (Self::BasePoint, _) => false,
            (Self::ClampedCentre, known) => matches!(known, Known::BaseOrientation | Known::RingLength),
            (Self::ClampedAxis, known) => known == Known::BaseOrientation,
            (Self::Lengths, known) => matches!(known, Known::RingLength | Known::BodyLength),
            (Self::Sources, known) => known == Known::Source,
        };
        depends.then_some(DependencyKind::Dependent)
    }
}
