//! The devices that the rows measure: that of the scene, with the inputs of each row.

use crate::error::Error;
use crate::manipulator::{Inputs, Manipulator, Neighbours, Scene, SceneFile, Sensitivities, Status, Variant};

/// Number of centreline points of a device whose shape is not looked at.
const SHAPE_POINTS: usize = 2;

/// Tables of a scene that hold inputs alone, but for those that [`table`] takes out.
const INPUTS: [&str; 7] = ["field", "magnet", "coil", "base", "load", "gravity", "feed"];

/// The table in which a key counts as input or number of the device.
fn table(key: &str) -> &str {
    let of_coil = ["_radius_mm", ".length_mm", ".turns", ".reach_mm", ".multipoles"];
    let of_magnet = [".cylinders", ".size_mm", "radius_mm", ".length_mm", ".direction", ".remanence_t"];
    let of_device = key.starts_with("feed.shaft")
        || key.starts_with("magnet") && of_magnet.iter().any(|part| key.contains(part))
        || key.starts_with("coil") && of_coil.iter().any(|part| key.contains(part));
    if of_device { "design" } else { key.split(['.', '[']).next().unwrap_or(key) }
}

/// The inputs of `device`, with those of `row` in these tables.
fn overlaid(device: &Inputs, row: &Inputs, tables: &[&str]) -> Inputs {
    let mut out = device.clone();
    for table in tables {
        match *table {
            "field" => (out.uniform_field, out.field_gradient) = (row.uniform_field, row.field_gradient),
            "magnet" | "coil" => out.sources.clone_from(&row.sources),
            "base" => out.base = row.base,
            "load" => {
                (out.tip_force, out.tip_moment) = (row.tip_force, row.tip_moment);
                out.ring_forces.clone_from(&row.ring_forces);
            }
            "gravity" => out.gravity = row.gravity,
            _ => (out.insertion, out.feed_force, out.roll) = (row.insertion, row.feed_force, row.roll),
        }
    }
    out
}

/// The inputs of rows by keys of a scene, and the parameters that vary.
#[derive(Debug, Clone)]
pub(super) struct Rows {
    parameters: Vec<String>,
    keys: Vec<String>,
    values: Vec<Vec<f64>>,
    /// Where all rows are one device and no parameter acts on what the rows give: the tables that they give, and the inputs of each.
    shared: Option<(Vec<String>, Vec<Inputs>)>,
}

/// A device with some values of the parameters.
#[derive(Debug)]
pub(super) struct Device<'a> {
    rows: &'a Rows,
    file: SceneFile,
    variant: Variant,
    /// Unsolved, for rows that share it.
    unsolved: Manipulator,
}

/// The scene with these values at these keys.
pub(super) fn with(file: &SceneFile, keys: &[String], values: &[f64]) -> Result<SceneFile, Error> {
    keys.iter().zip(values).try_fold(file.clone(), |file, (key, value)| file.with(key, *value))
}

/// Whether two scenes differ in their inputs alone.
fn is_same_device(a: &Scene, b: &Scene) -> bool {
    (&a.specification, &a.shaft, &a.guidewire) == (&b.specification, &b.shaft, &b.guidewire)
        && (&a.sources, &a.settings, &a.method, &a.vessel) == (&b.sources, &b.settings, &b.method, &b.vessel)
}

impl Rows {
    /// Rows with these `values` of `keys`, each with its name for messages.
    ///
    /// # Errors
    /// Those of a scene that is refused, naming the row.
    pub(super) fn new(
        file: &SceneFile,
        parameters: &[String],
        keys: &[String],
        values: Vec<(String, Vec<f64>)>,
    ) -> Result<Self, Error> {
        use rayon::prelude::*;
        let scene = file.scene()?;
        let scenes = values.par_iter().map(|(name, values)| {
            let own = with(file, keys, values).and_then(|own| own.scene());
            // A row that is another device is checked as one.
            own.and_then(
                |own| if is_same_device(&own, &scene) { Ok(own) } else { own.variant().map(|_| own) },
            )
            .map_err(|error| Error::Syntax { what: name.clone(), reason: error.to_string() })
        });
        let scenes = scenes.collect::<Result<Vec<_>, _>>()?;
        let tables: Vec<String> = keys.iter().map(|key| table(key).to_owned()).collect();
        let apart = tables.iter().all(|own| INPUTS.contains(&own.as_str()))
            && !parameters.iter().any(|key| tables.iter().any(|own| own == table(key)))
            && scenes.iter().all(|own| is_same_device(own, &scene));
        let inputs = scenes.into_iter().map(|scene| scene.inputs).collect();
        let values = values.into_iter().map(|(_, values)| values).collect();
        let (parameters, keys) = (parameters.to_vec(), keys.to_vec());
        let mut out = Self { parameters, keys, values, shared: apart.then_some((tables, inputs)) };
        if apart && !out.holds_shared(file)? {
            out.shared = None;
        }
        Ok(out)
    }

