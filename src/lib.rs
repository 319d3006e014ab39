//! Statics of magnetic continuum manipulators (MCMs): given where the external magnet is, what shape,
//! tip angle and forces does the catheter take?
//!
//! The rooms, in the order in which they may use one another:

pub mod constants; // physical constants with their source
pub mod error; // the one public error

pub mod numerics; // quadrature, dense linear algebra, trust region: knows no physics

pub mod geometry; // rotations and poses

pub mod design; // what is built: materials, sections, the chain of bodies

pub mod magnetics; // fields, exact and cheaper; wrench on a body; pairs of rings

pub mod rod; // strain modes, kinematics, elastic energy, weight

pub mod equilibrium; // the potential, its minimum, its stability

pub mod methods; // other methods for the same equilibrium, kept to compare with

pub mod manipulator; // the device as its user sees it: scene in, shape and forces out

pub mod studies; // the paper's figures as numbers

pub mod fmi; // the FMI 2.0 co-simulation FMU

#[cfg(doctest)]
#[doc = include_str!("../README.md")]
mod readme {} // its Rust example is a doctest
