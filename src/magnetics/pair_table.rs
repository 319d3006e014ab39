//! The quadrature of the energy of two magnets: as few nodes as their distance and the accuracy allow.
//!
//! Nodes on the axis of one of them do far away. Close by they would stand for an expansion of the other one's field that
//! does not converge there, and the magnetic charges on the faces take over.

use super::axial_rule::AxialRule;
use super::axial_source::AxialSource;
use super::face_rule::FaceRule;
use crate::geometry::Pose;

/// Bisections of the distance from which on a rule is accurate enough.
const BISECTIONS: usize = 40;

/// How often the bound of the last rule on the axis, the error for a dipole at the nearest point of the other ring, exceeds
/// the error of force and torque between two rings: measured for the paper's, where the bound is 1e-5 to 1e-4.
const BOUND_OVER_ERROR: f64 = 2.8;

/// Part of the accuracy that is asked for of the faces: force and torque of close pairs are to be as good as their energy.
const FACE_SHARE: f64 = 0.1;

/// Largest distance of a face from the other magnet's edges for which there is a rule, in outer radii.
const FARTHEST: f64 = 4.0;

/// Rules for each halving of that distance.
const PER_OCTAVE: f64 = 4.0;

/// Number of these rules: the last is for a fortieth of the outer radius.
const LEVELS: i32 = 30;

/// How the energy of a magnet in the field of another one is summed up.
#[derive(Debug, Clone, Copy)]
pub enum PairRule<'a> {
    /// By dipoles at nodes on its axis.
    Axis(&'a AxialRule),
    /// By charges at nodes on its two faces, where its magnetisation enters and where it leaves.
    Faces([&'a FaceRule; 2]),
}

/// All rules of one magnet.
#[derive(Debug, Clone, PartialEq)]
pub struct PairTable {
    inner: f64,
    outer: f64,
    length: f64,
    /// Fewest nodes first, each with the distances (m) of the nearest source from which on it is accurate enough: for a
    /// field of given size, and for that of another ring, which decays.
    axis: Vec<(f64, f64, AxialRule)>,
    /// By the distance (m) from the other magnet's edges from which on each rule is accurate enough, fewest nodes first.
    faces: Vec<(f64, FaceRule)>,
}

impl PairTable {
    /// For an annular cylinder of these radii and this length (m), magnetised along its axis.
    ///
    /// `accuracy` bounds the error of the energy, relative to that of two dipoles as far apart as the magnet is wide. By
    /// faces, force and torque are good to a tenth of it, relative to `|F| + |T|/a` and `|F| a + |T|` with the outer radius
    /// `a`, down to a fortieth of `a` between a face and the other magnet's edges.
    ///
    /// ```
    /// use mcm::geometry::Pose;
    /// use mcm::magnetics::{AxialSource, PairRule, PairTable};
    /// let ring = AxialSource::new(0.75e-3, 2.0e-3, 1.0e-3, 1.35)?;
    /// let table = PairTable::new(0.75e-3, 2.0e-3, 1.0e-3, 1e-5);
    /// let rule = |z| Pose::new([0.0, 0.0, z], [1.0, 0.0, 0.0, 0.0]).map(|pose| table.choose(&ring, &pose));
    /// assert!(matches!(table.rule(rule(5.0e-3)?), PairRule::Axis(_)));
    /// assert!(matches!(table.rule(rule(1.1e-3)?), PairRule::Faces(_)));
    /// # Ok::<(), mcm::error::Error>(())
    /// ```
    #[must_use]
    pub fn new(inner: f64, outer: f64, length: f64, accuracy: f64) -> Self {
        let faces = (0..LEVELS).map(|level| {
            let distance = outer * FARTHEST * (-f64::from(level) / PER_OCTAVE).exp2();
            (distance, FaceRule::new(inner, outer, distance, FACE_SHARE * accuracy))
        });
        let axis = axis_rules(inner, outer, length, accuracy);
        Self { inner, outer, length, axis, faces: faces.collect() }
    }

    /// Whether it is that of a magnet of these radii and this length, m.
    #[must_use]
    pub fn is_of(&self, inner: f64, outer: f64, length: f64) -> bool {
        (self.inner, self.outer, self.length) == (inner, outer, length)
    }

    /// How many rules there are for a pair.
    #[must_use]
    pub fn len(&self) -> usize {
        self.axis.len() + self.faces.len() * self.faces.len()
    }

    /// Whether there are none, which no table has.
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
        let level = |height: f64| {
            let distance = source.edge_distance(&pose.advanced(height), self.inner, self.outer);
            self.faces.iter().position(|(least, _)| *least <= distance).unwrap_or(self.faces.len() - 1)
        };
        let half = 0.5 * self.length;
        self.axis.len() + level(-half) * self.faces.len() + level(half)
    }

    /// The rule of that number; beyond the last it is the last.
    #[must_use]
    pub fn rule(&self, number: usize) -> PairRule<'_> {
        match number.min(self.len() - 1).checked_sub(self.axis.len()) {
            None => PairRule::Axis(&self.axis[number].2),
            Some(levels) => {
                let count = self.faces.len();
                PairRule::Faces([&self.faces[levels / count].1, &self.faces[levels % count].1])
            }
        }
    }

    /// The rule on the axis in a field of given size whose sources are `reach` (m) away: the last one if none is accurate
    /// enough.
    #[must_use]
    pub fn external(&self, reach: f64) -> &AxialRule {
        let number = self.axis.iter().position(|entry| entry.0 <= reach).unwrap_or(self.axis.len() - 1);
        &self.axis[number].2
    }
}

/// Rules of 1, 3, 5 ... nodes on the axis, with the distances from which on each is accurate.
fn axis_rules(inner: f64, outer: f64, length: f64, accuracy: f64) -> Vec<(f64, f64, AxialRule)> {
    let extent = outer.hypot(0.5 * length);
    (1..=AxialRule::MOST_NODES)
        .step_by(2)
        .map(|nodes| {
            let rule = AxialRule::new(inner, outer, length, nodes);
            let bound = if nodes == AxialRule::MOST_NODES { BOUND_OVER_ERROR * accuracy } else { accuracy };
            // The energy of two dipoles falls with the cube of their distance.
            let field = reach_of(|ratio| rule.error(extent / ratio) <= accuracy);
            let pair = reach_of(|ratio| rule.error(extent / ratio) * (2.0 * ratio).powi(3) <= bound);
            (extent / field, extent / pair, rule)
        })
        .collect()
}

/// Bisects the ratio of extent to distance, between infinitely far and touching, up to which `holds`.
fn reach_of(holds: impl Fn(f64) -> bool) -> f64 {
    let (mut far, mut near) = (0.0, 1.0);
    for _ in 0..BISECTIONS {
        let middle = 0.5 * (near + far);
        if holds(middle) {
            far = middle;
        } else {
            near = middle;
        }
    }
    far
}