    /// Whether the inputs of the first and the last row follow the parameters as if each row was a scene of its own.
    fn holds_shared(&self, file: &SceneFile) -> Result<bool, Error> {
        for key in &self.parameters {
            let value = file.number(key)?;
            // A part in a thousand, on the side where it is allowed.
            let moved = [1.001, 0.999].iter().filter_map(|by| {
                let varied = file.with(key, value * by).ok()?;
                let variant = varied.scene().ok()?.variant().ok()?;
                Some((varied, variant))
            });
            let Some((varied, variant)) = moved.into_iter().next() else { return Ok(false) };
            for row in [0, self.values.len() - 1] {
                let own = with(&varied, &self.keys, &self.values[row])?.scene()?.inputs;
                if self.inputs(row, &variant.inputs) != own {
                    return Ok(false);
                }
            }
        }
        Ok(true)
    }

    /// The inputs of a row of a device with these inputs; only where they are shared.
    fn inputs(&self, row: usize, device: &Inputs) -> Inputs {
        let Some((tables, rows)) = &self.shared else { return device.clone() };
        let tables: Vec<&str> = tables.iter().map(String::as_str).collect();
        overlaid(device, &rows[row], &tables)
    }

    /// Whether these values of the parameters are those of a device.
    pub(super) fn allows(&self, file: &SceneFile, parameters: &[f64]) -> bool {
        let scene = with(file, &self.parameters, parameters).and_then(|file| file.scene());
        scene.and_then(|scene| scene.variant()).is_ok()
    }

    /// The device with these values of the parameters.
    ///
    /// # Errors
    /// Those of values out of range.
    pub(super) fn device(&self, file: &SceneFile, parameters: &[f64]) -> Result<Device<'_>, Error> {
        let file = with(file, &self.parameters, parameters)?;
        let scene = file.scene()?;
        let (variant, unsolved) = (scene.variant()?, scene.manipulator(SHAPE_POINTS)?);
        Ok(Device { rows: self, file, variant, unsolved })
    }
}

impl Device<'_> {
    /// The scene of a row.
    fn file(&self, row: usize) -> Result<SceneFile, Error> {
        with(&self.file, &self.rows.keys, &self.rows.values[row])
    }

    /// The device of a row, and its inputs.
    fn variant(&self, row: usize) -> Result<Variant, Error> {
        if self.rows.shared.is_none() {
            return self.file(row)?.scene()?.variant();
        }
        let inputs = self.rows.inputs(row, &self.variant.inputs);
        Ok(Variant { inputs, ..self.variant.clone() })
    }

    /// A row solved from the unloaded shape.
    ///
    /// # Errors
    /// Those of inputs out of range.
    pub(super) fn fresh(&self, row: usize) -> Result<Manipulator, Error> {
        if self.rows.shared.is_none() {
            let scene = self.file(row)?.scene()?;
            let mut manipulator = scene.manipulator(SHAPE_POINTS)?;
            manipulator.solve(&scene.inputs)?;
            return Ok(manipulator);
        }
        let mut manipulator = self.unsolved.clone();
        manipulator.solve(&self.rows.inputs(row, &self.variant.inputs))?;
        Ok(manipulator)
    }

    /// A row solved from the shape of a device with other values of the parameters; from the unloaded shape where that is not held.
    ///
    /// # Errors
    /// Those of inputs out of range.
    pub(super) fn moved(&self, row: usize, from: &Manipulator) -> Result<Manipulator, Error> {
        let moved = from.varied(&self.variant(row)?);
        match moved {
            Ok(moved) if matches!(moved.outputs().status, Status::Solved | Status::NearFold) => Ok(moved),
            _ => self.fresh(row),
        }
    }

    /// The neighbours of the device, for all rows that share it.
    ///
    /// # Errors
    /// As [`Neighbours::new`].
    pub(super) fn neighbours(&self) -> Result<Option<Neighbours>, Error> {
        let shared = self.rows.shared.is_some();
        shared.then(|| Neighbours::new(&self.file, &self.rows.parameters)).transpose()
    }

    /// Derivatives of the outputs of a row by the parameters at its solved shape.
    ///
    /// # Errors
    /// As [`Neighbours::sensitivities`].
    pub(super) fn sensitivities(
        &self,
        row: usize,
        solved: &Manipulator,
        neighbours: &mut Option<Neighbours>,
    ) -> Result<Sensitivities, Error> {
        match neighbours {
            Some(shared) => shared.sensitivities_at(solved, |inputs| self.rows.inputs(row, inputs)),
            None => Neighbours::new(&self.file(row)?, &self.rows.parameters)?.sensitivities(solved),
        }
    }
}
