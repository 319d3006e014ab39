//! Numerical methods, independent of the physics.

pub mod arnoldi;
pub mod bisection;
pub mod cholesky;
pub mod continuation;
pub mod dense;
pub mod eigenvalue;
pub mod hermite;
pub mod lagrange;
pub mod levenberg_marquardt;
pub mod maximum;
pub mod newton;
pub mod onset;
pub mod processor;
pub mod pseudo_transient;
pub mod quadrature;
pub mod refinement;
pub mod spline;
pub mod tricubic;
pub mod trust_region;
