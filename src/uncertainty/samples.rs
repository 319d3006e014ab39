//! Samples: devices drawn at random, each solved.

use nalgebra::{Cholesky, DVector};
use rand::SeedableRng;
use rand::rngs::StdRng;
use rand_distr::{Distribution, StandardNormal};
use rayon::prelude::*;

use super::bands::stated;
use crate::error::{Error, check};
use crate::manipulator::{Manipulator, Outputs, SceneFile, Status};

/// Part of a distribution below the limits of its band of 95 %, in fortieths.
const TAILS: [usize; 2] = [1, 39];

/// Random devices whose numbers are normally distributed about those of a scene, each solved from the shape of the scene's device.
///
/// So each answers: would a device that differs by so much hold this shape, only a little changed, or has it snapped?
#[derive(Debug, Clone)]
pub struct Samples {
    outputs: Vec<Outputs>,
    snapped: usize,
    lost: usize,
    refused: usize,
}

/// What became of one device.
enum Drawn {
    On(Box<Outputs>),
    Snapped,
    Lost,
    Refused,
}

impl Samples {
    /// Draws `count` devices of the scene `file` near the last solved shape of `manipulator`, which is one of that scene, and solves
    /// them on all cores; `done` is called after each. Equal seeds draw equal devices.
    ///
    /// # Errors
    /// [`Error::Unsupported`] for a scene without `[uncertainty]`, before the first solve, and where the push on a shaft is given;
    /// [`Error::Range`] for no devices.
    pub fn draw(
        file: &SceneFile,
        manipulator: &Manipulator,
        count: usize,
        seed: u64,
        done: impl Fn() + Sync,
    ) -> Result<Self, Error> {
        let uncertainty = stated(file)?;
        check("number of samples", count as f64, |v| (1.0..=1e7).contains(&v), "from 1 to 10000000")?;
        let values = uncertainty.keys.iter().map(|key| file.number(key)).collect::<Result<Vec<_>, _>>()?;
        let contradicting = || Error::Unsupported("the correlations contradict one another".into());
        let factor = Cholesky::new(uncertainty.covariance()).ok_or_else(contradicting)?.unpack();

        // All deviates are drawn before the devices are solved, so that the seed alone decides, not the
        // threads.
        let mut random = StdRng::seed_from_u64(seed);
        let deviates: Vec<DVector<f64>> = (0..count)
            .map(|_| {
                let normal = (0..values.len()).map(|_| StandardNormal.sample(&mut random));
                &factor * DVector::from_iterator(values.len(), normal)
            })
            .collect();

        let device = |deviate: &DVector<f64>| {
            let mut varied = file.clone();
            for ((key, value), by) in uncertainty.keys.iter().zip(&values).zip(deviate) {
                match varied.with(key, value + by) {
                    Ok(next) => varied = next,
                    Err(_) => return Ok(Drawn::Refused),
                }
            }

            let Ok(scene) = varied.scene() else { return Ok(Drawn::Refused) };
            let outputs = manipulator.variant(&scene.variant()?)?;
            done();
            Ok(match outputs.status {
                Status::NotSolved => Drawn::Lost,
                Status::Snapped => Drawn::Snapped,
                _ if outputs.stable == Some(false) => Drawn::Lost,
                Status::Solved | Status::NearFold => Drawn::On(Box::new(outputs)),
            })
        };

        Ok(Self::of(deviates.par_iter().map(device).collect::<Result<Vec<_>, Error>>()?))
    }

    fn of(drawn: Vec<Drawn>) -> Self {
        let mut out = Self { outputs: Vec::new(), snapped: 0, lost: 0, refused: 0 };
        for each in drawn {
            match each {
                Drawn::On(outputs) => out.outputs.push(*outputs),
                Drawn::Snapped => out.snapped += 1,
                Drawn::Lost => out.lost += 1,
                Drawn::Refused => out.refused += 1,
            }
        }
        out
    }

    /// The outputs of the devices that hold the shape.
    #[must_use]
    pub fn outputs(&self) -> &[Outputs] {
        &self.outputs
    }

    /// Part of the devices that have snapped to another shape or found none; NaN where none could be built.
    #[must_use]
    pub fn snap_probability(&self) -> f64 {
        let gone = (self.snapped + self.lost) as f64;
        gone / (gone + self.outputs.len() as f64)
    }

    /// Number of devices that found no shape at all, among those of [`Self::snap_probability`].
    #[must_use]
    pub fn lost(&self) -> usize {
        self.lost
    }

    /// Number of draws that are no device, because a number is out of its range; they count for nothing.
    #[must_use]
    pub fn refused(&self) -> usize {
        self.refused
    }

    /// The values between which 95 % of the devices that hold the shape lie, of what `read` reads; `None` where none does.
    #[must_use]
    pub fn band(&self, read: impl Fn(&Outputs) -> f64) -> Option<[f64; 2]> {
        let mut values: Vec<f64> = self.outputs.iter().map(read).collect();
        values.sort_by(f64::total_cmp);
        let last = values.len().checked_sub(1)?;
        Some(TAILS.map(|part| {
            let (place, beyond) = (part * last / 40, (part * last % 40) as f64 / 40.0);
            let before = values[place];
            before + (values[(place + 1).min(last)] - before) * beyond
        }))
    }

    /// Mean and standard deviation of what `read` reads, of the devices that hold the shape; NaN of fewer than two.
    #[must_use]
    pub fn moments(&self, read: impl Fn(&Outputs) -> f64) -> [f64; 2] {
        let values: Vec<f64> = self.outputs.iter().map(read).collect();
        let count = values.len() as f64;
        let mean = values.iter().sum::<f64>() / count;
        let squares: f64 = values.iter().map(|value| (value - mean).powi(2)).sum();
        [mean, (squares / (count - 1.0)).sqrt()]
    }
}
