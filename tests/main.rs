//! Every Rust test of the project in one binary, in the order of the modules of `src`.
#![allow(
    clippy::unwrap_used,
    clippy::expect_used,
    clippy::panic,
    reason = "a test that meets something unexpected must stop"
)]
#![allow(clippy::print_stdout, reason = "a test tells what it reached, for whoever runs it with --nocapture")]
#![allow(
    clippy::cast_possible_truncation,
    clippy::cast_possible_wrap,
    clippy::cast_sign_loss,
    reason = "counts in tests and their tables are small whole numbers"
)]

mod differences;
mod given;
mod instructions;
mod tolerance;

mod numerics;

mod geometry;

mod vessel;

mod design;

mod magnetics;

mod rod;

mod equilibrium;

mod methods;

mod manipulator;

mod uncertainty;

mod steer;

mod fit;

mod studies;

mod fmi;

mod web;

mod abi;

mod hostile;

mod cli;

mod documents;
mod provenance;

mod layers;

mod dependencies;
