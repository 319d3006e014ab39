//! Exact derivatives of all outputs, from the factorisation of the Hessian at the equilibrium.
//!
//! Every input has a column `@2U/@q@u` of mixed derivatives; one solve for each gives the rates of the unknowns, from
//! which the rates of the nodes follow along the chain. A motion of the base is the opposite motion of all other bodies
//! and fields, seen from a frame that moves with the base: its columns are combinations of the others.

use nalgebra::{DMatrix, DMatrixView};

use super::input_derivatives::{InputDerivatives, base_transport, turned};
use super::jacobian::Jacobian;
use super::output_derivatives::OutputDerivatives;
use super::response::{Motion, Response, inside, transport_base};
use crate::equilibrium::model::{Counts, Input, Inputs, Interaction, Potential};
use crate::equilibrium::search::Equilibrium;
use crate::error::Error;
use crate::numerics::trust_region::{Objective, norm, spread};
use crate::rod::START;

/// Stiffness of the softest direction, relative to the elastic stiffness, below which a shape counts as being at a fold:
/// the residual of a solve leaves the stiffness itself uncertain by its square root, 3e-6.
const SINGULAR: f64 = 1e-5;

/// Number of inverse iterations for it: near a fold, each gains orders of magnitude.
const ITERATIONS: usize = 4;

impl Equilibrium {
    /// Derivatives of all outputs with respect to all inputs at the last solved shape.
    ///
    /// Under friction they are those at the present normal forces and stick points. The equilibrium itself and its later
    /// solves stay unchanged.
    ///
    /// # Errors
    /// [`Error::NoDerivatives`] before the first solved shape; at a fold, where the derivatives are infinite (the
    /// stiffness of some direction is below 1e-5 of the elastic one); and where a part or the tip lies inside or on an
    /// edge of the external magnet. A magnet that is switched off there cannot be switched on: its columns are zero.
    pub fn jacobian(&self) -> Result<Jacobian, Error> {
        let nothing = || Error::NoDerivatives("nothing is solved yet".into());
        let inputs = self.branch.inputs.clone().ok_or_else(nothing)?;
        let mut copy = self.apart();
        let response = copy.response(&inputs)?;
        let mut rows = OutputDerivatives::new(&inputs, &response.counts);
        copy.add_tip(&mut rows, &response);
        copy.add_wrenches(&mut rows, &response);
        copy.add_feed(&mut rows, &response);
        copy.add_tip_field(&mut rows, &response)?;
        copy.add_shape(&mut rows, &response);
        copy.add_rings(&mut rows, &response);
        copy.add_cores(&mut rows, &response);
        let mut matrix = rows.into_matrix();
        let roll = matrix.columns_range(Input::BaseRotation.columns()) * inputs.base.axis();
        matrix.set_column(Input::Roll.columns().start, &roll);
        Ok(Jacobian { matrix, counts: response.counts })
    }

    fn response(&mut self, inputs: &Inputs) -> Result<Response, Error> {
        let counts = Counts {
            rings: self.chain.rings.len(),
            shape_points: self.shape.len(),
            cores: self.chain.cores.len(),
            sources: inputs.sources.len(),
        };
        let shape = self.branch.unknowns.clone();
        let by_insertion = self.by_insertion(inputs, &shape);

        let mut potential = self.potential(inputs, &shape);
        potential.factorise_regular(&shape)?;
        let (mut columns, with_idle) = potential.columns_of_present(&counts)?;
        let insertion = Input::Insertion.columns().start;
        if let Some(by_insertion) = &by_insertion {
            columns.gradient.column_mut(insertion).copy_from_slice(&by_insertion.gradient);
            columns.clamp.column_mut(insertion).copy_from_slice(&by_insertion.base);
        }
        if let Some(by_reach) = potential.work.lining_gradient_by_reach(potential.chain) {
            columns.gradient.column_mut(Input::GuidewireInsertion.columns().start).copy_from_slice(&by_reach);
        }

        let by_base = base_transport(inputs, &counts);
        transport_base(&mut columns.gradient, &by_base);
        transport_base(&mut columns.clamp, &by_base);

        let mut unknowns = -&columns.gradient;
        for column in unknowns.as_mut_slice().chunks_exact_mut(shape.len()) {
            potential.solve(column);
        }
        let motion = potential.motion(&unknowns);

        let none = || DMatrix::zeros(0, 0);
        let mut response =
            Response { counts, with_idle, by_base, columns, unknowns, motion, push: none(), clamp: none() };
        response.clamp = potential.clamp_rates(&response);
        if let Some(by_insertion) = &by_insertion {
            response.push = self.push_rates(&response, inputs, by_insertion);
        }
        Ok(response)
    }
}

