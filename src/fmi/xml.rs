//! `modelDescription.xml`, written from the table.

use std::io;

use quick_xml::Writer;
use quick_xml::events::{BytesDecl, BytesEnd, BytesStart, Event};

use super::dependency::DependencyKind;
use super::host_values::HostValues;
use super::log::Category;
use super::units::{QUANTITIES, UNITS};
use super::value::{DataType, Enumeration, Value};
use super::variable::{Causality, Variability, Variable};
use super::variables::Table;
use crate::error::Error;

/// Name of the model.
pub const MODEL_NAME: &str = "MagneticContinuumManipulator";
/// Name of the shared library in the archive, without its suffix.
pub const MODEL_IDENTIFIER: &str = "mcm";

const DESCRIPTION: &str = "Shape, tip angle and forces of a magnetic continuum manipulator from the pose of the \
                           external magnet";
const COPYRIGHT: &str = "Copyright (c) 2026 the mcm authors";
const TOOL: &str = concat!("mcm ", env!("CARGO_PKG_VERSION"));

/// The tolerance is the accuracy of the default discretisation (strain modes and pair quadrature), relative to the length
/// of the manipulator. The solver itself converges far more tightly, whatever tolerance the host sets.
const DEFAULT_EXPERIMENT: Attributes =
    &[("startTime", "0"), ("stopTime", "10"), ("tolerance", "1e-5"), ("stepSize", "0.01")];

pub(super) type Xml = Writer<Vec<u8>>;
type Attributes<'a> = &'a [(&'a str, &'a str)];

/// The text of the model description for a table with these start values.
///
/// `generated` is the date and time of generation in UTC (`2026-01-31T12:00:00Z`), if it shall be stated.
///
/// # Errors
/// [`Error::Syntax`] if the text cannot be written.
pub fn model_description(
    table: &Table,
    start: &HostValues,
    guid: &str,
    generated: Option<&str>,
) -> Result<String, Error> {
    text("modelDescription.xml", |xml| write(xml, table, start, guid, generated))
}

/// The text of an XML file with this content, indented.
///
/// # Errors
/// [`Error::Syntax`] if it cannot be written.
pub(super) fn text(file: &str, content: impl FnOnce(&mut Xml) -> io::Result<()>) -> Result<String, Error> {
    let refused = |reason: String| Error::Syntax { what: file.into(), reason };
    let mut xml = Writer::new_with_indent(Vec::new(), b' ', 2);
    let declaration = Event::Decl(BytesDecl::new("1.0", Some("UTF-8"), None));
    xml.write_event(declaration)
        .and_then(|()| content(&mut xml))
        .map_err(|error| refused(error.to_string()))?;
    let text = String::from_utf8(xml.into_inner()).map_err(|error| refused(error.to_string()))?;
    Ok(text + "\n")
}

fn write(
    xml: &mut Xml,
    table: &Table,
    start: &HostValues,
    guid: &str,
    generated: Option<&str>,
) -> io::Result<()> {
    let mut attributes = vec![
        ("fmiVersion", "2.0"),
        ("modelName", MODEL_NAME),
        ("guid", guid),
        ("description", DESCRIPTION),
        ("author", "the mcm authors"),
        ("version", env!("CARGO_PKG_VERSION")),
        ("copyright", COPYRIGHT),
        ("license", "MIT; see documentation/licenses"),
        ("generationTool", TOOL),
    ];

    attributes.extend(generated.map(|generated| ("generationDateAndTime", generated)));
    attributes.push(("variableNamingConvention", "structured"));

    // The order of the elements is that of the schema fmi2ModelDescription.xsd.
    within(xml, "fmiModelDescription", &attributes, |xml| {
        empty(xml, "ModelExchange", &capabilities(&[]))?;
        empty(xml, "CoSimulation", &capabilities(STEPPING))?;
        within(xml, "UnitDefinitions", &[], units)?;
        within(xml, "TypeDefinitions", &[], |xml| types(xml, table))?;
        within(xml, "LogCategories", &[], |xml| {
            Category::ALL.iter().try_for_each(|category| {
                empty(xml, "Category", &[("name", category.name()), ("description", category.description())])
            })
        })?;
        empty(xml, "DefaultExperiment", DEFAULT_EXPERIMENT)?;
        within(xml, "ModelVariables", &[], |xml| {
            (table.variables().iter().enumerate())
                .try_for_each(|(reference, variable)| scalar(xml, reference, variable, start))
        })?;
        within(xml, "ModelStructure", &[], |xml| structure(xml, table))
    })
}

