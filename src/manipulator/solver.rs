//! Any of the methods behind one name: the same scene in, the same answers out.

use nalgebra::Vector3;

use super::ladder::{self, Ladder};
use super::{Inputs, Jacobian, Outputs, Status};
use crate::design::Design;
use crate::equilibrium::{Comparison, Gap, Method, Outcome, Report, Settings};
use crate::error::Error;
use crate::magnetics::Assembly;

/// The equilibrium by the method that the settings name.
#[derive(Debug, Clone)]
pub(super) enum Solver {
    /// By the potential method, with as much model as the level asks for.
    Potential(Box<Ladder>),
    /// By another one.
    Other(Box<Comparison>),
}

/// Asks the model that answers, whichever method it is.
macro_rules! either {
    ($self:expr, $model:ident => $answer:expr) => {
        match $self {
            Solver::Potential(ladder) => {
                let $model = ladder.present();
                $answer
            }
            Solver::Other($model) => $answer,
        }
    };
}

impl Solver {
    /// # Errors
    /// As [`Ladder::new`] and [`Comparison::new`].
    pub(super) fn new(
        design: &Design,
        magnet: Option<&Assembly>,
        settings: Settings,
        shape_points: usize,
    ) -> Result<Self, Error> {
        Ok(if settings.method == Method::Potential {
            Self::Potential(Box::new(Ladder::new(design, magnet, settings, shape_points)?))
        } else {
            Self::Other(Box::new(Comparison::new(design, magnet, settings, shape_points)?))
        })
    }

    /// # Errors
    /// As [`Ladder::solve`] and [`Comparison::solve`].
    pub(super) fn solve(&mut self, inputs: &Inputs) -> Result<Report, Error> {
        match self {
            Self::Potential(ladder) => ladder.solve(inputs),
            Self::Other(comparison) => comparison.solve(inputs),
        }
    }

    /// Forgets the shape.
    pub(super) fn reset(&mut self) {
        match self {
            Self::Potential(ladder) => ladder.reset(),
            Self::Other(comparison) => comparison.reset(),
        }
    }

    /// Settings of the model that answers.
    pub(super) fn settings(&self) -> &Settings {
        either!(self, model => model.settings())
    }

    /// Stability margin of the last solved shape; `None` from the other methods.
    pub(super) fn margin(&self) -> Option<f64> {
        match self {
            Self::Potential(ladder) => ladder.present().clone().margin(),
            Self::Other(_) => None,
        }
    }

    /// # Errors
    /// As [`crate::equilibrium::Equilibrium::jacobian`]; [`Error::NoDerivatives`] from the other methods.
    pub(super) fn jacobian(&self) -> Result<Jacobian, Error> {
        match self {
            Self::Potential(ladder) => ladder.present().jacobian(),
            Self::Other(_) => Err(Error::NoDerivatives(self.only_by_potential("has no derivatives"))),
        }
    }

    /// # Errors
    /// [`Error::Unsupported`] from the other methods.
    pub(super) fn set_tolerance(&mut self, tolerance: Gap) -> Result<(), Error> {
        match self {
            Self::Potential(ladder) => {
                ladder.set_tolerance(tolerance);
                Ok(())
            }
            Self::Other(_) => {
                Err(Error::Unsupported(self.only_by_potential("takes no tolerances of the tip")))
            }
        }
    }

    /// # Errors
    /// [`Error::Unsupported`] from the other methods.
    pub(super) fn snapshot(&self) -> Result<ladder::Snapshot, Error> {
        match self {
            Self::Potential(ladder) => Ok(ladder.snapshot()),
            Self::Other(_) => Err(Error::Unsupported(self.only_by_potential("makes no snapshots"))),
        }
    }

    /// # Errors
    /// As [`Ladder::restore`]; [`Error::Unsupported`] from the other methods.
    pub(super) fn restore(&mut self, snapshot: &ladder::Snapshot) -> Result<(), Error> {
        match self {
            Self::Potential(ladder) => ladder.restore(snapshot),
            Self::Other(_) => Err(Error::Unsupported(self.only_by_potential("takes no snapshots"))),
        }
    }

    fn only_by_potential(&self, lack: &str) -> String {
        let (own, other) = (self.settings().method.name(), Method::Potential.name());
        format!("method \"{own}\" {lack}: choose \"{other}\"")
    }

    /// Writes shape and wrenches at `inputs`, those of the last solve, into outputs of this manipulator.
    pub(super) fn observe(&self, inputs: &Inputs, out: &mut Outputs) {
        either!(self, model => {
            out.tip = model.tip();
            let magnetic = model.magnetic_wrench();
            (out.magnetic_force, out.magnetic_torque) = (magnetic.force, magnetic.torque);
            let base = model.base_reaction();
            (out.base_reaction_force, out.base_reaction_moment) = (base.force, base.torque);
            let magnet = model.magnet_reaction(inputs);
            (out.magnet_reaction_force, out.magnet_reaction_torque) = (magnet.force, magnet.torque);
            out.tip_field = model.field_at(inputs, &out.tip.position).unwrap_or_default();
            let places = out.shape.iter_mut().zip(&mut out.shape_arc_length);
            places.zip(model.shape()).for_each(|((point, place), (s, at))| (*point, *place) = (at, s));
            out.rings.iter_mut().zip(model.rings()).for_each(|(slot, pose)| *slot = pose);
            out.core_angles.iter_mut().zip(model.core_angles()).for_each(|(slot, angle)| *slot = angle);
            (out.interaction, out.degree) = (model.settings().interaction, model.settings().degree);
        });
        if let Self::Potential(ladder) = self {
            out.error_estimate = ladder.error_estimate();
        }
    }

    /// Outputs of the straight, unloaded manipulator at the origin, which a new or reset one is.
    pub(super) fn straight(&self) -> Outputs {
        let zero = Vector3::zeros();
        either!(self, model => {
            let (shape_arc_length, shape) = model.shape().unzip();
            Outputs {
                tip_angle: 0.0,
                tip: model.tip(),
                magnetic_force: zero,
                magnetic_torque: zero,
                base_reaction_force: zero,
                base_reaction_moment: zero,
                magnet_reaction_force: zero,
                magnet_reaction_torque: zero,
                tip_field: zero,
                shape_arc_length,
                shape,
                rings: model.rings().collect(),
                core_angles: model.core_angles().collect(),
                stable: Some(true),
                stability_margin: 1.0,
                snaps: 0,
                status: Status::Solved,
                outcome: Outcome::Solved,
                progress: 1.0,
                iterations: 0,
                residual: 0.0,
                energy: 0.0,
                interaction: model.settings().interaction,
                degree: model.settings().degree,
                error_estimate: 0.0,
                method: model.settings().method,
            }
        })
    }
}
