//! What makes a field, and the energy of rings and stations in it.
//!
//! Energies are computed in the frame of the source, where its field is cheapest; only their sums are turned.

use nalgebra::{Matrix3, Vector3};

use super::chain::RingBody;
use super::inputs::Inputs;
use crate::geometry::Pose;
use crate::magnetics::{Assembly, AxialRule, AxialSource, LinearField};
use crate::rod::{Load, Matter, Order, SectionPoint};

/// The magnet in a source.
#[derive(Debug, Clone, Copy)]
enum Magnet<'a> {
    Absent,
    Assembly(&'a Assembly, f64),
    Ring(&'a AxialSource),
}

/// A magnet at a pose, and a linear field around it.
#[derive(Debug, Clone, Copy)]
pub(super) struct Source<'a> {
    frame: Pose,
    magnet: Magnet<'a>,
    /// The linear field at the frame's origin and its gradient, in the frame's axes.
    field: Vector3<f64>,
    gradient: Matrix3<f64>,
}

impl<'a> Source<'a> {
    /// The external magnet and the background field.
    pub(super) fn external(magnet: Option<&'a Assembly>, inputs: &Inputs) -> Self {
        let background = LinearField::new(inputs.uniform_field, inputs.field_gradient);
        let present = magnet.filter(|_| inputs.magnet_strength != 0.0);
        let frame = if present.is_some() { inputs.magnet } else { Pose::identity() };
        let turn = &frame.rotation;
        Self {
            magnet: present
                .map_or(Magnet::Absent, |assembly| Magnet::Assembly(assembly, inputs.magnet_strength)),
            field: turn.tr_mul(&background.at(&frame.position)),
            gradient: turn.tr_mul(&background.gradient()) * turn,
            frame,
        }
    }

    /// A ring of the manipulator whose node is at `node`.
    pub(super) fn ring(body: &'a RingBody, node: &Pose) -> Self {
        Self {
            frame: node.advanced(0.5 * body.ring.length),
            magnet: Magnet::Ring(&body.source),
            field: Vector3::zeros(),
            gradient: Matrix3::zeros(),
        }
    }

    /// Whether there is a magnet, and not the background field alone.
    pub(super) fn has_magnet(&self) -> bool {
        !matches!(self.magnet, Magnet::Absent)
    }

    /// The axes in which the energies are given: the columns, in the world's axes.
    pub(super) fn axes(&self) -> &Matrix3<f64> {
        &self.frame.rotation
    }

    /// Field (T) at a point of the world; `None` inside a magnet.
    pub(super) fn at(&self, point: &Vector3<f64>) -> Option<Vector3<f64>> {
        let local = self.frame.rotation.tr_mul(&(point - self.frame.position));
        let mut load = Load::zero();
        let mut along = |axis: Vector3<f64>| {
            load.energy = 0.0;
            self.add(&mut load, -1.0, &axis, &local, &Vector3::zeros(), Order::Gradient).map(|()| load.energy)
        };
        let field = Vector3::new(along(Vector3::x())?, along(Vector3::y())?, along(Vector3::z())?);
        Some(self.frame.rotation * field)
    }

    /// Distance from a point of the world to the nearest magnet, m; infinite without one.
    pub(super) fn distance(&self, point: &Vector3<f64>) -> f64 {
        let local = || self.frame.rotation.tr_mul(&(point - self.frame.position));
        match self.magnet {
            Magnet::Absent => f64::INFINITY,
            Magnet::Assembly(assembly, _) => assembly.distance(&local()),
            Magnet::Ring(ring) => ring.distance(&local()),
        }
    }

