//! Devices that differ from a solved one in a number, and their outputs.

use super::{Inputs, Manipulator, Outputs, Status};
use crate::design::Design;
use crate::equilibrium::{Equilibrium, Linearised, Neighbourhood, Report, Settings, Solution};
use crate::error::Error;
use crate::magnetics::Sources;
use crate::vessel::Vessel;

/// Step of the differences relative to the number: their error is its square, 1e-8, relative to the number's nonlinearity.
const STEP: f64 = 1e-4;

/// Size of a number, relative to its usual one, below which the step no longer shrinks with it.
const SMALL: f64 = 0.1;

/// Step of one-sided differences, at a limit of the number's range, relative to that of two-sided ones: their error is the step
/// or what rounding leaves, 1e-12 over the step, both about 3e-6 there.
const ONE_SIDED: f64 = 0.03;

/// Factors by which the steps shrink, one after the other, where the models of a number differ in a quadrature.
const SHRUNK: [f64; 3] = [1.0, 0.1, 0.01];

/// A device in its surroundings, and its inputs: all that a model and a solve need.
#[derive(Debug, Clone)]
pub struct Variant {
    /// The device.
    pub design: Design,
    /// The magnets and coils.
    pub sources: Sources,
    /// The vessel around it; `None` for none.
    pub vessel: Option<Vessel>,
    /// Fields, loads and poses.
    pub inputs: Inputs,
}

/// A number on which a device depends, and the devices where that number is a little smaller and larger.
#[derive(Debug, Clone)]
pub(crate) struct Variation {
    number: Number,
    sides: [Variant; 2],
    /// By how much it is smaller and larger; 0 where it is at its limit.
    steps: [f64; 2],
    /// Models of both devices, and their settings.
    models: Option<([Equilibrium; 2], Settings)>,
}

/// A number with its usual size.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Number {
    pub(crate) value: f64,
    pub(crate) usual: f64,
}

impl Variation {
    /// `at` gives the device where the number has another value.
    ///
    /// # Errors
    /// Those of `at` on both sides of the number.
    pub(crate) fn new(number: Number, at: impl Fn(f64) -> Result<Variant, Error>) -> Result<Self, Error> {
        Self::shrunk(number, SHRUNK[0], at)
    }

    fn shrunk(number: Number, by: f64, at: impl Fn(f64) -> Result<Variant, Error>) -> Result<Self, Error> {
        let Number { value, usual } = number;
        let step = by * STEP * value.abs().max(SMALL * usual);
        let mut steps = [step; 2];
        let sides = match (at(value - step), at(value + step)) {
            (Ok(before), Ok(after)) => [before, after],
            (Err(_), Err(error)) => return Err(error),
            (before, _) => {
                // At a limit of its range.
                steps = [0.0; 2];
                steps[usize::from(before.is_err())] = ONE_SIDED * step;
                [at(value - steps[0])?, at(value + steps[1])?]
            }
        };
        Ok(Self { number, sides, steps, models: None })
    }

    /// By how much the number differs between the two devices.
    pub(crate) fn difference(&self) -> f64 {
        self.steps[0] + self.steps[1]
    }

    /// Outputs of both devices, each in equilibrium to first order, at the last solved shape of `manipulator`. Where they do not differ
    /// smoothly, nearer devices are made by `at`; `None` where these do not either. `inputs_of` makes the inputs from those of a
    /// device.
    ///
    /// # Errors
    /// Those of `at` and of models.
    pub(crate) fn outputs(
        &mut self,
        manipulator: &Manipulator,
        here: &mut Linearised,
        at: impl Fn(f64) -> Result<Variant, Error>,
        inputs_of: impl Fn(&Inputs) -> Inputs,
    ) -> Result<Option<[Outputs; 2]>, Error> {
        for shrunk in SHRUNK {
            if shrunk < SHRUNK[0] {
                *self = Self::shrunk(self.number, shrunk, &at)?;
            }
            let found = self.outputs_here(manipulator, here, &inputs_of)?;
            if found.is_some() {
                return Ok(found);
            }
        }
        Ok(None)
    }

