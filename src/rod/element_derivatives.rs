//! Element derivatives: gradient and Hessian of an element's energy by its mode amplitudes and the pose of its start node.
//!
//! Columns 0..3 are a displacement of the start node, 3..6 its rotation (both in the node's axes), the others the mode
//! amplitudes. All derivatives are exact: the second variation of the rotation vector's exponential is the geometric stiffness.

use nalgebra::{Matrix3, Vector3};

use super::bending::{self, Bending};
use super::element::Element;
use super::kinematics::{Configuration, StationState};
use super::load::{Load, turning};
use super::placed_load::{PlacedCoupling, PlacedLoad};
use super::row::{COMPONENTS, ROTATIONS, Row};
use crate::numerics::dense;

/// Order of the derivatives to evaluate.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Order {
    /// Gradient only.
    Gradient,
    /// Gradient and Hessian.
    Hessian,
}

/// Number of columns of the start node.
pub const START: usize = 6;

/// All loads on one element, in the axes of its start node.
#[derive(Debug, Clone, Copy)]
pub struct ElementLoads<'a> {
    /// Load on each Gauss point.
    pub stations: &'a [Load],
    /// Loads on frames at other arc lengths.
    pub placed: &'a [PlacedLoad],
    /// Mixed second derivatives of pairs of these.
    pub couplings: &'a [PlacedCoupling],
    /// Force (N) and moment (N m) on the end: the load of the rest of the chain, as derivatives of its energy.
    pub end: (Vector3<f64>, Vector3<f64>),
}

/// What all loads together do to the start node, with which the element moves as a rigid body.
struct StartLoad {
    force: Vector3<f64>,
    moment: Vector3<f64>,
    /// Derivative of the energy by the matrix that turns the element: couples, and forces times positions.
    whole: Matrix3<f64>,
}

impl StartLoad {
    fn of(configuration: &Configuration, loads: &ElementLoads<'_>) -> Self {
        let (end_force, end_moment) = &loads.end;
        let mut whole = end_force * configuration.end.position.transpose();
        let mut force = *end_force;
        let mut moment = configuration.end.position.cross(end_force) + end_moment;
        let stations = configuration.stations.iter().map(|state| &state.position).zip(loads.stations);
        let placed = loads.placed.iter().map(|placed| (&placed.frame.pose.position, &placed.load));
        for (position, load) in stations.chain(placed) {
            whole += load.couple + load.force * position.transpose();
            force += load.force;
            moment += position.cross(&load.force) + load.moment();
        }
        Self { force, moment, whole }
    }
}

/// A station, and what acts on it and beyond it.
struct LoadedStation<'a> {
    index: usize,
    state: &'a StationState,
    /// Length of the element relative to the one of its tables.
    growth: f64,
    load: &'a Load,
    /// Force of everything beyond the station on its tangent.
    beyond: Vector3<f64>,
}

/// First and second derivatives of one element's contribution to the Lagrangian.
#[derive(Debug, Clone)]
pub struct ElementDerivatives {
    /// Rows and columns: six of the start node and the element's freedoms.
    pub size: usize,
    /// Gradient.
    pub gradient: Vec<f64>,
    /// Hessian, row by row, symmetric.
    pub hessian: Vec<f64>,
    /// Derivative of the end's position with respect to each amplitude, for a fixed start, m.
    pub end_position: Vec<Vector3<f64>>,
    /// Derivatives of each station's tangent with respect to the amplitudes: three rows per station.
    tangents: Vec<f64>,
    /// Derivatives of one frame's displacement and rotation with respect to every column: six rows.
    pub(super) motion: Vec<f64>,
    /// The frame's load stiffness times these: six rows.
    pub(super) answer: Vec<f64>,
}

impl ElementDerivatives {
    /// Allocates storage for `element`.
    #[must_use]
    pub fn new(element: &Element) -> Self {
        let freedoms = element.freedoms();
        let size = START + freedoms;
        Self {
            size,
            gradient: vec![0.0; size],
            hessian: vec![0.0; size * size],
            end_position: vec![Vector3::zeros(); freedoms],
            tangents: vec![0.0; 3 * freedoms * element.stations.len()],
            motion: vec![0.0; 6 * size],
            answer: vec![0.0; 6 * size],
        }
    }

