//! The smallest change of one number of the design with which the unloaded device stands.

use core::fmt;

use super::bracket::Bracket;
use super::{Outputs, Scene, SceneFile, Status, stands};
use crate::design::{Specification, ValueList};
use crate::equilibrium::{Deadline, Outcome};
use crate::error::Error;
use crate::manipulator::way::Way;

/// Part of what is left of the time budget that the continuation may take; then solves of the scene itself begin.
const CONTINUED: f64 = 0.6;

/// Cold solves by which a value may be confirmed; each fails at twice the distance of the last one.
const CONFIRMATIONS: u32 = 6;

/// Part of a rounding step below which a value counts as rounded already.
const ROUNDING: f64 = 1e-6;

/// The keys that are tried, in this order: hardness up to the end of the Shore A scale in use, then weaker rings.
const KEYS: [Key; 2] = [
    Key { name: "design.helix.shore_a", limit: 95.0, per_unit: 10.0 },
    Key { name: "design.ring.remanence_t", limit: 0.1, per_unit: 100.0 },
];

/// Whether a device has the numbers that are tried, each the same for all of its segments.
pub(super) fn has_keys(specification: &Specification) -> bool {
    let tried = |list: &ValueList| KEYS.iter().any(|key| key.name == list.quantity.key);
    matches!(specification, Specification::Segmented(chain) if !chain.lists.iter().any(tried))
}

/// A number of the design that makes a device stand.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Key {
    name: &'static str,
    /// The value that is tried first, with which nearly every device stands, in the unit of the key.
    limit: f64,
    /// Inverse of the step to which values are rounded.
    per_unit: f64,
}

/// What lets a device stand.
#[derive(Debug, Clone, PartialEq)]
pub enum Remedy {
    /// One number of the scene, confirmed by a cold solve.
    From {
        /// Key of the number.
        key: &'static str,
        /// Its value, in the unit of the key.
        value: f64,
        /// Whether smaller numbers, instead of larger ones, let the device stand too.
        downwards: bool,
        /// Whether the scene itself, whose loads are not at rest, has a shape there; `None` for a scene without loads, and where the
        /// time budget ended before that was known.
        under_loads: Option<bool>,
    },
    /// None was found.
    Unknown {
        /// Key of the last number that was tried.
        key: &'static str,
        /// The farthest value that was tried, in the unit of the key.
        value: f64,
        /// Whether the time budget ended the search.
        late: bool,
    },
}

impl fmt::Display for Remedy {
    fn fmt(&self, out: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::From { key, value, downwards, under_loads } => {
                let direction = if *downwards { "down" } else { "on" };
                write!(out, "it stands from {key} = {value} {direction}")?;
                if *under_loads == Some(false) {
                    write!(out, ", but has no shape there under the loads of this scene")?;
                }
                Ok(())
            }
            Self::Unknown { key, value, late } => {
                write!(out, "no value found up to {key} = {value}")?;
                if *late {
                    write!(out, " within model.time_budget_s")?;
                }
                Ok(())
            }
        }
    }
}

/// The search for a remedy.
#[derive(Debug, Clone, Copy)]
pub(super) struct Search<'a> {
    pub(super) file: &'a SceneFile,
    pub(super) deadline: &'a Deadline,
    /// Whether the scene has loads.
    pub(super) loaded: bool,
    /// Whether the device is known not to stand; otherwise a remedy is only one where the branch of the standing device ends before
    /// the scene's own number.
    pub(super) shut: bool,
}

impl Search<'_> {
    /// Tries one key after the other.
    ///
    /// # Errors
    /// As [`Scene::manipulator`] and [`crate::manipulator::Manipulator::solve`].
    pub(super) fn remedy(&self) -> Result<Remedy, Error> {
        let mut unknown = None;
        for key in KEYS {
            if unknown.is_none() || !self.deadline.has_passed() {
                match self.by(&key)? {
                    found @ Remedy::From { .. } => return Ok(found),
                    other => unknown = Some(other),
                }
            }
        }
        let nothing = Remedy::Unknown { key: KEYS[0].name, value: KEYS[0].limit, late: true };
        Ok(unknown.unwrap_or(nothing))
    }

    /// Follows the device from the stiff side of a key to where it is lost, and confirms the value there by cold solves.
    fn by(&self, key: &Key) -> Result<Remedy, Error> {
        let unknown = |late| Remedy::Unknown { key: key.name, value: key.limit, late };
        let own = self.file.number(key.name)?;
        let side = (key.limit - own).signum();
        if side * (key.limit - own) <= 1.0 / key.per_unit {
            return Ok(unknown(false));
        }

        let at = |value| Ok(at_rest(self.file.with(key.name, value)?.scene()?));
        let keep = (1.0 - CONTINUED) * self.deadline.left();
        let bracket = Bracket { deadline: self.deadline, keep, step: 1.0 / key.per_unit };
        let found = bracket.narrow([key.limit, own], at)?;
        let Some((standing, _)) = found.filter(|(_, ends)| *ends || self.shut) else {
            return Ok(unknown(self.deadline.has_passed()));
        };

        let rounded = |value: f64| side * (side * value * key.per_unit - ROUNDING).ceil() / key.per_unit;
        let within = |value: f64| if side > 0.0 { value.min(key.limit) } else { value.max(key.limit) };
        for trial in 0..CONFIRMATIONS {
            let farther = (f64::from(2_u32.pow(trial)) - 1.0) / key.per_unit;
            let value = within(rounded(standing + side * farther));
            if self.deadline.has_passed() {
                break;
            }
            if Self::is_confirmed(&at(value)?)? {
                let under_loads = if self.loaded { self.holds_loads(key, value)? } else { None };
                return Ok(Remedy::From { key: key.name, value, downwards: side < 0.0, under_loads });
            }
        }
        Ok(unknown(self.deadline.has_passed()))
    }

    /// Solves a scene cold, in the time budget of a solve: what is confirmed is what a user's solve of that scene gives.
    ///
    /// # Errors
    /// As [`Scene::manipulator`] and [`crate::manipulator::Manipulator::solve`].
    pub(super) fn solve(scene: &Scene) -> Result<Outputs, Error> {
        scene.manipulator(2)?.solve(&scene.inputs).cloned()
    }

    /// Whether a cold solve of the unloaded device finds it standing: stable, on the branch of the straight shape, within tolerance.
    fn is_confirmed(scene: &Scene) -> Result<bool, Error> {
        let outputs = Self::solve(scene)?;
        let followed = outputs.outcome == Outcome::Solved && outputs.status != Status::Snapped;
        let sure = outputs.stable != Some(false) && !outputs.beyond_tolerance;
        Ok(followed && sure && stands(scene, &outputs))
    }

    /// Whether the scene with its loads has a shape; `None` where the budget ends before.
    fn holds_loads(&self, key: &Key, value: f64) -> Result<Option<bool>, Error> {
        let outputs = Self::solve(&self.file.with(key.name, value)?.scene()?)?;
        let late = matches!(outputs.outcome, Outcome::OutOfBudget(_));
        Ok((!late).then_some(outputs.status != Status::NotSolved))
    }
}

/// A scene without its loads, which a device then comes to directly.
pub(super) fn at_rest(scene: Scene) -> Scene {
    Scene { inputs: scene.inputs.without_loads(), way: Way::default(), ..scene }
}
