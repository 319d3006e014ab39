//! A device that a page moves: an instance of the FMU, with all inputs and all outputs as arrays.

use std::sync::{Arc, Mutex, PoisonError};

use super::description::{Description, is_shown};
use crate::equilibrium::Interaction;
use crate::error::Error;
use crate::fmi::Instance;
use crate::fmi::Package;
use crate::fmi::log::Log;
use crate::fmi::state::{Ending, Interface, State};
use crate::fmi::value::Value;
use crate::fmi::variable::{Availability, Causality};
use crate::manipulator::SceneFile;
use crate::vessel::{DistanceGrid, Lumen};

/// Points of the centreline for each segment and for a shaft, and fewest and most of them: close enough that cubic curves between them
/// show every bend.
const POINTS_PER_SEGMENT: usize = 12;
const POINTS_OF_SHAFT: usize = 120;
const FEWEST_POINTS: usize = 49;
const MOST_POINTS: usize = 500;

/// Factor on the scene's time budget, as far as the budget stays below some seconds: a page knows the time of the wall alone, shares the
/// processor with the pictures that it draws, and its code is slow until the browser has compiled it well.
const PATIENCE: f64 = 5.0;
const SECONDS: f64 = 5.0;

/// A device that follows its inputs.
///
/// It answers as the FMU of the same scene does, number by number, but goes on from its last good shape where a step fails.
///
/// ```
/// use mcm::web::Device;
/// let mut device = Device::open("[design]\nsegments = 1\n[magnet]", None)?;
/// let mut inputs = device.start();
/// assert!(device.load(&inputs));
/// let before = device.outputs();
/// inputs[1] += 0.01; // magnet.position[2], m
/// assert!(device.step(&inputs));
/// assert_ne!(device.outputs(), before);
/// inputs[1] = f64::NAN;
/// assert!(!device.step(&inputs));
/// assert!(device.said().contains("magnet.position[2]"));
/// # Ok::<(), mcm::error::Error>(())
/// ```
#[derive(Debug)]
pub struct Device {
    pub(super) file: Arc<SceneFile>,
    pub(super) package: Arc<Package>,
    instance: Instance,
    level: Interaction,
    pub(super) inputs: Vec<u32>,
    outputs: Vec<u32>,
    said: Arc<Mutex<Vec<String>>>,
}

impl Device {
    /// The device of a scene, not yet loaded. A scene that names a mesh needs its distance grid, as an FMU's resources have it.
    ///
    /// # Errors
    /// Those of [`SceneFile::parse`] and [`Package::of`]; [`Error::Syntax`] for bytes that are no grid.
    pub fn open(scene: &str, grid: Option<&[u8]>) -> Result<Self, Error> {
        let lumen = |name: &str| match grid {
            Some(bytes) => DistanceGrid::from_bytes(bytes).map(Lumen::of_grid),
            None => Err(Error::Unsupported(format!(
                "{name} is not in this page: build one with `fmu/live --scene`, which takes the mesh along"
            ))),
        };
        let file = SceneFile::parse_with(scene, "scene", lumen)?;
        let read = file.scene()?;
        let design = read.design()?;
        let shaft = if design.shaft().is_some() { POINTS_OF_SHAFT } else { 0 };
        let points =
            (POINTS_PER_SEGMENT * design.segments().len() + 1).clamp(FEWEST_POINTS, MOST_POINTS - shaft);
        let package = Package::of(&file, points + shaft)?;
        let level = package.start().settings.interaction;
        Ok(Self::of(Arc::new(file), Arc::new(package), level))
    }

    /// This device, not yet loaded, by another level of the model.
    #[must_use]
    pub fn at_level(&self, level: Interaction) -> Self {
        Self::of(Arc::clone(&self.file), Arc::clone(&self.package), level)
    }

    fn of(file: Arc<SceneFile>, package: Arc<Package>, level: Interaction) -> Self {
        let said = Arc::new(Mutex::new(Vec::new()));
        let heard = Arc::clone(&said);
        let sink = move |_: Ending, _: _, message: &str| {
            heard.lock().unwrap_or_else(PoisonError::into_inner).push(message.to_owned());
        };
        let rows = (0..).zip(package.table().variables());
        let inputs = rows.clone().filter(|(_, row)| row.causality == Causality::Input).map(|(at, _)| at);
        let outputs = rows.clone().filter(|(_, row)| is_shown(row)).map(|(at, _)| at);
        let (inputs, outputs) = (inputs.collect(), outputs.collect());
        let instance =
            Instance::new(Interface::CoSimulation, Arc::clone(&package), Log::new(Box::new(sink), false));
        Self { file, package, instance, level, inputs, outputs, said }
    }

