//! A room of `src` uses only the rooms before it.
