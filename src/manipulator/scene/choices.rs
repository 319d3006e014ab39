//! Keys whose value is one of a list of names: the level of interaction and the method.

use serde::de::Error;
use serde::{Deserialize, Deserializer, Serializer};

use crate::equilibrium::Interaction;

#[expect(clippy::trivially_copy_pass_by_ref, reason = "serde hands over a reference")]
pub(super) fn write_level<S: Serializer>(level: &Interaction, out: S) -> Result<S::Ok, S::Error> {
    out.serialize_str(level.name())
}

pub(super) fn read_level<'de, D: Deserializer<'de>>(input: D) -> Result<Interaction, D::Error> {
    let name = String::deserialize(input)?;
    let known = Interaction::ALL.iter().map(|row| row.1);
    Interaction::named(&name).ok_or_else(|| unknown(&name, "not a level", known))
}

/// The words of the key `model.method`: the potential method, which a [`super::Manipulator`] solves by, and those to compare it with.
pub const METHODS: [&str; 7] = [
    "potential",
    "shooting-fd",
    "shooting",
    "multiple-shooting",
    "collocation",
    "constant-curvature",
    "planar",
];

/// The method that this library is made of: the minimum of the potential energy.
pub const POTENTIAL: &str = METHODS[0];

pub(super) fn read_method<'de, D: Deserializer<'de>>(input: D) -> Result<String, D::Error> {
    let name = String::deserialize(input)?;
    if METHODS.contains(&name.as_str()) {
        return Ok(name);
    }
    Err(unknown(&name, "not available in this version", METHODS.into_iter()))
}

fn unknown<E: Error>(name: &str, is: &str, known: impl Iterator<Item = &'static str>) -> E {
    let known: Vec<&str> = known.collect();
    E::custom(format!("\"{name}\" is {is}: choose one of {}", known.join(", ")))
}

/// The levels in the schema of a scene.
#[cfg(test)]
pub(super) fn levels(_: &mut schemars::SchemaGenerator) -> schemars::Schema {
    let level = |(_, name, is): &(Interaction, &str, &str)| serde_json::json!({ "const": name, "type": "string", "description": format!("{is}.") });
    schemars::json_schema!({ "oneOf": Interaction::ALL.iter().map(level).collect::<Vec<_>>() })
}

/// The methods in the schema of a scene.
#[cfg(test)]
pub(super) fn methods(_: &mut schemars::SchemaGenerator) -> schemars::Schema {
    schemars::json_schema!({ "type": "string", "enum": METHODS })
}
