//! Tests of `design`.
