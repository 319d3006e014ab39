//! Shapes, branches, sensitivities and what is told of them.

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

/// Energies of the reference table where rings act on spans: it states no digits of them, and ours change by 4e-5 when the spans
/// are resolved twice as finely.
pub(crate) const STATICS_SPANS_ENERGY: f64 = 1e-3;

/// Tips of devices made of sections against an independent program, over the length: its own digits are nine and more, ours those of
/// the finest discretisation that the tolerances of the scene lead to.
pub(crate) const SECTIONS_LENGTH: f64 = 1e-7;

/// Their orientation, rad.
pub(crate) const SECTIONS_ANGLE: f64 = 1e-6;

/// Their wrenches and energies.
pub(crate) const SECTIONS_WRENCH: f64 = 1e-6;

/// Their stability margins: the table has seven decimals, and a margin is of first order in the error of the shape.
pub(crate) const SECTIONS_MARGIN: f64 = 1e-5;

/// A device and its mirror image, or the same device elsewhere, over the length.
pub(crate) const MIRRORED: f64 = 1e-9;

/// Closed forms of bent rods, over the length, and their angles in rad.
pub(crate) const CLOSED_FORM: f64 = 1e-7;

/// Tips of one device that is written in two ways, m.
pub(crate) const SAME_DEVICE: f64 = 1e-12;

/// Forces between adjacent rings at the default accuracy: the rule of most nodes on the axis leaves 5e-6 there.
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

/// Margin of the solver against that of pieces of constant strain, extrapolated from two lengths.
pub(crate) const MARGIN_BY_STRAINS: f64 = 5e-5;

/// Margin of a pushed shaft against that of pieces whose magnetisation lies on the centreline, at the length of the solver.
pub(crate) const PUSHED_MARGIN: f64 = 1e-3;

/// Energy of a neutral shape that is turned: what the quadratures of sections leave.
pub(crate) const SAME_ENERGY_TURNED: f64 = 1e-6;

/// Angle of a bent core against a closed form: the rotation of the discs varies within them by their two Gauss points.
pub(crate) const BEND: f64 = 1e-9;

/// Tip angle of three closed cores, deg: measured 119 in a field whose direction is not printed; ours stop at 115 to 127
/// (`none` to `full`) in a field turned by 170 deg.
pub(crate) const PAPER_STOP_DEG: f64 = 10.0;

/// The quick look at the margin after every solve, close to a fold, where it must tell: from above.
pub(crate) const MARGIN_BOUND: f64 = 0.01;

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

/// Derivatives of curvatures, likewise. At a residual of 1e-9, where cheaper models of `auto` stop, a curvature is known to as much of
/// its scale; a difference of fourth order over steps of 1e-3 makes 1.5e-6 of that, and twice as much with both signs (reached: 1.3e-6;
/// 2e-10 where the level is fixed and the residual 1e-13).
pub(crate) const JACOBIAN_CURVATURE: f64 = 3e-6;

/// Derivatives of all outputs by numbers of the scene, from gradients of neighbouring models, by the same differences of solves.
pub(crate) const SENSITIVITY: f64 = 1e-6;

/// Symmetries of second derivatives, each side from solves of its own with one factorisation.
pub(crate) const SYMMETRY: f64 = 1e-9;

/// Tip over the length at the default degree, uniform field of 20 mT.
pub(crate) const DEGREE_NONE: f64 = 2e-6;

/// Tip over the length at the default degree with ring pairs, uniform field of 20 mT.
pub(crate) const DEGREE_RINGS: f64 = 1e-5;

/// Tip over length between two references of different degrees, nine segments beside the magnet pair; 4.7e-10 measured, 4e-7
/// with the stations of other solves.
pub(crate) const BETWEEN_REFERENCES: f64 = 1e-9;

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

/// A shape that is reached on two ways, rad: both are solved to 1e-11 turns of one element.
pub(crate) const SAME_SHAPE: f64 = 1e-9;

/// The packed FMU in another importer beside the Rust API: the same library on the same path, compiled apart.
pub(crate) const IMPORTER: f64 = 1e-9;

/// A change that counts as an effect of what was changed: far above any tolerance of a solve, rad.
pub(crate) const EFFECT: f64 = 1e-6;

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

/// Collapses under `full`, mT: the values have two decimals, and at the default tolerances ours err by 0.003.
pub(crate) const COLLAPSE_MT: f64 = 0.01;

/// Derivatives through the C interface by differences of fourth order: rounding of a solve, 1e-11, over a step of 1e-3,
/// relative to the largest effect that an input of usual size has on that kind of output (reached: 4e-8).
pub(crate) const ABI_DIFFERENCE: f64 = 3e-7;

/// Derivatives of curvatures through the C interface, likewise: [`JACOBIAN_CURVATURE`] says why they are known to less (reached: 3.1e-7;
/// differences over three times as long a step agree to 3e-8).
pub(crate) const ABI_CURVATURE: f64 = 1e-6;

/// Other methods by default, relative to the length, a radian or the largest wrench (reached: 7.6e-6 by collocation, 1.1e-6
/// by those that shoot).
pub(crate) const METHOD_COARSE: f64 = 1e-5;

/// Arcs of constant curvature: shear, extension and the moment's change along a core are missing (reached: 1.6e-2).
pub(crate) const METHOD_ARCS: f64 = 0.02;

/// Arcs of constant curvature with touching windings: an arc does not tell the discs' bend from the core's (reached: 2.2e-2).
pub(crate) const METHOD_ARCS_STOPPED: f64 = 0.03;

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

