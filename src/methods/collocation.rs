//! Gauss collocation on a residual-controlled mesh, all equations solved together by Newton's method.
//!
//! On each interval the rates of the local coordinates are a polynomial that satisfies the equations at the Gauss points.
//! Newton's equations are almost block diagonal: the rates of each interval are condensed, the transition matrices of an
//! element's intervals are multiplied, and the nodal equations remain.
//!
//! Sources: Ascher, Christiansen and Russell, ACM Trans. Math. Softw. 7, 1981, doi:10.1145/355945.355950 (COLSYS: collocation,
//! elimination); Kierzenka and Shampine, ACM Trans. Math. Softw. 27, 2001, doi:10.1145/502800.502801 (bvp4c: control of the
//! residual).

use nalgebra::Matrix6;

use super::condensation::{Condensed, Windings};
use super::line::Line;
use super::mesh::{Interval, Tableau};
use super::node_shape::{Basis, NodeShape, couplings, flat, size};
use super::node_system::{Defects, NodeSystem};
use super::settings::Settings;
use super::shape::Shape;
use super::strong_form::{State, Vector12};
use super::surroundings::Surroundings;
use super::trace::Trace;
use crate::numerics::levenberg_marquardt::Ending;
use crate::numerics::newton::{self, Equations};
use crate::rod::Order;

/// Largest number of mesh refinements.
const ROUNDS: u32 = 12;

/// Largest number of intervals per element.
const MOST_INTERVALS: usize = 400;

/// Links per interval in the traced shape: between the mesh points the polynomial is of higher degree than a link.
const LINKS: usize = 4;

/// Mesh, polynomials and node states of the last solved shape.
#[derive(Debug, Clone)]
pub(super) struct Collocation {
    tableau: Tableau,
    guess: Guess,
}

/// The unknowns: node states, and the intervals of each element with their rates.
#[derive(Debug, Clone)]
struct Guess {
    shape: NodeShape,
    mesh: Vec<Vec<Interval>>,
}

/// The collocation equations of one scene on one mesh.
struct Collocated<'a, 'b> {
    around: &'a Surroundings<'b>,
    tableau: &'a Tableau,
    basis: Basis<6>,
    scale: Vector12,
    condensed: Vec<Condensed>,
    system: Option<NodeSystem<6>>,
    defects: Defects<6>,
    /// Residuals of the rates at the stages, by element and interval.
    residuals: Vec<Vec<Vec<Vector12>>>,
}

impl Collocation {
    pub(super) fn straight(line: &Line, settings: &Settings) -> Self {
        let mesh = (0..line.count())
            .map(|element| Interval::straight(line, element, settings.intervals, settings.stages))
            .collect();
        let guess = Guess { shape: NodeShape::straight(line), mesh };
        Self { tableau: Tableau::new(settings.stages), guess }
    }

    /// Solves and refines the mesh until no interval's residual is too large.
    pub(super) fn solve(&mut self, around: &Surroundings<'_>, settings: &Settings) -> Ending {
        let base = around.inputs.base;
        let turn = base.rotation * self.guess.shape.nodes[0].rotation.transpose();
        let turned = |element: &Vec<Interval>| element.iter().map(|i| i.turned(&turn)).collect();

        let mut guess = Guess {
            shape: self.guess.shape.carried(&base),
            mesh: self.guess.mesh.iter().map(turned).collect(),
        };

        let mut iterations = 0;
        for _ in 0..ROUNDS {
            let mut equations = Collocated::new(around, &self.tableau);
            let end = newton::solve(&mut equations, &mut guess, settings.tolerance, settings.iterations);
            iterations += end.iterations;
            let end = Ending { iterations, ..end };
            if !end.converged {
                return end;
            }

            let Some(refined) = equations.refined(&mut guess, settings.mesh_tolerance) else { break };
            if !refined {
                self.guess = guess;
                return end;
            }
        }
        Ending { converged: false, iterations, residual: f64::INFINITY }
    }

