//! What is asked of the tip, and how far it is from it.

use nalgebra::{DMatrix, DVector, Vector3};

use super::constants::STRAIGHT_ANGLE;
use super::moves::{Freedom, turn};
use crate::error::{Error, check};
use crate::manipulator::{Jacobian, Output, Outputs};

/// What is asked of the tip; what is `None` may be anything.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Target {
    /// Position of the tip, m.
    pub position: Option<Vector3<f64>>,
    /// Direction of the tip's `d3`, of any length.
    pub direction: Option<Vector3<f64>>,
    /// Angle between the tip's and the base's `d3`, rad, from 0 to pi; not together with a direction.
    pub angle: Option<f64>,
    /// Force of the external field on the device, N.
    pub force: Option<Vector3<f64>>,
}

/// How near counts as reached.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Tolerances {
    /// Of the position, m.
    pub position: f64,
    /// Of direction and angle, rad.
    pub angle: f64,
    /// Of the force, N.
    pub force: f64,
}

impl Default for Tolerances {
    fn default() -> Self {
        Self { position: 1e-6, angle: 1e-4, force: 1e-6 }
    }
}

impl Tolerances {
    /// Checks that all are positive.
    ///
    /// # Errors
    /// [`Error::Range`] naming the first that is not.
    pub fn checked(self) -> Result<Self, Error> {
        check("tolerance of the tip position (m)", self.position, |v| v > 0.0, "> 0")?;
        check("tolerance of the tip's angle (rad)", self.angle, |v| v > 0.0, "> 0")?;
        check("tolerance of the force (N)", self.force, |v| v > 0.0, "> 0")?;
        Ok(self)
    }
}

/// Distance of the tip from its target; `None` for what is not asked.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Residual {
    /// Of the position, m.
    pub position: Option<f64>,
    /// Of the direction, rad.
    pub direction: Option<f64>,
    /// Of the angle, rad.
    pub angle: Option<f64>,
    /// Of the force, N.
    pub force: Option<f64>,
}

impl Target {
    /// Checks that something is asked, and nothing impossible.
    ///
    /// # Errors
    /// [`Error::Range`] for numbers that are not finite, a direction of no length and an angle outside 0 to pi;
    /// [`Error::Unsupported`] for an empty target and one with both direction and angle.
    pub fn check(&self) -> Result<(), Error> {
        let vectors = [
            ("target position (m)", self.position),
            ("target direction", self.direction),
            ("target force (N)", self.force),
        ];

        for (name, vector) in vectors {
            for value in vector.iter().flatten() {
                check(name, *value, |_| true, "finite")?;
            }
        }

        if let Some(direction) = self.direction {
            check("length of the target direction", direction.norm(), |v| v > 0.0, "> 0")?;
        }
        if let Some(angle) = self.angle {
            check(
                "target tip angle (rad)",
                angle,
                |v| (0.0..=core::f64::consts::PI).contains(&v),
                "from 0 to pi",
            )?;
        }

        if self.direction.is_some() && self.angle.is_some() {
            return Err(Error::Unsupported(
                "a target has a direction or an angle of the tip, not both".into(),
            ));
        }

        if *self == Self::default() {
            return Err(Error::Unsupported("the target asks for nothing".into()));
        }

        Ok(())
    }

    /// Distance from it.
    #[must_use]
    pub fn residual(&self, outputs: &Outputs) -> Residual {
        let axis = outputs.tip.axis();
        Residual {
            position: self.position.map(|position| (position - outputs.tip.position).norm()),
            direction: self.direction.map(|direction| axis.angle(&direction)),
            angle: self.angle.map(|angle| (angle - outputs.tip_angle).abs()),
            force: self.force.map(|force| (force - outputs.magnetic_force).norm()),
        }
    }

    /// The largest part of the residual, in tolerances: reached up to 1.
    pub(super) fn misfit(&self, outputs: &Outputs, tolerances: &Tolerances) -> f64 {
        let Residual { position, direction, angle, force } = self.residual(outputs);
        let position = position.map(|apart| apart / tolerances.position);
        let angles = direction.into_iter().chain(angle).map(|apart| apart / tolerances.angle);
        let force = force.map(|apart| apart / tolerances.force);
        position.into_iter().chain(angles).chain(force).fold(0.0, f64::max)
    }

    /// What is missing, in tolerances.
    pub(super) fn errors(&self, outputs: &Outputs, tolerances: &Tolerances) -> DVector<f64> {
        let mut out = Vec::new();
        if let Some(position) = self.position {
            out.extend(&((position - outputs.tip.position) / tolerances.position));
        }
        if let Some(direction) = self.direction {
            let across = outputs.tip.rotation.column(0).into_owned();
            out.extend(&(turn(&outputs.tip.axis(), &direction, &across) / tolerances.angle));
        }
        if let Some(angle) = self.angle {
            out.push((angle - outputs.tip_angle) / tolerances.angle);
        }
        if let Some(force) = self.force {
            out.extend(&((force - outputs.magnetic_force) / tolerances.force));
        }
        DVector::from_vec(out)
    }

    /// Rates at which the freedoms take away what is missing, in tolerances a step: a row for each error, a column for each freedom.
    pub(super) fn rates(
        &self,
        jacobian: &Jacobian,
        outputs: &Outputs,
        tolerances: &Tolerances,
        freedoms: &[Freedom],
    ) -> DMatrix<f64> {
        let axis = outputs.tip.axis();
        let mut columns = Vec::new();
        for freedom in freedoms {
            let mut column: Vec<f64> = Vec::new();
            if self.position.is_some() {
                column.extend(&(freedom.rate(jacobian, Output::TipPosition) / tolerances.position));
            }
            let rotation = freedom.rate(jacobian, Output::TipRotation);
            if self.direction.is_some() {
                column.extend(&((rotation - axis * axis.dot(&rotation)) / tolerances.angle));
            }
            if self.angle.is_some() {
                let mut rate = freedom.rate(jacobian, Output::TipAngle).x;
                if outputs.tip_angle < STRAIGHT_ANGLE {
                    // Bends first about the tip's own `d1`.
                    rate = rotation.dot(&outputs.tip.rotation.column(0));
                }
                column.push(rate / tolerances.angle);
            }
            if self.force.is_some() {
                column.extend(&(freedom.rate(jacobian, Output::MagneticForce) / tolerances.force));
            }
            columns.push(DVector::from_vec(column));
        }
        DMatrix::from_columns(&columns)
    }
}
