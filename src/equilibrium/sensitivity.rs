//! Exact derivatives of all outputs, from the factorisation of the Hessian at the equilibrium.
//!
//! Every input has a column `@2U/@q@u` and every output a row; the wrenches, derivatives of the energy by rigid
//! motions, have rows that are columns of the inputs. Moving the base is moving everything else the other way,
//! seen from a frame that moves with the base.

use nalgebra::{DMatrix, DMatrixView, Dim, Dyn, Matrix, Matrix3, RawStorage, Vector3};

use super::columns::{Columns, carried, turned};
use super::field_rates::{FIELD_INPUTS, field_rates};
use super::inputs::Inputs;
use super::jacobian::{Counts, Input, Jacobian};
use super::potential::Potential;
use super::settings::Interaction;
use super::solver::{Equilibrium, Place};
use crate::error::Error;
use crate::geometry::{Pose, hat};
use crate::magnetics::LinearField;
use crate::numerics::trust_region::{Objective, norm, spread};
use crate::rod::{Configuration, Row, START};

/// Stiffness of the softest direction, relative to the elastic one, from which on a shape counts as at a fold: the
/// residual of a solve leaves the stiffness itself uncertain by its square root, 3e-6.
const SINGULAR: f64 = 1e-5;

/// Inverse iterations that look for it: near a fold, each gains orders of magnitude.
const ITERATIONS: usize = 4;

/// Sine of an angle below which its corner counts as reached.
const CORNER: f64 = 1e-9;

/// What a quantity does when the whole scene moves as one body.
#[derive(Debug, Clone, Copy)]
enum Carried {
    Not,
    Vector(Vector3<f64>),
    Position(Vector3<f64>),
    Rotation,
}

/// The rows, one quantity after the other.
struct Rows {
    matrix: DMatrix<f64>,
    next: usize,
    base: Vector3<f64>,
}

impl Rows {
    /// Adds a quantity's derivatives, seen from the base in the base's columns.
    fn push<R: Dim, S: RawStorage<f64, R, Dyn>>(&mut self, rates: &Matrix<f64, R, Dyn, S>, kind: Carried) {
        let mut rows = self.matrix.rows_mut(self.next, rates.nrows());
        rows.iter_mut().zip(rates.iter()).for_each(|(entry, rate)| *entry = *rate);
        self.next += rates.nrows();
        let (shift, spin) = (Input::BasePosition.columns().start, Input::BaseRotation.columns().start);
        let mut add = |column: usize, block: Matrix3<f64>| {
            let mut part = rows.columns_mut(column, 3);
            part += block;
        };
        match kind {
            Carried::Not => {}
            Carried::Vector(vector) => add(spin, -hat(&vector)),
            Carried::Rotation => add(spin, Matrix3::identity()),
            Carried::Position(point) => {
                add(shift, Matrix3::identity());
                add(spin, -hat(&(point - self.base)));
            }
        }
    }

    /// Two vectors, a wrench's.
    fn push_wrench(&mut self, rates: &DMatrix<f64>, wrench: [Vector3<f64>; 2]) {
        for (part, vector) in [0, 3].into_iter().zip(wrench) {
            self.push(&rates.rows(part, 3), Carried::Vector(vector));
        }
    }
}

/// Displacements (m) and rotations (rad) of the nodes, and of the columns of each element's tangent.
struct Motion {
    nodes: Vec<DMatrix<f64>>,
    elements: Vec<DMatrix<f64>>,
}

impl Equilibrium {
    /// Derivatives of all outputs by all inputs at the last solved shape.
    ///
    /// The equilibrium itself stays as it is, and goes on as if nothing had been asked.
    ///
    /// # Errors
    /// [`Error::NoDerivatives`] before the first solved shape; at a fold, where the shape moves infinitely far with
    /// its inputs (the stiffness of some direction is below 1e-5 of the elastic one); and where a part lies inside
    /// or on an edge of the external magnet, be it switched off.
    pub fn jacobian(&self) -> Result<Jacobian, Error> {
        let nothing = || Error::NoDerivatives("nothing is solved yet".into());
        let inputs = self.branch.inputs.clone().ok_or_else(nothing)?;
        // Evaluations of the copy leave no trace.
        self.clone().differentiate(&inputs)
    }

