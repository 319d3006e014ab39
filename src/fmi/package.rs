//! What an archive carries besides the library, and how the library finds it again.

use std::fs;
use std::path::{Path, PathBuf};

use serde::{Deserialize, Serialize};

use super::given::Given;
use super::guid::guid;
use super::variables::Table;
use super::{documentation, xml};
use crate::error::Error;
use crate::manipulator::SceneFile;

/// The scene that is packed when none is given, and that the library knows without resources.
pub const DEFAULT_SCENE: &str = include_str!("../../fmu/default.toml");

/// Centreline points of the default FMU.
pub const DEFAULT_SHAPE_POINTS: usize = 21;

const SCENE: &str = "scene.toml";
const STAMP: &str = "package.toml";

/// A design with its table, start values and GUID.
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
    start: Given,
}

/// What stands beside the scene in the archive.
#[derive(Debug, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
struct Stamp {
    guid: String,
    shape_points: usize,
}

impl Package {
    /// The package of a scene (its text; `what` names it in messages) with so many centreline points.
    ///
    /// # Errors
    /// What [`SceneFile::parse`] and [`Table::new`] refuse.
    pub fn new(scene: &str, what: &str, shape_points: usize) -> Result<Self, Error> {
        let file = SceneFile::parse(scene, what)?;
        let start = Given::start(&file)?;
        let scene = file.to_toml()?;
        let table = Table::new(&start, shape_points)?;
        let unnamed = xml::model_description(&table, &start, "", None)?;
        Ok(Self { guid: guid([unnamed.as_str(), scene.as_str()]), scene, table, start })
    }

    /// The package that the library knows without resources.
    ///
    /// # Errors
    /// None, unless `fmu/default.toml` is no scene.
    pub fn built_in() -> Result<Self, Error> {
        Self::new(DEFAULT_SCENE, "default scene", DEFAULT_SHAPE_POINTS)
    }

    /// The package in an archive's unpacked resource directory; `None` if there is nothing of ours in it.
    ///
    /// # Errors
    /// [`Error::Syntax`] for a file that is missing, unreadable or altered.
    pub fn read(directory: &Path) -> Result<Option<Self>, Error> {
        let path = |name: &str| directory.join(name);
        if !path(SCENE).exists() && !path(STAMP).exists() {
            return Ok(None);
        }
        let text = |path: PathBuf| {
            fs::read_to_string(&path).map_err(|error| Error::Syntax {
                what: path.display().to_string(),
                reason: error.to_string(),
            })
        };
        let stamp_path = path(STAMP).display().to_string();
        let stamp: Stamp = toml::from_str(&text(path(STAMP))?)
            .map_err(|error| Error::Syntax { what: stamp_path.clone(), reason: error.message().into() })?;
        let scene = path(SCENE).display().to_string();
        let package = Self::new(&text(path(SCENE))?, &scene, stamp.shape_points)?;
        if package.guid == stamp.guid {
            Ok(Some(package))
        } else {
            Err(Error::Syntax {
                what: stamp_path,
                reason: format!(
                    "its GUID {} is not {}, that of the scene beside it: altered, or packed by another version",
                    stamp.guid, package.guid
                ),
            })
        }
    }

    /// The GUID, in braces: another one for every other design, interface or version.
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
    pub fn start(&self) -> &Given {
        &self.start
    }

    /// The text of `modelDescription.xml`; `generated` is the date and time in UTC, if it is to be told.
    ///
    /// # Errors
    /// [`Error::Syntax`] if the text cannot be written.
    pub fn model_description(&self, generated: Option<&str>) -> Result<String, Error> {
        xml::model_description(&self.table, &self.start, &self.guid, generated)
    }

    /// The text of `documentation/index.html`.
    #[must_use]
    pub fn documentation(&self) -> String {
        documentation::page(&self.table, &self.start)
    }

    /// The files of `resources/`: name and text.
    ///
    /// # Errors
    /// [`Error::Syntax`] if a text cannot be written.
    pub fn resources(&self) -> Result<[(&'static str, String); 2], Error> {
        let stamp = Stamp { guid: self.guid.clone(), shape_points: self.table.counts().shape_points };
        let stamp = toml::to_string(&stamp)
            .map_err(|error| Error::Syntax { what: STAMP.into(), reason: error.to_string() })?;
        Ok([(SCENE, self.scene.clone()), (STAMP, stamp)])
    }
}
