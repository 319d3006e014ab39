//! Derivatives by finite differences, and what must agree with them.

use core::fmt::{Debug, Display};
use core::ops::{Div, Mul, Sub};

use mcm::equilibrium::{Equilibrium, Inputs};
use nalgebra::DVector;

/// The derivative of `at` at 0 by central differences of fourth order over this step, whose error is `h^4/30` times the fifth
/// derivative: `[8 (f(h) - f(-h)) - (f(2h) - f(-2h))] / 12h`.
pub(crate) fn derivative<T>(step: f64, at: impl FnMut(f64) -> T) -> T
where
    T: Sub<Output = T> + Mul<f64, Output = T> + Div<f64, Output = T>,
{
    let [far, near, next, last] = [-2.0, -1.0, 1.0, 2.0].map(|steps| steps * step).map(at);
    ((next - near) * 8.0 - (last - far)) / (12.0 * step)
}

/// A direction through a shape of a model, along which its gradient and its Hessian are compared with differences.
pub(crate) struct Direction {
    /// The unknowns of the shape, which need not be in equilibrium.
    pub(crate) shape: Vec<f64>,
    /// What is added to them; in the elastic norm, steps are relative to its size.
    pub(crate) along: Vec<f64>,
    /// Steps along it of the differences of energies, and of gradients.
    pub(crate) steps: [f64; 2],
    /// Multiple of the elastic stiffness that makes the Hessian definite where the shape is not in equilibrium.
    pub(crate) shift: f64,
    /// Largest errors of the gradient and of the Hessian, relative.
    pub(crate) allowed: [f64; 2],
}

impl Direction {
    /// The unknowns so far along it.
    pub(crate) fn at(&self, distance: f64) -> Vec<f64> {
        self.shape.iter().zip(&self.along).map(|(x, d)| x + distance * d).collect()
    }

    /// The component along it of a gradient.
    pub(crate) fn of(&self, gradient: &[f64]) -> f64 {
        gradient.iter().zip(&self.along).map(|(g, d)| g * d).sum()
    }

    /// Error of the slope of the energy along it that the gradient of a model gives, relative to that by differences.
    fn slope_error(&self, model: &mut Equilibrium, inputs: &Inputs) -> f64 {
        let mut at = |distance: f64| model.gradient(inputs, &self.at(distance)).expect("apart");
        let expected = derivative(self.steps[0], |distance| at(distance).0);
        (self.of(&at(0.0).1) / expected - 1.0).abs()
    }

    /// Error of the Hessian of a model along it in the elastic norm: its factorisation, applied to `(H + shift K) d` by differences of
    /// gradients, must give the direction `d` back.
    pub(crate) fn hessian_error(&self, model: &mut Equilibrium, inputs: &Inputs) -> f64 {
        let at =
            |distance: f64| DVector::from_vec(model.gradient(inputs, &self.at(distance)).expect("apart").1);
        let image = derivative(self.steps[1], at);

        let stiffness = DVector::from_row_slice(model.metric());
        let along = DVector::from_row_slice(&self.along);
        let shifted = image + stiffness.component_mul(&along) * self.shift;
        let back = model.solve_at(inputs, &self.shape, self.shift, shifted.as_slice());
        let back = DVector::from_vec(back.expect("positive definite"));

        let norm = |x: &DVector<f64>| x.component_mul(x).dot(&stiffness).sqrt();
        norm(&(back - &along)) / norm(&along)
    }
}

/// Stops unless the gradient and the Hessian of a model are those of its energy along a direction.
#[track_caller]
pub(crate) fn assert_derivatives(
    name: impl Display,
    model: &mut Equilibrium,
    inputs: &Inputs,
    direction: &Direction,
) {
    let errors = [direction.slope_error(model, inputs), direction.hessian_error(model, inputs)];
    println!("{name}: gradient {:.1e}, Hessian {:.1e}", errors[0], errors[1]);
    for ((what, error), allowed) in ["gradient", "Hessian"].iter().zip(errors).zip(direction.allowed) {
        assert!(error <= allowed, "{name}: the {what} is off by {error:e}, more than {allowed:e}");
    }
}

/// A derivative beside differences.
pub(crate) struct Compared<K> {
    /// What the errors of all derivatives of this kind are relative to: the largest effect among them.
    pub(crate) kind: K,
    /// Of what by what.
    pub(crate) name: String,
    /// How far it is from the differences, times the usual size of what it is by.
    pub(crate) error: f64,
    /// The differences, times that size.
    pub(crate) effect: f64,
}

/// The largest error of a derivative in parts of what is allowed, which is relative to the largest effect of its kind; and of which.
///
/// An error of a kind without any effect is infinite.
pub(crate) fn worst<K: Copy + PartialEq + Debug>(
    compared: &[Compared<K>],
    allowed: impl Fn(K) -> f64,
) -> (f64, String) {
    let mut scales: Vec<(K, f64)> = Vec::new();
    for one in compared {
        match scales.iter_mut().find(|scale| scale.0 == one.kind) {
            Some(scale) => scale.1 = scale.1.max(one.effect),
            None => scales.push((one.kind, one.effect)),
        }
    }

    let mut worst = (0.0, String::new());
    for one in compared {
        let scale = scales.iter().find(|scale| scale.0 == one.kind).expect("of its own").1;
        let part = if one.error <= 0.0 { 0.0 } else { one.error / (scale * allowed(one.kind)) };
        if part > worst.0 || part.is_nan() {
            worst = (part, one.name.clone());
        }
    }
    worst
}

#[test]
fn differences_are_of_fourth_order_and_errors_are_seen() {
    let cubic = |x: f64| 1.0 + 2.0 * x - 3.0 * x * x + 4.0 * x.powi(4);
    assert!((derivative(0.1, cubic) - 2.0).abs() < 1e-13);
    let error = |step: f64| derivative(step, f64::exp) - 1.0;
    assert!((error(0.1) / (-0.1_f64.powi(4) / 30.0) - 1.0).abs() < 1e-2, "{}", error(0.1));

    let one = |kind: u8, error: f64, effect: f64| {
        let name = format!("{kind} {error}");
        Compared { kind, name, error, effect }
    };
    let (part, name) = worst(&[one(1, 1e-3, 1.0), one(1, 2e-3, 4.0), one(2, 1e-3, 0.1)], |_| 1e-2);
    assert!((part - 1.0).abs() < 1e-12 && name == "2 0.001", "{part} {name}");
    assert!(worst(&[one(1, 1e-3, 0.0)], |_| 1.0).0.is_infinite());
    assert!(worst(&[one(1, f64::NAN, 1.0)], |_| 1.0).0.is_nan());
}
