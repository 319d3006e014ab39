//! Scenes whose vessel is a mesh.

use std::fs;
use std::path::{Path, PathBuf};

use mcm::manipulator::{Scene, SceneFile};
use mcm::vessel::{DistanceGrid, Lumen};
use nalgebra::Vector3;

use super::tube::{Corners, shifted, stl, straight, tube};
use crate::tolerance::MESH_TUBE;

/// Three segments that a field between two rows of corners presses against the wall of a tube along z, from -20 to 60 mm, with a radius of 3.5 mm.
const PRESSED: &str = "[design]\nsegments = 3\n[field]\nuniform_mt = [0.2, 8.0, 0.0]\n[model]\ninteraction = \"rings\"\n\
    time_budget_s = 20.0\n[vessel]\n";

const BRANCH: &str = "[[vessel.branch]]\nname = \"tube\"\npoints_mm = [[0, 0, -20], [0, 0, 20], [0, 0, 60]]\nradius_mm = 3.5\n";

const MESH: &str = "mesh_stl = \"tube.stl\"\n";

/// The tube of [`BRANCH`] as triangles, fine enough for the grid, m.
fn triangles() -> Vec<Corners> {
    shifted(tube(straight(0.08, 3.5e-3), 240, 120), Vector3::new(0.0, 0.0, -0.02))
}

/// A folder of its own for one test with files in it.
fn folder(test: &str, files: &[(&str, &[u8])]) -> PathBuf {
    let folder = Path::new(env!("CARGO_TARGET_TMPDIR")).join("meshes").join(test);
    drop(fs::remove_dir_all(&folder));
    fs::create_dir_all(&folder).unwrap();
    for (name, content) in files {
        fs::write(folder.join(name), content).unwrap();
    }
    folder
}

#[test]
fn a_tube_of_triangles_is_the_tube() {
    let text = format!("{PRESSED}{MESH}");
    let place = folder("same", &[("scene.toml", text.as_bytes()), ("tube.stl", &stl(&triangles(), ""))]);
    let inside_out: Vec<Corners> = triangles().into_iter().map(|[a, b, c]| [a, c, b]).collect();
    let outputs = |scene: &Scene| {
        let mut manipulator = scene.manipulator(5).unwrap();
        manipulator.solve(&scene.inputs).unwrap().clone()
    };
    let meshed = Scene::read(&place.join("scene.toml")).unwrap();
    let from_mesh = outputs(&meshed);
    let from_branch = outputs(&Scene::parse(&format!("{PRESSED}{BRANCH}"), "branch").unwrap());
    let [meshed_wall, branch_wall] = [&from_mesh, &from_branch].map(|outputs| outputs.wall.as_ref().unwrap());
    assert!(branch_wall.sum > 1e-3, "{branch_wall:?}");
    println!(
        "tip {:.1e} m, force {:.1e} of {:.1e} N",
        (from_mesh.tip.position - from_branch.tip.position).norm(),
        meshed_wall.sum - branch_wall.sum,
        branch_wall.sum
    );
    let [tip, force] = MESH_TUBE;
    assert!((from_mesh.tip.position - from_branch.tip.position).norm() < tip);
    assert!((meshed_wall.sum / branch_wall.sum - 1.0).abs() < force);
    assert_eq!(meshed_wall.count, branch_wall.count);
    // Normals and the order of corners do not matter, nor from where the file is named.
    fs::write(place.join("tube.stl"), stl(&inside_out, "")).unwrap();
    let turned = SceneFile::parse_in(&text, "turned", &place).unwrap();
    assert_eq!(outputs(&turned.scene().unwrap()), from_mesh);
    // What is varied keeps the mesh.
    let stiffer = turned.with("vessel.wall_modulus_mpa", 2.0).unwrap().scene().unwrap();
    assert_eq!(stiffer.vessel.as_ref().unwrap().lumen, meshed.vessel.unwrap().lumen);
    assert!(outputs(&stiffer).wall.unwrap().largest_indentation < meshed_wall.largest_indentation);
}

