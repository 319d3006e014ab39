//! Magnets that a scene gives by their shape, and the grades of their material.

use serde::de::Error as _;
use serde::{Deserialize, Deserializer};
use toml::Value;

use super::names::Unit;
use super::path::suggestion;
use super::sources::{MagnetCylinder, MagnetEntries, Magnets};
use crate::error::Error;
use crate::magnetics::{SHAPES, Shape, ShapedMagnet};

/// Grades of sintered `NdFeB` with the range of their remanence, T, as data sheets give it.
const GRADES: [(&str, [f64; 2]); 8] = [
    ("N35", [1.17, 1.22]),
    ("N38", [1.22, 1.25]),
    ("N40", [1.25, 1.28]),
    ("N42", [1.28, 1.32]),
    ("N45", [1.32, 1.38]),
    ("N48", [1.38, 1.42]),
    ("N50", [1.40, 1.45]),
    ("N52", [1.43, 1.48]),
];

/// Standard deviations within the range of a grade.
const DEVIATIONS: f64 = 4.0;

/// The dimension that is 0 where it is left out.
const SOLID: &str = "inner_radius_mm";

/// Keys of a shape that are no dimensions.
const OF_ALL: [&str; 3] = ["direction", "remanence_t", "grade"];

/// Reads the name of a shape.
pub(super) fn read<'de, D: Deserializer<'de>>(input: D) -> Result<Option<String>, D::Error> {
    let name = String::deserialize(input)?;
    if Shape::named(&name).is_some() {
        return Ok(Some(name));
    }
    let known = SHAPES.map(|shape| shape.name).join(", ");
    Err(D::Error::custom(format!("\"{name}\" is not known here: choose one of {known}")))
}

/// The names of all shapes in the schema of a scene.
#[cfg(test)]
pub(super) fn names(_: &mut schemars::SchemaGenerator) -> schemars::Schema {
    let each = SHAPES.map(|shape| {
        serde_json::json!({ "const": shape.name, "type": "string", "description": format!("{}.", shape.description) })
    });
    schemars::json_schema!({ "oneOf": each })
}

/// The names of all grades in the schema of a scene.
#[cfg(test)]
pub(super) fn grades(_: &mut schemars::SchemaGenerator) -> schemars::Schema {
    schemars::json_schema!({ "type": "string", "enum": GRADES.map(|(name, _)| name) })
}

/// What the schema of a magnet's table says of its shape: which keys belong to it.
#[cfg(test)]
pub(super) fn conditions() -> Vec<serde_json::Value> {
    use serde_json::{Map, json};

    let dimensions = |shape: &Shape| -> Vec<&'static str> {
        shape.dimensions.iter().map(|quantity| key_of(quantity.key)).collect()
    };
    let all: Vec<_> = SHAPES.into_iter().flat_map(dimensions).collect();
    let none_of = |keys: &[&str]| -> Map<String, serde_json::Value> {
        keys.iter().map(|key| ((*key).to_owned(), json!(false))).collect()
    };
    let magnetised = json!([{ "required": ["remanence_t"] }, { "required": ["grade"] }]);
    let mut out = vec![json!({
        "if": { "required": ["shape"] },
        "then": { "properties": { "cylinders": false }, "oneOf": magnetised },
        "else": { "properties": none_of(&[&all[..], &OF_ALL].concat()) },
    })];
    for shape in SHAPES {
        let own = dimensions(shape);
        let others: Vec<_> = all.iter().copied().filter(|key| !own.contains(key)).collect();
        let mut required = own;
        required.dedup();
        required.retain(|key| *key != SOLID);
        out.push(json!({
            "if": { "properties": { "shape": { "const": shape.name } }, "required": ["shape"] },
            "then": { "required": required, "properties": none_of(&others) },
        }));
    }
    out
}

/// The key of a magnet's table that holds a quantity, without its index.
fn key_of(key: &str) -> &str {
    let own = key.split_once('.').map_or(key, |(_, own)| own);
    own.split('[').next().unwrap_or(own)
}

impl Magnets {
    /// Fills in the defaults that depend on the shape, and the remanence of a grade; calls `known` with the key of that number and its
    /// standard deviation.
    pub(super) fn complete(&mut self, mut known: impl FnMut(String, f64)) {
        let several = self.0.len() > 1;
        for (number, magnet) in (1..).zip(&mut self.0) {
            if let Some(deviation) = magnet.complete() {
                let table = if several { format!("magnet[{number}]") } else { "magnet".into() };
                known(format!("{table}.remanence_t"), deviation);
            }
        }
    }
}

