//! Tests of `magnetics`.
