//! Every tolerance of the tests, each with its reason. Relative to the size of the value unless said.

use core::fmt::Debug;

/// Field of the closed forms: the difference of two ends loses `eps (r/a)^2 (r/h)`, 3e-13 at six extents (reached: 2e-13).
pub(crate) const FIELD: f64 = 5e-12;

/// Gradient and second derivative of the closed forms (reached: 3e-13).
pub(crate) const DERIVATIVES: f64 = 1e-12;

/// The same closer than 10 um to an edge, where one rounding of a coordinate alone moves them by up to 3.5e-12.
pub(crate) const DERIVATIVES_NEAR_EDGE: f64 = 1e-11;

/// Gradient at a source's centre, where it is zero, T/m: rounding of 1 T over the smallest dimension, 1 mm.
pub(crate) const ZERO_GRADIENT: f64 = 1e-11;

/// Wrench between two rings, asked for with [`WRENCH_ACCURACY`] (reached: 2e-12).
pub(crate) const WRENCH: f64 = 1e-8;

/// Accuracy that the wrench is asked for: tenfold inside [`WRENCH`], as the estimate is only an estimate.
pub(crate) const WRENCH_ACCURACY: f64 = 1e-9;

/// Central differences with a step of 1e-4 of the size: truncation 1e-8 times a constant of the curvature near a magnet.
pub(crate) const DIFFERENCE: f64 = 2e-6;

/// Identities that hold in exact arithmetic between results that are each good to [`DERIVATIVES`].
pub(crate) const IDENTITY: f64 = 1e-11;

/// Numbers of the paper, printed with four or five digits.
pub(crate) const PRINTED: f64 = 1.5e-4;

/// Numbers of the paper that are printed with four decimals, absolute.
pub(crate) const PRINTED_FOUR_DECIMALS: f64 = 5e-5;

/// The same with three decimals.
pub(crate) const PRINTED_THREE_DECIMALS: f64 = 5e-4;

/// Numbers known to two or three digits, of which the last may be one off.
pub(crate) const PRINTED_THREE_DIGITS: f64 = 1e-2;

/// Forces on a stiff device: the solver's spans see a field of third degree over their section as one of second.
pub(crate) const HELD: f64 = 1e-5;

/// Forces on two devices of one length over their moments: rings lie further out than an even magnetisation, which makes
/// the mean square of the distance from the middle 13 mm2 larger, and the force changes over about 22 mm.
pub(crate) const SAME_SHAPE_OF_MAGNETISATION: f64 = 0.03;

/// Slopes by central differences with steps of a twentieth of the length over which the field changes.
pub(crate) const COARSE_DIFFERENCE: f64 = 1e-2;

/// Sums over some ten thousand cells of a ring, and numbers of four digits.
pub(crate) const CELLS: f64 = 1e-3;

/// Order in the distance of what multipoles leave out, four to five extents away: the next but one changes it by some
/// percent.
pub(crate) const MULTIPOLE_ORDER: f64 = 0.5;

/// A few operations in floating point.
pub(crate) const ROUNDING: f64 = 1e-14;

/// Tip and rings of the independent energy model, relative to the length.
pub(crate) const STATICS_LENGTH: f64 = 1e-5;

/// Its angles, deg.
pub(crate) const STATICS_ANGLE_DEG: f64 = 1e-3;

/// Its forces and torques.
pub(crate) const STATICS_WRENCH: f64 = 1e-4;

/// Its lengths where rings act on spans and no digits are stated: the least of those that are, 4.0. Ours change by
/// 1e-7 when the spans are resolved twice as finely.
pub(crate) const STATICS_SPANS: f64 = 1e-4;

/// Its energies, a minimum: of second order in the error of the shape.
pub(crate) const STATICS_ENERGY: f64 = 1e-5;

/// The same where rings act on spans: the table states no digits of an energy, and ours changes by 4e-5 when the spans
/// are resolved twice as finely.
pub(crate) const STATICS_SPANS_ENERGY: f64 = 1e-3;

/// Accuracy that the ring pairs are asked for beside a table: the best that they have.
pub(crate) const PAIRS: f64 = 1e-10;

