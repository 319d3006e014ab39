//! The models that a level of interaction chooses from, and how far each is off.

use std::sync::Arc;

use crate::design::Design;
use crate::equilibrium::{Equilibrium, Inputs, Interaction, Refinement, Settings, TipDeviation};
use crate::error::Error;
use crate::magnetics::Assembly;

/// Iterations that a cheaper model may take for one solve: more would not be cheap.
const CHEAP: u32 = 100;

/// Accuracy of the pairs on the coarse models.
const COARSE: f64 = 1e-3;

/// Finer discretisations that may answer; the next finer one only judges.
const FINER: usize = 2;

/// How many times as far off as its refinement says a discretisation is taken to be: what that says is of first order, and it is
/// not converged itself. The example `estimate` records how often this covers the error.
const DOUBT: f64 = 2.0;

/// Models of one design, cheapest first.
#[derive(Debug, Clone)]
pub(super) struct Models {
    design: Arc<(Design, Option<Assembly>)>,
    shape_points: usize,
    /// Models of the interaction, the richest last.
    whole: Vec<Equilibrium>,
    /// Finer discretisations of that one, as far as they have been needed.
    finer: Vec<Refinement>,
}

impl Models {
    /// # Errors
    /// As [`Equilibrium::new`].
    pub(super) fn new(
        design: &Design,
        magnet: Option<&Assembly>,
        settings: &Settings,
        shape_points: usize,
    ) -> Result<Self, Error> {
        let whole = if settings.interaction == Interaction::Auto {
            models_of_auto(settings, design.rings().next().is_some())
        } else {
            vec![*settings]
        };
        let model = |settings| Equilibrium::new(design, magnet, settings, shape_points);
        Ok(Self {
            design: Arc::new((design.clone(), magnet.cloned())),
            shape_points,
            whole: whole.into_iter().map(model).collect::<Result<_, _>>()?,
            finer: Vec::new(),
        })
    }

    /// Number of the richest model of the interaction, in the discretisation that the settings ask for.
    pub(super) fn richest(&self) -> usize {
        self.whole.len() - 1
    }

    /// Number of the last model that may answer.
    pub(super) fn last(&self) -> usize {
        self.richest() + FINER
    }

    /// A model that has been made.
    pub(super) fn at(&self, number: usize) -> &Equilibrium {
        let finer = number.checked_sub(self.whole.len());
        finer.map_or_else(|| &self.whole[number], |finer| &self.finer[finer].model)
    }

    /// The same, to be solved.
    pub(super) fn at_mut(&mut self, number: usize) -> &mut Equilibrium {
        match number.checked_sub(self.whole.len()) {
            Some(finer) => &mut self.finer[finer].model,
            None => &mut self.whole[number],
        }
    }

    /// Makes models up to that number.
    ///
    /// # Errors
    /// As [`Equilibrium::new`].
    pub(super) fn make(&mut self, number: usize) -> Result<(), Error> {
        while self.whole.len() + self.finer.len() <= number {
            let (design, magnet) = &*self.design;
            let last = self.at(self.whole.len() + self.finer.len() - 1);
            let next = Refinement::new(last, design, magnet.as_ref(), self.shape_points)?;
            self.finer.push(next);
        }
        Ok(())
    }

    /// Those cheaper than the richest.
    pub(super) fn cheaper(&mut self) -> &mut [Equilibrium] {
        let richest = self.richest();
        &mut self.whole[..richest]
    }

    /// Whether a model differs from another one by its discretisation alone.
    pub(super) fn is_refinement(&self, number: usize, of: usize) -> bool {
        let interaction = |number| {
            let settings = self.at(number).settings();
            (settings.interaction, settings.bending_stop)
        };
        interaction(number) == interaction(of)
    }

    /// Forgets all shapes.
    pub(super) fn reset(&mut self) {
        self.whole.iter_mut().for_each(Equilibrium::reset);
        self.finer.iter_mut().for_each(|finer| finer.model.reset());
    }

    /// Lets model `to` take up a shape of model `from`, as [`Equilibrium::adopt`] does.
    pub(super) fn adopt(&mut self, to: usize, from: usize, unknowns: &[f64], inputs: &Inputs) {
        let finer = self.finer.iter_mut().map(|finer| &mut finer.model);
        let mut models: Vec<_> = self.whole.iter_mut().chain(finer).collect();
        if let Ok([to, from]) = models.get_disjoint_mut([to, from]) {
            to.adopt(from, unknowns, inputs);
        }
    }

    /// Lets model `to` start from the shape at which model `from` is.
    pub(super) fn warm_start(&mut self, to: usize, from: usize, inputs: &Inputs) {
        let shape = self.at(from).unknowns().to_vec();
        self.adopt(to, from, &shape, inputs);
    }

    /// How far the tip of a model, which has been solved, is from converged; `None` where that cannot be told.
    ///
    /// The richest model forgets its branch where a cheaper one is judged.
    ///
    /// # Errors
    /// As [`Models::make`].
    pub(super) fn error(&mut self, number: usize) -> Result<Option<TipDeviation>, Error> {
        let richest = self.richest();
        self.make(number.max(richest) + 1)?;
        let mut apart = TipDeviation::NONE;
        if number < richest {
            let (cheaper, judge) = self.whole.split_at_mut(richest);
            let Some(gap) = judge[0].gap(&cheaper[number]) else { return Ok(None) };
            apart = gap;
        }
        let number = number.max(richest);
        let (below, above) = self.finer.split_at_mut(number - richest);
        let model = below.last_mut().map_or(&mut self.whole[richest], |finer| &mut finer.model);
        Ok(above[0].error_of(model).map(|error| error.times(DOUBT).plus(apart)))
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
