//! Tests of `manipulator`.
