//! Tests of `rod`.
