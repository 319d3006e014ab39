//! Where a variable stands in the Jacobian of the manipulator.

use crate::manipulator::output_table::Derivative;
pub use crate::manipulator::output_table::WrenchPart;
use crate::manipulator::{Input, Output};

/// How a variable takes part in the derivatives of outputs with respect to inputs.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum DerivativeRole {
    /// It takes no part: a fixed parameter, a constant, or a result without derivatives.
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
    /// An output without a row in the Jacobian, as a force of the wall: its derivatives are the differences of devices in equilibrium
    /// beside the present one.
    Neighbours,
    /// A component of the wrench of all other magnets and coils on one of them.
    MutualWrench(WrenchPart),
}

impl DerivativeRole {
    /// The role of an output of the table, of the body or point with this number; `shape_points` is the number of centreline points of
    /// a device on a shaft, `None` without one.
    #[must_use]
    pub(super) fn of(derivative: Derivative, item: usize, shape_points: Option<usize>) -> Self {
        match (derivative, shape_points) {
            (Derivative::OfSolve | Derivative::Whole, _) => Self::None,
            (Derivative::Rows(output), _) => Self::Output(output(item)),
            (Derivative::TipQuaternion, _) => Self::TipQuaternion,
            (Derivative::ShareOfShaft, None) => Self::Unaffected,
            (Derivative::ShareOfShaft, Some(points)) => Self::ShareOfFeed { part: item, of: points - 1 },
            (Derivative::Neighbours, _) => Self::Neighbours,
            (Derivative::MutualWrench(part), _) => Self::MutualWrench(part),
        }
    }

    /// Whether outputs have derivatives with respect to the variable.
    #[must_use]
    pub fn is_known(self) -> bool {
        matches!(self, Self::Input(_) | Self::InputQuaternion(_))
    }

    /// Whether the variable is an output that has derivatives.
    #[must_use]
    pub fn is_unknown(self) -> bool {
        !matches!(self, Self::None | Self::Input(_) | Self::InputQuaternion(_))
    }
}
