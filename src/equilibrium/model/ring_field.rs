//! The field of a rigid magnet of the manipulator, and the energy of other magnets and of magnetised material in it.
//!
//! Energies are computed in the frame of the magnet, where its field is cheapest; only their sums are rotated.

use nalgebra::{Matrix3, Vector2, Vector3};

use super::ring_body::RingBody;
use super::span_quadrature::SectionSample;
use crate::design::RigidShape;
use crate::geometry::Pose;
use crate::magnetics::{
    AxialRule, DipoleSheet, FaceRule, FieldAccuracy, FieldHessian, Jet, SecondSums, SheetSums, WallRule,
};
use crate::rod::{Charges, Load, Order, SectionDipoles, SectionStiffness, StationState};

/// Sections of an element in the field of one ring, and the loads on them; storage that is used again.
#[derive(Debug, Clone, Default)]
pub(crate) struct SectionBatch {
    /// Poses of the sections in the frame of the ring; instead of the normal, the direction of the dipoles.
    pub(crate) sections: Vec<Pose>,
    /// Energy of each section as a load on its frame, in the axes of the ring.
    pub(crate) loads: Vec<Load>,
}

/// The field of a ring, or of another rigid magnet, at its pose.
#[derive(Debug, Clone, Copy)]
pub(crate) struct RingField<'a> {
    frame: Pose,
    body: &'a RingBody,
}

impl<'a> RingField<'a> {
    /// A ring of the manipulator whose node is at `node`.
    pub(crate) fn new(body: &'a RingBody, node: &Pose) -> Self {
        Self { frame: body.centre(node), body }
    }

    /// Position in world axes, m.
    pub(crate) fn centre(&self) -> &Vector3<f64> {
        &self.frame.position
    }

    /// The axes in which the energies are given, as columns in world axes.
    pub(crate) fn axes(&self) -> &Matrix3<f64> {
        &self.frame.rotation
    }

    /// Energy of another ring whose node is at `node`, in the axes of this one, by dipoles on its axis; `None` where they touch.
    pub(crate) fn on_axis(
        &self,
        body: &RingBody,
        node: &Pose,
        rule: &AxialRule,
        accuracy: FieldAccuracy,
        order: Order,
    ) -> Option<Load> {
        if self.body.directed.is_some() || body.ring.shape == RigidShape::Ball {
            return self.on_nodes(body, node, rule, order);
        }

        // All nodes at once: they lie on a section that contains the axis, which is its first director.
        let local = self.locate(node);
        let axis = local.axis();
        let direction = body.direction.seen_in(&local.rotation);
        let start = axis * body.start;
        let section = Pose {
            position: local.position + start,
            rotation: Matrix3::from_columns(&[axis, Vector3::zeros(), direction]),
        };
        let dipoles = self.on_sheet(rule.upright(), &section, accuracy, order)?;
        let load = dipoles.times(body.magnetisation).load(&section.rotation);
        Some(if body.start == 0.0 { load } else { load.carried(&start) })
    }

    /// As [`Self::on_axis`], node by node.
    fn on_nodes(&self, body: &RingBody, node: &Pose, rule: &AxialRule, order: Order) -> Option<Load> {
        let local = self.locate(node);
        let (axis, direction) = (local.axis(), body.direction.seen_in(&local.rotation));
        let mut load = Load::zero();
        for (height, volume) in rule.points() {
            let arm = axis * (body.to_centre() + height);
            let Jet { field, gradient, hessian } = self.near(&(local.position + arm), order)?;
            let along = (order == Order::Hessian).then(|| hessian.along(&direction));
            let moment = body.magnetisation * volume;
            load.add_dipole(moment, &direction, &arm, &field, &gradient, along.as_ref());
        }
        Some(load)
    }

