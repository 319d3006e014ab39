//! Tests of `manipulator`.

mod auto;
mod budget;
mod changes;
mod collapse;

mod estimate;

mod jacobian;
mod long_discs;
mod magnet_shapes;
mod near_fold;

mod quantities;
mod ranges;
mod refusals;
mod scene;

mod sections;

mod sensitivities;

mod snapshot;

mod sources;

mod steps;

mod strains;

mod tolerances;

mod walks;

mod way;

mod uncertainty;

mod units;
