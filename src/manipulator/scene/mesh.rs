//! The mesh that a scene names instead of branches: where it is found and what is made of it.

use std::path::Path;

use super::vessel::{BranchEntries, VesselEntries};
use super::{SceneFile, faults};
use crate::error::Error;
use crate::vessel::{Lumen, Mesh};

/// Key of the mesh.
const KEY: &str = "vessel.mesh_stl";

impl SceneFile {
    /// Reads a scene file's text, and the mesh and the tables of multipoles that it names, whose paths are relative to `folder`;
    /// `what` names the text in error messages. Coordinates of the mesh are in mm, as those of the scene.
    ///
    /// # Errors
    /// As [`SceneFile::parse`], as where the mesh is missing or is none: see [`crate::vessel::Mesh`].
    pub fn parse_in(text: &str, what: &str, folder: &Path) -> Result<Self, Error> {
        let lumen_of = |name: &str, mesh: Mesh| {
            let refused = |error: Error| refused(&folder.join(name), error.to_string());
            Lumen::from_mesh(&mesh, None).map_err(refused)
        };
        let mesh_of = |name: &str| read(&folder.join(name));
        faults::read(text, what, mesh_of, lumen_of, |name| text_of(&folder.join(name)))
    }

    /// Whether a mesh is named.
    #[must_use]
    pub fn has_mesh(&self) -> bool {
        self.mesh_stl().is_some()
    }

    /// The file with the mesh called by its name alone, as it travels without the folders that it was in.
    #[must_use]
    pub fn without_folders(&self) -> Self {
        let mut file = self.clone();
        if let Some(name) = file.vessel.as_mut().and_then(|vessel| vessel.mesh_stl.as_mut())
            && let Some(last) = Path::new(name.as_str()).file_name()
        {
            *name = last.to_string_lossy().into_owned();
        }
        file
    }

    pub(super) fn mesh_stl(&self) -> Option<&str> {
        self.vessel.as_ref()?.mesh_stl.as_deref()
    }

    /// Sets the lumen of the mesh that is named; what stands in its way is told with the scene's other faults.
    pub(super) fn set_mesh(&mut self, found: Result<Lumen, Error>) {
        let at_key = |error: Error| Error::Syntax { what: KEY.into(), reason: error.to_string() };
        self.mesh = Some(found.map_err(at_key));
    }
}

impl VesselEntries {
    /// The lumen of the mesh or of the branches; `mesh` is what was found under the name of the mesh.
    pub(super) fn lumen(&self, mesh: Option<&Result<Lumen, Error>>) -> Result<Lumen, Error> {
        match (&self.mesh_stl, self.branch.is_empty()) {
            (Some(name), true) => match mesh {
                Some(found) => found.clone(),
                None => Err(Error::Syntax { what: KEY.into(), reason: unplaced(name).to_string() }),
            },
            (Some(_), false) => Err(Error::Unsupported(format!(
                "{KEY} has no meaning beside [[vessel.branch]]: give one or the other"
            ))),
            (None, false) => Lumen::new(self.branch.iter().map(BranchEntries::si).collect::<Result<_, _>>()?),
            (None, true) => Err(Error::Unsupported(
                "vessel needs mesh_stl, the name of an STL file in mm, or at least one [[vessel.branch]]"
                    .into(),
            )),
        }
    }
}

/// The text of a file.
pub(super) fn text_of(path: &Path) -> Result<String, Error> {
    std::fs::read_to_string(path).map_err(|error| refused(path, error.to_string()))
}

/// Why a file is not used.
fn refused(path: &Path, reason: String) -> Error {
    Error::Syntax { what: path.display().to_string(), reason }
}

/// Why a text alone does not tell where a file is that it names.
pub(super) fn unplaced(name: &str) -> Error {
    Error::Unsupported(format!(
        "{name} is not found from a text alone: read the scene's file (Scene::read), or name the folder (SceneFile::parse_in)"
    ))
}

#[cfg(feature = "stl")]
fn read(path: &Path) -> Result<Mesh, Error> {
    use std::fs::File;
    use std::io::Read;

    use super::units::MM_PER_M;

    /// Largest length of an STL file, bytes: twenty million triangles.
    const LONGEST: u64 = 1_000_000_000;

    let mut bytes = Vec::new();
    let opened = File::open(path).and_then(|file| file.take(LONGEST + 1).read_to_end(&mut bytes));
    opened.map_err(|error| refused(path, error.to_string()))?;
    if bytes.len() as u64 > LONGEST {
        return Err(refused(path, format!("it has more than {LONGEST} bytes")));
    }
    Mesh::from_stl(&bytes, 1.0 / MM_PER_M).map_err(|error| refused(path, error.to_string()))
}

#[cfg(not(feature = "stl"))]
fn read(path: &Path) -> Result<Mesh, Error> {
    Err(Error::Unsupported(format!(
        "{} is not read: this build of mcm has no reader for STL files, the feature `stl`",
        path.display()
    )))
}
