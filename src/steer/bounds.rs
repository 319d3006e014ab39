//! Limits as linear inequalities about a state.

use nalgebra::{DVector, Vector3};

use super::constants::GAP_DIFFERENCE;
use super::limits::{Limit, Limits};
use super::moves::{Freedom, MAGNET, MAGNET_POSITION, MAGNET_ROTATION};
use crate::equilibrium::LONGEST_INSERTION;
use crate::geometry::Pose;
use crate::magnetics::Source;
use crate::manipulator::{Input, Inputs, Jacobian, Output, Outputs};

/// A limit as `slack + gradient . step >= 0`.
#[derive(Debug, Clone)]
pub(super) struct Bound {
    pub(super) limit: Limit,
    pub(super) slack: f64,
    pub(super) gradient: DVector<f64>,
}

/// The nearest point of the device to the magnet.
#[derive(Debug, Clone, Copy)]
struct Nearest {
    point: usize,
    gap: f64,
    /// Direction in which the gap grows fastest, world axes.
    away: Vector3<f64>,
    /// From the centre of the magnet to the point, m.
    arm: Vector3<f64>,
}

/// The magnet and the thickness of the device.
#[derive(Debug, Clone)]
pub(super) struct Bodies {
    pub(super) magnet: Option<Source>,
    pub(super) radius: f64,
}

impl Bodies {
    /// Pose of the magnet, if there is one.
    pub(super) fn placed<'a>(&self, inputs: &'a Inputs) -> Option<&'a Pose> {
        let magnet = self.magnet.as_ref().and(inputs.sources.get(MAGNET));
        magnet.map(|placed| &placed.pose)
    }

    /// Gap between magnet and device, m; infinite without a magnet.
    pub(super) fn gap(&self, inputs: &Inputs, outputs: &Outputs) -> f64 {
        self.nearest(inputs, outputs).map_or(f64::INFINITY, |nearest| nearest.gap)
    }

    fn nearest(&self, inputs: &Inputs, outputs: &Outputs) -> Option<Nearest> {
        let (magnet, pose) = (self.magnet.as_ref()?, self.placed(inputs)?);
        let local = |point: &Vector3<f64>| pose.rotation.tr_mul(&(point - pose.position));
        let distances = outputs.shape.iter().map(|point| magnet.distance(&local(point)));
        let (point, distance) = distances.enumerate().min_by(|(_, a), (_, b)| a.total_cmp(b))?;
        let place = local(&outputs.shape[point]);
        let away = Vector3::from_fn(|axis, _| {
            let by = Vector3::ith(axis, GAP_DIFFERENCE);
            (magnet.distance(&(place + by)) - magnet.distance(&(place - by))) / (2.0 * GAP_DIFFERENCE)
        });
        let (gap, arm) = (distance - self.radius, outputs.shape[point] - pose.position);
        Some(Nearest { point, gap, away: pose.rotation * away, arm })
    }

    /// The limits that a step from here may meet.
    pub(super) fn bounds(
        &self,
        limits: &Limits,
        inputs: &Inputs,
        outputs: &Outputs,
        jacobian: &Jacobian,
        freedoms: &[Freedom],
    ) -> Vec<Bound> {
        let mut out = Vec::new();
        let mut add = |limit, slack, rate: &dyn Fn(&Freedom) -> f64| {
            let gradient = DVector::from_iterator(freedoms.len(), freedoms.iter().map(rate));
            if gradient.iter().any(|rate| *rate != 0.0) {
                out.push(Bound { limit, slack, gradient });
            }
        };

        let only = |input: Input, freedom: &Freedom, along: Vector3<f64>| {
            if freedom.input == input { freedom.along.dot(&along) } else { 0.0 }
        };

        if let (Some([low, high]), Some(magnet)) = (&limits.workspace, self.placed(inputs)) {
            let place = magnet.position;
            for axis in 0..3 {
                let unit = Vector3::ith(axis, 1.0);
                add(Limit::Workspace, place[axis] - low[axis], &|f| only(MAGNET_POSITION, f, unit));
                add(Limit::Workspace, high[axis] - place[axis], &|f| only(MAGNET_POSITION, f, -unit));
            }
        }

        if let Some((largest, along)) = limits.field.zip(inputs.uniform_field.try_normalize(0.0)) {
            let slack = largest - inputs.uniform_field.norm();
            add(Limit::Field, slack, &|f| only(Input::UniformField, f, -along));
        }

        for (slack, way) in [(inputs.insertion, 1.0), (LONGEST_INSERTION - inputs.insertion, -1.0)] {
            add(Limit::Insertion, slack, &|f| only(Input::Insertion, f, Vector3::x() * way));
        }

        // The gap changes with the magnet's travel, its turn about its centre, and the device's own motion.
        if let Some(Nearest { point, gap, away, arm }) = self.nearest(inputs, outputs) {
            add(Limit::Distance, gap - limits.distance, &|freedom| {
                let by_magnet =
                    only(MAGNET_POSITION, freedom, -away) + only(MAGNET_ROTATION, freedom, -arm.cross(&away));
                by_magnet + freedom.rate(jacobian, Output::ShapePoint(point)).dot(&away)
            });
        }

        out
    }
}
