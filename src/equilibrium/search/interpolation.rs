//! Strain mode amplitudes for a shape that another model has found.

use nalgebra::{DMatrix, Matrix3, Vector3};

use super::solver::Equilibrium;
use crate::geometry::{Pose, rotation_log};
use crate::rod::{Configuration, Element};

/// Newton corrections of an element's amplitudes; each squares the remaining distance.
const CORRECTIONS: usize = 8;

/// Finite difference step, in radians of the first mode.
const STEP: f64 = 1e-6;

/// The first amplitudes of an element are the rotation vector of its end.
const ROTATION: usize = 3;

impl Equilibrium {
    /// Amplitudes that put every ring at its pose in `rings` (poses of the centres, base to tip) with the least bending;
    /// the initial guess for the equilibrium that a shape of another model approximates.
    ///
    /// `None` where a node has no ring, or where `rings` is not a shape of this chain.
    #[must_use]
    pub fn amplitudes_through(&self, rings: &[Pose]) -> Option<Vec<f64>> {
        let chain = &self.chain;
        let on_every_node = chain.rings.iter().enumerate().all(|(k, body)| body.node == k);
        if !on_every_node || chain.rings.len() != chain.elements.len() + 1 || rings.len() != chain.rings.len()
        {
            return None;
        }
        let faces = rings.iter().zip(&chain.rings).map(|(pose, body)| pose.advanced(-body.to_centre()));
        let faces: Vec<Pose> = faces.collect();
        let mut unknowns = Vec::with_capacity(chain.freedoms());
        for (element, ends) in chain.elements.iter().zip(faces.windows(2)) {
            let rotation = ends[0].rotation.tr_mul(&ends[1].rotation);
            let position = ends[0].rotation.tr_mul(&(ends[1].position - ends[0].position));
            unknowns.extend(reaching(element, &Pose { position, rotation })?);
        }
        Some(unknowns)
    }

    /// Poses of the rings' centres, base to tip, at any shape; the branch stays unchanged.
    #[must_use]
    pub fn rings_at(&self, base: &Pose, unknowns: &[f64]) -> Vec<Pose> {
        let chain = &self.chain;
        let mut nodes = vec![*base];
        for (k, element) in chain.elements.iter().enumerate() {
            let mut configuration = Configuration::straight(element);
            configuration.update(element, chain.part(k, unknowns));
            nodes.push(nodes[k].compose(&configuration.end));
        }
        chain.rings.iter().map(|body| body.centre(&nodes[body.node])).collect()
    }
}

/// Amplitudes with which the element ends at `target`, found by steps that are shortest in the elastic energy norm.
fn reaching(element: &Element, target: &Pose) -> Option<Vec<f64>> {
    let mut amplitudes = vec![0.0; element.freedoms()];
    let bent = rotation_log(&target.rotation) - element.rest_angle;
    amplitudes[..ROTATION].copy_from_slice(bent.as_slice());
    let mut configuration = Configuration::straight(element);
    let mut end = |amplitudes: &[f64]| {
        configuration.update(element, amplitudes);
        configuration.end.position
    };

    for _ in 0..CORRECTIONS {
        let here = end(&amplitudes);
        let mut slopes = DMatrix::zeros(3, amplitudes.len());
        for i in ROTATION..amplitudes.len() {
            let step = STEP * (element.metric[0] / element.metric[i]).sqrt();
            let mut moved = amplitudes.clone();
            moved[i] += step;
            slopes.set_column(i, &((end(&moved) - here) / step));
        }

        // The shortest step in the elastic norm that leads to the target.
        let mut compliant = slopes.transpose();
        for (mut row, k) in compliant.row_iter_mut().zip(&element.metric) {
            row /= *k;
        }
        let reach: Matrix3<f64> = (&slopes * &compliant).fixed_view::<3, 3>(0, 0).into_owned();
        let pull: Vector3<f64> = reach.try_inverse()? * (target.position - here);
        let step = compliant * pull;
        amplitudes.iter_mut().zip(step.iter()).for_each(|(a, s)| *a += s);
    }
    amplitudes.iter().all(|a| a.is_finite()).then_some(amplitudes)
}