/// Forces between adjacent rings: the rule of most nodes on the axis leaves 5e-6 there, whatever is asked for.
pub(crate) const ADJACENT: f64 = 1e-5;

/// Where a turned field loses the branch, deg.
pub(crate) const FOLD_ANGLE_DEG: f64 = 0.5;

/// At which relative strength of the magnet the branch is lost: the table's ramp has steps of up to 10 percent.
pub(crate) const FOLD_STRENGTH: f64 = 0.03;

/// A shape some tenths of a degree before its fold, where it moves with the square root of the distance, over the length.
pub(crate) const FOLD_SHAPE: f64 = 0.02;

/// Critical loads of ring pairs: these are good to [`ADJACENT`], and worse the closer they have pulled each other.
pub(crate) const CRITICAL: f64 = 5e-5;

/// Critical loads without ring pairs, closed forms and tables of 6.6 digits.
pub(crate) const CRITICAL_WITHOUT_PAIRS: f64 = 5e-7;

/// Smallest eigenvalue by Lanczos' method and from the whole inverse.
pub(crate) const MARGIN: f64 = 1e-8;

/// Angle of a bent core against a closed form: the rotation of the discs varies within them by their two Gauss points.
pub(crate) const BEND: f64 = 1e-9;

/// Tip angle of three closed cores, deg: measured 119 in a field whose direction is not printed; ours stop at 115 to 127
/// (`none` to `full`) in a field turned by 170 deg.
pub(crate) const PAPER_STOP_DEG: f64 = 10.0;

/// Width at which a bisection ends: well inside [`CRITICAL`].
pub(crate) const BISECTION: f64 = 1e-8;

/// The quick look at the margin after every solve, close to a fold, where it must tell: from above.
pub(crate) const MARGIN_BOUND: f64 = 0.01;

/// A straight shape's distance from its axis over its length.
pub(crate) const ON_AXIS: f64 = 1e-9;

/// Laws that hold exactly, between two solves that each end at a residual of 1e-11.
pub(crate) const LAW: f64 = 1e-9;

/// Balance of forces, relative to the largest: rounding, and the residual of the solve.
pub(crate) const BALANCE: f64 = 1e-9;

/// Wrenches by two formulas at the shape of one solve.
pub(crate) const RECIPROCITY: f64 = 1e-7;

/// Slope of the energy by differences with steps of 1e-3, no shorter: the energy of ring pairs has a noise of 1e-10, which
/// the large weights of their rules make out of the rounding of the field.
pub(crate) const SLOPE_DIFFERENCE: f64 = 5e-7;

/// Slope of the gradient by the same.
pub(crate) const HESSIAN_DIFFERENCE: f64 = 1e-6;

/// Derivatives of all outputs by differences of fourth order of solves that each end at a residual of 1e-13, relative
/// to the largest effect that an input of usual size has on that output.
pub(crate) const JACOBIAN: f64 = 1e-6;

/// Symmetries of second derivatives, each side from solves of its own with one factorisation.
pub(crate) const SYMMETRY: f64 = 1e-9;

/// Tip over the length at the default degree, uniform field of 20 mT.
pub(crate) const DEGREE_NONE: f64 = 2e-6;

/// The same with ring pairs.
pub(crate) const DEGREE_RINGS: f64 = 1e-5;

/// Tip over the length under `full` by default, where rings and spans are seen by few points (reached: 2e-5, S = 9).
pub(crate) const FULL_BY_DEFAULT: f64 = 3e-5;

/// Tip over the length by the default accuracy of the ring pairs.
pub(crate) const PAIRS_BY_DEFAULT: f64 = 1e-5;

/// Residual of a solved shape: the default setting is 1e-11, but close ring pairs have a noise of up to 3e-11.
pub(crate) const RESIDUAL: f64 = 1e-10;

/// Shapes reached on two ways, over a length of 5 cm and in rotation.
pub(crate) const RETURN: f64 = 1e-8;

/// Closed forms of inextensible rods: the slender rod stretches by up to 1e-7 under its tip load.
pub(crate) const ELASTICA: f64 = 1e-7;

