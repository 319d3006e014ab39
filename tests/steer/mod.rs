//! Inputs that bring the tip to a target.
