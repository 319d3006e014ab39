//! Tests of `design`.

mod demagnetisation;
mod limits;
mod paper;
