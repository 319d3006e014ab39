//! The model description, as far as no validator looks.

use mcm::fmi::Package;
use mcm::fmi::variable::Causality;
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
fn elements_of_vectors_say_what_they_are_and_in_which_frame() {
    let described = |name: &str| {
        let package = Package::new("[design]\nsegments = 3", "three", 3).unwrap();
        let table = package.table();
        table.find(table.reference(name).unwrap()).unwrap().description.clone()
    };
    for (name, element) in [
        ("magnet.position[2]", "y, world frame"),
        ("magnet.orientation[1]", "w (scalar), body to world"),
        ("base.orientation[4]", "z, body to world"),
        ("field.gradient[5]", "dBy/dz = dBz/dy, world frame"),
        ("ring[2].load_force[3]", "z, world frame"),
        ("tip.position[1]", "x, world frame"),
        ("gravity[2]", "y, world frame"),
    ] {
        let description = described(name);
        assert!(description.ends_with(&format!(": {element}")), "{name}: {description}");
    }
    // A list of three angles is no vector.
    assert!(!described("design.spiral_start[3]").contains("frame"));
}

#[test]
fn inputs_have_the_bounds_that_the_fmu_holds_them_to() {
    let scene = "[design]\nsegments = 1\n[feed]\nmode = \"insertion\"\n[feed.shaft]\nouter_radius_mm = 0.7\n\
                 inner_radius_mm = 0.3\nshore_a = 40.0\npoisson = 0.4\n[guidewire]\nradius_mm = 0.2\n\
                 elastic_modulus_mpa = 1000.0\n[[coil]]\nposition_mm = [0, 80, 0]\ninner_radius_mm = 10\n\
                 outer_radius_mm = 20\nlength_mm = 20\nturns = 100";
    let package = Package::new(scene, "bounds", 3).unwrap();
    let table = package.table();
    for (name, bounds) in [
        ("magnet.orientation[1]", Some([-1.0, 1.0])),
        ("base.orientation[4]", Some([-1.0, 1.0])),
        ("coil[1].orientation[2]", Some([-1.0, 1.0])),
        ("feed.insertion", Some([0.0, 1.0])),
        ("guidewire.insertion", Some([0.0, 2.0])),
        ("magnet.position[1]", None),
        ("coil[1].current", None),
    ] {
        let variable = table.find(table.reference(name).unwrap()).unwrap();
        assert_eq!(variable.min.zip(variable.max).map(|(min, max)| [min, max]), bounds, "{name}");
    }
    let text = package.model_description(None).unwrap();
    for (name, attributes) in
        elements(&text).iter().filter(|(name, _)| name == "SimpleType" || name == "Real")
    {
        let nominal =
            attribute(attributes, "nominal").is_some() || attribute(attributes, "declaredType").is_some();
        assert!(name == "SimpleType" || nominal, "{attributes:?}");
    }
}

#[test]
fn the_centreline_has_directions_and_curvatures_in_their_units_and_frames() {
    let text = Package::built_in().unwrap().model_description(None).unwrap();
    let elements = elements(&text);
    for (name, unit, frame) in [
        ("shape.position[21,3]", "m", "z, world frame"),
        ("shape.tangent[1,1]", "1", "x, world frame"),
        ("shape.tangent[21,3]", "1", "z, world frame"),
        ("shape.curvature[1,1]", "1/m", "u1, about d1"),
        ("shape.curvature[21,3]", "1/m", "u3, twist about d3"),
    ] {
        let named = |(_, attributes): &(String, Vec<_>)| attribute(attributes, "name") == Some(name);
        let row = elements.iter().position(named).unwrap_or_else(|| panic!("no {name}"));
        let description = attribute(&elements[row].1, "description").unwrap();
        assert!(description.ends_with(&format!(": {frame}")), "{name}: {description}");
        assert_eq!(attribute(&elements[row].1, "causality"), Some("output"), "{name}");
        let (element, attributes) = &elements[row + 1];
        assert_eq!((element.as_str(), attribute(attributes, "unit")), ("Real", Some(unit)), "{name}");
    }
}

/// Names of the inputs and parameters on which a variable depends, with the kind of each dependency.
fn dependencies(scene: &str, output: &str) -> Vec<(String, &'static str)> {
    let package = Package::new(scene, "test scene", 3).unwrap();
    let table = package.table();
    let output = table.find(table.reference(output).unwrap()).unwrap();
    let knowns = table
        .variables()
        .iter()
        .filter(|variable| matches!(variable.causality, Causality::Input | Causality::Parameter));
    knowns.filter_map(|known| Some((known.name.clone(), output.depends_on(known)?.name()))).collect()
}

#[test]
fn an_output_that_the_equilibrium_does_not_move_depends_on_what_it_is_made_of() {
    let chain = "[design]\nsegments = 2";
    let free = "[design]\nsegments = 2\nbase_magnet = false";
    let rod = "[design]\nkind = \"cylinder\"\nlength_mm = 10.0\nradius_mm = 1.0\nshore_a = 33.0";
    let orientation = [1, 2, 3, 4].map(|number| format!("base.orientation[{number}]"));
    let orientation = orientation.each_ref().map(|name| (name.as_str(), "dependent"));
    let lengths = [("design.helix.length", "dependent"), ("design.ring.length", "dependent")];
    let position = [("base.position[2]", "constant")];
    let centre = [&position[..], &orientation, &lengths[1..]].concat();
    for (scene, output, expected) in [
        (chain, "shape.position[1,2]", &position[..]),
        (chain, "shape.arc_length[2]", &lengths),
        (rod, "shape.arc_length[2]", &[("design.cylinder.length", "dependent")]),
        (chain, "ring[1].position[2]", &centre),
        (chain, "ring[1].axis[2]", &orientation),
    ] {
        let found = dependencies(scene, output);
        let found: Vec<_> = found.iter().map(|(name, kind)| (name.as_str(), *kind)).collect();
        assert_eq!(found, expected, "{output}");
    }
    let reaction = dependencies(chain, "base.reaction_force[1]");
    let constant: Vec<_> = reaction.iter().filter(|(_, kind)| *kind == "constant").collect();
    assert_eq!(constant, [&("ring[1].load_force[1]".to_owned(), "constant")]);
    assert!(dependencies(chain, "base.reaction_moment[1]").iter().all(|(_, kind)| *kind == "dependent"));
    let all = dependencies(chain, "base.reaction_moment[1]").len();
    assert_eq!(reaction.len(), all - 2, "the force across does not act on this component");
    assert_eq!(dependencies(chain, "tip.angle").len(), all - 3, "all but the force on the clamped ring");
    assert_eq!(dependencies(chain, "ring[2].position[1]").len(), all - 3);
    let all = dependencies(free, "base.reaction_force[1]").len();
    assert_eq!(dependencies(free, "ring[1].position[1]").len(), all, "no ring is clamped");
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
