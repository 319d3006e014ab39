//! Terms of the potential, each in its own file: energies, loads, and derivatives with respect to the inputs.
//!
//! A [`Term`] acts on single frames: its load depends on the pose of that frame alone. The interactions of rings with one
//! another and with spans ([`RingPairs`], [`RingsOnSpans`]) depend on two poses, as does the bending stop of a core
//! ([`BendingStops`]), which loads the frames at its ends.

mod applied;
mod background;
mod bending_stops;
mod frame;
mod load_derivatives;
mod magnet;
mod magnets;
mod pair;
mod ring_pairs;
mod rings_on_spans;
mod weight;

use nalgebra::{Matrix3, Vector3};

use super::chain::Chain;
use super::inputs::Inputs;
use super::layout::{Counts, Input};
use super::pair_quadrature::PairQuadrature;
use super::settings::Settings;
use crate::geometry::Pose;
use crate::magnetics::{Sources, Wrench};
use crate::rod::{Load, Order};
use magnet::Magnet;

pub(crate) use applied::Applied;
pub(crate) use background::Background;
pub(crate) use bending_stops::BendingStops;
pub(crate) use frame::{Frame, NearStation};
pub(crate) use load_derivatives::{FieldRate, LoadDerivatives};
pub(crate) use magnets::Magnets;
pub(crate) use pair::blocks;
pub(crate) use ring_pairs::{RingPairs, overlap};
pub(crate) use rings_on_spans::{Mixed, RingsOnSpans};
pub(crate) use weight::Weight;

