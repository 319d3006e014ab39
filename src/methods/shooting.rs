//! Single shooting: integration from the base, and the base wrench for which the tip carries its load.
//!
//! Where later rings act back on preceding ones, the wrenches of these reactions are additional unknowns; their difference to
//! the reactions computed along the shape is the residual. So every load is known when the integration reaches it.

use nalgebra::{DMatrix, DVector, Matrix3, Vector6};

use super::shape::Shape;
use super::strong_form::State;
use super::surroundings::{NodeLoad, Surroundings, column};
use super::trace::Trace;
use crate::geometry::Pose;
use crate::numerics::levenberg_marquardt::{self, Ending, LeastSquares};
use crate::rod::Order;

/// The unknowns of the last solved shape: the base wrench, then the reactions on the rings between the first and the last.
///
/// In the axes of the base and in units of [`super::line::Line::wrench_units`].
#[derive(Debug, Clone)]
pub(super) struct Shooting {
    unknowns: DVector<f64>,
    exact: bool,
    steps: usize,
}

/// One integration from base to tip.
struct Shot {
    /// Poses of all nodes.
    nodes: Vec<Pose>,
    /// Internal wrench at the start of each element; the entry after the last node is the residual at the tip.
    wrenches: Vec<Vector6<f64>>,
    loads: Vec<NodeLoad>,
    /// Reactions of later rings on preceding ones.
    reactions: Vec<Vector6<f64>>,
    /// Derivatives of each node's displacement and of the tip residual with respect to the unknowns; empty unless requested.
    columns: Vec<DMatrix<f64>>,
}

/// Shooting in given surroundings.
struct Problem<'a, 'b> {
    around: &'a Surroundings<'b>,
    exact: bool,
    steps: usize,
}

impl Shooting {
    pub(super) fn new(exact: bool, steps: usize) -> Self {
        Self { unknowns: DVector::zeros(0), exact, steps }
    }

    /// Solves from the last unknowns, which are replaced on success.
    pub(super) fn solve(&mut self, around: &Surroundings<'_>, tolerance: f64, iterations: u32) -> Ending {
        let mut problem = Problem { around, exact: self.exact, steps: self.steps };
        // The first solve starts straight and without wrenches.
        self.unknowns.resize_vertically_mut(problem.size(), 0.0);
        let mut unknowns = self.unknowns.clone();
        let end = levenberg_marquardt::solve(&mut problem, &mut unknowns, tolerance, iterations);
        if end.converged {
            self.unknowns = unknowns;
        }
        end
    }

    /// Node poses, base wrench and shape of the last solution.
    pub(super) fn shape(&self, around: &Surroundings<'_>) -> Option<Shape> {
        let problem = Problem { around, exact: self.exact, steps: self.steps };
        let mut trace = Trace::default();
        let shot = problem.shoot(&self.unknowns, false, Some(&mut trace))?;
        Some(Shape { nodes: shot.nodes, base: shot.wrenches[0], trace })
    }
}

impl Problem<'_, '_> {
    /// Number of nodes between the first and the last with a reaction.
    fn reacting(&self) -> usize {
        if self.around.has_pairs() { self.around.line.count() - 1 } else { 0 }
    }

    fn size(&self) -> usize {
        6 + 6 * self.reacting()
    }

    /// The wrench of that number among the unknowns.
    fn wrench(&self, unknowns: &DVector<f64>, number: usize) -> Vector6<f64> {
        let units = self.around.line.wrench_units();
        let scaled = Vector6::from_fn(|i, _| unknowns[6 * number + i] * units[i]);
        turned(&self.around.inputs.base.rotation, &scaled)
    }

    fn wrench_columns(&self, number: usize) -> DMatrix<f64> {
        let units = self.around.line.wrench_units();
        let mut out = DMatrix::zeros(6, self.size());
        for (i, unit) in units.iter().enumerate() {
            let column = turned(&self.around.inputs.base.rotation, &Vector6::ith(i, *unit));
            out.column_mut(6 * number + i).copy_from(&column);
        }
        out
    }

