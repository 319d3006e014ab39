//! The paper's figures, computed: numbers to draw, and what they say beside the paper's.
//!
//! Every study is a function without arguments that returns a [`Study`]; [`accuracy()`], which measures times, returns its
//! points, which [`accuracy_picture`] draws, and so do [`fidelity()`], [`omissions()`] and [`budget()`]; [`bifurcation()`] has tables beside its diagrams;
//! the map of failures takes minutes, and is the [`stability_rays`], each of which makes its [`Ray::attempts`], which
//! [`stability_picture`] draws. Nothing is printed or written here.

mod accuracy;
mod bending;
mod bifurcation;
mod budget;
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
mod hysteresis;
mod omissions;
mod scenes;
mod stability;
mod study;

pub use accuracy::{PEERS, Peered, Point, accuracy, accuracy_cases, accuracy_picture, front};
pub use bifurcation::{Bifurcation, DISTANCES, Place, Prediction, bifurcation};
pub use budget::{BUDGET_SCENES, BudgetKind, BudgetScene, Contribution, budget, budget_picture};
pub use communication_step::communication_step;
pub use fidelity::{Fidelity, fidelity, fidelity_picture, fidelity_scenes};
pub use field_ring::field_ring;
pub use fig4::fig4;
pub use fig5::fig5;
pub use fig7a::{Gain, fig7a, gain_from_base_ring};
pub use fig7b::fig7b;
pub use fig7c::fig7c;
pub use fig7d::fig7d;
pub use fig8::fig8;
pub use hysteresis::hysteresis;
pub use omissions::{Omission, omissions};
pub use stability::{Attempt, Ray, Verdict, stability_picture, stability_rays};
pub use study::{
    AtlasRow, Bar, Column, Comparison, Curve, Kind, Mark, Panel, Series, Stroke, Study, Tint, Value,
};
