//! The solution methods and their names.

use serde::{Deserialize, Serialize};

use crate::equilibrium::Interaction;
use crate::manipulator::METHODS;

/// Method that solves for the equilibrium; all but the potential method serve for comparison.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
pub enum Method {
    /// Minimum of the potential energy over strain modes, see [`crate::equilibrium::Equilibrium`].
    Potential,
    /// Single shooting with the classical Runge-Kutta method, Levenberg-Marquardt on the base wrench and a Jacobian by
    /// forward differences, as in the paper.
    ShootingPaper,
    /// Single shooting with the exact derivative of the Runge-Kutta map.
    ShootingExact,
    /// Multiple shooting from ring to ring, damped Newton.
    MultipleShooting,
    /// Gauss collocation on a mesh refined where the residual of the equations is large, damped Newton.
    Collocation,
    /// One arc of constant curvature per core with rigid discs, without torsion, shear or extension.
    ConstantCurvature,
    /// Multiple shooting in the plane that contains the loads and the field.
    Planar,
}

impl Method {
    /// Every method with its name in scene files.
    pub const ALL: [(Self, &str); METHODS.len()] = [
        (Self::Potential, METHODS[0]),
        (Self::ShootingPaper, METHODS[1]),
        (Self::ShootingExact, METHODS[2]),
        (Self::MultipleShooting, METHODS[3]),
        (Self::Collocation, METHODS[4]),
        (Self::ConstantCurvature, METHODS[5]),
        (Self::Planar, METHODS[6]),
    ];

    /// The method with this name.
    ///
    /// ```
    /// use mcm::methods::Method;
    /// assert_eq!(Method::named("shooting-fd"), Some(Method::ShootingPaper));
    /// assert_eq!(Method::named("shoting"), None);
    /// ```
    #[must_use]
    pub fn named(name: &str) -> Option<Self> {
        Self::ALL.iter().find(|row| row.1 == name).map(|row| row.0)
    }

    /// The name of the method in scene files and on the command line.
    #[must_use]
    pub fn name(self) -> &'static str {
        Self::ALL.iter().find(|row| row.0 == self).map_or("", |row| row.1)
    }

    /// Whether the method can solve scenes with this level of interaction.
    ///
    /// Where rings act on spans the differential equations are no longer local: the load on a ring is an integral over the
    /// shapes of others. Only the potential method includes this, and with it [`Interaction::Auto`], which may need it.
    #[must_use]
    pub fn supports(self, interaction: Interaction) -> bool {
        self == Self::Potential || matches!(interaction, Interaction::None | Interaction::Rings)
    }
}
