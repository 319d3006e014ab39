//! Derivatives of all outputs with respect to all inputs.

use crate::equilibrium::model::{Counts, Input};
use core::ops::Range;

use nalgebra::{DMatrix, DMatrixView, DVector, Matrix6, Matrix6x3};

use super::output_derivatives::Output;

/// Exact derivatives of all outputs with respect to all inputs at one equilibrium: a matrix with a row for each output
/// and a column for each input, in SI units, world frame.
///
/// With the potential `U(q, u)` of the unknowns `q` and inputs `u`, and an output `y(q, u)`,
///
/// ```text
/// dy/du = @y/@u + @y/@q dq/du      dq/du = -H^-1 @2U/@q@u      H = @2U/@q2
/// ```
///
/// with one factorisation of `H` for all inputs. The quadrature of rings (see [`crate::equilibrium::Settings::pair_accuracy`]) is
/// treated as fixed. Not included are the stability margin, which would need third derivatives, and the energy, whose
/// derivative is the load conjugate to the input (for the base pose: its reaction).
///
/// ```
/// use mcm::manipulator::{Input, Output, Scene};
/// let scene = Scene::parse("[design]\nsegments = 1\n[field]\nuniform_mt = [0.0, 10.0, 0.0]", "example")?;
/// let mut manipulator = scene.manipulator(11)?;
/// let alpha = manipulator.solve(&scene.inputs)?.tip_angle;
/// let jacobian = manipulator.jacobian()?;
/// let by_field = jacobian.block(Output::TipAngle, Input::UniformField);
/// let slope = by_field.map_or(f64::NAN, |block| block[(0, 1)]);
/// let mut inputs = scene.inputs.clone();
/// inputs.uniform_field.y += 1e-6; // T
/// let moved = manipulator.solve(&inputs)?.tip_angle;
/// assert!((alpha + slope * 1e-6 - moved).abs() < 1e-8);
/// # Ok::<(), mcm::error::Error>(())
/// ```
#[derive(Debug, Clone, PartialEq)]
pub struct Jacobian {
    pub(crate) matrix: DMatrix<f64>,
    pub(crate) counts: Counts,
}

impl Jacobian {
    /// The whole matrix.
    #[must_use]
    pub fn matrix(&self) -> &DMatrix<f64> {
        &self.matrix
    }

    /// The columns of an input; `None` for a ring or source that is not there.
    #[must_use]
    pub fn columns(&self, input: Input) -> Option<Range<usize>> {
        self.counts.columns(input)
    }

    /// The rows of an output; `None` for a point or body that the design does not have.
    #[must_use]
    pub fn rows(&self, output: Output) -> Option<Range<usize>> {
        self.counts.rows(output)
    }

    /// Derivatives of one output with respect to one input; `None` for a point or body that the design does not have.
    #[must_use]
    pub fn block(&self, output: Output, input: Input) -> Option<DMatrixView<'_, f64>> {
        let (rows, columns) = (self.rows(output)?, self.columns(input)?);
        Some(self.matrix.view((rows.start, columns.start), (rows.len(), columns.len())))
    }

    /// Rates of all outputs for the given rates of the inputs, one for each column.
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

    /// The derivatives where the push on the shaft is given and its length follows; as they are without a shaft.
    #[must_use]
    pub(crate) fn at_given_push(mut self) -> Self {
        let (insertion, given) = (Input::Insertion.columns().start, Input::FeedForce.columns().start);
        let Some(push) = self.rows(Output::FeedReaction).map(|rows| rows.start) else { return self };
        let stiffness = self.matrix[(push, insertion)];
        if stiffness != 0.0 {
            let by_push = self.matrix.column(insertion) / stiffness;
            let follows = &by_push * self.matrix.row(push);
            self.matrix -= follows;
            self.matrix.set_column(given, &by_push);
        }
        self
    }

    /// The actuation Jacobian: displacement (m) and rotation (rad) of the tip with respect to displacement and rotation
    /// of a magnet or coil about its centre, world axes; `None` for a source that is not there.
    #[must_use]
    pub fn tip_by_source(&self, number: usize) -> Option<Matrix6<f64>> {
        let columns = self.columns(Input::SourcePosition(number))?;
        Some(self.matrix.fixed_view::<6, 6>(self.tip(), columns.start).into_owned())
    }

    /// Displacement (m) and rotation (rad) of the tip with respect to the uniform background field (T), world axes.
    #[must_use]
    pub fn tip_by_uniform_field(&self) -> Matrix6x3<f64> {
        self.matrix.fixed_view::<6, 3>(self.tip(), Input::UniformField.columns().start).into_owned()
    }

    /// First of the six rows of the tip's pose.
    fn tip(&self) -> usize {
        self.counts.rows(Output::TipPosition).map_or(0, |rows| rows.start)
    }
}
