//! The allowed range of the numbers of a scene that no other part of the library checks, in the units of the scene.

use crate::design::MOST_SECTIONS;
use crate::equilibrium::{LONGEST_INSERTION, LONGEST_REACH};
use crate::error::Interval;

/// Turns of the field, of magnets, of the base and of the shaft, deg: a hundred times round. Of a larger one too few digits would be
/// left.
pub(super) const TURN: Interval = Interval::within(36_000.0);

/// Angle by which a spiral is turned about the axis, deg.
pub(super) const SPIRAL_START: Interval = Interval::within(360.0);

/// Length of shaft inside the port, mm.
pub(super) const INSERTION: Interval = Interval::at_least(0.0).at_most(1e3 * LONGEST_INSERTION);

/// Reach of the guidewire from the port, mm.
pub(super) const GUIDEWIRE_INSERTION: Interval = Interval::at_least(0.0).at_most(1e3 * LONGEST_REACH);

/// How many sections, or groups of sections, follow one another.
pub(super) const REPEAT: Interval = Interval::at_least(1.0).at_most(MOST_SECTIONS as f64);

/// Standard deviations of any number.
pub(super) const DEVIATION: Interval = Interval::above(0.0);

/// Correlations of two numbers.
pub(super) const CORRELATION: Interval = Interval::within(1.0);

/// The keys that these ranges are of.
#[cfg(test)]
pub(super) const KEYS: [(&str, Interval); 10] = [
    ("design.section.repeat", REPEAT),
    ("design.group.repeat", REPEAT),
    ("field.turn_deg", TURN),
    ("magnet.turn_deg", TURN),
    ("base.turn_deg", TURN),
    ("feed.roll_deg", TURN),
    ("feed.insertion_mm", INSERTION),
    ("guidewire.insertion_mm", GUIDEWIRE_INSERTION),
    ("uncertainty.*", DEVIATION),
    ("correlation.*", CORRELATION),
];
