//! As much model as the tolerances need: a ladder of models of one design, from the cheapest to the richest.
//!
//! The richest model is the judge: one Newton step of it from the shape of a cheaper one tells how far that is off. The
//! cheapest rung that is good enough answers. It is judged again once the shape, the field or the loads have changed by
//! a few percent, and left when it is no longer good, does not solve, snaps or comes near a fold; a cheaper one is tried
//! as seldom, and must be clearly better than needed, so that rungs do not alternate. Both rungs of a change are
//! within the tolerance of the judge by [`CLIMB`] and [`DESCEND`], and so is the jump between them.

use nalgebra::Vector3;
use serde::{Deserialize, Serialize};

use crate::design::Design;
use crate::equilibrium::{self, Deadline, Equilibrium, Gap, Inputs, Interaction, Report, Settings};
use crate::error::Error;
use crate::geometry::Pose;
use crate::magnetics::Assembly;

/// Part of the tolerance beyond which a rung is left.
const CLIMB: f64 = 0.5;

/// Part of the tolerance within which a cheaper rung is taken.
const DESCEND: f64 = 0.25;

/// Change of what surrounds or loads the manipulator, relative to its size, after which a rung is judged again.
const CHANGED: f64 = 0.02;

/// Displacement of the tip, relative to the length, and turn of the tip (rad), after which a rung is judged again.
const MOVED: f64 = 0.02;

/// How many times as long a rung stands that is as much better than needed.
const STANDING: f64 = 5.0;

/// Residual of a cheaper model over the tolerances, lengths in those of the manipulator; and the most over the residual that
/// is asked for.
const RESIDUAL: f64 = 1e-2;
const RELAXED: f64 = 1e4;

/// Most judgements that pass between two trials of a cheaper rung: each failed one doubles their number.
const PATIENCE: u32 = 16;

/// Iterations that a cheaper model may take for one solve: more would not be cheap.
const CHEAP: u32 = 100;

/// Accuracy of the pairs on the coarse rungs.
const COARSE: f64 = 1e-3;

/// Models of one design, cheapest first; one alone where the level is fixed.
#[derive(Debug, Clone)]
pub(super) struct Ladder {
    rungs: Vec<Equilibrium>,
    present: usize,
    judged: Option<Judged>,
    wait: Wait,
    length: f64,
    fold_margin: f64,
    time_budget: f64,
    /// Largest error of the tip: position (m) and angle (rad).
    tolerance: Gap,
    /// The residual that is asked for of the richest model.
    residual: f64,
}

/// When a rung was judged last.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
struct Judged {
    inputs: Inputs,
    tip: Pose,
    field: Vector3<f64>,
    gap: Gap,
}

/// How many judgements are still to pass, and after the next failure, before a cheaper rung is tried.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
struct Wait {
    left: u32,
    next: u32,
}

impl Wait {
    const NONE: Self = Self { left: 0, next: 1 };

    fn is_over(&mut self) -> bool {
        let over = self.left == 0;
        self.left = self.left.saturating_sub(1);
        over
    }

    fn longer(self) -> Self {
        Self { left: self.next, next: PATIENCE.min(2 * self.next) }
    }
}

/// What a ladder remembers of its past.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub(super) struct Snapshot {
    present: usize,
    wait: Wait,
    equilibrium: equilibrium::Snapshot,
    judged: Option<Judged>,
}

impl Ladder {
    /// # Errors
    /// As [`Equilibrium::new`].
    pub(super) fn new(
        design: &Design,
        magnet: Option<&Assembly>,
        settings: Settings,
        shape_points: usize,
    ) -> Result<Self, Error> {
        let rungs = if settings.interaction == Interaction::Auto {
            models_of_auto(&settings, design.rings().next().is_some())
        } else {
            vec![settings]
        };
        let model = |settings| Equilibrium::new(design, magnet, settings, shape_points);
        let mut out = Self {
            rungs: rungs.into_iter().map(model).collect::<Result<_, _>>()?,
            present: 0,
            judged: None,
            wait: Wait::NONE,
            length: design.length(),
            fold_margin: settings.fold_margin,
            time_budget: settings.time_budget,
            tolerance: Gap { distance: settings.tolerance_position, angle: settings.tolerance_angle },
            residual: settings.tolerance,
        };
        out.relax();
        Ok(out)
    }

    /// Lets the cheaper models end as soon as their residual is small beside the tolerances.
    fn relax(&mut self) {
        let Gap { distance, angle } = self.tolerance;
        let residual = RESIDUAL * (distance / self.length).min(angle);
        let residual = residual.clamp(self.residual, RELAXED * self.residual);
        let last = self.last();
        self.rungs[..last].iter_mut().for_each(|rung| rung.set_tolerance(residual));
    }