    /// Adds a dipole at `arm` from `origin`, both in the source's frame; `None` inside a magnet.
    fn add(
        &self,
        load: &mut Load,
        moment: f64,
        axis: &Vector3<f64>,
        origin: &Vector3<f64>,
        arm: &Vector3<f64>,
        order: Order,
    ) -> Option<()> {
        let point = origin + arm;
        let field = self.field + self.gradient * point;
        let (factor, jet) = match (self.magnet, order) {
            (Magnet::Absent, _) => {
                let second = (order == Order::Hessian).then(Matrix3::zeros);
                load.add_dipole(moment, axis, arm, &field, &self.gradient, second.as_ref());
                return Some(());
            }
            (Magnet::Assembly(assembly, _), _) if assembly.contains(&point) => return None,
            (Magnet::Ring(ring), _) if ring.contains(&point) => return None,
            (Magnet::Assembly(assembly, strength), Order::Gradient) => {
                let (near, gradient) = assembly.field_gradient(&point).ok()?;
                let (field, gradient) = (field + near * strength, self.gradient + gradient * strength);
                load.add_dipole(moment, axis, arm, &field, &gradient, None);
                return Some(());
            }
            (Magnet::Ring(ring), Order::Gradient) => {
                let (near, gradient) = ring.field_gradient(&point).ok()?;
                load.add_dipole(moment, axis, arm, &near, &gradient, None);
                return Some(());
            }
            (Magnet::Assembly(assembly, strength), Order::Hessian) => (strength, assembly.jet(&point).ok()?),
            (Magnet::Ring(ring), Order::Hessian) => (1.0, ring.jet(&point).ok()?),
        };
        let along = jet.hessian_along(axis) * factor;
        let (field, gradient) = (field + jet.field * factor, self.gradient + jet.gradient * factor);
        load.add_dipole(moment, axis, arm, &field, &gradient, Some(&along));
        Some(())
    }

    /// Energy of a ring whose node is at `node`, in the axes of the world; `None` where it touches a magnet.
    pub(super) fn on_ring(
        &self,
        body: &RingBody,
        node: &Pose,
        rule: &AxialRule,
        order: Order,
    ) -> Option<Load> {
        let local = self.locate(node);
        let axis = local.axis();
        let centre = 0.5 * body.ring.length;
        let mut load = Load::zero();
        for (height, volume) in rule.points() {
            let arm = axis * (centre + height);
            self.add(&mut load, body.magnetisation * volume, &axis, &local.position, &arm, order)?;
        }
        Some(load.in_axes(&self.frame.rotation.transpose()))
    }

    /// Energy of a section's material in the axes of the source; `pose` is the section's in the world.
    pub(super) fn on_matter(&self, matter: &Matter, pose: &Pose, order: Order) -> Option<Load> {
        let mut load = Load::zero();
        if matter.magnetisation == 0.0 {
            return Some(load);
        }
        let local = self.locate(pose);
        let axis = local.axis();
        let moment = matter.magnetisation * matter.moments.volume;
        if matches!(self.magnet, Magnet::Absent) && self.gradient == Matrix3::zeros() {
            load.energy = -moment * axis.dot(&self.field);
            load.couple = self.field * (axis.transpose() * -moment);
            return Some(load);
        }
        let points = matter.moments.points();
        for point in points {
            let arm = local.rotation * Vector3::new(point.x, point.y, 0.0);
            self.add(&mut load, moment / points.len() as f64, &axis, &local.position, &arm, order)?;
        }
        Some(load)
    }

    /// The same, for the given points of the station's section.
    pub(super) fn on_points(
        &self,
        points: &[SectionPoint],
        magnetisation: f64,
        pose: &Pose,
        order: Order,
    ) -> Option<Load> {
        let local = self.locate(pose);
        let axis = local.axis();
        let mut load = Load::zero();
        for point in points {
            let arm = local.rotation * Vector3::new(point.position.x, point.position.y, 0.0);
            self.add(&mut load, magnetisation * point.volume, &axis, &local.position, &arm, order)?;
        }
        Some(load)
    }

    fn locate(&self, pose: &Pose) -> Pose {
        Pose {
            position: self.frame.rotation.tr_mul(&(pose.position - self.frame.position)),
            rotation: self.frame.rotation.tr_mul(&pose.rotation),
        }
    }
}
