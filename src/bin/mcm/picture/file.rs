//! The file of a picture.

use std::path::Path;

use svg::Document;

use crate::failure::Failure;
use crate::output::Output;

/// A file for a picture, which can be written.
pub(crate) struct SvgFile(Output);

impl SvgFile {
    /// Begins the file that an option names; its name must say that it is SVG.
    pub(crate) fn at(option: &str, path: &Path) -> Result<Self, Failure> {
        if path.extension().is_some_and(|ending| ending.eq_ignore_ascii_case("svg")) {
            return Ok(Self(Output::at(path)?));
        }
        let svg = path.with_extension("svg");
        Err(Failure(format!(
            "{option} {} must end in .svg, the only kind of picture that is drawn; a browser, Inkscape or \
             `rsvg-convert {} -o picture.png` makes pixels of one",
            path.display(),
            svg.display()
        )))
    }

    /// Writes the picture.
    pub(crate) fn fill(self, picture: &Document) -> Result<(), Failure> {
        self.0.fill(format!("{picture}\n").as_bytes())
    }
}
