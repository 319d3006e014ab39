//! What an equilibrium answers at its last solved shape.

use nalgebra::{Matrix3, Vector3};

use super::solution::Solution;
use super::solver::Equilibrium;
use crate::equilibrium::contact::WallForces;
use crate::equilibrium::model::{Inputs, Site, strained};
use crate::geometry::Pose;
use crate::magnetics::{Sources, Wrench};

impl Solution for Equilibrium {
    fn tip(&self) -> Pose {
        self.work.nodes[self.work.nodes.len() - 1].advanced(self.chain.tip_offset)
    }

    fn rings(&self) -> impl Iterator<Item = Pose> + '_ {
        self.chain.rings.iter().map(|body| body.centre(&self.work.nodes[body.node]))
    }

    fn core_angles(&self) -> impl Iterator<Item = f64> + '_ {
        self.chain.cores.iter().map(|(first, last)| {
            let tangent = |element: usize, end: usize| {
                self.on_element(element, &self.chain.elements[element].core_ends[end]).axis()
            };
            tangent(*first, 0).angle(&tangent(*last, 1))
        })
    }

    fn shape(&self) -> impl Iterator<Item = (f64, Vector3<f64>)> + '_ {
        self.shape.iter().map(|point| {
            let position = match &point.place {
                Site::Rigid(node, distance) => self.work.nodes[*node].advanced(*distance).position,
                Site::Elastic(element, row) => self.on_element(*element, row).position,
            };
            (point.arc_length, position)
        })
    }

    fn shape_strains(&self) -> impl Iterator<Item = (Matrix3<f64>, Vector3<f64>)> + '_ {
        self.shape.iter().map(|point| {
            let directors = match &point.place {
                Site::Rigid(node, _) => self.work.nodes[*node].rotation,
                Site::Elastic(element, row) => self.on_element(*element, row).rotation,
            };

            let curvature = strained(&self.chain, point).map(|(k, row)| {
                let amplitudes = self.chain.part(k, &self.branch.unknowns);
                self.work.configurations[k].curvature_at(&self.chain.elements[k], &row, amplitudes)
            });
            (directors, curvature.unwrap_or_default())
        })
    }

    fn base_reaction(&self) -> Wrench {
        Wrench { force: self.work.base.0, torque: self.work.base.1 }
    }

    fn magnetic_wrench(&self) -> Wrench {
        self.work.wrenches.magnetic()
    }

    fn sources(&self) -> &Sources {
        &self.sources
    }

    fn source_reaction(&self, number: usize, inputs: &Inputs) -> Wrench {
        self.work.wrenches.on_source(number, inputs)
    }

    fn feed_reaction(&self, inputs: &Inputs) -> Option<f64> {
        self.feed_push(inputs)
    }

    fn wall(&self) -> Option<WallForces> {
        self.contact.as_ref().map(|contact| contact.forces(self.chain.rings.len()))
    }

    fn field_at(&self, inputs: &Inputs, point: &Vector3<f64>) -> Option<Vector3<f64>> {
        self.terms(inputs).field_at(point)
    }
}