/// A term that acts on single frames.
pub(crate) trait Term {
    /// Whether the term is non-zero at these inputs on what `frame` carries.
    fn acts_on(&self, frame: &Frame<'_>) -> bool;

    /// Whether its loads are conservative: derivatives of an energy.
    fn has_potential(&self) -> bool {
        true
    }

    /// Whether nothing of the term changes when all it acts on turns about the axis of this frame.
    fn is_symmetric_about(&self, axis: &Pose) -> bool;

    /// Energy of the body in `frame` at `pose`, with its derivatives in `axes` (columns, in world axes); `None` where it
    /// is not defined, as inside a magnet.
    fn load(&self, frame: &Frame<'_>, pose: &Pose, axes: &Matrix3<f64>, order: Order) -> Option<Load>;

    /// Adds the derivatives of that load, in world axes, with respect to the term's own inputs; `None` where they are not
    /// defined.
    fn add_input_derivatives(&self, frame: &Frame<'_>, pose: &Pose, out: &mut LoadDerivatives) -> Option<()>;
}

/// Number of terms that act on single frames beside the sources: background field, weight, applied loads.
const OTHERS: usize = 3;

/// Number of terms that act on single frames, at most.
const LOCAL: usize = Sources::MOST + OTHERS;

/// All terms that act on the chain.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Terms<'a> {
    pub(crate) magnets: Magnets<'a>,
    pub(crate) background: Background,
    pub(crate) weight: Weight,
    pub(crate) applied: Applied<'a>,
    pub(crate) pairs: RingPairs<'a>,
    pub(crate) spans: RingsOnSpans<'a>,
    pub(crate) stops: BendingStops,
}

impl<'a> Terms<'a> {
    /// The terms at `inputs`, with the quadrature rules chosen last.
    pub(crate) fn new(
        chain: &'a Chain,
        settings: &Settings,
        sources: &'a Sources,
        inputs: &'a Inputs,
        rules: &'a PairQuadrature,
    ) -> Self {
        Self {
            magnets: Magnets::new(sources, inputs, rules),
            background: Background::new(inputs),
            weight: Weight::new(inputs),
            applied: Applied::new(inputs),
            pairs: RingPairs::new(chain, settings.interaction, rules),
            spans: RingsOnSpans::new(chain, settings.interaction, rules),
            stops: BendingStops::new(settings),
        }
    }

    /// The terms that act on single frames, each with its number among the wrenches.
    fn local(&self) -> impl Iterator<Item = (usize, &dyn Term)> {
        let others: [&dyn Term; OTHERS] = [&self.background, &self.weight, &self.applied];
        let sources = self.magnets.each().map(|source| (source.number(), source as &dyn Term));
        sources.chain((BACKGROUND..).zip(others))
    }

    /// Whether all forces are conservative. False for one-sided interaction or a fixed tip moment.
    pub(crate) fn have_potential(&self) -> bool {
        !self.pairs.one_sided() && self.local().all(|(_, term)| term.has_potential())
    }

    /// Whether nothing changes when an axisymmetric chain turns about the axis of this frame. The terms between bodies of the chain do
    /// not distinguish one direction from another.
    pub(crate) fn are_symmetric_about(&self, axis: &Pose) -> bool {
        self.local().all(|(_, term)| term.is_symmetric_about(axis))
    }

    /// Total load on one frame, in `axes`; adds each term's wrench about `origin` to `wrenches`.
    pub(crate) fn load(
        &self,
        frame: &Frame<'_>,
        pose: &Pose,
        axes: &Matrix3<f64>,
        order: Order,
        (origin, wrenches): (&Vector3<f64>, &mut TermWrenches),
    ) -> Option<Load> {
        let arm = pose.position - origin;
        let mut sum: Option<Load> = None;
        for (number, term) in self.local() {
            if !term.acts_on(frame) {
                continue;
            }
            let load = term.load(frame, pose, axes, order)?;
            let (force, moment) = (axes * load.force, axes * load.moment());
            let wrench = &mut wrenches.0[number];
            wrench.force -= force;
            wrench.torque -= moment + arm.cross(&force);
            match &mut sum {
                Some(sum) => *sum += load,
                None => sum = Some(load),
            }
        }
        Some(sum.unwrap_or_else(Load::zero))
    }

    /// Derivatives of the total load on one frame with respect to all inputs, world axes.
    pub(crate) fn input_derivatives(
        &self,
        frame: &Frame<'_>,
        pose: &Pose,
        counts: &Counts,
    ) -> Option<LoadDerivatives> {
        let mut out = LoadDerivatives::none(counts);
        for (_, term) in self.local() {
            term.add_input_derivatives(frame, pose, &mut out)?;
        }
        Some(out)
    }

    /// External field (T) at a point in the world frame; `None` inside a magnet.
    pub(crate) fn field_at(&self, point: &Vector3<f64>) -> Option<Vector3<f64>> {
        Some(self.background.at(point) + self.magnets.at(point)?)
    }

    /// Derivatives of that field with respect to its inputs, each group with its first column of the Jacobian.
    pub(crate) fn field_rates(
        &self,
        point: &Vector3<f64>,
        counts: &Counts,
    ) -> Option<Vec<(usize, Vec<FieldRate>)>> {
        let of_source = |source: &Magnet<'_>| {
            Some((counts.of_source(source.number()).start, source.rates(point)?.to_vec()))
        };
        let background = (Input::UniformField.columns().start, Background::rates(point).to_vec());
        self.magnets.each().map(of_source).chain([Some(background)]).collect()
    }
}

/// Number of the background field among the wrenches; weight and applied loads follow, and the sources precede it.
const BACKGROUND: usize = Sources::MOST;

/// Wrench of each single-frame term on the whole chain, about the base position.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct TermWrenches([Wrench; LOCAL]);

impl TermWrenches {
    /// Zero wrenches, for no load.
    pub(crate) fn none() -> Self {
        Self([Wrench::NONE; LOCAL])
    }

    /// Adds other wrenches multiplied by `share`.
    pub(crate) fn add(&mut self, others: &Self, share: f64) {
        for (own, other) in self.0.iter_mut().zip(&others.0) {
            own.force += other.force * share;
            own.torque += other.torque * share;
        }
    }

    /// Total wrench of all external fields.
    pub(crate) fn magnetic(&self) -> Wrench {
        let mut sum = self.0[0];
        for other in &self.0[1..=BACKGROUND] {
            sum.force += other.force;
            sum.torque += other.torque;
        }
        sum
    }

    /// Wrench on the source of this number about its centre.
    pub(crate) fn on_source(&self, number: usize, inputs: &Inputs) -> Wrench {
        let placed = inputs.sources.get(number).filter(|_| self.0[number] != Wrench::NONE);
        let Some(placed) = placed else { return Wrench::NONE }; // avoids negative zeros
        let magnet = &self.0[number];
        let arm = placed.pose.position - inputs.base.position;
        Wrench { force: -magnet.force, torque: arm.cross(&magnet.force) - magnet.torque }
    }
}
