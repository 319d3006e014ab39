//! Printed numbers, differences and methods, whatever they are of.

/// Central differences with a step of 1e-4 of the size: truncation 1e-8 times a constant of the curvature near a magnet.
pub(crate) const DIFFERENCE: f64 = 2e-6;

/// Numbers of the paper, printed with four or five digits.
pub(crate) const PRINTED: f64 = 1.5e-4;

/// Numbers of the paper that are printed with four decimals, absolute.
pub(crate) const PRINTED_FOUR_DECIMALS: f64 = 5e-5;

/// Numbers of the paper that are printed with three decimals, absolute.
pub(crate) const PRINTED_THREE_DECIMALS: f64 = 5e-4;

/// Numbers known to two or three digits, of which the last may be one off.
pub(crate) const PRINTED_THREE_DIGITS: f64 = 1e-2;

/// Forces on a stiff device: the solver's spans see a field of third degree over their section as one of second.
pub(crate) const HELD: f64 = 1e-5;

/// Slopes by central differences with steps of a twentieth of the length over which the field changes.
pub(crate) const COARSE_DIFFERENCE: f64 = 1e-2;

/// A few operations in floating point.
pub(crate) const ROUNDING: f64 = 1e-14;

/// Width at which a bisection ends: well inside [`CRITICAL`].
pub(crate) const BISECTION: f64 = 1e-8;

/// A straight shape's distance from its axis over its length.
pub(crate) const ON_AXIS: f64 = 1e-9;

/// Laws that hold exactly, between two solves that each end at a residual of 1e-11.
pub(crate) const LAW: f64 = 1e-9;

/// Rotation matrices by two formulas: near the switch of series and sine the cosine's argument is rounded.
pub(crate) const ROTATION: f64 = 1e-14;

/// Derivatives of rotations by differences of fourth order, step 1e-4: rounding over the step.
pub(crate) const ROTATION_DIFFERENCE: f64 = 1e-10;

/// Smallest eigenvalue: of second order in a residual of 1e-7, and the rounding of a metric over six decades.
pub(crate) const EIGENVALUE: f64 = 1e-8;

/// Angles of the paper's and of independent models that are known to two decimals, degrees.
pub(crate) const TWO_DECIMALS_DEG: f64 = 0.01;

/// Small loads beside a beam written out by hand: they turn the tip by 1e-5, and shear that varies along a disc has no mode.
pub(crate) const LINEAR: f64 = 1e-7;

/// Parameter at singular points, of order one: located until what vanishes there is 1e-10.
pub(crate) const SINGULAR: f64 = 1e-9;

/// Rings of a shape put through them, over the length and in rotation: Newton's method in 8 steps, differences of 1e-6.
pub(crate) const INTERPOLATED: f64 = 1e-9;

/// Rest of a damped motion: its slopes end at 1e-11 beside stiffnesses of order one.
pub(crate) const RESTING: f64 = 1e-9;

/// Smallest real part of the eigenvalues of random matrices, by Arnoldi's method with all vectors and by the QR algorithm, over the
/// root of the size: rounding, times the condition of an eigenvalue, some hundreds.
pub(crate) const REAL_PART: f64 = 1e-9;

/// Smallest real part of the eigenvalues of random matrices, by Arnoldi's method with half as many vectors as rows, over the root
/// of the size, where it is next to zero.
pub(crate) const REAL_PART_OF_FEW: f64 = 1e-8;

/// Single precision, of numbers below 1.
pub(crate) const SINGLE: f64 = 6e-8;

/// Places in a picture, which are written to a thousandth of a pixel, relative to the range of an axis's numbers: the numbers'
/// own places, from which a place is read, are rounded as well, and span a hundred pixels at least.
pub(crate) const DRAWN: f64 = 3e-5;
