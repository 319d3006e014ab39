//! The wrench of magnets and coils on one another.
//!
//! What a kind feels in the field of another source stands in its own file; here is which of two sources is asked.

use core::f64::consts::PI;

use nalgebra::Vector3;

use super::list::Sources;
use super::source::Source;
use crate::error::Error;
use crate::geometry::Pose;
use crate::magnetics::overlap::depth;
use crate::magnetics::wrench::{Wrench, check_accuracy};

/// Accuracies that are tried one after the other: bodies that almost touch do not reach the first.
const ACCURACIES: [f64; 3] = [1e-6, 1e-4, 1e-2];

impl Source {
    /// The wrench on another source at `pose` in the frame of this one, both of strength 1 (coils: of one ampere), in the axes of
    /// this frame; the torque is about the other's origin. `accuracy` is that of [`crate::magnetics::AxialSource::wrench_on`].
    ///
    /// ```
    /// use mcm::geometry::Pose;
    /// use mcm::magnetics::{AxialMagnet, Coil, Cylinders, Solenoid, Source};
    /// let magnet = AxialMagnet { radius: 5e-3, inner_radius: 0.0, length: 10e-3, offset: 0.0, remanence: 1.3 };
    /// let coil = Coil { inner_radius: 20e-3, outer_radius: 40e-3, length: 60e-3, turns: 600.0 };
    /// let (magnet, coil) = (Cylinders::new(vec![magnet])?, Solenoid::new(coil)?);
    /// let (magnet, coil) = (Source::from(magnet), Source::from(coil));
    /// let wrench = coil.wrench_on_source(&magnet, &Pose::identity().advanced(60e-3), 1e-6)?;
    /// assert!(wrench.force.z < 0.0); // poles in line attract
    /// # Ok::<(), mcm::error::Error>(())
    /// ```
    ///
    /// # Errors
    /// [`Error::Unsupported`] when the bodies overlap; [`Error::Range`] for an accuracy out of range or not attained, and for a body
    /// in the sphere in which the multipoles of an iron core say nothing.
    pub fn wrench_on_source(&self, other: &Self, pose: &Pose, accuracy: f64) -> Result<Wrench, Error> {
        check_accuracy(accuracy)?;
        let deepest = self.depth_in(other, pose);
        if deepest > 0.0 {
            return Err(Error::Unsupported(format!("the bodies overlap by {:.3} mm", 1e3 * deepest)));
        }

        // Of two, the one whose field is known everywhere makes it, so that no sphere need be free of the other.
        if other.unknown_within() > 0.0 && self.unknown_within() == 0.0 {
            let back = Pose::identity().seen_from(pose);
            let wrench = self.wrench_in(other, &back, accuracy)?.reaction(&back.position);
            return Ok(Wrench { force: pose.rotation * wrench.force, torque: pose.rotation * wrench.torque });
        }
        other.wrench_in(self, pose, accuracy)
    }

    /// How deep another source at `pose` is in this one, m; 0 where they are apart.
    pub(super) fn depth_in(&self, other: &Self, pose: &Pose) -> f64 {
        let bodies = self.parts().iter().flat_map(|one| {
            other.parts().iter().map(move |part| {
                let position = pose.transform(&part.centre) - one.centre;
                depth(&one.outline, &part.outline, &Pose { position, ..*pose })
            })
        });
        bodies.fold(0.0, f64::max)
    }
}

/// The extent of a body, at `pose` in the frame of `other`, over the distance from its centre to what makes that field.
pub(super) fn around(extent: f64, other: &Source, pose: &Pose) -> f64 {
    extent / other.distance(&pose.position)
}

/// Sine and cosine of evenly spaced angles.
pub(super) fn directions(count: usize) -> impl Iterator<Item = (f64, f64)> {
    (0..count).map(move |step| (2.0 * PI * (step as f64 + 0.5) / count as f64).sin_cos())
}

/// Forces at points, added up.
pub(super) struct Sum {
    wrench: Wrench,
    /// Sum of the magnitudes, N.
    size: f64,
}

impl Sum {
    pub(super) const NONE: Self = Self { wrench: Wrench::NONE, size: 0.0 };

    pub(super) fn add(&mut self, arm: &Vector3<f64>, force: &Vector3<f64>) {
        self.wrench.force += force;
        self.wrench.torque += arm.cross(force);
        self.size += force.norm();
    }

    /// The wrench of the field of `other` on magnetic charges at `pose` in its frame; `charges` hands each place, in the frame of the
    /// body, with its charge (A m) to what it is given.
    pub(super) fn on_charges(
        other: &Source,
        pose: &Pose,
        charges: impl FnOnce(&mut dyn FnMut(Vector3<f64>, f64)),
    ) -> Result<(Wrench, f64), Error> {
        let (mut arms, mut strengths) = (Vec::new(), Vec::new());
        charges(&mut |place, charge| {
            arms.push(pose.rotation * place);
            strengths.push(charge);
        });
        let points: Vec<Vector3<f64>> = arms.iter().map(|arm| pose.position + arm).collect();
        let mut fields = vec![Vector3::zeros(); points.len()];
        other.fields(&points, &mut fields)?;

        let mut sum = Self::NONE;
        for ((arm, charge), field) in arms.iter().zip(&strengths).zip(&fields) {
            sum.add(arm, &(field * *charge));
        }
        Ok(sum.wrench_and_size())
    }

    /// What was added up, and the sum of the magnitudes, N.
    pub(super) fn wrench_and_size(&self) -> (Wrench, f64) {
        (self.wrench, self.size)
    }
}

impl Sources {
    /// The wrench of all other sources on each, by its number, about its centre and in the world frame; `at` gives pose and strength
    /// (coils: current, A) of each.
    ///
    /// Good to 1e-6; where bodies almost touch, at least to 1e-2.
    ///
    /// # Errors
    /// As [`Source::wrench_on_source`], naming both sources.
    pub fn mutual_wrenches(&self, at: impl Fn(usize) -> Option<(Pose, f64)>) -> Result<Vec<Wrench>, Error> {
        let mut out = vec![Wrench::NONE; self.list().len()];
        for (number, second) in self.list().iter().enumerate() {
            for (before, first) in self.list().iter().enumerate().take(number) {
                let (Some((here, strength)), Some((there, factor))) = (at(before), at(number)) else {
                    continue;
                };
                let strength = strength * factor;
                if strength == 0.0 {
                    continue;
                }

                let seen = there.seen_from(&here);
                let by = |accuracy| first.wrench_on_source(second, &seen, accuracy);
                let [finest, coarser, coarsest] = ACCURACIES;
                let tried = by(finest).or_else(|_| by(coarser)).or_else(|_| by(coarsest));
                let wrench = tried.map_err(|error| {
                    let (one, other) = (self.name(before), self.name(number));
                    Error::Unsupported(format!("{one} and {other}: {error}"))
                })?;

                for (of, own) in [(number, wrench), (before, wrench.reaction(&seen.position))] {
                    out[of].force += here.rotation * own.force * strength;
                    out[of].torque += here.rotation * own.torque * strength;
                }
            }
        }
        Ok(out)
    }
}