    /// Assembles the elastic energy and all `loads`.
    pub fn assemble(
        &mut self,
        element: &Element,
        configuration: &Configuration,
        amplitudes: &[f64],
        loads: &ElementLoads<'_>,
        order: Order,
    ) {
        let second = order == Order::Hessian;
        let (end_force, end_moment) = &loads.end;
        self.gradient.fill(0.0);
        if second {
            self.hessian.fill(0.0);
            self.end_position.fill(Vector3::zeros());
            self.fill_tangents(element, configuration);
        }

        let start = StartLoad::of(configuration, loads);
        for (index, (state, load)) in configuration.stations.iter().zip(loads.stations).enumerate() {
            // Force of everything beyond this station on its tangent.
            let mut beyond = end_force * element.stations[index].weight;
            for (other, distant) in element.stations.iter().zip(loads.stations) {
                beyond += distant.force * other.row.position[index];
            }
            for placed in loads.placed {
                beyond += placed.load.force * placed.row.position[index];
            }
            let station = LoadedStation { index, state, growth: configuration.growth, load, beyond };
            if second {
                self.add_station(element, &station);
                if load.stiff {
                    self.station_motion(element, index, state);
                    self.add_stiffness(load);
                }
            } else {
                self.add_station_gradient(element, &station);
            }
        }

        for placed in loads.placed {
            self.add_placed(element, placed, second);
        }
        self.add_end(configuration, end_moment, second);
        for i in 0..3 {
            self.gradient[i] = start.force[i];
            self.gradient[3 + i] = start.moment[i];
        }

        // The rotational strains' energy is in the stations; that of shear and stretch is diagonal in the amplitudes.
        for (((row, stiffness), amplitude), component) in
            (START..).zip(&element.metric).zip(amplitudes).zip(&element.component)
        {
            if *component >= ROTATIONS {
                self.gradient[row] += stiffness * amplitude / configuration.growth;
            }
        }
        if second {
            for coupling in loads.couplings {
                self.add_coupling(element, loads.placed, coupling);
            }
            self.complete(element, configuration.growth, &start.whole);
        }
    }

    /// Adds the second-order rotation of the start node and the strain stiffness, and fills the lower triangle.
    fn complete(&mut self, element: &Element, growth: f64, whole: &Matrix3<f64>) {
        let turned = turning(whole);
        for i in 0..3 {
            for j in 0..3 {
                self.hessian[(3 + i) * self.size + 3 + j] += turned[(i, j)];
            }
        }
        for ((row, stiffness), component) in (START..).zip(&element.metric).zip(&element.component) {
            if *component >= ROTATIONS {
                self.hessian[row * self.size + row] += stiffness / growth;
            }
        }
        for i in 0..self.size {
            for j in i + 1..self.size {
                self.hessian[j * self.size + i] = self.hessian[i * self.size + j];
            }
        }
    }

    /// Computes the derivatives of each station's tangent and of the end with respect to the amplitudes.
    fn fill_tangents(&mut self, element: &Element, configuration: &Configuration) {
        let freedoms = element.freedoms();
        for (index, (state, station)) in configuration.stations.iter().zip(&element.stations).enumerate() {
            let rows = &mut self.tangents[3 * index * freedoms..][..3 * freedoms];
            let turned: [Vector3<f64>; 3] =
                core::array::from_fn(|c| state.left.column(c).cross(&state.tangent));
            for (i, c) in element.component.iter().enumerate() {
                let column = if *c < ROTATIONS {
                    turned[*c] * station.row.integral[i]
                } else {
                    state.directors.column(c - ROTATIONS) * station.row.rate[i]
                };
                for k in 0..3 {
                    rows[k * freedoms + i] = column[k];
                }
                self.end_position[i] += column * station.weight;
            }
        }
    }

