//! Field sources, and the energy of rings and stations in their fields.
//!
//! Energies are computed in the frame of the source, where its field is cheapest; only their sums are rotated.

use nalgebra::{Matrix3, Vector2, Vector3};

use super::chain::Chain;
use super::ring_body::RingBody;
use super::span_quadrature::SectionSample;
use crate::geometry::Pose;
use crate::magnetics::{
    Assembly, AxialRule, AxialSource, DipoleSheet, FaceRule, FieldAccuracy, Jet, SecondSums, SheetSums,
};
use crate::rod::{
    Charges, Load, Order, SectionDipoles, SectionMaterial, SectionStiffness, Station, StationState,
};

/// The magnet that makes the field of a source.
#[derive(Debug, Clone, Copy)]
enum Magnet<'a> {
    Assembly(&'a Assembly, f64),
    Ring(&'a AxialSource),
}

/// Sections of an element in the field of one source, and the loads on them; storage that is used again.
#[derive(Debug, Clone, Default)]
pub(crate) struct SectionBatch {
    /// Poses of the sections in the frame of the source.
    pub(super) sections: Vec<Pose>,
    /// Energy of each section as a load on its frame, in the axes of the source.
    pub(super) loads: Vec<Load>,
}

/// Field (T) and its derivatives at a point.
#[derive(Debug, Clone)]
pub(crate) struct Near {
    field: Vector3<f64>,
    gradient: Matrix3<f64>,
    /// Second derivative of the field component along an axis.
    along: Option<Matrix3<f64>>,
}

impl Near {
    /// Scaled by `strength`, with the second derivative of the component along `axis`.
    fn of(jet: &Jet, axis: &Vector3<f64>, strength: f64) -> Self {
        let along = Some(jet.hessian_along(axis) * strength);
        Self { field: jet.field * strength, gradient: jet.gradient * strength, along }
    }
}

/// Field of a magnet or coil at the material points of many stations, evaluated side by side; storage that is used again.
#[derive(Debug, Clone, Default)]
pub(crate) struct StationFields {
    /// The points in the frame of the source, m.
    points: Vec<Vector3<f64>>,
    /// The normal of the section of each.
    axes: Vec<Vector3<f64>>,
    /// Where the points of each station end.
    ends: Vec<usize>,
    gradients: Vec<(Vector3<f64>, Matrix3<f64>)>,
    jets: Vec<Jet>,
    /// The fields, in the axes of the source.
    near: Vec<Near>,
}

impl StationFields {
    /// The fields at the points of a station, counted along the chain; none where none were evaluated.
    pub(super) fn at(&self, station: usize) -> &[Near] {
        let first = station.checked_sub(1).and_then(|before| self.ends.get(before)).copied().unwrap_or(0);
        self.ends.get(station).and_then(|end| self.near.get(first..*end)).unwrap_or(&[])
    }

    /// Forgets all fields.
    pub(super) fn clear(&mut self) {
        self.ends.clear();
        self.near.clear();
    }
}

/// A field source at a pose.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Source<'a> {
    frame: Pose,
    magnet: Magnet<'a>,
    /// Largest spread (see [`Station::spread`]) for which the material of a section is represented by one point, m2.
    compact: f64,
}

impl<'a> Source<'a> {
    /// The external magnet at its pose, with its field scaled by `strength`.
    pub(crate) fn assembly(assembly: &'a Assembly, frame: Pose, strength: f64) -> Self {
        Self { frame, magnet: Magnet::Assembly(assembly, strength), compact: 0.0 }
    }

    /// The same source for a `chain` with its base at `base`, whose sections are sampled as coarsely as this relative
    /// `accuracy` of the energies allows.
    ///
    /// The mean field of a dipole over a section at distance `d` along its axis is `B (1 - 3 spread / d^2)`. The distance
    /// is taken to everything that the chain may reach, so that the choice depends on the inputs alone.
    pub(crate) fn seen_by(self, chain: &Chain, base: &Pose, accuracy: f64) -> Self {
        let reach = self.distance(&base.position) - chain.length();
        Self { compact: accuracy / 3.0 * reach * reach.max(0.0), ..self }
    }

