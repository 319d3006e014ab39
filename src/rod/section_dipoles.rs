//! Parallel dipoles in one section, along its normal or any other direction: their energy from weighted sums of the field.

use nalgebra::{Matrix3, Vector2, Vector3};

use super::load::Load;
use crate::geometry::hat;

/// Sums of the field over the dipoles of a section, weighted with their moments and with their coordinates `x`, `y` along `d1`,
/// `d2`.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct SectionDipoles {
    /// Field, J.
    pub field: Vector3<f64>,
    /// Gradient times the dipoles' direction, weighted with 1, x, y.
    pub force: [Vector3<f64>; 3],
    /// For second derivatives.
    pub second: Option<SectionStiffness>,
}

/// Sums of the field over the dipoles of a section for the second derivatives of their energy.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct SectionStiffness {
    /// Gradient, weighted with 1, x, y.
    pub gradient: [Matrix3<f64>; 3],
    /// Second derivative of the field's component along the dipoles, weighted with 1, x, y, xx, xy, yy.
    pub along: [Matrix3<f64>; 6],
}

impl SectionDipoles {
    /// No dipoles; `stiff` if second derivatives are summed too.
    #[must_use]
    pub fn new(stiff: bool) -> Self {
        Self {
            field: Vector3::zeros(),
            force: [Vector3::zeros(); 3],
            second: stiff
                .then(|| SectionStiffness { gradient: [Matrix3::zeros(); 3], along: [Matrix3::zeros(); 6] }),
        }
    }

    /// Adds a dipole `moment axis` (A m2, `axis`: the direction of all dipoles) at `position` (m), with the field (T), its gradient
    /// and, for the second derivatives, `along = sum_i axis_i d2B_i/dx_j dx_k` there.
    pub fn add(
        &mut self,
        (moment, axis): (f64, &Vector3<f64>),
        position: &Vector2<f64>,
        field: &Vector3<f64>,
        gradient: &Matrix3<f64>,
        along: Option<&Matrix3<f64>>,
    ) {
        let (x, y) = (position.x, position.y);
        self.field += field * moment;
        let force = gradient * axis;
        for (sum, weight) in self.force.iter_mut().zip([moment, moment * x, moment * y]) {
            *sum += force * weight;
        }
        let (Some(second), Some(along)) = (&mut self.second, along) else { return };
        for (sum, weight) in second.gradient.iter_mut().zip([moment, moment * x, moment * y]) {
            *sum += gradient * weight;
        }
        for (sum, weight) in second.along.iter_mut().zip([1.0, x, y, x * x, x * y, y * y]) {
            *sum += along * (moment * weight);
        }
    }

    /// These sums for dipoles `factor` times as strong.
    #[must_use]
    pub fn times(mut self, factor: f64) -> Self {
        self.field *= factor;
        self.force.iter_mut().for_each(|sum| *sum *= factor);
        if let Some(second) = &mut self.second {
            second.gradient.iter_mut().chain(&mut second.along).for_each(|sum| *sum *= factor);
        }
        self
    }

    /// The energy as a load on the section's frame. The columns of `directors` are the two directors of its plane and the direction of
    /// the dipoles, which is the third director where they are normal to the section.
    ///
    /// Equal to the sum of [`Load::add_dipole`] over the dipoles with arms `x d1 + y d2`.
    #[must_use]
    pub fn load(&self, directors: &Matrix3<f64>) -> Load {
        let [d1, d2, axis]: [Vector3<f64>; 3] = core::array::from_fn(|i| directors.column(i).into_owned());
        let [force, by_x, by_y] = &self.force;
        let mut load = Load {
            energy: -axis.dot(&self.field),
            force: -force,
            couple: -(by_x * d1.transpose() + by_y * d2.transpose() + self.field * axis.transpose()),
            ..Load::zero()
        };
        let Some(SectionStiffness { gradient, along: [one, x, y, xx, xy, yy] }) = &self.second else {
            return load;
        };
        let (turn, first, second) = (hat(&axis), hat(&d1), hat(&d2));
        let cross = turn * (gradient[1] * first + gradient[2] * second);
        let mixed = first * xy * second;
        load.position_position = -one;
        load.position_rotation = gradient[0] * turn + x * first + y * second;
        load.rotation_rotation =
            cross + cross.transpose() + first * xx * first + mixed + mixed.transpose() + second * yy * second;
        load.stiff = true;
        load
    }
}
