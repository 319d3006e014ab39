//! Tests of `manipulator`.

mod auto;

mod estimate;

mod jacobian;

mod scene;

mod snapshot;

mod steps;

mod walks;