#[test]
fn a_lumen_may_come_from_elsewhere() {
    let box_around = [Vector3::new(-4e-3, -4e-3, -0.021), Vector3::new(4e-3, 4e-3, 0.061)];
    let grid =
        DistanceGrid::new(box_around, 4e-4, |at| (3.5e-3 - at.xy().norm()).min(at.z + 0.02).min(0.06 - at.z));
    let lumen = Lumen::of_grid(grid.unwrap());
    let text = format!("{PRESSED}{MESH}");
    let file = SceneFile::parse_with(&text, "given", |name| {
        assert_eq!(name, "tube.stl");
        Ok(lumen.clone())
    });
    assert_eq!(file.unwrap().scene().unwrap().vessel.unwrap().lumen, lumen);
    let alone = SceneFile::parse(&text, "alone").unwrap_err().to_string();
    assert!(
        alone.starts_with("alone, line 9: vessel.mesh_stl: tube.stl is not found from a text alone"),
        "{alone}"
    );
    assert!(alone.contains("Scene::read") && alone.contains("SceneFile::parse_in"), "{alone}");
}

#[test]
fn a_mesh_that_cannot_be_used_is_refused_by_name_and_line() {
    let whole = triangles();
    let moved = |x: f64| stl(&shifted(whole.clone(), Vector3::new(x, 0.0, 0.0)), "");
    let metres: Vec<Corners> = whole.iter().map(|corners| corners.map(|corner| corner * 1e-3)).collect();
    let place = folder(
        "refused",
        &[
            ("tube.stl", &stl(&whole, "")),
            ("text.stl", b"no mesh"),
            ("open.stl", &stl(&whole[1..], "")),
            ("narrow.stl", &stl(&tube(straight(0.08, 1.5e-3), 100, 20), "")),
            ("aside.stl", &moved(0.02)),
            ("metres.stl", &stl(&metres, "")),
        ],
    );
    let refused = |entries: &str| {
        let text = format!("{PRESSED}{entries}");
        let error = SceneFile::parse_in(&text, "scene.toml", &place).unwrap_err();
        error.to_string().replace(&format!("{}/", place.display()), "")
    };
    for (entries, expected) in [
        ("mesh_stl = \"absent.stl\"", "scene.toml, line 9: vessel.mesh_stl: absent.stl: No such file"),
        ("mesh_stl = \".\"", "Is a directory"),
        (
            "mesh_stl = 3",
            "scene.toml, line 9: `vessel.mesh_stl`: invalid type: integer `3`, expected a string",
        ),
        ("mesh_stll = \"tube.stl\"", "unknown key `vessel.mesh_stll`; did you mean `mesh_stl`?"),
        (
            "mesh_stl = \"text.stl\"",
            "scene.toml, line 9: vessel.mesh_stl: text.stl: STL file of a vessel: it is neither text nor complete",
        ),
        (
            "mesh_stl = \"open.stl\"",
            "vessel.mesh_stl: open.stl: number of open edges of the vessel's mesh, the first from",
        ),
        (
            "mesh_stl = \"aside.stl\"",
            "it does not fit in where it starts; the mesh lies within (16, -4, -20) to (24, 4, 60) mm",
        ),
        ("mesh_stl = \"narrow.stl\"", "distance of base.position_mm from the wall of the vessel (mm)"),
        ("mesh_stl = \"metres.stl\"", "the mesh lies within (-0, -0, -0) to (0, 0, 0) mm"),
        (
            &format!("{MESH}{BRANCH}"),
            "line 9: vessel.mesh_stl has no meaning beside [[vessel.branch]]: give one or the other",
        ),
        (
            "",
            "line 8: vessel needs mesh_stl, the name of an STL file in mm, or at least one [[vessel.branch]]",
        ),
    ] {
        let told = refused(entries);
        assert!(told.contains(expected), "{entries}:\n{told}\nexpected {expected}");
    }
    // Faults of the mesh are told with those of other entries.
    let both = refused("wall_modulus_mpa = -1\nmesh_stl = \"absent.stl\"");
    let lines: Vec<&str> = both.lines().collect();
    assert!(lines[0].contains("line 9: vessel.wall_modulus_mpa = -1"), "{both}");
    assert!(lines[1].contains("line 10: vessel.mesh_stl: absent.stl"), "{both}");
    assert_eq!(lines.len(), 2, "{both}");
}