/// What co-simulation offers beside what both interfaces have.
const STEPPING: Attributes = &[
    ("canHandleVariableCommunicationStepSize", "true"),
    ("canInterpolateInputs", "true"),
    ("maxOutputDerivativeOrder", "1"),
    ("canRunAsynchronuously", "false"),
];

/// The attributes of an interface, those of both first.
fn capabilities(own: Attributes<'static>) -> Vec<(&'static str, &'static str)> {
    let both = [
        ("modelIdentifier", MODEL_IDENTIFIER),
        ("needsExecutionTool", "false"),
        ("canBeInstantiatedOnlyOncePerProcess", "false"),
        ("canNotUseMemoryManagementFunctions", "true"),
        ("canGetAndSetFMUstate", "true"),
        ("canSerializeFMUstate", "true"),
        ("providesDirectionalDerivative", "true"),
    ];
    both.into_iter().chain(own.iter().copied()).collect()
}

fn units(xml: &mut Xml) -> io::Result<()> {
    for unit in UNITS {
        within(xml, "Unit", &[("name", unit.name)], |xml| {
            let exponents: Vec<_> =
                unit.base.iter().map(|(name, exponent)| (*name, exponent.to_string())).collect();
            let base: Vec<_> = exponents.iter().map(|(name, exponent)| (*name, exponent.as_str())).collect();
            empty(xml, "BaseUnit", &base)?;
            match unit.display {
                Some((name, factor)) => {
                    empty(xml, "DisplayUnit", &[("name", name), ("factor", &number(factor))])
                }
                None => Ok(()),
            }
        })?;
    }
    Ok(())
}

fn display_unit(unit: &str) -> Option<&'static str> {
    UNITS.iter().find(|known| known.name == unit)?.display.map(|(name, _)| name)
}

fn types(xml: &mut Xml, table: &Table) -> io::Result<()> {
    for quantity in QUANTITIES {
        let attributes = [("name", quantity.name), ("description", quantity.description)];
        within(xml, "SimpleType", &attributes, |xml| {
            let nominal = number(quantity.nominal);
            let mut real = vec![("quantity", quantity.name), ("unit", quantity.unit)];
            real.extend(display_unit(quantity.unit).map(|unit| ("displayUnit", unit)));
            real.push(("nominal", &nominal));
            empty(xml, "Real", &real)
        })?;
    }

    let mut enumerations: Vec<&Enumeration> = Vec::new();
    for variable in table.variables() {
        if let DataType::Enumeration(enumeration) = variable.data_type
            && !enumerations.contains(&enumeration)
        {
            enumerations.push(enumeration);
        }
    }

    for enumeration in enumerations {
        let attributes = [("name", enumeration.name), ("description", enumeration.description)];
        within(xml, "SimpleType", &attributes, |xml| {
            within(xml, "Enumeration", &[("quantity", enumeration.name)], |xml| {
                enumeration.items.iter().try_for_each(|item| {
                    let value = item.value.to_string();
                    let attributes =
                        [("name", item.name), ("value", value.as_str()), ("description", item.description)];
                    empty(xml, "Item", &attributes)
                })
            })
        })?;
    }
    Ok(())
}

fn causality(variable: &Variable) -> &'static str {
    match variable.causality {
        Causality::Input => "input",
        Causality::Parameter => "parameter",
        Causality::Output => "output",
        Causality::Local => "local",
    }
}

fn variability(variable: &Variable) -> &'static str {
    match variable.variability {
        Variability::Constant => "constant",
        Variability::Fixed => "fixed",
        Variability::Tunable => "tunable",
        Variability::Discrete => "discrete",
        Variability::Continuous => "continuous",
    }
}

/// How the value is determined before initialisation; the standard forbids the attribute for inputs.
fn initial(variable: &Variable) -> Option<&'static str> {
    match variable.causality {
        Causality::Input => None,
        Causality::Parameter => Some("exact"),
        Causality::Output | Causality::Local => {
            Some(if variable.is_result() { "calculated" } else { "exact" })
        }
    }
}

