//! Columns of the Jacobian: one ordered table of inputs.

use core::ops::Range;

/// A continuous input: a group of columns of a [`super::Jacobian`].
///
/// Rotations are about the body's own origin (the magnet's centre, the base position), as rotation vectors in world axes,
/// rad; see [`crate::geometry::Pose::rotation_rate`] for the components of a quaternion.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Input {
    /// Position of the external magnet, m.
    MagnetPosition,
    /// Rotation of the external magnet, rad.
    MagnetRotation,
    /// Factor on the field of the external magnet, 1.
    MagnetStrength,
    /// Position of a further source (counted from 0; magnets first, then coils), m.
    SourcePosition(usize),
    /// Rotation of a further source, rad.
    SourceRotation(usize),
    /// Factor on the field of a further magnet, 1, or current through a coil, A.
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

/// Inputs of every design in the order of their columns; the forces on the rings follow, then the further sources.
const INPUTS: [Input; 16] = [
    Input::MagnetPosition,
    Input::MagnetRotation,
    Input::MagnetStrength,
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
pub(super) const VECTOR: usize = 3;

impl Input {
    /// Number of columns of this input.
    pub(super) const fn width(self) -> usize {
        match self {
            Self::MagnetStrength
            | Self::SourceStrength(_)
            | Self::Roll
            | Self::Insertion
            | Self::FeedForce
            | Self::GuidewireInsertion => 1,
            Self::FieldGradient => 5,
            _ => VECTOR,
        }
    }

    /// The columns of this input, for any design that has this ring; those of the further sources depend on the number of rings:
    /// [`Counts::columns`].
    pub(super) fn columns(self) -> Range<usize> {
        let before: usize =
            INPUTS.iter().take_while(|input| **input != self).map(|input| input.width()).sum();
        let first = before + if let Self::RingForce(ring) = self { ring * self.width() } else { 0 };
        first..first + self.width()
    }

    /// Number of a further source and which of its inputs this is; `None` for another input.
    fn of_source(self) -> Option<(usize, usize)> {
        match self {
            Self::SourcePosition(source) => Some((source, 0)),
            Self::SourceRotation(source) => Some((source, VECTOR)),
            Self::SourceStrength(source) => Some((source, 2 * VECTOR)),
            _ => None,
        }
    }

    /// The columns of displacement and rotation of the vessel.
    pub(super) fn of_vessel() -> Range<usize> {
        Self::VesselPosition.columns().start..Self::VesselRotation.columns().end
    }
}

/// Number of columns of a source: displacement, rotation and strength.
pub(super) const OF_SOURCE: usize = 2 * VECTOR + 1;

/// Numbers of rings, shape points and cores of a design, and of sources beside the external magnet.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) struct Counts {
    pub(super) rings: usize,
    pub(super) shape_points: usize,
    pub(super) cores: usize,
    pub(super) further: usize,
}

impl Counts {
    /// Number of columns.
    pub(super) fn inputs(&self) -> usize {
        self.of_further(self.further)
    }

    /// First column of a further source.
    fn of_further(&self, source: usize) -> usize {
        Input::RingForce(self.rings).columns().start + source * OF_SOURCE
    }

    /// The columns of an input; `None` for a ring or source that is not there.
    pub(super) fn columns(&self, input: Input) -> Option<Range<usize>> {
        let columns = match input.of_source() {
            Some((source, _)) if source >= self.further => return None,
            Some((source, within)) => {
                let first = self.of_further(source) + within;
                first..first + input.width()
            }
            None => input.columns(),
        };
        let exists = !matches!(input, Input::RingForce(ring) if ring >= self.rings);
        Some(columns).filter(|_| exists)
    }

    /// The columns of a source by its number: 0 is the external magnet.
    pub(super) fn of_source(&self, number: usize) -> Range<usize> {
        let first = match number.checked_sub(1) {
            None => Input::MagnetPosition.columns().start,
            Some(further) => self.of_further(further),
        };
        first..first + OF_SOURCE
    }

    /// Whether a column is one of the external field: of a source or of the background.
    pub(super) fn is_of_field(&self, column: usize) -> bool {
        column < Input::FieldGradient.columns().end || column >= self.of_further(0)
    }
}
