//! What an archive carries besides the library, and how the library reads it at instantiation.

use std::fs;
use std::path::{Path, PathBuf};

use serde::{Deserialize, Serialize};

use super::guid::guid;
use super::host_values::HostValues;
use super::variables::Table;
use super::{documentation, terminals, xml};
use crate::error::Error;
use crate::manipulator::SceneFile;
use crate::vessel::{DistanceGrid, Lumen};

/// The scene of the default FMU, which is also built into the library for hosts that pass no resources.
pub const DEFAULT_SCENE: &str = include_str!("../../fmu/default.toml");

/// Number of centreline points of the default FMU.
pub const DEFAULT_SHAPE_POINTS: usize = 21;

const SCENE_FILE: &str = "scene.toml";
const STAMP_FILE: &str = "package.toml";

/// The distances to the wall of a vessel that is given by a mesh: sampled once, when packing, since that takes half a minute for a
/// long vessel. Reading them takes some ten milliseconds.
const VESSEL_FILE: &str = "vessel.grid";

/// A packed design: its scene, table of variables, start values and GUID.
///
/// ```
/// use mcm::fmi::Package;
/// let one = Package::new("[design]\nsegments = 1", "my scene", 5)?;
/// let two = Package::new("[design]\nsegments = 2", "my scene", 5)?;
/// assert_ne!(one.guid(), two.guid());
/// assert!(one.model_description(None)?.contains(one.guid()));
/// # Ok::<(), mcm::error::Error>(())
/// ```
#[derive(Debug, Clone)]
pub struct Package {
    guid: String,
    scene: String,
    table: Table,
    start: HostValues,
    warnings: Vec<String>,
}

/// The second resource file. It fixes the number of centreline points, and shows whether the scene was altered.
#[derive(Debug, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
struct Stamp {
    guid: String,
    shape_points: usize,
}

impl Package {
    /// The package of a scene with this number of centreline points. `scene` is the text of a scene file, and `what` names it
    /// in messages.
    ///
    /// # Errors
    /// Those of [`SceneFile::parse`] and [`Package::of`].
    pub fn new(scene: &str, what: &str, shape_points: usize) -> Result<Self, Error> {
        Self::of(&SceneFile::parse(scene, what)?, shape_points)
    }

    /// The package of a scene that has been read, with the mesh that it may name.
    ///
    /// # Errors
    /// Those of [`HostValues::start`] and [`Table::new`].
    pub fn of(file: &SceneFile, shape_points: usize) -> Result<Self, Error> {
        let start = HostValues::start(file)?;
        let scene = file.without_folders().to_toml()?;
        let table = Table::new(&start, shape_points)?;
        let unnamed = xml::model_description(&table, &start, "", None)?;
        let mesh = start.vessel.as_ref().filter(|vessel| vessel.lumen.grid().is_some());
        let mesh = mesh.map(|vessel| format!("{:08x}", vessel.lumen.checksum()));
        let texts = [unnamed.as_str(), scene.as_str()].into_iter().chain(mesh.as_deref());
        let guid = guid(texts);
        Ok(Self { guid, scene, table, start, warnings: file.warnings()? })
    }

    /// The package of the default design, which is built into the library.
    ///
    /// # Errors
    /// Those of [`Package::new`], if `fmu/default.toml` is not a valid scene.
    pub fn built_in() -> Result<Self, Error> {
        Self::new(DEFAULT_SCENE, "default scene", DEFAULT_SHAPE_POINTS)
    }

    /// The package in the unpacked resource directory of an archive; `None` if the directory holds neither of its files.
    ///
    /// # Errors
    /// [`Error::Syntax`] for a file that is missing, unreadable or altered; those of [`Package::new`].
    pub fn read(directory: &Path) -> Result<Option<Self>, Error> {
        let path = |name: &str| directory.join(name);
        if !path(SCENE_FILE).exists() && !path(STAMP_FILE).exists() {
            return Ok(None);
        }

        let unreadable =
            |path: &Path, reason: String| Error::Syntax { what: path.display().to_string(), reason };
        let text =
            |path: PathBuf| fs::read_to_string(&path).map_err(|error| unreadable(&path, error.to_string()));
        let lumen = |_: &str| {
            let path = path(VESSEL_FILE);
            let bytes = fs::read(&path).map_err(|error| unreadable(&path, error.to_string()))?;
            let grid = DistanceGrid::from_bytes(&bytes);
            grid.map(Lumen::of_grid).map_err(|error| unreadable(&path, error.to_string()))
        };

        let stamp_path = path(STAMP_FILE).display().to_string();
        let stamp: Stamp = toml::from_str(&text(path(STAMP_FILE))?)
            .map_err(|error| Error::Syntax { what: stamp_path.clone(), reason: error.message().into() })?;
        let scene = path(SCENE_FILE).display().to_string();
        let file = SceneFile::parse_with(&text(path(SCENE_FILE))?, &scene, lumen)?;

        // The GUID is a digest of scene and vessel: whoever exchanged one of them is told here, not by other
        // results.
        let package = Self::of(&file, stamp.shape_points)?;
        if package.guid == stamp.guid {
            Ok(Some(package))
        } else {
            Err(Error::Syntax {
                what: stamp_path,
                reason: format!(
                    "its GUID {} is not {}, that of the scene and vessel beside it: altered, or packed by another version",
                    stamp.guid, package.guid
                ),
            })
        }
    }

