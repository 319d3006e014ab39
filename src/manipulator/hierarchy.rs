//! Model hierarchy: models of one design from the cheapest to the richest, chosen by the tolerances.
//!
//! Level `auto` has several interaction models. The richest is the reference: one of its Newton steps from the shape of a
//! cheaper model estimates the error of that model. A fixed level has one model. Above the richest model stand finer
//! discretisations of it, created when first needed; each estimates the discretisation error of the one below, see
//! [`crate::equilibrium::Refinement`]. The error estimate is the sum of both parts, and the cheapest model whose estimate is small enough gives the
//! answer.
//!
//! The error is estimated again once the shape, the field or the loads have changed by a few percent, and the model is left
//! when its error is too large; a cheaper interaction model is also left when it does not solve, snaps or comes near a fold. A
//! cheaper model is tried as rarely, and its error must be clearly below the tolerance, so that models do not alternate. By
//! [`CLIMB`], [`REFINE`] and [`DESCEND`], both models of a change are within the tolerance of the reference, and so is the jump
//! between them.

use serde::{Deserialize, Serialize};

use super::error_estimate::{CLIMB, ErrorEstimate, ModelError};
use super::models::Models;
use super::tolerance::TipTolerance;
use super::wait::Wait;
use crate::design::Design;
use crate::equilibrium::{self, Deadline, Equilibrium, Inputs, Report, Settings, Solution, TipDeviation};
use crate::error::Error;
use crate::magnetics::Sources;
use crate::vessel::Vessel;

/// Fraction of the tolerance above which a discretisation of the richest model is left; its estimate includes a safety factor.
const REFINE: f64 = 1.0;

/// Fraction of the tolerance within which a cheaper model is accepted.
const DESCEND: f64 = 0.25;

/// Residual tolerance of a cheaper model relative to the tip tolerances (lengths relative to the manipulator's), and its
/// largest ratio to the residual tolerance of the settings.
const RESIDUAL: f64 = 1e-2;
const RELAXED: f64 = 1e4;

/// The models of one design, the one in use and its error estimate.
#[derive(Debug, Clone)]
pub(super) struct Hierarchy {
    models: Models,
    present: usize,
    estimate: Option<ErrorEstimate>,
    /// Change since the last estimate, see [`ErrorEstimate::age`].
    age: f64,
    wait: Wait,
    length: f64,
    fold_margin: f64,
    time_budget: f64,
    tolerance: TipTolerance,
    /// Residual tolerance of the richest model.
    residual: f64,
}

/// Serializable state of a hierarchy.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub(super) struct HierarchySnapshot {
    present: usize,
    wait: Wait,
    equilibrium: equilibrium::BranchSnapshot,
    estimate: Option<ErrorEstimate>,
    age: f64,
}

impl Hierarchy {
    /// # Errors
    /// As [`Equilibrium::new`].
    pub(super) fn new(
        design: &Design,
        sources: Sources,
        settings: Settings,
        shape_points: usize,
    ) -> Result<Self, Error> {
        Ok(Self {
            models: Models::new(design, sources, &settings, shape_points)?,
            present: 0,
            estimate: None,
            age: 0.0,
            wait: Wait::NONE,
            length: design.length(),
            fold_margin: settings.fold_margin,
            time_budget: settings.time_budget,
            tolerance: TipTolerance::of(&settings),
            residual: settings.tolerance,
        })
    }

    /// All models in a vessel.
    pub(super) fn in_vessel(self, vessel: &Vessel) -> Self {
        Self { models: self.models.in_vessel(vessel), ..self }
    }

    /// Relaxes the residual tolerances of the cheaper models to a small part of the tip tolerances, at the last error estimate.
    fn relax(&mut self) {
        let travel = self.estimate.as_ref().map(|estimate| estimate.tip_travel(self.present()));
        let TipDeviation { distance, angle } = self.tolerance.after(travel.unwrap_or(f64::INFINITY));
        let residual = RESIDUAL * (distance / self.length).min(angle);
        let residual = residual.clamp(self.residual, RELAXED * self.residual);
        self.models.cheaper().iter_mut().for_each(|model| model.set_tolerance(residual));
    }

    /// The model in use.
    pub(super) fn present(&self) -> &Equilibrium {
        self.models.at(self.present)
    }

    /// Puts another model in the place of the one in use.
    #[cfg(feature = "fit")]
    pub(super) fn replace_present(&mut self, model: Equilibrium) {
        *self.models.at_mut(self.present) = model;
    }

    /// Stability margin below which a shape is reported as close to a fold.
    pub(super) fn fold_margin(&self) -> f64 {
        self.fold_margin
    }

    /// Estimated distance of the tip (m) from the converged model; at most the length, which is returned where no estimate is
    /// available.
    pub(super) fn error_estimate(&self) -> f64 {
        let error = |estimate: &ErrorEstimate| estimate.error(self.age, self.present()).distance;
        self.estimate.as_ref().map_or(0.0, |estimate| error(estimate).min(self.length))
    }

