//! A vessel: the space inside and the wall around it.

use super::lumen::Lumen;
use super::wall::Wall;

/// The vessel that a manipulator is in.
#[derive(Debug, Clone, PartialEq)]
pub struct Vessel {
    /// The space inside.
    pub lumen: Lumen,
    /// How the wall answers to contact.
    pub wall: Wall,
}
