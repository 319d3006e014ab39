//! Where a variable stands in the Jacobian of the manipulator.

use crate::manipulator::{Input, Output};

/// How a variable takes part in the derivatives of outputs with respect to inputs.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum DerivativeRole {
    /// It takes no part: a fixed parameter, a constant, or an output about the solution process.
    None,
    /// An output that no input changes, so that its derivatives are 0.
    Unaffected,
    /// A share `part / of` of the length of shaft that is inside the port.
    ShareOfFeed {
        /// Its numerator.
        part: usize,
        /// Its denominator.
        of: usize,
    },
    /// A component of an input of the manipulator.
    Input(Input),
    /// A component of the quaternion that describes this rotation.
    InputQuaternion(Input),
    /// A component of an output of the manipulator.
    Output(Output),
    /// A component of the quaternion of the tip.
    TipQuaternion,
}

impl DerivativeRole {
    /// Whether outputs have derivatives with respect to the variable.
    #[must_use]
    pub fn is_known(self) -> bool {
        matches!(self, Self::Input(_) | Self::InputQuaternion(_))
    }

    /// Whether the variable is an output that has derivatives.
    #[must_use]
    pub fn is_unknown(self) -> bool {
        matches!(self, Self::Unaffected | Self::ShareOfFeed { .. } | Self::Output(_) | Self::TipQuaternion)
    }
}
