//! External magnet: the loads of its field on rings and magnetised material.

use nalgebra::{Matrix3, Vector3};

use super::load_derivatives::{FieldRate, LoadDerivatives, MAGNET_INPUTS};
use super::{Frame, Term};
use crate::equilibrium::chain::Chain;
use crate::equilibrium::inputs::Inputs;
use crate::equilibrium::layout::Input;
use crate::equilibrium::pair_quadrature::PairQuadrature;
use crate::equilibrium::source::{Source, StationFields};
use crate::geometry::{Pose, hat};
use crate::magnetics::{Assembly, Jet};
use crate::rod::{Load, Order, Station};

/// The external magnet at its pose.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Magnet<'a> {
    /// The assembly, also where it is switched off.
    assembly: Option<&'a Assembly>,
    /// Its field source, where it is switched on.
    source: Option<Source<'a>>,
    inputs: &'a Inputs,
    rules: &'a PairQuadrature,
}

impl<'a> Magnet<'a> {
    pub(super) fn new(assembly: Option<&'a Assembly>, inputs: &'a Inputs, rules: &'a PairQuadrature) -> Self {
        let on = assembly.filter(|_| inputs.magnet_strength != 0.0);
        let source = on.map(|assembly| Source::assembly(assembly, inputs.magnet, inputs.magnet_strength));
        Self { assembly, source, inputs, rules }
    }

    /// The same magnet for a chain whose sections are sampled as coarsely as this relative accuracy of the energies
    /// allows.
    pub(crate) fn seen_by(self, chain: &Chain, accuracy: f64) -> Self {
        let seen = |source: Source<'a>| source.seen_by(chain, &self.inputs.base, accuracy);
        Self { source: self.source.map(seen), ..self }
    }

    /// Whether it is there and switched on.
    pub(crate) fn is_on(&self) -> bool {
        self.source.is_some()
    }

    /// The same term without the assembly: as if the magnet could not be switched on.
    pub(crate) fn removed(self) -> Self {
        Self { assembly: None, source: None, ..self }
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

    /// Number of points at which [`Self::fields_at`] evaluates it on a station.
    pub(crate) fn points_on(&self, station: &Station) -> usize {
        self.source.as_ref().map_or(0, |source| source.points(station).len())
    }

    /// Its field (T) at a point in the world frame; `None` inside it.
    pub(super) fn at(&self, point: &Vector3<f64>) -> Option<Vector3<f64>> {
        self.source.as_ref().map_or(Some(Vector3::zeros()), |source| source.at(point))
    }

    /// Derivatives of its field with respect to its own inputs at a point in the world frame; `None` inside it and on its
    /// edges, even if it is switched off.
    ///
    /// The field of a body that moves with velocity `v(x) = t + w x (x - c)` changes at a fixed point by `w x B - G v`,
    /// and its gradient by `hat(w) G - G hat(w) - H v`.
    pub(super) fn rates(&self, point: &Vector3<f64>) -> Option<[FieldRate; MAGNET_INPUTS]> {
        let turn = &self.inputs.magnet.rotation;
        let arm = point - self.inputs.magnet.position;
        let own = match self.assembly {
            None => Jet::zero(),
            Some(assembly) => {
                let local = turn.tr_mul(&arm);
                if assembly.contains(&local) {
                    return None;
                }
                assembly.jet(&local).ok()?.rotated(turn)
            }
        };
        let jet = own * self.inputs.magnet_strength;
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

    /// Distance (m) of a point in the world frame from the assembly, switched on or off; infinite without one.
    fn distance(&self, point: &Vector3<f64>) -> f64 {
        let local = || self.inputs.magnet.rotation.tr_mul(&(point - self.inputs.magnet.position));
        self.assembly.map_or(f64::INFINITY, |assembly| assembly.distance(&local()))
    }
}

impl Term for Magnet<'_> {
    fn acts_on(&self, frame: &Frame<'_>) -> bool {
        self.is_on() && !matches!(frame, Frame::Tip(_))
    }

    fn load(&self, frame: &Frame<'_>, pose: &Pose, axes: &Matrix3<f64>, order: Order) -> Option<Load> {
        let Some(source) = &self.source else { return Some(Load::zero()) };
        let load = match frame {
            Frame::Station(station, fields) => {
                source.on_material(&station.material, (source.points(station), fields), pose, order)
            }
            Frame::Section(material) => {
                source.on_material(material, (&material.moments.points(), &[]), pose, order)
            }
            Frame::Ring(number, body) => {
                let centre = pose.position + pose.axis() * body.half_length();
                let rule = self.rules.external(*number, self.distance(&centre));
                source.on_ring(body, pose, rule, order)
            }
            Frame::Tip(_) => return Some(Load::zero()),
        };
        Some(load?.in_axes(&source.axes().tr_mul(axes)))
    }

    fn add_input_derivatives(&self, frame: &Frame<'_>, pose: &Pose, out: &mut LoadDerivatives) -> Option<()> {
        if self.assembly.is_none() {
            return Some(());
        }
        let first = Input::MagnetPosition.columns().start;
        match frame {
            Frame::Station(station, _) if station.material.magnetisation != 0.0 => {
                let points =
                    self.source.as_ref().map_or(&station.points.1[..], |source| source.points(station));
                let whole = pose.axis() * (station.material.magnetisation * station.material.moments.volume);
                let moment = whole / points.len() as f64;
                for point in points {
                    let arm = pose.rotation * Vector3::new(point.x, point.y, 0.0);
                    out.add_dipole(first, &moment, &arm, &self.rates(&(pose.position + arm))?);
                }
            }
            Frame::Ring(number, body) => {
                let (axis, half) = (pose.axis(), body.half_length());
                let reach = self.distance(&(pose.position + axis * half));
                for (height, volume) in self.rules.external(*number, reach).points() {
                    let arm = axis * (half + height);
                    let moment = axis * (body.magnetisation * volume);
                    out.add_dipole(first, &moment, &arm, &self.rates(&(pose.position + arm))?);
                }
            }
            Frame::Station(..) | Frame::Section(_) | Frame::Tip(_) => {}
        }
        Some(())
    }
}
