//! Tests of `manipulator`.

mod scene;