    fn outputs_here(
        &mut self,
        manipulator: &Manipulator,
        here: &mut Linearised,
        inputs_of: &impl Fn(&Inputs) -> Inputs,
    ) -> Result<Option<[Outputs; 2]>, Error> {
        let model = manipulator.model();
        let known = self.models.take().filter(|(_, settings)| settings == model.settings());
        let ([before, after], _) = if let Some(known) = known {
            self.models.insert(known)
        } else {
            let made = |side: &Variant| model.alike(&side.design, &side.sources, side.vessel.as_ref());
            let models = [made(&self.sides[0])?, made(&self.sides[1])?];
            self.models.insert((models, *model.settings()))
        };
        let mut inputs = self.sides.each_ref().map(|side| inputs_of(&side.inputs));
        let pushed = here.inputs().feed_force.is_some();
        if pushed {
            for inputs in &mut inputs {
                inputs.insertion = here.inputs().insertion;
            }
        }
        let mut lead = |before: &mut Equilibrium, after: &mut Equilibrium, inputs: &[Inputs; 2]| {
            here.lead([(before, &inputs[0]), (after, &inputs[1])], self.steps) == Neighbourhood::Smooth
        };
        if !lead(before, after, &inputs) {
            return Ok(None);
        }
        if let Some(response) = model.feed_response(None).filter(|_| pushed) {
            // The length follows, so that the shaft holds the given push.
            let models = [&*before, &*after];
            for (inputs, model) in inputs.iter_mut().zip(models) {
                let push =
                    model.feed_reaction(inputs).zip(inputs.feed_force).map(|(held, given)| given - held);
                inputs.insertion += push.unwrap_or(0.0) / response.stiffness;
            }
            if !lead(before, after, &inputs) {
                return Ok(None);
            }
        }
        let read = |model: &Equilibrium, inputs| manipulator.outputs_of(model, inputs);
        Ok(Some([read(before, &inputs[0]), read(after, &inputs[1])]))
    }

    /// Rate of the stability margin by the number, at the shape of the last outputs; `None` where a device has none.
    pub(crate) fn margin_rate(&self) -> Option<f64> {
        let ([before, after], _) = self.models.as_ref()?;
        Some((after.margin()? - before.margin()?) / self.difference())
    }
}

impl Manipulator {
    /// The outputs of a variant of this device: solved on the present model, from the last shape of this device.
    ///
    /// The status is [`Status::Snapped`] where the variant does not hold the shape and another one was found. This manipulator is not
    /// changed.
    ///
    /// # Errors
    /// [`Error::Unsupported`] before the first solve, where the push on a shaft is given, and for a variant with another number of
    /// bodies; those of its model and its inputs.
    pub fn variant(&self, variant: &Variant) -> Result<Outputs, Error> {
        let (model, report) = self.solved_variant(variant)?;
        Ok(self.outputs_of_solve(&model, &variant.inputs, &report))
    }

    /// A variant of this device as a device, solved as by [`Self::variant`]. Only its present model is one of the variant: what it tells
    /// of this shape and the next variants hold, further solves do not.
    ///
    /// # Errors
    /// As [`Self::variant`].
    #[cfg(feature = "fit")]
    pub(crate) fn varied(&self, variant: &Variant) -> Result<Self, Error> {
        let (model, report) = self.solved_variant(variant)?;
        let outputs = self.outputs_of_solve(&model, &variant.inputs, &report);
        Ok(self.with_model(model, outputs))
    }

    fn solved_variant(&self, variant: &Variant) -> Result<(Equilibrium, Report), Error> {
        let model = self.model();
        let Some(inputs) = model.inputs().filter(|_| self.outputs().status != Status::NotSolved) else {
            return Err(Error::Unsupported(
                "the last inputs are not solved: there is no shape to vary".into(),
            ));
        };
        if inputs.feed_force.is_some() {
            return Err(Error::Unsupported("a device whose push is given has no variants".into()));
        }
        let Variant { design, sources, vessel, inputs } = variant;
        let mut varied = model.alike(design, sources, vessel.as_ref())?;
        if varied.freedoms() != model.freedoms() {
            return Err(Error::Unsupported("the variant has another number of bodies".into()));
        }
        varied.adopt(model, model.unknowns(), inputs);
        let report = varied.solve(inputs)?;
        Ok((varied, report))
    }

    /// Derivative of all that is read from outputs by a number on which the device depends, as the outputs of two devices and by how
    /// much the number differs between them. `at` gives the device where the number has another value.
    ///
    /// # Errors
    /// As [`super::Neighbours::sensitivities`]; those of `at`.
    pub(crate) fn outputs_beside(
        &self,
        number: Number,
        at: impl Fn(f64) -> Result<Variant, Error>,
    ) -> Result<([Outputs; 2], f64), Error> {
        let mut here = self.model().linearised()?;
        let mut variation = Variation::new(number, &at)?;
        let found = variation.outputs(self, &mut here, at, Inputs::clone)?;
        found.map(|outputs| (outputs, variation.difference())).ok_or_else(not_smooth)
    }
}

/// The error where neighbouring devices do not differ smoothly.
pub(crate) fn not_smooth() -> Error {
    Error::NoDerivatives("the outputs do not change smoothly with the number".into())
}
