//! Tests of `geometry`.

mod rotation;
