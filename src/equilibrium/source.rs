//! What makes a field, and the energy of rings and stations in it.
//!
//! Energies are computed in the frame of the source, where its field is cheapest; only their sums are turned.

use nalgebra::{Matrix3, Vector2, Vector3};

use super::chain::Chain;
use super::ring_body::RingBody;
use crate::geometry::Pose;
use crate::magnetics::{Assembly, AxialRule, AxialSource, FaceRule, FieldTable};
use crate::rod::{Charges, Load, Order, SectionDipoles, SectionMaterial, Station, StationQuadrature};

/// The magnet in a source.
#[derive(Debug, Clone, Copy)]
enum Magnet<'a> {
    Assembly(&'a Assembly, f64),
    Ring(&'a AxialSource, Option<&'a FieldTable>),
}

/// A field at a point.
struct Near {
    field: Vector3<f64>,
    gradient: Matrix3<f64>,
    /// Second derivative of the component along an axis.
    along: Option<Matrix3<f64>>,
}

/// A magnet at a pose.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Source<'a> {
    frame: Pose,
    magnet: Magnet<'a>,
    /// Largest spread (see [`Station::spread`]) with which material counts as one point.
    compact: f64,
}

impl<'a> Source<'a> {
    /// The external magnet at its pose, its field times `strength`.
    pub(crate) fn assembly(assembly: &'a Assembly, frame: Pose, strength: f64) -> Self {
        Self { frame, magnet: Magnet::Assembly(assembly, strength), compact: 0.0 }
    }

    /// The same for a `chain` with its base there, sampled as coarsely as this relative `accuracy` of the energies allows.
    ///
    /// A dipole at distance `d` along the axis has the mean `B (1 - 3 spread / d^2)` over a section. The distance is that
    /// of all the chain may reach, so that the choice depends on the inputs alone.
    pub(crate) fn seen_by(self, chain: &Chain, base: &Pose, accuracy: f64) -> Self {
        let reach = self.distance(&base.position) - chain.length();
        Self { compact: accuracy / 3.0 * reach * reach.max(0.0), ..self }
    }

