//! Verification of shapes that depends on nothing of a solver but the gradient of its potential.

use nalgebra::{DMatrix, DVector, Schur, SymmetricEigen};

use super::Equilibrium;
use crate::equilibrium::model::Inputs;

/// Step of the differences of gradients, in radians of the first mode.
const STEP: f64 = 1e-5;

/// Maximum number of Newton steps, and the residual (1: one element turned by a radian) at which a shape is an equilibrium.
const STEPS: usize = 30;
const BALANCE: f64 = 1e-8;

/// Largest ratio of successive residuals for which the matrix is reused in the next Newton step.
const SHRINKING: f64 = 0.1;

/// Entries below the diagonal that the QR algorithm takes for zero, relative to their neighbours. With the first it may not
/// converge, and then it does with the next; all are below the noise of the differences.
const DEFLATED: [f64; 4] = [1e-13, 1e-12, 1e-11, 1e-10];

/// Maximum number of iterations of the QR algorithm for each row.
const ITERATIONS: usize = 100;

/// Verifies shapes at given inputs with the gradient of a model alone, usually a finer one than has found them: Newton's
/// method and eigenvalues with full matrices of central differences of gradients. Its unit is the rotation of one
/// element by a radian; eigenvalues are relative to the stiffness of the straight shape, so that no elastic norm enters: they have
/// the sign of the stability margin, but at a bent shape not its size.
#[derive(Debug)]
pub struct Verifier<'a> {
    model: &'a mut Equilibrium,
    inputs: &'a Inputs,
    roots: DVector<f64>,
    symmetric: bool,
}

impl<'a> Verifier<'a> {
    /// `symmetric`: whether the forces have a potential, so that the matrix of differences is that of second derivatives.
    pub fn new(model: &'a mut Equilibrium, inputs: &'a Inputs, symmetric: bool) -> Self {
        let roots = DVector::from_iterator(model.freedoms(), model.metric().iter().map(|k| k.sqrt()));
        Self { model, inputs, roots, symmetric }
    }

    /// Norm of the gradient at a shape over that of one element turned by a radian; `None` where bodies share volume.
    pub fn residual(&mut self, unknowns: &[f64]) -> Option<f64> {
        let shape = self.weighted(unknowns);
        Some(self.gradient(&shape)?.norm() / self.roots[0])
    }

    /// Smallest real part of the eigenvalues at a shape, relative to the stiffness of the straight shape: stable above 0. `None` where
    /// bodies share volume.
    pub fn smallest_real_part(&mut self, unknowns: &[f64]) -> Option<f64> {
        let shape = self.weighted(unknowns);
        let matrix = self.matrix(&shape)?;
        if self.symmetric {
            return Some(SymmetricEigen::new((&matrix + matrix.transpose()) * 0.5).eigenvalues.min());
        }
        let rows = matrix.nrows();
        let schur = |deflated| Schur::try_new(matrix.clone(), deflated, ITERATIONS * rows);
        let values = DEFLATED.into_iter().find_map(schur)?.complex_eigenvalues();
        values.iter().map(|value| value.re).min_by(f64::total_cmp)
    }

    /// The equilibrium, stable or not, that Newton's method finds from a shape in steps of at most `longest_step` (1: one
    /// element turned by a radian), so that a shape is not compared with a distant equilibrium. `None` if it does not
    /// converge.
    pub fn polished(&mut self, start: &[f64], longest_step: f64) -> Option<Vec<f64>> {
        let unit = self.roots[0];
        let mut shape = self.weighted(start);
        let mut gradient = self.gradient(&shape)?;
        let mut matrix = None;
        for _ in 0..STEPS {
            let residual = gradient.norm() / unit;
            if residual <= BALANCE {
                return Some(shape.component_div(&self.roots).as_slice().to_vec());
            }
            let factors = match matrix.take() {
                Some(factors) => factors,
                None => self.matrix(&shape)?.lu(),
            };
            let step = factors.solve(&gradient)?;
            shape -= &step * f64::min(1.0, longest_step * unit / step.norm());
            gradient = self.gradient(&shape)?;
            matrix = (gradient.norm() / unit <= SHRINKING * residual).then_some(factors);
        }
        None
    }

    fn weighted(&self, unknowns: &[f64]) -> DVector<f64> {
        DVector::from_column_slice(unknowns).component_mul(&self.roots)
    }

    fn gradient(&mut self, shape: &DVector<f64>) -> Option<DVector<f64>> {
        let (_, gradient) = self.model.gradient(self.inputs, shape.component_div(&self.roots).as_slice())?;
        Some(DVector::from_vec(gradient).component_div(&self.roots))
    }

    fn matrix(&mut self, shape: &DVector<f64>) -> Option<DMatrix<f64>> {
        let step = STEP * self.roots[0];
        let mut out = DMatrix::zeros(shape.len(), shape.len());
        for i in 0..shape.len() {
            let mut at = |side: f64| {
                let mut moved = shape.clone();
                moved[i] += side * step;
                self.gradient(&moved)
            };
            let slope = (at(1.0)? - at(-1.0)?) / (2.0 * step);
            out.set_column(i, &slope);
        }
        Some(out)
    }
}