impl MagnetEntries {
    /// Fills in the defaults; the standard deviation of the remanence where it is that of a grade.
    fn complete(&mut self) -> Option<f64> {
        let Some(shape) = self.shape.as_deref().and_then(Shape::named) else {
            if self.stated().is_none() {
                self.cylinders.get_or_insert_with(MagnetCylinder::pair);
            }
            return None;
        };
        self.direction.get_or_insert([0.0, 0.0, 1.0]);
        if shape.dimensions.iter().any(|quantity| key_of(quantity.key) == SOLID) {
            self.inner_radius_mm.get_or_insert(0.0);
        }
        if self.remanence_t.is_some() {
            return None;
        }
        let (_, [low, high]) = GRADES.into_iter().find(|(name, _)| self.grade.as_deref() == Some(*name))?;
        self.grade = None;
        self.remanence_t = Some(0.5 * (low + high));
        Some((high - low) / DEVIATIONS)
    }

    /// The first key that is stated and belongs to a shape.
    fn stated(&self) -> Option<String> {
        let own = Value::try_from(self).ok()?;
        let dimensions = SHAPES.iter().flat_map(|shape| shape.dimensions).map(|one| key_of(one.key));
        dimensions.chain(OF_ALL).find(|key| own.get(key).is_some()).map(str::to_owned)
    }

    /// The magnet in SI units where it is given by its shape; `key` is that of the table.
    pub(super) fn shaped(&self, key: &str) -> Result<Option<ShapedMagnet>, Error> {
        let refused = |reason: String| Err(Error::Unsupported(reason));
        let Some(shape) = self.shape.as_deref().and_then(Shape::named) else {
            return match self.stated() {
                Some(stated) => refused(format!("{key}.{stated} needs {key}.shape")),
                None => Ok(None),
            };
        };
        if self.cylinders.is_some() {
            return refused(format!(
                "{key}.cylinders has no meaning beside {key}.shape: give one or the other"
            ));
        }
        self.refuse_other_dimensions(shape, key)?;

        let own = Value::try_from(self).unwrap_or(Value::Boolean(false));
        let number = |(place, quantity): (usize, &crate::error::Quantity)| {
            let name = key_of(quantity.key);
            let found = own.get(name).map(|value| value.as_array().map_or(value, |list| &list[place]));
            let found = found.and_then(Value::as_float);
            let missing = || Error::Unsupported(format!("{key}.{name} is missing"));
            found.map(|number| number / Unit::of(name).per_si()).ok_or_else(missing)
        };
        Ok(Some(ShapedMagnet {
            shape,
            dimensions: shape.numbered().map(number).collect::<Result<_, _>>()?,
            direction: self.direction.unwrap_or([0.0, 0.0, 1.0]),
            remanence: self.remanence(key)?,
        }))
    }

    /// Checks that no dimension of another shape is stated.
    fn refuse_other_dimensions(&self, shape: &Shape, key: &str) -> Result<(), Error> {
        let own = Value::try_from(self).unwrap_or(Value::Boolean(false));
        let belongs = |name: &str| shape.dimensions.iter().any(|quantity| key_of(quantity.key) == name);
        let all = SHAPES.iter().flat_map(|shape| shape.dimensions).map(|quantity| key_of(quantity.key));
        match all.into_iter().find(|name| own.get(name).is_some() && !belongs(name)) {
            Some(name) => {
                let reason = format!("{key}.{name} has no meaning for {key}.shape = \"{}\"", shape.name);
                Err(Error::Unsupported(reason))
            }
            None => Ok(()),
        }
    }

    /// The remanence, T.
    fn remanence(&self, key: &str) -> Result<f64, Error> {
        match (self.remanence_t, &self.grade) {
            (Some(remanence), None) => Ok(remanence),
            (Some(_), Some(_)) => Err(Error::Unsupported(format!(
                "{key}.grade has no meaning beside {key}.remanence_t: give one or the other"
            ))),
            (None, Some(grade)) => {
                let known = GRADES.map(|(name, _)| name);
                let hint = suggestion(grade, &known);
                Err(Error::Unsupported(format!("{key}.grade: \"{grade}\" is not known here{hint}")))
            }
            (None, None) => Err(Error::Unsupported(format!("{key}.remanence_t is missing, or {key}.grade"))),
        }
    }
}
