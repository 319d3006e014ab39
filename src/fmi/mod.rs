//! The device as an FMI 2.0 co-simulation FMU.

#[rustfmt::skip]
pub mod bindings; // types of the official headers
