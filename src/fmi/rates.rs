//! Time derivatives of the inputs: the path that they take during a step.

use std::collections::BTreeMap;

use serde::{Deserialize, Serialize};

use super::given::{Given, Placement};
use super::variable::Value;
use super::variables::Table;
use crate::error::Error;
use crate::manipulator::Inputs;

/// Largest turn between two points of a path, rad. Between them orientations turn along the shortest arc at constant
/// speed, which is within `turn^3 / 100` of a quaternion that moves on a straight line and is normalised.
const LARGEST_TURN: f64 = 0.1;

/// First derivatives of inputs by value reference; an input that is not named is held.
///
/// The standard (section 4.2.1) sets inputs and their derivatives with respect to the beginning of a communication
/// step. So they serve one step, at whose end the inputs keep the values reached, and can be read until new ones are set.
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize)]
pub struct Rates {
    of: BTreeMap<u32, f64>,
    spent: bool,
}

impl Rates {
    /// Sets the derivative of an input for the step to come.
    pub fn set(&mut self, reference: u32, rate: f64) {
        if self.spent {
            *self = Self::default();
        }
        self.of.insert(reference, rate);
    }

    /// The derivatives that are not zero, of the step to come or, if there are none, of the last one.
    pub fn present(&self) -> impl Iterator<Item = (u32, f64)> + '_ {
        self.of.iter().map(|(&reference, &rate)| (reference, rate)).filter(|(_, rate)| *rate != 0.0)
    }

    /// Whether inputs move during the step to come.
    #[must_use]
    pub fn move_inputs(&self) -> bool {
        !self.spent && self.present().next().is_some()
    }

    /// After a step.
    pub fn spend(&mut self) {
        if self.spent {
            self.of.clear(); // this step held its inputs
        }
        self.spent = true;
    }

    /// Where `given` is after `time` (s): `u + u' time`, orientations normalised.
    ///
    /// # Errors
    /// [`Error::Range`] for an input that becomes infinite.
    pub fn moved(&self, table: &Table, given: &Given, time: f64) -> Result<Given, Error> {
        let mut moved = given.clone();
        for (reference, rate) in self.present() {
            let Some(variable) = table.find(reference) else { continue };
            if let Some(Value::Real(from)) = variable.given(given) {
                let value = from + rate * time;
                if !variable.set(&mut moved, Value::Real(value)) {
                    return Err(Error::range(format!("{} during the step", variable.name), value, "finite"));
                }
            }
        }
        for (moved, given) in [(&mut moved.magnet, &given.magnet), (&mut moved.base, &given.base)] {
            // As it was given where nothing turns it, to the last bit.
            if moved.orientation.map(f64::to_bits) != given.orientation.map(f64::to_bits) {
                moved.normalise();
            }
        }
        Ok(moved)
    }

    /// The points of the path from `given` that takes `duration` (s), without its beginning, and where it ends.
    ///
    /// # Errors
    /// As [`Rates::moved`] and [`Given::inputs`].
    pub fn path(&self, table: &Table, given: &Given, duration: f64) -> Result<(Vec<Inputs>, Given), Error> {
        let end = self.moved(table, given, duration)?;
        let turn = f64::max(turn(&given.magnet, &end.magnet), turn(&given.base, &end.base));
        let mut points = Vec::new();
        let mut reached = 0.0;
        while reached + LARGEST_TURN < turn {
            reached += LARGEST_TURN;
            points.push(self.moved(table, given, duration * reached / turn)?.inputs()?);
        }
        points.push(end.inputs()?);
        Ok((points, end))
    }
}

/// By what angle the orientation turns on a straight line of quaternions, rad, from 0 to 2 pi.
fn turn(from: &Placement, to: &Placement) -> f64 {
    let dot = |a: &[f64; 4], b: &[f64; 4]| a.iter().zip(b).map(|(a, b)| a * b).sum::<f64>();
    let (a, b) = (&from.orientation, &to.orientation);
    let cosine = dot(a, b) / (dot(a, a) * dot(b, b)).sqrt();
    if cosine.is_nan() { 0.0 } else { 2.0 * cosine.clamp(-1.0, 1.0).acos() }
}
