//! The abdominal aorta with its branches, from published measures.

mod anatomy;
mod arteries;
mod course;
mod route;
mod text;

pub use anatomy::{Aorta, Iliac, SideArtery};
pub use arteries::Artery;
pub use route::{Mouth, Route};
