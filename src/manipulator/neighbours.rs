//! Sensitivities: derivatives of all outputs by numbers of the scene, such as moduli, lengths and remanences.

use nalgebra::DVector;

use super::scene::{Scene, SceneFile};
use super::sensitivities::Sensitivities;
use super::variation::{Number, Variant, Variation, not_smooth};
use super::{Inputs, Manipulator, Status};
use crate::error::Error;

/// A key whose effect depends on the way to a shape: there is no derivative by it.
const OF_THE_WAY: &str = "vessel.friction";

/// Usual size of a number with this unit at the end of its key.
fn usual(key: &str) -> f64 {
    let key = key.split('[').next().unwrap_or(key);
    if key.ends_with("_nm") {
        1e-5
    } else if key.ends_with("_n") {
        5e-3
    } else {
        1.0
    }
}

impl Scene {
    /// The checked device of the scene in its surroundings, with its inputs.
    ///
    /// # Errors
    /// As [`Scene::design`].
    pub fn variant(&self) -> Result<Variant, Error> {
        let (sources, vessel) = (self.sources.clone(), self.vessel.clone());
        Ok(Variant { design: self.design()?, sources, vessel, inputs: self.inputs.clone() })
    }
}

/// A scene and, for some of its numbers, the devices where that number is a little smaller and larger.
///
/// From these follow exact derivatives of all outputs by the numbers, without solving another equilibrium: see
/// [`Neighbours::sensitivities`].
///
/// ```
/// use mcm::manipulator::{Neighbours, SceneFile};
/// let text = "[design]\nsegments = 1\n[field]\nuniform_mt = [0.0, 10.0, 0.0]";
/// let file = SceneFile::parse(text, "example")?;
/// let scene = file.scene()?;
/// let mut manipulator = scene.manipulator(11)?;
/// let softer = manipulator.solve(&scene.inputs)?.tip_angle;
/// let mut neighbours = Neighbours::new(&file, &["design.helix.shore_a"])?;
/// let by_hardness = neighbours.sensitivities(&manipulator)?.of(|outputs| outputs.tip_angle)[0];
/// // The same by another solve, a tenth of a Shore degree harder.
/// let harder = file.with("design.helix.shore_a", 33.1)?.scene()?;
/// let harder = harder.manipulator(11)?.solve(&harder.inputs)?.tip_angle;
/// assert!((softer + 0.1 * by_hardness - harder).abs() < 2e-5);
/// # Ok::<(), mcm::error::Error>(())
/// ```
#[derive(Debug, Clone)]
pub struct Neighbours {
    file: SceneFile,
    keys: Vec<String>,
    variations: Vec<Variation>,
}

/// The device of `file` with another value of a number.
fn with(file: &SceneFile, key: &str, value: f64) -> Result<Variant, Error> {
    file.with(key, value)?.scene()?.variant()
}

impl Neighbours {
    /// `keys` are numbers of the scene by their path, as [`SceneFile::with`] takes them: `design.helix.shore_a`,
    /// `base.position_mm[3]`, `magnet.cylinders[1].remanence_t`.
    ///
    /// # Errors
    /// [`Error::Unsupported`] for a key that does not exist, holds no number or a whole one, or has no derivatives
    /// (`vessel.friction`: what friction holds depends on the way); [`Error::Several`] for keys named twice; those of a scene
    /// that is refused.
    pub fn new(file: &SceneFile, keys: &[impl AsRef<str>]) -> Result<Self, Error> {
        for (number, key) in keys.iter().enumerate() {
            if keys[..number].iter().any(|other| other.as_ref() == key.as_ref()) {
                return Err(Error::Unsupported(format!("`{}` is named twice", key.as_ref())));
            }
        }
        let vary = |key: &str| {
            if key == OF_THE_WAY {
                let reason = "what friction holds depends on the way to the shape";
                return Err(Error::Unsupported(format!("no derivatives by `{key}`: {reason}")));
            }
            let number = Number { value: file.number(key)?, usual: usual(key) };
            Variation::new(number, |value| with(file, key, value))
        };
        let variations = keys.iter().map(|key| vary(key.as_ref())).collect::<Result<_, _>>()?;
        let keys = keys.iter().map(|key| key.as_ref().to_owned()).collect();
        Ok(Self { file: file.clone(), keys, variations })
    }

    /// The keys of the numbers, in the order in which they were given.
    #[must_use]
    pub fn keys(&self) -> &[String] {
        &self.keys
    }

    /// Derivatives of all outputs by the numbers at the last solved shape of `manipulator`, which is one of the same scene.
    ///
    /// They hold for the model that `manipulator` has chosen, with its quadratures, and, where the push on a shaft is given, for
    /// that push.
    ///
    /// # Errors
    /// [`Error::NoDerivatives`] where nothing is solved, at a fold, where bodies touch, and where a number cannot change without
    /// changing the discretisation.
    pub fn sensitivities(&mut self, manipulator: &Manipulator) -> Result<Sensitivities, Error> {
        self.sensitivities_at(manipulator, Inputs::clone)
    }

    /// Sensitivities of a shape whose inputs are not those of the scene: `inputs_of` makes them from those of the scene, so that a
    /// number of the scene that they replace has no effect.
    ///
    /// # Errors
    /// As [`Self::sensitivities`].
    pub fn sensitivities_at(
        &mut self,
        manipulator: &Manipulator,
        inputs_of: impl Fn(&Inputs) -> Inputs,
    ) -> Result<Sensitivities, Error> {
        if manipulator.outputs().status == Status::NotSolved {
            return Err(Error::NoDerivatives("the last inputs are not solved".into()));
        }
        let mut here = manipulator.model().linearised()?;
        let (mut sides, mut differences) = (Vec::new(), Vec::new());
        for (key, variation) in self.keys.iter().zip(&mut self.variations) {
            let at = |value| with(&self.file, key, value);
            let outputs = variation.outputs(manipulator, &mut here, at, &inputs_of)?;
            sides.push(outputs.ok_or_else(not_smooth)?);
            differences.push(variation.difference());
        }
        Ok(Sensitivities::new(self.keys.clone(), sides, differences))
    }

    /// Derivatives of the stability margin by the numbers, at the shape of the last sensitivities; `None` before the first, and where a
    /// neighbouring device has no margin.
    #[must_use]
    pub fn margin_sensitivities(&self) -> Option<DVector<f64>> {
        let rates = self.variations.iter().map(Variation::margin_rate);
        Some(DVector::from_vec(rates.collect::<Option<_>>()?))
    }
}