fn scalar(xml: &mut Xml, reference: usize, variable: &Variable, start: &HostValues) -> io::Result<()> {
    let reference = reference.to_string();
    let mut attributes = vec![
        ("name", variable.name.as_str()),
        ("valueReference", reference.as_str()),
        ("description", variable.description.as_str()),
        ("causality", causality(variable)),
        ("variability", variability(variable)),
    ];
    attributes.extend(initial(variable).map(|initial| ("initial", initial)));

    within(xml, "ScalarVariable", &attributes, |xml| {
        let integral = matches!(variable.data_type, DataType::Integer | DataType::Enumeration(_));
        let bound = |bound: f64| if integral { format!("{bound:.0}") } else { number(bound) };
        let (min, max) = (variable.min.map(bound), variable.max.map(bound));
        let start = variable.host_value(start).map(|value| match value {
            Value::Real(value) => number(value),
            Value::Integer(value) => value.to_string(),
            Value::Boolean(value) => value.to_string(),
        });

        let (element, mut attributes) = match &variable.data_type {
            DataType::Real(quantity) => {
                let mut attributes = vec![("declaredType", quantity.name), ("unit", quantity.unit)];
                attributes.extend(display_unit(quantity.unit).map(|unit| ("displayUnit", unit)));
                ("Real", attributes)
            }
            DataType::Integer => ("Integer", vec![]),
            DataType::Boolean => ("Boolean", vec![]),
            DataType::Enumeration(enumeration) => ("Enumeration", vec![("declaredType", enumeration.name)]),
        };

        let optional = [("min", min), ("max", max), ("start", start)];
        attributes.extend(optional.iter().filter_map(|(name, value)| Some((*name, value.as_deref()?))));
        empty(xml, element, &attributes)
    })
}

fn structure(xml: &mut Xml, table: &Table) -> io::Result<()> {
    within(xml, "Outputs", &[], |xml| unknowns(xml, table, &[Causality::Input]))?;
    within(xml, "InitialUnknowns", &[], |xml| unknowns(xml, table, &[Causality::Input, Causality::Parameter]))
}

/// All outputs, each with those variables of the causalities `known` on which it depends.
fn unknowns(xml: &mut Xml, table: &Table, known: &[Causality]) -> io::Result<()> {
    let rows = || (1..).zip(table.variables());
    for (index, output) in rows().filter(|(_, variable)| variable.causality == Causality::Output) {
        let dependencies = rows().filter(|(_, variable)| known.contains(&variable.causality)).filter_map(
            |(index, variable): (usize, _)| Some((index.to_string(), output.depends_on(variable)?)),
        );
        let (indices, kinds): (Vec<_>, Vec<_>) = dependencies.unzip();
        let (index, indices) = (index.to_string(), indices.join(" "));
        let mut attributes = vec![("index", index.as_str()), ("dependencies", indices.as_str())];
        // Where the attribute is missing, every kind is `dependent`.
        let special = kinds.iter().any(|kind| *kind != DependencyKind::Dependent);
        let names = special.then(|| kinds.iter().map(|kind| kind.name()).collect::<Vec<_>>().join(" "));
        attributes.extend(names.as_deref().map(|names| ("dependenciesKind", names)));
        empty(xml, "Unknown", &attributes)?;
    }
    Ok(())
}

/// The shortest text that reads back as the same number.
fn number(value: f64) -> String {
    format!("{value:?}")
}

fn element<'a>(name: &'a str, attributes: Attributes<'a>) -> BytesStart<'a> {
    BytesStart::new(name).with_attributes(attributes.iter().copied())
}

pub(super) fn empty(xml: &mut Xml, name: &str, attributes: Attributes) -> io::Result<()> {
    xml.write_event(Event::Empty(element(name, attributes)))
}

pub(super) fn within(
    xml: &mut Xml,
    name: &str,
    attributes: Attributes,
    content: impl FnOnce(&mut Xml) -> io::Result<()>,
) -> io::Result<()> {
    xml.write_event(Event::Start(element(name, attributes)))?;
    content(xml)?;
    xml.write_event(Event::End(BytesEnd::new(name)))
}