/// Stiffness at a fold by differences with a step of 1e-4, relative to the unloaded.
pub(crate) const NEUTRAL: f64 = 1e-7;

/// Sums over some million cells: of second order in their size.
pub(crate) const BRUTE_FORCE: f64 = 2e-4;

/// Rotation matrices by two formulas: near the switch of series and sine the cosine's argument is rounded.
pub(crate) const ROTATION: f64 = 1e-14;

/// Derivatives of rotations by differences of fourth order, step 1e-4: rounding over the step.
pub(crate) const ROTATION_DIFFERENCE: f64 = 1e-10;

/// Smallest eigenvalue: of second order in a residual of 1e-7, and the rounding of a metric over six decades.
pub(crate) const EIGENVALUE: f64 = 1e-8;

/// Angles of the paper's and of independent models that are known to two decimals, degrees.
pub(crate) const TWO_DECIMALS_DEG: f64 = 0.01;

/// The same shape reached on another way, rad: both are solved to 1e-11 turns of one element.
pub(crate) const SAME_SHAPE: f64 = 1e-9;

/// The packed FMU in another importer beside the Rust API: the same library on the same path, compiled apart.
pub(crate) const IMPORTER: f64 = 1e-9;

/// A change that counts as an effect of what was changed: far above any tolerance of a solve, rad.
pub(crate) const EFFECT: f64 = 1e-6;

/// Curl and divergence of a magnet's field beside it, T/m: rounding of gradients around 1 T/m.
pub(crate) const MAXWELL: f64 = 1e-13;

/// Small loads beside a beam written out by hand: they turn the tip by 1e-5, and shear that varies along a disc has no mode.
pub(crate) const LINEAR: f64 = 1e-7;

/// Sum of the effects of small loads of several kinds and the effect of their sum: of first order in the tip's turn by
/// 1e-5 where the rings' attraction couples them.
pub(crate) const SUPERPOSED: f64 = 1e-4;

/// Angles of one segment where rings act on spans, deg: the digits that the independent model has.
pub(crate) const SPANS_ANGLE_DEG: f64 = 5e-3;

/// Ratios of angles reached on two ways, by default settings (reached: 1.2e-7 for `preceding`, 7e-11 for the others).
pub(crate) const RATIO_ON_TWO_WAYS: f64 = 1e-6;

/// Where a sweep locates a fold: in an interval of this part of its range.
pub(crate) const LOCATED: f64 = 1e-5;

/// A fold located by steps from elsewhere: Newton's method may give up some intervals before it, where the branch turns.
pub(crate) const LOCATED_AGAIN: f64 = 5e-5;

/// A fold predicted from two shapes before it, relative to the distance of the last one: the square of the margin is linear
/// to leading order only (at a tenth of the load before the fold: 0.29, half as far 0.17).
pub(crate) const PREDICTED: f64 = 0.35;

/// Collapses under `full`, mT: the table has two decimals, and rings about to snap err by 1e-3.
pub(crate) const COLLAPSE_MT: f64 = 0.06;

/// Derivatives through the C interface by differences of fourth order: rounding of a solve, 1e-11, over a step of 1e-3,
/// relative to the largest effect that an input of usual size has on that kind of output (reached: 4e-8).
pub(crate) const ABI_DIFFERENCE: f64 = 3e-7;

/// Other methods by default, relative to the length, a radian or the largest wrench (reached: 7.6e-6 by collocation, 1.1e-6
/// by those that shoot).
pub(crate) const METHOD_COARSE: f64 = 1e-5;

/// Arcs of constant curvature: shear, extension and the moment's change along a core are missing (reached: 1.6e-2).
pub(crate) const METHOD_ARCS: f64 = 0.02;

/// Tips by other methods with fine meshes, over the length: what the shear that varies along a disc leaves of the potential
/// method, which gives it no mode (2e-9), and some.
pub(crate) const METHOD_FINE: f64 = 1e-8;

/// Orders of convergence between two meshes, of which the coarser is not yet asymptotic.
pub(crate) const METHOD_ORDER: f64 = 0.5;

