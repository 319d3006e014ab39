//! Tests of `numerics`.

mod arnoldi;
mod continuation;
mod dense;
mod linear;
mod pseudo_transient;
mod quadrature;
mod tricubic;
mod trust_region;
