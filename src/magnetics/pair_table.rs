//! Quadrature of the energy of two magnets, with as few nodes as their distance and the accuracy allow.
//!
//! Far apart, nodes on the axis of one magnet suffice. Close together, they would represent an expansion of the other
//! one's field that does not converge there; the magnetic charges on the faces are used instead.

use nalgebra::{Rotation3, Vector3};

use super::axial_rule::AxialRule;
use super::axial_source::AxialSource;
use super::face_rule::FaceRule;
use super::wall_rule::WallRule;
use super::wrench::{Wrench, relative_difference};
use crate::constants::VACUUM_PERMEABILITY;
use crate::geometry::Pose;
use crate::numerics::bisection::bisect;

/// Number of bisections for the distance from which on a rule is accurate enough.
const BISECTIONS: usize = 40;

/// Error of force and torque of two rings, relative to the requested accuracy.
const SHARE: f64 = 0.1;

/// Error bound of an axial rule (for the field of a dipole at the nearest point of the other ring), relative to the
/// error of force and torque between two rings, which depend on high degrees more than the field does.
const BOUND_OVER_ERROR: f64 = 0.2;

/// Number of nodes from which on that ratio is measured, see [`Measured`]: a ring's edges are further away than the
/// dipole, which affects high degrees.
const MANY_NODES: usize = 13;

/// Settings of this measurement: the largest ratio; the extent over the distance; the accuracy of the wrench; the tilts
/// (rad) and offsets (outer radii); and a safety factor for other poses.
const MOST_BOUND_OVER_ERROR: f64 = 28.0;
const NEAREST: f64 = 0.45;
const MEASURED_TO: f64 = 1e-7;
const CLOSE: [[f64; 2]; 4] = [[0.0, 0.0], [0.2, 0.0], [0.4, 0.5], [0.8, 0.0]];
const OTHERS: f64 = 1.5;

/// Largest distance of a face from the other magnet's edges for which there is a rule, in outer radii.
const FARTHEST: f64 = 4.0;

/// Number of rules per halving of that distance.
const PER_OCTAVE: f64 = 4.0;

/// Number of these rules: the last is for a fortieth of the outer radius.
const LEVELS: i32 = 30;

