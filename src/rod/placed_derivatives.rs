//! Contributions of placed loads to the element derivatives.

use nalgebra::Matrix3;

use super::element::Element;
use super::element_derivatives::{ElementDerivatives, START};
use super::placed_load::{PlacedCoupling, PlacedLoad};
use super::row::ROTATIONS;
use crate::numerics::dense;

impl ElementDerivatives {
    /// Adds a placed load, except for its force on the tangents of the stations before it.
    pub(super) fn add_placed(&mut self, element: &Element, placed: &PlacedLoad, second: bool) {
        let PlacedLoad { row, frame, load } = placed;

        let pull = load.couple * frame.pose.rotation;
        let rotations = || element.runs.iter().filter(|(c, _)| *c < ROTATIONS);
        if !second {
            let slope = frame.theta.rotation_gradient(&pull);
            for (c, run) in rotations() {
                for i in run.clone() {
                    self.gradient[START + i] += slope[*c] * row.integral[i];
                }
            }
            return;
        }

        let (slope, curve) = frame.theta.contract_rotation(&pull);
        let turn = load.couple.transpose() - Matrix3::identity() * load.couple.trace();
        let turn_left: Matrix3<f64> = turn * frame.left;

        for (a, own) in rotations() {
            for i in own.clone() {
                let phi = row.integral[i];
                self.gradient[START + i] += slope[*a] * phi;
                for (b, run) in rotations() {
                    for j in run.clone().filter(|j| *j >= i) {
                        self.hessian[(START + i) * self.size + START + j] +=
                            phi * curve[(*a, *b)] * row.integral[j];
                    }
                }

                // Mixed derivatives with the start node's rotation.
                for k in 0..3 {
                    self.hessian[(3 + k) * self.size + START + i] += turn_left[(k, *a)] * phi;
                }
            }
        }

        if load.stiff {
            self.motion(element, row, &frame.pose.position, &frame.left);
            self.add_stiffness(load);
        }
    }

    /// Adds the mixed second derivative of two placed loads.
    pub(super) fn add_coupling(
        &mut self,
        element: &Element,
        loads: &[PlacedLoad],
        coupling: &PlacedCoupling,
    ) {
        let size = self.size;
        let [first, second] = coupling.between.map(|number| &loads[number]);
        self.motion(element, &first.row, &first.frame.pose.position, &first.frame.left);
        self.answer.fill(0.0);
        // Stored by column: row by row it is the transpose.
        dense::add_product(coupling.matrix.as_slice(), &self.motion, 6, size, &mut self.answer);
        self.motion(element, &second.row, &second.frame.pose.position, &second.frame.left);
        dense::add_upper(&self.answer, &self.motion, size, &mut self.hessian);
        dense::add_upper(&self.motion, &self.answer, size, &mut self.hessian);
    }
}
