//! As much model as the tolerances need: a hierarchy of models of one design, from the cheapest to the richest.
//!
//! Level `auto` has several models of the interaction, of which the richest is the judge: one Newton step of it from the shape
//! of a cheaper one tells how far that is off. A fixed level has one. Above the richest stand finer discretisations of it, made
//! when first needed: each tells how far the one below is from converged, see [`Refinement`]. Both parts together are the error
//! that is told, and the cheapest model with an error that is small enough answers.
//!
//! It is judged again once the shape, the field or the loads have changed by a few percent, and left when it is no longer
//! good; a cheaper model of the interaction also when it does not solve, snaps or comes near a fold. A cheaper model is tried
//! as seldom, and must be clearly better than needed, so that models do not alternate. Both models of a change are
//! within the tolerance of the judge by [`CLIMB`], [`REFINE`] and [`DESCEND`], and so is the jump between them.

use serde::{Deserialize, Serialize};

use super::error_estimate::{CLIMB, ErrorEstimate};
use super::models::Models;
use crate::design::Design;
use crate::equilibrium::{self, Deadline, Equilibrium, Inputs, Report, Settings, TipDeviation};
use crate::error::Error;
use crate::magnetics::Assembly;

/// The same for a discretisation of the richest, whose error is told with a margin.
const REFINE: f64 = 1.0;

/// Part of the tolerance within which a cheaper model is taken.
const DESCEND: f64 = 0.25;

/// Residual of a cheaper model over the tolerances, lengths in those of the manipulator; and the most over the residual that
/// is asked for.
const RESIDUAL: f64 = 1e-2;
const RELAXED: f64 = 1e4;

/// Most changes that pass between two trials of a cheaper model: each failed one doubles their number.
const PATIENCE: u32 = 16;

/// The models of one design, the one that answers, and how far that is off.
#[derive(Debug, Clone)]
pub(super) struct Hierarchy {
    models: Models,
    present: usize,
    judged: Option<ErrorEstimate>,
    /// How much has changed since.
    age: f64,
    wait: Wait,
    length: f64,
    fold_margin: f64,
    time_budget: f64,
    /// Largest error of the tip: position (m) and angle (rad).
    tolerance: TipDeviation,
    /// The residual that is asked for of the richest model.
    residual: f64,
}

/// How many changes are still to pass, and after the next failure, before a cheaper model is tried.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
struct Wait {
    left: u32,
    next: u32,
    /// Age at which the last change was counted.
    counted: f64,
}

impl Wait {
    const NONE: Self = Self { left: 0, next: 1, counted: 0.0 };

    /// Whether a cheaper model is to be tried at that age, which counts as a change where it is one older than at the last.
    fn is_over(&mut self, age: f64) -> bool {
        if age - self.counted <= 1.0 {
            return false;
        }
        let over = self.left == 0;
        (self.left, self.counted) = (self.left.saturating_sub(1), age);
        over
    }

    fn longer(self) -> Self {
        Self { left: self.next, next: PATIENCE.min(2 * self.next), ..self }
    }
}

/// What a hierarchy remembers of its past.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub(super) struct HierarchySnapshot {
    present: usize,
    wait: Wait,
    equilibrium: equilibrium::BranchSnapshot,
    judged: Option<ErrorEstimate>,
    age: f64,
}

impl Hierarchy {
    /// # Errors
    /// As [`Equilibrium::new`].
    pub(super) fn new(
        design: &Design,
        magnet: Option<&Assembly>,
        settings: Settings,
        shape_points: usize,
    ) -> Result<Self, Error> {
        let mut out = Self {
            models: Models::new(design, magnet, &settings, shape_points)?,
            present: 0,
            judged: None,
            age: 0.0,
            wait: Wait::NONE,
            length: design.length(),
            fold_margin: settings.fold_margin,
            time_budget: settings.time_budget,
            tolerance: TipDeviation {
                distance: settings.tolerance_position,
                angle: settings.tolerance_angle,
            },
            residual: settings.tolerance,
        };
        out.relax();
        Ok(out)
    }

    /// Lets the cheaper models end as soon as their residual is small beside the tolerances.
    fn relax(&mut self) {
        let TipDeviation { distance, angle } = self.tolerance;
        let residual = RESIDUAL * (distance / self.length).min(angle);
        let residual = residual.clamp(self.residual, RELAXED * self.residual);
        self.models.cheaper().iter_mut().for_each(|model| model.set_tolerance(residual));
    }

