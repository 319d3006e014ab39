//! Comparison methods: they solve the same scene for the same equilibrium as the potential method.

mod arc;
mod arcs;
mod bending_stop;
mod collocation;
mod compared;
mod comparison;
mod condensation;
mod device;
mod engine;
mod line;
mod mesh;
mod method;
mod multiple_shooting;
mod node_shape;
mod node_system;
mod planar;
mod plane;
mod runge_kutta;
mod settings;
mod shape;
mod shooting;
mod strong_form;
mod surroundings;
mod trace;

pub use compared::Compared;
pub use comparison::Comparison;
pub use device::Device;
pub use method::Method;
pub use settings::Settings;
