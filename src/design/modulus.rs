//! Elastic moduli, as they are given.

/// An elastic modulus, given directly or by the Shore hardness.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Modulus {
    /// Shore A hardness, converted to Young's modulus by Gent's relation (Eq. 14).
    ShoreA(f64),
    /// Young's modulus, Pa.
    Elastic(f64),
}
