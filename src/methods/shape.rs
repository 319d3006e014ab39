//! The result of every comparison method.

use nalgebra::Vector6;

use super::trace::Trace;
use crate::geometry::Pose;

/// A solved shape.
#[derive(Debug, Clone)]
pub(super) struct Shape {
    pub(super) nodes: Vec<Pose>,
    /// Internal wrench just after the base node.
    pub(super) base: Vector6<f64>,
    pub(super) trace: Trace,
}
