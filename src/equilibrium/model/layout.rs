//! Columns of the Jacobian: one ordered table of inputs.

use core::ops::Range;

/// A continuous input: a group of columns of a [`crate::equilibrium::Jacobian`].
///
/// Rotations are about the body's own origin (the magnet's centre, the base position), as rotation vectors in world axes,
/// rad; see [`crate::geometry::Pose::rotation_rate`] for the components of a quaternion.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Input {
    /// Position of a magnet or coil (counted from 0, in the order of [`crate::equilibrium::Inputs::sources`]), m.
    SourcePosition(usize),
    /// Rotation of a magnet or coil, rad.
    SourceRotation(usize),
    /// Factor on the field of a magnet, 1, or current through a coil, A.
    SourceStrength(usize),
    /// Uniform background field, T.
    UniformField,
    /// The five independent components of the linear background field, T/m.
    FieldGradient,
    /// Force on the tip, N.
    TipForce,
    /// Moment on the tip, N m.
    TipMoment,
    /// Acceleration of gravity, m/s2.
    Gravity,
    /// Position of the base, m.
    BasePosition,
    /// Rotation of the base, rad.
    BaseRotation,
    /// Turn of the base or shaft about its axis, rad.
    Roll,
    /// Length of shaft inside the port, m; nothing changes with it where the push is given, or without a shaft.
    Insertion,
    /// Push on the shaft, N, where that is given instead of the length.
    FeedForce,
    /// Arc length that the guidewire reaches, m; nothing changes with it without one.
    GuidewireInsertion,
    /// Displacement of the vessel, m.
    VesselPosition,
    /// Rotation of the vessel about the base position, rad.
    VesselRotation,
    /// Force at the centre of this ring (counted from 0), N.
    RingForce(usize),
}

/// Inputs of every design in the order of their columns; the forces on the rings follow, then the sources.
const INPUTS: [Input; 13] = [
    Input::UniformField,
    Input::FieldGradient,
    Input::TipForce,
    Input::TipMoment,
    Input::Gravity,
    Input::BasePosition,
    Input::BaseRotation,
    Input::Roll,
    Input::Insertion,
    Input::FeedForce,
    Input::GuidewireInsertion,
    Input::VesselPosition,
    Input::VesselRotation,
];

/// Number of components of a vector.
pub(crate) const VECTOR: usize = 3;

impl Input {
    /// Number of columns of this input.
    pub(crate) const fn width(self) -> usize {
        match self {
            Self::SourceStrength(_)
            | Self::Roll
            | Self::Insertion
            | Self::FeedForce
            | Self::GuidewireInsertion => 1,
            Self::FieldGradient => 5,
            _ => VECTOR,
        }
    }

    /// The columns of this input, for any design that has this ring; those of the sources depend on the number of rings:
    /// [`Counts::columns`].
    pub(crate) fn columns(self) -> Range<usize> {
        let before: usize =
            INPUTS.iter().take_while(|input| **input != self).map(|input| input.width()).sum();
        let first = before + if let Self::RingForce(ring) = self { ring * self.width() } else { 0 };
        first..first + self.width()
    }

    /// Number of a source and which of its inputs this is; `None` for another input.
    fn of_source(self) -> Option<(usize, usize)> {
        match self {
            Self::SourcePosition(source) => Some((source, 0)),
            Self::SourceRotation(source) => Some((source, VECTOR)),
            Self::SourceStrength(source) => Some((source, 2 * VECTOR)),
            _ => None,
        }
    }

    /// The columns of displacement and rotation of the vessel.
    pub(crate) fn of_vessel() -> Range<usize> {
        Self::VesselPosition.columns().start..Self::VesselRotation.columns().end
    }
}

/// Number of columns of a source: displacement, rotation and strength.
pub(crate) const OF_SOURCE: usize = 2 * VECTOR + 1;

/// Numbers of rings, shape points and cores of a design, and of sources.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) struct Counts {
    pub(crate) rings: usize,
    pub(crate) shape_points: usize,
    pub(crate) cores: usize,
    pub(crate) sources: usize,
}

impl Counts {
    /// Number of columns.
    pub(crate) fn inputs(&self) -> usize {
        self.of_source(self.sources).start
    }

    /// The columns of an input; `None` for a ring or source that is not there.
    pub(crate) fn columns(&self, input: Input) -> Option<Range<usize>> {
        let columns = match input.of_source() {
            Some((source, _)) if source >= self.sources => return None,
            Some((source, within)) => {
                let first = self.of_source(source).start + within;
                first..first + input.width()
            }
            None => input.columns(),
        };
        let exists = !matches!(input, Input::RingForce(ring) if ring >= self.rings);
        Some(columns).filter(|_| exists)
    }

    /// The columns of a source by its number.
    pub(crate) fn of_source(&self, number: usize) -> Range<usize> {
        let first = Input::RingForce(self.rings).columns().start + number * OF_SOURCE;
        first..first + OF_SOURCE
    }

    /// Whether a column is one of the external field: of a source or of the background.
    pub(crate) fn is_of_field(&self, column: usize) -> bool {
        column < Input::FieldGradient.columns().end || column >= self.of_source(0).start
    }
}
