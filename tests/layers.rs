//! A module of `src` uses only the modules that the table below allows, files stay short, and names say what is inside.

use std::collections::{BTreeMap, BTreeSet};
use std::fs;
use std::path::{Path, PathBuf};

/// The modules in order, and what each may use; what those may use is allowed too.
const MODULES: [(&str, &[&str]); 18] = [
    ("constants", &[]),
    ("error", &[]),
    ("numerics", &["constants", "error"]),
    ("geometry", &["numerics"]),
    ("vessel", &["geometry"]),
    ("design", &["geometry"]),
    ("magnetics", &["design"]),
    ("rod", &["design"]),
    ("equilibrium", &["magnetics", "rod", "vessel"]),
    ("manipulator", &["equilibrium"]),
    ("methods", &["manipulator"]),
    ("uncertainty", &["manipulator"]),
    ("steer", &["manipulator"]),
    ("fit", &["manipulator"]),
    ("studies", &["methods", "uncertainty"]),
    ("fmi", &["manipulator"]),
    ("web", &["fmi"]),
    ("bin", &["studies", "steer", "fit", "fmi"]),
];

const LONGEST_FILE: usize = 400;

/// Names that say nothing about what is inside.
const EMPTY_NAMES: [&str; 7] = ["util", "utils", "common", "helper", "helpers", "misc", "shared"];

/// Written by bindgen, not by hand.
const GENERATED: [&str; 1] = ["src/fmi/bindings.rs"];

/// What may lie at the top level, beside what the scripts leave there.
const TOP_LEVEL: [&str; 10] = [
    "CITATION.cff", // where GitHub looks for it
    "Cargo.toml",
    "Cargo.lock",
    "LICENSE",
    "README.md",
    "build.rs",
    "src",
    "modelDescription",
    "fmu",
    "tests",
];
const LEFT_BY_SCRIPTS: [&str; 6] =
    ["target", "mcm_demo.csv", "mcm_demo.gif", "mcm_demo.png", "mcm_live.html", "logs"];

fn allowed(module: &str) -> BTreeSet<&'static str> {
    let direct = MODULES.iter().find(|(name, _)| *name == module).map_or(&[][..], |(_, direct)| direct);
    direct.iter().flat_map(|&other| allowed(other).into_iter().chain([other])).collect()
}

/// What the file at `path` (from the package's folder) with this text does wrong, in words.
fn violations(path: &Path, text: &str) -> Vec<String> {
    let mut found = Vec::new();
    let name = path.display();
    let lines = text.lines().count();
    if lines > LONGEST_FILE && !GENERATED.iter().any(|generated| path == Path::new(generated)) {
        found.push(format!("{name} has {lines} lines, more than {LONGEST_FILE}: split it"));
    }
    for part in path.iter().map(|part| part.to_string_lossy()) {
        let stem = part.split('.').next().unwrap_or_default();
        if EMPTY_NAMES.contains(&stem) {
            found.push(format!("{name}: `{stem}` says nothing about what is inside"));
        }
    }
    let modules = modules(path);
    if path.starts_with("src") && path != Path::new("src/lib.rs") {
        let module = modules[0].as_str();
        if !MODULES.iter().any(|(known, _)| *known == module) {
            found.push(format!("{name}: `src` has no module `{module}`"));
        }
        let may_use = allowed(module);
        for used in modules_used(text, modules.len()) {
            let is_module = MODULES.iter().any(|(known, _)| *known == used);
            if is_module && used != module && !may_use.contains(used.as_str()) {
                found.push(format!("{name}: `{module}` must not use `{used}`"));
            }
        }
    }
    found
}

/// The modules that lead to a file of `src`: `src/rod/element.rs` is `rod`, `element`.
fn modules(path: &Path) -> Vec<String> {
    let stem = path.with_extension("");
    let parts = stem.iter().skip(1).map(|part| part.to_string_lossy().into_owned());
    parts.filter(|part| part != "mod").collect()
}

/// Every name directly under the crate that the code (not its comments) mentions; the file is `depth` modules deep.
fn modules_used(text: &str, depth: usize) -> BTreeSet<String> {
    names_below(text, &["crate::".into(), "super::".repeat(depth)])
}

/// Every name directly under one of these paths that the code (not its comments) mentions.
fn names_below(text: &str, roots: &[String]) -> BTreeSet<String> {
    let code = code(text);
    let mut used = BTreeSet::new();
    for root in roots {
        for (start, _) in code.match_indices(root.as_str()) {
            let before = code[..start].chars().next_back();
            // `super::super::` also ends in `super::`; a name may end in `crate`.
            if before.is_some_and(|c| c == ':' || c == '_' || c.is_alphanumeric())
                && !code[..start].ends_with("use")
            {
                continue;
            }
            used.extend(heads(&code[start + root.len()..]));
        }
    }
    used
}

