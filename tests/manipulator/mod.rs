//! Tests of `manipulator`.

mod auto;

mod jacobian;

mod scene;

mod snapshot;

mod steps;

mod walks;
