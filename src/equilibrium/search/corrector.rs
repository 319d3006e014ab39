//! Corrector: Newton's method for one shape.

use super::evaluator::{Aim, Balance, Evaluator, NEARLY, ROUNDING};
use super::outcome::Outcome;
use super::scratch::{Buffers, CORRECTIONS};
use crate::equilibrium::model::Inputs;
use crate::numerics::eigenvalue::inner;
use crate::numerics::trust_region::{Objective, dual_norm, norm};

/// Largest ratio of the lengths of two successive Newton steps that is trusted to stay on the branch.
const CONTRACTION: f64 = 0.5;

/// Largest ratio of that kind for steps with an earlier factorisation, which only pay off if they contract faster.
const CHORD_CONTRACTION: f64 = 0.1;

/// Length of a Newton step (radian norm) from which on steps with the same factorisation are tried next: they cost a tenth.
const SOON: f64 = 0.05;

/// Shift of the Hessian, relative to the elastic one, where the chain is pressed into a wall so hard that it is not definite.
const LIFTING: f64 = 0.3;

/// Largest residual (radian norm) that counts as rounding where there is a wall.
const PRESSED: f64 = 1e-7;

/// Maximum number of changes of the quadrature rules at a solved shape: at the distance where two rules meet, they could
/// alternate for ever.
const RULE_CHOICES: u32 = 3;

/// How the stability of a corrected shape is known.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Verdict {
    /// It is so close to the last factorisation that its stability is that of the shape assessed then.
    Kept,
    /// It has been factorised on the way and is to be assessed.
    Fresh,
}

/// A shape that was found, with how its stability is known, or why there is none.
pub(super) type Finding = Result<Verdict, Outcome>;

/// Corrects shapes by Newton's method with the factorisation in the workspace or, where that is no longer valid, a new one.
pub(super) struct Corrector<'a> {
    pub(super) evaluator: Evaluator<'a>,
    pub(super) buffers: &'a mut Buffers,
    /// Largest drift of loads and shape from the last factorisation for which that counts as valid.
    pub(super) drift: f64,
}

/// Newton's method on the way to one shape.
struct Newton {
    aim: Aim,
    /// Length of the first step, at most.
    reach: f64,
    /// Length of the last step.
    previous: f64,
    /// How often the quadrature rules may still change.
    choices: u32,
}

impl Newton {
    /// Begins again, with other quadrature rules or from another place.
    fn begin_again(&mut self) {
        self.previous = self.reach / CONTRACTION;
    }
}

/// What a step of Newton's method has come to.
enum Progress {
    GoesOn,
    Settled,
    Lost,
}