    pub(super) fn shape(&self, around: &Surroundings<'_>) -> Option<Shape> {
        let Guess { shape, mesh } = &self.guess;
        let mut trace = Trace::default();
        for (element, intervals) in mesh.iter().enumerate() {
            around.offset(element, &shape.state(element), Some(&mut trace));
            let (starts, _) = starts(around, &self.tableau, &self.guess, element);
            for (interval, state) in intervals.iter().zip(starts) {
                let mut from = (interval.at(0.0), state);
                for part in 1..=LINKS {
                    let x = part as f64 / LINKS as f64;
                    let to = (interval.at(x), state.displaced(&interval.local_at(&self.tableau, x)));
                    let rates = [around.rates(&from.0, &from.1)?, around.rates(&to.0, &to.1)?];
                    let length = interval.length / LINKS as f64;
                    trace.add(&from.0, length, [&from.1.pose, &to.1.pose], &rates);
                    from = to;
                }
            }
        }
        trace.add_rigid(around.line.chain.tip_offset, &shape.nodes[mesh.len()]);
        Some(Shape { nodes: shape.nodes.clone(), base: shape.wrenches[0], trace })
    }
}

/// The start of every interval of an element, and the element's end; then its touching windings.
fn starts(
    around: &Surroundings<'_>,
    tableau: &Tableau,
    at: &Guess,
    element: usize,
) -> (Vec<State>, Option<Windings>) {
    let mut states = vec![around.offset(element, &at.shape.state(element), None)];
    for (k, interval) in at.mesh[element].iter().enumerate() {
        states.push(states[k].displaced(&interval.end(tableau)));
    }
    let core = around.line.core(element);
    let piece = |piece: usize| at.mesh[element].partition_point(|interval| interval.place.piece < piece);
    let intervals = piece(core)..piece(core + 1);
    let ends = [intervals.start, intervals.end].map(|k| &states[k].pose);
    let carried = around.winding_moment(element, ends);
    if let Some(carried) = &carried {
        for state in &mut states[intervals.clone()] {
            *state = state.relieved(&carried.moment);
        }
    }
    (states, carried.map(|carried| Windings { intervals, by_ends: carried.by_ends }))
}

impl<'a, 'b> Collocated<'a, 'b> {
    fn new(around: &'a Surroundings<'b>, tableau: &'a Tableau) -> Self {
        let line = around.line;
        let units = line.pose_units().into_iter().chain(line.wrench_units());
        Self {
            around,
            tableau,
            basis: Basis::new(line, &Matrix6::identity()),
            scale: Vector12::from_iterator(units.map(|unit| line.length / unit)),
            condensed: Vec::new(),
            system: None,
            defects: Defects { pose: Vec::new(), wrench: Vec::new() },
            residuals: Vec::new(),
        }
    }

    /// Norm of all residuals, those of the rates weighted by their share of an element.
    fn size(&self, at: &Guess) -> f64 {
        let mut square = size(&self.defects).powi(2);
        for (intervals, residuals) in at.mesh.iter().zip(&self.residuals) {
            for (interval, stages) in intervals.iter().zip(residuals) {
                let share = interval.length / self.around.line.length;
                for (residual, weight) in stages.iter().zip(&self.tableau.weights) {
                    square += share * weight * residual.norm_squared();
                }
            }
        }
        square.sqrt()
    }

    /// Divides intervals whose residual is too large; whether there were any, `None` where their number exceeds the limit.
    fn refined(&self, guess: &mut Guess, tolerance: f64) -> Option<bool> {
        let mut refined = false;
        for element in 0..guess.mesh.len() {
            let (starts, _) = starts(self.around, self.tableau, guess, element);
            let mut divided = Vec::new();
            for (interval, start) in guess.mesh[element].iter().zip(&starts) {
                let excess = interval.residual(self.around, self.tableau, start, &self.scale)? / tolerance;
                if excess > 1.0 {
                    refined = true;
                    divided.extend(interval.divided(self.tableau, excess));
                } else {
                    divided.push(interval.clone());
                }
            }
            if divided.len() > MOST_INTERVALS {
                return None;
            }
            guess.mesh[element] = divided;
        }
        Some(refined)
    }
}

impl Equations for Collocated<'_, '_> {
    type Point = Guess;