    /// The GUID, in braces. It differs for every other design, interface or version.
    #[must_use]
    pub fn guid(&self) -> &str {
        &self.guid
    }

    /// The table of variables.
    #[must_use]
    pub fn table(&self) -> &Table {
        &self.table
    }

    /// The start values.
    #[must_use]
    pub fn start(&self) -> &HostValues {
        &self.start
    }

    /// What is odd about the scene, as [`SceneFile::warnings`].
    #[must_use]
    pub fn warnings(&self) -> &[String] {
        &self.warnings
    }

    /// The text of `modelDescription.xml`; `generated` is the date and time of generation in UTC, if it shall be stated.
    ///
    /// # Errors
    /// [`Error::Syntax`] if the text cannot be written.
    pub fn model_description(&self, generated: Option<&str>) -> Result<String, Error> {
        xml::model_description(&self.table, &self.start, &self.guid, generated)
    }

    /// The text of `terminalsAndIcons/terminalsAndIcons.xml`.
    ///
    /// # Errors
    /// [`Error::Syntax`] if it cannot be written.
    pub fn terminals(&self) -> Result<String, Error> {
        terminals::terminals(&self.table)
    }

    /// The text of `documentation/index.html`.
    #[must_use]
    pub fn documentation(&self) -> String {
        documentation::page(&self.table, &self.start)
    }

    /// The files in `resources/`, by name.
    ///
    /// # Errors
    /// [`Error::Syntax`] if one cannot be written.
    pub fn resources(&self) -> Result<Vec<(&'static str, Vec<u8>)>, Error> {
        let stamp = Stamp { guid: self.guid.clone(), shape_points: self.table.counts().shape_points };
        let stamp = toml::to_string(&stamp)
            .map_err(|error| Error::Syntax { what: STAMP_FILE.into(), reason: error.to_string() })?;
        let mut files = vec![(SCENE_FILE, self.scene.clone().into()), (STAMP_FILE, stamp.into())];
        if let Some(grid) = self.start.vessel.as_ref().and_then(|vessel| vessel.lumen.grid()) {
            files.push((VESSEL_FILE, grid.to_bytes()?));
        }
        Ok(files)
    }
}

/// The package that a host wants to instantiate.
///
/// It is read from the first of the directories `resources` that holds one; if none does, it is the built-in default
/// design.
///
/// # Errors
/// [`Error::Syntax`] for resources that were altered, and for a GUID that is not that of the package; it says which directories were
/// sought in vain.
pub fn identify(guid: &str, resources: &[PathBuf]) -> Result<Package, Error> {
    let mut found = None;
    for path in resources {
        found = Package::read(path)?;
        if found.is_some() {
            break;
        }
    }
    let from = if found.is_some() { "the resources".to_owned() } else { sought_in_vain(resources) };
    let package = found.map_or_else(Package::built_in, Ok)?;
    if package.guid() == guid.trim() {
        Ok(package)
    } else {
        Err(Error::Syntax {
            what: format!("GUID {guid}"),
            reason: format!("it is not {}, that of {from}", package.guid()),
        })
    }
}

/// The built-in design in words, and why it is the one: where resources were sought in vain.
fn sought_in_vain(resources: &[PathBuf]) -> String {
    let why = match resources.first() {
        None => "the host gave no location".to_owned(),
        Some(folder) if folder.is_dir() => format!("there is no {SCENE_FILE} in {}", folder.display()),
        Some(folder) => format!("{} is no folder", folder.display()),
    };
    format!("the built-in default design (no resources found: {why})")
}
