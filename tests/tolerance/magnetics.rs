//! Fields and wrenches of magnets, and where bodies are.

/// Field of the closed forms: the difference of two ends loses `eps (r/a)^2 (r/h)`, 3e-13 at six extents (reached: 2e-13).
pub(crate) const FIELD: f64 = 5e-12;

/// Gradient and second derivative of the closed forms (reached: 3e-13).
pub(crate) const DERIVATIVES: f64 = 1e-12;

/// Gradient and second derivative of the closed forms closer than 10 um to an edge, where one rounding of a coordinate alone
/// moves them by up to 3.5e-12.
pub(crate) const DERIVATIVES_NEAR_EDGE: f64 = 1e-11;

/// Gradient at a source's centre, where it is zero, T/m: rounding of 1 T over the smallest dimension, 1 mm.
pub(crate) const ZERO_GRADIENT: f64 = 1e-11;

/// Wrench between two rings, asked for with [`WRENCH_ACCURACY`] (reached: 2e-12).
pub(crate) const WRENCH: f64 = 1e-8;

/// Accuracy that the wrench is asked for: tenfold inside [`WRENCH`], as the estimate is only an estimate.
pub(crate) const WRENCH_ACCURACY: f64 = 1e-9;

/// Identities that hold in exact arithmetic between results that are each good to [`DERIVATIVES`].
pub(crate) const IDENTITY: f64 = 1e-11;

/// Forces on two devices of one length over their moments: rings lie further out than an even magnetisation, which makes
/// the mean square of the distance from the middle 13 mm2 larger, and the force changes over about 22 mm.
pub(crate) const SAME_SHAPE_OF_MAGNETISATION: f64 = 0.03;

/// Sums over some ten thousand cells of a ring, and numbers of four digits.
pub(crate) const CELLS: f64 = 1e-3;

/// Order in the distance of what multipoles leave out, four to five extents away: the next but one changes it by some
/// percent.
pub(crate) const MULTIPOLE_ORDER: f64 = 0.5;

/// Default accuracy of the ring pairs.
pub(crate) const PAIR_DEFAULT: f64 = 1e-5;

/// Force, torque and energy of ring pairs at that accuracy: a tenth of it (reached: 7e-7).
pub(crate) const RING_PAIR: f64 = 1e-6;

/// Force, torque and energy of pairs of rings of other shapes at the default accuracy, of whose close rules some poses are tried
/// (reached: 1e-6).
pub(crate) const OTHER_PAIR: f64 = 2e-6;

/// As [`RING_PAIR`] at [`PAIRS`]: what the adaptive cubature beside them is good to (reached: 1e-10).
pub(crate) const RING_PAIR_TIGHT: f64 = 1e-9;

/// Shapes that such pairs decide, over what they do: softened by up to the same again.
pub(crate) const FACES_BALANCE: f64 = 5e-6;

/// Slope of an energy of such pairs by differences of fourth order with steps of 1e-4.
pub(crate) const FACES_SLOPE: f64 = 2e-9;

/// Slope of the gradient by differences of second order with steps of 1e-5.
pub(crate) const FACES_HESSIAN: f64 = 1e-6;

/// Accuracy that the ring pairs are asked for beside a table: the best that they have.
pub(crate) const PAIRS: f64 = 1e-10;

/// Curl and divergence of a magnet's field beside it, T/m: rounding of gradients around 1 T/m.
pub(crate) const MAXWELL: f64 = 1e-13;

/// First moment of a turning spiral by the points that stand for it, over volume and outer radius: by brute force, and two Gauss
/// points in the squared radius (reached: 2e-5).
pub(crate) const FIRST_MOMENT: f64 = 1e-4;

/// Demagnetising factors by two formulas, absolute: elliptic integrals lose two digits for very long or flat cylinders.
pub(crate) const DEMAGNETISATION: f64 = 1e-12;

/// Coefficients that are printed with six decimals.
pub(crate) const PRINTED_NAGAOKA: f64 = 1e-6;

/// Mean of the field within a ring by 96 Gauss points each way, which at the logarithms of its edges leave 1e-5.
pub(crate) const MEAN_FIELD: f64 = 3e-5;

/// Moment of uniformly magnetised rings over `(mu_r - 1)^2`: second order (reached: 0.025 by a cylinder as long as wide).
pub(crate) const UNIFORM_MAGNETISATION: f64 = 0.03;

/// Depth of bodies in one another, mm: nested golden sections of 4e-11 of bodies of some centimetres.
pub(crate) const DEPTH: f64 = 1e-8;

/// Depth of bodies in one another by points up to 0.13, 0.2 and 0.14 mm apart in three directions, mm: half a diagonal.
pub(crate) const DEPTH_SAMPLED: f64 = 0.15;

/// Fields at many points beside those at single ones: other formulas of the same integrals.
pub(crate) const BATCH: f64 = 1e-12;

/// Sums over the dipoles of a sheet by four steps of the means, beside single points.
pub(crate) const ROUGH_SHEET: f64 = 2e-8;

/// The gradient by so many multipoles, over its size and over the power of the extent's ratio to the distance that is left out
/// (reached: 9).
pub(crate) const LEFT_OUT: f64 = 12.0;

/// Field, gradient and second derivative of magnets of every shape and direction.
pub(crate) const MAGNET_FIELD: f64 = 1e-12;
pub(crate) const MAGNET_GRADIENT: f64 = 1e-12;
pub(crate) const MAGNET_HESSIAN: f64 = 1e-12;

/// Fields of magnets by shape beside faces and edges, where rounding of a coordinate alone moves them by as much.
pub(crate) const NEAR_MAGNET_EDGE: f64 = 1e-11;
