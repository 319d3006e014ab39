//! Equilibria whose tip is held: dead loads cannot hold them.

use mcm::equilibrium::{Equilibrium, Inputs, Solution};
use nalgebra::{DMatrix, DVector, Vector3};

use super::wall_force;

/// Multiple of the elastic stiffness with which every Hessian here is definite.
const SHIFT: f64 = 1e4;

/// Unknowns that change, where the others stay 0 by symmetry; their amplitudes are weighted by the roots of the metric.
pub(super) struct Free {
    which: Vec<usize>,
    roots: Vec<f64>,
}

impl Free {
    /// All unknowns.
    pub(super) fn all(model: &Equilibrium) -> Self {
        let roots = model.metric().iter().map(|k| k.sqrt()).collect();
        Self { which: (0..model.freedoms()).collect(), roots }
    }

    /// Those that move the rod in the plane of x and z.
    pub(super) fn in_plane(model: &mut Equilibrium) -> Self {
        let Self { mut which, roots } = Self::all(model);
        which.retain(|&unknown| {
            let mut unknowns = vec![0.0; roots.len()];
            unknowns[unknown] = 1e-3;
            model.gradient(&Inputs::unloaded(0), &unknowns).expect("apart");
            let moved = model.shape().map(|(s, point)| point - Vector3::z() * s);
            let [within, across] = moved.fold([0.0_f64; 2], |[within, across], by| {
                [within.max(by.x.abs()).max(by.z.abs()), across.max(by.y.abs())]
            });
            within > across
        });
        Self { which, roots }
    }

    fn amplitudes(&self, all: &[f64], weigh: impl Fn(f64, f64) -> f64) -> DVector<f64> {
        let values = self.which.iter().map(|&unknown| weigh(all[unknown], self.roots[unknown]));
        DVector::from_iterator(self.which.len(), values)
    }

    /// The model's present shape.
    pub(super) fn weighted(&self, model: &Equilibrium) -> DVector<f64> {
        self.amplitudes(model.unknowns(), |x, root| x * root)
    }

    fn unknowns(&self, shape: &DVector<f64>) -> Vec<f64> {
        let mut unknowns = vec![0.0; self.roots.len()];
        for (&unknown, weighted) in self.which.iter().zip(shape) {
            unknowns[unknown] = weighted / self.roots[unknown];
        }
        unknowns
    }
}

/// Equilibria whose tip is held in one direction by a force or moment that is found with them.
pub(super) struct Held<'a> {
    model: &'a mut Equilibrium,
    free: &'a Free,
    /// The inputs with this much of the load that holds the tip.
    inputs: &'a dyn Fn(f64) -> Inputs,
    /// What is held at 0.
    place: &'a dyn Fn(&Equilibrium) -> f64,
    /// A load of the size to be expected.
    unit: f64,
}

impl<'a> Held<'a> {
    pub(super) fn new(
        model: &'a mut Equilibrium,
        free: &'a Free,
        inputs: &'a dyn Fn(f64) -> Inputs,
        place: &'a dyn Fn(&Equilibrium) -> f64,
        unit: f64,
    ) -> Self {
        Self { model, free, inputs, place, unit }
    }

    /// The gradient, and what is to be held.
    fn gradient(&mut self, shape: &DVector<f64>, load: f64) -> (DVector<f64>, f64) {
        let unknowns = self.free.unknowns(shape);
        let (_, gradient) = self.model.gradient(&(self.inputs)(load), &unknowns).expect("apart");
        (self.free.amplitudes(&gradient, |by, root| by / root), (self.place)(self.model))
    }

    /// The Hessian, from the inverse of the shifted one, and the gradient of what is held. The model stays at this load.
    fn matrix(&mut self, shape: &DVector<f64>, load: f64) -> (DMatrix<f64>, DVector<f64>) {
        let (count, inputs, unknowns) = (shape.len(), (self.inputs)(load), self.free.unknowns(shape));
        let along = self.gradient(shape, load).0 - self.gradient(shape, load + self.unit).0;
        let mut inverse = DMatrix::zeros(count, count);
        for (i, &unknown) in self.free.which.iter().enumerate() {
            let mut right = vec![0.0; unknowns.len()];
            right[unknown] = self.free.roots[unknown];
            let column = self.model.solve_at(&inputs, &unknowns, SHIFT, &right).expect("definite");
            inverse.set_column(i, &self.free.amplitudes(&column, |x, root| x * root));
        }
        let shifted = ((&inverse + inverse.transpose()) * 0.5).try_inverse().expect("regular");
        (shifted - DMatrix::identity(count, count) * SHIFT, along / self.unit)
    }

    /// Moves shape and load to the equilibrium by Newton's method, until the wall's force stays.
    pub(super) fn solve(&mut self, shape: &mut DVector<f64>, load: &mut f64) {
        let mut force = f64::INFINITY;
        for _ in 0..40 {
            let (gradient, place) = self.gradient(shape, *load);
            let before = std::mem::replace(&mut force, wall_force(self.model));
            if (force - before).abs() <= 1e-7 * force {
                return;
            }
            let (matrix, along) = self.matrix(shape, *load);
            let count = shape.len();
            let scale = matrix.diagonal().amax() / along.norm();
            let mut whole = DMatrix::zeros(count + 1, count + 1);
            whole.view_mut((0, 0), (count, count)).copy_from(&matrix);
            whole.view_mut((0, count), (count, 1)).copy_from(&(-&along * scale));
            whole.view_mut((count, 0), (1, count)).copy_from(&(along.transpose() * scale));
            let right = (-gradient).push(-place * scale);
            let step = whole.lu().solve(&right).expect("regular");
            *shape += step.rows(0, count);
            *load += step[count] * scale;
        }
        panic!("no equilibrium found");
    }

    /// Smallest eigenvalue of the Hessian among the changes that leave the tip where it is held, relative to the elastic energy.
    pub(super) fn smallest(&mut self, shape: &DVector<f64>, load: f64) -> f64 {
        let (matrix, along) = self.matrix(shape, load);
        let along = along.normalize();
        let across = &along * along.transpose();
        let kept = DMatrix::identity(shape.len(), shape.len()) - &across;
        (&kept * matrix * &kept + across * SHIFT).symmetric_eigenvalues().min()
    }
}