    fn differentiate(&mut self, inputs: &Inputs) -> Result<Jacobian, Error> {
        let shape = self.shape.clone();
        let counts = Counts {
            rings: self.chain.rings.len(),
            shape_points: shape.len(),
            cores: self.chain.cores.len(),
        };
        let (unknowns, magnet) = (self.branch.unknowns.clone(), self.magnet.clone());
        let mut potential = self.potential(inputs, &unknowns);
        let stiffness = match potential.linearise(&unknowns) {
            Some(_) if potential.factorise(0.0) => potential.softest_stiffness(),
            _ => 0.0,
        };
        if stiffness.is_nan() || stiffness < SINGULAR {
            let reason = format!(
                "the shape is at a fold: its softest direction has {stiffness:.1e} of the elastic stiffness"
            );
            return Err(Error::NoDerivatives(reason));
        }
        let inside =
            || Error::NoDerivatives("a part lies inside or on an edge of the external magnet".into());
        let by_base = carried(inputs, &counts);
        let mut columns = potential.columns(magnet.as_ref(), &counts).ok_or_else(inside)?;
        let mut on_field = columns.clamp.clone();
        on_field.columns_mut(FIELD_INPUTS, counts.inputs() - FIELD_INPUTS).fill(0.0);
        for part in [&mut columns.gradient, &mut columns.clamp, &mut on_field] {
            carry(part, &by_base);
        }
        let mut unknown_rates = -&columns.gradient;
        for column in unknown_rates.as_mut_slice().chunks_exact_mut(unknowns.len()) {
            potential.solve(column);
        }
        let motion = potential.motion(&unknown_rates);
        let clamp = potential.clamp_rates(&columns, &by_base, &unknown_rates, &motion);
        let base = inputs.base.position;
        let matrix = DMatrix::zeros(counts.outputs(), counts.inputs());
        let mut rows = Rows { matrix, next: 0, base };

        let (tip, last) = (self.tip(), self.chain.elements.len());
        let tip_rates = moved(&motion.nodes[last], &(tip.position - self.work.nodes[last].position));
        let (tip_position, tip_rotation) = halves(&tip_rates);
        rows.push(&(bending(&inputs.base.axis(), &tip.axis()).transpose() * &tip_rotation), Carried::Not);
        rows.push(&tip_position, Carried::Position(tip.position));
        rows.push(&tip_rotation, Carried::Rotation);

        let magnetic = self.magnetic_wrench();
        let mut by_field = by_base.clone();
        by_field.rows_mut(FIELD_INPUTS, counts.inputs() - FIELD_INPUTS).fill(0.0);
        let by_shape = (&columns.gradient * by_field).tr_mul(&unknown_rates);
        rows.push_wrench(&(by_shape - &on_field), [magnetic.force, magnetic.torque]);
        let reaction = self.base_reaction();
        rows.push_wrench(&clamp, [reaction.force, reaction.torque]);

        let reaction = self.magnet_reaction(inputs);
        let mut on_magnet = columns.clamp.clone();
        on_magnet.columns_mut(7, counts.inputs() - 7).fill(0.0);
        let (force, _) = halves(&on_magnet);
        let mut torque = on_magnet.rows_mut(3, 3);
        torque -= hat(&(inputs.magnet.position - base)) * force;
        let mut by_position = torque.columns_mut(0, 3);
        by_position += hat(&reaction.force);
        carry(&mut on_magnet, &by_base);
        let by_shape = columns.gradient.columns(0, 6).tr_mul(&unknown_rates);
        rows.push_wrench(&(on_magnet - by_shape), [reaction.force, reaction.torque]);

        let rates = field_rates(magnet.as_ref(), inputs, &tip.position).ok_or_else(inside)?;
        let mut field = DMatrix::zeros(3, counts.inputs());
        let mut gradient = LinearField::new(inputs.uniform_field, inputs.field_gradient).gradient();
        for (column, (rate, _)) in rates.iter().enumerate() {
            field.set_column(column, rate);
            if column < 3 {
                // The magnet's field moves with it: minus its gradient.
                gradient.set_column(column, &(gradient.column(column) - rate));
            }
        }
        carry(&mut field, &by_base);
        let at_tip = self.field_at(inputs, &tip.position).unwrap_or_default();
        rows.push(&(field + gradient * tip_position), Carried::Vector(at_tip));

        for point in shape.iter() {
            let (pose, rates) = match &point.place {
                Place::Rigid(node, distance) => {
                    let pose = self.work.nodes[*node];
                    (pose.advanced(*distance), moved(&motion.nodes[*node], &(pose.axis() * *distance)))
                }
                Place::Elastic(element, row) => self.place(*element, row, &motion),
            };
            rows.push(&rates.rows(0, 3), Carried::Position(pose.position));
        }
        let rings: Vec<Pose> = self.rings().collect();
        for (body, pose) in self.chain.rings.iter().zip(rings) {
            let arm = pose.position - self.work.nodes[body.node].position;
            let (position, rotation) = halves(&moved(&motion.nodes[body.node], &arm));
            let axis = pose.axis();
            rows.push(&position, Carried::Position(pose.position));
            rows.push(&rotation, Carried::Rotation);
            rows.push(&(-hat(&axis) * &rotation), Carried::Vector(axis));
        }
        for (first, last) in self.chain.clone().cores.iter().copied() {
            let end = |element: usize, end: usize| &self.chain.elements[element].core_ends[end];
            let (from, to) = (end(first, 0).clone(), end(last, 1).clone());
            let (start, start_rates) = self.place(first, &from, &motion);
            let (stop, stop_rates) = self.place(last, &to, &motion);
            let turn = stop_rates.rows(3, 3) - start_rates.rows(3, 3);
            rows.push(&(bending(&start.axis(), &stop.axis()).transpose() * turn), Carried::Not);
        }
        Ok(Jacobian { matrix: rows.matrix, counts })
    }

