//! The device as its user sees it: inputs in, shape and forces out; it keeps its last shape.

mod device;
mod inputs;
mod outputs;
mod scene;

pub use device::Manipulator;
pub use inputs::Inputs;
pub use outputs::{Outputs, Status};
pub use scene::{Scene, SceneFile};