    fn evaluate(&mut self, at: &Guess) -> Option<f64> {
        let mut ends = Vec::new();
        self.residuals.clear();
        for element in 0..at.mesh.len() {
            let (starts, _) = starts(self.around, self.tableau, at, element);
            let mut residuals = Vec::new();
            for (interval, start) in at.mesh[element].iter().zip(&starts) {
                let missing = |j: usize| {
                    let place = interval.stage(self.tableau, j);
                    let required = self.around.local_rate(&place, start, &interval.local(self.tableau, j))?;
                    Some((required - interval.rates[j]).component_mul(&self.scale))
                };
                residuals.push((0..interval.rates.len()).map(missing).collect::<Option<Vec<_>>>()?);
            }
            self.residuals.push(residuals);
            ends.push(starts[starts.len() - 1]);
        }
        let (_, loads) = self.around.nodes(&at.shape.nodes, Order::Gradient)?;
        self.defects = at.shape.defects(&self.basis, &ends, &loads);
        Some(self.size(at)).filter(|size| size.is_finite())
    }

    fn linearise(&mut self, at: &Guess) -> Option<f64> {
        let (mut ends, mut links) = (Vec::new(), Vec::new());

        self.residuals.clear();
        self.condensed.clear();
        for element in 0..at.mesh.len() {
            let (starts, windings) = starts(self.around, self.tableau, at, element);
            let mut condensed = Condensed::new(self.around, &self.basis, element, &at.shape.state(element));
            let mut residuals = Vec::new();

            for (interval, start) in at.mesh[element].iter().zip(&starts) {
                let stages = (0..interval.rates.len()).map(|j| {
                    let place = interval.stage(self.tableau, j);
                    self.around.stage(&place, start, &interval.local(self.tableau, j))
                });
                let stages = stages.collect::<Option<Vec<_>>>()?;
                let missing = stages.iter().zip(&interval.rates);
                residuals.push(
                    missing.map(|(stage, rate)| (stage.rate - rate).component_mul(&self.scale)).collect(),
                );
                condensed.add(self.tableau, interval, &stages)?;
            }

            if let Some(windings) = windings {
                condensed.couple(windings)?;
            }

            let end = starts[starts.len() - 1];
            let mut link = condensed.link();
            link.next = at.shape.next(&self.basis, element, &end);
            links.push(link);
            ends.push(end);
            self.residuals.push(residuals);
            self.condensed.push(condensed);
        }

        let (loads, totals) = self.around.nodes(&at.shape.nodes, Order::Hessian)?;
        self.defects = at.shape.defects(&self.basis, &ends, &totals);
        self.system = NodeSystem::new(links, &couplings(&self.basis, &loads));
        Some(self.size(at)).filter(|size| size.is_finite())
    }

    fn correction(&mut self) -> Option<Vec<f64>> {
        let mut defects = self.defects.clone();
        let mut particular = Vec::new();
        for (element, condensed) in self.condensed.iter().enumerate() {
            let own = condensed.particular(&self.residuals[element])?;
            let end = condensed.cross(&own, &Vector12::zeros(), None);
            defects.pose[element] += end.fixed_rows::<6>(0);
            defects.wrench[element] += end.fixed_rows::<6>(6);
            particular.push(own);
        }
        let solution = self.system.as_ref()?.solve(&defects)?;
        let mut step = flat(&solution);
        for (element, condensed) in self.condensed.iter().enumerate() {
            let mut start = Vector12::zeros();
            if element > 0 {
                start.fixed_rows_mut::<6>(0).copy_from(&solution.poses[element - 1]);
            }
            start.fixed_rows_mut::<6>(6).copy_from(&solution.wrenches[element]);
            condensed.cross(&particular[element], &start, Some(&mut step));
        }
        Some(step)
    }

    fn moved(&self, at: &Guess, step: &[f64], factor: f64) -> Guess {
        let mut out = Guess { shape: at.shape.moved(&self.basis, step, factor), mesh: at.mesh.clone() };
        let nodes = 12 * at.mesh.len();
        let rates = out.mesh.iter_mut().flatten().flat_map(|interval| &mut interval.rates);
        for (rate, change) in rates.zip(step[nodes..].chunks_exact(12)) {
            *rate += Vector12::from_column_slice(change).component_div(&self.scale) * factor;
        }
        out
    }
}