impl Corrector<'_> {
    /// Newton's method without safeguards, abandoned as soon as it does not converge as it does near a root.
    ///
    /// Steps with the last factorisation come first, and suffice while that remains valid; otherwise the Hessian is
    /// recomputed once on the way. `None` where no equilibrium, or an unstable one, is found.
    pub(super) fn correct(
        &mut self,
        inputs: &Inputs,
        unknowns: &mut [f64],
        reach: f64,
        aim: Aim,
    ) -> Option<Verdict> {
        self.evaluator.choose_rules(inputs, unknowns);
        if self.correct_by_chords(inputs, unknowns, reach, aim) {
            return Some(Verdict::Kept);
        }
        self.correct_by_newton(inputs, unknowns, reach, aim).then_some(Verdict::Fresh)
    }

    /// Corrects with the last factorisation alone.
    fn correct_by_chords(&mut self, inputs: &Inputs, unknowns: &mut [f64], reach: f64, aim: Aim) -> bool {
        let mut longest = reach.min(self.evaluator.model.settings.follow_step);
        for left in (0..=RULE_CHOICES).rev() {
            let there_is_one = self.evaluator.work.factorisation.is_some();
            if !there_is_one || !self.chord(inputs, unknowns, [longest, NEARLY], aim) {
                return false;
            }
            if aim == Aim::Pass || left == 0 || !self.evaluator.choose_rules_here() {
                return true;
            }
            longest = self.evaluator.nearly();
        }
        false
    }

    /// Corrects with new factorisations; returns whether a stable shape was found.
    fn correct_by_newton(&mut self, inputs: &Inputs, unknowns: &mut [f64], reach: f64, aim: Aim) -> bool {
        let mut newton = Newton { aim, reach, previous: reach / CONTRACTION, choices: RULE_CHOICES };
        for _ in 0..CORRECTIONS {
            let mut settled = match self.newton_step(inputs, unknowns, &mut newton) {
                Progress::Lost => return false,
                Progress::GoesOn => false,
                Progress::Settled => true,
            };
            while settled {
                // The rules must be those of the solved shape, otherwise the solution would depend on the path to it.
                if aim == Aim::Pass || newton.choices == 0 || !self.evaluator.choose_rules_here() {
                    // For non-conservative forces a root may be an unstable shape.
                    return self.evaluator.potential(inputs).is_stable();
                }
                newton.choices -= 1;
                newton.begin_again();
                settled = self.chord(inputs, unknowns, [self.evaluator.nearly(), 0.0], aim);
            }
        }
        false
    }

    /// One step with a new factorisation and, where that is short, more with the same one.
    fn newton_step(&mut self, inputs: &Inputs, unknowns: &mut [f64], newton: &mut Newton) -> Progress {
        let unit = self.evaluator.unit();
        let mut potential = self.evaluator.potential(inputs);
        let Some(energy) = potential.linearise(unknowns) else { return Progress::Lost };
        let residual = dual_norm(potential.metric(), potential.gradient()) / unit;
        if !potential.factorise(0.0) {
            return self.lift_off(inputs, unknowns, newton);
        }
        self.evaluator.balance = Balance { residual, energy };
        if residual <= self.evaluator.tolerance(newton.aim) {
            return Progress::Settled;
        }

        let length = self.step(inputs, 0);
        self.evaluator.iterations += 1;
        // Contacts that open or close make Newton's method hesitate before it converges.
        let settles = self.evaluator.contact.is_some() && length <= SOON.min(newton.previous);
        if length > CONTRACTION * newton.previous && !settles || length.is_nan() {
            let rounded = length < ROUNDING && self.is_rounding(residual);
            return if rounded { Progress::Settled } else { Progress::Lost };
        }
        apply(unknowns, &self.buffers.steps[0]);

        let longest = CHORD_CONTRACTION * length;
        let settled = length <= SOON && self.chord(inputs, unknowns, [longest, 0.0], newton.aim);
        if settled && length > NEARLY && newton.aim == Aim::Rest {
            // The stability is that of the shape itself, with its rules.
            newton.choices -= u32::from(newton.choices > 0 && self.evaluator.choose_rules_here());
            newton.begin_again();
            return Progress::GoesOn;
        }
        newton.previous = length;
        if settled { Progress::Settled } else { Progress::GoesOn }
    }

    /// Where the chain, pressed deep into a wall, would buckle, a shift of the Hessian leads it back.
    fn lift_off(&mut self, inputs: &Inputs, unknowns: &mut [f64], newton: &mut Newton) -> Progress {
        let pressed = self.evaluator.contact.is_some() && self.evaluator.potential(inputs).factorise(LIFTING);
        let length = if pressed { self.step(inputs, 0) } else { f64::NAN };
        if length.is_nan() || length > newton.reach {
            return Progress::Lost;
        }
        apply(unknowns, &self.buffers.steps[0]);
        self.evaluator.iterations += 1;
        newton.begin_again();
        Progress::GoesOn
    }

    /// Whether rounding may be what is left of a residual: against a stiff wall the shortest step changes forces.
    fn is_rounding(&self, residual: f64) -> bool {
        self.evaluator.contact.is_none() || residual <= PRESSED
    }

    /// Computes the step from the last gradient with the last factorisation, corrected by the last `done` steps of this
    /// kind; returns its length in the radian norm.
    ///
    /// Broyden's method in its matrix-free form, in the metric of the elastic energy (C. T. Kelley, Iterative Methods for
    /// Linear and Nonlinear Equations, SIAM 1995, section 7.3, doi:10.1137/1.9781611970944).
    pub(super) fn step(&mut self, inputs: &Inputs, done: usize) -> f64 {
        let metric = self.evaluator.model.metric;
        let (earlier, rest) = self.buffers.steps.split_at_mut(done);
        let step = &mut rest[0];
        let mut potential = self.evaluator.potential(inputs);
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
        norm(metric, step) / self.evaluator.unit()
    }

    /// Takes steps with the last factorisation as long as they contract well: cheap, for small changes.
    ///
    /// The first step may be as long as `longest`. Where the factorisation is no longer valid, the steps end when the
    /// expected remainder is within `until`. Returns whether the shape is solved and evaluated.
    fn chord(
        &mut self,
        inputs: &Inputs,
        unknowns: &mut [f64],
        [mut longest, until]: [f64; 2],
        aim: Aim,
    ) -> bool {
        let (unit, tolerance) = (self.evaluator.unit(), self.evaluator.tolerance(aim));
        for done in 0..CORRECTIONS {
            let mut potential = self.evaluator.potential(inputs);
            let Some(energy) = potential.slope(unknowns) else { return false };
            let residual = dual_norm(potential.metric(), potential.gradient()) / unit;
            self.evaluator.balance = Balance { residual, energy };
            let holds = until == 0.0 || self.holds(unknowns);
            if residual <= tolerance {
                return holds;
            }

            let length = self.step(inputs, done);
            if length.is_nan() || length > longest {
                return holds && length < ROUNDING && self.is_rounding(residual);
            }
            apply(unknowns, &self.buffers.steps[done]);
            self.evaluator.iterations += 1;
            longest = CHORD_CONTRACTION * length;
            if !holds && longest <= until {
                return false;
            }
        }
        false
    }

    /// Whether the stability result of the last factorisation is valid for the present loads and `unknowns`.
    fn holds(&self, unknowns: &[f64]) -> bool {
        let Evaluator { work, model, .. } = &self.evaluator;
        let last = work.factorisation.as_ref();
        last.is_some_and(|last| last.holds_at(model.chain, unknowns, work.loads(), self.drift))
    }
}

/// Adds a step to the unknowns.
fn apply(unknowns: &mut [f64], step: &[f64]) {
    for (x, s) in unknowns.iter_mut().zip(step) {
        *x += s;
    }
}
