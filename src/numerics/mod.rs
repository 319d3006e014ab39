//! Numerical methods that know no physics.

pub mod quadrature;