    /// The model that answers.
    pub(super) fn present(&self) -> &Equilibrium {
        self.models.at(self.present)
    }

    /// Stability margin below which a shape counts as close to a fold.
    pub(super) fn fold_margin(&self) -> f64 {
        self.fold_margin
    }

    /// Estimated distance of the tip (m) from the converged answer of the model; at most the length, which is told where
    /// nothing is known.
    pub(super) fn error_estimate(&self) -> f64 {
        self.judged.as_ref().map_or(0.0, |judged| judged.error(self.age).distance.min(self.length))
    }

    /// New tolerances; the next solve judges by them.
    pub(super) fn set_tolerance(&mut self, tolerance: TipDeviation) {
        if self.tolerance != tolerance {
            (self.tolerance, self.judged) = (tolerance, None);
            self.relax();
        }
    }

    /// Forgets the shape.
    pub(super) fn reset(&mut self) {
        (self.present, self.judged, self.age, self.wait) = (0, None, 0.0, Wait::NONE);
        self.models.reset();
    }

    /// Follows the branch to `inputs` on the cheapest model that is good enough.
    ///
    /// # Errors
    /// As [`Equilibrium::solve`].
    pub(super) fn solve(&mut self, inputs: &Inputs) -> Result<Report, Error> {
        let (from, richest) = (self.present, self.models.richest());
        // All models of one solve share its time.
        let deadline = Deadline::new(self.time_budget);
        let Some(before) = self.present().inputs() else {
            return self.ascend(0, inputs, &deadline, |models, level, from| {
                if let Some(from) = from
                    && models.is_refinement(level, from)
                {
                    models.warm_start(level, from, inputs);
                    let report = models.at_mut(level).solve_before(&deadline, inputs)?;
                    if report.solved() && report.snaps == 0 {
                        return Ok(report);
                    }
                }
                let model = models.at_mut(level);
                model.reset();
                model.solve_before(&deadline, inputs)
            });
        };
        // The richest one needs no way back.
        let way_back = (from < richest).then(|| (before.clone(), self.present().unknowns().to_vec()));
        let report = self.models.at_mut(from).solve_before(&deadline, inputs)?;
        let changed = report.solved() && self.has_changed(inputs);
        let due = report.solved() && from > 0 && self.wait.is_over(self.age);
        if let Some((before, shape)) = way_back
            && !(self.is_sound(&report) && (!changed || self.holds(inputs, &deadline)?))
        {
            let next = if report.solved() { from + 1 } else { richest };
            return self.ascend(next, inputs, &deadline, |models, level, _| {
                models.adopt(level, from, &shape, &before);
                let model = models.at_mut(level);
                let settled = model.solve_before(&deadline, &before)?;
                let report = model.solve_before(&deadline, inputs)?;
                let (iterations, snaps) =
                    (settled.iterations + report.iterations, settled.snaps + report.snaps);
                Ok(Report { iterations, snaps, ..report })
            });
        }
        if changed && from >= richest && !self.holds(inputs, &deadline)? {
            return self.refine(inputs, report, &deadline);
        }
        if due { self.descend(inputs, report, &deadline) } else { Ok(report) }
    }

    /// From model `first` up to one that is good enough, each solved by `solve`, which is told the one before where that has a sound
    /// answer. Where a cheaper one finds nothing, the richest is asked.
    fn ascend(
        &mut self,
        first: usize,
        inputs: &Inputs,
        deadline: &Deadline,
        solve: impl Fn(&mut Models, usize, Option<usize>) -> Result<Report, Error>,
    ) -> Result<Report, Error> {
        let richest = self.models.richest();
        let (mut iterations, mut sound) = (0, None);
        self.present = first;
        loop {
            let report = solve(&mut self.models, self.present, sound)?;
            iterations += report.iterations;
            let (at_richest, report) = (self.present == richest, Report { iterations, ..report });
            if at_richest && !report.solved() {
                self.judged = None;
                return Ok(report);
            }
            sound = self.is_sound(&report).then_some(self.present);
            if (at_richest || sound.is_some()) && self.holds(inputs, deadline)? {
                return Ok(report);
            }
            if at_richest {
                return self.refine(inputs, report, deadline);
            }
            self.present = if report.solved() { self.present + 1 } else { richest };
        }
    }

