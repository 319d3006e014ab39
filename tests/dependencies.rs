//! The library alone needs few other crates; all that the program and the studies need comes with their features.

use toml::{Table, Value};

/// What the library and the FMU are made with.
const OF_THE_LIBRARY: [&str; 11] = [
    "cpu-time",
    "crc32fast",
    "libc",
    "multiversion",
    "nalgebra",
    "postcard",
    "quick-xml",
    "serde",
    "strsim",
    "thiserror",
    "toml",
];

/// The names of the dependencies without which nothing is built, on some target at least.
fn always_needed(manifest: &str) -> Vec<String> {
    let manifest: Table = manifest.parse().unwrap();
    let optional = |dependency: &Value| dependency.get("optional").and_then(Value::as_bool) == Some(true);
    let of_targets = manifest.get("target").and_then(Value::as_table).into_iter().flat_map(Table::values);
    let mut needed: Vec<String> = [&manifest["dependencies"]]
        .into_iter()
        .chain(of_targets.filter_map(|target| target.get("dependencies")))
        .flat_map(|dependencies| dependencies.as_table().unwrap())
        .filter(|(_, dependency)| !optional(dependency))
        .map(|(name, _)| name.clone())
        .collect();
    needed.sort();
    needed
}

#[test]
fn what_the_library_does_not_need_is_optional() {
    assert_eq!(always_needed(include_str!("../Cargo.toml")), OF_THE_LIBRARY);
}

#[test]
fn a_dependency_is_needed_unless_it_is_optional() {
    let manifest = "[dependencies]\na = \"1\"\nb = { version = \"1\", optional = true }\nc = { version = \"1\", optional = false }";
    assert_eq!(always_needed(manifest), ["a", "c"]);
    let manifest = "[dependencies]\nb = \"1\"\n[target.'cfg(unix)'.dependencies]\na = \"1\"";
    assert_eq!(always_needed(manifest), ["a", "b"]);
}
