//! Names of numbers with their units: one rule for keys of JSON and columns of tables.
//!
//! A name is a stem, the component of a vector and the unit, joined by `_`: `tip`, `x` and mm give `tip_x_mm`.

use super::row::OutputRow;
use super::spelling::{Spelled, Spelling};

/// The name of a number: a stem, a component (empty for a scalar) and a unit.
fn name(stem: &str, component: &str, unit: Spelled) -> String {
    let parts = [stem, component, unit.suffix];
    parts.into_iter().filter(|part| !part.is_empty()).collect::<Vec<_>>().join("_")
}

impl OutputRow {
    /// Its key in JSON, where it has one.
    #[must_use]
    pub fn json_key(&self) -> Option<String> {
        Some(name(self.json?, "", self.quantity.si()))
    }

    /// The names of its columns, one for each component, in the unit of sweeps; empty where it has none.
    ///
    /// ```
    /// use mcm::manipulator::output_table::row;
    /// let tip = row("tip.position").map(|row| row.columns());
    /// assert_eq!(tip, Some(["tip_x_mm", "tip_y_mm", "tip_z_mm"].map(String::from).to_vec()));
    /// ```
    #[must_use]
    pub fn columns(&self) -> Vec<String> {
        self.column.map_or_else(Vec::new, |Spelling { stem, unit }| self.columns_in(stem, unit))
    }

    /// The names of its columns with another stem or in another unit.
    #[must_use]
    pub fn columns_in(&self, stem: &str, unit: Spelled) -> Vec<String> {
        let components: &[&str] = match self.components {
            1 => &[""],
            3 => &["x", "y", "z"],
            _ => &["w", "x", "y", "z"],
        };
        components.iter().map(|component| name(stem, component, unit)).collect()
    }

    /// All spellings of its columns: by the stem of sweeps or by the name in the FMU, in the unit of sweeps or in any other.
    #[must_use]
    pub fn spellings(&self) -> Vec<(String, Spelled)> {
        let Some(Spelling { stem, unit }) = self.column else { return Vec::new() };
        let own = self.name.replace('.', "_");
        let stems = [stem].into_iter().chain((own != stem).then_some(own.as_str()));
        let others = self.quantity.spellings().iter().copied().filter(|other| *other != unit);
        let units: Vec<Spelled> = [unit].into_iter().chain(others).collect();
        stems.flat_map(|stem| units.iter().map(|unit| (stem.to_owned(), *unit))).collect()
    }
}