    /// From the answer `report` of the richest model on to discretisations of it that are fine enough, or to the finest.
    /// Where a finer one does not stay on the branch, the coarser answer stands, with its error.
    fn refine(&mut self, inputs: &Inputs, report: Report, deadline: &Deadline) -> Result<Report, Error> {
        let mut report = report;
        while self.present < self.models.last() && !deadline.has_passed() {
            self.models.warm_start(self.present + 1, self.present, inputs);
            let next = self.models.at_mut(self.present + 1).solve_before(deadline, inputs)?;
            if !next.solved() || next.snaps > 0 {
                break;
            }
            let iterations = report.iterations + next.iterations;
            report = Report { iterations, snaps: report.snaps, ..next };
            self.present += 1;
            if self.holds(inputs, deadline)? {
                break;
            }
        }
        Ok(report)
    }

    /// Tries the next cheaper model; without success `report` stays the answer.
    fn descend(&mut self, inputs: &Inputs, report: Report, deadline: &Deadline) -> Result<Report, Error> {
        let from = self.present;
        // The richer models forget their shapes as they judge.
        let kept = (from >= self.models.richest()).then(|| self.present().clone());
        let judged = (self.judged.clone(), self.age);
        self.models.warm_start(from - 1, from, inputs);
        let other = self.models.at_mut(from - 1).solve_before(deadline, inputs)?;
        self.present = from - 1;
        if self.is_sound(&other) && self.judge(inputs, DESCEND, deadline)? {
            self.wait = Wait::NONE;
            let iterations = report.iterations + other.iterations;
            return Ok(Report { iterations, snaps: report.snaps, ..other });
        }
        (self.present, self.wait) = (from, self.wait.longer());
        (self.judged, self.age) = judged;
        if let Some(kept) = kept {
            *self.models.at_mut(from) = kept;
        }
        Ok(report)
    }

    /// Whether a cheaper model's answer may stand: solved, stable, without a jump and away from folds.
    fn is_sound(&self, report: &Report) -> bool {
        let held = report.stable.is_none_or(|stable| stable && report.margin >= self.fold_margin);
        report.solved() && held && report.snaps == 0
    }

    /// Whether the present model may go on.
    fn holds(&mut self, inputs: &Inputs, deadline: &Deadline) -> Result<bool, Error> {
        let part = if self.present < self.models.richest() { CLIMB } else { REFINE };
        self.judge(inputs, part, deadline)
    }

    /// Whether the present model is off by no more than that part of the tolerance. Where that cannot be told, a cheaper model
    /// is not trusted, but a finer discretisation would be no help. An answer that took all the time is not judged.
    fn judge(&mut self, inputs: &Inputs, part: f64, deadline: &Deadline) -> Result<bool, Error> {
        let late = self.present >= self.models.richest() && deadline.has_passed();
        let error = if late { None } else { self.models.error(self.present)? };
        let unknown = TipDeviation { distance: self.length, angle: core::f64::consts::PI };
        self.note(inputs, error.unwrap_or(unknown));
        let good = |gap| self.tolerance.room(&gap, part) >= 1.0;
        Ok(error.map_or(self.present >= self.models.richest(), good))
    }

    fn note(&mut self, inputs: &Inputs, gap: TipDeviation) {
        let model = self.models.at(self.present);
        (self.age, self.wait.counted) = (0.0, 0.0);
        match &mut self.judged {
            Some(judged) => judged.renew(model, inputs, gap),
            None => self.judged = Some(ErrorEstimate::new(model, inputs, gap)),
        }
    }

    /// Whether enough has changed since the last estimate to judge again.
    fn has_changed(&mut self, inputs: &Inputs) -> bool {
        let Some(judged) = &self.judged else { return true };
        self.age = judged.age(self.models.at(self.present), inputs, self.length);
        judged.is_old(self.age, &self.tolerance)
    }

    /// What it remembers.
    pub(super) fn snapshot(&self) -> HierarchySnapshot {
        let equilibrium = self.present().snapshot();
        HierarchySnapshot {
            present: self.present,
            wait: self.wait,
            equilibrium,
            judged: self.judged.clone(),
            age: self.age,
        }
    }

    /// Goes on from there.
    ///
    /// # Errors
    /// As [`Equilibrium::restore`].
    pub(super) fn restore(&mut self, snapshot: &HierarchySnapshot) -> Result<(), Error> {
        self.reset();
        if snapshot.present > self.models.last() {
            return Err(Error::Unsupported("the snapshot is not of this model".into()));
        }
        self.models.make(snapshot.present)?;
        self.models.at_mut(snapshot.present).restore(&snapshot.equilibrium)?;
        (self.present, self.wait, self.judged) = (snapshot.present, snapshot.wait, snapshot.judged.clone());
        self.age = snapshot.age;
        Ok(())
    }
}