/// The text without comments and white space.
fn code(text: &str) -> String {
    let code: String = text.lines().map(|line| line.split("//").next().unwrap_or_default()).collect();
    code.split_whitespace().collect()
}

/// What the code of a file (from the package's folder) mentions of the folder whose modules are `folder`, in which it lies,
/// itself or in a folder there; first the file, or that folder, itself.
fn neighbours_used(path: &Path, text: &str, folder: &[String]) -> (String, BTreeSet<String>) {
    let own = modules(path);
    let roots = ["super::".repeat(own.len() - folder.len()), format!("crate::{}::", folder.join("::"))];
    let (name, mut used) = (own[folder.len()].clone(), names_below(text, &roots));
    used.remove(&name);
    (name, used)
}

/// Those of the files and folders of one folder, each with what it uses beside it, that need one another in a circle.
fn circle(mut files: BTreeMap<String, BTreeSet<String>>) -> Vec<String> {
    loop {
        let names: BTreeSet<String> = files.keys().cloned().collect();
        let used: BTreeSet<String> = files.values().flatten().cloned().collect();
        files.retain(|name, uses| used.contains(name) && uses.iter().any(|other| names.contains(other)));
        if files.len() == names.len() {
            return files.into_keys().collect();
        }
    }
}

/// The first names of a path or of each path of a `{...}` group.
fn heads(path: &str) -> Vec<String> {
    let identifier =
        |text: &str| -> String { text.chars().take_while(|c| c.is_alphanumeric() || *c == '_').collect() };
    let Some(group) = path.strip_prefix('{') else { return vec![identifier(path)] };
    let (mut level, mut names, mut at_start) = (0, Vec::new(), true);
    for (index, letter) in group.char_indices() {
        if at_start && level == 0 {
            names.push(identifier(&group[index..]));
        }
        at_start = letter == ',';
        match letter {
            '{' => level += 1,
            '}' if level == 0 => break,
            '}' => level -= 1,
            _ => {}
        }
    }
    names
}

fn files_below(folder: &Path, found: &mut Vec<PathBuf>) {
    for entry in fs::read_dir(folder).unwrap() {
        let path = entry.unwrap().path();
        if path.is_dir() {
            files_below(&path, found);
        } else if path.extension().is_some_and(|extension| extension == "rs" || extension == "py") {
            found.push(path);
        }
    }
}

#[test]
fn every_module_uses_only_what_it_may() {
    let package = Path::new(env!("CARGO_MANIFEST_DIR"));
    let mut files = Vec::new();
    for folder in ["src", "tests", "fmu"] {
        let folder = package.join(folder);
        if folder.exists() {
            files_below(&folder, &mut files);
        }
    }
    assert!(files.len() > 30, "only {} files found", files.len());
    let found: Vec<String> = files
        .iter()
        .flat_map(|file| violations(file.strip_prefix(package).unwrap(), &fs::read_to_string(file).unwrap()))
        .collect();
    assert!(found.is_empty(), "{}", found.join("\n"));
}

#[test]
fn no_files_of_a_folder_need_one_another() {
    let package = Path::new(env!("CARGO_MANIFEST_DIR"));
    let mut files = Vec::new();
    files_below(&package.join("src"), &mut files);
    let folders: BTreeSet<&Path> = files.iter().filter_map(|file| file.parent()).collect();
    for folder in folders.into_iter().filter(|folder| *folder != package.join("src")) {
        let parts = modules(folder.strip_prefix(package).unwrap());
        let mut uses: BTreeMap<String, BTreeSet<String>> = BTreeMap::new();
        for file in files.iter().filter(|file| file.starts_with(folder) && **file != folder.join("mod.rs")) {
            let text = fs::read_to_string(file).unwrap();
            let (name, used) = neighbours_used(file.strip_prefix(package).unwrap(), &text, &parts);
            uses.entry(name).or_default().extend(used);
        }
        let found = circle(uses);
        assert!(found.is_empty(), "{}: {} need one another", folder.display(), found.join(", "));
    }
}

