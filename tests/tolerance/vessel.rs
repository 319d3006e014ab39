//! Distances to the wall of a vessel.

/// Distances, m: rounding of lengths of some centimetres.
pub(crate) const CLEARANCE: f64 = 1e-16;

/// Derivatives beside differences of fourth order, relative to a unit gradient and to the second derivative.
pub(crate) const CLEARANCE_SLOPE: f64 = 1e-8;

/// Distances from a mesh by another formula, m: rounding of lengths of some centimetres, through triangles that are acute.
pub(crate) const MESH_DISTANCE: f64 = 1e-15;

/// Gradient and second derivative (1/m) outside a grid beside differences with a step of 1e-6 m, across planes of nodes where
/// the third derivative changes by some 1000 1/m2.
pub(crate) const GRID_OUTSIDE: [f64; 2] = [1e-7, 0.01];

/// Jumps of value (m), gradient and second derivative (1/m) where the grid changes: rounding of some centimetres to single
/// precision, over powers of half a millimetre.
pub(crate) const GRID_ACROSS_LEVELS: [f64; 3] = [2e-9, 1e-5, 0.1];

/// Tip of a rod in a stiff tube beside the rigid limit, relative to its length.
pub(crate) const STIFF_TIP: f64 = 1e-5;

/// Sum of the wall's forces there, relative.
pub(crate) const STIFF_FORCE: f64 = 1e-3;

/// A tube of triangles beside the tube itself, in a grid of an eighth of its radius: tip (m; facets turn the wall by up to 0.03,
/// and across the tube the device is held softly) and sum of the wall's forces (relative).
pub(crate) const MESH_TUBE: [f64; 2] = [1e-5, 1e-4];

/// Push that holds a shaft, relative to the force at the port.
pub(crate) const FEED_FORCE: f64 = 1e-4;

/// Closed forms of small slopes, relative.
pub(crate) const WALL_CLOSED_FORM: f64 = 1e-4;

/// Mean place of contact along a line that begins between elements of an eighth, relative to the length.
pub(crate) const CONTACT_PLACE: f64 = 2e-4;

/// Stability margin of a column that touches a wall in a point, absolute. The touch has a length, most of all where it spreads.
pub(crate) const MARGIN_AT_POINT: f64 = 1e-3;

/// Stability margin of a column that lies on a wall along a line, absolute: elements of an eighth hold it a little more.
pub(crate) const MARGIN_ALONG_LINE: f64 = 1e-2;

/// Push of a sleeve at a slope of a hundredth, relative: half of the slope's square.
pub(crate) const SLEEVE: f64 = 1e-4;

/// Place where a rod lifts off a former, relative to its length.
pub(crate) const LIFT_OFF: f64 = 1e-4;

/// Pitch of a helix in a tube whose slopes squared are 3e-4, relative.
pub(crate) const HELIX: f64 = 1e-3;

/// Load at which a helix in a tube has no more energy than the rod on the bottom, relative, beside that of its pitch.
pub(crate) const HELICAL_LOAD: f64 = 1e-4;

/// Force per length of a helix on its tube, relative.
pub(crate) const LINE_FORCE: f64 = 1e-2;

/// Balance of all forces, relative to the sum of the wall's: the residual of a solve.
pub(crate) const WALL_BALANCE: f64 = 1e-9;

/// Gradient in contact beside differences of the energy, relative; the Gauss points move with the shape.
pub(crate) const CONTACT_SLOPE: f64 = 1e-6;

/// Hessian in contact beside differences of the gradient, relative.
pub(crate) const CONTACT_RATE: f64 = 1e-4;

/// Derivatives by the inserted length in contact beside differences of solves, relative.
pub(crate) const CONTACT_INSERTION: f64 = 1e-4;

/// Tip of a scene that is moved as a whole, m.
pub(crate) const WALL_MOVED: f64 = 1e-11;

/// A shaft that is just at its port beside a clamp: m, N and N m.
pub(crate) const CLAMPED: f64 = 1e-6;
/// Measures of arteries searched in steps of 0.02 mm, m; that their walls taper counts less.
pub(crate) const MEASURE: f64 = 6e-5;

/// Angles between arteries, rad: a spline turns a little already before a bend begins.
pub(crate) const MEASURED_ANGLE: f64 = 1e-3;

/// Push of a sliding rod, relative to its friction: where normal forces count as settled, 1e-4.
pub(crate) const FRICTION_SETTLED: f64 = 2e-4;

/// Growth of the tension round a former, relative: the second order of the angles at its ends, and where the cord lifts off.
pub(crate) const CAPSTAN: f64 = 5e-3;

/// Push under friction beside the difference of energies, relative to the friction: the normal forces of the energy are those of the
/// last pass.
pub(crate) const FRICTION_PUSH: f64 = 1e-3;

/// Answers after steps of other sizes: push, relative to the friction, and tip, m.
pub(crate) const FRICTION_STEPS: [f64; 2] = [1e-3, 1e-7];

/// Gradient and Hessian of friction beside differences, relative.
pub(crate) const FRICTION_DERIVATIVE: f64 = 1e-8;

/// Deflection of a cantilever of two stiffnesses, 1 to 18: between elements, by the smoothed end of the wire, and within them, where
/// strain modes follow no jump of the curvature.
pub(crate) const TWO_STIFFNESSES: [f64; 2] = [1e-4, 1e-2];

/// Tip of a rod stiffened 18 times, relative to its length: the shear of a rod of all that would be as much less.
pub(crate) const SUM_OF_STIFFNESSES: f64 = 5e-4;

/// Gradient and Hessian with a wire beside differences of fourth order.
pub(crate) const WIRE_DIFFERENCE: f64 = 1e-6;

/// Push beside differences of the energy, N, where the wire's end sets in over 0.1 mm.
pub(crate) const WIRE_PUSH: f64 = 1e-6;

/// Derivatives by the reach of the wire beside differences over 2 um.
pub(crate) const WIRE_RATES: f64 = 1e-4;
