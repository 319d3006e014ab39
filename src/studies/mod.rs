//! The paper's figures, computed: numbers to draw, and what they say beside the paper's.
//!
//! Every study is a function without arguments that returns a [`Study`]: nothing is printed or written here.

mod fig5;
mod study;

pub use fig5::fig5;
pub use study::{Column, Comparison, Curve, Mark, Panel, Stroke, Study, Value};