    /// The points of a station's section that carry its material in equal parts.
    pub(crate) fn points<'s>(&self, station: &'s Station) -> &'s [Vector2<f64>] {
        if station.spread <= self.compact { &station.points.0 } else { &station.points.1 }
    }

    /// A ring of the manipulator whose node is at `node`; `tabulated` where its table may stand for its field and gradient.
    pub(crate) fn ring(body: &'a RingBody, node: &Pose, tabulated: bool) -> Self {
        Self {
            frame: body.centre(node),
            magnet: Magnet::Ring(&body.source, body.table.as_deref().filter(|_| tabulated)),
            compact: 0.0,
        }
    }

    /// The axes in which the energies are given: the columns, in the world's axes.
    pub(crate) fn axes(&self) -> &Matrix3<f64> {
        &self.frame.rotation
    }

    /// Field (T) at a point of the world; `None` inside a magnet.
    pub(crate) fn at(&self, point: &Vector3<f64>) -> Option<Vector3<f64>> {
        let local = self.frame.rotation.tr_mul(&(point - self.frame.position));
        let near = self.near(&local, &Vector3::z(), Order::Gradient)?;
        Some(self.frame.rotation * near.field)
    }

    /// Distance from a point of the world, m.
    pub(crate) fn distance(&self, point: &Vector3<f64>) -> f64 {
        let local = || self.frame.rotation.tr_mul(&(point - self.frame.position));
        match self.magnet {
            Magnet::Assembly(assembly, _) => assembly.distance(&local()),
            Magnet::Ring(ring, _) => ring.distance(&local()),
        }
    }

    /// The field at a point of the source's frame, with the second derivative of its component along `axis` where
    /// asked for; `None` inside a magnet.
    #[inline]
    fn near(&self, point: &Vector3<f64>, axis: &Vector3<f64>, order: Order) -> Option<Near> {
        if let (Magnet::Ring(_, Some(table)), Order::Gradient) = (self.magnet, order)
            && let Some((field, gradient)) = table.field_gradient(point)
        {
            return Some(Near { field, gradient, along: None });
        }
        let (strength, jet) = match (self.magnet, order) {
            (Magnet::Assembly(assembly, _), _) if assembly.contains(point) => return None,
            (Magnet::Ring(ring, _), _) if ring.contains(point) => return None,
            (Magnet::Assembly(assembly, strength), Order::Gradient) => {
                let (field, gradient) = assembly.field_gradient(point).ok()?;
                return Some(Near { field: field * strength, gradient: gradient * strength, along: None });
            }
            (Magnet::Ring(ring, _), Order::Gradient) => {
                let (field, gradient) = ring.field_gradient(point).ok()?;
                return Some(Near { field, gradient, along: None });
            }
            (Magnet::Assembly(assembly, strength), Order::Hessian) => (strength, assembly.jet(point).ok()?),
            (Magnet::Ring(ring, _), Order::Hessian) => (1.0, ring.jet(point).ok()?),
        };
        Some(Near {
            field: jet.field * strength,
            gradient: jet.gradient * strength,
            along: Some(jet.hessian_along(axis) * strength),
        })
    }

    /// Energy of a ring whose node is at `node`, in the axes of the source; `None` where it touches the magnet.
    pub(crate) fn on_ring(
        &self,
        body: &RingBody,
        node: &Pose,
        rule: &AxialRule,
        order: Order,
    ) -> Option<Load> {
        let local = self.locate(node);
        let axis = local.axis();
        let centre = body.half_length();
        let mut load = Load::zero();
        for (height, volume) in rule.points() {
            let arm = axis * (centre + height);
            let near = self.near(&(local.position + arm), &axis, order)?;
            let moment = body.magnetisation * volume;
            load.add_dipole(moment, &axis, &arm, &near.field, &near.gradient, near.along.as_ref());
        }
        Some(load)
    }

    /// The same for a ring in the field of this one, by the magnetic charges of its two faces, proximal and distal.
    pub(crate) fn on_faces(
        &self,
        body: &RingBody,
        node: &Pose,
        rules: [&FaceRule; 2],
        order: Order,
    ) -> Option<Load> {
        let Magnet::Ring(ring, _) = self.magnet else { return None };
        let local = self.locate(node);
        let [d1, d2, axis]: [Vector3<f64>; 3] =
            core::array::from_fn(|i| local.rotation.column(i).into_owned());
        let mut load = Load::zero();
        for (rule, height, charge) in
            [(rules[0], 0.0, -body.magnetisation), (rules[1], body.ring.length, body.magnetisation)]
        {
            let centre = local.position + axis * height;
            let mut charges = Charges::new(order == Order::Hessian);
            for (position, area) in rule.points() {
                let point = centre + d1 * position.x + d2 * position.y;
                if ring.contains(&point) {
                    return None;
                }
                if order == Order::Hessian {
                    let (potential, field, gradient) = ring.potential_field_gradient(&point).ok()?;
                    charges.add(charge * area, &position, potential, &field, Some(&gradient));
                } else {
                    let (potential, field) = ring.potential_field(&point).ok()?;
                    charges.add(charge * area, &position, potential, &field, None);
                }
            }
            load += charges.load(&local.rotation, height);
        }
        Some(load)
    }

    /// The same for material of a section at `pose`, where `points` carry it in equal parts.
    pub(crate) fn on_material(
        &self,
        material: &SectionMaterial,
        points: &[Vector2<f64>],
        pose: &Pose,
        order: Order,
    ) -> Option<Load> {
        if material.magnetisation == 0.0 {
            return Some(Load::zero());
        }
        let share = material.magnetisation * material.moments.volume / points.len() as f64;
        self.on_section(points.iter().map(|point| (*point, share)), &self.locate(pose), order)
    }

    /// The same, for a sample of the material.
    pub(crate) fn on_sample(&self, sample: &StationQuadrature, pose: &Pose, order: Order) -> Option<Load> {
        let dipoles = sample.points.iter().map(|point| (point.position, sample.magnetisation * point.volume));
        self.on_section(dipoles, &self.locate(pose), order)
    }

    /// Dipoles (A m2) at points of a section, whose pose is given in the source's frame.
    fn on_section(
        &self,
        dipoles: impl Iterator<Item = (Vector2<f64>, f64)>,
        section: &Pose,
        order: Order,
    ) -> Option<Load> {
        let turn = &section.rotation;
        let [d1, d2, axis]: [Vector3<f64>; 3] = core::array::from_fn(|i| turn.column(i).into_owned());
        let mut sheet = SectionDipoles::new(order == Order::Hessian);
        for (position, moment) in dipoles {
            let point = section.position + d1 * position.x + d2 * position.y;
            let near = self.near(&point, &axis, order)?;
            sheet.add(moment, &position, &near.field, &near.gradient, near.along.as_ref());
        }
        Some(sheet.load(turn))
    }

    fn locate(&self, pose: &Pose) -> Pose {
        Pose {
            position: self.frame.rotation.tr_mul(&(pose.position - self.frame.position)),
            rotation: self.frame.rotation.tr_mul(&pose.rotation),
        }
    }
}
