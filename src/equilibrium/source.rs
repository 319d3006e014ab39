//! Field sources, and the energy of rings and stations in their fields.
//!
//! Energies are computed in the frame of the source, where its field is cheapest; only their sums are rotated.

use nalgebra::{Matrix3, Vector2, Vector3};

use super::chain::Chain;
use super::ring_body::RingBody;
use super::span_quadrature::SectionSample;
use crate::geometry::Pose;
use crate::magnetics::{Assembly, AxialRule, AxialSource, FaceRule, SecondSums, SheetSums};
use crate::rod::{Charges, Load, Order, SectionDipoles, SectionMaterial, SectionStiffness, Station};

/// The magnet that makes the field of a source.
#[derive(Debug, Clone, Copy)]
enum Magnet<'a> {
    Assembly(&'a Assembly, f64),
    Ring(&'a AxialSource),
}

/// Sections of an element in the field of one source, and the loads on them; storage that is used again.
#[derive(Debug, Clone, Default)]
pub(crate) struct SectionBatch {
    /// Poses of the element's stations in the world.
    stations: Vec<Pose>,
    /// Poses of the sections in the frame of the source.
    pub(super) sections: Vec<Pose>,
    /// Energy of each section as a load on its frame, in the axes of the source.
    pub(super) loads: Vec<Load>,
}

impl SectionBatch {
    /// Places the stations of an element, given by their poses in the world.
    pub(super) fn place(&mut self, stations: impl Iterator<Item = Pose>) {
        self.stations.clear();
        self.stations.extend(stations);
    }
}

/// Field (T) and its derivatives at a point.
struct Near {
    field: Vector3<f64>,
    gradient: Matrix3<f64>,
    /// Second derivative of the field component along an axis.
    along: Option<Matrix3<f64>>,
}

/// A field source at a pose.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Source<'a> {
    frame: Pose,
    magnet: Magnet<'a>,
    /// Largest spread (see [`Station::spread`]) for which the material of a section is represented by one point, m2.
    compact: f64,
}

impl<'a> Source<'a> {
    /// The external magnet at its pose, with its field scaled by `strength`.
    pub(crate) fn assembly(assembly: &'a Assembly, frame: Pose, strength: f64) -> Self {
        Self { frame, magnet: Magnet::Assembly(assembly, strength), compact: 0.0 }
    }

    /// The same source for a `chain` with its base at `base`, whose sections are sampled as coarsely as this relative
    /// `accuracy` of the energies allows.
    ///
    /// The mean field of a dipole over a section at distance `d` along its axis is `B (1 - 3 spread / d^2)`. The distance
    /// is taken to everything that the chain may reach, so that the choice depends on the inputs alone.
    pub(crate) fn seen_by(self, chain: &Chain, base: &Pose, accuracy: f64) -> Self {
        let reach = self.distance(&base.position) - chain.length();
        Self { compact: accuracy / 3.0 * reach * reach.max(0.0), ..self }
    }

