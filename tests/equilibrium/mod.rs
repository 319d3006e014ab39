//! Tests of `equilibrium`: the independent energy model, laws, derivatives, convergence, robustness.

mod convergence;
pub(crate) mod critical;
mod derivatives;
mod laws;
mod lost;
mod reciprocity;
mod reference;
mod robustness;
mod rows;
mod scaling;
mod stop;
