//! The external field, and its energy on rings and stations.

use nalgebra::{Matrix3, Vector3};

use super::chain::RingBody;
use super::inputs::Inputs;
use crate::geometry::Pose;
use crate::magnetics::{Assembly, AxialRule, LinearField};
use crate::rod::{Load, Station};

/// The field around the manipulator: the external magnet and the linear background.
#[derive(Debug, Clone, Copy)]
pub(super) struct ExternalField<'a> {
    magnet: Option<(&'a Assembly, &'a Pose, f64)>,
    background: LinearField,
    uniform: bool,
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

    /// Field, gradient, and second derivatives along `axis`, at `point`; `None` inside a magnet.
    pub(super) fn along(
        &self,
        point: &Vector3<f64>,
        axis: &Vector3<f64>,
    ) -> Option<(Vector3<f64>, Matrix3<f64>, Matrix3<f64>)> {
        let background = self.background.jet(point);
        let Some((assembly, pose, strength)) = self.magnet else {
            return Some((background.field, background.gradient, Matrix3::zeros()));
        };
        let turn = &pose.rotation;
        let local = turn.tr_mul(&(point - pose.position));
        if assembly.contains(&local) {
            return None;
        }
        let jet = assembly.jet(&local).ok()?;
        let gradient = turn * (jet.gradient * strength) * turn.transpose();
        let along = turn * (jet.hessian_along(&turn.tr_mul(axis)) * strength) * turn.transpose();
        Some((background.field + turn * jet.field * strength, background.gradient + gradient, along))
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
    pub(super) fn on_ring(&self, body: &RingBody, node: &Pose, rule: &AxialRule) -> Option<Load> {
        let axis = node.axis();
        let centre = 0.5 * body.ring.length;
        let mut load = Load::zero();
        for (height, volume) in rule.points() {
            let arm = axis * (centre + height);
            let (field, gradient, along) = self.along(&(node.position + arm), &axis)?;
            load.add_dipole(body.magnetisation * volume, &axis, &arm, &field, &gradient, &along);
        }
        Some(load)
    }

    /// Energy of a station's material; `pose` is the station's, in world axes.
    pub(super) fn on_station(&self, station: &Station, pose: &Pose) -> Option<Load> {
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
            let (field, gradient, along) = self.along(&(pose.position + arm), &axis)?;
            load.add_dipole(moment, &axis, &arm, &field, &gradient, &along);
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