    /// Pose of a place on an element, and its displacement and rotation by each input.
    fn place(&mut self, k: usize, row: &Row, motion: &Motion) -> (Pose, DMatrix<f64>) {
        let element = &self.chain.elements[k];
        let amplitudes = self.chain.part(k, &self.branch.unknowns);
        let local = self.work.configurations[k].pose_at(element, row, amplitudes);
        let left = Configuration::rotation_at(element, row, amplitudes).left_jacobian();
        let tangent = &mut self.work.tangents[k];
        let size = tangent.size;
        let columns = DMatrixView::from_slice(tangent.motion(element, row, &local.position, &left), size, 6);
        let node = self.work.nodes[k];
        (node.compose(&local), turned(&node.rotation, &columns.tr_mul(&motion.elements[k])))
    }
}

impl Potential<'_> {
    /// Stiffness of the softest direction relative to the elastic one, from above, close where it is small: by
    /// inverse iteration, with or without a potential.
    fn softest_stiffness(&mut self) -> f64 {
        let metric = &self.chain.metric;
        let mut direction = vec![0.0; metric.len()];
        spread(metric, &mut direction, 1.0);
        let mut growth = f64::INFINITY;
        for _ in 0..ITERATIONS {
            let size = norm(metric, &direction);
            direction.iter_mut().zip(metric).for_each(|(x, k)| *x *= k / size);
            self.solve(&mut direction);
            growth = norm(metric, &direction);
        }
        1.0 / growth
    }

    /// Carries the rates of the unknowns along the chain, from the base that stands still.
    fn motion(&mut self, unknown_rates: &DMatrix<f64>) -> Motion {
        let mut nodes = vec![DMatrix::zeros(6, unknown_rates.ncols())];
        let mut elements = Vec::new();
        for k in 0..self.chain.elements.len() {
            let axes = self.work.nodes[k].rotation;
            let end = self.end_motion(k);
            let mut whole = DMatrix::zeros(end.nrows(), unknown_rates.ncols());
            whole.rows_mut(0, START).copy_from(&turned(&axes.transpose(), &nodes[k]));
            let own = unknown_rates.rows(self.chain.first[k], end.nrows() - START);
            whole.rows_mut(START, own.nrows()).copy_from(&own);
            nodes.push(turned(&axes, &end.tr_mul(&whole)));
            elements.push(whole);
        }
        Motion { nodes, elements }
    }

    /// Rates of the clamp's wrench at a fixed base.
    fn clamp_rates(
        &mut self,
        columns: &Columns,
        by_base: &DMatrix<f64>,
        unknown_rates: &DMatrix<f64>,
        motion: &Motion,
    ) -> DMatrix<f64> {
        if self.settings.interaction == Interaction::Preceding {
            return self.clamp_without_reciprocity(motion) + &columns.clamp;
        }
        // Nothing inside pulls at the clamp: its wrench is the energy's derivative by what surrounds the chain. A
        // dead moment has none, and is there as it is wherever the tip turns.
        let mut around = by_base.clone();
        around.rows_mut(Input::TipMoment.columns().start, 3).fill(0.0);
        &columns.clamp - (&columns.gradient * around).tr_mul(unknown_rates)
    }

    /// The part of it that comes from the shape, added up from the tip where actions lack their reactions.
    fn clamp_without_reciprocity(&mut self, motion: &Motion) -> DMatrix<f64> {
        let last = self.chain.elements.len();
        let mut others = DMatrix::zeros(6 * last, motion.nodes[0].ncols());
        for (k, node) in motion.nodes.iter().skip(1).enumerate() {
            others.rows_mut(6 * k, 6).copy_from(node);
        }
        // Rows of symmetric matrices are read as their columns.
        let by_column = DMatrixView::from_slice(&self.work.node_hessian, 6 * last, 6 * last);
        let mut on_nodes = by_column.tr_mul(&others);
        let (_, turn) = halves(&motion.nodes[last]);
        let mut on_tip = on_nodes.rows_mut(6 * last - 3, 3);
        on_tip -= hat(&self.inputs.tip_moment) * turn * 0.5;
        let mut wrench = DMatrix::zeros(6, others.ncols());
        for k in (0..last).rev() {
            wrench += on_nodes.rows(6 * k, 6);
            let axes = self.work.nodes[k].rotation;
            let end = self.end_motion(k);
            let size = end.nrows();
            let hessian = DMatrixView::from_slice(&self.work.tangents[k].hessian, size, size);
            let cross = DMatrixView::from_slice(&self.work.cross[k], 6 * last, size);
            let local = hessian.columns(0, START).tr_mul(&motion.elements[k])
                + cross.columns(0, START).tr_mul(&others)
                + end.rows(0, START) * turned(&axes.transpose(), &wrench);
            wrench = turned(&axes, &local);
        }
        wrench
    }
}

/// Fills the base's columns, seen from the base: what surrounds the chain moves the other way.
fn carry(rates: &mut DMatrix<f64>, by_base: &DMatrix<f64>) {
    let columns = -&*rates * by_base;
    rates.columns_mut(Input::BasePosition.columns().start, 6).copy_from(&columns);
}

/// Displacement and rotation of a point at `arm` from one that moves so.
fn moved(twists: &DMatrix<f64>, arm: &Vector3<f64>) -> DMatrix<f64> {
    let mut out = twists.clone();
    let mut position = out.rows_mut(0, 3);
    position -= hat(arm) * twists.rows(3, 3);
    out
}

fn halves(twists: &DMatrix<f64>) -> (DMatrix<f64>, DMatrix<f64>) {
    (twists.rows(0, 3).into_owned(), twists.rows(3, 3).into_owned())
}

/// The axis about which a rotation of `to` opens the angle from `from`; zero where the angle has a corner.
fn bending(from: &Vector3<f64>, to: &Vector3<f64>) -> Vector3<f64> {
    from.cross(to).try_normalize(CORNER).unwrap_or_default()
}
