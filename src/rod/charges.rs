//! Magnetic charges in a plane normal to a frame's axis: their energy from weighted sums of potential, field and gradient.

use nalgebra::{Matrix3, Vector2, Vector3};

use super::load::Load;
use crate::geometry::hat;

/// Sums over the charges of a plane, weighted with the charges and with their coordinates `x`, `y` along `d1`, `d2`.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Charges {
    potential: f64,
    /// Field, weighted with 1, x, y.
    field: [Vector3<f64>; 3],
    /// Gradient, weighted with 1, x, y, xx, xy, yy.
    gradient: Option<[Matrix3<f64>; 6]>,
}

impl Charges {
    /// No charges; `stiff` if second derivatives are summed too.
    #[must_use]
    pub fn new(stiff: bool) -> Self {
        Self {
            potential: 0.0,
            field: [Vector3::zeros(); 3],
            gradient: stiff.then_some([Matrix3::zeros(); 6]),
        }
    }

    /// Adds a charge (A m: magnetisation times area) at `position` (m).
    ///
    /// `potential` (T m), `field` (T) and, for the second derivatives, `gradient` (T/m) are the values there.
    pub fn add(
        &mut self,
        charge: f64,
        position: &Vector2<f64>,
        potential: f64,
        field: &Vector3<f64>,
        gradient: Option<&Matrix3<f64>>,
    ) {
        let (x, y) = (position.x, position.y);
        self.potential += charge * potential;
        for (sum, weight) in self.field.iter_mut().zip([1.0, x, y]) {
            *sum += field * (charge * weight);
        }
        let (Some(sums), Some(gradient)) = (&mut self.gradient, gradient) else { return };
        for (sum, weight) in sums.iter_mut().zip([1.0, x, y, x * x, x * y, y * y]) {
            *sum += gradient * (charge * weight);
        }
    }

    /// The energy `sum q psi` as a load on a frame with the columns of `directors` as directors.
    ///
    /// The plane is at `height` (m) along the frame's axis. The energy of a charge depends on its position `p + A r` alone:
    /// with the arm `a = A r` its derivative is `-q B` with respect to `p` and `-q B a^T` with respect to `A`, and its second
    /// derivative with respect to the position is `-q G`.
    #[must_use]
    pub fn load(&self, directors: &Matrix3<f64>, height: f64) -> Load {
        let [d1, d2, axis]: [Vector3<f64>; 3] = core::array::from_fn(|i| directors.column(i).into_owned());
        let centre = axis * height;
        let [whole, by_x, by_y] = &self.field;
        let mut load = Load {
            energy: self.potential,
            force: -whole,
            couple: -(whole * centre.transpose() + by_x * d1.transpose() + by_y * d2.transpose()),
            ..Load::zero()
        };
        let Some([one, x, y, xx, xy, yy]) = &self.gradient else { return load };
        let (up, first, second) = (hat(&centre), hat(&d1), hat(&d2));
        let mixed = up * x * first + up * y * second + first * xy * second;
        load.position_position = -one;
        load.position_rotation = one * up + x * first + y * second;
        load.rotation_rotation =
            up * one * up + first * xx * first + second * yy * second + mixed + mixed.transpose();
        load.stiff = true;
        load
    }
}
