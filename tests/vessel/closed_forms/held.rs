//! Rods whose tip is held, pressed against a wall and on the bottom of a tube.

use core::f64::consts::PI;

use mcm::equilibrium::{Equilibrium, Inputs, Solution};
use mcm::geometry::Pose;
use nalgebra::{DMatrix, DVector, Vector3};

use super::{GAP, LENGTH, MODULUS, RADIUS, STIFF, bending_stiffness, design, model, solve, tube, wall_force};
use crate::tolerance::WALL_CLOSED_FORM;

/// Acceleration of heavy rods, m/s2.
const GRAVITY: f64 = 10.0;

/// Multiple of the elastic stiffness with which every Hessian here is definite.
const SHIFT: f64 = 1e4;

/// Equilibria whose tip is held in one direction by a force or moment that is found with them: dead loads cannot hold them.
struct Held<'a> {
    model: &'a mut Equilibrium,
    /// The inputs with this much of the load that holds the tip.
    inputs: &'a dyn Fn(f64) -> Inputs,
    /// What is held at 0.
    place: &'a dyn Fn(&Equilibrium) -> f64,
    /// A load of the size to be expected.
    unit: f64,
    /// Of the metric: amplitudes are weighted by them.
    roots: DVector<f64>,
}

impl<'a> Held<'a> {
    fn new(
        model: &'a mut Equilibrium,
        inputs: &'a dyn Fn(f64) -> Inputs,
        place: &'a dyn Fn(&Equilibrium) -> f64,
        unit: f64,
    ) -> Self {
        let roots = DVector::from_iterator(model.freedoms(), model.metric().iter().map(|k| k.sqrt()));
        Self { model, inputs, place, unit, roots }
    }

    /// The gradient, and what is to be held.
    fn gradient(&mut self, shape: &DVector<f64>, load: f64) -> (DVector<f64>, f64) {
        let unknowns = shape.component_div(&self.roots);
        let (_, gradient) = self.model.gradient(&(self.inputs)(load), unknowns.as_slice()).expect("apart");
        (DVector::from_vec(gradient).component_div(&self.roots), (self.place)(self.model))
    }

    /// The Hessian, from the inverse of the shifted one, and the gradient of what is held.
    fn matrix(&mut self, shape: &DVector<f64>, load: f64) -> (DMatrix<f64>, DVector<f64>) {
        let (count, inputs) = (shape.len(), (self.inputs)(load));
        let unknowns = shape.component_div(&self.roots);
        let mut inverse = DMatrix::zeros(count, count);
        for i in 0..count {
            let mut right = vec![0.0; count];
            right[i] = self.roots[i];
            let column = self.model.solve_at(&inputs, unknowns.as_slice(), SHIFT, &right).expect("definite");
            inverse.set_column(i, &DVector::from_vec(column).component_mul(&self.roots));
        }
        let shifted = ((&inverse + inverse.transpose()) * 0.5).try_inverse().expect("regular");
        let along = self.gradient(shape, load).0 - self.gradient(shape, load + self.unit).0;
        (shifted - DMatrix::identity(count, count) * SHIFT, along / self.unit)
    }

