//! Meshes from STL files.

use std::io::Cursor;

use nalgebra::Vector3;

use super::mesh::Mesh;
use crate::error::{Error, check};

/// Bytes of a binary file before its triangles: a header and their number.
const HEADER: usize = 80;
const BEFORE: usize = HEADER + 4;

/// Bytes of a triangle.
const TRIANGLE: usize = 50;

impl Mesh {
    /// The surface in an STL file, binary or text, whose coordinates are in `unit` (m, 1e-3 for mm: the file does not say it).
    ///
    /// The normals in the file are left aside. A text may hold the surface in several parts, each a `solid`.
    ///
    /// ```
    /// use mcm::vessel::Mesh;
    /// let facet = |a: &str, b: &str, c: &str| {
    ///     format!("facet normal 0 0 0\nouter loop\nvertex {a}\nvertex {b}\nvertex {c}\nendloop\nendfacet\n")
    /// };
    /// let [o, x, y, z] = ["0 0 0", "6 0 0", "0 6 0", "0 0 6"];
    /// let facets = [facet(o, y, x), facet(o, x, z), facet(o, z, y), facet(x, y, z)].concat();
    /// let text = format!("solid corner\n{facets}endsolid corner\n");
    /// let mesh = Mesh::from_stl(text.as_bytes(), 1e-3)?;
    /// assert!((mesh.volume() - 36e-9).abs() < 1e-15);
    /// # Ok::<(), mcm::error::Error>(())
    /// ```
    ///
    /// # Errors
    /// [`Error::Syntax`] for bytes that are no STL or end early; [`Error::Range`] unless the unit is positive; and as
    /// [`Mesh::new`].
    pub fn from_stl(bytes: &[u8], unit: f64) -> Result<Self, Error> {
        check("unit of an STL file (m)", unit, |v| v > 0.0, "> 0")?;
        let mut source = Cursor::new(clean(bytes)?);
        let unreadable =
            |number: usize, error: std::io::Error| refused(format!("triangle {number}: {error}"));
        let triangles = stl_io::create_stl_reader(&mut source).map_err(|error| unreadable(1, error))?;
        let mut corners = Vec::new();
        for (number, triangle) in (1..).zip(triangles) {
            let triangle = triangle.map_err(|error| unreadable(number, error))?;
            corners.push(triangle.vertices.map(|corner| Vector3::from(corner.0.map(f64::from)) * unit));
        }
        Self::new(&corners)
    }
}

/// The file in a form that the reader takes: a binary file whose header does not look like text, or one `solid` in lower case.
fn clean(bytes: &[u8]) -> Result<Vec<u8>, Error> {
    let announced = bytes.get(HEADER..BEFORE).map_or(0, |count| {
        let count = count.iter().rev().fold(0, |count: usize, byte| count << 8 | usize::from(*byte));
        BEFORE.saturating_add(TRIANGLE.saturating_mul(count))
    });
    let is_text = bytes.trim_ascii_start().get(..5).is_some_and(|word| word.eq_ignore_ascii_case(b"solid"));
    if is_text && announced != bytes.len() {
        return one_solid(bytes);
    }
    if announced == 0 || announced > bytes.len() {
        let length = bytes.len();
        return Err(refused(format!(
            "it is neither text nor complete: it has {length} bytes, announces {announced}"
        )));
    }
    let mut out = bytes.to_vec();
    out[..HEADER].fill(b' ');
    Ok(out)
}

/// All parts of a text as one.
fn one_solid(bytes: &[u8]) -> Result<Vec<u8>, Error> {
    let text = str::from_utf8(bytes).map_err(|error| refused(error.to_string()))?.to_lowercase();
    let mut out = String::from("solid vessel\n");
    let mut open = 0_i64;
    for line in text.lines() {
        match line.split_whitespace().next() {
            Some("solid") => open += 1,
            Some("endsolid") => open -= 1,
            _ => {
                out.push_str(line);
                out.push('\n');
            }
        }
    }
    if open != 0 {
        return Err(refused("a `solid` has no `endsolid`: the text ends early".into()));
    }
    out.push_str("endsolid vessel\n");
    Ok(out.into_bytes())
}

fn refused(reason: String) -> Error {
    Error::Syntax { what: "STL file of a vessel".into(), reason }
}