/// Residual to which methods are solved where errors of the mesh are compared: differences leave the paper's shooting at 3e-12.
pub(crate) const METHOD_RESIDUAL: f64 = 1e-11;

/// Balance of force and moment at a shape that a method calls solved, up to 500 mT: the torque is summed up over a mesh made
/// for 20 mT (reached: 1.6e-4).
pub(crate) const METHOD_BALANCE: f64 = 5e-4;

/// Bending moment of spans on spans, which no level counts, over the elastic one, 0.031 to 0.083: by lattices of point charges
/// (reached: 8e-5 where sections follow the rod, 6.4e-4 between the windings' sharper gaps).
pub(crate) const SPANS_AMONG_THEMSELVES: f64 = 1e-3;

/// Equations of order one that Newton's method has solved until a correction is 1e-8, the next one its square.
pub(crate) const ON_BRANCH: f64 = 1e-14;

/// Parameter at singular points, of order one: located until what vanishes there is 1e-10.
pub(crate) const SINGULAR: f64 = 1e-9;

/// A segment whose rings are closer than the paper's, 3 mm apart or more, beside a beam column with the exact wrench: what
/// the rule of most nodes leaves there (reached: 1.4e-4 at 3 mm).
pub(crate) const CLOSER: f64 = 2e-4;

/// Folds of a dipole on a core beside closed forms, which leave out nothing.
pub(crate) const CLOSED_FORM_OF_FOLDS: f64 = 1e-7;

/// A snap predicted 5 % of the way before it, relative to the distance (reached: 0.12, by one segment that is pulled shut
/// 0.16: its margin falls slowly first).
pub(crate) const PREDICTED_FAR: f64 = 0.2;

/// The same 1 % before it (reached: 0.044).
pub(crate) const PREDICTED_CLOSE: f64 = 0.05;

/// Energy between two shapes of a branch beside the trapezoidal rule, relative to its largest slope over the whole range
/// (reached: 2.3e-6, of second order in the steps).
pub(crate) const ALONG_ENERGY: f64 = 1e-5;

/// Whether `got` is within `tolerance` of `expected`, relative to the Euclidean norm of `expected`; never for NaN.
pub(crate) fn is_close(got: &[f64], expected: &[f64], tolerance: f64) -> bool {
    got.len() == expected.len() && distance(got, expected) <= tolerance * norm(expected)
}

/// Stops unless `got` [`is_close`] to `expected`; says which case it was.
#[track_caller]
pub(crate) fn assert_close(case: impl Debug, got: &[f64], expected: &[f64], tolerance: f64) {
    let error = distance(got, expected) / norm(expected);
    assert!(
        is_close(got, expected, tolerance),
        "{case:?}: got {got:?}, expected {expected:?}: relative error {error:e} > {tolerance:e}"
    );
}

fn norm(values: &[f64]) -> f64 {
    values.iter().map(|v| v * v).sum::<f64>().sqrt()
}

fn distance(got: &[f64], expected: &[f64]) -> f64 {
    got.iter().zip(expected).map(|(a, b)| (a - b) * (a - b)).sum::<f64>().sqrt()
}

#[test]
fn the_comparison_sees_what_it_must() {
    assert!(is_close(&[1.0, 2.0], &[1.0, 2.0 + 1e-13], 1e-12));
    assert!(!is_close(&[1.0, 2.0], &[1.0, 2.1], 1e-2), "a wrong digit");
    assert!(!is_close(&[-1.0, -2.0], &[1.0, 2.0], 1e-2), "a wrong sign");
    assert!(!is_close(&[f64::NAN, 2.0], &[1.0, 2.0], 1e-2), "NaN in the result");
    assert!(!is_close(&[1.0, 2.0], &[f64::NAN, 2.0], 1e-2), "NaN in the reference");
    assert!(!is_close(&[f64::INFINITY, 2.0], &[1.0, 2.0], 1e-2), "infinity");
    assert!(!is_close(&[1.0], &[1.0, 2.0], 1e-2), "a missing entry");
    assert!(!is_close(&[1e-30], &[0.0], 1e-2), "zero has no size to be relative to");
}

