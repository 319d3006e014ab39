//! Pictures, as SVG: a solved scene to scale, and charts of numbers.
//!
//! Letters are drawn by the viewer, in its own sans-serif font.

pub(crate) mod chart;
mod file;
mod frame;
mod labels;
pub(crate) mod shape;
mod style;
mod ticks;
pub(crate) mod units;

pub(crate) use file::SvgFile;
