//! The device in a web page: the core as WebAssembly, asked by arrays of numbers.

mod device;

mod description; // what a page draws and offers to set

mod way; // the way of a device, kept by a page, as a scene

#[cfg(target_family = "wasm")]
pub mod ffi; // the C functions that the page calls

pub use device::Device;