    /// The model that answers.
    pub(super) fn present(&self) -> &Equilibrium {
        &self.rungs[self.present]
    }

    /// Estimated distance of the tip (m) from that of the richest model; 0 where that one answers or the level is fixed.
    pub(super) fn error_estimate(&self) -> f64 {
        self.judged.as_ref().filter(|_| self.present < self.last()).map_or(0.0, |judged| judged.gap.distance)
    }

    /// New tolerances; the next solve judges by them.
    pub(super) fn set_tolerance(&mut self, tolerance: Gap) {
        if self.tolerance != tolerance {
            (self.tolerance, self.judged) = (tolerance, None);
            self.relax();
        }
    }

    /// Forgets the shape.
    pub(super) fn reset(&mut self) {
        (self.present, self.judged, self.wait) = (0, None, Wait::NONE);
        self.rungs.iter_mut().for_each(Equilibrium::reset);
    }

    /// Follows the branch to `inputs` on the cheapest rung that is good enough.
    ///
    /// # Errors
    /// As [`Equilibrium::solve`].
    pub(super) fn solve(&mut self, inputs: &Inputs) -> Result<Report, Error> {
        let (from, last) = (self.present, self.last());
        if last == 0 {
            return self.rungs[0].solve(inputs);
        }
        // All models of one solve share its time.
        let deadline = Deadline::new(self.time_budget);
        let Some(before) = self.present().inputs() else {
            return self.ascend(0, inputs, |models, rung| {
                models[rung].reset();
                models[rung].solve_before(&deadline, inputs)
            });
        };
        // The richest one needs no way back.
        let way_back = (from < last).then(|| (before.clone(), self.present().unknowns().to_vec()));
        let report = self.rungs[from].solve_before(&deadline, inputs)?;
        let changed = self.changed(inputs);
        if let Some((before, shape)) = way_back
            && !(self.is_sound(&report) && (!changed || self.judge(inputs, CLIMB)))
        {
            let next = if report.solved() { from + 1 } else { last };
            return self.ascend(next, inputs, |models, rung| {
                let (lower, upper) = models.split_at_mut(rung);
                upper[0].adopt(&lower[from], &shape, &before);
                let settled = upper[0].solve_before(&deadline, &before)?;
                let report = upper[0].solve_before(&deadline, inputs)?;
                let (iterations, snaps) =
                    (settled.iterations + report.iterations, settled.snaps + report.snaps);
                Ok(Report { iterations, snaps, ..report })
            });
        }
        if !(changed && from > 0 && report.solved()) {
            return Ok(report);
        }
        if self.wait.is_over() {
            return self.descend(inputs, report, &deadline);
        }
        if from == last {
            self.note(inputs, Gap::NONE);
        }
        Ok(report)
    }

    /// From rung `first` up to one that is good enough, each solved by `solve`. Where a cheaper one finds nothing, the
    /// richest is asked.
    fn ascend(
        &mut self,
        first: usize,
        inputs: &Inputs,
        solve: impl Fn(&mut [Equilibrium], usize) -> Result<Report, Error>,
    ) -> Result<Report, Error> {
        let mut iterations = 0;
        self.present = first;
        loop {
            let report = solve(&mut self.rungs, self.present)?;
            iterations += report.iterations;
            let richest = self.present == self.last();
            if richest {
                self.note(inputs, Gap::NONE);
            }
            if richest || (self.is_sound(&report) && self.judge(inputs, CLIMB)) {
                return Ok(Report { iterations, ..report });
            }
            self.present = if report.solved() { self.present + 1 } else { self.last() };
        }
    }

    /// Tries the next cheaper rung; without success `report` stays the answer.
    fn descend(&mut self, inputs: &Inputs, report: Report, deadline: &Deadline) -> Result<Report, Error> {
        let from = self.present;
        // The richest model forgets its branch as it judges.
        let kept = (from == self.last()).then(|| self.rungs[from].clone());
        let gap = self.judged.as_ref().map_or(Gap::NONE, |judged| judged.gap);
        let (lower, upper) = self.rungs.split_at_mut(from);
        let cheaper = &mut lower[from - 1];
        cheaper.adopt(&upper[0], upper[0].unknowns(), inputs);
        let other = cheaper.solve_before(deadline, inputs)?;
        self.present = from - 1;
        if self.is_sound(&other) && self.judge(inputs, DESCEND) {
            self.wait = Wait::NONE;
            let iterations = report.iterations + other.iterations;
            return Ok(Report { iterations, snaps: report.snaps, ..other });
        }
        (self.present, self.wait) = (from, self.wait.longer());
        if let Some(kept) = kept {
            self.rungs[from] = kept;
        }
        self.note(inputs, gap);
        Ok(report)
    }

