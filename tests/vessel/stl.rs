//! Meshes from STL files.

use std::fmt::Write;

use mcm::vessel::Mesh;
use nalgebra::Vector3;

use super::tube::{Corners, arc, stl, tube};

/// A bent tube, mm, in numbers that single precision holds.
fn bent() -> Vec<Corners> {
    let rounded = |corner: Vector3<f64>| corner.map(|v| f64::from((1e3 * v) as f32));
    tube(arc(0.03, 2.0, 4e-3), 12, 8).into_iter().map(|corners| corners.map(rounded)).collect()
}

/// Triangles in mm as a binary file.
fn binary(triangles: &[Corners], header: &str) -> Vec<u8> {
    let metres: Vec<Corners> = triangles.iter().map(|corners| corners.map(|corner| corner * 1e-3)).collect();
    stl(&metres, header)
}

fn text(triangles: &[Corners], name: &str) -> String {
    let mut out = format!("solid {name}\n");
    for corners in triangles {
        out += "  facet normal 0 0 0\n    outer loop\n";
        for [x, y, z] in corners.map(<[f64; 3]>::from) {
            writeln!(out, "      vertex {x:e} {y:e} {z:e}").unwrap();
        }
        out += "    endloop\n  endfacet\n";
    }
    out + &format!("endsolid {name}\n")
}

#[test]
fn binary_and_text_are_the_same_mesh() {
    let triangles = bent();
    let metres: Vec<Corners> = triangles.iter().map(|corners| corners.map(|corner| corner * 1e-3)).collect();
    let expected = Mesh::new(&metres).unwrap();
    let (first, second) = triangles.split_at(100);
    let whole = text(&triangles, "wall of 2 parts");
    for (case, bytes) in [
        ("binary", binary(&triangles, "made by a test")),
        ("binary with a header like text", binary(&triangles, "solid wall\n")),
        ("text", whole.clone().into_bytes()),
        ("text without a name", text(&triangles, "").into_bytes()),
        ("text in upper case", whole.to_uppercase().into_bytes()),
        ("text with other ends of lines", whole.replace('\n', "\r\n\r\n").into_bytes()),
        ("text of two parts", (text(first, "wall") + &text(second, "ends")).into_bytes()),
    ] {
        assert_eq!(Mesh::from_stl(&bytes, 1e-3).unwrap(), expected, "{case}");
    }
}

#[test]
fn what_is_no_stl_is_refused() {
    let triangles = bent();
    let [binary, text] = [binary(&triangles, ""), text(&triangles, "wall").into_bytes()];
    let mut unknown = binary.clone();
    unknown[84 + 50 + 12..84 + 50 + 16].copy_from_slice(&f32::NAN.to_le_bytes());
    let changed =
        |from: &str, to: &str| String::from_utf8(text.clone()).unwrap().replacen(from, to, 1).into_bytes();
    for (bytes, unit, expected) in [
        (&binary, 0.0, "unit of an STL file (m) = 0 is not allowed: it must be > 0"),
        (&binary, f64::NAN, "unit of an STL file (m) = NaN"),
        (&binary, 1.0, "must be between -10 and 10"),
        (&Vec::new(), 1e-3, "STL file of a vessel: it is neither text nor complete: it has 0 bytes"),
        (
            &binary[..binary.len() - 1].to_vec(),
            1e-3,
            "neither text nor complete: it has 10483 bytes, announces 10484",
        ),
        (
            &b"PK\x03\x04 something else that is long enough to hold a header of 80 bytes and a number"
                .to_vec(),
            1e-3,
            "neither text nor complete",
        ),
        (&unknown, 1e-3, "coordinate (m) of triangle 2 of the vessel's mesh = NaN"),
        (&text[..text.len() - 30].to_vec(), 1e-3, "a `solid` has no `endsolid`: the text ends early"),
        (&changed("vertex", "vortex"), 1e-3, "STL file of a vessel: triangle 1: vertex f32 f32 f32, got"),
        (&changed("  facet normal 0", "  facet normal nan"), 1e-3, "triangle 1: expected finite f32"),
        (
            &b"solid nothing\nendsolid nothing\n".to_vec(),
            1e-3,
            "list of triangles of the vessel's mesh has 0 entries",
        ),
        (&b"solid \xff\nendsolid\n".to_vec(), 1e-3, "invalid utf-8"),
    ] {
        let refused = Mesh::from_stl(bytes, unit).unwrap_err().to_string();
        assert!(refused.contains(expected), "{refused}\nexpected {expected}");
    }
}
