//! The paper's figures and further studies, computed: tables of numbers, and their comparison with the paper.
//!
//! Most studies are functions that return a [`Study`]; those that take long tell their [`Progress`]. [`accuracy()`], [`fidelity()`],
//! [`omissions()`] and [`budget()`] return rows; [`bifurcation()`] returns tables beside its diagrams. The map of failures takes
//! minutes: [`stability_rays`] lists its parts, [`Ray::attempts`] computes one. Nothing is printed, written or drawn here.

mod accuracy;
mod bands;
mod bending;
mod bifurcation;
mod budget;
mod coils;
mod communication_step;
mod experiment;
mod fidelity;
mod field_ring;
mod fig4;
mod fig5;
mod fig7a;
mod fig7b;
mod fig7c;
mod fig7d;
mod fig8;
mod fig9;
mod hysteresis;
mod omissions;
mod progress;
mod rest;
mod scenes;
mod stability;
mod study;

pub use accuracy::{Point, accuracy, front};
pub use bands::bands;
pub use bifurcation::{Bifurcation, DISTANCES, Place, Prediction, bifurcation};
pub use budget::{BUDGET_SCENES, BudgetKind, BudgetScene, Contribution, budget};
pub use coils::coils;
pub use communication_step::communication_step;
pub use fidelity::{Fidelity, fidelity};
pub use field_ring::field_ring;
pub use fig4::fig4;
pub use fig5::fig5;
pub use fig7a::{Gain, fig7a, gain_from_base_ring};
pub use fig7b::fig7b;
pub use fig7c::fig7c;
pub use fig7d::fig7d;
pub use fig8::fig8;
pub use fig9::fig9;
pub use hysteresis::hysteresis;
pub use omissions::{Omission, omissions};
pub use progress::Progress;
pub use rest::rest;
pub use stability::{Attempt, Ray, Verdict, stability_rays};
pub use study::{Column, Comparison, Mark, Study, Value};

/// Processor time that a solve of a study may take, s: its numbers must not depend on the machine.
const PATIENCE: f64 = 600.0;
