//! Tests of `rod`: closed forms and published benchmarks, and the material that stations stand for.

mod benchmarks;
mod magnetic;
mod placed;
mod stations;
pub(crate) mod table;
