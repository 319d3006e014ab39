//! Bending stop in the strong form: beside a core with touching windings, these carry a part of the moment.
//!
//! Contact acts between the two ends of a core, on which it exerts the couples `-c` and `c` (derivatives of its energy with
//! respect to the rotations of both ends). The internal moment of the core alone is smaller by `c` than that before and
//! after it, and `c` depends on the rotation of the core's far end: an implicit equation for each core, solved by
//! Newton's method.

use nalgebra::{Matrix3, SMatrix, Vector3};

use super::line::SpanIndex;
use super::strong_form::{Matrix12, State};
use super::surroundings::{Surroundings, derivative};
use crate::geometry::Pose;
use crate::rod::BendingStop;

/// Limit of the remaining moment, relative to that which bends an element by one radian.
const CONVERGED: f64 = 1e-13;

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

/// A span crossed from its start to its end, beside the moment that its windings carry.
#[derive(Debug, Clone, Copy)]
pub(super) struct Crossed {
    /// The moment that the windings carry, N m.
    moment: Vector3<f64>,
    /// State at the end.
    pub(super) end: State,
    /// Derivative of that state with respect to displacement and wrench at the start.
    pub(super) own: Matrix12,
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

impl Surroundings<'_> {
    /// The moment carried by the windings of an element's core with these poses of its ends; `None` where they are open.
    pub(super) fn winding_moment(&self, element: usize, ends: [&Pose; 2]) -> Option<WindingMoment> {
        let stop = self.terms.stops.of(&self.line.chain.elements[element])?.loads(&ends.map(Pose::axis))?;
        let by_far = derivative(&stop.loads[1]).fixed_view::<3, 3>(3, 3).into_owned();
        Some(WindingMoment { moment: stop.loads[1].moment(), by_ends: [stop.mixed.transpose(), by_far] })
    }

    /// The bending stop of a span; `None` for a disc, too.
    fn stop_of(&self, SpanIndex { element, piece }: SpanIndex) -> Option<&BendingStop> {
        let own = self.line.core(element) == piece;
        self.terms.stops.of(&self.line.chain.elements[element]).filter(|_| own)
    }

    /// The moment carried by the windings of a span that starts in the state `start`; arguments as of [`Self::crossed`].
    pub(super) fn relief(
        &self,
        span: SpanIndex,
        start: &State,
        across: impl Fn(&State) -> Option<(State, Matrix12)>,
    ) -> Option<Vector3<f64>> {
        match self.stop_of(span) {
            None => Some(Vector3::zeros()),
            Some(_) => Some(self.crossed(span, start, across)?.moment),
        }
    }

    /// Crosses a span from the state `start`.
    ///
    /// `across` integrates the span alone, with its derivative. `None` where it does, and where no moment of the windings
    /// is found.
    pub(super) fn crossed(
        &self,
        span: SpanIndex,
        start: &State,
        across: impl Fn(&State) -> Option<(State, Matrix12)>,
    ) -> Option<Crossed> {
        let open = Vector3::zeros();
        let mut moment = self.stop_of(span).map_or(open, |stop| self.first_guess(stop, span, start));
        for _ in 0..STEPS {
            let (end, own) = across(&start.relieved(&moment))?;
            let touching =
                self.stop_of(span).and(self.winding_moment(span.element, [&start.pose, &end.pose]));

            // Open under a relief that is not zero decides nothing: try again without.
            let Some(carried) = touching else {
                if moment == open {
                    return Some(Crossed { moment, end, own });
                }
                moment = open;
                continue;
            };

            let turned = own.fixed_rows::<3>(3);
            let [by_near, by_far] = carried.by_ends;
            let rate = Matrix3::identity() + by_far * turned.fixed_columns::<3>(9);
            let inverse = rate.try_inverse()?;
            let excess = moment - carried.moment;

            if excess.norm() <= CONVERGED * self.line.moment {
                // By the implicit function theorem, at the moment that solves the equation.
                let mut by_state = by_far * turned;
                let mut by_near_end = by_state.fixed_columns_mut::<3>(3);
                by_near_end += by_near;
                let own = beside(&(inverse * by_state), &own);
                return Some(Crossed { moment, end: end.relieved(&-moment), own });
            }

            moment -= inverse * excess;
        }
        None
    }

    /// The moment carried by the windings if the moment at the core's start acted all along it.
    fn first_guess(&self, stop: &BendingStop, span: SpanIndex, start: &State) -> Vector3<f64> {
        let span = &self.line.spans[span.element][span.piece];
        let axis = start.pose.axis();
        let across = start.moment() - axis * axis.dot(&start.moment());
        let flexibility = span.length / span.stiffness.bending;
        let bend = across.norm() * flexibility;
        // Where the windings are fully closed, their moment is linear in the angle.
        let closed = stop.energy(bend).filter(|_| bend > 0.0);
        closed.map_or_else(Vector3::zeros, |[_, first, second]| {
            across * (first / (1.0 + second * flexibility) / across.norm())
        })
    }
}

/// Derivative of the state after a core, given that of the core alone and that of the moment which its windings carry.
fn beside(moment: &SMatrix<f64, 3, 12>, own: &Matrix12) -> Matrix12 {
    let mut relieved = Matrix12::identity();
    let mut rows = relieved.fixed_rows_mut::<3>(9);
    rows -= moment;
    let mut out = own * relieved;
    let mut rows = out.fixed_rows_mut::<3>(9);
    rows += moment;
    out
}
