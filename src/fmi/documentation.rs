//! `documentation/index.html`: conventions, limits and all variables, the latter written from the table.

use std::fmt::Write as _;

use quick_xml::escape::escape;

use super::host_values::HostValues;
use super::value::{DataType, Item, Value};
use super::variable::Variable;
use super::variables::Table;

/// The page above the table of variables.
const PREAMBLE: &str = include_str!("../../modelDescription/preamble.html");

/// What the variables are about whose names begin so.
const GROUPS: [(&str, &str); 19] = [
    ("magnet", "External magnets"),
    ("coil", "Coils"),
    ("field", "Uniform field and gradient, and the field at the tip"),
    ("base", "Pose of the clamped end, or of the port"),
    ("feed", "Feeding"),
    ("guidewire", "Guidewire"),
    ("tip", "Tip"),
    ("ring", "Rings"),
    ("core", "Cores"),
    ("shape", "Centreline"),
    ("force", "Force of the external field"),
    ("torque", "Torque of the external field"),
    ("contact", "Contact with the wall of the vessel"),
    ("vessel", "Vessel"),
    ("gravity", "Gravity"),
    ("design", "Design"),
    ("model", "Model"),
    ("stability", "Stability"),
    ("solver", "Solver"),
];

/// The first word of a structured name: `ring` of `ring[3].position[1]`.
fn group(variable: &Variable) -> &str {
    variable.name.split(['.', '[']).next().unwrap_or_default()
}

/// The text of the page for a table with these start values.
#[must_use]
pub fn page(table: &Table, start: &HostValues) -> String {
    let mut page = PREAMBLE.replace("{version}", env!("CARGO_PKG_VERSION"));
    let mut groups: Vec<&str> = Vec::new();
    for variable in table.variables() {
        if !groups.contains(&group(variable)) {
            groups.push(group(variable));
        }
    }
    for of in groups {
        let title = GROUPS.iter().find(|(name, _)| *name == of).map_or(of, |(_, title)| title);
        // Writing to a string cannot fail.
        let _ = writeln!(page, "<h3 id=\"{of}\">{title}</h3>\n<table>\n{HEAD}");
        for variable in table.variables().iter().filter(|variable| group(variable) == of) {
            row(&mut page, variable, start);
        }
        page.push_str("</table>\n");
    }
    page.push_str("</body>\n</html>\n");
    page
}

const HEAD: &str = "<tr><th>variable</th><th>role</th><th>unit</th><th>start</th><th>meaning</th></tr>";

fn row(page: &mut String, variable: &Variable, start: &HostValues) {
    let causality = variable.causality_in_words();
    let unit = match variable.data_type {
        DataType::Real(quantity) => quantity.unit.to_owned(),
        DataType::Integer => "integer".to_owned(),
        DataType::Boolean => "true or false".to_owned(),
        // Hosts show and set the number.
        DataType::Enumeration(enumeration) => {
            let item = |item: &Item| format!("{} {}", item.value, item.name);
            enumeration.items.iter().map(item).collect::<Vec<_>>().join(", ")
        }
    };
    let start = match variable.host_value(start) {
        Some(Value::Real(value)) => format!("{value:?}"),
        Some(Value::Integer(value)) => value.to_string(),
        Some(Value::Boolean(value)) => value.to_string(),
        None => String::new(),
    };
    let (name, meaning) = (escape(variable.name.as_str()), escape(variable.description.as_str()));
    // Writing to a string cannot fail.
    let _ = writeln!(
        page,
        "<tr><td><code>{name}</code></td><td>{causality}</td><td>{unit}</td><td>{start}</td><td>{meaning}</td></tr>"
    );
}
