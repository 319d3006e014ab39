//! Layout of the Jacobian: one ordered table of inputs (columns) and one of outputs (rows).

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

/// A continuous output: a group of rows of a [`super::Jacobian`]. Points and bodies are counted from 0.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Output {
    /// Angle between the axes of tip and base, rad; its derivative is set to 0 at 0 and pi, where it is not
    /// differentiable.
    TipAngle,
    /// Position of the tip, m.
    TipPosition,
    /// Rotation of the tip, rad, world axes; see [`crate::geometry::Pose::quaternion_rate`].
    TipRotation,
    /// External magnetic force, N.
    MagneticForce,
    /// External magnetic torque about the base position, N m.
    MagneticTorque,
    /// Force that the clamp exerts, N.
    BaseReactionForce,
    /// Moment that the clamp exerts about the base position, N m.
    BaseReactionMoment,
    /// Force on the external magnet, N.
    MagnetReactionForce,
    /// Torque on the external magnet about its centre, N m.
    MagnetReactionTorque,
    /// Force on a further source (counted from 0), N.
    SourceReactionForce(usize),
    /// Torque on a further source about its centre, N m.
    SourceReactionTorque(usize),
    /// External field at the tip, T.
    TipField,
    /// Length of shaft inside the port, m.
    FeedLength,
    /// Push that holds the shaft, N.
    FeedReaction,
    /// Point of the centreline, m.
    ShapePoint(usize),
    /// Centre of a ring, m.
    RingPosition(usize),
    /// Rotation of a ring, rad, world axes.
    RingRotation(usize),
    /// Axis `d3` of a ring, 1.
    RingAxis(usize),
    /// Bending angle of a core, rad; its derivative is set to 0 where the core is straight and the angle is not
    /// differentiable.
    CoreAngle(usize),
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

/// Outputs of every design in the order of their rows; shape points, rings, cores and further sources follow.
const OUTPUTS: [Output; 12] = [
    Output::TipAngle,
    Output::TipPosition,
    Output::TipRotation,
    Output::MagneticForce,
    Output::MagneticTorque,
    Output::BaseReactionForce,
    Output::BaseReactionMoment,
    Output::MagnetReactionForce,
    Output::MagnetReactionTorque,
    Output::TipField,
    Output::FeedLength,
    Output::FeedReaction,
];

/// Outputs of each ring in the order of their rows.
const RING_OUTPUTS: [fn(usize) -> Output; 3] = [Output::RingPosition, Output::RingRotation, Output::RingAxis];

/// Number of components of a vector.
const VECTOR: usize = 3;

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

    /// Number of rows.
    pub(super) fn outputs(&self) -> usize {
        self.first(Output::SourceReactionForce(self.further))
    }

    /// The rows of an output; `None` for a point or body that the design does not have.
    pub(super) fn rows(&self, output: Output) -> Option<Range<usize>> {
        let exists = match output {
            Output::ShapePoint(point) => point < self.shape_points,
            Output::RingPosition(ring) | Output::RingRotation(ring) | Output::RingAxis(ring) => {
                ring < self.rings
            }
            Output::CoreAngle(core) => core < self.cores,
            Output::SourceReactionForce(source) | Output::SourceReactionTorque(source) => {
                source < self.further
            }
            _ => true,
        };
        exists.then(|| self.first(output)..self.first(output) + output.width())
    }

    /// The first row of an output, whether or not the design has it.
    fn first(&self, output: Output) -> usize {
        let points: usize = OUTPUTS.iter().map(|output| output.width()).sum();
        let rings = points + self.shape_points * VECTOR;
        let cores = rings + self.rings * RING_OUTPUTS.len() * VECTOR;
        let of_ring = |ring: usize| {
            let before = RING_OUTPUTS.iter().take_while(|other| other(ring) != output).count();
            rings + (ring * RING_OUTPUTS.len() + before) * VECTOR
        };
        match output {
            Output::ShapePoint(point) => points + point * VECTOR,
            Output::RingPosition(ring) | Output::RingRotation(ring) | Output::RingAxis(ring) => of_ring(ring),
            Output::CoreAngle(core) => cores + core,
            Output::SourceReactionForce(source) => cores + self.cores + 2 * VECTOR * source,
            Output::SourceReactionTorque(source) => cores + self.cores + 2 * VECTOR * source + VECTOR,
            _ => OUTPUTS.iter().take_while(|other| **other != output).map(|other| other.width()).sum(),
        }
    }
}

impl Output {
    /// Number of rows of this output.
    fn width(self) -> usize {
        match self {
            Self::TipAngle | Self::CoreAngle(_) | Self::FeedLength | Self::FeedReaction => 1,
            _ => VECTOR,
        }
    }
}
