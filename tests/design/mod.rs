//! Tests of `design`.

mod limits;
mod paper;