    /// Load of this ring's field on a ring, from the magnetic charges on the faces of that, proximal and distal, and on its walls.
    pub(crate) fn on_surface(
        &self,
        body: &RingBody,
        node: &Pose,
        (faces, wall): ([&FaceRule; 2], Option<&WallRule>),
        order: Order,
    ) -> Option<Load> {
        let local = self.locate(node);
        let magnetisation = body.direction.vector() * body.magnetisation;
        let [d1, d2, axis]: [Vector3<f64>; 3] =
            core::array::from_fn(|i| local.rotation.column(i).into_owned());
        let mut load = Load::zero();
        for (rule, height, charge) in
            [(faces[0], body.start, -magnetisation.z), (faces[1], body.end(), magnetisation.z)]
        {
            let centre = local.position + axis * height;
            let mut charges = Charges::new(order == Order::Hessian);
            for (position, area) in rule.points() {
                let point = centre + d1 * position.x + d2 * position.y;
                let (potential, field, gradient) = self.potential_near(&point, order)?;
                charges.add(charge * area, &position, potential, &field, gradient.as_ref());
            }
            load += charges.load(&local.rotation, height);
        }

        let across: Vector2<f64> = magnetisation.xy();
        for (place, area) in wall.iter().flat_map(|wall| wall.points()) {
            let arm = local.rotation * (place + Vector3::z() * body.to_centre());
            let (potential, field, gradient) = self.potential_near(&(local.position + arm), order)?;
            load.add_charge(across.dot(area), &arm, (potential, &field), gradient.as_ref());
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
            let dipoles = self.on_sheet(&sample.sheet, &section, sample.accuracy(near), Order::Hessian)?;
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
        samples: &[SectionSample],
        near: bool,
        (start, states): (&Pose, &[StationState]),
        stations: &mut [Load],
    ) -> Option<(f64, Vector3<f64>, Vector3<f64>)> {
        let start = self.locate(start);
        let to_centre = Vector3::z() * self.body.to_centre();
        let (mut energy, mut force, mut moment) = (0.0, Vector3::zeros(), Vector3::zeros());
        for sample in samples {
            let state = &states[sample.station];
            let own_axes = sample.direction.sheet(&state.directors);
            let section = sample.directed(start.compose(&state.pose()));
            let sums = self.on_sheet(&sample.sheet, &section, sample.accuracy(near), Order::Gradient)?;
            let SectionDipoles { field, force: [pull, by_x, by_y], .. } = sums;

            let director = |i: usize| section.rotation.column(i).into_owned();
            energy -= director(2).dot(&field);
            force += pull;
            let arm = section.position + to_centre;
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

    /// The field at a point in the frame of the ring, its second derivatives for the Hessian alone; `None` inside it.
    fn near(&self, point: &Vector3<f64>, order: Order) -> Option<Jet> {
        let flat = |(field, gradient)| Jet { field, gradient, hessian: FieldHessian::default() };
        match &self.body.directed {
            Some(magnet) if magnet.contains(point) => None,
            Some(magnet) if order == Order::Hessian => magnet.jet(point).ok(),
            Some(magnet) => magnet.field_gradient(point).ok().map(flat),
            None if self.body.source.contains(point) => None,
            None if order == Order::Hessian => self.body.source.jet(point).ok(),
            None => self.body.source.field_gradient(point).ok().map(flat),
        }
    }

    /// Potential and field at a point in the frame of the ring, with the gradient for the Hessian; `None` inside it.
    fn potential_near(
        &self,
        point: &Vector3<f64>,
        order: Order,
    ) -> Option<(f64, Vector3<f64>, Option<Matrix3<f64>>)> {
        if self.body.directed.is_none() {
            let ring = &self.body.source;
            if ring.contains(point) {
                return None;
            }
            if order == Order::Hessian {
                let (potential, field, gradient) = ring.potential_field_gradient(point).ok()?;
                return Some((potential, field, Some(gradient)));
            }
            let (potential, field) = ring.potential_field(point).ok()?;
            return Some((potential, field, None));
        }
        let Jet { field, gradient, .. } = self.near(point, Order::Gradient)?;
        let potential = self.body.directed.as_ref()?.potential(point).ok()?;
        Some((potential, field, (order == Order::Hessian).then_some(gradient)))
    }

    /// Dipoles of a sheet at `section` in the field of the ring, in its frame; `None` where one is inside the ring.
    fn on_sheet(
        &self,
        sheet: &DipoleSheet,
        section: &Pose,
        accuracy: FieldAccuracy,
        order: Order,
    ) -> Option<SectionDipoles> {
        let ring = &self.body.source;
        if self.body.directed.is_some() {
            return self.one_by_one(sheet, section, order);
        }
        if order == Order::Gradient {
            let SheetSums { field, force } = ring.on_sheet(sheet, section, accuracy)?;
            return Some(SectionDipoles { field, force, second: None });
        }
        let SecondSums { field, gradient, along } = ring.second_on_sheet(sheet, section, accuracy)?;
        let force = gradient.each_ref().map(|gradient| gradient * section.axis());
        Some(SectionDipoles { field, force, second: Some(SectionStiffness { gradient, along }) })
    }

    /// As [`Self::on_sheet`], dipole by dipole.
    fn one_by_one(&self, sheet: &DipoleSheet, section: &Pose, order: Order) -> Option<SectionDipoles> {
        let (axis, hessian) = (section.axis(), order == Order::Hessian);
        let mut sums = SectionDipoles::new(hessian);
        for (position, point, moment) in sheet.placed(section) {
            let jet = self.near(&point, order)?;
            let along = hessian.then(|| jet.hessian_along(&axis));
            sums.add((moment, &axis), &position, &jet.field, &jet.gradient, along.as_ref());
        }
        Some(sums)
    }
}
