//! Parameters from measured rows.
