//! `documentation/index.html`: conventions, limits and all variables, the latter written from the table.

use std::fmt::Write as _;

use quick_xml::escape::escape;

use super::host_values::HostValues;
use super::value::{DataType, Item, Value};
use super::variables::Table;

/// The page above the table of variables.
const PREAMBLE: &str = include_str!("../../modelDescription/preamble.html");

/// The text of the page for a table with these start values.
#[must_use]
pub fn page(table: &Table, start: &HostValues) -> String {
    let mut page = PREAMBLE.replace("{version}", env!("CARGO_PKG_VERSION"));
    page.push_str(
        "<table>\n<tr><th>variable</th><th>role</th><th>unit</th><th>start</th><th>meaning</th></tr>\n",
    );
    for variable in table.variables() {
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
    page.push_str("</table>\n</body>\n</html>\n");
    page
}
