//! Tests of `numerics`.

mod linear;
mod quadrature;
mod trust_region;
