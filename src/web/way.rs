//! The way of a device as a page keeps it: rows of all its inputs, and the scene that leads along them.

use std::fmt::Write as _;

use super::Device;
use crate::error::Error;
use crate::fmi::value::Value;
use crate::manipulator::WayRow;

impl Device {
    /// The scene at these inputs (SI), to which its device comes along `way`, rows of all inputs one after the other.
    ///
    /// ```
    /// use mcm::manipulator::Scene;
    /// use mcm::web::Device;
    /// let device = Device::open("[design]\nsegments = 1\n[magnet]", None)?;
    /// let (way, mut inputs) = (device.start(), device.start());
    /// inputs[1] += 0.01; // magnet.position[2], m
    /// let moved = Scene::parse(&device.scene_at(&inputs, &way)?, "moved")?;
    /// assert_eq!(moved.inputs.sources[0].pose.position.y, inputs[1]);
    /// assert_eq!(moved.way.rows()[0]["magnet.position[2]"], way[1]);
    /// # Ok::<(), mcm::error::Error>(())
    /// ```
    ///
    /// # Errors
    /// [`Error::Count`] for another number of inputs; those of the inputs, and of a scene that cannot be written.
    pub fn scene_at(&self, inputs: &[f64], way: &[f64]) -> Result<String, Error> {
        let mut values = self.package.start().clone();
        for (&reference, &value) in self.inputs.iter().zip(inputs) {
            if let Some(variable) = self.package.table().find(reference) {
                variable.set(&mut values, Value::Real(value))?;
            }
        }
        self.file.at(&values.inputs()?, &self.rows(inputs, way)?)?.to_toml()
    }

    /// The rows of a way to these inputs as the text of a scene's tables `[[start.way]]`.
    ///
    /// # Errors
    /// [`Error::Count`] for another number of inputs.
    pub fn way_text(&self, inputs: &[f64], way: &[f64]) -> Result<String, Error> {
        let mut text = String::new();
        for row in self.rows(inputs, way)? {
            text.push_str("\n[[start.way]]\n");
            for (name, value) in row {
                // Writing to a string cannot fail.
                let _ = writeln!(text, "\"{name}\" = {value:?}");
            }
        }
        Ok(text)
    }

    /// The rows of a way: those inputs that differ anywhere on it from where it leads to. An orientation has all its components, or none.
    fn rows(&self, inputs: &[f64], way: &[f64]) -> Result<Vec<WayRow>, Error> {
        let count = self.inputs.len();
        for given in [inputs.len(), way.len() % count.max(1)] {
            if given != count && given != 0 {
                let expected = format!("{count} for each row");
                return Err(Error::Count { quantity: "inputs of a way".into(), given, expected });
            }
        }

        let names: Vec<&str> = self
            .inputs
            .iter()
            .filter_map(|&at| self.package.table().find(at))
            .map(|row| row.name.as_str())
            .collect();

        // A part of a quaternion has no meaning without the others.
        let group = |name: &str| match name.split_once(".orientation[") {
            Some((body, _)) => format!("{body}.orientation"),
            None => name.to_owned(),
        };

        let rows: Vec<&[f64]> = way.chunks_exact(count.max(1)).collect();
        let differs = |index: usize| rows.iter().any(|row| row[index].to_bits() != inputs[index].to_bits());
        let moved: Vec<String> =
            (0..names.len()).filter(|index| differs(*index)).map(|index| group(names[index])).collect();

        let row = |row: &&[f64]| {
            let kept = names.iter().zip(*row).filter(|(name, _)| moved.contains(&group(name)));
            kept.map(|(name, value)| ((*name).to_owned(), *value)).collect()
        };
        Ok(rows.iter().map(row).collect())
    }
}
