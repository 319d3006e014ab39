//! Kinematics of an element: poses of its stations and its end relative to its start node.

use nalgebra::{Matrix3, Vector3};

use super::curvature_stiffness::curvature_stiffness;
use super::element::Element;
use super::row::{COMPONENTS, ROTATIONS, Row};
use crate::geometry::{Pose, RotationVector};

/// A Gauss point of a deformed element, in the frame of the preceding node.
#[derive(Debug, Clone)]
pub struct StationState {
    /// Rotation vector relative to the start.
    pub theta: RotationVector,
    /// Derivative of the rotation vector with respect to arc length, 1/m.
    pub rate: Vector3<f64>,
    /// Directors `A = exp(theta)`.
    pub directors: Matrix3<f64>,
    /// Left Jacobian of the rotation vector.
    pub left: Matrix3<f64>,
    /// `v = e3 +` shear and extension, in the directors, per arc length of the element's tables.
    pub stretch: Vector3<f64>,
    /// Derivative of the position with respect to arc length, `A v`.
    pub tangent: Vector3<f64>,
    /// Position, m.
    pub position: Vector3<f64>,
    /// Bending stiffness of what lies inside beside that of the section, N m2.
    pub lining: f64,
    /// Curvature without loads, per arc length of the element's tables, 1/m.
    pub rest: Vector3<f64>,
}

impl StationState {
    /// Rotation of the directors per arc length of the element's tables, in the directors, 1/m.
    pub(super) fn curvature(&self) -> Vector3<f64> {
        self.left.tr_mul(&self.rate)
    }

    /// Position and directors.
    #[must_use]
    pub fn pose(&self) -> Pose {
        Pose { position: self.position, rotation: self.directors }
    }
}

/// The frame at any arc length of a deformed element, in the frame of the preceding node.
#[derive(Debug, Clone)]
pub struct FrameState {
    /// Rotation vector relative to the start.
    pub theta: RotationVector,
    /// Position (m) and directors `exp(theta)`.
    pub pose: Pose,
    /// Left Jacobian of the rotation vector.
    pub left: Matrix3<f64>,
}

/// A deformed element, in the frame of the preceding node.
#[derive(Debug, Clone)]
pub struct Configuration {
    /// The Gauss points.
    pub stations: Vec<StationState>,
    /// Its length relative to that of the element's tables: it changes where a shaft is pushed in.
    pub growth: f64,
    /// Rotation vector from start to end.
    pub end_theta: RotationVector,
    /// Pose of the end.
    pub end: Pose,
}

/// Sum of mode values times amplitudes, by component: rotation, then strain.
fn components(element: &Element, row: &[f64], amplitudes: &[f64]) -> (Vector3<f64>, Vector3<f64>) {
    let mut out = [0.0; COMPONENTS];
    for ((component, value), amplitude) in element.component.iter().zip(row).zip(amplitudes) {
        out[*component] += value * amplitude;
    }
    (Vector3::new(out[0], out[1], out[2]), Vector3::new(out[3], out[4], out[5]))
}

impl Configuration {
    /// The unloaded element.
    #[must_use]
    pub fn straight(element: &Element) -> Self {
        let state = StationState {
            theta: RotationVector::new(Vector3::zeros()),
            rate: Vector3::zeros(),
            directors: Matrix3::identity(),
            left: Matrix3::identity(),
            stretch: Vector3::z(),
            tangent: Vector3::z(),
            position: Vector3::zeros(),
            lining: 0.0,
            rest: Vector3::zeros(),
        };
        let mut out = Self {
            stations: vec![state; element.stations.len()],
            growth: 1.0,
            end_theta: RotationVector::new(Vector3::zeros()),
            end: Pose::identity(),
        };
        out.update(element, &vec![0.0; element.freedoms()]);
        out
    }

    /// Updates all states for the mode amplitudes `amplitudes`.
    pub fn update(&mut self, element: &Element, amplitudes: &[f64]) {
        let mut end_position = Vector3::new(0.0, 0.0, element.offset);
        for (state, station) in self.stations.iter_mut().zip(&element.stations) {
            let (theta, _) = components(element, &station.row.integral, amplitudes);
            let (rate, strain) = components(element, &station.row.rate, amplitudes);
            state.rest = station.row.rest_rate * self.growth;
            state.theta = RotationVector::new(theta + station.row.rest_angle * self.growth);
            state.rate = rate + state.rest;
            state.directors = state.theta.matrix();
            state.left = state.theta.left_jacobian();
            state.stretch = Vector3::z() * self.growth + strain;
            state.tangent = state.directors * state.stretch;
            end_position += state.tangent * station.weight;
        }
        for (index, station) in element.stations.iter().enumerate() {
            self.stations[index].position = self.position_at(element, &station.row);
        }
        let end = Vector3::new(amplitudes[0], amplitudes[1], amplitudes[2]);
        self.end_theta = RotationVector::new(end + element.rest_angle * self.growth);
        self.end = Pose { position: end_position, rotation: self.end_theta.matrix() };
    }

