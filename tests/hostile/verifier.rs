//! An independent verifier of answers: a potential of which it takes the gradient alone, with Newton's method and eigenvalues by full
//! matrices of central differences.

use mcm::equilibrium::{Equilibrium, Inputs};
use nalgebra::{DMatrix, DVector, Schur, SymmetricEigen};

/// Step of the differences of gradients, in radians of the first mode.
const STEP: f64 = 1e-5;

/// Newton steps at most, and the residual (in turns of one element by a radian) at which a shape is in balance.
const STEPS: usize = 30;
const BALANCE: f64 = 1e-8;

/// Longest Newton step, in the same measure: no answer is verified by an equilibrium far away.
const LONGEST_STEP: f64 = 0.2;

/// A matrix made earlier serves while it makes the residual shrink by this factor.
const SHRINKING: f64 = 0.1;

/// Entries below the diagonal that the QR algorithm takes for zero, relative to their neighbours. It may go round in circles with
/// the first, and then not with the next; all are below the differences' noise.
const DEFLATED: [f64; 4] = [1e-13, 1e-12, 1e-11, 1e-10];

/// Turns of the QR algorithm at most, by row.
const TURNS: usize = 100;

/// A model at given inputs, in amplitudes weighted by the root of the metric, of which the first is a turn of an element.
pub(crate) struct Verifier<'a> {
    model: &'a mut Equilibrium,
    inputs: &'a Inputs,
    roots: DVector<f64>,
    symmetric: bool,
}

impl<'a> Verifier<'a> {
    /// Whether the matrix is to be taken as symmetric, as forces with a potential have it.
    pub(crate) fn new(model: &'a mut Equilibrium, inputs: &'a Inputs, symmetric: bool) -> Self {
        let roots = DVector::from_iterator(model.freedoms(), model.metric().iter().map(|k| k.sqrt()));
        Self { model, inputs, roots, symmetric }
    }

    /// Norm of the gradient at a shape, in turns of one element by a radian.
    pub(crate) fn residual(&mut self, unknowns: &[f64]) -> Option<f64> {
        let shape = self.weighted(unknowns);
        Some(self.gradient(&shape)?.norm() / self.roots[0])
    }

    /// Smallest real part of the eigenvalues of the matrix of differences at a shape, relative to the elastic energy.
    pub(crate) fn smallest_real_part(&mut self, unknowns: &[f64]) -> Option<f64> {
        let shape = self.weighted(unknowns);
        let matrix = self.matrix(&shape)?;
        if self.symmetric {
            return Some(SymmetricEigen::new((&matrix + matrix.transpose()) * 0.5).eigenvalues.min());
        }
        let rows = matrix.nrows();
        let schur = |deflated| Schur::try_new(matrix.clone(), deflated, TURNS * rows);
        let values = DEFLATED.into_iter().find_map(schur)?.complex_eigenvalues();
        values.iter().map(|value| value.re).min_by(f64::total_cmp)
    }

    /// The equilibrium, stable or not, to which Newton's method leads from a shape.
    pub(crate) fn polished(&mut self, start: &[f64]) -> Option<Vec<f64>> {
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
            shape -= &step * f64::min(1.0, LONGEST_STEP * unit / step.norm());
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
