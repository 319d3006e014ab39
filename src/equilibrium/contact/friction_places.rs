//! Material places of the chain at which friction acts, and the shares that they take of the wall's normal forces.

use super::friction::Where;
use super::friction_contact::Place;
use super::surface::Surface;
use crate::equilibrium::model::{Chain, Workspace};
use crate::geometry::Pose;
use crate::rod::{Configuration, Row};

/// Distance of two places of a shaft, m.
const SPACING: f64 = 1.5e-3;

/// The frame on which a place is.
pub(crate) enum Carrier {
    Node(usize),
    /// On an element, at this row of its tables.
    Row(usize, Row),
}

/// A shape of the chain, and where all its places are.
pub(crate) struct Placing<'a> {
    pub(crate) chain: &'a Chain,
    pub(crate) surface: &'a Surface,
    pub(crate) nodes: &'a [Pose],
    pub(crate) configurations: &'a [Configuration],
    pub(crate) unknowns: &'a [f64],
    pub(crate) growth: f64,
}

/// A shape that is kept while the workspace goes on to others.
#[derive(Debug, Clone)]
pub(crate) struct KeptShape {
    nodes: Vec<Pose>,
    configurations: Vec<Configuration>,
    unknowns: Vec<f64>,
    growth: f64,
}

impl KeptShape {
    /// The shape placed last.
    pub(crate) fn of(work: &Workspace) -> Self {
        Self {
            nodes: work.nodes.clone(),
            configurations: work.configurations.clone(),
            unknowns: work.placed.clone(),
            growth: work.growth,
        }
    }

    pub(crate) fn placing<'a>(&'a self, chain: &'a Chain, surface: &'a Surface) -> Placing<'a> {
        let Self { nodes, configurations, unknowns, growth } = self;
        Placing { chain, surface, nodes, configurations, unknowns, growth: *growth }
    }
}

impl Place {
    /// The ring that the place is on.
    pub(crate) fn ring(self) -> Option<usize> {
        if let Self::Rim(ring, _) = self { Some(ring) } else { None }
    }

    /// Its distance behind the shaft's distal end, m, if it is on the shaft.
    pub(crate) fn behind(self) -> Option<f64> {
        if let Self::Shaft(number) = self { Some(number as f64 * SPACING) } else { None }
    }

    /// The frame of the place for a shaft grown by `growth`; `None` for one outside the port.
    pub(crate) fn carrier(self, chain: &Chain, surface: &Surface, growth: f64) -> Option<Carrier> {
        Some(match self {
            Self::Shaft(_) => {
                let along = chain.inserted(1.0) - self.behind()? / growth;
                if along < 0.0 {
                    return None;
                }
                let length = chain.elements[0].length;
                #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "a small count")]
                let k = ((along / length) as usize).min(chain.shaft - 1);
                Carrier::Row(k, chain.tables()[k].row(0, (along - k as f64 * length).min(length)))
            }
            Self::Skin(k, piece, number) => {
                Carrier::Row(k, surface.elements.get(k)?.get(piece)?.places.get(number)?.clone())
            }
            Self::Rim(ring, _) => Carrier::Node(chain.rings.get(ring)?.node),
            Self::Tip => Carrier::Node(chain.elements.len()),
        })
    }
}

impl<'a> Placing<'a> {
    /// The shape placed last.
    pub(super) fn of(work: &'a Workspace, chain: &'a Chain, surface: &'a Surface) -> Self {
        let Workspace { nodes, configurations, placed: unknowns, growth, .. } = work;
        Self { chain, surface, nodes, configurations, unknowns, growth: *growth }
    }

    /// The frame of a place, world axes; `None` for one outside the port.
    pub(crate) fn frame(&self, place: Place) -> Option<Pose> {
        Some(match place.carrier(self.chain, self.surface, self.growth)? {
            Carrier::Node(node) => self.nodes[node],
            Carrier::Row(k, row) => {
                let amplitudes = self.chain.part(k, self.unknowns);
                let local = self.configurations[k].pose_at(&self.chain.elements[k], &row, amplitudes);
                self.nodes[k].compose(&local)
            }
        })
    }

    /// Frame of a place; one outside the port is on the straight line behind that.
    pub(crate) fn frame_or_outside(&self, place: Place) -> Pose {
        let port = self.nodes[0];
        let outside = place.behind().map_or(0.0, |behind| self.chain.inserted(self.growth) - behind);
        self.frame(place).unwrap_or_else(|| port.advanced(outside))
    }

    /// The one or two places that take a normal force, with their shares, whose sum is 1.
    pub(crate) fn shares(&self, on: Where) -> [(Place, f64); 2] {
        let (k, piece, s) = match on {
            Where::At(place) => return [(place, 1.0), (place, 0.0)],
            Where::Along(k, piece, s) => (k, piece, s),
        };
        if k < self.chain.shaft {
            let length = self.chain.inserted(self.growth);
            let behind = length - (k as f64 * self.chain.elements[k].length + s) * self.growth;
            let (number, part) = parts(behind / SPACING);
            // What is nearer to the port than the last place inside belongs to that.
            let inside = (number + 1) as f64 * SPACING <= length;
            let part = if inside { part } else { 0.0 };
            return [(Place::Shaft(number), 1.0 - part), (Place::Shaft(number + 1), part)];
        }
        let places = &self.surface.elements[k][piece].places;
        let last = places.len() - 1;
        let (from, to) = (places[0].arc_length, places[last].arc_length);
        let (number, part) = parts((s - from) / (to - from) * last as f64);
        let (number, part) = if number < last { (number, part) } else { (last - 1, 1.0) };
        [(Place::Skin(k, piece, number), 1.0 - part), (Place::Skin(k, piece, number + 1), part)]
    }
}

/// Whole and fractional part of a number, which counts as 0 if it is negative.
fn parts(x: f64) -> (usize, f64) {
    let whole = x.max(0.0).floor();
    #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "a small count")]
    let number = whole as usize;
    (number, (x - whole).clamp(0.0, 1.0))
}
