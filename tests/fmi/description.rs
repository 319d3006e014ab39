//! The model description, as far as no validator looks.

use mcm::fmi::Package;
use quick_xml::Reader;
use quick_xml::events::{BytesStart, Event};

const CHECKED_IN: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/modelDescription/modelDescription.xml");

/// The elements of a text, each with its attributes.
fn elements(text: &str) -> Vec<(String, Vec<(String, String)>)> {
    let mut reader = Reader::from_str(text);
    let mut found = Vec::new();
    let attributes = |start: &BytesStart| {
        let name = start.name().as_ref().to_owned();
        let pairs = start.attributes().map(|attribute| {
            let attribute = attribute.unwrap();
            (attribute.key.as_ref().to_owned(), attribute.value.into_owned())
        });
        (name, pairs.collect())
    };
    loop {
        match reader.read_event().unwrap() {
            Event::Start(start) | Event::Empty(start) => found.push(attributes(&start)),
            Event::Eof => return found,
            _ => {}
        }
    }
}

fn attribute<'a>(attributes: &'a [(String, String)], name: &str) -> Option<&'a str> {
    attributes.iter().find(|(key, _)| key == name).map(|(_, value)| value.as_str())
}

/// `MCM_WRITE=1 cargo test checked_in_description` writes it anew.
#[test]
fn checked_in_description_is_that_of_the_default_fmu() {
    let written = Package::built_in().unwrap().model_description(None).unwrap();
    if std::env::var_os("MCM_WRITE").is_some() {
        std::fs::write(CHECKED_IN, &written).unwrap();
    }
    let kept = std::fs::read_to_string(CHECKED_IN).unwrap();
    assert!(written == kept, "{CHECKED_IN} differs: MCM_WRITE=1 cargo test checked_in_description");
}

#[test]
fn variables_stand_in_the_order_of_the_table() {
    let package = Package::built_in().unwrap();
    let text = package.model_description(Some("2026-01-31T12:00:00Z")).unwrap();
    assert!(text.contains("generationDateAndTime=\"2026-01-31T12:00:00Z\""));
    let elements = elements(&text);
    let scalars: Vec<_> = elements.iter().filter(|(name, _)| name == "ScalarVariable").collect();
    assert_eq!(scalars.len(), package.table().variables().len());
    for (row, ((_, attributes), variable)) in scalars.iter().zip(package.table().variables()).enumerate() {
        assert_eq!(attribute(attributes, "name"), Some(variable.name.as_str()));
        assert_eq!(attribute(attributes, "valueReference"), Some(row.to_string().as_str()));
    }
}

#[test]
fn unknowns_are_sorted_and_every_output_is_in_both_lists() {
    let package = Package::built_in().unwrap();
    let text = package.model_description(None).unwrap();
    let elements = elements(&text);
    let outputs: Vec<usize> = (1..)
        .zip(elements.iter().filter(|(name, _)| name == "ScalarVariable"))
        .filter(|(_, (_, attributes))| attribute(attributes, "causality") == Some("output"))
        .map(|(index, _)| index)
        .collect();
    let index = |attributes: &[(String, String)]| attribute(attributes, "index").unwrap().parse().unwrap();
    let unknowns: Vec<usize> = elements
        .iter()
        .filter(|(name, _)| name == "Unknown")
        .map(|(_, attributes)| index(attributes))
        .collect();
    assert_eq!(unknowns, [outputs.clone(), outputs.clone()].concat());
    for (_, attributes) in elements.iter().filter(|(name, _)| name == "Unknown") {
        let list = |name: &str| attribute(attributes, name).map(|text| text.split_whitespace().count());
        let known: Vec<usize> = attribute(attributes, "dependencies")
            .unwrap()
            .split_whitespace()
            .map(|i| i.parse().unwrap())
            .collect();
        assert!(known.is_sorted() && known.iter().all(|index| !outputs.contains(index)));
        assert!(list("dependenciesKind").is_none_or(|kinds| kinds == known.len()));
    }
}

#[test]
fn a_load_on_a_clamped_ring_reaches_the_clamp_only() {
    let package = Package::built_in().unwrap();
    let table = package.table();
    let text = package.model_description(None).unwrap();
    let index = |name: &str| (table.reference(name).unwrap() + 1).to_string();
    let depends = |output: &str, input: &str| {
        let elements = elements(&text);
        let (_, attributes) = (elements.iter())
            .find(|(name, attributes)| {
                name == "Unknown" && attribute(attributes, "index") == Some(index(output).as_str())
            })
            .unwrap();
        attribute(attributes, "dependencies").unwrap().split_whitespace().any(|known| known == index(input))
    };
    assert!(depends("base.reaction_force[1]", "ring[1].load_force[1]"));
    assert!(!depends("tip.angle", "ring[1].load_force[1]"));
    assert!(depends("tip.angle", "ring[2].load_force[1]"));
    assert!(depends("shape.position[1,2]", "base.position[2]"));
    assert!(!depends("shape.position[1,2]", "base.position[1]"));
    assert!(!depends("shape.arc_length[2]", "magnet.strength"));
}

#[test]
fn capabilities_are_those_of_the_functions() {
    let text = Package::built_in().unwrap().model_description(None).unwrap();
    for promise in [
        "fmiVersion=\"2.0\"",
        "modelIdentifier=\"mcm\"",
        "canGetAndSetFMUstate=\"true\"",
        "canSerializeFMUstate=\"true\"",
        "providesDirectionalDerivative=\"true\"",
        "canHandleVariableCommunicationStepSize=\"true\"",
        "canInterpolateInputs=\"true\"",
        "maxOutputDerivativeOrder=\"1\"",
        "canRunAsynchronuously=\"false\"",
        "canBeInstantiatedOnlyOncePerProcess=\"false\"",
        "canNotUseMemoryManagementFunctions=\"true\"",
    ] {
        assert!(text.contains(promise), "{promise}");
    }
}