    /// Sets the tolerances; the next solve estimates the error anew.
    pub(super) fn set_tolerance(&mut self, tolerance: TipTolerance) {
        if self.tolerance != tolerance {
            (self.tolerance, self.estimate) = (tolerance, None);
        }
    }

    /// Whether the estimated error is larger than what is allowed.
    pub(super) fn is_beyond_tolerance(&self) -> bool {
        let (Some(estimate), Some(inputs)) = (&self.estimate, self.present().inputs()) else { return false };
        self.allowed(inputs).room(&estimate.error(self.age, self.present()), 1.0) < 1.0
    }

    /// The tolerance of the tip of the present model.
    fn allowed(&self, inputs: &Inputs) -> TipDeviation {
        let model = self.present();
        self.tolerance.after(model.tip_travel(inputs, &model.tip()))
    }

    /// Sets the coefficient of friction between the device and the wall of its vessel, as [`Equilibrium::set_friction`].
    ///
    /// # Errors
    /// As [`Equilibrium::set_friction`].
    pub(super) fn set_friction(&mut self, coefficient: f64) -> Result<(), Error> {
        self.models.all().try_for_each(|model| model.set_friction(coefficient))
    }

    /// Resets the shape.
    pub(super) fn reset(&mut self) {
        (self.present, self.estimate, self.age, self.wait) = (0, None, 0.0, Wait::NONE);
        self.models.reset();
    }

    /// Follows the branch to `inputs` on the cheapest model with a sufficiently small error.
    ///
    /// # Errors
    /// As [`Equilibrium::solve`].
    pub(super) fn solve(&mut self, inputs: &Inputs) -> Result<Report, Error> {
        self.solve_before(&self.deadline(), inputs)
    }

    /// Processor time that a solve may take, s.
    pub(super) fn time_budget(&self) -> f64 {
        self.time_budget
    }

    pub(super) fn set_time_budget(&mut self, seconds: f64) {
        self.time_budget = seconds;
    }

    /// The end of the time budget of a solve that begins now.
    pub(super) fn deadline(&self) -> Deadline {
        Deadline::new(self.time_budget)
    }

    /// As [`Self::solve`]: all models, and all solves that belong together, share one time budget.
    ///
    /// # Errors
    /// As [`Equilibrium::solve`].
    pub(super) fn solve_before(&mut self, deadline: &Deadline, inputs: &Inputs) -> Result<Report, Error> {
        let (from, richest) = (self.present, self.models.richest());
        self.relax();
        let Some(before) = self.present().inputs() else {
            return self.ascend(0, inputs, deadline, |models, level, from| {
                if let Some(from) = from
                    && models.is_refinement(level, from)
                {
                    models.warm_start(level, from, inputs);
                    let report = models.at_mut(level).solve_before(deadline, inputs)?;
                    if report.solved() && report.snaps == 0 {
                        return Ok(report);
                    }
                }
                let model = models.at_mut(level);
                model.reset();
                model.solve_before(deadline, inputs)
            });
        };
        // If a cheaper model fails, a richer one starts from the shape before this solve; for the richest it is not needed.
        let way_back = (from < richest).then(|| {
            let present = self.present();
            (before.clone(), present.unknowns().to_vec(), present.friction_memory())
        });
        let report = self.models.at_mut(from).solve_before(deadline, inputs)?;
        let changed = report.solved() && self.has_changed(inputs);
        let due = report.solved() && from > 0 && self.wait.is_over(self.age);
        if let Some((before, shape, friction)) = way_back
            && !(self.is_sound(&report) && (!changed || self.is_accurate(inputs, deadline)?))
        {
            let next = if report.solved() { from + 1 } else { richest };
            return self.ascend(next, inputs, deadline, |models, level, _| {
                models.adopt(level, from, &shape, &before);
                let model = models.at_mut(level);
                model.recall_friction(&friction);
                let there = model.solve_before(deadline, &before)?;
                let report = model.solve_before(deadline, inputs)?;
                // What another model corrects of a shape is no snap of the device.
                Ok(Report { iterations: there.iterations + report.iterations, ..report })
            });
        }
        if changed && from >= richest && !self.is_accurate(inputs, deadline)? {
            return self.refine(inputs, report, deadline);
        }
        if due { self.descend(inputs, report, deadline) } else { Ok(report) }
    }

    /// Ascends from model `first` until the error is small enough.
    ///
    /// `solve` gets the index of the model to solve and that of the previous one if its solution is sound.
    ///
    /// Where a cheaper model finds no solution, the richest is solved next.
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

            // Nothing is left to try: what the richest model could not solve is the result.
            if at_richest && !report.solved() {
                self.estimate = None;
                return Ok(report);
            }

            sound = self.is_sound(&report).then_some(self.present);
            if (at_richest || sound.is_some()) && self.is_accurate(inputs, deadline)? {
                return Ok(report);
            }

