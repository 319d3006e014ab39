//! Statics of magnetic continuum manipulators (MCMs): given where the external magnet is, what shape,
//! tip angle and forces does the catheter take?
//!
//! ```
//! use mcm::manipulator::Scene;
//!
//! // Three segments of the paper's manipulator in a uniform field of 10 mT across their axis.
//! let text = "[design]\nsegments = 3\n[field]\nuniform_mt = [0.0, 10.0, 0.0]";
//! let scene = Scene::parse(text, "quick start")?;
//! let mut manipulator = scene.manipulator(21)?; // 21 points of the centreline
//! let outputs = manipulator.solve(&scene.inputs)?;
//! assert_eq!(outputs.stable, Some(true));
//! assert!((outputs.tip_angle.to_degrees() - 73.6).abs() < 0.1);
//! # Ok::<(), mcm::error::Error>(())
//! ```
//!
//! The modules, in the order in which they may use one another:

pub mod constants; // physical constants with their source
pub mod error; // the one public error

pub mod numerics; // quadrature, dense linear algebra, trust region: knows no physics

pub mod geometry; // rotations and poses

pub mod vessel; // the vessel around it: distance to its wall

pub mod design; // what is built: materials, sections, the chain of bodies

pub mod magnetics; // fields, exact and cheaper; wrench on a body; pairs of rings

pub mod rod; // strain modes, kinematics, elastic energy, weight

pub mod equilibrium; // the potential, its minimum, its stability

pub mod manipulator; // the device as its user sees it: scene in, shape and forces out

#[cfg(feature = "methods")]
pub mod methods; // other methods for the same equilibrium, kept to compare with

#[cfg(feature = "uncertainty")]
pub mod uncertainty; // how sure the outputs are: bands and samples

#[cfg(feature = "steer")]
pub mod steer; // where the magnet must be: inputs that bring the tip to a target

#[cfg(feature = "fit")]
pub mod fit; // what the device is: parameters from measured rows

#[cfg(feature = "studies")]
pub mod studies; // the paper's figures as numbers

pub mod fmi; // the FMI 2.0 FMU

#[cfg(feature = "web")]
pub mod web; // the same device in a web page, as WebAssembly

/// Vectors, rotations and matrices of this interface, in the version that it uses: `mcm::nalgebra::Vector3`.
pub use nalgebra;

#[cfg(doctest)]
#[doc = include_str!("../README.md")]
mod readme {} // its Rust example is a doctest

#[cfg(all(doctest, feature = "steer"))]
#[doc = include_str!("steer/README.md")]
mod steer_page {} // and that of a page

#[cfg(doctest)]
#[doc = concat!("```\n", include_str!("../tests/examples/ring_field.rs"), "```")]
#[doc = concat!("```\n", include_str!("../tests/examples/shape.rs"), "```")]
#[doc = concat!("```\n", include_str!("../tests/examples/jacobian.rs"), "```")]
#[doc = concat!("```\n", include_str!("../tests/examples/snap.rs"), "```")]
mod examples {} // and so are the example programs