    /// Moves shape and load to the equilibrium by Newton's method, until the wall's force stays.
    fn solve(&mut self, shape: &mut DVector<f64>, load: &mut f64) {
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
    fn smallest(&mut self, shape: &DVector<f64>, load: f64) -> f64 {
        let (matrix, along) = self.matrix(shape, load);
        let along = along.normalize();
        let across = &along * along.transpose();
        let kept = DMatrix::identity(shape.len(), shape.len()) - &across;
        (&kept * matrix * &kept + across * SHIFT).symmetric_eigenvalues().min()
    }
}

/// A clamped column of length `L` pressed against one wall at a distance `h` touches it in one point from `P L^2/(pi^2 K) = 4` to 16:
/// with 98.257 and 301.095 `K h/L^3` at 6 and 10.
///
/// By symmetry half of it is computed, whose far end keeps its direction.
#[test]
fn pressed_column_touches_in_a_point_as_in_closed_form() {
    let (whole, stiffness) = (2.0 * LENGTH, bending_stiffness());
    let unit = stiffness * PI * PI / (whole * whole);
    let mut model = model(&design(LENGTH, 0.0), 8, &tube(STIFF));
    let start = Vector3::new(1e-2 * unit, 0.0, -4.5 * unit);
    solve(&mut model, &Inputs { tip_force: start, ..Inputs::unloaded(0) });
    let weighted = model.unknowns().iter().zip(model.metric()).map(|(x, k)| x * k.sqrt());
    let mut shape = DVector::from_iterator(model.freedoms(), weighted);
    let mut moment = 0.0;
    let direction = |model: &Equilibrium| model.tip().axis().x;
    for (times, tabulated) in [(6.0, Some(98.257)), (10.0, Some(301.095)), (14.0, None)] {
        let axial = times * unit;
        let inputs = |moment: f64| Inputs {
            tip_force: Vector3::new(0.0, 0.0, -axial),
            tip_moment: Vector3::new(0.0, moment, 0.0),
            ..Inputs::unloaded(0)
        };
        let mut held = Held::new(&mut model, &inputs, &direction, 1e-3 * stiffness / LENGTH);
        held.solve(&mut shape, &mut moment);
        let wave = (axial / stiffness).sqrt();
        let turn = 0.25 * wave * whole;
        let force = axial * GAP * wave / (turn - turn.tan());
        let scaled = force * whole.powi(3) / (stiffness * GAP);
        assert!(tabulated.is_none_or(|known| (scaled - known).abs() < 1e-3), "{scaled} {tabulated:?}");
        // The shortening by the slopes of both quarters of a wave.
        let slope = |x: f64| 0.5 * force / axial * (turn.tan() * x.sin() + x.cos() - 1.0);
        let parts = 1000;
        let squares = (0..parts).map(|i| slope(turn * (f64::from(i) + 0.5) / f64::from(parts)).powi(2));
        let shortening = squares.sum::<f64>() * turn / wave / f64::from(parts);
        let squeezed = axial * LENGTH / (MODULUS * PI * RADIUS * RADIUS);
        let off = 2.0 * wall_force(&model) / force - 1.0;
        let shorter = (LENGTH - model.tip().position.z - squeezed) / shortening - 1.0;
        println!("P = {times} pi^2 K/L^2: force {off:.1e}, shortening {shorter:.1e}");
        assert!(off.abs() < WALL_CLOSED_FORM && shorter.abs() < WALL_CLOSED_FORM, "{off} {shorter}");
    }
}

/// Load (times `sqrt(K w/c)`) at which a rod of weight `w` per length buckles sideways on the bottom of a tube, clamped at one end and
/// held at the other, of a length in units of `(K c/w)^(1/4)`: that of a beam on an elastic foundation `w/c`.
fn sinusoidal_buckling(length: f64) -> f64 {
    let determinant = |load: f64| {
        let root = (load * load - 4.0).sqrt();
        let [a, b] = [1.0, -1.0].map(|sign: f64| (0.5 * (load + sign * root)).sqrt());
        let (even, odd) =
            ((a * length).cos() - (b * length).cos(), (a * length).sin() - a / b * (b * length).sin());
        let bent = |x: f64, y: f64| b * b * y - a * a * x;
        let (even2, odd2) = (
            bent((a * length).cos(), (b * length).cos()),
            bent((a * length).sin(), a / b * (b * length).sin()),
        );
        even * odd2 - odd * even2
    };
    let (mut load, step) = (2.0 + 1e-6, 1e-6);
    while determinant(load) * determinant(load + step) > 0.0 {
        load += step;
    }
    load + 0.5 * step
}

/// A heavy rod on the bottom of a tube buckles sideways at `2 sqrt(K w/c)` if it is long.
#[test]
fn a_heavy_rod_in_a_tube_buckles_sideways_as_in_closed_form() {
    let stiffness = bending_stiffness();
    for (length, long) in [(8.0, 0.1), (12.0, 0.04)] {
        let weight = stiffness * GAP * (length / LENGTH).powi(4);
        let vessel = tube(STIFF);
        let mut model = model(&design(LENGTH, weight / GRAVITY), 8, &vessel);
        let unit = (stiffness * weight / GAP).sqrt();
        // It rests where the wall bears it.
        let [mut bears, mut yields] = [vessel.wall.onset() + weight / STIFF * 2.0, 0.0];
        for _ in 0..60 {
            let depth = 0.5 * (bears + yields);
            *(if vessel.wall.line(depth)[1] > weight { &mut bears } else { &mut yields }) = depth;
        }
        let wanted = sinusoidal_buckling(length);
        let aside = |model: &Equilibrium| model.tip().position.x;
        let bottom = Pose { position: Vector3::new(0.0, -GAP - bears, 0.0), ..Pose::identity() };
        let straight = DVector::zeros(model.freedoms());
        let mut smallest = |load: f64| {
            let inputs = |held: f64| Inputs {
                tip_force: Vector3::new(held, 0.0, -load * unit),
                gravity: Vector3::new(0.0, -GRAVITY, 0.0),
                base: bottom,
                ..Inputs::unloaded(0)
            };
            Held::new(&mut model, &inputs, &aside, unit).smallest(&straight, 0.0)
        };
        let [(below, stable), (above, unstable)] =
            [0.999, 1.001].map(|part| (part * wanted, smallest(part * wanted)));
        assert!(stable > 0.0 && unstable < 0.0, "{stable} {unstable}");
        let found = below + (above - below) * stable / (stable - unstable);
        println!("length {length}: {found} of sqrt(K w/c), {wanted}: {:.1e}", found / wanted - 1.0);
        assert!((found / wanted - 1.0).abs() < WALL_CLOSED_FORM, "{found} {wanted}");
        assert!(wanted < 2.0 * (1.0 + long), "{wanted}");
    }
}
