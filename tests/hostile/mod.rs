//! The C interface in hostile hands: what the property test here does for a moment, `record.rs` does for long and the
//! fuzz target in `fuzz/` under a sanitizer, led by coverage.
#![allow(unsafe_code, reason = "the functions under test take raw pointers")]

pub(crate) mod host;
mod insertions;

use std::path::Path;
use std::time::Duration;

use proptest::prelude::*;

use host::{Design, Host};

/// A call that takes longer hangs: a second in a recorded run; tests share their machine.
const PATIENCE: Duration = Duration::from_secs(10);

proptest! {
    #![proptest_config(ProptestConfig { cases: 64, ..ProptestConfig::default() })]

    #[test]
    fn no_bytes_make_a_host_that_breaks_it(bytes in proptest::collection::vec(any::<u8>(), 0..2000)) {
        static DESIGNS: std::sync::OnceLock<Vec<Design>> = std::sync::OnceLock::new();
        let designs = DESIGNS
            .get_or_init(|| Design::all(&Path::new(env!("CARGO_TARGET_TMPDIR")).join("hostile")));
        Host::new(designs, &bytes, PATIENCE).run();
    }
}