    fn shoot(&self, unknowns: &DVector<f64>, linear: bool, mut trace: Option<&mut Trace>) -> Option<Shot> {
        let (around, count) = (self.around, self.around.line.count());
        let order = if linear { Order::Hessian } else { Order::Gradient };
        let base = around.inputs.base;
        let mut shot = Shot {
            nodes: vec![base],
            wrenches: vec![self.wrench(unknowns, 0)],
            loads: Vec::new(),
            reactions: vec![Vector6::zeros(); count + 1],
            columns: Vec::new(),
        };

        let mut columns = nalgebra::OMatrix::<f64, nalgebra::U12, nalgebra::Dyn>::zeros(if linear {
            self.size()
        } else {
            0
        });
        if linear {
            columns.rows_mut(6, 6).copy_from(&self.wrench_columns(0));
            shot.columns.push(columns.rows(0, 6).into_owned());
        }

        for element in 0..count {
            let state = State { pose: shot.nodes[element], wrench: shot.wrenches[element] };
            let mut end = if linear {
                let (end, own) = around.cross_linear(element, &state, self.steps)?;
                columns = own * columns;
                end
            } else {
                around.cross(element, &state, self.steps, trace.as_deref_mut())?
            };

            let node = element + 1;
            shot.nodes.push(end.pose);
            let load = around.node(node, &shot.nodes, order)?;
            end.wrench += load.gradient;

            if linear {
                let moved = columns.rows(0, 6).into_owned();
                let mut added = load.own * &moved;
                for pair in &load.pairs {
                    added += pair.by_first * &shot.columns[pair.node];
                }
                shot.columns.push(moved);
                let mut target = columns.rows_mut(6, 6);
                target += added;
            }

            // Reactions on nodes already passed: their wrenches are unknowns, and these sums what they must
            // equal.
            for pair in &load.pairs {
                shot.reactions[pair.node] += pair.reaction;
            }

            if (1..=self.reacting()).contains(&node) {
                end.wrench += self.wrench(unknowns, node);
                if linear {
                    let mut target = columns.rows_mut(6, 6);
                    target += self.wrench_columns(node);
                }
            }

            shot.loads.push(load);
            shot.wrenches.push(end.wrench);
        }

        if let Some(trace) = trace {
            trace.add_rigid(around.line.chain.tip_offset, &shot.nodes[count]);
        }
        if linear {
            shot.columns.push(columns.rows(6, 6).into_owned());
        }
        Some(shot)
    }

    /// Writes a wrench to `out`, scaled and in the axes of the base.
    fn put(&self, out: &mut DVector<f64>, number: usize, wrench: &Vector6<f64>) {
        let units = self.around.line.wrench_units();
        let local = turned(&self.around.inputs.base.rotation.transpose(), wrench);
        for i in 0..6 {
            out[6 * number + i] = local[i] / units[i];
        }
    }

    fn defects(&self, unknowns: &DVector<f64>, shot: &Shot) -> DVector<f64> {
        let mut out = DVector::zeros(self.size());
        self.put(&mut out, 0, &shot.wrenches[self.around.line.count()]);
        for node in 1..=self.reacting() {
            self.put(&mut out, node, &(self.wrench(unknowns, node) - shot.reactions[node]));
        }
        out
    }

    fn exact_jacobian(&self, unknowns: &DVector<f64>) -> Option<DMatrix<f64>> {
        let shot = self.shoot(unknowns, true, None)?;
        let mut rows = vec![shot.columns[shot.columns.len() - 1].clone()];
        rows.extend((1..=self.reacting()).map(|node| self.wrench_columns(node)));
        for (later, load) in shot.loads.iter().enumerate() {
            for pair in load.pairs.iter().filter(|pair| (1..=self.reacting()).contains(&pair.node)) {
                let [by_first, by_second] = &pair.reaction_by;
                rows[pair.node] -= by_first * &shot.columns[pair.node] + by_second * &shot.columns[later + 1];
            }
        }
        let mut out = DMatrix::zeros(self.size(), self.size());
        let mut scaled = DVector::zeros(self.size());
        for (number, rows) in rows.iter().enumerate() {
            for (j, column) in rows.column_iter().enumerate() {
                self.put(&mut scaled, number, &column.fixed_rows::<6>(0).into_owned());
                out.view_mut((6 * number, j), (6, 1)).copy_from(&scaled.rows(6 * number, 6));
            }
        }
        Some(out)
    }

    /// Forward differences with a relative step of the square root of the machine epsilon.
    fn difference_jacobian(&mut self, x: &DVector<f64>, residual: &DVector<f64>) -> Option<DMatrix<f64>> {
        let mut out = DMatrix::zeros(x.len(), x.len());
        let mut moved = x.clone();
        for j in 0..x.len() {
            moved[j] = x[j] + f64::EPSILON.sqrt() * x[j].abs().max(1.0);
            let step = moved[j] - x[j];
            let column = (self.residual(&moved)? - residual) / step;
            out.column_mut(j).copy_from(&column);
            moved[j] = x[j];
        }
        Some(out)
    }
}

impl LeastSquares for Problem<'_, '_> {
    fn residual(&mut self, x: &DVector<f64>) -> Option<DVector<f64>> {
        let shot = self.shoot(x, false, None)?;
        Some(self.defects(x, &shot))
    }

    fn jacobian(&mut self, x: &DVector<f64>, residual: &DVector<f64>) -> Option<DMatrix<f64>> {
        if self.exact { self.exact_jacobian(x) } else { self.difference_jacobian(x, residual) }
    }
}

/// A wrench in rotated axes.
fn turned(rotation: &Matrix3<f64>, wrench: &Vector6<f64>) -> Vector6<f64> {
    column(&(rotation * wrench.fixed_rows::<3>(0)), &(rotation * wrench.fixed_rows::<3>(3)))
}
