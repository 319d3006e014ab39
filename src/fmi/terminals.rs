//! `terminalsAndIcons/terminalsAndIcons.xml` (FMI 2.0.4, section 2.3; FMI 3.0, section 2.4.9), written from the table: which
//! inputs and outputs belong together, so that a host can connect a magnet or a coil as one.

use std::io;

use super::variable::Causality;
use super::variables::Table;
use super::xml::{Xml, empty, text, within};
use crate::error::Error;

/// The text of the file.
///
/// # Errors
/// [`Error::Syntax`] if it cannot be written.
pub fn terminals(table: &Table) -> Result<String, Error> {
    text("terminalsAndIcons.xml", |xml| write(xml, table))
}

fn write(xml: &mut Xml, table: &Table) -> io::Result<()> {
    within(xml, "fmiTerminalsAndIcons", &[("fmiVersion", "3.0")], |xml| {
        within(xml, "GraphicalRepresentation", &[], |xml| {
            let square = [("x1", "-100"), ("y1", "-100"), ("x2", "100"), ("y2", "100")];
            let scaled = square.into_iter().chain([("suggestedScalingFactorTo_mm", "0.1")]);
            empty(xml, "CoordinateSystem", &scaled.collect::<Vec<_>>())?;
            empty(xml, "Icon", &square)
        })?;
        within(xml, "Terminals", &[], |xml| {
            terminal_names(table).into_iter().try_for_each(|name| terminal(xml, table, name))
        })
    })
}

/// The parts of the inputs' structured names before the first dot. What has no input is there to be read, not to be connected.
fn terminal_names(table: &Table) -> Vec<&str> {
    let mut names: Vec<&str> = Vec::new();
    for variable in table.variables().iter().filter(|variable| variable.causality == Causality::Input) {
        if let Some((name, _)) = variable.name.split_once('.')
            && !names.contains(&name)
        {
            names.push(name);
        }
    }
    names
}

/// One terminal with the inputs and outputs whose names begin with its own.
fn terminal(xml: &mut Xml, table: &Table, name: &str) -> io::Result<()> {
    let described = format!("Inputs and outputs of {name}");
    let attributes = [("name", name), ("matchingRule", "bus"), ("description", described.as_str())];
    within(xml, "Terminal", &attributes, |xml| {
        for variable in table.variables() {
            let connected = matches!(variable.causality, Causality::Input | Causality::Output);
            let member = variable.name.strip_prefix(name).and_then(|rest| rest.strip_prefix('.'));
            if let Some(member) = member.filter(|_| connected) {
                let attributes = [
                    ("variableName", variable.name.as_str()),
                    ("memberName", member),
                    ("variableKind", "signal"),
                ];
                empty(xml, "TerminalMemberVariable", &attributes)?;
            }
        }
        Ok(())
    })
}