/// How far below the measured stability margin that told along a walk may lie, relative to it: kept while shape and loads
/// drift by a tenth of it (reached: 2.4e-2).
pub(crate) const KEPT_MARGIN: f64 = 0.05;

/// Tip on two ways to the same inputs over the length: the residual, 1e-11, times a compliance of order ten.
pub(crate) const WAY: f64 = 1e-9;

/// Slope of the energy at a solved shape by differences with steps of 1e-3, in turns of one element by a radian.
pub(crate) const BALANCED: f64 = 1e-5;

/// Smallest eigenvalue, over the elastic one, of a shape that may turn freely, by differences of gradients with steps of 1e-5.
pub(crate) const NEUTRAL_SHAPE: f64 = 1e-6;

/// Rings of a shape put through them, over the length and in rotation: Newton's method in 8 steps, differences of 1e-6.
pub(crate) const INTERPOLATED: f64 = 1e-9;

/// Tips after two ways that end in one shape, mm: 1e-9 of the length ([`WAY`]), 5 cm.
pub(crate) const SAME_TIP_MM: f64 = 1e-7;

/// Error of the tip's angle (rad) over the accuracy of the pairs: that is one of energies, of which the angle is a slope
/// (reached: 1.4).
pub(crate) const ANGLE_BY_ACCURACY: f64 = 2.0;

/// First moment of a turning spiral by the points that stand for it, over volume and outer radius: by brute force, and two Gauss
/// points in the squared radius (reached: 2e-5).
pub(crate) const FIRST_MOMENT: f64 = 1e-4;

/// Mean error of the tabulated field of a ring and of its gradient, over their size (reached: 3e-6).
pub(crate) const TABLE_MEAN: f64 = 1e-5;

/// Demagnetising factors by two formulas, absolute: quadrature to rounding, and a difference of elliptic integrals that loses two
/// digits where the cylinder is a hundred times as long as wide or the reverse.
pub(crate) const DEMAGNETISATION: f64 = 1e-12;

/// Coefficients that are printed with six decimals.
pub(crate) const PRINTED_NAGAOKA: f64 = 1e-6;

/// Mean of the field within a ring by 96 Gauss points each way, which at the logarithms of its edges leave 1e-5.
pub(crate) const MEAN_FIELD: f64 = 3e-5;

/// Moment of rings of recoil permeability `mu_r`, taken as uniformly magnetised, over `(mu_r - 1)^2`: a variation that the mean field
/// leaves out counts to second order (reached: 0.025 by a solid cylinder as long as wide).
pub(crate) const UNIFORM_MAGNETISATION: f64 = 0.03;

/// Changes of the tip angle, percent, by the same solve of a scene file: its millimetres and millitesla are rounded.
pub(crate) const BUDGET_SOLVES: f64 = 1e-6;

/// The same as an independent model states them, to one digit or two.
pub(crate) const BUDGET_POINTS: f64 = 0.5;

/// Effect of the recoil permeability beside that of the mean magnetisation by an integral equation: the uniform one is 5e-5 of the
/// moment off, of which the effect is 2.7e-2.
pub(crate) const BY_RECOIL: f64 = 3e-3;

/// Depth of bodies in one another, mm: nested golden sections of 4e-11 of bodies of some centimetres.
pub(crate) const DEPTH: f64 = 1e-8;

/// The same by points up to 0.13, 0.2 and 0.14 mm apart in three directions, mm: half a diagonal.
pub(crate) const DEPTH_SAMPLED: f64 = 0.15;

/// Depth of the manipulator in a magnet by points, m: circles of 2000 points, whose chords are 2.5 nm off, every 2 um of a
/// bent segment (reached: 0.6 nm with circles of 4000).
pub(crate) const CONTACT_DEPTH: f64 = 1e-6;

/// Part of random scenes whose error is below what is told: the estimate is one of first order, with a factor for doubt.
pub(crate) const ESTIMATED_SHARE: f64 = 0.99;

/// Median of the error that is told over the error that is: that factor is 2, and what is added to it where errors are tiny.
pub(crate) const ESTIMATED_MEDIAN: f64 = 3.0;
