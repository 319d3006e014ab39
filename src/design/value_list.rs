//! Numbers that differ along a chain: a list with one value for each segment or ring.

use core::ptr;

use crate::error::Quantity;

/// The values of one quantity, base to tip, in the place of one value for all.
#[derive(Debug, Clone, PartialEq)]
pub struct ValueList {
    /// The quantity: one of a helix or of a ring.
    pub quantity: &'static Quantity,
    /// One value for each segment, or for each ring.
    pub values: Vec<f64>,
}

impl ValueList {
    /// Whether it is a list of this quantity.
    #[must_use]
    pub fn is_of(&self, quantity: &'static Quantity) -> bool {
        ptr::eq(self.quantity, quantity)
    }
}
