//! The models of an interaction level and their error estimates.

use std::sync::Arc;

use super::error_estimate::ModelError;
use crate::design::Design;
use crate::equilibrium::{Equilibrium, Inputs, Interaction, Refinement, Settings, TipDeviation};
use crate::error::Error;
use crate::magnetics::Sources;
use crate::vessel::Vessel;

/// Largest number of iterations of a cheaper model per solve; with more it would not be cheap.
const CHEAP: u32 = 100;

/// Degree and pair accuracy of the coarse models without rings on spans.
const COARSE: (usize, f64) = (0, 1e-3);

/// Degree and pair accuracy of the coarse model with rings on spans: for the default tolerances.
const COARSE_FULL: (usize, f64) = (2, 3e-4);

/// Number of finer discretisations that may give the answer; the next finer one only estimates the error.
const FINER: usize = 2;

/// Models of one design, cheapest first.
#[derive(Debug, Clone)]
pub(super) struct Models {
    design: Arc<(Design, Arc<Sources>)>,
    shape_points: usize,
    /// Interaction models, the richest last.
    whole: Vec<Equilibrium>,
    /// Finer discretisations of the richest model, as far as they have been needed.
    finer: Vec<Refinement>,
    /// The finer discretisation of the coarse model of the richest interaction, once it has been needed.
    finer_coarse: Option<Refinement>,
    /// Judge of a soft shape, with the number of the model that it judges.
    judge: Option<(usize, Refinement)>,
}

impl Models {
    /// # Errors
    /// As [`Equilibrium::new`].
    pub(super) fn new(
        design: &Design,
        sources: Sources,
        settings: &Settings,
        shape_points: usize,
    ) -> Result<Self, Error> {
        let whole = if settings.interaction == Interaction::Auto {
            models_of_auto(settings, design.rings().next().is_some())
        } else {
            vec![*settings]
        };
        let sources = Arc::new(sources);
        let model = |settings| Equilibrium::shared(design, &sources, settings, shape_points);
        Ok(Self {
            design: Arc::new((design.clone(), Arc::clone(&sources))),
            shape_points,
            whole: whole.into_iter().map(model).collect::<Result<_, _>>()?,
            finer: Vec::new(),
            finer_coarse: None,
            judge: None,
        })
    }

    /// These models, unsolved, in a vessel.
    pub(super) fn in_vessel(self, vessel: &Vessel) -> Self {
        let whole = self.whole.into_iter().map(|model| model.in_vessel(vessel)).collect();
        Self { whole, finer: Vec::new(), finer_coarse: None, judge: None, ..self }
    }

    /// Index of the richest interaction model, in the discretisation of the settings.
    pub(super) fn richest(&self) -> usize {
        self.whole.len() - 1
    }

    /// Index of the last model that may give the answer.
    pub(super) fn last(&self) -> usize {
        self.richest() + FINER
    }

    /// The model of that index, which must exist.
    pub(super) fn at(&self, number: usize) -> &Equilibrium {
        let finer = number.checked_sub(self.whole.len());
        finer.map_or_else(|| &self.whole[number], |finer| &self.finer[finer].model)
    }

    /// The model of that index, which must exist, to change.
    pub(super) fn at_mut(&mut self, number: usize) -> &mut Equilibrium {
        match number.checked_sub(self.whole.len()) {
            Some(finer) => &mut self.finer[finer].model,
            None => &mut self.whole[number],
        }
    }

    /// Creates the models up to that index.
    ///
    /// # Errors
    /// As [`Equilibrium::new`].
    pub(super) fn make(&mut self, number: usize) -> Result<(), Error> {
        while self.whole.len() + self.finer.len() <= number {
            let last = self.whole.len() + self.finer.len() - 1;
            let next = self.refinement(last, self.at(last).settings().refined())?;
            self.finer.push(next);
        }
        Ok(())
    }

    /// The models cheaper than the richest.
    pub(super) fn cheaper(&mut self) -> &mut [Equilibrium] {
        let richest = self.richest();
        &mut self.whole[..richest]
    }

    /// Whether two models differ in discretisation alone.
    pub(super) fn is_refinement(&self, number: usize, of: usize) -> bool {
        let interaction = |number| {
            let settings = self.at(number).settings();
            (settings.interaction, settings.has_bending_stop())
        };
        interaction(number) == interaction(of)
    }

    /// All models.
    pub(super) fn all(&mut self) -> impl Iterator<Item = &mut Equilibrium> {
        let judge = self.judge.iter_mut().map(|(_, judge)| judge);
        let finer = self.finer.iter_mut().chain(&mut self.finer_coarse).chain(judge);
        self.whole.iter_mut().chain(finer.map(|finer| &mut finer.model))
    }

    /// Resets all shapes.
    pub(super) fn reset(&mut self) {
        self.all().for_each(Equilibrium::reset);
    }

    /// Transfers a shape of model `from` to model `to`, as [`Equilibrium::adopt`] does.
    pub(super) fn adopt(&mut self, to: usize, from: usize, unknowns: &[f64], inputs: &Inputs) {
        self.with_pair([to, from], |to, from| to.adopt(from, unknowns, inputs));
    }

