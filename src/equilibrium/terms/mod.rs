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
mod pair;
mod ring_pairs;
mod rings_on_spans;
mod walls;
mod weight;

use nalgebra::{Matrix3, Vector3};

use super::chain::Chain;
use super::inputs::Inputs;
use super::pair_quadrature::PairQuadrature;
use super::settings::Settings;
use crate::geometry::Pose;
use crate::magnetics::{Assembly, Wrench};
use crate::rod::{Load, Order};
use crate::vessel::Vessel;

pub(crate) use applied::Applied;
pub(crate) use background::Background;
pub(crate) use bending_stops::BendingStops;
pub(crate) use frame::Frame;
pub(crate) use load_derivatives::{FIELD_INPUTS, FieldRate, LoadDerivatives};
pub(crate) use magnet::Magnet;
pub(crate) use pair::blocks;
pub(crate) use ring_pairs::{RingPairs, overlap};
pub(crate) use rings_on_spans::{Mixed, RingsOnSpans};
pub(crate) use walls::{Touch, Walls};
pub(crate) use weight::Weight;

/// A term that acts on single frames.
pub(crate) trait Term {
    /// Whether the term is non-zero at these inputs on what `frame` carries.
    fn acts_on(&self, frame: &Frame<'_>) -> bool;

    /// Whether its loads are conservative: derivatives of an energy.
    fn has_potential(&self) -> bool {
        true
    }

    /// Energy of the body in `frame` at `pose`, with its derivatives in `axes` (columns, in world axes); `None` where it
    /// is not defined, as inside a magnet.
    fn load(&self, frame: &Frame<'_>, pose: &Pose, axes: &Matrix3<f64>, order: Order) -> Option<Load>;

    /// Adds the derivatives of that load, in world axes, with respect to the term's own inputs; `None` where they are not
    /// defined.
    fn add_input_derivatives(&self, frame: &Frame<'_>, pose: &Pose, out: &mut LoadDerivatives) -> Option<()>;
}

/// Number of terms that act on single frames.
const LOCAL: usize = 4;

/// All terms that act on the chain.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Terms<'a> {
    pub(crate) magnet: Magnet<'a>,
    pub(crate) background: Background,
    pub(crate) weight: Weight,
    pub(crate) applied: Applied<'a>,
    pub(crate) pairs: RingPairs<'a>,
    pub(crate) spans: RingsOnSpans<'a>,
    pub(crate) stops: BendingStops,
    pub(crate) walls: Walls<'a>,
}

impl<'a> Terms<'a> {
    /// The terms at `inputs`, with the quadrature rules chosen last.
    pub(crate) fn new(
        chain: &'a Chain,
        settings: &Settings,
        magnet: Option<&'a Assembly>,
        vessel: Option<&'a Vessel>,
        inputs: &'a Inputs,
        rules: &'a PairQuadrature,
    ) -> Self {
        Self {
            magnet: Magnet::new(magnet, inputs, rules),
            background: Background::new(inputs),
            weight: Weight::new(inputs),
            applied: Applied::new(inputs),
            pairs: RingPairs::new(chain, settings.interaction, rules),
            spans: RingsOnSpans::new(chain, settings.interaction, rules),
            stops: BendingStops::new(settings),
            walls: Walls::new(vessel, inputs),
        }
    }

    /// The terms that act on single frames.
    fn local(&self) -> [&dyn Term; LOCAL] {
        [&self.magnet, &self.background, &self.weight, &self.applied]
    }

    /// Whether all forces are conservative. False for one-sided interaction or a fixed tip moment.
    pub(crate) fn have_potential(&self) -> bool {
        !self.pairs.one_sided() && self.local().iter().all(|term| term.has_potential())
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
        for (term, wrench) in self.local().into_iter().zip(&mut wrenches.0) {
            if !term.acts_on(frame) {
                continue;
            }
            let load = term.load(frame, pose, axes, order)?;
            let (force, moment) = (axes * load.force, axes * load.moment());
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
        inputs: usize,
    ) -> Option<LoadDerivatives> {
        let mut out = LoadDerivatives::none(inputs);
        for term in self.local() {
            term.add_input_derivatives(frame, pose, &mut out)?;
        }
        Some(out)
    }

    /// External field (T) at a point in the world frame; `None` inside a magnet.
    pub(crate) fn field_at(&self, point: &Vector3<f64>) -> Option<Vector3<f64>> {
        Some(self.background.at(point) + self.magnet.at(point)?)
    }

    /// Derivatives of that field with respect to its inputs, in the order of the Jacobian's columns.
    pub(crate) fn field_rates(&self, point: &Vector3<f64>) -> Option<[FieldRate; FIELD_INPUTS]> {
        let (magnet, background) = (self.magnet.rates(point)?, Background::rates(point));
        let split = magnet.len();
        Some(core::array::from_fn(|i| if i < split { magnet[i] } else { background[i - split] }))
    }
}

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
        let [magnet, background, ..] = &self.0;
        Wrench { force: magnet.force + background.force, torque: magnet.torque + background.torque }
    }

    /// Wrench on the external magnet about its centre.
    pub(crate) fn on_magnet(&self, inputs: &Inputs) -> Wrench {
        let [magnet, ..] = &self.0;
        if *magnet == Wrench::NONE {
            return Wrench::NONE; // avoids negative zeros
        }
        let arm = inputs.magnet.position - inputs.base.position;
        Wrench { force: -magnet.force, torque: arm.cross(&magnet.force) - magnet.torque }
    }
}
