//! The model as a function of its parameters: residuals and their exact derivatives.

use nalgebra::{DMatrix, DVector};
use rayon::prelude::*;

use super::data::Data;
use crate::error::Error;
use crate::manipulator::{Inputs, Manipulator, Neighbours, SceneFile, Sensitivities, Status};

/// A scene whose numbers at these keys are sought.
#[derive(Debug, Clone)]
pub(super) struct Problem<'a> {
    pub(super) file: &'a SceneFile,
    pub(super) keys: &'a [String],
    pub(super) data: &'a Data,
}

/// The answers of the model to all rows.
#[derive(Debug, Clone)]
pub(super) struct Answers {
    file: SceneFile,
    /// The device at each row.
    devices: Vec<(Manipulator, Inputs)>,
    /// What the model gives for each measured number, in its unit.
    pub(super) computed: DVector<f64>,
}

/// Why there are none.
#[derive(Debug)]
pub(super) enum Missing {
    /// A number is out of its range.
    Refused(Error),
    /// There is no shape at this row, counted from 1.
    NoShape(usize, String),
}

impl Problem<'_> {
    /// The scene with these values of the parameters.
    pub(super) fn scene(&self, values: &DVector<f64>) -> Result<SceneFile, Error> {
        let mut file = self.file.clone();
        for (key, value) in self.keys.iter().zip(values) {
            file = file.with(key, *value)?;
        }
        Ok(file)
    }

    /// Solves all rows, each from the shape of the one before.
    pub(super) fn answers(&self, values: &DVector<f64>) -> Result<Answers, Missing> {
        let file = self.scene(values).map_err(Missing::Refused)?;
        let scene = file.scene().map_err(Missing::Refused)?;
        let mut device = scene.manipulator(2).map_err(Missing::Refused)?;
        let (mut devices, mut computed) = (Vec::new(), Vec::new());
        for (number, row) in self.data.rows.iter().enumerate() {
            let inputs = self.data.inputs(&row.inputs, &scene.inputs);
            let outputs = device.solve(&inputs).map_err(Missing::Refused)?;
            if outputs.status == Status::NotSolved {
                return Err(Missing::NoShape(number + 1, outputs.outcome.name().replace('_', " ")));
            }
            computed.extend(row.measured.iter().map(|each| each.quantity.read(outputs)));
            devices.push((device.clone(), inputs));
        }
        Ok(Answers { file, devices, computed: DVector::from_vec(computed) })
    }

    /// Derivatives of what the model gives by the parameters: a row for each measured number, a column for each parameter.
    pub(super) fn rates(&self, answers: &Answers) -> Result<DMatrix<f64>, Error> {
        let neighbours = Neighbours::new(&answers.file, self.keys)?;
        let rows: Vec<(&(Manipulator, Inputs), usize)> = answers.devices.iter().zip(0..).collect();
        let sensitivities = rows.into_par_iter().map_init(
            || neighbours.clone(),
            |neighbours, ((device, _), number)| self.sensitivities(neighbours, device, number),
        );
        let sensitivities = sensitivities.collect::<Result<Vec<Sensitivities>, Error>>()?;
        let mut rows = Vec::new();
        for (sensitivities, row) in sensitivities.iter().zip(&self.data.rows) {
            let each =
                |quantity: super::Quantity| sensitivities.of(|outputs| quantity.read(outputs)).transpose();
            rows.extend(row.measured.iter().map(|measured| each(measured.quantity)));
        }
        Ok(DMatrix::from_rows(&rows))
    }

    fn sensitivities(
        &self,
        neighbours: &mut Neighbours,
        device: &Manipulator,
        number: usize,
    ) -> Result<Sensitivities, Error> {
        let row = &self.data.rows[number].inputs;
        neighbours.sensitivities_at(device, |own| self.data.inputs(row, own))
    }

    /// Derivatives of what the first row measures by the parameters, with other inputs there; `None` where there is no shape.
    pub(super) fn rates_with(
        &self,
        answers: &Answers,
        change: impl Fn(&mut Inputs),
    ) -> Result<Option<DMatrix<f64>>, Error> {
        let (Some((device, inputs)), Some(row)) = (answers.devices.first(), self.data.rows.first()) else {
            return Ok(None);
        };
        let (mut device, mut changed) = (device.clone(), inputs.clone());
        change(&mut changed);
        if device.solve(&changed)?.status == Status::NotSolved {
            return Ok(None);
        }
        let mut neighbours = Neighbours::new(&answers.file, self.keys)?;
        let found = neighbours.sensitivities_at(&device, |own| {
            let mut inputs = self.data.inputs(&row.inputs, own);
            change(&mut inputs);
            inputs
        });
        let sensitivities = match found {
            Err(Error::NoDerivatives(_)) => return Ok(None),
            found => found?,
        };
        let each = |quantity: super::Quantity| sensitivities.of(|outputs| quantity.read(outputs)).transpose();
        let rows: Vec<_> = row.measured.iter().map(|measured| each(measured.quantity)).collect();
        Ok(Some(DMatrix::from_rows(&rows)))
    }
}
