//! The field of a magnet or coil at its place, and the energy of rings and stations in it.
//!
//! Energies are computed in the frame of the source, where its field is cheapest; only their sums are rotated.

use nalgebra::{Matrix3, Vector2, Vector3};

use super::chain::Chain;
use super::ring_body::RingBody;
use crate::geometry::Pose;
use crate::magnetics::{AxialRule, Jet, Source};
use crate::rod::{Load, Order, SectionDipoles, SectionMaterial, Station};

/// Number of nodes of a ring whose field is asked for at once: as many as are evaluated side by side.
const TOGETHER: usize = 8;

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

    /// Field and gradient at a point, without second derivatives, at this strength.
    fn flat((field, gradient): &(Vector3<f64>, Matrix3<f64>), strength: f64) -> Self {
        Self { field: field * strength, gradient: gradient * strength, along: None }
    }
}

/// Field of a magnet or coil at the material points of many stations, evaluated side by side; storage that is used again.
#[derive(Debug, Clone, Default)]
pub(crate) struct StationFields {
    /// The points in the frame of the source, m.
    points: Vec<Vector3<f64>>,
    /// The direction of the dipole at each.
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
    pub(crate) fn at(&self, station: usize) -> &[Near] {
        let first = station.checked_sub(1).and_then(|before| self.ends.get(before)).copied().unwrap_or(0);
        self.ends.get(station).and_then(|end| self.near.get(first..*end)).unwrap_or(&[])
    }

    /// Forgets all fields.
    pub(crate) fn clear(&mut self) {
        self.ends.clear();
        self.near.clear();
    }
}

/// The field of a magnet or coil at its pose.
#[derive(Debug, Clone, Copy)]
pub(crate) struct SourceField<'a> {
    frame: Pose,
    source: &'a Source,
    strength: f64,
    /// Largest spread (see [`Station::spread`]) for which the material of a section is represented by one point, m2.
    compact: f64,
}

impl<'a> SourceField<'a> {
    /// A magnet or coil at its pose, with its field scaled by `strength`.
    pub(crate) fn new(source: &'a Source, frame: Pose, strength: f64) -> Self {
        Self { frame, source, strength, compact: 0.0 }
    }

    /// The source for a `chain` with its base at `base`, whose sections are sampled as coarsely as this relative
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
    fn distance(&self, point: &Vector3<f64>) -> f64 {
        self.source.distance(&self.frame.rotation.tr_mul(&(point - self.frame.position)))
    }

    /// Field at a point in the source's frame; for second order, with the second derivative of its component along
    /// `axis`. `None` inside a magnet.
    fn near(&self, point: &Vector3<f64>, axis: &Vector3<f64>, order: Order) -> Option<Near> {
        if self.source.contains(point) {
            return None;
        }
        Some(match order {
            Order::Gradient => Near::flat(&self.source.field_gradient(point).ok()?, self.strength),
            Order::Hessian => Near::of(&self.source.jet(point).ok()?, axis, self.strength),
        })
    }

    /// Evaluates the field at a few points, at most [`TOGETHER`], handed to `put` by their numbers.
    fn near_each(
        &self,
        points: &[Vector3<f64>],
        axis: &Vector3<f64>,
        order: Order,
        mut put: impl FnMut(usize, &Near),
    ) -> Option<()> {
        if self.source.contains_any(points) {
            return None;
        }
        if order == Order::Gradient {
            let mut gradients = [(Vector3::zeros(), Matrix3::zeros()); TOGETHER];
            let gradients = &mut gradients[..points.len()];
            self.source.gradients(points, gradients).ok()?;
            let near = gradients.iter().map(|own| Near::flat(own, self.strength));
            near.enumerate().for_each(|(number, near)| put(number, &near));
        } else {
            let mut jets = [Jet::zero(); TOGETHER];
            let jets = &mut jets[..points.len()];
            self.source.jets(points, jets).ok()?;
            let near = jets.iter().map(|jet| Near::of(jet, axis, self.strength));
            near.enumerate().for_each(|(number, near)| put(number, &near));
        }
        Some(())
    }

    /// Evaluates the field at the points of `stations` at their poses, in that order; see [`Self::points`]. `None` inside a
    /// magnet.
    pub(crate) fn fields_at<'s>(
        &self,
        stations: impl Iterator<Item = (&'s Station, Pose)>,
        order: Order,
        out: &mut StationFields,
    ) -> Option<()> {
        let Self { source, strength, .. } = *self;
        out.clear();
        let StationFields { points, axes, ends, gradients, jets, near } = out;

        points.clear();
        axes.clear();
        for (station, pose) in stations {
            let section = self.locate(&pose);
            let direction = station.material.direction.seen_in(&section.rotation);
            for position in self.points(station) {
                points.push(section.transform(&Vector3::new(position.x, position.y, 0.0)));
                axes.push(direction);
            }
            ends.push(points.len());
        }

        if source.contains_any(points) {
            return None;
        }
        if order == Order::Gradient {
            gradients.resize(points.len(), (Vector3::zeros(), Matrix3::zeros()));
            source.gradients(points, gradients).ok()?;
            near.extend(gradients.iter().map(|own| Near::flat(own, strength)));
        } else {
            jets.resize(points.len(), Jet::zero());
            source.jets(points, jets).ok()?;
            near.extend(jets.iter().zip(axes).map(|(jet, axis)| Near::of(jet, axis, strength)));
        }
        Some(())
    }

    /// Energy of a ring whose node is at `node`, in the axes of the source; `None` where it touches the source.
    pub(crate) fn on_ring(
        &self,
        body: &RingBody,
        node: &Pose,
        rule: &AxialRule,
        order: Order,
    ) -> Option<Load> {
        let local = self.locate(node);
        let (axis, direction) = (local.axis(), body.direction.seen_in(&local.rotation));
        let centre = body.to_centre();
        let arm = |height: f64| axis * (centre + height);
        let mut load = Load::zero();

        for nodes in rule.nodes().chunks(TOGETHER) {
            let mut points = [Vector3::zeros(); TOGETHER];
            for (point, (height, _)) in points.iter_mut().zip(nodes) {
                *point = local.position + arm(*height);
            }
            self.near_each(&points[..nodes.len()], &direction, order, |number, near| {
                let (height, volume) = nodes[number];
                let moment = body.magnetisation * volume;
                let (field, gradient) = (&near.field, &near.gradient);
                load.add_dipole(moment, &direction, &arm(height), field, gradient, near.along.as_ref());
            })?;
        }
        Some(load)
    }

    /// Load on the material of a section at `pose`, represented by `points` with equal shares; the field at the first
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
        // Instead of the normal, the direction of the dipoles.
        let directors = material.direction.sheet(&section.rotation);
        let [d1, d2, axis]: [Vector3<f64>; 3] = core::array::from_fn(|i| directors.column(i).into_owned());
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
        Some(sheet.load(&directors))
    }

    fn locate(&self, pose: &Pose) -> Pose {
        Pose {
            position: self.frame.rotation.tr_mul(&(pose.position - self.frame.position)),
            rotation: self.frame.rotation.tr_mul(&pose.rotation),
        }
    }
}
