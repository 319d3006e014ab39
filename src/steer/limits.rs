//! What the way to a target must keep to, and what can stop it.

use core::fmt;

use nalgebra::Vector3;

use crate::error::{Error, check};
use crate::manipulator::Outcome;

/// What every step of a way keeps to.
#[derive(Debug, Clone, PartialEq)]
pub struct Limits {
    /// Lowest and highest corner of the box in which the magnet's centre stays, m.
    pub workspace: Option<[Vector3<f64>; 2]>,
    /// Least gap between the magnet's cylinders and the device, m.
    pub distance: f64,
    /// Least stability margin, from 0 (at a fold) to below 1.
    pub margin: f64,
    /// Largest uniform field, T.
    pub field: Option<f64>,
    /// Longest displacement of the magnet in a step, m.
    pub step: f64,
    /// Largest turn of the magnet in a step, rad.
    pub turn: f64,
}

impl Default for Limits {
    fn default() -> Self {
        Self { workspace: None, distance: 1e-3, margin: 0.0, field: None, step: 5e-3, turn: 0.1 }
    }
}

impl Limits {
    /// Checks all numbers.
    ///
    /// # Errors
    /// [`Error::Range`] naming the first limit that nothing can keep to.
    pub fn check(&self) -> Result<(), Error> {
        if let Some([low, high]) = &self.workspace {
            for (low, high) in low.iter().zip(high) {
                check("lowest place of the workspace (m)", *low, |_| true, "finite")?;
                let allowed = format!("above its lowest, {low}");
                check("highest place of the workspace (m)", *high, |v| v > *low, &allowed)?;
            }
        }
        check("least distance of the magnet (m)", self.distance, |v| v >= 0.0, ">= 0")?;
        check("least stability margin", self.margin, |v| (0.0..1.0).contains(&v), "from 0 to below 1")?;
        if let Some(field) = self.field {
            check("largest uniform field (T)", field, |v| v > 0.0, "> 0")?;
        }
        check("longest step (m)", self.step, |v| v > 0.0 && v <= 0.1, "above 0, at most 0.1")?;
        check("largest turn of a step (rad)", self.turn, |v| v > 0.0 && v <= 1.0, "above 0, at most 1")?;
        Ok(())
    }
}

/// What stops a way.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Limit {
    /// The box of the magnet.
    Workspace,
    /// The least gap between magnet and device.
    Distance,
    /// The least stability margin.
    Margin,
    /// The largest uniform field.
    Field,
    /// The shaft: no less than nothing of it can be inside its port, and no more than a metre.
    Insertion,
    /// A fold: the next step would snap.
    Snap,
    /// Beyond it no shape was found.
    NoShape(Outcome),
    /// No limit: a local optimum, from which no small step of what may move brings it nearer.
    Nearest,
    /// No limit: the search has ended while steps still brought it nearer, but less and less.
    Slow,
    /// No way without a snap was found in so many tries.
    NoWay(usize),
}

impl fmt::Display for Limit {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Workspace => f.write_str("the magnet is at the edge of its workspace"),
            Self::Distance => f.write_str("the magnet is as near to the device as it may be"),
            Self::Margin => f.write_str("the stability margin is as small as it may be"),
            Self::Field => f.write_str("the uniform field is as strong as it may be"),
            Self::Insertion => f.write_str("the shaft is at the end of its travel"),
            Self::Snap => f.write_str("the next step would snap"),
            Self::NoShape(outcome) => {
                write!(f, "beyond it there is no shape ({})", outcome.name().replace('_', " "))
            }
            Self::Nearest => f.write_str("from there no small step of what may move brings it nearer"),
            Self::Slow => f.write_str("steps still bring it nearer, but ever less: the search has ended"),
            Self::NoWay(tries) => write!(f, "no way without a snap was found in {tries} tries"),
        }
    }
}
