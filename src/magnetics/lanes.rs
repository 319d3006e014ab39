//! Short vectors with element-wise arithmetic: one number for each edge of a magnet, or for each of several points.

#![expect(
    clippy::inline_always,
    reason = "the batch of points compiles these operations for several processors"
)]

use core::array::from_fn;
use core::ops::{Add, Div, Mul, Sub};

/// `N` numbers side by side; the compiler turns each operation into packed instructions.
#[derive(Debug, Clone, Copy)]
pub(super) struct Lanes<const N: usize>(pub(super) [f64; N]);

impl<const N: usize> Lanes<N> {
    #[inline(always)]
    pub(super) fn all(value: f64) -> Self {
        Self([value; N])
    }

    #[inline(always)]
    pub(super) fn map(self, function: impl Fn(f64) -> f64) -> Self {
        Self(from_fn(|i| function(self.0[i])))
    }

    #[inline(always)]
    pub(super) fn sqrt(self) -> Self {
        self.map(f64::sqrt)
    }

    #[inline(always)]
    pub(super) fn squared(self) -> Self {
        self * self
    }

    /// `sum_i self_i weights_i`.
    #[inline(always)]
    pub(super) fn weighted_sum(self, weights: &[f64; N]) -> f64 {
        self.0.iter().zip(weights).map(|(value, weight)| value * weight).sum()
    }

    /// The lanes of `yes` where `test` is true for their number, elsewhere those of `no`.
    #[inline(always)]
    pub(super) fn select(test: impl Fn(usize) -> bool, yes: Self, no: Self) -> Self {
        Self(from_fn(|i| if test(i) { yes.0[i] } else { no.0[i] }))
    }

    #[inline(always)]
    pub(super) fn max(self, other: Self) -> Self {
        Self::select(|i| self.0[i] > other.0[i], self, other)
    }

    #[inline(always)]
    pub(super) fn min(self, other: Self) -> Self {
        Self::select(|i| self.0[i] < other.0[i], self, other)
    }
}

macro_rules! lanewise {
    ($trait:ident, $method:ident, $operator:tt) => {
        impl<const N: usize> $trait for Lanes<N> {
            type Output = Self;
            #[inline(always)]
            fn $method(self, other: Self) -> Self {
                Self(from_fn(|i| self.0[i] $operator other.0[i]))
            }
        }
        impl<const N: usize> $trait<f64> for Lanes<N> {
            type Output = Self;
            #[inline(always)]
            fn $method(self, other: f64) -> Self {
                Self(from_fn(|i| self.0[i] $operator other))
            }
        }
        impl<const N: usize> $trait<Lanes<N>> for f64 {
            type Output = Lanes<N>;
            #[inline(always)]
            fn $method(self, other: Lanes<N>) -> Lanes<N> {
                Lanes(from_fn(|i| self $operator other.0[i]))
            }
        }
    };
}

lanewise!(Add, add, +);
lanewise!(Sub, sub, -);
lanewise!(Mul, mul, *);
lanewise!(Div, div, /);
