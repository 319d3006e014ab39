//! Tests of `numerics`.

mod continuation;
mod linear;
mod quadrature;
mod trust_region;
