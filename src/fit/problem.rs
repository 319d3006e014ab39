//! Residuals and their derivatives by the parameters.

use nalgebra::{DMatrix, DVector};
use rayon::prelude::*;

use super::devices::{Device, Rows};
use super::measurable::Measurable;
use super::measurements::Measurements;
use crate::error::Error;
use crate::manipulator::{Manipulator, SceneFile, Status};

/// One measured value.
#[derive(Debug, Clone, Copy)]
pub(super) struct Observation {
    pub(super) row: usize,
    pub(super) output: Measurable,
    pub(super) value: f64,
    /// Its standard deviation; 1 where none is stated.
    pub(super) deviation: f64,
}

/// The solved shapes of the rows; `None` for one that does not count.
pub(super) type Shapes = Vec<Option<Manipulator>>;

/// Why parameters were refused.
#[derive(Debug)]
pub(super) enum Refused {
    /// They are out of range.
    Range(Error),
    /// This row finds no shape, or has no derivatives there.
    Row(usize, String),
}

/// The scene, the rows, and what was measured.
#[derive(Debug)]
pub(super) struct Problem<'a> {
    file: &'a SceneFile,
    rows: Rows,
    observations: Vec<Observation>,
    count: usize,
}

impl<'a> Problem<'a> {
    /// # Errors
    /// Those of a row's scene.
    pub(super) fn new(file: &'a SceneFile, keys: &[String], measured: &Measurements) -> Result<Self, Error> {
        let values = measured.rows().iter().map(|row| (format!("line {}", row.line), row.inputs.clone()));
        let rows = Rows::new(file, keys, measured.keys(), values.collect())?;
        let mut observations = Vec::new();
        for (index, row) in measured.rows().iter().enumerate() {
            let cells = row.measured.iter().zip(&row.deviations).zip(measured.outputs());
            observations.extend(cells.filter_map(|((value, deviation), output)| {
                let (value, deviation) = ((*value)?, deviation.unwrap_or(1.0));
                Some(Observation { row: index, output: *output, value, deviation })
            }));
        }
        Ok(Self { file, rows, observations, count: measured.rows().len() })
    }

    /// The measured values of the rows that count.
    pub(super) fn observations(&self, shapes: &Shapes) -> impl Iterator<Item = &Observation> {
        self.observations.iter().filter(|each| shapes[each.row].is_some())
    }

    /// The device with these parameters.
    fn device(&self, parameters: &DVector<f64>) -> Result<Device<'_>, Error> {
        self.rows.device(self.file, parameters.as_slice())
    }

    /// Whether these parameters are allowed.
    pub(super) fn allows(&self, parameters: &DVector<f64>) -> bool {
        self.rows.allows(self.file, parameters.as_slice())
    }

    /// Every row from the unloaded shape: its shape, or why it has none.
    ///
    /// # Errors
    /// Those of parameters out of range.
    pub(super) fn first(&self, parameters: &DVector<f64>) -> Result<Vec<Result<Manipulator, String>>, Error> {
        let device = self.device(parameters)?;
        let solved = |row| device.fresh(row).map(|made| self.checked(row, made));
        (0..self.count).into_par_iter().map(solved).collect()
    }

    /// The rows at other parameters, from the shapes of these.
    ///
    /// # Errors
    /// [`Refused`] where the parameters are out of range, or a row that counts has no shape there.
    pub(super) fn moved(&self, shapes: &Shapes, parameters: &DVector<f64>) -> Result<Shapes, Refused> {
        let device = self.device(parameters).map_err(Refused::Range)?;
        let moved = |(row, from): (usize, &Option<Manipulator>)| {
            let Some(from) = from else { return Ok(None) };
            let made = device.moved(row, from).map_err(Refused::Range)?;
            self.checked(row, made).map(Some).map_err(|reason| Refused::Row(row, reason))
        };
        shapes.par_iter().enumerate().map(moved).collect()
    }

    /// A shape that was found, with all that was measured of it.
    fn checked(&self, row: usize, made: Manipulator) -> Result<Manipulator, String> {
        let outputs = made.outputs();
        if outputs.status == Status::NotSolved {
            return Err(format!("no shape: {}", outputs.outcome));
        }
        let own = self.observations.iter().filter(|each| each.row == row);
        for each in own {
            if !each.output.read(outputs).is_finite() {
                return Err(format!("this device has no {}", each.output.name()));
            }
        }
        Ok(made)
    }

    /// Computed minus measured, in standard deviations.
    pub(super) fn residuals(&self, shapes: &Shapes) -> DVector<f64> {
        let each = self.observations(shapes).filter_map(|each| {
            let outputs = shapes[each.row].as_ref()?.outputs();
            Some((each.output.read(outputs) - each.value) / each.deviation)
        });
        DVector::from_vec(each.collect())
    }

    /// Derivatives of the residuals by the parameters, a row for each residual.
    ///
    /// # Errors
    /// [`Refused::Row`] where a row has none, as at a fold.
    pub(super) fn jacobian(
        &self,
        shapes: &Shapes,
        parameters: &DVector<f64>,
    ) -> Result<DMatrix<f64>, Refused> {
        let device = self.device(parameters).map_err(Refused::Range)?;
        let neighbours = device.neighbours().map_err(Refused::Range)?;

        // One set of neighbouring devices for each thread: every row changes them.
        let part = shapes.len().div_ceil(rayon::current_num_threads()).max(1);
        let parts = shapes.par_chunks(part).enumerate().map(|(number, shapes)| {
            let mut neighbours = neighbours.clone();
            let mut rows = Vec::new();
            for (index, shape) in shapes.iter().enumerate() {
                let row = number * part + index;
                let Some(shape) = shape else { continue };
                let found = device.sensitivities(row, shape, &mut neighbours);
                let found = found.map_err(|error| Refused::Row(row, error.to_string()))?;
                for each in self.observations.iter().filter(|each| each.row == row) {
                    rows.push(found.of(|outputs| each.output.read(outputs)) / each.deviation);
                }
            }
            Ok(rows)
        });

        let rows: Vec<DVector<f64>> = parts.collect::<Result<Vec<_>, Refused>>()?.concat();
        Ok(DMatrix::from_fn(rows.len(), parameters.len(), |i, j| rows[i][j]))
    }
}
