//! The numbers by which a fit is tuned, in one table: unit, and what is known of other values.
//!
//! Where nothing is said of other values, none are recorded.

/// First damping, 1.
pub(super) const FIRST_DAMPING: f64 = 1e-3;

/// Factors of the damping after a step that is taken and after one that is not.
pub(super) const DAMPING_DECREASE: f64 = 0.1;
pub(super) const DAMPING_INCREASE: f64 = 8.0;

/// Damping below which there is none.
pub(super) const NO_DAMPING: f64 = 1e-9;

/// Damping above which nothing is gained any more.
pub(super) const LARGEST_DAMPING: f64 = 1e12;

/// Expected part of the loss that a step gains, at which the loop ends: a step of a ten thousandth of a standard deviation.
pub(super) const LEAST_GAIN: f64 = 1e-10;

/// Expected part of the loss that a step gains, at which a step that fails ends the loop.
pub(super) const SOLVER_NOISE: f64 = 1e-7;

/// Relative distance from a limit of a parameter's range that counts as the limit.
pub(super) const AT_LIMIT: f64 = 1e-6;

/// Relative change of the scale of a robust loss at which it stays.
pub(super) const SCALE_CHANGE: f64 = 1e-6;

/// Residual, in standard deviations, up to which the Huber loss is a square: 95 % as efficient as squares for normal errors
/// (P. J. Huber, Robust Statistics, 1981).
pub(super) const HUBER_CORNER: f64 = 1.345;

/// Median absolute value of a standard normal variable.
pub(super) const NORMAL_MEDIAN: f64 = 0.674_489_750_196_081_7;

/// Upper end of the intervals as a probability: 95 % lie between the ends.
pub(super) const UPPER: f64 = 0.975;

/// Part of the threshold to which the end of an interval is found.
pub(super) const CLOSE: f64 = 2e-3;

/// Most values of the parameter that are tried on a side of an interval.
pub(super) const PROFILE_VALUES: usize = 8;

/// Most corrections of the other parameters at each of these values.
pub(super) const PROFILE_CORRECTIONS: usize = 5;

/// Gain of a correction, in parts of the threshold, that no longer counts.
pub(super) const SMALL_CORRECTION: f64 = 1e-4;

/// Singular value of the Jacobian with columns of length 1, relative to the largest, below which there is no effect: the error of
/// the sensitivities is 1e-7.
pub(super) const FLAT: f64 = 1e-5;

/// Relative standard deviation of a combination of parameters from which it counts as unknown.
pub(super) const UNKNOWN: f64 = 0.5;

/// Part of a direction from which a parameter belongs to it.
pub(super) const MEMBER: f64 = 0.2;

/// Part of a flat direction from which a parameter's deviation is unknown.
pub(super) const TOUCHED: f64 = 1e-3;

/// Most rows that are repeated under a candidate.
pub(super) const REPEATED: usize = 4;

/// Most experiments that are proposed.
pub(super) const PROPOSED: usize = 3;

/// Least factor on the strength of the weakest direction that is worth a row.
pub(super) const WORTH: f64 = 1.5;
