//! Tests of `equilibrium`: the independent energy model, laws, derivatives, convergence, robustness.

mod around;
mod contact;
mod continuation;
mod convergence;
pub(crate) mod critical;
mod derivatives;
mod laws;
mod loads;
mod lost;
mod map;
mod margin;
mod moments;
mod neglected;
mod neutral;
mod reciprocity;
mod reference;
mod rest;
mod robustness;
pub(crate) mod rows;
mod scaling;
mod sensitivity;
mod short_helix;
mod spacing;
mod stop;
mod tables;
