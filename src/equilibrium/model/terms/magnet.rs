//! A magnet or coil: the loads of its field on rings and magnetised material.

use nalgebra::{Matrix3, Vector3};

use super::super::chain::Chain;
use super::super::inputs::{Inputs, PlacedSource};
use super::super::layout::OF_SOURCE;
use super::super::pair_quadrature::PairQuadrature;
use super::super::source_field::{SourceField, StationFields};
use super::load_derivatives::{FieldRate, LoadDerivatives};
use super::{Frame, Term};
use crate::geometry::{Pose, hat};
use crate::magnetics::Source;
use crate::rod::{Load, Order, Station};

/// A magnet or coil at its pose.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Magnet<'a> {
    /// Its number in the list of sources.
    number: usize,
    /// What makes the field, also where it is switched off.
    kind: &'a Source,
    placed: PlacedSource,
    /// Its field source, where it is switched on.
    source: Option<SourceField<'a>>,
    base: &'a Pose,
    rules: &'a PairQuadrature,
}

impl<'a> Magnet<'a> {
    /// The source of this number; `None` where the inputs do not say where it is.
    pub(crate) fn new(
        (number, kind): (usize, &'a Source),
        inputs: &'a Inputs,
        rules: &'a PairQuadrature,
    ) -> Option<Self> {
        let placed = *inputs.sources.get(number)?;
        let source = (placed.strength != 0.0).then(|| SourceField::new(kind, placed.pose, placed.strength));
        Some(Self { number, kind, placed, source, base: &inputs.base, rules })
    }

    /// The magnet for a chain whose sections are sampled as coarsely as this relative accuracy of the energies
    /// allows.
    pub(crate) fn seen_by(self, chain: &Chain, accuracy: f64) -> Self {
        let seen = |source: SourceField<'a>| source.seen_by(chain, self.base, accuracy);
        Self { source: self.source.map(seen), ..self }
    }

    /// Its number among the sources.
    pub(crate) fn number(&self) -> usize {
        self.number
    }

    /// Whether it is switched on.
    pub(crate) fn is_on(&self) -> bool {
        self.source.is_some()
    }

    /// Evaluates its field at the material of `stations` at their poses; `None` inside it.
    pub(crate) fn fields_at<'s>(
        &self,
        stations: impl Iterator<Item = (&'s Station, Pose)>,
        order: Order,
        out: &mut StationFields,
    ) -> Option<()> {
        self.source.as_ref().map_or(Some(()), |source| source.fields_at(stations, order, out))
    }

    /// Its field (T) at a point in the world frame; `None` inside it.
    pub(crate) fn at(&self, point: &Vector3<f64>) -> Option<Vector3<f64>> {
        self.source.as_ref().map_or(Some(Vector3::zeros()), |source| source.at(point))
    }

    /// Derivatives of its field with respect to its own inputs at a point in the world frame; `None` inside it and on its
    /// edges, even if it is switched off.
    ///
    /// The field of a body that moves with velocity `v(x) = t + w x (x - c)` changes at a fixed point by `w x B - G v`,
    /// and its gradient by `hat(w) G - G hat(w) - H v`.
    pub(crate) fn rates(&self, point: &Vector3<f64>) -> Option<[FieldRate; OF_SOURCE]> {
        let turn = &self.placed.pose.rotation;
        let arm = point - self.placed.pose.position;
        let local = turn.tr_mul(&arm);
        if self.kind.contains(&local) {
            return None;
        }
        let own = self.kind.jet(&local).ok()?.rotated(turn);
        let jet = own * self.placed.strength;
        Some(core::array::from_fn(|column| {
            let unit = Vector3::ith(column % 3, 1.0);
            match column {
                0..3 => (-jet.gradient * unit, -jet.hessian_along(&unit)),
                3..6 => {
                    let (spin, velocity) = (hat(&unit), unit.cross(&arm));
                    let gradient = spin * jet.gradient - jet.gradient * spin - jet.hessian_along(&velocity);
                    (spin * jet.field - jet.gradient * velocity, gradient)
                }
                _ => (own.field, own.gradient),
            }
        }))
    }

    /// Distance (m) of a point in the world frame from the source, switched on or off.
    fn distance(&self, point: &Vector3<f64>) -> f64 {
        let Pose { position, rotation } = &self.placed.pose;
        self.kind.distance(&rotation.tr_mul(&(point - position)))
    }
}

impl Term for Magnet<'_> {
    fn acts_on(&self, frame: &Frame<'_>) -> bool {
        self.is_on() && !matches!(frame, Frame::Tip(_))
    }

    fn is_symmetric_about(&self, axis: &Pose) -> bool {
        let PlacedSource { pose, strength } = self.placed;
        let coaxial = axis.is_along_axis(&pose.axis()) && axis.is_on_axis(&pose.position);
        strength == 0.0 || (self.kind.is_axisymmetric() && coaxial)
    }

    fn load(&self, frame: &Frame<'_>, pose: &Pose, axes: &Matrix3<f64>, order: Order) -> Option<Load> {
        let Some(source) = &self.source else { return Some(Load::zero()) };
        let load = match frame {
            Frame::Station(station, fields) => {
                let known = fields.of(self.number);
                source.on_material(&station.material, (source.points(station), known), pose, order)
            }
            Frame::Section(material) => {
                source.on_material(material, (&material.moments.points(), &[]), pose, order)
            }
            Frame::Ring(number, body) => {
                let centre = pose.position + pose.axis() * body.to_centre();
                let rule = self.rules.external(*number, self.distance(&centre));
                source.on_ring(body, pose, rule, order)
            }
            Frame::Tip(_) => return Some(Load::zero()),
        };
        Some(load?.in_axes(&source.axes().tr_mul(axes)))
    }

    fn add_input_derivatives(&self, frame: &Frame<'_>, pose: &Pose, out: &mut LoadDerivatives) -> Option<()> {
        let first = out.counts.of_source(self.number).start;
        match frame {
            Frame::Station(station, _) if station.material.magnetisation != 0.0 => {
                let points =
                    self.source.as_ref().map_or(&station.points.1[..], |source| source.points(station));

                // The points of a station have equal shares of its moment.
                let direction = frame.direction().seen_in(&pose.rotation);
                let whole = direction * (station.material.magnetisation * station.material.moments.volume);
                let moment = whole / points.len() as f64;
                for point in points {
                    let arm = pose.rotation * Vector3::new(point.x, point.y, 0.0);
                    out.add_dipole(first, &moment, &arm, &self.rates(&(pose.position + arm))?);
                }
            }
            Frame::Ring(number, body) => {
                let (axis, half) = (pose.axis(), body.to_centre());
                let direction = frame.direction().seen_in(&pose.rotation);
                let reach = self.distance(&(pose.position + axis * half));
                for (height, volume) in self.rules.external(*number, reach).points() {
                    let arm = axis * (half + height);
                    let moment = direction * (body.magnetisation * volume);
                    out.add_dipole(first, &moment, &arm, &self.rates(&(pose.position + arm))?);
                }
            }
            Frame::Station(..) | Frame::Section(_) | Frame::Tip(_) => {}
        }
        Some(())
    }
}
