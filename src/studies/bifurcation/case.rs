//! A device on a path of inputs: its branches, the way that slow loading takes, and when that sees a snap coming.

use crate::design::Design;
use crate::equilibrium::{Diagram, Equilibrium, Inputs, Settings};
use crate::error::Error;
use crate::geometry::Pose;
use crate::magnetics::Assembly;
use crate::manipulator::{Branch, Manipulator, Status};
use crate::numerics::continuation::Walk;

/// Steps of slow loading along the whole path.
const STEPS: u32 = 24;

/// Longest step along a branch, in turns of one segment by a radian.
const LONGEST_STEP: f64 = 0.2;

/// What acts at a value on the path.
pub(super) type Way = Box<dyn Fn(f64) -> Inputs + Send + Sync>;

/// A device and what it is put through.
pub(super) struct Case {
    pub(super) design: Design,
    pub(super) magnet: Option<Assembly>,
    pub(super) settings: Settings,
    pub(super) way: Way,
    /// Where the path begins and ends.
    pub(super) path: [f64; 2],
    /// What is drawn of a tip, deg.
    pub(super) angle: fn(&Pose) -> f64,
    /// Points of a branch at most.
    pub(super) points: usize,
}

/// What slow loading meets along the path and, if asked for, back.
pub(super) struct Loading {
    /// Value and angle (deg); the angle is NaN where no shape was found.
    pub(super) shapes: Vec<[f64; 2]>,
    /// Values at which it snaps, or ends.
    pub(super) snaps: Vec<f64>,
}

/// The tip's angle with the base's axis, deg.
pub(super) fn turned(tip: &Pose) -> f64 {
    tip.axis().z.clamp(-1.0, 1.0).acos().to_degrees()
}

/// The same in the plane of the field, positive towards +y.
pub(super) fn turned_in_plane(tip: &Pose) -> f64 {
    tip.axis().y.atan2(tip.axis().z).to_degrees()
}

impl Case {
    fn span(&self) -> f64 {
        (self.path[1] - self.path[0]).abs()
    }

    /// The branch through the stable shape to which loading at once leads from the path's beginning.
    pub(super) fn trace(&self, from: f64) -> Result<Diagram, Error> {
        let mut model = Equilibrium::new(&self.design, self.magnet.as_ref(), self.settings, 2)?;
        model.solve(&(self.way)(self.path[0]))?;
        model.solve(&(self.way)(from))?;
        self.trace_from(&model, from)
    }

    /// The branch through the present shape of a model: from the path's beginning forth, from its end back.
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
        let settings = self.settings.as_discretised();
        let manipulator = Manipulator::new(&self.design, self.magnet.as_ref(), settings, 2)?;
        Branch::new(manipulator, |value| Ok((self.way)(value)), self.span(), self.span() / f64::from(STEPS))
    }

    /// Slow loading along the path, and back.
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

    /// Errors of predictions of the snap at a value, on the way forth or back, at each of these distances before it.
    ///
    /// Distances are relative to the way up to there, errors to the distance: positive, if the prediction is too early.
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
            for steps in [3.0, 2.0, 1.0] {
                branch.to(snap - steps * ahead)?;
            }
            errors.push(branch.predicted_fold().map(|predicted| (snap - predicted) / ahead));
        }
        Ok(errors)
    }
}