            if at_richest {
                return self.refine(inputs, report, deadline);
            }

            self.present = if report.solved() { self.present + 1 } else { richest };
        }
    }

    /// Refines the discretisation from the solution `report` until the error is small enough or the finest is reached.
    ///
    /// Where a finer discretisation leaves the branch, the coarser solution is kept with its error estimate.
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
            if self.is_accurate(inputs, deadline)? {
                break;
            }
        }
        Ok(report)
    }

    /// Tries the next cheaper model; if it is rejected, `report` remains the answer.
    fn descend(&mut self, inputs: &Inputs, report: Report, deadline: &Deadline) -> Result<Report, Error> {
        let from = self.present;
        // One step of the cheaper model tells of most that are rejected, before any is solved.
        let deviation = self.models.deviation(from - 1, from);
        if deviation.is_none_or(|deviation| self.allowed(inputs).room(&deviation, DESCEND) < 1.0) {
            self.wait = self.wait.longer();
            return Ok(report);
        }
        // The richer models lose their branch when they estimate errors, so this one is saved.
        let kept = (from >= self.models.richest()).then(|| self.present().clone());
        let before = (self.estimate.clone(), self.age);
        let other = self.models.at_mut(from - 1).solve_before(deadline, inputs)?;
        self.present = from - 1;
        if self.is_sound(&other) && self.is_within(inputs, DESCEND, deadline)? {
            self.wait = Wait::NONE;
            let iterations = report.iterations + other.iterations;
            return Ok(Report { iterations, snaps: report.snaps, ..other });
        }
        (self.present, self.wait) = (from, self.wait.longer());
        (self.estimate, self.age) = before;
        if let Some(kept) = kept {
            *self.models.at_mut(from) = kept;
        }
        Ok(report)
    }

    /// Whether the solution of a cheaper model is acceptable: solved, stable, without a snap and away from folds.
    fn is_sound(&self, report: &Report) -> bool {
        let held = report.stable.is_none_or(|stable| stable && report.margin >= self.fold_margin);
        report.solved() && held && report.snaps == 0
    }

    /// Whether the error of the present model is small enough to keep it.
    fn is_accurate(&mut self, inputs: &Inputs, deadline: &Deadline) -> Result<bool, Error> {
        let part = if self.present < self.models.richest() { CLIMB } else { REFINE };
        self.is_within(inputs, part, deadline)
    }

    /// Estimates the error of the present model; whether it is within the fraction `part` of the tolerance.
    ///
    /// Where no estimate is available, a cheaper model is rejected, but a discretisation of the richest is kept, as a finer one
    /// would not help. No estimate is made for a solution of the richest model that used up the time budget.
    fn is_within(&mut self, inputs: &Inputs, part: f64, deadline: &Deadline) -> Result<bool, Error> {
        let late = self.present >= self.models.richest() && deadline.has_passed();
        let tolerance = self.allowed(inputs);
        let within = |error: &TipDeviation| tolerance.room(error, part) >= 1.0;
        let error = if late { None } else { self.models.error(self.present, within)? };
        let unknown = TipDeviation { distance: self.length, angle: core::f64::consts::PI };
        self.record(inputs, error.unwrap_or(ModelError::of_model(unknown)));
        Ok(error.map_or(self.present >= self.models.richest(), |error| within(&error.total())))
    }

    fn record(&mut self, inputs: &Inputs, error: ModelError) {
        let model = self.models.at(self.present);
        (self.age, self.wait.counted) = (0.0, 0.0);
        if let Some(estimate) = &mut self.estimate {
            estimate.renew(model, inputs, error);
        } else {
            let stops = self.models.at(self.models.richest()).settings().has_bending_stop();
            self.estimate = Some(ErrorEstimate::new(model, inputs, error, stops));
        }
    }

    /// Whether enough has changed since the last error estimate to make a new one.
    fn has_changed(&mut self, inputs: &Inputs) -> bool {
        let Some(estimate) = &self.estimate else { return true };
        let model = self.models.at(self.present);
        self.age = estimate.age(model, inputs, self.length);
        // Where the richest model tells the error, an estimate costs a Hessian, and the quadratures are a small part of it.
        let by_itself = self.models.is_refinement(self.models.richest(), self.present);
        estimate.is_old(self.age, &self.allowed(inputs))
            || (by_itself && estimate.is_of_other_rules(self.age, model))
    }

    /// The state.
    pub(super) fn snapshot(&self) -> HierarchySnapshot {
        let equilibrium = self.present().snapshot();
        HierarchySnapshot {
            present: self.present,
            wait: self.wait,
            equilibrium,
            estimate: self.estimate.clone(),
            age: self.age,
        }
    }

    /// Restores a state.
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
        (self.present, self.wait, self.estimate) =
            (snapshot.present, snapshot.wait, snapshot.estimate.clone());
        self.age = snapshot.age;
        Ok(())
    }
}