    fn position_at(&self, element: &Element, row: &Row) -> Vector3<f64> {
        let mut sum = Vector3::zeros();
        for (state, weight) in self.stations.iter().zip(&row.position) {
            sum += state.tangent * *weight;
        }
        Vector3::new(0.0, 0.0, element.offset) + sum
    }

    /// The pose at a tabulated arc length, in the frame of the preceding node.
    #[must_use]
    pub fn pose_at(&self, element: &Element, row: &Row, amplitudes: &[f64]) -> Pose {
        let rotation = self.rotation_at(element, row, amplitudes).matrix();
        Pose { position: self.position_at(element, row), rotation }
    }

    /// The frame at a tabulated arc length.
    #[must_use]
    pub fn frame_at(&self, element: &Element, row: &Row, amplitudes: &[f64]) -> FrameState {
        let theta = self.rotation_at(element, row, amplitudes);
        let pose = Pose { position: self.position_at(element, row), rotation: theta.matrix() };
        FrameState { pose, left: theta.left_jacobian(), theta }
    }

    /// Position (m) and its derivative with respect to the table's arc length at a tabulated arc length, in the frame of the preceding node.
    #[must_use]
    pub fn curve_at(&self, element: &Element, row: &Row, amplitudes: &[f64]) -> (Vector3<f64>, Vector3<f64>) {
        let (_, strain) = components(element, &row.rate, amplitudes);
        let directors = self.rotation_at(element, row, amplitudes).matrix();
        (self.position_at(element, row), directors * (Vector3::z() * self.growth + strain))
    }

    /// The rotation vector at a tabulated arc length.
    #[must_use]
    pub fn rotation_at(&self, element: &Element, row: &Row, amplitudes: &[f64]) -> RotationVector {
        let theta = components(element, &row.integral, amplitudes).0;
        RotationVector::new(theta + row.rest_angle * self.growth)
    }

    /// The rotation vector at a tabulated arc length, and its derivative by the table's arc length, 1/m.
    pub(super) fn turned_at(
        &self,
        element: &Element,
        row: &Row,
        amplitudes: &[f64],
    ) -> (RotationVector, Vector3<f64>) {
        let (rate, _) = components(element, &row.rate, amplitudes);
        (self.rotation_at(element, row, amplitudes), rate + row.rest_rate * self.growth)
    }

    /// Curvature about `d1` and `d2`, and twist about `d3`, at a tabulated arc length: rotation of the directors per arc length
    /// (1/m), in the directors.
    #[must_use]
    pub fn curvature_at(&self, element: &Element, row: &Row, amplitudes: &[f64]) -> Vector3<f64> {
        let (theta, rate) = self.turned_at(element, row, amplitudes);
        theta.left_jacobian().tr_mul(&rate) / self.growth
    }

    /// Rotation of the directors per the table's arc length (rad/m) at a tabulated arc length, in the frame of the preceding node.
    #[must_use]
    pub fn turning_at(&self, element: &Element, row: &Row, amplitudes: &[f64]) -> Vector3<f64> {
        let (theta, rate) = self.turned_at(element, row, amplitudes);
        theta.left_jacobian() * rate
    }

    /// Elastic energy, J.
    #[must_use]
    pub fn elastic_energy(&self, element: &Element, amplitudes: &[f64]) -> f64 {
        let mut energy = 0.0;
        for (state, station) in self.stations.iter().zip(&element.stations) {
            let curvature = state.curvature();
            let k = station.stiffness.lined(state.lining);
            let bending = curvature.x * curvature.x + curvature.y * curvature.y;
            energy += 0.5 * station.weight * (k.bending * bending + k.torsion * curvature.z * curvature.z);
            // What lies inside is straight without loads, the section need not be.
            let moment = curvature_stiffness(&station.stiffness, station.weight).component_mul(&state.rest);
            energy -= moment.dot(&(curvature - state.rest * 0.5));
        }
        for ((component, stiffness), amplitude) in
            element.component.iter().zip(&element.metric).zip(amplitudes)
        {
            if *component >= ROTATIONS {
                energy += 0.5 * stiffness * amplitude * amplitude;
            }
        }
        energy / self.growth
    }

    /// The rod without what lies inside it.
    #[must_use]
    pub fn unlined(&self) -> Self {
        let mut out = self.clone();
        out.stations.iter_mut().for_each(|state| state.lining = 0.0);
        out
    }
}