    /// Adds the contribution of a station to the gradient alone.
    fn add_station_gradient(&mut self, element: &Element, at: &LoadedStation<'_>) {
        let &LoadedStation { index, state, growth, load, ref beyond } = at;
        let station = &element.stations[index];
        let stiffness = [&station.stiffness.lined(state.lining), &station.stiffness];
        let (bend, rate) = bending::gradient(state, stiffness, station.weight / growth);
        let pull = beyond * state.stretch.transpose() + load.couple * state.directors;
        let slope = state.theta.rotation_gradient(&pull) + bend;
        let along = state.directors.tr_mul(beyond);
        let per_phi = [slope.x, slope.y, slope.z, 0.0, 0.0, 0.0];
        let per_psi = [rate.x, rate.y, rate.z, along.x, along.y, along.z];
        let rows = self.gradient[START..].iter_mut().zip(&element.component);
        for ((entry, c), (phi, psi)) in rows.zip(station.row.integral.iter().zip(&station.row.rate)) {
            *entry += per_phi[*c] * phi + per_psi[*c] * psi;
        }
    }

    /// Adds the elastic bending of a station and the second variation of its directors and tangent.
    fn add_station(&mut self, element: &Element, at: &LoadedStation<'_>) {
        let &LoadedStation { index, state, growth, load, ref beyond } = at;
        let station = &element.stations[index];
        let bend = Bending::new(state, station, growth);
        let pull = beyond * state.stretch.transpose() + load.couple * state.directors;
        let (slope, curve) = state.theta.contract_rotation(&pull);
        let slope = slope + bend.slope;
        let curve = curve + bend.curve;
        let shear: [Vector3<f64>; 3] =
            core::array::from_fn(|c| state.left.tr_mul(&state.directors.column(c).cross(beyond)));
        let along = state.directors.tr_mul(beyond);
        let (phi, psi) = (&station.row.integral, &station.row.rate);
        let size = self.size;
        for (i, (phi_i, psi_i)) in phi.iter().zip(psi).enumerate() {
            let a = element.component[i];
            let row = START + i;
            // Contribution of this row per integral (phi) and per value (psi) of a column's mode, by component.
            let (mut per_phi, mut per_psi) = ([0.0; COMPONENTS], [0.0; COMPONENTS]);
            if a < ROTATIONS {
                self.gradient[row] += slope[a] * phi_i + bend.rate_slope[a] * psi_i;
                for b in 0..ROTATIONS {
                    per_phi[b] = phi_i * curve[(a, b)] + psi_i * bend.mixed[(b, a)];
                    per_psi[b] = phi_i * bend.mixed[(a, b)] + psi_i * bend.rate_curve[(a, b)];
                    per_psi[ROTATIONS + b] = phi_i * shear[b][a];
                }
            } else {
                self.gradient[row] += along[a - ROTATIONS] * psi_i;
                for b in 0..ROTATIONS {
                    per_phi[b] = psi_i * shear[a - ROTATIONS][b];
                }
            }
            let target = &mut self.hessian[row * size + START..][..size - START];
            for (c, run) in &element.runs {
                let run = run.start.max(i)..run.end;
                if run.is_empty() {
                    continue;
                }
                let (a, b) = (per_phi[*c], per_psi[*c]);
                let columns = phi[run.clone()].iter().zip(&psi[run.clone()]);
                for (entry, (phi_j, psi_j)) in target[run].iter_mut().zip(columns) {
                    *entry += a * phi_j + b * psi_j;
                }
            }
        }
        self.add_station_turn(element, at);
    }

    /// Adds the mixed derivatives of a station's load with respect to the start node's rotation and the amplitudes.
    fn add_station_turn(&mut self, element: &Element, at: &LoadedStation<'_>) {
        let &LoadedStation { index, state, load, ref beyond, .. } = at;
        let turn = load.couple.transpose() - Matrix3::identity() * load.couple.trace();
        let turn_left = turn * state.left;

        let (freedoms, size) = (element.freedoms(), self.size);
        let rows = &self.tangents[3 * index * freedoms..][..3 * freedoms];
        for (i, phi_i) in element.stations[index].row.integral.iter().enumerate() {
            let column = Vector3::new(rows[i], rows[freedoms + i], rows[2 * freedoms + i]);
            let mut cross = column.cross(beyond);
            let c = element.component[i];
            if c < ROTATIONS {
                cross += turn_left.column(c) * *phi_i;
            }
            for k in 0..3 {
                self.hessian[(3 + k) * size + START + i] += cross[k];
            }
        }
    }

