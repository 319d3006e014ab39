//! Direction of the magnetisation of a body, in its own frame.

use nalgebra::{Matrix3, Rotation3, Vector3};

use super::quantities::SECTION_DIRECTION;
use crate::error::{Error, check};

/// Direction in which a body is magnetised, in its directors `d1`, `d2`, `d3`.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Direction {
    /// Along the axis `d3`, as in most devices.
    Axial,
    /// Along this unit vector.
    Oblique(Vector3<f64>),
}

impl Direction {
    /// Largest deviation of a given vector's length from one: components rounded to three decimals.
    pub(crate) const SLACK: f64 = 1e-3;

    /// The direction of a vector whose length is one within 1e-3.
    ///
    /// ```
    /// use mcm::design::Direction;
    /// assert_eq!(Direction::new([0.0, 0.0, 1.0])?, Direction::Axial);
    /// let refused = Direction::new([0.0, 0.0, 0.0]).unwrap_err().to_string();
    /// assert_eq!(refused, "length of the direction of magnetisation = 0 is not allowed: it must be 1 within 1e-3");
    /// # Ok::<(), mcm::error::Error>(())
    /// ```
    ///
    /// # Errors
    /// [`Error::Range`] for any other vector.
    pub fn new(vector: [f64; 3]) -> Result<Self, Error> {
        let vector = Vector3::from(vector);
        let length = vector.norm();
        check(SECTION_DIRECTION.name, length, |l| (l - 1.0).abs() <= Self::SLACK, "1 within 1e-3")
            .map_err(|error| error.of(&SECTION_DIRECTION))?;
        Ok(Self::along(vector / length))
    }

    /// The direction of a unit vector.
    fn along(unit: Vector3<f64>) -> Self {
        if unit == Vector3::z() { Self::Axial } else { Self::Oblique(unit) }
    }

    /// The direction and the sign of a magnetisation along this direction: against the axis it is that along it, reversed.
    pub(super) fn signed(self) -> (f64, Self) {
        if self.vector() == -Vector3::z() { (-1.0, Self::Axial) } else { (1.0, self) }
    }

    /// Direction and size of a vector; that of zero is axial.
    pub(super) fn of(vector: &Vector3<f64>) -> (f64, Self) {
        vector.try_normalize(0.0).map_or((0.0, Self::Axial), |unit| (vector.norm(), Self::along(unit)))
    }

    /// Whether it is that of the axis.
    #[must_use]
    pub fn is_axial(&self) -> bool {
        *self == Self::Axial
    }

    /// The unit vector in the directors.
    #[must_use]
    pub fn vector(&self) -> Vector3<f64> {
        match self {
            Self::Axial => Vector3::z(),
            Self::Oblique(unit) => *unit,
        }
    }

    /// The unit vector in the axes in which the columns of `directors` are the directors.
    #[must_use]
    pub fn seen_in(&self, directors: &Matrix3<f64>) -> Vector3<f64> {
        match self {
            Self::Axial => directors.column(2).into_owned(),
            Self::Oblique(unit) => directors * unit,
        }
    }

    /// The two directors of a section's plane and, instead of its normal, this direction, as columns.
    #[must_use]
    pub fn sheet(&self, directors: &Matrix3<f64>) -> Matrix3<f64> {
        match self {
            Self::Axial => *directors,
            Self::Oblique(unit) => {
                let mut sheet = *directors;
                sheet.set_column(2, &(directors * unit));
                sheet
            }
        }
    }

    /// This direction turned by an angle (rad), right-handed about `d3`.
    #[must_use]
    pub fn turned(&self, angle: f64) -> Self {
        match self {
            Self::Oblique(unit) if angle != 0.0 => {
                Self::Oblique(Rotation3::from_axis_angle(&Vector3::z_axis(), angle) * unit)
            }
            _ => *self,
        }
    }
}
