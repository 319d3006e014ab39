//! The paper's figures, computed: numbers to draw, and what they say beside the paper's.
//!
//! Every study is a function without arguments that returns a [`Study`]: nothing is printed or written here.

mod experiment;
mod field_ring;
mod fig4;
mod fig5;
mod fig7c;
mod fig7d;
mod fig8;
mod study;

pub use field_ring::field_ring;
pub use fig4::fig4;
pub use fig5::fig5;
pub use fig7c::fig7c;
pub use fig7d::fig7d;
pub use fig8::fig8;
pub use study::{Column, Comparison, Curve, Mark, Panel, Stroke, Study, Value};
