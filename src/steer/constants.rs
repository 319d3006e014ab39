//! The numbers by which steering is tuned, in one table: unit, and what is known of other values.
//!
//! Where nothing is said of other values, none are recorded.

/// Most steps of one walk.
pub(super) const MOST_STEPS: usize = 400;

/// Number of steps over which the pace of a walk is measured.
pub(super) const PACE: usize = 24;

/// Shortest part of a step that is tried.
pub(super) const SHORTEST_PART: f64 = 1.0 / 1024.0;

/// Part of the predicted gain that a step must bring. 1e-4 to 1e-2: the example `reachable` meets the same 18 of 18 targets, in 246 to
/// 243 steps together.
pub(super) const GAIN: f64 = 1e-3;

/// Difference between predicted and found errors, relative to the errors before, up to which a Jacobian is kept and corrected.
pub(super) const FAITHFUL: f64 = 0.5;

/// Step, in longest steps, below which nothing moves: by default 0.5 nm and 1e-8 rad.
pub(super) const STILL: f64 = 1e-7;

/// Most corrections of one step. In 200 random targets (the example `reachable`) most steps that needed any took one or two.
pub(super) const CORRECTIONS: usize = 4;

/// Factor by which a correction must shrink what a step has missed, for another one to be tried.
pub(super) const SHRINKS: f64 = 0.5;

/// Weight of the step's own length, relative to the largest stiffness: it chooses the shortest of many steps.
pub(super) const LENGTH_WEIGHT: f64 = 1e-10;

/// Slack, relative to what a whole step can take, up to which a limit counts as met.
pub(super) const MET: f64 = 1e-6;

/// How far beyond a face of the workspace the solver of quadratic programs may end, m.
pub(super) const FACE_ROUNDING: f64 = 1e-7;

/// Step of the differences that give the direction of the shortest distance, m.
pub(super) const GAP_DIFFERENCE: f64 = 1e-7;

/// Stability margin, in least margins, below which it is computed at every step, not only bounded.
pub(super) const NEAR_MARGIN: f64 = 2.0;

/// Step of the differences that give the gradient of the margin, in longest steps. Beside differences of fourth order the error is 1e-5
/// of the largest component (`tests/steer/limits.rs`).
pub(super) const MARGIN_DIFFERENCE: f64 = 0.02;

/// Stability margin below which what is free of the target is used to raise it.
pub(super) const COMFORTABLE_MARGIN: f64 = 0.25;

/// Length of the steps that raise it, in longest steps.
pub(super) const MARGIN_STEP: f64 = 0.5;

/// Singular values and lengths below this part of the largest count as zero.
pub(super) const RANK: f64 = 1e-6;

/// Tip angle below which the direction of bending decides how it grows, rad: the angle itself has a corner there.
pub(super) const STRAIGHT_ANGLE: f64 = 1e-4;

/// Longest step of the magnet's strength, 1.
pub(super) const STRENGTH_STEP: f64 = 0.05;

/// Longest step of a current, A.
pub(super) const CURRENT_STEP: f64 = 0.2;

/// Longest step of the uniform field, T.
pub(super) const FIELD_STEP: f64 = 1e-3;

/// Longest step of the inserted length, m.
pub(super) const INSERTION_STEP: f64 = 2e-3;

/// Most steps of a straight way: a bound, by default 10 m of travel.
pub(super) const STRAIGHT_STEPS: usize = 2000;

/// Number of states of the tree from which a target is tried that cannot be reached directly, and how many of them are tried.
pub(super) const TREE_STATES: usize = 48;
pub(super) const STARTS: usize = 8;

/// Most steps from one state of the tree to a random one: by default 12 of 5 mm are [`DRAWN_TRAVEL`].
pub(super) const EXTENSION: usize = 12;

/// Seed of all random draws: the same question has the same answer.
pub(super) const SEED: u64 = 1;

/// How far from its place the magnet is looked for where no workspace is given, m.
pub(super) const DRAWN_TRAVEL: f64 = 0.06;

/// Largest uniform field that is tried where none is given, T.
pub(super) const DRAWN_FIELD: f64 = 0.02;

/// Largest change of a coil's current that is tried, A.
pub(super) const DRAWN_CURRENT: f64 = 5.0;

/// How far the shaft is moved, m.
pub(super) const DRAWN_INSERTION: f64 = 0.02;

/// Largest relative change of the magnet's strength.
pub(super) const DRAWN_STRENGTH: f64 = 0.5;
