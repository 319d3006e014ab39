//! Tests of `fmi`.
