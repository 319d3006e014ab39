//! Tests of `fmi`.

#[cfg(feature = "bindgen")]
mod bindings;
