//! The arteries as text of a scene.

use core::fmt::Write;

use nalgebra::Vector3;

use super::anatomy::Aorta;
use crate::error::Error;

/// Points of a centreline, or radii, in a line.
const IN_A_LINE: [usize; 2] = [3, 12];

impl Aorta {
    /// The arteries as tables `[[vessel.branch]]` of a scene, lengths rounded to 1e-4 mm, each below a remark that names its source.
    ///
    /// ```
    /// use mcm::vessel::Aorta;
    /// let text = Aorta::planar().scene_text()?;
    /// assert!(text.starts_with("# left iliac and aorta: 10.5 mm wide, then"));
    /// assert!(text.contains("name = \"celiac trunk\"\npoints_mm = [\n"));
    /// # Ok::<(), mcm::error::Error>(())
    /// ```
    ///
    /// # Errors
    /// [`Error::Range`] for a measure that is not possible.
    pub fn scene_text(&self) -> Result<String, Error> {
        let mut out = String::new();
        for artery in self.arteries()? {
            if !out.is_empty() {
                out.push('\n');
            }
            let point = |point: &Vector3<f64>| format!("[{}]", point.map(millimetres).as_slice().join(", "));
            let points: Vec<String> = artery.points.iter().map(point).collect();
            let radii: Vec<String> = artery.radii.iter().map(|radius| millimetres(*radius)).collect();
            let one = radii.iter().all(|radius| *radius == radii[0]);
            let radii = if one { radii[0].clone() } else { list(&radii, IN_A_LINE[1]) };
            // Writing to a string cannot fail.
            let _ = writeln!(
                out,
                "# {name}: {}\n[[vessel.branch]]\nname = \"{name}\"\npoints_mm = {}\nradius_mm = {radii}",
                artery.remark,
                list(&points, IN_A_LINE[0]),
                name = artery.name,
            );
        }
        Ok(out)
    }
}

/// A list over several lines.
fn list(entries: &[String], in_a_line: usize) -> String {
    let lines: Vec<String> =
        entries.chunks(in_a_line).map(|line| format!("  {},\n", line.join(", "))).collect();
    format!("[\n{}]", lines.concat())
}

/// A length (m) in mm, to 1e-4 mm; a floating-point number of TOML, without a negative zero.
fn millimetres(length: f64) -> String {
    let rounded = (length * 1e7).round() / 1e4 + 0.0;
    format!("{rounded:?}")
}
