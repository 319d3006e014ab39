//! The derivatives of all outputs by all inputs, and what is where in them.

use core::ops::Range;

use nalgebra::{DMatrix, DMatrixView, DVector, Matrix6, Matrix6x3};

/// A continuous input: columns of a [`Jacobian`].
///
/// Rotations are about the body's own origin (the magnet's centre, the base position), by a rotation vector in the
/// world's axes, rad; see [`crate::geometry::Pose::rotation_rate`] for the components of a quaternion.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Input {
    /// Position of the external magnet, m.
    MagnetPosition,
    /// Rotation of the external magnet, rad.
    MagnetRotation,
    /// Factor on its field, 1.
    MagnetStrength,
    /// Uniform background field, T.
    UniformField,
    /// The five numbers of the linear background field, T/m.
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
    /// Force at the centre of this ring (0: the first), N.
    RingForce(usize),
}

/// A continuous output: rows of a [`Jacobian`]. Points and bodies are counted from 0.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Output {
    /// Angle between the tip's and the base's axis, rad; 0 where it is 0 or pi, where it has a corner.
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
    /// External field at the tip, T.
    TipField,
    /// Point of the centreline, m.
    ShapePoint(usize),
    /// Centre of a ring, m.
    RingPosition(usize),
    /// Rotation of a ring, rad, world axes.
    RingRotation(usize),
    /// Axis `d3` of a ring, 1.
    RingAxis(usize),
    /// Bending angle of a core, rad; 0 where it is straight, where the angle has a corner.
    CoreAngle(usize),
}

/// Columns before those of the ring forces.
const BEFORE_RINGS: usize = 30;

/// Rows before those of the shape.
const BEFORE_SHAPE: usize = 28;

/// Rows of a ring.
const RING_ROWS: usize = 9;

/// How many bodies and points there are.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) struct Counts {
    pub(super) rings: usize,
    pub(super) shape_points: usize,
    pub(super) cores: usize,
}

impl Counts {
    /// Number of columns.
    pub(super) fn inputs(&self) -> usize {
        BEFORE_RINGS + 3 * self.rings
    }

    fn ring_rows(&self) -> usize {
        BEFORE_SHAPE + 3 * self.shape_points
    }

    fn core_rows(&self) -> usize {
        self.ring_rows() + RING_ROWS * self.rings
    }

    /// Number of rows.
    pub(super) fn outputs(&self) -> usize {
        self.core_rows() + self.cores
    }
}

impl Input {
    /// Its columns, wherever the design has so many rings.
    pub(super) fn columns(self) -> Range<usize> {
        match self {
            Self::MagnetPosition => 0..3,
            Self::MagnetRotation => 3..6,
            Self::MagnetStrength => 6..7,
            Self::UniformField => 7..10,
            Self::FieldGradient => 10..15,
            Self::TipForce => 15..18,
            Self::TipMoment => 18..21,
            Self::Gravity => 21..24,
            Self::BasePosition => 24..27,
            Self::BaseRotation => 27..BEFORE_RINGS,
            Self::RingForce(ring) => BEFORE_RINGS + 3 * ring..BEFORE_RINGS + 3 * ring + 3,
        }
    }
}

/// Exact derivatives of all outputs by all inputs at one equilibrium: a matrix with a row for each output and a
/// column for each input, in SI units, world frame.
///
/// With the potential `U(q, u)` of the unknowns `q` and inputs `u`, and an output `y(q, u)`,
///
/// ```text
/// dy/du = @y/@u + @y/@q dq/du      dq/du = -H^-1 @2U/@q@u      H = @2U/@q2
/// ```
///
/// at one factorisation of `H` for all inputs. The quadrature of rings (see
/// [`super::Settings::pair_accuracy`]) counts as fixed. Left out are the stability margin, which would need third
/// derivatives, and the energy, whose derivative is the load that belongs to the input (by the base pose: its
/// reaction).
///
/// ```
/// use mcm::manipulator::{Input, Output, Scene};
/// let scene = Scene::parse("[design]\nsegments = 1\n[field]\nuniform_mt = [0.0, 10.0, 0.0]", "example")?;
/// let mut manipulator = scene.manipulator(11)?;
/// let alpha = manipulator.solve(&scene.inputs)?.tip_angle;
/// let jacobian = manipulator.jacobian()?;
/// let slope = jacobian.block(Output::TipAngle, Input::UniformField).expect("a quantity of every design")[(0, 1)];
/// let mut inputs = scene.inputs.clone();
/// inputs.uniform_field.y += 1e-6; // T
/// let moved = manipulator.solve(&inputs)?.tip_angle;
/// assert!((alpha + slope * 1e-6 - moved).abs() < 1e-8);
/// # Ok::<(), mcm::error::Error>(())
/// ```
#[derive(Debug, Clone, PartialEq)]
pub struct Jacobian {
    pub(super) matrix: DMatrix<f64>,
    pub(super) counts: Counts,
}

