//! Units of a scene file.

pub(super) const MM_PER_M: f64 = 1e3;
pub(super) const MT_PER_T: f64 = 1e3;
pub(super) const PA_PER_MPA: f64 = 1e6;
