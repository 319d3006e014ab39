//! Measured rows.

use super::quantity::Quantity;
use crate::error::{Error, check};
use crate::manipulator::{Inputs, SceneFile};

/// A measured number.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Measured {
    /// What was measured.
    pub quantity: Quantity,
    /// Its value, in the unit of the quantity.
    pub value: f64,
    /// Its standard deviation; `None` where that is to be estimated from the rows.
    pub deviation: Option<f64>,
}

/// One row: inputs and what was measured there.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Row {
    pub(super) inputs: Inputs,
    pub(super) measured: Vec<Measured>,
}

/// Measured rows, in the order in which they were taken: each is solved from the shape of the one before.
///
/// ```
/// use mcm::fit::{Data, Measured, Quantity};
/// use mcm::manipulator::SceneFile;
/// let file = SceneFile::parse("[design]\nsegments = 1\n[field]", "example")?;
/// let mut data = Data::new(&file, &["field.uniform_mt[2]"])?;
/// let angle = Measured { quantity: Quantity::named("alpha_deg")?, value: 19.4, deviation: Some(0.2) };
/// data.add(&[10.0], &[angle])?;
/// assert!(Data::new(&file, &["design.helix.shore_a"]).is_err()); // not another input but another device
/// # Ok::<(), mcm::error::Error>(())
/// ```
#[derive(Debug, Clone)]
pub struct Data {
    file: SceneFile,
    keys: Vec<String>,
    pub(super) rows: Vec<Row>,
}

/// Tables of a scene that hold inputs.
const INPUTS: [&str; 7] = ["field", "magnet", "base", "load", "gravity", "feed", "guidewire"];

/// Keys there that are part of the device.
const DEVICE: [&str; 3] = ["magnet.cylinders", "feed.shaft", "guidewire.outer"];

impl Data {
    /// No rows yet; each will have these inputs, named by their keys in the scene, and the scene's for the others.
    ///
    /// # Errors
    /// [`Error::Unsupported`] for a key that is no input of the scene, or named twice.
    pub fn new(file: &SceneFile, keys: &[impl AsRef<str>]) -> Result<Self, Error> {
        let keys: Vec<String> = keys.iter().map(|key| key.as_ref().to_owned()).collect();
        for (number, key) in keys.iter().enumerate() {
            let table = key.split('.').next().unwrap_or_default();
            let device = DEVICE.iter().any(|part| key.starts_with(part));
            if !INPUTS.contains(&table) || device {
                return Err(Error::Unsupported(format!(
                    "`{key}` is no input: rows have inputs and measured outputs"
                )));
            }
            if keys[..number].contains(key) {
                return Err(Error::Unsupported(format!("`{key}` is named twice")));
            }
            file.number(key)?;
        }
        Ok(Self { file: file.clone(), keys, rows: Vec::new() })
    }

    /// Adds a row with these values of the keys.
    ///
    /// # Errors
    /// [`Error::Count`] for another number of values, and for nothing measured; [`Error::Range`] for numbers that are not finite and
    /// standard deviations that are not positive; those of the scene.
    pub fn add(&mut self, values: &[f64], measured: &[Measured]) -> Result<(), Error> {
        let count = |quantity: &str, given, expected: String| Error::Count {
            quantity: quantity.into(),
            given,
            expected,
        };
        if values.len() != self.keys.len() {
            return Err(count("inputs of a row", values.len(), self.keys.len().to_string()));
        }
        if measured.is_empty() {
            return Err(count("measured outputs of a row", 0, "at least one".into()));
        }
        for each in measured {
            let name = each.quantity.name();
            check(&name, each.value, |_| true, "finite")?;
            if let Some(deviation) = each.deviation {
                check(&format!("standard deviation of {name}"), deviation, |v| v > 0.0, "> 0")?;
            }
        }
        let mut file = self.file.clone();
        for (key, value) in self.keys.iter().zip(values) {
            file = file.with(key, *value)?;
        }
        self.rows.push(Row { inputs: file.scene()?.inputs, measured: measured.to_vec() });
        Ok(())
    }

    /// Number of rows.
    #[must_use]
    pub fn len(&self) -> usize {
        self.rows.len()
    }

    /// Whether there are none.
    #[must_use]
    pub fn is_empty(&self) -> bool {
        self.rows.is_empty()
    }

    /// All measured numbers, row by row.
    pub(super) fn measured(&self) -> impl Iterator<Item = &Measured> {
        self.rows.iter().flat_map(|row| &row.measured)
    }

    /// The inputs of a row for a device of the scene with other parameters, whose inputs without a row are `own`.
    pub(super) fn inputs(&self, row: &Inputs, own: &Inputs) -> Inputs {
        let mut out = own.clone();
        for key in &self.keys {
            match key.split(['.', '[']).collect::<Vec<_>>().as_slice() {
                ["magnet", part, ..] if part.starts_with("position") => {
                    out.magnet.position = row.magnet.position;
                }
                ["magnet", "strength", ..] => out.magnet_strength = row.magnet_strength,
                ["magnet", ..] => out.magnet.rotation = row.magnet.rotation,
                ["field", ..] => {
                    (out.uniform_field, out.field_gradient) = (row.uniform_field, row.field_gradient);
                }
                ["base", part, ..] if part.starts_with("position") => out.base.position = row.base.position,
                ["base", ..] => out.base.rotation = row.base.rotation,
                ["gravity", ..] => out.gravity = row.gravity,
                ["guidewire", ..] => out.guidewire_insertion = row.guidewire_insertion,
                ["feed", ..] => {
                    (out.insertion, out.feed_force, out.roll) = (row.insertion, row.feed_force, row.roll);
                }
                _ => {
                    (out.tip_force, out.tip_moment) = (row.tip_force, row.tip_moment);
                    out.ring_forces.clone_from(&row.ring_forces);
                }
            }
        }
        out
    }
}
