//! Any of the methods behind one name.

use nalgebra::Vector3;

use super::comparison::Comparison;
use super::method::Method;
use crate::design::Design;
use crate::equilibrium::follow::Report;
use crate::equilibrium::inputs::Inputs;
use crate::equilibrium::jacobian::Jacobian;
use crate::equilibrium::settings::Settings;
use crate::equilibrium::snapshot::Snapshot;
use crate::equilibrium::solver::Equilibrium;
use crate::error::Error;
use crate::geometry::Pose;
use crate::magnetics::{Assembly, Wrench};

/// The equilibrium by the method that the settings name: the same scene in, the same answers out.
#[derive(Debug, Clone)]
pub enum Solver {
    /// By the potential method.
    Potential(Box<Equilibrium>),
    /// By another one.
    Other(Box<Comparison>),
}

/// Asks whichever method it is.
macro_rules! either {
    ($self:expr, $solver:ident => $answer:expr) => {
        match $self {
            Solver::Potential($solver) => $answer,
            Solver::Other($solver) => $answer,
        }
    };
}

impl Solver {
    /// The straight manipulator; `shape_points` is the number of centreline points, at least 2.
    ///
    /// # Errors
    /// As [`Equilibrium::new`] and [`Comparison::new`].
    pub fn new(
        design: &Design,
        magnet: Option<&Assembly>,
        settings: Settings,
        shape_points: usize,
    ) -> Result<Self, Error> {
        if settings.method == Method::Potential {
            return Ok(Self::Potential(Box::new(Equilibrium::new(design, magnet, settings, shape_points)?)));
        }
        Ok(Self::Other(Box::new(Comparison::new(design, magnet, settings, shape_points)?)))
    }

    /// See [`Equilibrium::solve`].
    ///
    /// # Errors
    /// As [`Equilibrium::solve`] and [`Comparison::solve`].
    pub fn solve(&mut self, inputs: &Inputs) -> Result<Report, Error> {
        either!(self, solver => solver.solve(inputs))
    }

    /// See [`Equilibrium::reset`].
    pub fn reset(&mut self) {
        either!(self, solver => solver.reset());
    }

    /// See [`Equilibrium::settings`].
    #[must_use]
    pub fn settings(&self) -> &Settings {
        either!(self, solver => solver.settings())
    }

    /// See [`Equilibrium::margin`]; `None` from the other methods.
    pub fn margin(&mut self) -> Option<f64> {
        match self {
            Self::Potential(solver) => solver.margin(),
            Self::Other(_) => None,
        }
    }

    /// See [`Equilibrium::jacobian`].
    ///
    /// # Errors
    /// As [`Equilibrium::jacobian`]; [`Error::NoDerivatives`] from the other methods.
    pub fn jacobian(&self) -> Result<Jacobian, Error> {
        match self {
            Self::Potential(solver) => solver.jacobian(),
            Self::Other(_) => Err(Error::NoDerivatives(self.only_by_potential("has no derivatives"))),
        }
    }

    /// See [`Equilibrium::snapshot`].
    ///
    /// # Errors
    /// [`Error::Unsupported`] from the other methods.
    pub fn snapshot(&self) -> Result<Snapshot, Error> {
        match self {
            Self::Potential(solver) => Ok(solver.snapshot()),
            Self::Other(_) => Err(Error::Unsupported(self.only_by_potential("makes no snapshots"))),
        }
    }

    /// See [`Equilibrium::restore`].
    ///
    /// # Errors
    /// As [`Equilibrium::restore`]; [`Error::Unsupported`] from the other methods.
    pub fn restore(&mut self, snapshot: &Snapshot) -> Result<(), Error> {
        match self {
            Self::Potential(solver) => solver.restore(snapshot),
            Self::Other(_) => Err(Error::Unsupported(self.only_by_potential("takes no snapshots"))),
        }
    }

    fn only_by_potential(&self, lack: &str) -> String {
        let (own, other) = (self.settings().method.name(), Method::Potential.name());
        format!("method \"{own}\" {lack}: choose \"{other}\"")
    }

    /// See [`Equilibrium::tip`].
    #[must_use]
    pub fn tip(&self) -> Pose {
        either!(self, solver => solver.tip())
    }

    /// See [`Equilibrium::rings`].
    #[must_use]
    pub fn rings(&self) -> Box<dyn Iterator<Item = Pose> + '_> {
        either!(self, solver => Box::new(solver.rings()))
    }

    /// See [`Equilibrium::core_angles`].
    #[must_use]
    pub fn core_angles(&self) -> Box<dyn Iterator<Item = f64> + '_> {
        either!(self, solver => Box::new(solver.core_angles()))
    }

    /// See [`Equilibrium::shape`].
    #[must_use]
    pub fn shape(&self) -> Box<dyn Iterator<Item = (f64, Vector3<f64>)> + '_> {
        either!(self, solver => Box::new(solver.shape()))
    }

    /// See [`Equilibrium::base_reaction`].
    #[must_use]
    pub fn base_reaction(&self) -> Wrench {
        either!(self, solver => solver.base_reaction())
    }

    /// See [`Equilibrium::magnetic_wrench`].
    #[must_use]
    pub fn magnetic_wrench(&self) -> Wrench {
        either!(self, solver => solver.magnetic_wrench())
    }

    /// See [`Equilibrium::magnet_reaction`].
    #[must_use]
    pub fn magnet_reaction(&self, inputs: &Inputs) -> Wrench {
        either!(self, solver => solver.magnet_reaction(inputs))
    }

    /// See [`Equilibrium::field_at`].
    #[must_use]
    pub fn field_at(&self, inputs: &Inputs, point: &Vector3<f64>) -> Option<Vector3<f64>> {
        either!(self, solver => solver.field_at(inputs, point))
    }
}
