//! The list of all shapes of single magnets.

use super::shape::Shape;
use super::{cuboid, oblique, sphere};

/// All shapes that a magnet may have in a scene.
pub static SHAPES: [&Shape; 3] = [&cuboid::SHAPE, &sphere::SHAPE, &oblique::SHAPE];

/// The shape of this name.
#[must_use]
pub fn shape_named(name: &str) -> Option<&'static Shape> {
    SHAPES.into_iter().find(|shape| shape.name == name)
}
