//! Tip angle of a device along one branch, in a uniform field that grows or turns.

use nalgebra::Vector3;

use super::PATIENCE;
use crate::design::Design;
use crate::equilibrium::Settings;
use crate::error::Error;
use crate::manipulator::{Branch, Inputs, Manipulator, Status};

/// A device and its model.
pub(super) struct Device {
    design: Design,
    settings: Settings,
}

/// Magnitude (T) and direction (deg from the base's axis +z towards +y) of the field as functions of a path parameter.
pub(super) type Way = fn(f64) -> (f64, f64);

/// Tip angles of a device along a path of the field.
pub(super) struct Bent {
    /// Tip angle at each parameter value, deg; NaN beyond the end of the branch.
    pub(super) angles: Vec<f64>,
    /// Parameter value and tip angle (deg) of the last shape, if the branch ends or snaps.
    pub(super) end: Option<[f64; 2]>,
}

impl Device {
    pub(super) fn new(design: Design, settings: Settings) -> Self {
        Self { design, settings: Settings { time_budget: PATIENCE, ..settings } }
    }

    /// The manipulator, not yet solved, without an external magnet.
    fn manipulator(&self) -> Result<Manipulator, Error> {
        Manipulator::new(&self.design, None, self.settings, 2)
    }

    /// Inputs with a field (T) at `angle` degrees from the base's axis and no other load.
    fn inputs(&self, (size, angle): (f64, f64)) -> Inputs {
        let (sine, cosine) = angle.to_radians().sin_cos();
        let uniform_field = Vector3::new(0.0, sine, cosine) * size;
        Inputs { uniform_field, ..Inputs::unloaded(self.design.rings().count()) }
    }

    /// The tip angles (deg) at evenly increasing parameter values `places`; NaN beyond the end of the branch.
    pub(super) fn bend(&self, way: Way, places: &[f64]) -> Result<Bent, Error> {
        let span = places[places.len() - 1] - places[0];
        let step = span / (places.len() - 1) as f64;
        let mut branch = Branch::new(self.manipulator()?, |place| Ok(self.inputs(way(place))), span, step)?;
        let mut angles = Vec::with_capacity(places.len());
        for &place in places {
            if !branch.folds().is_empty() {
                angles.push(f64::NAN);
                continue;
            }
            let outputs = branch.to(place)?;
            let solved = matches!(outputs.status, Status::Solved | Status::NearFold);
            angles.push(if solved { outputs.tip_angle.to_degrees() } else { f64::NAN });
        }
        let end = branch.folds().first().map(|fold| [fold.value, fold.before.tip_angle.to_degrees()]);
        Ok(Bent { angles, end })
    }

    /// Parameter value on `way` at which the tip angle is `angle` (deg), by bisection of an interval that contains it.
    pub(super) fn place_of(&self, way: Way, angle: f64, [mut low, mut high]: [f64; 2]) -> Result<f64, Error> {
        const WIDTH: f64 = 1e-6;
        let mut manipulator = self.manipulator()?;
        manipulator.solve(&self.inputs(way(low)))?;
        while (high - low) > WIDTH * high {
            let middle = 0.5 * (low + high);
            let mut trial = manipulator.clone();
            if trial.solve(&self.inputs(way(middle)))?.tip_angle.to_degrees() < angle {
                (manipulator, low) = (trial, middle);
            } else {
                high = middle;
            }
        }
        Ok(0.5 * (low + high))
    }
}
