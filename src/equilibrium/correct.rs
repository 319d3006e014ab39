//! Corrector: Newton's method for one shape, and the test whether it has stayed on its branch.

use super::inputs::Inputs;
use super::potential::Potential;
use super::search::{CORRECTIONS, Model, NEARLY, PASSING, ROUNDING, Search};
use crate::numerics::eigenvalue::inner;
use crate::numerics::trust_region::{Objective, dual_norm, norm};

/// Largest ratio of the lengths of two successive Newton steps that is trusted to stay on the branch.
const CONTRACTION: f64 = 0.5;

/// Largest ratio of that kind for steps with an earlier factorisation, which only pay off if they contract faster.
const CHORD_CONTRACTION: f64 = 0.1;

/// Length of a Newton step (radian norm) from which on steps with the same factorisation are tried next: they cost a tenth.
const SOON: f64 = 0.05;

/// Largest distance, relative to a step, by which the step back may miss its start. A branch that turns more within a
/// step is followed in shorter steps.
const MISSED: f64 = 0.5;

/// Shift of the Hessian, relative to the elastic one, where the chain is pressed into a wall so hard that it is not definite.
const LIFTING: f64 = 0.3;

/// Largest residual (radian norm) that counts as rounding where there is a wall.
const PRESSED: f64 = 1e-7;

/// Maximum number of changes of the quadrature rules at a solved shape: at the distance where two rules meet, they could
/// alternate for ever.
const RULE_CHOICES: u32 = 3;

