//! `documentation/index.html`: conventions, limits and all variables, written from the table.

use std::fmt::Write as _;

use quick_xml::escape::escape;

use super::given::Given;
use super::variable::{Kind, Role, Value};
use super::variables::Table;

/// What stands above the table of variables.
const PREAMBLE: &str = include_str!("../../modelDescription/preamble.html");

/// The page for one table.
#[must_use]
pub fn page(table: &Table, start: &Given) -> String {
    let mut page = PREAMBLE.replace("{version}", env!("CARGO_PKG_VERSION"));
    page.push_str(
        "<table>\n<tr><th>variable</th><th>role</th><th>unit</th><th>start</th><th>meaning</th></tr>\n",
    );
    for variable in table.variables() {
        let role = match variable.role {
            Role::Input => "input",
            Role::Fixed => "fixed parameter",
            Role::Tunable => "tunable parameter",
            Role::Constant => "constant",
            Role::Output => "output",
        };
        let unit = match variable.kind {
            Kind::Real(quantity) => quantity.unit,
            Kind::Integer => "integer",
            Kind::Boolean => "true or false",
            Kind::Enumeration(enumeration) => enumeration.name,
        };
        let start = match variable.given(start) {
            Some(Value::Real(value)) => format!("{value:?}"),
            Some(Value::Integer(value)) => value.to_string(),
            Some(Value::Boolean(value)) => value.to_string(),
            None => String::new(),
        };
        let (name, meaning) = (escape(variable.name.as_str()), escape(variable.description.as_str()));
        // Writing to a string cannot fail.
        let _ = writeln!(
            page,
            "<tr><td><code>{name}</code></td><td>{role}</td><td>{unit}</td><td>{start}</td><td>{meaning}</td></tr>"
        );
    }
    page.push_str("</table>\n</body>\n</html>\n");
    page
}