impl Jacobian {
    /// The whole matrix.
    #[must_use]
    pub fn matrix(&self) -> &DMatrix<f64> {
        &self.matrix
    }

    /// The columns of an input; `None` for a ring that the design does not have.
    #[must_use]
    pub fn columns(&self, input: Input) -> Option<Range<usize>> {
        Some(input.columns()).filter(|columns| columns.end <= self.matrix.ncols())
    }

    /// The rows of an output; `None` for a point or body that the design does not have.
    #[must_use]
    pub fn rows(&self, output: Output) -> Option<Range<usize>> {
        let Counts { rings, shape_points, cores } = self.counts;
        let three = |row: usize| Some(row..row + 3);
        let ring = |index: usize, part: usize| {
            (index < rings).then_some(self.counts.ring_rows() + RING_ROWS * index + 3 * part).and_then(three)
        };
        match output {
            Output::TipAngle => Some(0..1),
            Output::TipPosition => three(1),
            Output::TipRotation => three(4),
            Output::MagneticForce => three(7),
            Output::MagneticTorque => three(10),
            Output::BaseReactionForce => three(13),
            Output::BaseReactionMoment => three(16),
            Output::MagnetReactionForce => three(19),
            Output::MagnetReactionTorque => three(22),
            Output::TipField => three(25),
            Output::ShapePoint(index) if index < shape_points => three(BEFORE_SHAPE + 3 * index),
            Output::RingPosition(index) => ring(index, 0),
            Output::RingRotation(index) => ring(index, 1),
            Output::RingAxis(index) => ring(index, 2),
            Output::CoreAngle(index) if index < cores => {
                Some(self.counts.core_rows() + index..self.counts.core_rows() + index + 1)
            }
            Output::ShapePoint(_) | Output::CoreAngle(_) => None,
        }
    }

    /// Derivatives of one output by one input; `None` for a point or body that the design does not have.
    #[must_use]
    pub fn block(&self, output: Output, input: Input) -> Option<DMatrixView<'_, f64>> {
        let (rows, columns) = (self.rows(output)?, self.columns(input)?);
        Some(self.matrix.view((rows.start, columns.start), (rows.len(), columns.len())))
    }

    /// Rates of all outputs when the inputs change at the given rates, one for each column.
    ///
    /// # Errors
    /// [`crate::error::Error::Count`] for a direction of another length.
    pub fn along(&self, direction: &[f64]) -> Result<DVector<f64>, crate::error::Error> {
        if direction.len() == self.matrix.ncols() {
            return Ok(&self.matrix * DVector::from_column_slice(direction));
        }
        let (quantity, given) = ("direction of the inputs".into(), direction.len());
        Err(crate::error::Error::Count { quantity, given, expected: self.matrix.ncols().to_string() })
    }

    /// The actuation Jacobian: displacement (m) and rotation (rad) of the tip by those of the magnet about its centre,
    /// world axes.
    #[must_use]
    pub fn tip_by_magnet(&self) -> Matrix6<f64> {
        self.matrix.fixed_view::<6, 6>(1, 0).into_owned()
    }

    /// Displacement (m) and rotation (rad) of the tip by the uniform background field (T), world axes.
    #[must_use]
    pub fn tip_by_uniform_field(&self) -> Matrix6x3<f64> {
        self.matrix.fixed_view::<6, 3>(1, 7).into_owned()
    }
}
