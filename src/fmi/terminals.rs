//! `terminalsAndIcons/terminalsAndIcons.xml` (FMI 2.0.4, section 2.3; FMI 3.0, section 2.4.9), written from the table: which
//! inputs and outputs belong together, so that a host can connect a magnet or a coil as one.

use std::io;

use super::variable::{Causality, Variable};
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

/// The part of a structured name before its first dot, and the rest.
fn split(variable: &Variable) -> Option<(&str, &str)> {
    variable.name.split_once('.')
}

fn write(xml: &mut Xml, table: &Table) -> io::Result<()> {
    let connected = |causality: Causality| matches!(causality, Causality::Input | Causality::Output);
    // What has no input is there to be read, not to be connected.
    let mut names: Vec<&str> = Vec::new();
    for variable in table.variables().iter().filter(|variable| variable.causality == Causality::Input) {
        if let Some((name, _)) = split(variable)
            && !names.contains(&name)
        {
            names.push(name);
        }
    }
    within(xml, "fmiTerminalsAndIcons", &[("fmiVersion", "3.0")], |xml| {
        within(xml, "GraphicalRepresentation", &[], |xml| {
            let square = [("x1", "-100"), ("y1", "-100"), ("x2", "100"), ("y2", "100")];
            let scaled = square.into_iter().chain([("suggestedScalingFactorTo_mm", "0.1")]);
            empty(xml, "CoordinateSystem", &scaled.collect::<Vec<_>>())?;
            empty(xml, "Icon", &square)
        })?;
        within(xml, "Terminals", &[], |xml| {
            names.iter().try_for_each(|terminal| {
                let described = format!("Inputs and outputs of {terminal}");
                let attributes =
                    [("name", *terminal), ("matchingRule", "bus"), ("description", described.as_str())];
                within(xml, "Terminal", &attributes, |xml| {
                    let members = table.variables().iter().filter(|variable| connected(variable.causality));
                    members.filter_map(|variable| Some((variable, split(variable)?))).try_for_each(
                        |(variable, (name, member))| {
                            if name != *terminal {
                                return Ok(());
                            }
                            let attributes = [
                                ("variableName", variable.name.as_str()),
                                ("memberName", member),
                                ("variableKind", "signal"),
                            ];
                            empty(xml, "TerminalMemberVariable", &attributes)
                        },
                    )
                })
            })
        })
    })
}
