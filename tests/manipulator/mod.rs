//! Tests of `manipulator`.

mod jacobian;

mod scene;

mod snapshot;
