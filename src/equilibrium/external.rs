//! The external field, and its energy on rings and stations.

use nalgebra::{Matrix3, Vector3};

use super::chain::RingBody;
use super::inputs::Inputs;
use crate::geometry::Pose;
use crate::magnetics::{Assembly, AxialRule, LinearField, Wrench};
use crate::rod::{Load, Order, Station};

/// The external field at one point.
#[derive(Debug, Clone, Copy)]
pub(super) struct Local {
    pub(super) field: Vector3<f64>,
    gradient: Matrix3<f64>,
    along: Option<Matrix3<f64>>,
}

/// The field around the manipulator: the external magnet and the linear background.
#[derive(Debug, Clone, Copy)]
pub(super) struct ExternalField<'a> {
    magnet: Option<(&'a Assembly, &'a Pose, f64)>,
    background: LinearField,
    uniform: bool,
}

impl Local {
    /// Adds a dipole along `axis` in this field to a load.
    fn add(&self, load: &mut Load, moment: f64, axis: &Vector3<f64>, arm: &Vector3<f64>) {
        load.add_dipole(moment, axis, arm, &self.field, &self.gradient, self.along.as_ref());
    }
}

impl<'a> ExternalField<'a> {
    pub(super) fn new(magnet: Option<&'a Assembly>, inputs: &'a Inputs) -> Self {
        let magnet = magnet.filter(|_| inputs.magnet_strength != 0.0);
        Self {
            magnet: magnet.map(|assembly| (assembly, &inputs.magnet, inputs.magnet_strength)),
            ..Self::background(inputs)
        }
    }

    /// The background field alone.
    pub(super) fn background(inputs: &Inputs) -> Self {
        Self {
            magnet: None,
            background: LinearField::new(inputs.uniform_field, inputs.field_gradient),
            uniform: inputs.field_gradient.iter().all(|g| *g == 0.0),
        }
    }

    /// Field, gradient and, for the Hessian, second derivatives along `axis`, at `point`; `None` inside a
    /// magnet.
    pub(super) fn along(&self, point: &Vector3<f64>, axis: &Vector3<f64>, order: Order) -> Option<Local> {
        let background = self.background.jet(point);
        let second = order == Order::Hessian;
        let Some((assembly, pose, strength)) = self.magnet else {
            let along = second.then(Matrix3::zeros);
            return Some(Local { field: background.field, gradient: background.gradient, along });
        };
        let turn = &pose.rotation;
        let local = turn.tr_mul(&(point - pose.position));
        if assembly.contains(&local) {
            return None;
        }
        let turned = |m: &Matrix3<f64>| turn * (m * strength) * turn.transpose();
        let (field, gradient, along) = if second {
            let jet = assembly.jet(&local).ok()?;
            (jet.field, jet.gradient, Some(turned(&jet.hessian_along(&turn.tr_mul(axis)))))
        } else {
            let (field, gradient) = assembly.field_gradient(&local).ok()?;
            (field, gradient, None)
        };
        Some(Local {
            field: background.field + turn * field * strength,
            gradient: background.gradient + turned(&gradient),
            along,
        })
    }

    /// Distance from `point` to the nearest external magnet, m; infinite without one.
    pub(super) fn distance(&self, point: &Vector3<f64>) -> f64 {
        self.magnet.map_or(f64::INFINITY, |(assembly, pose, _)| {
            assembly.distance(&pose.rotation.tr_mul(&(point - pose.position)))
        })
    }

    fn is_uniform(&self) -> bool {
        self.uniform && self.magnet.is_none()
    }

    /// Energy of a ring whose node is at `node`; `None` where it touches a magnet.
    pub(super) fn on_ring(
        &self,
        body: &RingBody,
        node: &Pose,
        rule: &AxialRule,
        order: Order,
    ) -> Option<Load> {
        let axis = node.axis();
        let centre = 0.5 * body.ring.length;
        let mut load = Load::zero();
        for (height, volume) in rule.points() {
            let arm = axis * (centre + height);
            let local = self.along(&(node.position + arm), &axis, order)?;
            local.add(&mut load, body.magnetisation * volume, &axis, &arm);
        }
        Some(load)
    }

    /// Energy of a station's material; `pose` is the station's, in world axes.
    pub(super) fn on_station(&self, station: &Station, pose: &Pose, order: Order) -> Option<Load> {
        let axis = pose.axis();
        let mut load = Load::zero();
        if station.magnetisation == 0.0 {
            return Some(load);
        }
        if self.is_uniform() {
            let field = self.background.jet(&pose.position).field;
            let moment = station.magnetisation * station.material.volume;
            load.energy = -moment * axis.dot(&field);
            load.couple = field * axis.transpose() * -moment;
            return Some(load);
        }
        let moment = station.magnetisation * station.material.volume / 4.0;
        for point in station.material.points() {
            let arm = pose.rotation * Vector3::new(point.x, point.y, 0.0);
            let local = self.along(&(pose.position + arm), &axis, order)?;
            local.add(&mut load, moment, &axis, &arm);
        }
        Some(load)
    }
}

/// Weight of a station's material and backbone; `pose` is the station's, in world axes.
pub(super) fn weight(station: &Station, pose: &Pose, gravity: &Vector3<f64>) -> Load {
    let material = station.density * station.material.volume;
    let first = station.material.first * station.density;
    let lever = pose.rotation * Vector3::new(first.x, first.y, 0.0);
    let mass = material + station.line_mass;
    Load {
        energy: -gravity.dot(&(pose.position * mass + lever)),
        force: gravity * -mass,
        couple: gravity * lever.transpose() * -1.0,
        ..Load::zero()
    }
}

/// Adds the wrench of a load whose frame's origin is at `arm` (m) from the reference point.
pub(super) fn add_load(wrench: &mut Wrench, load: &Load, arm: &Vector3<f64>) {
    wrench.force -= load.force;
    wrench.torque -= load.moment() + arm.cross(&load.force);
}