    /// Derivatives of a station's displacement and rotation with respect to every column, in the start node's axes: six rows.
    pub fn station_motion(&mut self, element: &Element, index: usize, state: &StationState) -> &[f64] {
        self.motion(element, &element.stations[index].row, &state.position, &state.left)
    }

    /// Derivatives of displacement and rotation at any arc length of the element, given its table `row`, position and left Jacobian.
    pub fn motion(
        &mut self,
        element: &Element,
        row: &Row,
        position: &Vector3<f64>,
        left: &Matrix3<f64>,
    ) -> &[f64] {
        let (freedoms, size) = (element.freedoms(), self.size);
        self.motion.fill(0.0);

        // The base's own motion: a rigid displacement, and a rotation, which swings the point about the
        // start.
        for k in 0..3 {
            let mut unit = Vector3::zeros();
            unit[k] = 1.0;
            let swing = unit.cross(position);
            self.motion[k * size + k] = 1.0;
            for axis in 0..3 {
                self.motion[axis * size + 3 + k] = swing[axis];
            }
            self.motion[(3 + k) * size + 3 + k] = 1.0;

            // Displacement: integral of the change of the tangents up to here.
            let target = &mut self.motion[k * size + START..][..freedoms];
            for (station, weight) in row.position.iter().enumerate().filter(|(_, weight)| **weight != 0.0) {
                let source = &self.tangents[(3 * station + k) * freedoms..][..freedoms];
                for (entry, value) in target.iter_mut().zip(source) {
                    *entry += weight * value;
                }
            }

            // Rotation: only the rotational strains turn the section, by the left Jacobian of their integral.
            let target = &mut self.motion[(3 + k) * size + START..][..freedoms];
            for (c, run) in element.runs.iter().filter(|(c, _)| *c < ROTATIONS) {
                let factor = left[(k, *c)];
                for (entry, value) in target[run.clone()].iter_mut().zip(&row.integral[run.clone()]) {
                    *entry = factor * value;
                }
            }
        }
        &self.motion
    }

    /// Adds the second derivatives of a load with respect to the position and directors of the frame whose motion was
    /// computed last.
    pub(super) fn add_stiffness(&mut self, load: &Load) {
        let stiffness: [f64; 36] = core::array::from_fn(|entry| {
            let (r, c) = (entry / 6, entry % 6);
            match (r / 3, c / 3) {
                (0, 0) => load.position_position[(r, c)],
                (0, _) => load.position_rotation[(r, c - 3)],
                (_, 0) => load.position_rotation[(c, r - 3)],
                _ => load.rotation_rotation[(r - 3, c - 3)],
            }
        });
        self.answer.fill(0.0);
        dense::add_product(&stiffness, &self.motion, 6, self.size, &mut self.answer);
        dense::add_upper(&self.motion, &self.answer, self.size, &mut self.hessian);
    }

    /// Adds the moment on the end, which acts on the rotation vector from start to end alone.
    fn add_end(&mut self, configuration: &Configuration, moment: &Vector3<f64>, second: bool) {
        let theta = &configuration.end_theta;
        let left = theta.left_jacobian();
        let slope = left.tr_mul(moment);
        for a in 0..3 {
            self.gradient[START + a] += slope[a];
        }
        if !second {
            return;
        }
        let product = theta.right_product_derivative(moment);
        for a in 0..3 {
            let cross = left.column(a).cross(moment) * 0.5;
            for b in 0..3 {
                self.hessian[(START + a) * self.size + START + b] +=
                    0.5 * (product[(a, b)] + product[(b, a)]);
                self.hessian[(3 + b) * self.size + START + a] += cross[b];
            }
        }
    }
}
