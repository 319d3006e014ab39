//! Single magnets by their shape: what scenes and the FMU know of each.

use core::fmt;

use nalgebra::Vector3;

use super::source::Source;
use crate::design::Direction;
use crate::error::{Error, Quantity};
use crate::magnetics::quantities::{DIRECTED_REMANENCE, DIRECTION};

/// A shape that a magnet may have.
pub struct Shape {
    /// Its name in scenes.
    pub name: &'static str,
    /// What it is, in words without a full stop.
    pub description: &'static str,
    /// Its dimensions; several entries of one list are the same quantity several times.
    pub dimensions: &'static [&'static Quantity],
    /// Makes the source with these dimensions (m) and remanence (T).
    pub(super) make: fn(&[f64], Vector3<f64>) -> Result<Source, Error>,
}

impl Shape {
    /// The dimensions, each with its number among those of the same quantity, from 0.
    pub fn numbered(&self) -> impl Iterator<Item = (usize, &'static Quantity)> {
        let before = move |at: usize| {
            self.dimensions[..at].iter().filter(move |other| **other == self.dimensions[at]).count()
        };
        self.dimensions.iter().enumerate().map(move |(at, quantity)| (before(at), *quantity))
    }
}

impl fmt::Debug for Shape {
    fn fmt(&self, out: &mut fmt::Formatter<'_>) -> fmt::Result {
        out.write_str(self.name)
    }
}

impl PartialEq for Shape {
    fn eq(&self, other: &Self) -> bool {
        self.name == other.name
    }
}

/// A magnet of one of the [`super::SHAPES`], centred in its frame.
///
/// ```
/// use mcm::magnetics::{ShapedMagnet, shape_named};
/// let shape = shape_named("cuboid").ok_or("no such shape")?;
/// let cube =
///     ShapedMagnet { shape, dimensions: vec![0.01; 3], direction: [0.0, 0.0, 1.0], remanence: 1.45 };
/// assert!((cube.source()?.moment().z - 1.1539).abs() < 1e-4);
/// assert!(ShapedMagnet { direction: [0.0; 3], ..cube }.source().is_err());
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Debug, Clone, PartialEq)]
pub struct ShapedMagnet {
    /// Its shape.
    pub shape: &'static Shape,
    /// As many as its shape has, m.
    pub dimensions: Vec<f64>,
    /// Direction of its magnetisation in its frame, a unit vector.
    pub direction: [f64; 3],
    /// Remanence along that direction, T; negative: against it.
    pub remanence: f64,
}

impl ShapedMagnet {
    /// The checked source.
    ///
    /// # Errors
    /// [`Error::Range`] naming the first number out of range: the length of the direction may differ from 1 by 0.001.
    pub fn source(&self) -> Result<Source, Error> {
        DIRECTED_REMANENCE.check(self.remanence)?;
        for (number, component) in (1..).zip(self.direction) {
            DIRECTION.check(component).map_err(|error| error.of_item(number))?;
        }
        let direction = Vector3::from(self.direction);
        let length = direction.norm();
        if length.is_nan() || (length - 1.0).abs() > Direction::SLACK {
            return Err(Error::range(
                "length of the magnet's direction",
                length,
                "1, as of a unit vector, within 0.001",
            ));
        }
        (self.shape.make)(&self.dimensions, direction * (self.remanence / length))
    }
}
