//! Rows of the Jacobian for the points of the centreline: positions, tangents, curvatures.

use nalgebra::{DMatrix, Vector3};

use super::output_derivatives::{Output, OutputDerivatives, Transport, moved};
use super::response::Response;
use crate::equilibrium::model::{Input, ShapePoint, Site, strained};
use crate::equilibrium::search::Equilibrium;
use crate::geometry::hat;
use crate::rod::{curvature_rates, curvature_slope};

impl Equilibrium {
    /// Position, tangent and curvature at each centreline point.
    pub(crate) fn add_shape(&mut self, rows: &mut OutputDerivatives<'_>, response: &Response) {
        let last = (self.shape.len() - 1) as f64;
        for (number, point) in self.shape.clone().iter().enumerate() {
            let (pose, mut rates) = match &point.place {
                Site::Rigid(node, distance) => {
                    let pose = self.work.nodes[*node];
                    let rates = moved(&response.motion.nodes[*node], &(pose.axis() * *distance));
                    (pose.advanced(*distance), rates)
                }
                Site::Elastic(element, row) => self.place(*element, row, &response.motion),
            };
            // With a shaft, the points stay at equal parts of the length.
            let share = (self.chain.shaft > 0).then(|| number as f64 / last);
            if let Some(share) = share {
                let (shift, turn) = self.slide(&point.place, share);
                let mut by_insertion = rates.fixed_view_mut::<6, 1>(0, Input::Insertion.columns().start);
                let mut shifted = by_insertion.fixed_rows_mut::<3>(0);
                shifted += shift;
                let mut turned = by_insertion.fixed_rows_mut::<3>(3);
                turned += turn;
            }

            rows.set(Output::ShapePoint(number), &rates.rows(0, 3), Transport::Position(pose.position));
            let tangent = pose.axis();
            let turned = -hat(&tangent) * rates.rows(3, 3);
            rows.set(Output::ShapeTangent(number), &turned, Transport::Vector(tangent));
            let bent = self.curvature_rates(point, share, response);
            rows.set(Output::ShapeCurvature(number), &bent, Transport::Not);
        }
    }

    /// Derivatives of the curvature at a shape point, in the material frame. `share` is the part of the whole length before the point,
    /// `None` without a shaft.
    fn curvature_rates(&self, point: &ShapePoint, share: Option<f64>, response: &Response) -> DMatrix<f64> {
        let Some((k, row)) = strained(&self.chain, point) else {
            return DMatrix::zeros(3, response.counts.inputs());
        };
        let (element, configuration) = (&self.chain.elements[k], &self.work.configurations[k]);
        let growth = configuration.growth;
        let amplitudes = self.chain.part(k, &self.branch.unknowns);
        let own = self.chain.first[k]..self.chain.first[k + 1];
        let own_rates = response.unknowns.rows_range(own);
        let by_shape = curvature_rates(configuration, element, &row, amplitudes) * own_rates / growth;
        let mut rates = DMatrix::from_column_slice(3, by_shape.ncols(), by_shape.as_slice());

        if let Some(share) = share {
            let slopes = self.chain.tables()[k].rate_slopes(row.arc_length);
            let slope = curvature_slope(configuration, element, (&row, &slopes), amplitudes);
            let mut by_insertion = rates.fixed_view_mut::<3, 1>(0, Input::Insertion.columns().start);
            by_insertion += slope * (self.along(k, share) / growth);
            if k < self.chain.shaft {
                // The same rotations on a longer shaft.
                let curvature = configuration.curvature_at(element, &row, amplitudes);
                by_insertion -= curvature / self.chain.inserted(self.work.growth);
            }
        }
        rates
    }

    /// Displacement and rotation (rad) of the frame of a shape point along the chain as the shaft grows, per length: `share` is the part
    /// of the whole length before it.
    fn slide(&self, place: &Site, share: f64) -> (Vector3<f64>, Vector3<f64>) {
        match place {
            Site::Rigid(node, _) => (self.work.nodes[*node].axis() * (share - 1.0), Vector3::zeros()),
            Site::Elastic(element, row) => {
                let (chain, k) = (&self.chain, *element);
                let amplitudes = chain.part(k, &self.branch.unknowns);
                let configuration = &self.work.configurations[k];
                let (_, local) = configuration.curve_at(&chain.elements[k], row, amplitudes);
                let turning = configuration.turning_at(&chain.elements[k], row, amplitudes);
                let (axes, along) = (self.work.nodes[k].rotation, self.along(k, share));
                (axes * local * along, axes * turning * along)
            }
        }
    }

    /// Rate of the tabulated arc length of a point on element `k` as the shaft grows, per length.
    fn along(&self, k: usize, share: f64) -> f64 {
        let chain = &self.chain;
        if k < chain.shaft {
            // The shaft's elements have grown.
            -share * chain.length() / (chain.inserted(self.work.growth) * self.work.growth)
        } else {
            share - 1.0
        }
    }
}