    /// The points of a station's section, each of which carries an equal share of its magnetic material.
    pub(crate) fn points<'s>(&self, station: &'s Station) -> &'s [Vector2<f64>] {
        if station.material.magnetisation == 0.0 {
            &[]
        } else if station.spread <= self.compact {
            &station.points.0
        } else {
            &station.points.1
        }
    }

    /// A ring of the manipulator whose node is at `node`.
    pub(crate) fn ring(body: &'a RingBody, node: &Pose) -> Self {
        Self { frame: body.centre(node), magnet: Magnet::Ring(&body.source), compact: 0.0 }
    }

    /// Position in world axes, m.
    pub(crate) fn centre(&self) -> &Vector3<f64> {
        &self.frame.position
    }

    /// The axes in which the energies are given, as columns in world axes.
    pub(crate) fn axes(&self) -> &Matrix3<f64> {
        &self.frame.rotation
    }

    /// Field (T) at a point in the world frame; `None` inside a magnet.
    pub(crate) fn at(&self, point: &Vector3<f64>) -> Option<Vector3<f64>> {
        let local = self.frame.rotation.tr_mul(&(point - self.frame.position));
        let near = self.near(&local, &Vector3::z(), Order::Gradient)?;
        Some(self.frame.rotation * near.field)
    }

    /// Distance (m) from a point in the world frame.
    pub(crate) fn distance(&self, point: &Vector3<f64>) -> f64 {
        let local = || self.frame.rotation.tr_mul(&(point - self.frame.position));
        match self.magnet {
            Magnet::Assembly(assembly, _) => assembly.distance(&local()),
            Magnet::Ring(ring) => ring.distance(&local()),
        }
    }

    /// Field at a point in the source's frame; for second order, with the second derivative of its component along
    /// `axis`. `None` inside a magnet.
    #[inline]
    fn near(&self, point: &Vector3<f64>, axis: &Vector3<f64>, order: Order) -> Option<Near> {
        let (strength, jet) = match (self.magnet, order) {
            (Magnet::Assembly(assembly, _), _) if assembly.contains(point) => return None,
            (Magnet::Ring(ring), _) if ring.contains(point) => return None,
            (Magnet::Assembly(assembly, strength), Order::Gradient) => {
                let (field, gradient) = assembly.field_gradient(point).ok()?;
                return Some(Near { field: field * strength, gradient: gradient * strength, along: None });
            }
            (Magnet::Ring(ring), Order::Gradient) => {
                let (field, gradient) = ring.field_gradient(point).ok()?;
                return Some(Near { field, gradient, along: None });
            }
            (Magnet::Assembly(assembly, strength), Order::Hessian) => (strength, assembly.jet(point).ok()?),
            (Magnet::Ring(ring), Order::Hessian) => (1.0, ring.jet(point).ok()?),
        };
        Some(Near::of(&jet, axis, strength))
    }

    /// Evaluates the field at the points of `stations` at their poses, in that order; see [`Self::points`]. `None` inside a
    /// magnet.
    pub(crate) fn fields_at<'s>(
        &self,
        stations: impl Iterator<Item = (&'s Station, Pose)>,
        order: Order,
        out: &mut StationFields,
    ) -> Option<()> {
        let Magnet::Assembly(assembly, strength) = self.magnet else { return None };
        out.clear();
        let StationFields { points, axes, ends, gradients, jets, near } = out;
        points.clear();
        axes.clear();
        for (station, pose) in stations {
            let section = self.locate(&pose);
            for position in self.points(station) {
                points.push(section.transform(&Vector3::new(position.x, position.y, 0.0)));
                axes.push(section.axis());
            }
            ends.push(points.len());
        }
        if points.iter().any(|point| assembly.contains(point)) {
            return None;
        }
        if order == Order::Gradient {
            assembly.field_gradients(points, gradients).ok()?;
            near.extend(gradients.iter().map(|(field, gradient)| Near {
                field: field * strength,
                gradient: gradient * strength,
                along: None,
            }));
        } else {
            assembly.jets(points, jets).ok()?;
            near.extend(jets.iter().zip(axes).map(|(jet, axis)| Near::of(jet, axis, strength)));
        }
        Some(())
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

    /// The same for a ring in the field of another ring, all points of `rule` at once.
    ///
    /// They lie on a section that contains the axis: its first director is the axis, as is the direction of the dipoles.
    pub(crate) fn on_axis(
        &self,
        body: &RingBody,
        node: &Pose,
        rule: &AxialRule,
        accuracy: FieldAccuracy,
        order: Order,
    ) -> Option<Load> {
        let Magnet::Ring(ring) = self.magnet else { return None };
        let local = self.locate(node);
        let (axis, none) = (local.axis(), Vector3::zeros());
        let section = Pose { rotation: Matrix3::from_columns(&[axis, none, axis]), ..local };
        let dipoles = on_sheet(ring, rule.upright(), &section, accuracy, order)?;
        Some(dipoles.times(body.magnetisation).load(&section.rotation))
    }

    /// The same for a ring in the field of another ring, from the magnetic charges on its proximal and distal face.
    pub(crate) fn on_faces(
        &self,
        body: &RingBody,
        node: &Pose,
        rules: [&FaceRule; 2],
        order: Order,
    ) -> Option<Load> {
        let Magnet::Ring(ring) = self.magnet else { return None };
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

    /// The same for the material of a section at `pose`, represented by `points` with equal shares; the field at the first
    /// ones may have been evaluated already.
    pub(crate) fn on_material(
        &self,
        material: &SectionMaterial,
        (points, fields): (&[Vector2<f64>], &[Near]),
        pose: &Pose,
        order: Order,
    ) -> Option<Load> {
        if material.magnetisation == 0.0 {
            return Some(Load::zero());
        }
        let share = material.magnetisation * material.moments.volume / points.len() as f64;
        let section = self.locate(pose);
        let [d1, d2, axis]: [Vector3<f64>; 3] =
            core::array::from_fn(|i| section.rotation.column(i).into_owned());
        let mut sheet = SectionDipoles::new(order == Order::Hessian);
        for (number, position) in points.iter().enumerate() {
            let here;
            let near = if let Some(near) = fields.get(number) {
                near
            } else {
                let point = section.position + d1 * position.x + d2 * position.y;
                here = self.near(&point, &axis, order)?;
                &here
            };
            sheet.add((share, &axis), position, &near.field, &near.gradient, near.along.as_ref());
        }
        Some(sheet.load(&section.rotation))
    }

    /// The same for a ring and samples of the material of an element with its start node at `start`; sections and loads,
    /// with second derivatives, are written to `batch` in the order of the samples. `None` for another source.
    pub(crate) fn on_samples(
        &self,
        samples: &[SectionSample],
        near: bool,
        (start, states): (&Pose, &[StationState]),
        batch: &mut SectionBatch,
    ) -> Option<()> {
        let Magnet::Ring(ring) = self.magnet else { return None };
        let start = self.locate(start);
        batch.loads.clear();
        batch.sections.clear();
        for sample in samples {
            let section = start.compose(&states[sample.station].pose());
            let dipoles = on_sheet(ring, &sample.sheet, &section, sample.accuracy(near), Order::Hessian)?;
            batch.loads.push(dipoles.load(&section.rotation));
            batch.sections.push(section);
        }
        Some(())
    }

    /// Adds the loads of a ring on samples of the material of an element, whose start node is at `start`, to the
    /// loads on its `stations`, in the axes of that node and without second derivatives. Returns the energy, and force and
    /// moment of the energy's derivative by the ring's node; `None` for another source.
    pub(crate) fn add_on_samples(
        &self,
        body: &RingBody,
        samples: &[SectionSample],
        near: bool,
        (start, states): (&Pose, &[StationState]),
        stations: &mut [Load],
    ) -> Option<(f64, Vector3<f64>, Vector3<f64>)> {
        let Magnet::Ring(ring) = self.magnet else { return None };
        let start = self.locate(start);
        let (mut energy, mut force, mut moment) = (0.0, Vector3::zeros(), Vector3::zeros());
        for sample in samples {
            let state = &states[sample.station];
            let section = start.compose(&state.pose());
            let SheetSums { field, force: [pull, by_x, by_y] } =
                ring.on_sheet(&sample.sheet, &section, sample.accuracy(near))?;
            let director = |i: usize| section.rotation.column(i).into_owned();
            energy -= director(2).dot(&field);
            force += pull;
            let arm = section.position + Vector3::z() * body.half_length();
            moment += arm.cross(&pull)
                + director(0).cross(&by_x)
                + director(1).cross(&by_y)
                + director(2).cross(&field);
            let back = |own: &Vector3<f64>| start.rotation.tr_mul(own);
            let load = &mut stations[sample.station];
            load.force -= back(&pull);
            let own = |i: usize| state.directors.column(i).transpose();
            load.couple -= back(&by_x) * own(0) + back(&by_y) * own(1) + back(&field) * own(2);
        }
        Some((energy, self.frame.rotation * force, self.frame.rotation * moment))
    }

    fn locate(&self, pose: &Pose) -> Pose {
        Pose {
            position: self.frame.rotation.tr_mul(&(pose.position - self.frame.position)),
            rotation: self.frame.rotation.tr_mul(&pose.rotation),
        }
    }
}

/// Dipoles of a sheet at `section` in the field of a ring, in its frame; `None` where one is inside the ring.
fn on_sheet(
    ring: &AxialSource,
    sheet: &DipoleSheet,
    section: &Pose,
    accuracy: FieldAccuracy,
    order: Order,
) -> Option<SectionDipoles> {
    if order == Order::Gradient {
        let SheetSums { field, force } = ring.on_sheet(sheet, section, accuracy)?;
        return Some(SectionDipoles { field, force, second: None });
    }
    let SecondSums { field, gradient, along } = ring.second_on_sheet(sheet, section, accuracy)?;
    let force = gradient.each_ref().map(|gradient| gradient * section.axis());
    Some(SectionDipoles { field, force, second: Some(SectionStiffness { gradient, along }) })
}
