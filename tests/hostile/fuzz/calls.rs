//! Calls of the C interface that coverage leads, under AddressSanitizer and LeakSanitizer.
#![no_main]
#![allow(unsafe_code, reason = "the functions under test take raw pointers")]

#[path = "../host/mod.rs"]
#[allow(dead_code, reason = "the start of a life in order is for others")]
mod host;

use std::sync::LazyLock;
use std::time::Duration;

use host::{Design, Host};
use libfuzzer_sys::fuzz_target;

/// A call that takes longer hangs: a second, and what the sanitizer costs.
const PATIENCE: Duration = Duration::from_secs(10);

static DESIGNS: LazyLock<Vec<Design>> =
    LazyLock::new(|| Design::all(&std::env::temp_dir().join("mcm fuzz")));

fuzz_target!(|bytes: &[u8]| {
    Host::new(&DESIGNS, bytes, PATIENCE).run();
});