    /// Estimated deviation of the tip of model `from`, which is solved, from that of model `to`, by one step of `to`, which is left
    /// at its end; `None` as for [`Equilibrium::deviation_of`].
    pub(super) fn deviation(&mut self, to: usize, from: usize) -> Option<TipDeviation> {
        self.with_pair([to, from], Equilibrium::deviation_of).flatten()
    }

    /// Acts on two different models; `None` where they are not.
    fn with_pair<T>(
        &mut self,
        numbers: [usize; 2],
        act: impl FnOnce(&mut Equilibrium, &Equilibrium) -> T,
    ) -> Option<T> {
        let finer = self.finer.iter_mut().map(|finer| &mut finer.model);
        let mut models: Vec<_> = self.whole.iter_mut().chain(finer).collect();
        let [first, second] = models.get_disjoint_mut(numbers).ok()?;
        Some(act(first, second))
    }

    /// Starts model `to` from the present shape of model `from`.
    pub(super) fn warm_start(&mut self, to: usize, from: usize, inputs: &Inputs) {
        let shape = self.at(from).unknowns().to_vec();
        self.adopt(to, from, &shape, inputs);
    }

    /// Estimated tip deviation of a solved model from the converged one; `None` where no estimate is available.
    ///
    /// Where the distance from the richest model alone is not allowed, that is all that is told: the error of the richest can
    /// only add to it. Estimating the error of a cheaper model discards the branch of the richest.
    ///
    /// # Errors
    /// As [`Models::make`].
    pub(super) fn error(
        &mut self,
        number: usize,
        is_allowed: impl Fn(&TipDeviation) -> bool,
    ) -> Result<Option<ModelError>, Error> {
        let richest = self.richest();
        if number < richest && self.is_refinement(richest, number) {
            return self.error_of_coarse(number);
        }

        let mut of_model = TipDeviation::NONE;
        if number < richest {
            let (cheaper, richest) = self.whole.split_at_mut(richest);
            let Some(deviation) = richest[0].deviation_of(&cheaper[number]) else { return Ok(None) };
            if !is_allowed(&deviation) {
                return Ok(Some(ModelError::of_model(deviation)));
            }
            of_model = deviation;
        }

        self.make(number.max(richest) + 1)?;
        let number = number.max(richest);

        if self.at(number).is_soft() {
            return Ok(self.error_of_soft(number)?.map(|error| error.beside(of_model)));
        }

        let (below, above) = self.finer.split_at_mut(number - richest);
        let model = below.last_mut().map_or(&mut self.whole[richest], |finer| &mut finer.model);
        Ok(above[0].error_of(model).map(|error| ModelError::of_discretisation(&error).beside(of_model)))
    }
}

impl Models {
    /// Estimated deviation of a solved model whose shape is soft: its forces err too little for one refinement to tell, but not the
    /// shape. The model two refinements finer tells.
    fn error_of_soft(&mut self, number: usize) -> Result<Option<ModelError>, Error> {
        let known = self.judge.take().filter(|(of, _)| *of == number);
        let mut judge = if let Some((_, judge)) = known {
            judge
        } else {
            self.refinement(number, self.at(number).settings().refined().refined())?
        };
        let error = judge.error_of(self.at_mut(number));
        self.judge = Some((number, judge));
        Ok(error.as_ref().map(ModelError::of_discretisation))
    }

    /// Estimated error of a model that differs from the richest in discretisation alone: all its error is that of its discretisation,
    /// which a finer one of its own tells.
    fn error_of_coarse(&mut self, number: usize) -> Result<Option<ModelError>, Error> {
        let mut judge = match self.finer_coarse.take() {
            Some(judge) => judge,
            None => self.refinement(number, self.at(number).settings().refined())?,
        };
        let error = judge.error_of(&mut self.whole[number]);
        self.finer_coarse = Some(judge);
        Ok(error.as_ref().map(ModelError::of_discretisation))
    }

    /// A refinement of a model to these settings.
    fn refinement(&self, number: usize, settings: Settings) -> Result<Refinement, Error> {
        let (design, sources) = &*self.design;
        Refinement::new(self.at(number), settings, design, sources, self.shape_points)
    }
}

/// Settings of the models that level `auto` chooses from, cheapest first, for a design with or without free rings.
#[must_use]
pub fn models_of_auto(settings: &Settings, has_rings: bool) -> Vec<Settings> {
    let coarse = |(degree, pair_accuracy): (usize, f64), model: Settings| Settings {
        degree: degree.min(settings.degree),
        pair_accuracy: settings.pair_accuracy.max(pair_accuracy),
        ..model
    };
    let iterations = settings.iterations.min(CHEAP);
    let cheap = |interaction| Settings { interaction, bending_stop: Some(false), iterations, ..*settings };
    let bending_stop = Some(settings.has_bending_stop());
    let richest = Settings { interaction: Interaction::Full, bending_stop, ..*settings };
    let mut out = vec![coarse(COARSE, cheap(Interaction::None))];
    if has_rings {
        out.push(coarse(COARSE, cheap(Interaction::Rings)));
        out.push(cheap(Interaction::Rings));
        out.push(coarse(COARSE_FULL, Settings { iterations, ..richest }));
    } else {
        out.push(cheap(Interaction::None));
    }
    out.push(richest);
    out
}
