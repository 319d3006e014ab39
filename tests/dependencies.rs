//! The library alone needs few other crates; all that the program and the studies need comes with their features. No crate
//! draws pixels or letters.

use std::collections::BTreeSet;

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

/// Crates that draw pixels or letters.
const OF_PIXELS: [&str; 6] = ["plotters", "png", "image", "tiny-skia", "ab_glyph", "ttf-parser"];

/// Every crate that is built for the program, as the lock file has it.
fn built(manifest: &str, lock: &str) -> BTreeSet<String> {
    let (manifest, lock): (Table, Table) = (manifest.parse().unwrap(), lock.parse().unwrap());
    let packages = lock["package"].as_array().unwrap();
    let mut next: Vec<String> = manifest["dependencies"].as_table().unwrap().keys().cloned().collect();
    let mut found = BTreeSet::new();
    while let Some(name) = next.pop() {
        if !found.insert(name.clone()) {
            continue;
        }
        let own = packages.iter().filter(|package| package["name"].as_str() == Some(name.as_str()));
        for needed in own.filter_map(|package| package.get("dependencies")?.as_array()).flatten() {
            // A name may be followed by a version.
            next.push(needed.as_str().unwrap().split(' ').next().unwrap().to_owned());
        }
    }
    found
}

#[test]
fn the_program_draws_no_pixels() {
    let found = built(include_str!("../Cargo.toml"), include_str!("../Cargo.lock"));
    assert!(found.len() > 100 && found.contains("svg") && found.contains("simba"), "{}", found.len());
    let drawing: Vec<&str> = OF_PIXELS.into_iter().filter(|name| found.contains(*name)).collect();
    assert!(drawing.is_empty(), "{drawing:?}");
}

#[test]
fn what_a_dependency_needs_is_built_too() {
    let lock = "[[package]]\nname = \"a\"\ndependencies = [\"b 1.0.0\"]\n[[package]]\nname = \"b\"\n[[package]]\nname = \"c\"";
    let found = built("[dependencies]\na = \"1\"\n[dev-dependencies]\nc = \"1\"", lock);
    assert_eq!(found.into_iter().collect::<Vec<_>>(), ["a", "b"]);
}
