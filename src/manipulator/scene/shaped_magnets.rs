//! Magnets that a scene gives by their shape.

use toml::Value;

use super::magnet_shape::{DEVIATIONS, GRADES, OF_ALL, SOLID, key_of};
use super::names::Unit;
use super::path::suggestion;
use super::sources::{MagnetCylinder, MagnetEntries, Magnets};
use crate::error::{Error, Quantity};
use crate::magnetics::{SHAPES, Shape, ShapedMagnet, shape_named};

impl Magnets {
    /// Fills in the defaults that depend on the shape, and the remanence of a grade; calls `known` with the key of that number and its
    /// standard deviation.
    pub(super) fn complete(&mut self, mut known: impl FnMut(String, f64)) {
        let several = self.0.len() > 1;
        for (number, magnet) in (1..).zip(&mut self.0) {
            if let Some(deviation) = magnet.complete() {
                let table = if several { format!("magnet[{number}]") } else { "magnet".into() };
                known(format!("{table}.remanence_t"), deviation);
            }
        }
    }
}

impl MagnetEntries {
    /// Fills in the defaults; the standard deviation of the remanence where it is that of a grade.
    fn complete(&mut self) -> Option<f64> {
        let Some(shape) = self.shape.as_deref().and_then(shape_named) else {
            if self.stated().is_none() {
                self.cylinders.get_or_insert_with(MagnetCylinder::pair);
            }
            return None;
        };
        self.direction.get_or_insert([0.0, 0.0, 1.0]);
        if shape.dimensions.iter().any(|quantity| key_of(quantity.key) == SOLID) {
            self.inner_radius_mm.get_or_insert(0.0);
        }
        if self.remanence_t.is_some() {
            return None;
        }
        let (_, [low, high]) = GRADES.into_iter().find(|(name, _)| self.grade.as_deref() == Some(*name))?;
        self.grade = None;
        self.remanence_t = Some(0.5 * (low + high));
        Some((high - low) / DEVIATIONS)
    }

    /// The first key that is stated and belongs to a shape.
    fn stated(&self) -> Option<String> {
        let own = Value::try_from(self).ok()?;
        let dimensions = SHAPES.iter().flat_map(|shape| shape.dimensions).map(|one| key_of(one.key));
        dimensions.chain(OF_ALL).find(|key| own.get(key).is_some()).map(str::to_owned)
    }

    /// The magnet in SI units where it is given by its shape; `key` is that of the table.
    pub(super) fn shaped(&self, key: &str) -> Result<Option<ShapedMagnet>, Error> {
        let refused = |reason: String| Err(Error::Unsupported(reason));
        let Some(shape) = self.shape.as_deref().and_then(shape_named) else {
            return match self.stated() {
                Some(stated) => refused(format!("{key}.{stated} needs {key}.shape")),
                None => Ok(None),
            };
        };
        if self.cylinders.is_some() {
            return refused(format!(
                "{key}.cylinders has no meaning beside {key}.shape: give one or the other"
            ));
        }
        self.refuse_other_dimensions(shape, key)?;

        let own = Value::try_from(self).unwrap_or(Value::Boolean(false));
        let number = |(place, quantity): (usize, &Quantity)| {
            let name = key_of(quantity.key);
            let found = own.get(name).map(|value| value.as_array().map_or(value, |list| &list[place]));
            let found = found.and_then(Value::as_float);
            let missing = || Error::Unsupported(format!("{key}.{name} is missing"));
            found.map(|number| number / Unit::of(name).per_si()).ok_or_else(missing)
        };
        Ok(Some(ShapedMagnet {
            shape,
            dimensions: shape.numbered().map(number).collect::<Result<_, _>>()?,
            direction: self.direction.unwrap_or([0.0, 0.0, 1.0]),
            remanence: self.remanence(key)?,
        }))
    }

    /// Checks that no dimension of another shape is stated.
    fn refuse_other_dimensions(&self, shape: &Shape, key: &str) -> Result<(), Error> {
        let own = Value::try_from(self).unwrap_or(Value::Boolean(false));
        let belongs = |name: &str| shape.dimensions.iter().any(|quantity| key_of(quantity.key) == name);
        let all = SHAPES.iter().flat_map(|shape| shape.dimensions).map(|quantity| key_of(quantity.key));
        match all.into_iter().find(|name| own.get(name).is_some() && !belongs(name)) {
            Some(name) => {
                let reason = format!("{key}.{name} has no meaning for {key}.shape = \"{}\"", shape.name);
                Err(Error::Unsupported(reason))
            }
            None => Ok(()),
        }
    }

    /// The remanence, T.
    fn remanence(&self, key: &str) -> Result<f64, Error> {
        match (self.remanence_t, &self.grade) {
            (Some(remanence), None) => Ok(remanence),
            (Some(_), Some(_)) => Err(Error::Unsupported(format!(
                "{key}.grade has no meaning beside {key}.remanence_t: give one or the other"
            ))),
            (None, Some(grade)) => {
                let known = GRADES.map(|(name, _)| name);
                let hint = suggestion(grade, &known);
                Err(Error::Unsupported(format!("{key}.grade: \"{grade}\" is not known here{hint}")))
            }
            (None, None) => Err(Error::Unsupported(format!("{key}.remanence_t is missing, or {key}.grade"))),
        }
    }
}