impl Search<'_> {
    /// Newton's method without safeguards, abandoned as soon as it does not converge as it does near a root.
    ///
    /// Steps with the last factorisation come first, and suffice while that remains valid; otherwise the Hessian is
    /// recomputed once on the way.
    pub(super) fn correct(&mut self, inputs: &Inputs, unknowns: &mut [f64], reach: f64) -> bool {
        let Model { chain, settings, .. } = self.model;
        let unit = chain.radian_norm();
        self.kept = false;
        self.choose_rules(inputs, unknowns);
        let mut longest = reach.min(settings.follow_step);
        for left in (0..=RULE_CHOICES).rev() {
            if self.work.factorisation.is_none() || !self.chord(inputs, unknowns, longest, NEARLY) {
                break;
            }
            if self.passing || left == 0 || !self.choose_rules_here() {
                self.kept = true;
                return true;
            }
            longest = self.model.nearly();
        }
        let tolerance = self.tolerance();
        let first = reach / CONTRACTION;
        let (mut previous, mut choices) = (first, RULE_CHOICES);
        for _ in 0..CORRECTIONS {
            let mut potential = self.potential(inputs);
            let Some(energy) = potential.linearise(unknowns) else { return false };
            let residual = dual_norm(potential.metric(), potential.gradient()) / unit;
            if !potential.factorise(0.0) {
                // Pressed deep into a wall the chain would buckle; a shift leads it back.
                let pressed = self.model.around.is_some() && self.potential(inputs).factorise(LIFTING);
                let length = if pressed { self.step(inputs, 0) } else { f64::NAN };
                if length.is_nan() || length > reach {
                    return false;
                }
                apply(unknowns, &self.scratch.steps[0]);
                self.report.iterations += 1;
                previous = first;
                continue;
            }
            let mut settled = residual <= tolerance;
            (self.report.residual, self.report.energy) = (residual, energy);
            if !settled {
                let length = self.step(inputs, 0);
                self.report.iterations += 1;
                // Contacts that open or close make Newton's method hesitate before it converges.
                let settles = self.model.around.is_some() && length <= SOON.min(previous);
                if length <= CONTRACTION * previous || settles {
                    apply(unknowns, &self.scratch.steps[0]);
                    settled = length <= SOON && self.chord(inputs, unknowns, CHORD_CONTRACTION * length, 0.0);
                    if settled && length > NEARLY && !self.passing {
                        // The stability is that of the shape itself, with its rules.
                        choices -= u32::from(choices > 0 && self.choose_rules_here());
                        (previous, settled) = (first, false);
                    } else {
                        previous = length;
                    }
                } else if length < ROUNDING && self.is_rounding(residual) {
                    settled = true;
                } else {
                    return false;
                }
            }
            while settled {
                // The rules must be those of the solved shape, otherwise the solution would depend on the path to it.
                if self.passing || choices == 0 || !self.choose_rules_here() {
                    // For non-conservative forces a root may be an unstable shape.
                    return self.potential(inputs).is_stable();
                }
                (previous, choices) = (first, choices - 1);
                settled = self.chord(inputs, unknowns, self.model.nearly(), 0.0);
            }
        }
        false
    }

    /// Whether rounding may be what is left of a residual: against a stiff wall the shortest step changes forces.
    fn is_rounding(&self, residual: f64) -> bool {
        self.model.around.is_none() || residual <= PRESSED
    }

    /// Residual at which a shape counts as solved.
    fn tolerance(&self) -> f64 {
        let tolerance = self.model.settings.tolerance;
        if self.passing { tolerance.max(PASSING) } else { tolerance }
    }

    /// Computes the step from the last gradient with the last factorisation, corrected by the last `done` steps of this
    /// kind; returns its length in the radian norm.
    ///
    /// Broyden's method in its matrix-free form, in the metric of the elastic energy (C. T. Kelley, Iterative Methods for
    /// Linear and Nonlinear Equations, SIAM 1995, section 7.3, doi:10.1137/1.9781611970944).
    pub(super) fn step(&mut self, inputs: &Inputs, done: usize) -> f64 {
        let metric = self.model.metric;
        let mut steps = std::mem::take(&mut self.scratch.steps);
        let (earlier, rest) = steps.split_at_mut(done);
        let step = &mut rest[0];
        let mut potential = self.potential(inputs);
        for (s, g) in step.iter_mut().zip(potential.gradient()) {
            *s = -g;
        }
        potential.solve(step);
        let along = |s: &[f64], z: &[f64]| inner(metric, s, z) / inner(metric, s, s);
        for pair in earlier.windows(2) {
            let factor = along(&pair[0], step);
            step.iter_mut().zip(&pair[1]).for_each(|(z, s)| *z += factor * s);
        }
        if let Some(last) = earlier.last() {
            let stretch = 1.0 / (1.0 - along(last, step));
            for z in &mut *step {
                *z *= stretch;
            }
        }
        let length = norm(metric, step) / self.model.chain.radian_norm();
        self.scratch.steps = steps;
        length
    }

    /// Takes steps with the last factorisation as long as they contract well: cheap, for small changes.
    ///
    /// The first step may be as long as `longest`. Where the factorisation is no longer valid, the steps end when the
    /// expected remainder is within `until`. Returns whether the shape is solved and evaluated.
    fn chord(&mut self, inputs: &Inputs, unknowns: &mut [f64], mut longest: f64, until: f64) -> bool {
        let (chain, tolerance) = (self.model.chain, self.tolerance());
        for done in 0..CORRECTIONS {
            let mut potential = self.potential(inputs);
            let Some(energy) = potential.slope(unknowns) else { return false };
            let residual = dual_norm(potential.metric(), potential.gradient()) / chain.radian_norm();
            (self.report.residual, self.report.energy) = (residual, energy);
            let holds = until == 0.0 || self.holds(unknowns);
            if residual <= tolerance {
                return holds;
            }
            let length = self.step(inputs, done);
            if length.is_nan() || length > longest {
                return holds && length < ROUNDING && self.is_rounding(residual);
            }
            apply(unknowns, &self.scratch.steps[done]);
            self.report.iterations += 1;
            longest = CHORD_CONTRACTION * length;
            if !holds && longest <= until {
                return false;
            }
        }
        false
    }

    /// Whether the stability result of the last factorisation is valid for the present loads and `unknowns`.
    fn holds(&self, unknowns: &[f64]) -> bool {
        let last = self.work.factorisation.as_ref();
        last.is_some_and(|last| last.holds_at(self.model.chain, unknowns, self.work.loads(), self.reach))
    }

    /// Corrects a copy of `unknowns` and accepts it if it is an equilibrium. If `unknowns` are the equilibrium at the
    /// inputs `before`, it must also be on the same branch.
    pub(super) fn try_to_correct(
        &mut self,
        before: Option<&Inputs>,
        inputs: &Inputs,
        unknowns: &mut [f64],
    ) -> bool {
        let mut trial = std::mem::take(&mut self.scratch.trial);
        trial.copy_from_slice(unknowns);
        let reach = self.model.settings.follow_step;
        let found = self.accept(before, inputs, unknowns, &mut trial, reach);
        self.scratch.trial = trial;
        found
    }

    /// Corrects the shape to which the branch leads along its tangent: where there is contact, a step from the last shape
    /// itself would press the chain into the wall. `nearby` are inputs on the way, by a small part of the step.
    pub(super) fn try_to_correct_along(
        &mut self,
        (nearby, part): (&Inputs, f64),
        [before, inputs]: [&Inputs; 2],
        unknowns: &mut [f64],
    ) -> bool {
        let mut trial = std::mem::take(&mut self.scratch.trial);
        let led = self.lead_along((nearby, part), before, unknowns, &mut trial);
        let predicted = trial.clone();
        let reach = self.model.settings.follow_step;
        let mut found = led && self.correct(inputs, &mut trial, reach) && self.is_still_free(inputs);
        if found {
            // Found where the tangent leads; the way back would meet other contacts than the way there.
            let expected = self.apart(&trial, &predicted) <= MISSED * self.apart(&predicted, unknowns);
            found = self.kept || expected || self.goes_on([before, inputs], [unknowns, &trial]);
        }
        if found {
            unknowns.copy_from_slice(&trial);
        }
        self.scratch.trial = trial;
        found
    }

    /// Writes the shape at the end of the tangent to `trial`, by the last factorisation; `false` where there is none.
    fn lead_along(
        &mut self,
        (nearby, part): (&Inputs, f64),
        before: &Inputs,
        unknowns: &[f64],
        trial: &mut [f64],
    ) -> bool {
        let mut potential = self.potential(before);
        if potential.linearise(unknowns).is_none() || !potential.factorise(0.0) {
            return false;
        }
        trial.copy_from_slice(&self.work.gradient);
        let mut potential = self.potential(nearby);
        if potential.slope(unknowns).is_none() {
            return false;
        }
        trial.iter_mut().zip(potential.gradient()).for_each(|(x, after)| *x = (*x - after) / part);
        potential.solve(trial);
        let length = norm(self.model.metric, trial) / self.model.chain.radian_norm();
        trial.iter_mut().zip(unknowns).for_each(|(x, here)| *x += here);
        length <= self.model.settings.follow_step
    }

    /// Corrects `trial` by a first step of at most `reach`, and moves `unknowns` there if it is an equilibrium; if
    /// `unknowns` are the equilibrium at the inputs `before`, on the same branch.
    pub(super) fn accept(
        &mut self,
        before: Option<&Inputs>,
        inputs: &Inputs,
        unknowns: &mut [f64],
        trial: &mut [f64],
        reach: f64,
    ) -> bool {
        let found = self.correct(inputs, trial, reach)
            && self.is_still_free(inputs)
            && before.is_none_or(|before| self.kept || self.goes_on([before, inputs], [unknowns, trial]));
        if found {
            unknowns.copy_from_slice(trial);
        }
        found
    }

    /// Whether the branch leads from the first shape, at the first inputs, to the second one, just found at the second
    /// inputs.
    ///
    /// One Newton step at the first inputs must lead nearly back: with the Hessian of the second shape or, as loads may
    /// stiffen or soften it, with the one under the first inputs. From beyond a fold it does not: there the change of the
    /// inputs moves the shape by far less than the distance of the two.
    fn goes_on(&mut self, [before, inputs]: [&Inputs; 2], [last, now]: [&[f64]; 2]) -> bool {
        let metric = self.model.metric;
        let mut between = std::mem::take(&mut self.scratch.between);
        let apart = |between: &mut [f64]| {
            between.iter_mut().zip(now.iter().zip(last)).for_each(|(b, (n, l))| *b = n - l);
        };
        apart(&mut between);
        let distance = norm(metric, &between);
        // At such a short distance the last factorisation would have been valid for both.
        if distance <= self.reach * self.model.chain.radian_norm() {
            self.scratch.between = between;
            return true;
        }
        let (residual, energy) = (self.report.residual, self.report.energy);
        let mut leads_back = |potential: &mut Potential<'_>| {
            apart(&mut between);
            potential.add_newton_step(&mut between);
            norm(metric, &between) <= MISSED * distance
        };
        let mut potential = self.potential(before);
        let mut returned = potential.slope(now).is_some() && leads_back(&mut potential);
        if !returned {
            let kept = self.work.factorisation.take();
            let mut potential = self.potential(before);
            let regular = potential.linearise(now).is_some() && potential.factorise(0.0);
            returned = regular && leads_back(&mut potential);
            self.work.factorisation = kept;
        }
        self.scratch.between = between;
        // The workspace must hold the solved shape at its own inputs, from which results are read.
        let again = self.potential(inputs).slope(now).is_some();
        (self.report.residual, self.report.energy) = (residual, energy);
        returned && again
    }
}

/// Adds a step to the unknowns.
fn apply(unknowns: &mut [f64], step: &[f64]) {
    for (x, s) in unknowns.iter_mut().zip(step) {
        *x += s;
    }
}