impl Potential<'_> {
    /// The mixed derivatives at the shape linearised last, and whether they count sources that are switched off: one inside the
    /// manipulator can only stay off.
    fn columns_of_present(&mut self, counts: &Counts) -> Result<(InputDerivatives, bool), Error> {
        if let Some(columns) = self.columns(counts) {
            return Ok((columns, true));
        }
        self.terms.magnets = self.terms.magnets.without_idle();
        Ok((self.columns(counts).ok_or_else(inside)?, false))
    }

    /// Linearises at the shape `unknowns` and factorises its Hessian.
    ///
    /// # Errors
    /// [`Error::NoDerivatives`] at a fold.
    pub(crate) fn factorise_regular(&mut self, unknowns: &[f64]) -> Result<(), Error> {
        let stiffness = match self.linearise(unknowns) {
            Some(_) if self.factorise(0.0) => self.softest_stiffness(),
            _ => 0.0,
        };
        if stiffness.is_nan() || stiffness < SINGULAR {
            let reason = format!(
                "the shape is at a fold: its softest direction has {stiffness:.1e} of the elastic stiffness"
            );
            return Err(Error::NoDerivatives(reason));
        }
        Ok(())
    }

    /// Stiffness of the softest direction relative to the elastic stiffness, by inverse iteration: an upper bound, close
    /// where it is small, for conservative and non-conservative forces.
    fn softest_stiffness(&mut self) -> f64 {
        let metric = self.metric;
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

    /// Propagates the rates of the unknowns along the chain, from the fixed base.
    pub(crate) fn motion(&mut self, unknown_rates: &DMatrix<f64>) -> Motion {
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

    /// Rates of the clamp's wrench.
    fn clamp_rates(&mut self, response: &Response) -> DMatrix<f64> {
        let columns = &response.columns;
        if self.settings.interaction == Interaction::Preceding {
            return self.clamp_without_reciprocity(&response.motion) + &columns.clamp;
        }
        // No internal force acts on the clamp: its wrench is the energy's derivative with respect to a motion of all that
        // surrounds the chain. A fixed tip moment has no energy and does not follow the tip.
        let mut around = response.by_base.clone();
        around.rows_mut(Input::TipMoment.columns().start, 3).fill(0.0);
        &columns.clamp - (&columns.gradient * around).tr_mul(&response.unknowns)
    }

    /// The part of the clamp rates that comes from the shape, summed from the tip where forces lack their reactions.
    fn clamp_without_reciprocity(&mut self, motion: &Motion) -> DMatrix<f64> {
        let last = self.chain.elements.len();
        let mut others = DMatrix::zeros(6 * last, motion.nodes[0].ncols());
        for (k, node) in motion.nodes.iter().skip(1).enumerate() {
            others.rows_mut(6 * k, 6).copy_from(node);
        }
        // The matrices are stored row by row and therefore appear transposed.
        let transposed = DMatrixView::from_slice(&self.work.node_hessian, 6 * last, 6 * last);
        let on_nodes = transposed.tr_mul(&others);
        let mut wrench = DMatrix::zeros(6, others.ncols());
        for k in (0..last).rev() {
            wrench += on_nodes.rows(6 * k, 6);
            let axes = self.work.nodes[k].rotation;
            let end = self.end_motion(k);
            let size = end.nrows();
            let hessian = DMatrixView::from_slice(&self.work.derivatives[k].hessian, size, size);
            let cross = DMatrixView::from_slice(&self.work.cross[k], size, 6 * last);
            let local = hessian.columns(0, START).tr_mul(&motion.elements[k])
                + cross.rows(0, START) * &others
                + end.rows(0, START) * turned(&axes.transpose(), &wrench);
            wrench = turned(&axes, &local);
        }
        wrench
    }
}
