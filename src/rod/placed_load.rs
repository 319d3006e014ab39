//! Loads on frames at any arc length of an element.

use std::sync::Arc;

use nalgebra::Matrix6;

use super::kinematics::FrameState;
use super::load::Load;
use super::row::Row;

/// A load on the frame at any arc length of an element.
#[derive(Debug, Clone)]
pub struct PlacedLoad {
    /// Mode tables at the arc length, see [`super::Element::row`].
    pub row: Arc<Row>,
    /// The frame there, in the frame of the start node.
    pub frame: FrameState,
    /// The load, in the axes of the start node.
    pub load: Load,
}

/// Mixed second derivative of an energy of two of an element's placed loads.
#[derive(Debug, Clone)]
pub struct PlacedCoupling {
    /// Indices of the two loads.
    pub between: [usize; 2],
    /// Rows of displacement and rotation of the first frame, columns of the second, in the axes of the start node.
    pub matrix: Matrix6<f64>,
}