#[test]
fn a_circle_is_seen() {
    let module = ["rod".to_owned()];
    let file = |path: &str, text: &str| neighbours_used(Path::new(path), text, &module);
    let a = file("src/rod/a.rs", "use super::b::B;");
    let b = file("src/rod/b.rs", "use super::{c, d::{D, a}};");
    let d = file("src/rod/d/mod.rs", "use crate::design::a; // not super::a\nuse super::super::a::A;");
    let open = [a.clone(), b.clone(), d.clone()];
    assert_eq!(circle(open.into()), Vec::<String>::new());
    for (path, text) in [
        ("src/rod/c.rs", "fn f() { super::a::g() }"),
        ("src/rod/c.rs", "use crate::rod::a::A;"),
        ("src/rod/c/e.rs", "use super::super::a;"),
        ("src/rod/c/mod.rs", "use super::{a, f};"),
    ] {
        let closed = [a.clone(), b.clone(), d.clone(), file(path, text)];
        assert_eq!(circle(closed.into()), ["a", "b", "c"], "{path}: {text}");
    }
}

#[test]
fn top_level_holds_nothing_else() {
    for entry in fs::read_dir(env!("CARGO_MANIFEST_DIR")).unwrap() {
        let name = entry.unwrap().file_name().to_string_lossy().into_owned();
        let known = TOP_LEVEL.contains(&name.as_str()) || LEFT_BY_SCRIPTS.contains(&name.as_str());
        let packed = Path::new(&name).extension().is_some_and(|extension| extension == "fmu");
        assert!(known || packed || name.starts_with('.'), "{name} does not belong at the top level");
    }
}

#[test]
fn every_module_exists() {
    let src = Path::new(env!("CARGO_MANIFEST_DIR")).join("src");
    for (module, _) in MODULES {
        let exists = src.join(module).is_dir() || src.join(format!("{module}.rs")).is_file();
        assert!(exists, "src has no module `{module}`");
    }
}

#[test]
fn table_of_contents_lists_the_modules_in_order() {
    let text = fs::read_to_string(Path::new(env!("CARGO_MANIFEST_DIR")).join("src/lib.rs")).unwrap();
    let order = |module: &str| MODULES.iter().position(|(name, _)| *name == module).expect(module);
    let listed: Vec<usize> =
        text.lines().filter_map(|line| line.strip_prefix("pub mod ")?.split(';').next()).map(order).collect();
    assert!(listed.len() > 8 && listed.is_sorted(), "{listed:?}");
}

#[test]
fn a_violation_is_seen() {
    for (path, text) in [
        ("src/rod/shape.rs", "use crate::equilibrium::Settings;"),
        ("src/rod/shape.rs", "use crate::magnetics::Jet;"),
        ("src/rod/shape.rs", "use crate::{design::Design, magnetics::{Jet, Assembly}};"),
        ("src/rod/shape.rs", "use crate::{\n    design::{Design, Span},\n    fmi,\n};"),
        ("src/rod/shape.rs", "fn f() { let _ = crate::manipulator::Inputs::unloaded(0); }"),
        ("src/rod/shape.rs", "use super::super::fmi::Instance;"),
        ("src/rod/mod.rs", "use super::fmi::Instance;"),
        ("src/rod/shape/mod.rs", "pub use super::super::fmi;"),
        ("src/error.rs", "use crate::geometry::Pose;"),
        ("src/cellar/mod.rs", ""),
        ("src/rod/utils.rs", ""),
        ("tests/common/mod.rs", ""),
        ("src/rod/shape.rs", &"\n".repeat(401)),
    ] {
        assert_eq!(violations(Path::new(path), text).len(), 1, "{path}: {text}");
    }
}

#[test]
fn what_is_allowed_is_not_reported() {
    for (path, text) in [
        ("src/rod/shape.rs", "use crate::design::Design;\nuse crate::error::{Error, check};"),
        ("src/rod/shape.rs", "use crate::{design::Design, geometry::Pose};\nuse super::fmi;"),
        ("src/rod/shape.rs", "/// See [`crate::equilibrium::Settings`].\nuse crate::rod::Strain;"),
        ("src/equilibrium/potential.rs", "use crate::rod::Strain;\nuse crate::magnetics::Jet;"),
        ("src/manipulator/scene/text.rs", "use super::super::fmi;\nuse super::SceneFile;"),
        ("src/bin/mcm/main.rs", "use mcm::manipulator::Scene;"),
        ("src/fmi/bindings.rs", &"\n".repeat(2000)),
        ("src/rod/shape.rs", &"\n".repeat(400)),
    ] {
        assert_eq!(violations(Path::new(path), text), Vec::<String>::new(), "{path}: {text}");
    }
}
