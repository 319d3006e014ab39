//! The wrench of magnets and coils on one another.
//!
//! A magnet feels the field at the charges on its faces, a winding at its current, and a coil with an iron core, of which only the
//! field outside a sphere is known, by the Maxwell stress on that sphere.

use core::f64::consts::PI;

use nalgebra::Vector3;

use super::assembly::Assembly;
use super::coil::Coil;
use super::overlap::depth;
use super::sources::Sources;
use super::wrench::{Wrench, check_accuracy, refined};
use crate::constants::VACUUM_PERMEABILITY;
use crate::error::Error;
use crate::geometry::Pose;
use crate::numerics::quadrature::gauss_legendre;

/// Accuracies that are tried one after the other: bodies that almost touch do not reach the first.
const ACCURACIES: [f64; 3] = [1e-6, 1e-4, 1e-2];

/// By how much the sphere on which the stress is taken is larger than that of the multipoles.
const OUTSIDE: f64 = 1.0 + 1e-9;

impl Assembly {
    /// The wrench on another source at `pose` in the frame of this one, both of strength 1 (coils: of one ampere), in the axes of
    /// this frame; the torque is about the other's origin. `accuracy` is that of [`super::AxialSource::wrench_on`].
    ///
    /// ```
    /// use mcm::geometry::Pose;
    /// use mcm::magnetics::{Assembly, AxialMagnet, Coil};
    /// let magnet = AxialMagnet { radius: 5e-3, inner_radius: 0.0, length: 10e-3, offset: 0.0, remanence: 1.3 };
    /// let coil = Coil { inner_radius: 20e-3, outer_radius: 40e-3, length: 60e-3, turns: 600.0, core: None };
    /// let (magnet, coil) = (Assembly::new(vec![magnet])?, Assembly::of_coil(coil)?);
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
        match (other.coil(), other.reach()) {
            (None, _) => self.on_magnets(other, pose, accuracy),
            (Some(coil), None) => self.on_winding(coil, pose, accuracy),
            (Some(_), Some(_)) if self.reach().is_none() => {
                let back = Pose::identity().seen_from(pose);
                let wrench = other.wrench_on_source(self, &back, accuracy)?.reaction(&back.position);
                Ok(Wrench { force: pose.rotation * wrench.force, torque: pose.rotation * wrench.torque })
            }
            (Some(_), Some(reach)) => self.on_sphere((other, reach), pose, accuracy),
        }
    }

    /// How deep another source at `pose` is in this one, m; 0 where they are apart.
    pub(super) fn depth_in(&self, other: &Self, pose: &Pose) -> f64 {
        let bodies = self.outlines().flat_map(|(one, place)| {
            other.outlines().map(move |(outline, centre)| {
                let position = pose.transform(&centre) - place;
                depth(&one, &outline, &Pose { position, ..*pose })
            })
        });
        bodies.fold(0.0, f64::max)
    }

    fn on_magnets(&self, other: &Self, pose: &Pose, accuracy: f64) -> Result<Wrench, Error> {
        let mut sum = Wrench::NONE;
        for (source, centre) in other.placed(&[]) {
            let wrench = self.wrench_on(source, &pose.advanced(centre.z), accuracy)?;
            sum.force += wrench.force;
            sum.torque += wrench.torque + (pose.rotation * centre).cross(&wrench.force);
        }
        Ok(sum)
    }

    /// The wrench on a winding of one ampere: the sum of current times field.
    fn on_winding(&self, coil: &Coil, pose: &Pose, accuracy: f64) -> Result<Wrench, Error> {
        let &Coil { inner_radius, outer_radius, length, turns, .. } = coil;
        let (middle, half) = (0.5 * (outer_radius + inner_radius), 0.5 * (outer_radius - inner_radius));
        let density = turns / (2.0 * half * length);
        let by = |(along, around): (usize, usize)| {
            let (radii, weights) = gauss_legendre(along);
            let (heights, shares) = gauss_legendre(2 * along);
            let mut sum = Sum::NONE;
            for (height, share) in heights.iter().zip(&shares) {
                for (radius, weight) in radii.iter().zip(&weights) {
                    let rho = middle + half * radius;
                    let area = 0.5 * half * length * weight * share;
                    let current = density * area * rho * 2.0 * PI / around as f64;
                    for (sine, cosine) in directions(around) {
                        let arm = Vector3::new(rho * cosine, rho * sine, 0.5 * length * height);
                        let arm = pose.rotation * arm;
                        let along = pose.rotation * Vector3::new(-sine, cosine, 0.0);
                        let field = self.field(&(pose.position + arm))?;
                        sum.add(&arm, &(along.cross(&field) * current));
                    }
                }
            }
            Ok((sum.wrench, sum.size))
        };
        refined(self.ratio(outer_radius.hypot(0.5 * length), pose), outer_radius, accuracy, by)
    }

    /// The wrench on a source whose field is known outside a sphere about its centre, by the Maxwell stress on that.
    fn on_sphere(&self, (other, reach): (&Self, f64), pose: &Pose, accuracy: f64) -> Result<Wrench, Error> {
        let radius = reach * OUTSIDE;
        let by = |(_, around): (usize, usize)| {
            let (heights, shares) = gauss_legendre(around / 2);
            let mut sum = Sum::NONE;
            for (height, share) in heights.iter().zip(&shares) {
                let across = (1.0 - height * height).sqrt();
                for (sine, cosine) in directions(around) {
                    let local = Vector3::new(across * cosine, across * sine, *height);
                    let normal = pose.rotation * local;
                    let (arm, own) = (normal * radius, pose.rotation * other.field(&(local * radius))?);
                    let field = self.field(&(pose.position + arm))?;
                    let stress =
                        own * field.dot(&normal) + field * own.dot(&normal) - normal * own.dot(&field);
                    let area = radius * radius * share * 2.0 * PI / around as f64;
                    sum.add(&arm, &(stress * (area / VACUUM_PERMEABILITY)));
                }
            }
            Ok((sum.wrench, sum.size))
        };
        refined(self.ratio(radius, pose), radius, accuracy, by)
    }

    /// The extent of a body over the distance from its centre to what makes this field.
    fn ratio(&self, extent: f64, pose: &Pose) -> f64 {
        extent / self.distance(&pose.position)
    }
}

/// Sine and cosine of evenly spaced angles.
fn directions(count: usize) -> impl Iterator<Item = (f64, f64)> {
    (0..count).map(move |step| (2.0 * PI * (step as f64 + 0.5) / count as f64).sin_cos())
}

/// Forces at points, added up.
struct Sum {
    wrench: Wrench,
    /// Sum of the magnitudes, N.
    size: f64,
}

impl Sum {
    const NONE: Self = Self { wrench: Wrench::NONE, size: 0.0 };

    fn add(&mut self, arm: &Vector3<f64>, force: &Vector3<f64>) {
        self.wrench.force += force;
        self.wrench.torque += arm.cross(force);
        self.size += force.norm();
    }
}

impl Sources {
    /// The wrench of all other sources on each, by its number, about its centre and in the world frame; `at` gives pose and strength
    /// (coils: current, A) of each.
    ///
    /// Good to 1e-6; where bodies almost touch, at least to 1e-2.
    ///
    /// # Errors
    /// As [`Assembly::wrench_on_source`], naming both sources.
    pub fn mutual_wrenches(&self, at: impl Fn(usize) -> Option<(Pose, f64)>) -> Result<Vec<Wrench>, Error> {
        let mut out = vec![Wrench::NONE; self.further().len() + 1];
        for (number, second) in self.numbered() {
            for (before, first) in self.numbered().take_while(|(before, _)| *before < number) {
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
