//! Designs, GUIDs and resources.

use std::fs;
use std::path::PathBuf;

use mcm::fmi::Package;
use mcm::fmi::location::paths;
use mcm::fmi::package::identify;

use super::BENT;

/// An empty directory of this test's own.
pub(super) fn directory(name: &str) -> PathBuf {
    let path = PathBuf::from(env!("CARGO_TARGET_TMPDIR")).join(name);
    let _ = fs::remove_dir_all(&path);
    fs::create_dir_all(&path).unwrap();
    path
}

pub(super) fn unpacked(name: &str, package: &Package) -> PathBuf {
    let path = directory(name);
    for (file, text) in package.resources().unwrap() {
        fs::write(path.join(file), text).unwrap();
    }
    path
}

#[test]
fn the_guid_follows_the_design() {
    let guid = |scene: &str, points| Package::new(scene, "test scene", points).unwrap().guid().to_owned();
    let bent = guid(BENT, 5);
    assert_eq!(bent, guid(&format!("# a remark\n{BENT}"), 5), "remarks do not matter");
    assert_ne!(bent, guid(BENT, 6));
    assert_ne!(bent, guid(&BENT.replace("10.0", "10.000000000000002"), 5));
    assert_ne!(bent, guid(&BENT.replace("segments = 1", "segments = 2"), 5));
    assert_eq!(bent.len(), 38);
}

#[test]
fn resources_bring_the_package_back() {
    let package = Package::new(BENT, "test scene", 5).unwrap();
    let path = unpacked("fmi resources (100% ü)", &package);
    let found = identify(package.guid(), std::slice::from_ref(&path)).unwrap();
    assert_eq!(found.guid(), package.guid());
    assert_eq!(found.start(), package.start());
    let text = path.display().to_string();
    for location in [
        format!("file://{text}"),
        format!("file:{text}/"),
        format!("file:///{text}"),
        format!("file://localhost{text}"),
        format!("file://{}", text.replace('%', "%25").replace(' ', "%20").replace('ü', "%C3%BC")),
        format!("file://{}/", text.replace(' ', "%20")),
        text.clone(),
    ] {
        let found = paths(&location).unwrap();
        assert!(identify(package.guid(), &found).is_ok(), "{location}: {found:?}");
    }
}

#[test]
fn without_resources_only_the_default_design_is_known() {
    let default = Package::built_in().unwrap();
    let empty = directory("fmi no resources");
    for resources in [&[][..], &[empty], &[PathBuf::from("/nowhere at all")]] {
        assert!(identify(default.guid(), resources).is_ok());
        let refused = identify("{87a5d2de-0000-8643-abe9-000000000000}", resources).unwrap_err().to_string();
        assert!(refused.contains("no resources found") && refused.contains(default.guid()), "{refused}");
    }
}

/// From a file's name and text to what is left of it.
type Spoil = dyn Fn(&str, &str) -> Option<String>;

#[test]
fn resources_that_do_not_fit_are_refused() {
    let package = Package::new(BENT, "test scene", 5).unwrap();
    let other = Package::built_in().unwrap();
    let spoiled: [(&str, &Spoil); 5] = [
        ("altered", &|_, text| Some(text.replace("segments = 1", "segments = 2"))),
        ("truncated", &|file, text| (file == "scene.toml").then(|| text[..text.len() / 2].to_owned())),
        ("no stamp", &|file, text| (file == "scene.toml").then(|| text.to_owned())),
        ("no scene", &|file, text| (file == "package.toml").then(|| text.to_owned())),
        ("points", &|_, text| Some(text.replace("shape_points = 5", "shape_points = -5"))),
    ];
    for (name, spoil) in spoiled {
        let path = directory(&format!("fmi {name}"));
        for (file, text) in package.resources().unwrap() {
            if let Some(text) = spoil(file, str::from_utf8(&text).unwrap()) {
                fs::write(path.join(file), text).unwrap();
            }
        }
        let refused = identify(package.guid(), &[path]).unwrap_err().to_string();
        assert!(refused.contains("toml"), "{name}: {refused}");
    }
    let path = unpacked("fmi other", &package);
    let refused = identify(other.guid(), &[path]).unwrap_err().to_string();
    assert!(refused.contains(package.guid()) && refused.contains("resources"), "{refused}");
}

#[test]
fn a_scene_without_magnet_has_it_switched_off() {
    let package = Package::new(BENT, "test scene", 5).unwrap();
    assert_eq!(package.start().sources[0].strength.to_bits(), 0);
    assert_eq!(package.start().magnets.len(), 2);
}
