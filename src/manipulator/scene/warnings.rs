//! What a scene may say, but probably does not mean.

use nalgebra::Vector3;
use toml::Value;

use super::SceneFile;
use super::names::{Unit, without_index};
use super::path::numbers;
use super::units::MM_PER_M;
use crate::design::unit_mistake::{SIZE, UnitMistake, UnitRule};
use crate::error::Error;

/// Tables whose keys are names of other numbers.
const OF_OTHERS: [&str; 2] = ["uncertainty.", "correlation."];

impl SceneFile {
    /// Numbers that are allowed, but look as if they were given in another unit, each in a sentence that begins with its key.
    ///
    /// ```
    /// use mcm::manipulator::SceneFile;
    /// let file = SceneFile::parse("[design.ring]\nlength_mm = 0.001", "example")?;
    /// let told = file.warnings()?;
    /// assert_eq!(
    ///     told,
    ///     ["design.ring.length_mm = 0.001: usual are 0.05 mm to 1 m; if it was meant in m, it is 1 mm"]
    /// );
    /// # Ok::<(), mcm::error::Error>(())
    /// ```
    ///
    /// # Errors
    /// [`Error::Syntax`] for a file that TOML cannot hold.
    pub fn warnings(&self) -> Result<Vec<String>, Error> {
        let own = numbers(&Value::Table(self.table()?), "").into_iter();
        let own = own.filter(|(path, _)| !OF_OTHERS.iter().any(|table| path.starts_with(table)));
        let own = own.filter_map(|(path, number)| Unit::mistake(&path, number));
        let extents = self.extents().into_iter();
        let extents = extents.filter_map(|(name, extent)| SIZE.mistake(&name, extent, MM_PER_M));
        Ok(own.chain(extents).map(|odd| odd.to_string()).collect())
    }

    /// How far the centreline of each branch of a vessel extends, or its mesh, mm.
    fn extents(&self) -> Vec<(String, f64)> {
        let Some(vessel) = &self.vessel else { return Vec::new() };
        let mesh = self.mesh.as_ref().and_then(|found| found.as_ref().ok()?.grid());
        let of_mesh = mesh.map(|grid| {
            let [low, high] = grid.bounds();
            ("extent of vessel.mesh_stl in mm".to_owned(), (high - low).norm() * MM_PER_M)
        });

        let of_branches = (1..).zip(&vessel.branch).map(|(number, branch)| {
            let points = || branch.points_mm.iter().map(|point| Vector3::from(*point));
            let low = points().reduce(|a, b| a.inf(&b)).unwrap_or_default();
            let high = points().reduce(|a, b| a.sup(&b)).unwrap_or_default();
            (format!("extent of vessel.branch[{number}].points_mm"), (high - low).norm())
        });
        of_branches.chain(of_mesh).collect()
    }
}

impl Unit {
    /// What is odd about a number under the key at this path.
    fn mistake(path: &str, number: f64) -> Option<UnitMistake> {
        let (rule, unit) = Self::rule(path)?;
        rule.mistake(path, number, unit.per_si())
    }

    /// The rule for the number under a key, and the unit of that.
    pub(super) fn rule(path: &str) -> Option<(&'static UnitRule, Self)> {
        let key = without_index(path);
        let name = key.rsplit_once('_').map_or(key, |(name, _)| name);
        Some((UnitRule::of(name)?, Self::of(key)))
    }
}
