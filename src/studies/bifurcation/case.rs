//! A device on a path of inputs: its branches, quasi-static loading, and predictions of snaps.

use super::super::PATIENCE;
use crate::design::Design;
use crate::equilibrium::{Diagram, Equilibrium, Inputs, Settings};
use crate::error::Error;
use crate::geometry::Pose;
use crate::magnetics::Source;
use crate::manipulator::{Branch, Manipulator, Status};
use crate::numerics::continuation::Walk;

/// Number of steps of quasi-static loading along the whole path.
const STEPS: u32 = 24;

/// Longest step along a branch; 1 turns one segment by a radian.
const LONGEST_STEP: f64 = 0.2;

/// Inputs as a function of the path parameter.
pub(super) type Way = Box<dyn Fn(f64) -> Inputs + Send + Sync>;

/// A device and its path of inputs.
pub(super) struct Case {
    pub(super) design: Design,
    pub(super) magnet: Option<Source>,
    pub(super) settings: Settings,
    pub(super) way: Way,
    /// First and last value of the path parameter.
    pub(super) path: [f64; 2],
    /// Plotted angle of a tip, deg.
    pub(super) angle: fn(&Pose) -> f64,
    /// Maximum number of points of a branch.
    pub(super) points: usize,
}

/// Result of quasi-static loading along the path and, on request, back.
pub(super) struct Loading {
    /// Path parameter and angle (deg) of each shape; the angle is NaN where no shape was found.
    pub(super) shapes: Vec<[f64; 2]>,
    /// Path parameters at which the shape snaps or the branch ends.
    pub(super) snaps: Vec<f64>,
}

/// The tip's angle with the base's axis, deg.
pub(super) fn turned(tip: &Pose) -> f64 {
    tip.axis().z.clamp(-1.0, 1.0).acos().to_degrees()
}

/// The tip's angle in the plane of the field, positive towards +y.
pub(super) fn turned_in_plane(tip: &Pose) -> f64 {
    tip.axis().y.atan2(tip.axis().z).to_degrees()
}

impl Case {
    fn span(&self) -> f64 {
        (self.path[1] - self.path[0]).abs()
    }

    /// The branch through the stable shape at `from`, to which loading in one step from the path's beginning leads.
    pub(super) fn trace(&self, from: f64) -> Result<Diagram, Error> {
        let mut model = Equilibrium::new(&self.design, self.magnet.as_ref(), self.settings, 2)?;
        model.solve(&(self.way)(self.path[0]))?;
        model.solve(&(self.way)(from))?;
        self.trace_from(&model, from)
    }

    /// The branch through the present shape of a model at `from`, traced away from the nearer end of the path.
    pub(super) fn trace_from(&self, model: &Equilibrium, from: f64) -> Result<Diagram, Error> {
        let [first, end] = self.path;
        let forth = (from - first).abs() < (from - end).abs();
        let walk = Walk {
            from,
            upwards: forth == (end > first),
            range: [first.min(end), first.max(end)],
            longest_step: LONGEST_STEP,
            points: self.points,
        };
        model.trace(|value| Ok((self.way)(value)), &walk)
    }

    fn branch(&self) -> Result<Branch<impl Fn(f64) -> Result<Inputs, Error> + Clone + '_>, Error> {
        let settings = Settings { time_budget: PATIENCE, ..self.settings.as_discretised() };
        let manipulator = Manipulator::new(&self.design, self.magnet.as_ref(), settings, 2)?;
        Branch::new(manipulator, |value| Ok((self.way)(value)), self.span(), self.span() / f64::from(STEPS))
    }

    /// Quasi-static loading along the path and, if `back`, in reverse as well.
    pub(super) fn load(&self, back: bool) -> Result<Loading, Error> {
        let [first, end] = self.path;
        let mut branch = self.branch()?;
        let forth = (0..=STEPS).map(|i| first + (end - first) * f64::from(i) / f64::from(STEPS));
        let mut values: Vec<f64> = forth.collect();
        if back {
            values.extend(values.clone().into_iter().rev().skip(1));
        }
        let mut shapes = Vec::with_capacity(values.len());
        for value in values {
            let outputs = branch.to(value)?;
            let lost = outputs.status == Status::NotSolved;
            shapes.push([value, if lost { f64::NAN } else { (self.angle)(&outputs.tip) }]);
        }
        let snaps = branch.folds().iter().map(|fold| fold.value).collect();
        Ok(Loading { shapes, snaps })
    }

    /// Errors of the predictions of a `snap` on the path, or on the way back, at each of these distances before it.
    ///
    /// Distances are relative to the path up to the snap, errors to the distance; they are positive if too early.
    pub(super) fn predict(
        &self,
        snap: f64,
        forth: bool,
        distances: &[f64],
    ) -> Result<Vec<Option<f64>>, Error> {
        let [first, end] = self.path;
        let mut branch = self.branch()?;
        branch.to(first)?;
        let start = if forth { first } else { end };
        branch.to(start)?;
        let mut errors = Vec::new();
        for distance in distances {
            let (mut branch, ahead) = (branch.clone(), distance * (snap - start));
            for steps in [4.0, 3.0, 2.0, 1.0] {
                branch.to(snap - steps * ahead)?;
            }
            errors.push(branch.predicted_fold().map(|predicted| (snap - predicted) / ahead));
        }
        Ok(errors)
    }
}
