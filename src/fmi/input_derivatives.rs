//! Time derivatives of the inputs, and the path on which they lead the inputs during a communication step.

use std::collections::BTreeMap;

use serde::{Deserialize, Serialize};

use super::host_values::{HostValues, UncheckedPose};
use super::value::Value;
use super::variables::Table;
use crate::error::Error;
use crate::manipulator::Inputs;

/// Largest rotation between two waypoints of a path, rad. Between waypoints an orientation turns along the shortest arc at
/// constant speed, which is within `turn^3 / 100` of a quaternion that moves on a straight line and is normalised.
const LARGEST_TURN: f64 = 0.1;

/// First time derivatives of inputs by value reference; an input that is not listed is held constant.
///
/// The standard (section 4.2.1) defines inputs and their derivatives at the beginning of a communication step. The
/// derivatives are therefore used for one step, at whose end the inputs keep the values that they have reached. They stay
/// readable, for output derivatives, until the next step or until new ones are set.
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize)]
pub struct InputDerivatives {
    by_reference: BTreeMap<u32, f64>,
    used: bool,
}

impl InputDerivatives {
    /// Sets the derivative of an input (its unit per second) for the next step.
    pub fn set(&mut self, reference: u32, derivative: f64) {
        if self.used {
            *self = Self::default();
        }
        self.by_reference.insert(reference, derivative);
    }

    /// The derivatives that are not zero, of the next step or, if none were set for it, of the last one.
    pub fn nonzero(&self) -> impl Iterator<Item = (u32, f64)> + '_ {
        self.by_reference
            .iter()
            .map(|(&reference, &derivative)| (reference, derivative))
            .filter(|(_, derivative)| *derivative != 0.0)
    }

    /// Whether inputs move during the next step.
    #[must_use]
    pub fn move_inputs(&self) -> bool {
        !self.used && self.nonzero().next().is_some()
    }

    /// Marks the derivatives as used at the end of a step.
    pub fn mark_used(&mut self) {
        if self.used {
            self.by_reference.clear(); // this step held its inputs
        }
        self.used = true;
    }

    /// The host values after `time` (s): `u + u' time` for every input, with quaternions that moved normalised.
    ///
    /// # Errors
    /// [`Error::Range`] for an input that becomes infinite.
    pub fn moved(&self, table: &Table, from: &HostValues, time: f64) -> Result<HostValues, Error> {
        let mut moved = from.clone();
        for (reference, derivative) in self.nonzero() {
            let Some(variable) = table.find(reference) else { continue };
            if let Some(Value::Real(start)) = variable.host_value(from) {
                let value = start + derivative * time;
                if !value.is_finite() {
                    return Err(Error::range(format!("{} during the step", variable.name), value, "finite"));
                }
                variable.set(&mut moved, Value::Real(value))?;
            }
        }
        let sources = moved.sources.iter_mut().zip(&from.sources);
        let sources = sources.enumerate().map(|(number, (a, b))| (Some(number), &mut a.pose, &b.pose));
        for (source, moved, before) in sources.chain([(None, &mut moved.base, &from.base)]) {
            // An orientation that nothing turns stays as the host has set it, to the last bit.
            if moved.orientation.map(f64::to_bits) != before.orientation.map(f64::to_bits) {
                if moved.is_unconnected() && before.is_unconnected() {
                    continue; // its start value holds all the way
                }
                if moved.is_unconnected() {
                    // Set so by the host, it would count as not connected.
                    let quantity = format!("norm of {} during the step", from.orientation(source));
                    return Err(Error::range(quantity, 0.0, "not 0"));
                }
                moved.normalise();
            }
        }
        Ok(moved)
    }

    /// The waypoints of the path that starts at `from` and takes `duration` (s), without its start, and the host values
    /// at its end.
    ///
    /// # Errors
    /// Those of [`InputDerivatives::moved`] and [`HostValues::inputs`].
    pub fn path(
        &self,
        table: &Table,
        from: &HostValues,
        duration: f64,
    ) -> Result<(Vec<Inputs>, HostValues), Error> {
        let end = self.moved(table, from, duration)?;
        let sources = from.sources.iter().zip(&end.sources).map(|(a, b)| turn(&a.pose, &b.pose));
        let turn = sources.fold(turn(&from.base, &end.base), f64::max);
        let mut waypoints = Vec::new();
        let mut reached = 0.0;
        while reached + LARGEST_TURN < turn {
            reached += LARGEST_TURN;
            waypoints.push(self.moved(table, from, duration * reached / turn)?.inputs()?);
        }
        waypoints.push(end.inputs()?);
        Ok((waypoints, end))
    }
}

/// The angle, rad, from 0 to 2 pi, by which an orientation turns while its quaternion moves on a straight line.
fn turn(from: &UncheckedPose, to: &UncheckedPose) -> f64 {
    let dot = |a: &[f64; 4], b: &[f64; 4]| a.iter().zip(b).map(|(a, b)| a * b).sum::<f64>();
    let (a, b) = (&from.orientation, &to.orientation);
    let cosine = dot(a, b) / (dot(a, a) * dot(b, b)).sqrt();
    if cosine.is_nan() { 0.0 } else { 2.0 * cosine.clamp(-1.0, 1.0).acos() }
}
