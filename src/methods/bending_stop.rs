//! Bending stop in the strong form: beside a core with touching windings, these carry a part of the moment.
//!
//! Contact acts between the two ends of a core, on which it exerts the couples `-c` and `c` (derivatives of its energy with
//! respect to the rotations of both ends). The internal moment of the core alone is smaller by `c` than that before and
//! after it, and `c` depends on the rotation of the core's far end: an implicit equation for each core, solved by
//! Newton's method.

use nalgebra::{Matrix3, SMatrix, Vector3};

use super::strong_form::{Matrix12, State};
use super::surroundings::{Surroundings, derivative};
use crate::geometry::Pose;

/// Limit of the remaining moment, relative to that which bends an element by one radian.
const SETTLED: f64 = 1e-13;

/// Largest number of Newton steps. The residual is concave in the moment, so that they converge from any start.
const STEPS: u32 = 60;

/// Moment that the touching windings of a core carry, in fixed axes.
#[derive(Debug, Clone, Copy)]
pub(super) struct WindingMoment {
    /// The moment `c`, N m.
    pub(super) moment: Vector3<f64>,
    /// Its derivatives with respect to rotations of the near and the far end, N m/rad.
    pub(super) by_ends: [Matrix3<f64>; 2],
}

/// The moment that a core's windings carry, as a function of the state at its start.
#[derive(Debug, Clone, Copy)]
pub(super) struct Relief {
    pub(super) moment: Vector3<f64>,
    /// Derivative with respect to displacement and wrench.
    by_state: SMatrix<f64, 3, 12>,
}

impl State {
    /// The state with `moment` (N m) taken off its internal moment.
    pub(super) fn relieved(&self, moment: &Vector3<f64>) -> Self {
        let mut out = *self;
        let mut own = out.wrench.fixed_rows_mut::<3>(3);
        own -= moment;
        out
    }
}

impl Relief {
    /// That of open windings.
    fn none() -> Self {
        Self { moment: Vector3::zeros(), by_state: SMatrix::zeros() }
    }

    /// Derivative of the state after the core, given that of the core alone.
    pub(super) fn with(&self, own: &Matrix12) -> Matrix12 {
        let mut relieved = Matrix12::identity();
        let mut rows = relieved.fixed_rows_mut::<3>(9);
        rows -= self.by_state;
        let mut out = own * relieved;
        let mut rows = out.fixed_rows_mut::<3>(9);
        rows += self.by_state;
        out
    }
}

impl Surroundings<'_> {
    /// The moment carried by the windings of an element's core with these poses of its ends; `None` where they are open.
    pub(super) fn winding_moment(&self, element: usize, ends: [&Pose; 2]) -> Option<WindingMoment> {
        let stop = self.terms.stops.loads(&self.line.chain.elements[element], &ends.map(Pose::axis))?;
        let by_far = derivative(&stop.loads[1]).fixed_view::<3, 3>(3, 3).into_owned();
        Some(WindingMoment { moment: stop.loads[1].moment(), by_ends: [stop.mixed.transpose(), by_far] })
    }

    /// The moment carried by the windings of a span that starts in the state `start`.
    ///
    /// `across` integrates the span alone, with its derivative. `None` where it does, and where no moment is found.
    pub(super) fn relief(
        &self,
        (element, piece): (usize, usize),
        start: &State,
        across: impl Fn(&State) -> Option<(State, Matrix12)>,
    ) -> Option<Relief> {
        let stops = self.terms.stops.act() && self.line.chain.elements[element].stop.is_some();
        if !stops || self.line.core(element) != piece {
            return Some(Relief::none());
        }
        let mut moment = self.first_guess(element, piece, start);
        for _ in 0..STEPS {
            let (end, own) = across(&start.relieved(&moment))?;
            let turned = own.fixed_rows::<3>(3);
            let Some(carried) = self.winding_moment(element, [&start.pose, &end.pose]) else {
                if moment == Vector3::zeros() {
                    return Some(Relief::none());
                }
                moment = Vector3::zeros();
                continue;
            };
            let [by_near, by_far] = carried.by_ends;
            let rate = Matrix3::identity() + by_far * turned.fixed_columns::<3>(9);
            let inverse = rate.try_inverse()?;
            let excess = moment - carried.moment;
            if excess.norm() <= SETTLED * self.line.moment {
                let mut by_state = by_far * turned;
                let mut by_near_end = by_state.fixed_columns_mut::<3>(3);
                by_near_end += by_near;
                return Some(Relief { moment, by_state: inverse * by_state });
            }
            moment -= inverse * excess;
        }
        None
    }

    /// The moment carried by the windings if the moment at the core's start acted all along it.
    fn first_guess(&self, element: usize, piece: usize, start: &State) -> Vector3<f64> {
        let span = &self.line.spans[element][piece];
        let axis = start.pose.axis();
        let across = start.moment() - axis * axis.dot(&start.moment());
        let flexibility = span.length / span.stiffness.bending;
        let bend = across.norm() * flexibility;
        let stop = self.line.chain.elements[element].stop.as_ref();
        // Where the windings are fully closed, their moment is linear in the angle.
        let closed = stop.and_then(|stop| stop.energy(bend)).filter(|_| bend > 0.0);
        closed.map_or_else(Vector3::zeros, |[_, first, second]| {
            across * (first / (1.0 + second * flexibility) / across.norm())
        })
    }
}
