//! The field of a ring of the manipulator, and the energy of other rings and of magnetised material in it.
//!
//! Energies are computed in the frame of the ring, where its field is cheapest; only their sums are rotated.

use nalgebra::{Matrix3, Vector3};

use super::ring_body::RingBody;
use super::span_quadrature::SectionSample;
use crate::geometry::Pose;
use crate::magnetics::{AxialRule, AxialSource, DipoleSheet, FaceRule, FieldAccuracy, SecondSums, SheetSums};
use crate::rod::{Charges, Load, Order, SectionDipoles, SectionStiffness, StationState};

/// Sections of an element in the field of one ring, and the loads on them; storage that is used again.
#[derive(Debug, Clone, Default)]
pub(crate) struct SectionBatch {
    /// Poses of the sections in the frame of the ring; instead of the normal, the direction of the dipoles.
    pub(crate) sections: Vec<Pose>,
    /// Energy of each section as a load on its frame, in the axes of the ring.
    pub(crate) loads: Vec<Load>,
}

/// The field of a ring at its pose.
#[derive(Debug, Clone, Copy)]
pub(crate) struct RingField<'a> {
    frame: Pose,
    ring: &'a AxialSource,
}

impl<'a> RingField<'a> {
    /// A ring of the manipulator whose node is at `node`.
    pub(crate) fn new(body: &'a RingBody, node: &Pose) -> Self {
        Self { frame: body.centre(node), ring: &body.source }
    }

    /// Position in world axes, m.
    pub(crate) fn centre(&self) -> &Vector3<f64> {
        &self.frame.position
    }

    /// The axes in which the energies are given, as columns in world axes.
    pub(crate) fn axes(&self) -> &Matrix3<f64> {
        &self.frame.rotation
    }

    /// Energy of another ring whose node is at `node`, in the axes of this one, all points of `rule` at once; `None` where they touch.
    ///
    /// They lie on a section that contains the axis: its first director is the axis, as is the direction of the dipoles.
    pub(crate) fn on_axis(
        &self,
        body: &RingBody,
        node: &Pose,
        rule: &AxialRule,
        accuracy: FieldAccuracy,
        order: Order,
    ) -> Option<Load> {
        let local = self.locate(node);
        let (axis, none) = (local.axis(), Vector3::zeros());
        let section = Pose { rotation: Matrix3::from_columns(&[axis, none, axis]), ..local };
        let dipoles = on_sheet(self.ring, rule.upright(), &section, accuracy, order)?;
        Some(dipoles.times(body.magnetisation).load(&section.rotation))
    }

    /// Load of this ring's field on a ring, from the magnetic charges on the faces of that, proximal and distal.
    pub(crate) fn on_faces(
        &self,
        body: &RingBody,
        node: &Pose,
        rules: [&FaceRule; 2],
        order: Order,
    ) -> Option<Load> {
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
                if self.ring.contains(&point) {
                    return None;
                }
                if order == Order::Hessian {
                    let (potential, field, gradient) = self.ring.potential_field_gradient(&point).ok()?;
                    charges.add(charge * area, &position, potential, &field, Some(&gradient));
                } else {
                    let (potential, field) = self.ring.potential_field(&point).ok()?;
                    charges.add(charge * area, &position, potential, &field, None);
                }
            }
            load += charges.load(&local.rotation, height);
        }
        Some(load)
    }

    /// Energies of samples of the material of an element with its start node at `start`; sections and loads, with second
    /// derivatives, are written to `batch` in the order of the samples. `None` where they touch.
    pub(crate) fn on_samples(
        &self,
        samples: &[SectionSample],
        near: bool,
        (start, states): (&Pose, &[StationState]),
        batch: &mut SectionBatch,
    ) -> Option<()> {
        let start = self.locate(start);
        batch.loads.clear();
        batch.sections.clear();
        for sample in samples {
            let section = sample.directed(start.compose(&states[sample.station].pose()));
            let dipoles =
                on_sheet(self.ring, &sample.sheet, &section, sample.accuracy(near), Order::Hessian)?;
            batch.loads.push(dipoles.load(&section.rotation));
            batch.sections.push(section);
        }
        Some(())
    }

    /// Adds the loads of a ring on samples of the material of an element, whose start node is at `start`, to the
    /// loads on its `stations`, in the axes of that node and without second derivatives. Returns the energy, and force and
    /// moment of the energy's derivative by the ring's node; `None` where they touch.
    pub(crate) fn add_on_samples(
        &self,
        body: &RingBody,
        samples: &[SectionSample],
        near: bool,
        (start, states): (&Pose, &[StationState]),
        stations: &mut [Load],
    ) -> Option<(f64, Vector3<f64>, Vector3<f64>)> {
        let start = self.locate(start);
        let (mut energy, mut force, mut moment) = (0.0, Vector3::zeros(), Vector3::zeros());
        for sample in samples {
            let state = &states[sample.station];
            let own_axes = sample.direction.sheet(&state.directors);
            let section = sample.directed(start.compose(&state.pose()));
            let SheetSums { field, force: [pull, by_x, by_y] } =
                self.ring.on_sheet(&sample.sheet, &section, sample.accuracy(near))?;
            let director = |i: usize| section.rotation.column(i).into_owned();
            energy -= director(2).dot(&field);
            force += pull;
            let arm = section.position + Vector3::z() * body.to_centre();
            moment += arm.cross(&pull)
                + director(0).cross(&by_x)
                + director(1).cross(&by_y)
                + director(2).cross(&field);
            let back = |own: &Vector3<f64>| start.rotation.tr_mul(own);
            let load = &mut stations[sample.station];
            load.force -= back(&pull);
            let own = |i: usize| own_axes.column(i).transpose();
            load.couple -= back(&by_x) * own(0) + back(&by_y) * own(1) + back(&field) * own(2);
        }
        Some((energy, self.frame.rotation * force, self.frame.rotation * moment))
    }

    fn locate(&self, pose: &Pose) -> Pose {
        Pose {
            position: self.frame.rotation.tr_mul(&(pose.position - self.frame.position)),
            rotation: self.frame.rotation.tr_mul(&pose.rotation),
        }
    }
}

/// Dipoles of a sheet at `section` in the field of a ring, in its frame; `None` where one is inside the ring.
fn on_sheet(
    ring: &AxialSource,
    sheet: &DipoleSheet,
    section: &Pose,
    accuracy: FieldAccuracy,
    order: Order,
) -> Option<SectionDipoles> {
    if order == Order::Gradient {
        let SheetSums { field, force } = ring.on_sheet(sheet, section, accuracy)?;
        return Some(SectionDipoles { field, force, second: None });
    }
    let SecondSums { field, gradient, along } = ring.second_on_sheet(sheet, section, accuracy)?;
    let force = gradient.each_ref().map(|gradient| gradient * section.axis());
    Some(SectionDipoles { field, force, second: Some(SectionStiffness { gradient, along }) })
}