    /// The points of a station's section, each of which carries an equal share of its material.
    pub(crate) fn points<'s>(&self, station: &'s Station) -> &'s [Vector2<f64>] {
        if station.spread <= self.compact { &station.points.0 } else { &station.points.1 }
    }

    /// A ring of the manipulator whose node is at `node`.
    pub(crate) fn ring(body: &'a RingBody, node: &Pose) -> Self {
        Self { frame: body.centre(node), magnet: Magnet::Ring(&body.source), compact: 0.0 }
    }

    /// Position in world axes, m.
    pub(crate) fn centre(&self) -> &Vector3<f64> {
        &self.frame.position
    }

    /// The axes in which the energies are given, as columns in world axes.
    pub(crate) fn axes(&self) -> &Matrix3<f64> {
        &self.frame.rotation
    }

    /// Field (T) at a point in the world frame; `None` inside a magnet.
    pub(crate) fn at(&self, point: &Vector3<f64>) -> Option<Vector3<f64>> {
        let local = self.frame.rotation.tr_mul(&(point - self.frame.position));
        let near = self.near(&local, &Vector3::z(), Order::Gradient)?;
        Some(self.frame.rotation * near.field)
    }

    /// Distance (m) from a point in the world frame.
    pub(crate) fn distance(&self, point: &Vector3<f64>) -> f64 {
        let local = || self.frame.rotation.tr_mul(&(point - self.frame.position));
        match self.magnet {
            Magnet::Assembly(assembly, _) => assembly.distance(&local()),
            Magnet::Ring(ring) => ring.distance(&local()),
        }
    }

    /// Field at a point in the source's frame; for second order, with the second derivative of its component along
    /// `axis`. `None` inside a magnet.
    #[inline]
    fn near(&self, point: &Vector3<f64>, axis: &Vector3<f64>, order: Order) -> Option<Near> {
        let (strength, jet) = match (self.magnet, order) {
            (Magnet::Assembly(assembly, _), _) if assembly.contains(point) => return None,
            (Magnet::Ring(ring), _) if ring.contains(point) => return None,
            (Magnet::Assembly(assembly, strength), Order::Gradient) => {
                let (field, gradient) = assembly.field_gradient(point).ok()?;
                return Some(Near { field: field * strength, gradient: gradient * strength, along: None });
            }
            (Magnet::Ring(ring), Order::Gradient) => {
                let (field, gradient) = ring.field_gradient(point).ok()?;
                return Some(Near { field, gradient, along: None });
            }
            (Magnet::Assembly(assembly, strength), Order::Hessian) => (strength, assembly.jet(point).ok()?),
            (Magnet::Ring(ring), Order::Hessian) => (1.0, ring.jet(point).ok()?),
        };
        Some(Near {
            field: jet.field * strength,
            gradient: jet.gradient * strength,
            along: Some(jet.hessian_along(axis) * strength),
        })
    }

    /// Energy of a ring whose node is at `node`, in the axes of the source; `None` where it touches the magnet.
    pub(crate) fn on_ring(
        &self,
        body: &RingBody,
        node: &Pose,
        rule: &AxialRule,
        order: Order,
    ) -> Option<Load> {
        let local = self.locate(node);
        let axis = local.axis();
        let centre = body.half_length();
        let mut load = Load::zero();
        for (height, volume) in rule.points() {
            let arm = axis * (centre + height);
            let near = self.near(&(local.position + arm), &axis, order)?;
            let moment = body.magnetisation * volume;
            load.add_dipole(moment, &axis, &arm, &near.field, &near.gradient, near.along.as_ref());
        }
        Some(load)
    }

    /// The same for a ring in the field of another ring, from the magnetic charges on its proximal and distal face.
    pub(crate) fn on_faces(
        &self,
        body: &RingBody,
        node: &Pose,
        rules: [&FaceRule; 2],
        order: Order,
    ) -> Option<Load> {
        let Magnet::Ring(ring) = self.magnet else { return None };
        let local = self.locate(node);
        let [d1, d2, axis]: [Vector3<f64>; 3] =
            core::array::from_fn(|i| local.rotation.column(i).into_owned());
        let mut load = Load::zero();
        for (rule, height, charge) in
            [(rules[0], 0.0, -body.magnetisation), (rules[1], body.ring.length, body.magnetisation)]
        {
            let centre = local.position + axis * height;
            let mut charges = Charges::new(order == Order::Hessian);
            for (position, area) in rule.points() {
                let point = centre + d1 * position.x + d2 * position.y;
                if ring.contains(&point) {
                    return None;
                }
                if order == Order::Hessian {
                    let (potential, field, gradient) = ring.potential_field_gradient(&point).ok()?;
                    charges.add(charge * area, &position, potential, &field, Some(&gradient));
                } else {
                    let (potential, field) = ring.potential_field(&point).ok()?;
                    charges.add(charge * area, &position, potential, &field, None);
                }
            }
            load += charges.load(&local.rotation, height);
        }
        Some(load)
    }

    /// The same for the material of a section at `pose`, represented by `points` with equal shares.
    pub(crate) fn on_material(
        &self,
        material: &SectionMaterial,
        points: &[Vector2<f64>],
        pose: &Pose,
        order: Order,
    ) -> Option<Load> {
        if material.magnetisation == 0.0 {
            return Some(Load::zero());
        }
        let share = material.magnetisation * material.moments.volume / points.len() as f64;
        let section = self.locate(pose);
        let [d1, d2, axis]: [Vector3<f64>; 3] =
            core::array::from_fn(|i| section.rotation.column(i).into_owned());
        let mut sheet = SectionDipoles::new(order == Order::Hessian);
        for position in points {
            let point = section.position + d1 * position.x + d2 * position.y;
            let near = self.near(&point, &axis, order)?;
            sheet.add((share, &axis), position, &near.field, &near.gradient, near.along.as_ref());
        }
        Some(sheet.load(&section.rotation))
    }

    /// The same for a ring and samples of the material of the element that was placed last; sections and loads are written
    /// to `batch` in the order of the samples. `None` for another source.
    pub(crate) fn on_samples(
        &self,
        samples: &[SectionSample],
        exact: bool,
        order: Order,
        batch: &mut SectionBatch,
    ) -> Option<()> {
        let Magnet::Ring(ring) = self.magnet else { return None };
        batch.loads.clear();
        batch.sections.clear();
        let second = order == Order::Hessian;
        for sample in samples {
            let section = self.locate(&batch.stations[sample.station]);
            let SheetSums { field, force, second: SecondSums { gradient, along } } =
                ring.on_sheet(&sample.sheet, &section, sample.accuracy(exact), second)?;
            let dipoles = SectionDipoles {
                field,
                force,
                second: second.then_some(SectionStiffness { gradient, along }),
            };
            batch.loads.push(dipoles.load(&section.rotation));
            batch.sections.push(section);
        }
        Some(())
    }

    fn locate(&self, pose: &Pose) -> Pose {
        Pose {
            position: self.frame.rotation.tr_mul(&(pose.position - self.frame.position)),
            rotation: self.frame.rotation.tr_mul(&pose.rotation),
        }
    }
}
