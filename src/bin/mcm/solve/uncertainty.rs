//! Bands of 95 % beside the numbers of a solve.

use mcm::error::Error;
use mcm::manipulator::output_table::OutputRow;
use mcm::manipulator::{Manipulator, Outputs, SceneFile};
use mcm::uncertainty::{Bands, Samples};
use nalgebra::DVector;
use serde_json::{Map, Value, json};

use super::json::{rows_with_keys, value};
use super::quantities::quantities;
use crate::progress::progress_bar;

/// Seed of the samples: the same scene has the same ones.
const SEED: u64 = 1;

/// What samples tell of, in the keys of JSON.
const SAMPLED: [&str; 6] = [
    "alpha_rad",
    "tip_position_m",
    "magnetic_force_n",
    "base_reaction_force_n",
    "magnet_reaction_force_n",
    "largest_contact_force_n",
];

/// How sure the numbers are.
pub(super) struct Told {
    bands: Bands,
    samples: Option<Samples>,
}

impl Told {
    /// Of the last shape of a scene's device; with this many samples, if any.
    pub(super) fn of(
        file: &SceneFile,
        manipulator: &Manipulator,
        samples: Option<usize>,
    ) -> Result<Self, Error> {
        let bands = Bands::new(file, manipulator)?;
        let drawn = samples.map(|count| {
            let bar = progress_bar(count as u64, "samples");
            let drawn = Samples::draw(file, manipulator, count, SEED, || bar.inc(1));
            bar.finish_and_clear();
            drawn
        });
        Ok(Self { bands, samples: drawn.transpose()? })
    }

    /// Half the width of the band of each component of the table's quantities.
    pub(super) fn of_table(&self) -> Vec<Vec<f64>> {
        let here = self.sides(|outputs| {
            let components = quantities(outputs).into_iter().map(|quantity| json!(quantity.components));
            Value::Array(components.collect())
        });
        let bands = leaves(&here, &|derivatives| self.band(derivatives));
        let rows = bands.as_array().into_iter().flatten();
        rows.map(|row| row.as_array().into_iter().flatten().filter_map(Value::as_f64).collect()).collect()
    }

    /// What the table ends with.
    pub(super) fn note(&self) -> String {
        let stated = self.bands.uncertainty();
        let numbers: Vec<String> = stated
            .keys
            .iter()
            .zip(&stated.deviations)
            .map(|(key, deviation)| format!("{key} \u{b1} {deviation}"))
            .collect();

        let mut lines = vec![format!(
            "\n\u{b1}: half the width of the 95 % band, first order, from standard deviations of {}\n",
            numbers.join(", ")
        )];

        if let Some(distance) = self.bands.distance_of_fold() {
            let told = if self.bands.near_fold() {
                ": near a fold the distribution is no ellipse and these bands do not hold; only samples show it (--samples 1000)"
            } else {
                ""
            };
            lines.push(format!("a fold is {distance:.1} standard deviations away{told}\n"));
        }

        if let Some(samples) = &self.samples {
            let (on, refused) = (samples.outputs().len(), samples.refused());
            let snaps = 100.0 * samples.snap_probability();
            lines.push(format!(
                "{on} sampled devices hold the shape, {refused} cannot be built; probability of a snap {snaps:.2} %\n"
            ));
            if let Some([low, high]) = samples.band(|outputs| outputs.tip_angle.to_degrees()) {
                lines.push(format!(
                    "95 % of those that hold it have a tip angle from {low:.4} to {high:.4} deg\n"
                ));
            }
        }

        lines.concat()
    }