/// Folds of a dipole on a core beside closed forms, which leave out nothing.
pub(crate) const CLOSED_FORM_OF_FOLDS: f64 = 1e-7;

/// Largest errors of a snap predicted 5, 2 and 1 % of the way before it, relative to the distance (reached: 0.16 by one segment
/// that is pulled shut, whose margin falls slowly first; 0.026; 0.083 by nine segments, nearly symmetric so close to the snap).
pub(crate) const PREDICTED_AHEAD: [f64; 3] = [0.17, 0.05, 0.1];

/// Energy between two shapes of a branch beside the trapezoidal rule, relative to its largest slope over the whole range
/// (reached: 2.3e-6, of second order in the steps).
pub(crate) const ALONG_ENERGY: f64 = 1e-5;

/// How far below the measured stability margin that told along a walk may lie, relative to it: kept while shape and loads
/// drift by a tenth of it (reached: 2.4e-2).
pub(crate) const KEPT_MARGIN: f64 = 0.05;

/// Tip on two ways to the same inputs over the length: the residual, 1e-11, times a compliance of order ten.
pub(crate) const WAY: f64 = 1e-9;

/// Slope of the energy at a solved shape by differences with steps of 1e-3, in turns of one element by a radian.
pub(crate) const BALANCED: f64 = 1e-5;

/// Smallest eigenvalue, over the elastic one, of a shape that may turn freely, by differences of gradients with steps of 1e-5.
pub(crate) const NEUTRAL_SHAPE: f64 = 1e-6;

/// Tips after two ways that end in one shape, mm: 1e-9 of the length ([`WAY`]), 5 cm.
pub(crate) const SAME_TIP_MM: f64 = 1e-7;

/// Error of the tip's angle (rad) over the accuracy of the pairs: that is one of energies, of which the angle is a slope
/// (reached: 1.4).
pub(crate) const ANGLE_BY_ACCURACY: f64 = 2.0;

/// Changes of the tip angle, percent, by the same solve of a scene file: its millimetres and millitesla are rounded.
pub(crate) const BUDGET_SOLVES: f64 = 1e-6;

/// Changes of the tip angle, percent, as an independent model states them, to one digit or two.
pub(crate) const BUDGET_POINTS: f64 = 0.5;

/// Effect of the recoil permeability by an integral equation: the moment is 5e-5 off, the effect 2.7e-2 of it.
pub(crate) const BY_RECOIL: f64 = 3e-3;

/// Depth of the manipulator in a magnet by circles of points, m, whose chords are 2.5 nm off (reached: 0.6 nm).
pub(crate) const CONTACT_DEPTH: f64 = 1e-6;

/// Strength of the magnet at a fold, which is within the step of 2e-5 where the walk snaps.
pub(crate) const FOLD_OF_A_STEP: f64 = 1e-5;

/// Field at which one segment with the rings' attraction loses its straight shape, T, within half a step of 0.05 mT.
pub(crate) const NO_FOLD_BEFORE_T: f64 = 0.029_251;

/// Tip angle with a moment of 1e-11 N m: it turns a core by 2e-8 rad, over the margin; `auto` ends its cheaper models at 1e-7.
pub(crate) const VANISHING_MOMENT_DEG: f64 = 1e-3;

/// Part of random scenes whose error is below what is told: the estimate is one of first order, with a factor for doubt.
pub(crate) const ESTIMATED_SHARE: f64 = 0.99;

/// Part of warm steps of `auto` where more than five times the error is told: 18 % while estimates grew with any change.
pub(crate) const PESSIMISTIC_SHARE: f64 = 0.05;

/// Median of the error that is told over the error that is: that factor is 2, and what is added to it where errors are small.
pub(crate) const ESTIMATED_MEDIAN: f64 = 3.0;

/// Least error over the length that is told; smaller ones are not compared in size.
pub(crate) const LEAST_TOLD: f64 = 1e-8;

/// Part of the last step at which its branch folds, by continuation, less where the solve told that it was lost: toward a fold
/// the shape moves by the root of the way that is left, and the last step that stays on the branch ends before it.
pub(crate) const FOLD_ON_THE_WAY: f64 = 5e-3;

/// Motion of the tip by a vanishing moment, over that of a straight rod and over the margin, of which the softest shape has part.
pub(crate) const MOVED_BY_A_MOMENT: f64 = 3.0;

/// What changes of models and quadrature rules add to a step's relative change of force, over the tolerance of the tip
/// relative to the length: forces follow the shape.
pub(crate) const CHATTER: f64 = 10.0;

/// What changes of models and quadrature rules add to a step's change of the stability margin, absolute: it is told anew when
/// loads or shape have changed by a tenth of it.
pub(crate) const MARGIN_CHATTER: f64 = 0.1;

/// Shapes of spirals turned about the axis beside the shape turned, relative to what bends it: the points that stand for the
/// spirals in the rings' fields do not turn with them (reached: 3e-5).
pub(crate) const TURNED_SPIRALS: f64 = 1e-4;

/// Tip angle of a shape that is its own point reflection, deg, by the default accuracies (reached: 5e-5, S = 12).
pub(crate) const REFLECTED_DEG: f64 = 1e-4;

/// Tip of a tube with long discs against an independent rod, m.
pub(crate) const LONG_DISCS: f64 = 1e-7;

/// Sums and differences between points 2 to 10 um apart, of strains that change along millimetres.
pub(crate) const STRAINS_BETWEEN_POINTS: f64 = 1e-5;

/// Central differences of whole solves of default accuracy, in steps of 1e-3 of an input.
pub(crate) const CENTRAL_DIFFERENCE: f64 = 2e-5;
