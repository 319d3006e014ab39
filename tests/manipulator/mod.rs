//! Tests of `manipulator`.

mod auto;

mod estimate;

mod jacobian;

mod refusals;
mod scene;

mod sensitivities;

mod snapshot;

mod steps;

mod walks;

mod uncertainty;