    /// Bands, deviations and sensitivities as JSON.
    pub(super) fn as_json(&self) -> Value {
        let stated = self.bands.uncertainty();
        let deviations: Map<String, Value> =
            stated.keys.iter().cloned().zip(stated.deviations.iter().map(|value| json!(value))).collect();

        let (mut bands, mut sensitivities) = (Map::new(), vec![Map::new(); stated.keys.len()]);
        for (key, row) in of_shape().filter(|(_, row)| self.is_known(row)) {
            let sides = self.sides(|outputs| value(row, outputs).unwrap_or(Value::Null));
            bands.insert(key.clone(), leaves(&sides, &|derivatives| self.band(derivatives)));
            for (side, sensitivity) in sides.chunks(1).zip(&mut sensitivities) {
                sensitivity.insert(key.clone(), leaves(side, &|derivatives| json!(derivatives[0])));
            }
        }
        let sensitivities: Map<String, Value> =
            stated.keys.iter().cloned().zip(sensitivities.into_iter().map(Value::Object)).collect();

        json!({
            "deviations": deviations,
            "band_95": bands,
            "sensitivities": sensitivities,
            "distance_of_fold": self.bands.distance_of_fold(),
            "near_fold": self.bands.near_fold(),
            "samples": self.samples.as_ref().map(|samples| json!({
                "hold_the_shape": samples.outputs().len(),
                "lost": samples.lost(),
                "refused": samples.refused(),
                "snap_probability": samples.snap_probability(),
                "band_95": quantiles(samples),
            })),
        })
    }

    /// Whether the neighbouring devices have an output.
    fn is_known(&self, row: &OutputRow) -> bool {
        let side = self.bands.sensitivities().sides(0);
        side.is_some_and(|([before, _], _)| value(row, before).is_some())
    }

    /// What is read of both neighbouring devices of each number, and by how much the number differs between them.
    fn sides(&self, read: impl Fn(&Outputs) -> Value) -> Vec<([Value; 2], f64)> {
        let sensitivities = self.bands.sensitivities();
        let each = (0..sensitivities.keys().len()).filter_map(|index| sensitivities.sides(index));
        each.map(|(sides, apart)| (sides.each_ref().map(&read), apart)).collect()
    }

    /// Half the width of the band of a number with these derivatives.
    fn band(&self, derivatives: &[f64]) -> Value {
        json!(self.bands.band_along(&DVector::from_column_slice(derivatives)))
    }
}

/// What JSON tells of a shape; not what a solve adds to it, which has no bands.
fn of_shape() -> impl Iterator<Item = (String, &'static OutputRow)> {
    rows_with_keys().filter(|(_, row)| row.derivative.is_of_shape())
}

/// What `of` tells of the derivatives of each number in values of one form; null where neighbouring devices differ in form.
fn leaves(sides: &[([Value; 2], f64)], of: &impl Fn(&[f64]) -> Value) -> Value {
    let derivatives: Option<Vec<f64>> = sides
        .iter()
        .map(|([before, after], apart)| Some((after.as_f64()? - before.as_f64()?) / apart))
        .collect();
    if let Some(derivatives) = derivatives {
        return of(&derivatives);
    }
    let Some(([Value::Array(first), _], _)) = sides.first() else { return Value::Null };
    let count = first.len();
    let alike = |value: &Value| value.as_array().is_some_and(|array| array.len() == count);
    if !sides.iter().all(|(sides, _)| sides.iter().all(alike)) {
        return Value::Null;
    }
    let entry = |index: usize| -> Vec<_> {
        sides
            .iter()
            .map(|(sides, apart)| (sides.each_ref().map(|side| side[index].clone()), *apart))
            .collect()
    };
    (0..count).map(|index| leaves(&entry(index), of)).collect()
}

/// The bands of the sampled devices that hold the shape, as pairs of limits.
fn quantiles(samples: &Samples) -> Map<String, Value> {
    let Some(first) = samples.outputs().first() else { return Map::new() };
    let mut out = Map::new();
    for (key, row) in of_shape().filter(|(key, _)| SAMPLED.contains(&key.as_str())) {
        let read = |outputs: &Outputs| value(row, outputs).unwrap_or(Value::Null);
        let value = read(first);
        let components = value.as_array().map(Vec::len);
        let band = |component: Option<usize>| {
            samples.band(|outputs| {
                let value = read(outputs);
                component.map_or(&value, |component| &value[component]).as_f64().unwrap_or(f64::NAN)
            })
        };
        out.insert(
            key,
            match components {
                Some(count) => (0..count).map(|component| json!(band(Some(component)))).collect(),
                None if value.is_number() => json!(band(None)),
                None => Value::Null,
            },
        );
    }
    out
}