/// Quadrature of the energy of a magnet in the field of another one.
#[derive(Debug, Clone, Copy)]
pub enum PairRule<'a> {
    /// Dipoles at nodes on its axis, and the distance (m) of the nearest source from which on it is used.
    Axis(&'a AxialRule, f64),
    /// Charges at nodes on its two faces: where its magnetisation enters, then where it leaves.
    Faces([&'a FaceRule; 2]),
    /// Charges at nodes on its two faces and on its walls: of a magnet that is not magnetised along its axis.
    Surface([&'a FaceRule; 2], &'a WallRule),
}

/// All quadrature rules of one magnet.
#[derive(Debug, Clone, PartialEq)]
pub struct PairTable {
    inner: f64,
    outer: f64,
    length: f64,
    /// Axial rules, fewest nodes first, each with the distances (m) of the nearest source from which on it is accurate
    /// enough: for the moment in a field, and for force and torque between two rings.
    axis: Vec<(f64, f64, AxialRule)>,
    /// Face rules, fewest nodes first, each with the distance (m) of the other magnet's edges from which on it is
    /// accurate enough.
    faces: Vec<(f64, FaceRule)>,
    /// Wall rules, fewest nodes first, with the distance (m) of the other magnet's edges from which on each is accurate enough; empty for
    /// a magnet magnetised along its axis.
    walls: Vec<(f64, WallRule)>,
}

impl PairTable {
    /// Makes the rules of an annular cylinder of these radii and this length (m), magnetised along its axis.
    ///
    /// The errors of force, torque and energy between two rings are at most a tenth of `accuracy`, relative to
    /// `|F| + |T|/a`, `|F| a + |T|` and the energy, with the outer radius `a`, down to a distance of a fortieth of `a`
    /// between a face and the other magnet's edges. This holds for rings like the paper's; for other shapes the errors
    /// may be three times as large, for very thin rings six times. In another field `accuracy` bounds the error of the
    /// energy.
    ///
    /// ```
    /// use mcm::geometry::Pose;
    /// use mcm::magnetics::{AxialSource, PairRule, PairTable};
    /// let ring = AxialSource::new(0.75e-3, 2.0e-3, 1.0e-3, 1.35)?;
    /// let table = PairTable::new(0.75e-3, 2.0e-3, 1.0e-3, 1e-5);
    /// let rule = |z| Pose::new([0.0, 0.0, z], [1.0, 0.0, 0.0, 0.0]).map(|pose| table.choose(&ring, &pose));
    /// assert!(matches!(table.rule(rule(5.0e-3)?), PairRule::Axis(..)));
    /// assert!(matches!(table.rule(rule(1.1e-3)?), PairRule::Faces(_)));
    /// # Ok::<(), mcm::error::Error>(())
    /// ```
    #[must_use]
    pub fn new(inner: f64, outer: f64, length: f64, accuracy: f64) -> Self {
        // The thinner the magnet, the more the forces on its faces cancel: the rules were measured for a length of half
        // a radius.
        let tolerance = SHARE * accuracy * (2.0 * length / outer).min(1.0);
        let faces = (0..LEVELS).map(|level| {
            let distance = outer * FARTHEST * (-f64::from(level) / PER_OCTAVE).exp2();
            (distance, FaceRule::new(inner, outer, distance, tolerance))
        });
        let axis = axis_rules(inner, outer, length, accuracy);
        Self { inner, outer, length, axis, faces: faces.collect(), walls: Vec::new() }
    }

    /// The rules of an annular cylinder that is magnetised in any direction; see [`PairTable::new`].
    #[must_use]
    pub fn of_any_direction(inner: f64, outer: f64, length: f64, accuracy: f64) -> Self {
        let tolerance = SHARE * accuracy;
        let own = Self::new(inner, outer, length, accuracy);
        let walls = own
            .faces
            .iter()
            .map(|(distance, _)| (*distance, WallRule::new(inner, outer, length, *distance, tolerance)));
        Self { walls: walls.collect(), ..own }
    }

    /// The table of a ball of this radius, m: outside, a uniformly magnetised ball is a dipole at its centre, so that one node is exact.
    #[must_use]
    pub fn of_ball(radius: f64) -> Self {
        // A cylinder of the same radius and volume has the same node.
        let rule = AxialRule::new(0.0, radius, 4.0 / 3.0 * radius, 1);
        Self {
            inner: 0.0,
            outer: radius,
            length: 2.0 * radius,
            axis: vec![(0.0, 0.0, rule)],
            faces: Vec::new(),
            walls: Vec::new(),
        }
    }

    /// Whether the table was made for a magnet of these radii and this length, m, that is not a ball, magnetised along its axis or not.
    #[must_use]
    pub fn is_of(&self, inner: f64, outer: f64, length: f64, axial: bool) -> bool {
        let tube = !self.faces.is_empty() && self.walls.is_empty() == axial;
        (self.inner, self.outer, self.length) == (inner, outer, length) && tube
    }

    /// Number of rules for a pair.
    #[must_use]
    pub fn len(&self) -> usize {
        self.axis.len() + self.faces.len() * self.faces.len() * self.walls.len().max(1)
    }

    /// Whether the table has no rules: always false.
    #[must_use]
    pub fn is_empty(&self) -> bool {
        self.len() == 0
    }

    /// The number, below [`PairTable::len`], of the rule for the magnet at `pose` in the frame of `source`.
    #[must_use]
    pub fn choose(&self, source: &AxialSource, pose: &Pose) -> usize {
        let reach = source.distance(&pose.position);
        if let Some(number) = self.axis.iter().position(|entry| entry.1 <= reach) {
            return number;
        }
        if self.faces.is_empty() {
            return 0;
        }
        let level = |height: f64| {
            let distance = source.edge_distance(&pose.advanced(height), self.inner, self.outer);
            self.faces.iter().position(|(least, _)| *least <= distance).unwrap_or(self.faces.len() - 1)
        };
        let half = 0.5 * self.length;
        let levels = level(-half) * self.faces.len() + level(half);
        if self.walls.is_empty() {
            return self.axis.len() + levels;
        }
        let distance = source.edge_distance_to(pose, [self.inner, self.outer], self.length);
        let wall =
            self.walls.iter().position(|(least, _)| *least <= distance).unwrap_or(self.walls.len() - 1);
        self.axis.len() + levels * self.walls.len() + wall
    }

    /// The rule of that number; beyond the last number, the last rule.
    #[must_use]
    pub fn rule(&self, number: usize) -> PairRule<'_> {
        match number.min(self.len() - 1).checked_sub(self.axis.len()) {
            None => PairRule::Axis(&self.axis[number].2, self.axis[number].1),
            Some(levels) => {
                let (count, walls) = (self.faces.len(), self.walls.len().max(1));
                let [first, second] = [levels / walls / count, levels / walls % count];
                let faces = [&self.faces[first].1, &self.faces[second].1];
                match self.walls.get(levels % walls) {
                    Some((_, wall)) => PairRule::Surface(faces, wall),
                    None => PairRule::Faces(faces),
                }
            }
        }
    }

    /// The axial rule for an external field whose sources are `reach` (m) away; the last one if none is accurate
    /// enough.
    #[must_use]
    pub fn external(&self, reach: f64) -> &AxialRule {
        let number = self.axis.iter().position(|entry| entry.0 <= reach).unwrap_or(self.axis.len() - 1);
        &self.axis[number].2
    }
}

/// Rules of 1, 3, 5 ... nodes on the axis, with the distances from which on each is accurate enough.
fn axis_rules(inner: f64, outer: f64, length: f64, accuracy: f64) -> Vec<(f64, f64, AxialRule)> {
    let extent = outer.hypot(0.5 * length);
    let measured = Measured::new(inner, outer, length);
    (1..=AxialRule::MOST_NODES)
        .step_by(2)
        .map(|nodes| {
            let rule = AxialRule::new(inner, outer, length, nodes);
            let margin = match &measured {
                Some(measured) if nodes >= MANY_NODES => measured.bound_over_error(&rule),
                _ => BOUND_OVER_ERROR,
            };
            // Bisection of the ratio of extent to distance, from infinitely far to touching.
            let least = |bound: f64| {
                extent / bisect([0.0, 1.0], BISECTIONS, |ratio| rule.error(extent / ratio) <= bound)[0]
            };
            (least(accuracy), least(margin * SHARE * accuracy), rule)
        })
        .collect()
}

/// Two equal rings close to each other, and the wrench of one on the other in several poses.
struct Measured {
    ring: AxialSource,
    poses: Vec<(Pose, Wrench)>,
}

impl Measured {
    /// Measures rings of these dimensions, m; `None` if the dimensions are out of range.
    fn new(inner: f64, outer: f64, length: f64) -> Option<Self> {
        let ring = AxialSource::new(inner, outer, length, 1.0).ok()?;
        let height = 0.5 * length + outer.hypot(0.5 * length) / NEAREST;
        let poses = CLOSE.iter().filter_map(|&[tilt, aside]| {
            let rotation = Rotation3::from_axis_angle(&Vector3::y_axis(), tilt).into_inner();
            let pose = Pose { position: Vector3::new(aside * outer, 0.0, height), rotation };
            ring.wrench_on(&ring, &pose, MEASURED_TO).ok().map(|wrench| (pose, wrench))
        });
        Some(Self { poses: poses.collect(), ring })
    }

    /// Smallest ratio of a rule's error bound to its error, from [`BOUND_OVER_ERROR`] to [`MOST_BOUND_OVER_ERROR`].
    fn bound_over_error(&self, rule: &AxialRule) -> f64 {
        let ring = &self.ring;
        let each = self.poses.iter().filter_map(|(pose, exact)| {
            let mut got = Wrench { force: Vector3::zeros(), torque: Vector3::zeros() };
            for (height, volume) in rule.points() {
                let arm = pose.axis() * height;
                let (field, gradient) = ring.field_gradient(&(pose.position + arm)).ok()?;
                let moment = pose.axis() * (ring.remanence() * volume / VACUUM_PERMEABILITY);
                let force = gradient * moment;
                got.force += force;
                got.torque += arm.cross(&force) + moment.cross(&field);
            }
            let error = relative_difference(&got, exact, 0.0, ring.outer_radius());
            Some(rule.error(ring.distance(&pose.position)) / (OTHERS * error))
        });
        each.fold(MOST_BOUND_OVER_ERROR, f64::min).max(BOUND_OVER_ERROR)
    }
}