    /// What a page draws and offers to set, as JSON.
    ///
    /// # Errors
    /// [`Error::Syntax`] if it cannot be written.
    pub fn description(&self) -> Result<String, Error> {
        Description::of(&self.package)?.to_json()
    }

    /// Start values of all inputs, SI.
    #[must_use]
    pub fn start(&self) -> Vec<f64> {
        let table = self.package.table();
        let value = |&at: &u32| table.find(at)?.host_value(self.package.start())?.real();
        self.inputs.iter().map(|at| value(at).unwrap_or_default()).collect()
    }

    /// Loads the device at these inputs, from its unloaded shape; false if that fails, see [`Device::said`].
    pub fn load(&mut self, inputs: &[f64]) -> bool {
        self.instance.reset();
        let budget = self.package.start().settings.time_budget;
        let budget = (PATIENCE * budget).min(budget.max(SECONDS));
        let parameters = [
            ("model.interaction", Value::Integer(self.level as i32)),
            ("model.time_budget", Value::Real(budget)),
        ];
        let table = self.package.table();
        let own = parameters.iter().filter_map(|&(name, value)| Some((table.reference(name)?, value)));
        let (references, values): (Vec<u32>, Vec<Value>) = own.unzip();
        self.instance.set(&references, values.into_iter()) == Ending::Ok
            && self.set(inputs)
            && self.instance.enter_initialization() == Ending::Ok
            && self.instance.exit_initialization() == Ending::Ok
    }

    /// Follows the equilibrium to these inputs; loads the device there if it has no shape. False if that fails: the last good shape
    /// stays, and the next step goes on from there; see [`Device::said`].
    pub fn step(&mut self, inputs: &[f64]) -> bool {
        self.instance.recover();
        if self.instance.state() != State::Stepping {
            return self.load(inputs);
        }
        self.set(inputs) && self.instance.do_step(self.instance.time(), 0.0) == Ending::Ok
    }

    fn set(&mut self, inputs: &[f64]) -> bool {
        if inputs.len() != self.inputs.len() {
            let (given, own) = (inputs.len(), self.inputs.len());
            return self.instance.refuse(&format!("{given} inputs for a device that has {own}"))
                == Ending::Ok;
        }
        self.instance.set(&self.inputs, inputs.iter().map(|&value| Value::Real(value))) == Ending::Ok
    }

    /// All outputs, SI; not a number where there is none yet. After a step that failed they are the last good ones. The stability
    /// margin is an upper bound until [`Device::measure`], and the wrench of magnets and coils on one another is not a number.
    #[must_use]
    pub fn outputs(&self) -> Vec<f64> {
        let table = self.package.table();
        let value = |&at: &u32| self.instance.result(table.find(at)?).map(number);
        self.outputs.iter().map(|at| value(at).unwrap_or(f64::NAN)).collect()
    }

    /// Computes what is computed only on request, the stability margin of the last shape above all, which takes as long as some steps;
    /// false where there is no shape.
    pub fn measure(&mut self) -> bool {
        let variables = (0..).zip(self.package.table().variables());
        let on_request = variables
            .filter(|(_, row)| is_shown(row) && matches!(row.availability, Availability::OnRequest(_)));
        let references: Vec<u32> = on_request.map(|(reference, _)| reference).collect();
        self.instance.get(&references, "Real", Value::real).is_ok()
    }

    /// What the device has said since the last question, a line each: why a call failed, that it snapped, that a fold is near.
    #[must_use]
    pub fn said(&self) -> String {
        let said = std::mem::take(&mut *self.said.lock().unwrap_or_else(PoisonError::into_inner));
        // The FMU's advice on what to do then is not for a page, which goes on by itself.
        self.instance.why_failed().filter(|_| !said.is_empty()).unwrap_or_else(|| said.join("\n"))
    }
}

fn number(value: Value) -> f64 {
    match value {
        Value::Real(value) => value,
        Value::Integer(value) => f64::from(value),
        Value::Boolean(value) => f64::from(u8::from(value)),
    }
}