    /// Number of the richest model.
    fn last(&self) -> usize {
        self.rungs.len() - 1
    }

    /// Whether a cheaper model's answer may stand: solved, stable, without a jump and away from folds.
    fn is_sound(&self, report: &Report) -> bool {
        let held = report.stable.is_none_or(|stable| stable && report.margin >= self.fold_margin);
        report.solved() && held && report.snaps == 0
    }

    /// Whether the richest model finds the present rung within that part of the tolerance.
    fn judge(&mut self, inputs: &Inputs, part: f64) -> bool {
        let last = self.last();
        let (cheaper, judge) = self.rungs.split_at_mut(last);
        let Some(gap) = judge[0].gap(&cheaper[self.present]) else { return false };
        self.note(inputs, gap);
        self.tolerance.room(&gap, part) >= 1.0
    }

    fn note(&mut self, inputs: &Inputs, gap: Gap) {
        let tip = self.present().tip();
        let field = self.present().field_at(inputs, &tip.position).unwrap_or_default();
        self.judged = Some(Judged { inputs: inputs.clone(), tip, field, gap });
    }

    /// Whether enough has changed since the last judgement to judge again: the better the rung was, the more may.
    fn changed(&self, inputs: &Inputs) -> bool {
        let Some(judged) = &self.judged else { return true };
        let room = self.tolerance.room(&judged.gap, CLIMB).clamp(1.0, STANDING);
        let (tip, then) = (self.present().tip(), &judged.inputs);
        let field = self.present().field_at(inputs, &tip.position).unwrap_or_default();
        let far = |change: f64, a: f64, b: f64| change > room * CHANGED * a.max(b);
        let other = |a: &Vector3<f64>, b: &Vector3<f64>| far((a - b).norm(), a.norm(), b.norm());
        let moved = Gap::between(&tip, &judged.tip);
        let [gradient, before] = [inputs, then].map(|i| nalgebra::SVector::from(i.field_gradient));
        moved.distance > room * MOVED * self.length
            || moved.angle > room * MOVED
            || other(&field, &judged.field)
            || far((gradient - before).norm(), gradient.norm(), before.norm())
            || other(&inputs.tip_force, &then.tip_force)
            || other(&inputs.tip_moment, &then.tip_moment)
            || other(&inputs.gravity, &then.gravity)
            || inputs.ring_forces.iter().zip(&then.ring_forces).any(|(a, b)| other(a, b))
    }

    /// What it remembers.
    pub(super) fn snapshot(&self) -> Snapshot {
        let equilibrium = self.present().snapshot();
        Snapshot { present: self.present, wait: self.wait, equilibrium, judged: self.judged.clone() }
    }

    /// Goes on from there.
    ///
    /// # Errors
    /// As [`Equilibrium::restore`].
    pub(super) fn restore(&mut self, snapshot: &Snapshot) -> Result<(), Error> {
        self.reset();
        let Some(rung) = self.rungs.get_mut(snapshot.present) else {
            return Err(Error::Unsupported("the snapshot is not of this model".into()));
        };
        rung.restore(&snapshot.equilibrium)?;
        (self.present, self.wait, self.judged) = (snapshot.present, snapshot.wait, snapshot.judged.clone());
        Ok(())
    }
}

/// Settings of the models that the level `auto` chooses from, cheapest first, for a design with free rings or without.
#[must_use]
pub fn models_of_auto(settings: &Settings, has_rings: bool) -> Vec<Settings> {
    let coarse = settings.pair_accuracy.max(COARSE);
    let iterations = settings.iterations.min(CHEAP);
    let cheap = |interaction| Settings { interaction, bending_stop: false, iterations, ..*settings };
    let richest = Settings { interaction: Interaction::Full, bending_stop: true, ..*settings };
    let mut out = vec![Settings { degree: 0, pair_accuracy: coarse, ..cheap(Interaction::None) }];
    if has_rings {
        out.push(Settings { degree: 0, pair_accuracy: coarse, ..cheap(Interaction::Rings) });
        out.push(cheap(Interaction::Rings));
        out.push(Settings { degree: 0, pair_accuracy: coarse, iterations, ..richest });
    }
    out.push(richest);
    out
}
