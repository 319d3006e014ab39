//! A scene as text (TOML, units in the names): the design, its inputs and the model.

mod choices;
mod device;
mod faults;
mod file;
mod magnet_shape;
mod mesh;
mod moved;
mod multipoles;
mod names;
mod numbers;
mod path;
mod pose;
mod ranges;
mod resolve;
#[cfg(test)]
mod schema;
mod sections;
mod segments;
mod shaped_magnets;
mod sources;
mod spiral_start;
mod text;
mod tube;
mod uncertainty;
mod units;
mod vessel;
mod warnings;

pub use choices::{METHODS, POTENTIAL};
pub use file::SceneFile;
pub use uncertainty::Uncertainty;
pub use vessel::FeedMode;

use std::path::Path;

use super::{Inputs, Manipulator, Way};
use crate::design::{Backbone, Design, Guidewire, Specification};
use crate::equilibrium::Settings;
use crate::error::Error;
use crate::magnetics::Sources;
use crate::vessel::Vessel;

/// Everything that one solve needs, in SI units.
///
/// ```
/// use mcm::manipulator::Scene;
/// let scene = Scene::parse("[field]\nuniform_mt = [0, 20, 0]", "my scene")?;
/// assert_eq!(scene.inputs.uniform_field.y, 0.02);
/// assert_eq!(scene.inputs.ring_forces.len(), 10); // nine segments unless said
///
/// let refused = Scene::parse("[design.helix]\nlenght_mm = 4.0", "my scene").unwrap_err();
/// assert_eq!(
///     refused.to_string(),
///     "my scene, line 2: unknown key `design.helix.lenght_mm`; did you mean `length_mm`?"
/// );
/// # Ok::<(), mcm::error::Error>(())
/// ```
#[derive(Debug, Clone, PartialEq)]
pub struct Scene {
    /// Specification of the manipulator.
    pub specification: Specification,
    /// The magnets, then the coils.
    pub sources: Sources,
    /// The vessel that the manipulator is in; `None` for none.
    pub vessel: Option<Vessel>,
    /// The shaft behind the base; `None` for a manipulator that is clamped there.
    pub shaft: Option<Backbone>,
    /// The guidewire inside; `None` for none.
    pub guidewire: Option<Guidewire>,
    /// Fields, loads, base pose, insertion and the guidewire's reach.
    pub inputs: Inputs,
    /// How the device comes to these inputs.
    pub way: Way,
    /// Model settings and solver settings of the potential method.
    pub settings: Settings,
    /// Solution method, as the scene's key `model.method` names it: one of [`METHODS`].
    pub method: String,
}

impl Scene {
    /// Reads a scene; omitted entries are those of the paper's Table 1 with nine segments, unloaded.
    ///
    /// `what` names the text in error messages, for example its file name.
    ///
    /// # Errors
    /// As [`SceneFile::parse`].
    pub fn parse(text: &str, what: &str) -> Result<Self, Error> {
        SceneFile::parse(text, what)?.scene()
    }

    /// The checked design.
    ///
    /// # Errors
    /// [`Error::Range`] naming the first quantity out of range.
    pub fn design(&self) -> Result<Design, Error> {
        let design = Design::new(self.specification.clone())?;
        design.with(self.shaft.as_ref(), self.guidewire.as_ref())
    }

    /// Reads a scene file, and the mesh of a vessel and the tables of multipoles that it names, whose paths are relative to the scene's
    /// folder.
    ///
    /// # Errors
    /// [`Error::Syntax`] for a file that cannot be read; as [`SceneFile::parse_in`].
    pub fn read(path: &Path) -> Result<Self, Error> {
        let folder = path.parent().unwrap_or(Path::new(""));
        SceneFile::parse_in(&mesh::text_of(path)?, &path.display().to_string(), folder)?.scene()
    }

    /// A manipulator of this scene, unsolved; `shape_points` is the number of centreline points in its outputs.
    ///
    /// # Errors
    /// As [`Scene::design`] and [`Manipulator::new`]; [`Error::Unsupported`] where the scene names a
    /// method other than the potential method.
    pub fn manipulator(&self, shape_points: usize) -> Result<Manipulator, Error> {
        if self.method != POTENTIAL {
            return Err(Error::Unsupported(format!(
                "a manipulator solves by method \"{POTENTIAL}\", not \"{}\"",
                self.method
            )));
        }

        let made = Manipulator::new(&self.design()?, &self.sources, self.settings, shape_points)?;
        let made = made.on_way(self.way.clone());
        Ok(match &self.vessel {
            Some(vessel) => made.in_vessel(vessel),
            None => made,
        })
    }
}
