//! The methods by name.

use serde::{Deserialize, Serialize};

use crate::equilibrium::Interaction;

/// How the equilibrium is found. All but the potential method are kept for comparison.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
pub enum Method {
    /// Minimum of the potential over strain modes, see [`crate::equilibrium::Equilibrium`].
    Potential,
    /// Single shooting with the classical Runge-Kutta method, Levenberg-Marquardt on the base wrench and a Jacobian by
    /// forward differences, as in the paper.
    ShootingPaper,
    /// The same with the exact derivative of the Runge-Kutta map.
    ShootingExact,
    /// Shooting from ring to ring, damped Newton.
    MultipleShooting,
    /// Gauss collocation on a mesh that is refined where the equations' residual is large, damped Newton.
    Collocation,
    /// One arc of constant curvature for each core, discs rigid, neither torsion nor shear nor extension.
    ConstantCurvature,
    /// Multiple shooting in the plane that holds load and field.
    Planar,
}

impl Method {
    /// Every method with its name in scene files.
    pub const ALL: &[(Self, &str)] = &[
        (Self::Potential, "potential"),
        (Self::ShootingPaper, "shooting-fd"),
        (Self::ShootingExact, "shooting"),
        (Self::MultipleShooting, "multiple-shooting"),
        (Self::Collocation, "collocation"),
        (Self::ConstantCurvature, "constant-curvature"),
        (Self::Planar, "planar"),
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

    /// Its name in scene files and on the command line.
    #[must_use]
    pub fn name(self) -> &'static str {
        Self::ALL.iter().find(|row| row.0 == self).map_or("", |row| row.1)
    }

    /// Whether it can solve scenes with this level of interaction.
    ///
    /// Where rings act on spans the differential equations are no longer local: what a ring feels is an integral over the
    /// shapes of others. Only the potential method takes that in, and with it [`Interaction::Auto`], which may come to that.
    #[must_use]
    pub fn supports(self, interaction: Interaction) -> bool {
        self == Self::Potential || matches!(interaction, Interaction::None | Interaction::Rings)
    }
}
