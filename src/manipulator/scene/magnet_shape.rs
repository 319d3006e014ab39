//! The words of a magnet's shape in a scene, and the grades of its material.

use serde::de::Error as _;
use serde::{Deserialize, Deserializer};

#[cfg(test)]
use crate::magnetics::Shape;
use crate::magnetics::{SHAPES, shape_named};

/// Grades of sintered `NdFeB` with the range of their remanence, T, as data sheets give it.
pub(super) const GRADES: [(&str, [f64; 2]); 8] = [
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
pub(super) const DEVIATIONS: f64 = 4.0;

/// The dimension that is 0 where it is left out.
pub(super) const SOLID: &str = "inner_radius_mm";

/// Keys of a shape that are no dimensions.
pub(super) const OF_ALL: [&str; 3] = ["direction", "remanence_t", "grade"];

/// Reads the name of a shape.
pub(super) fn read<'de, D: Deserializer<'de>>(input: D) -> Result<Option<String>, D::Error> {
    let name = String::deserialize(input)?;
    if shape_named(&name).is_some() {
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
pub(super) fn key_of(key: &str) -> &str {
    let own = key.split_once('.').map_or(key, |(_, own)| own);
    own.split('[').next().unwrap_or(own)
}
