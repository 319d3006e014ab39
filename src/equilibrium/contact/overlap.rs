//! Contact: overlap of rings with one another, and of the whole manipulator with magnets and coils.

use nalgebra::Vector3;

use super::bodies::{Body, Contact};
use crate::equilibrium::model::{Chain, Inputs, Interaction, Model, RingBody, Settings, Workspace, overlap};
use crate::geometry::Pose;
use crate::magnetics::{Outline, Source, SourceName, Sources};
use crate::numerics::maximum::largest;

/// Number of parts of an element at whose ends its sections are tested.
const PARTS: usize = 16;

/// Upper bound of an element's stretched length, relative to its unstrained length, in the test whether it is far from a
/// magnet: the model's strains are less than a tenth.
const STRETCHED: f64 = 2.0;

/// Depth below a magnet's surface, relative to the radius, that a section may have by rounding.
const TOUCHING: f64 = 1e-9;

/// Chain with the poses of its nodes in the world.
pub(crate) struct Placed<'a> {
    pub(crate) chain: &'a Chain,
    pub(crate) nodes: &'a [Pose],
}

impl Model<'_> {
    /// The deepest contact at the shape placed last, at these inputs.
    pub(crate) fn contact(&self, inputs: &Inputs, work: &Workspace) -> Option<Contact> {
        let placed = Placed { chain: self.chain, nodes: &work.nodes };
        placed.contact(self.settings, self.sources, inputs, |k, s| {
            let element = &self.chain.elements[k];
            let amplitudes = self.chain.part(k, &work.placed);
            work.nodes[k].compose(&work.configurations[k].pose_at(element, &element.row(s), amplitudes))
        })
    }
}

impl Placed<'_> {
    /// The deepest contact; `section` gives the pose of an element's section at an arc length (m) from the element's
    /// start.
    ///
    /// Contact among rings is tested where rings interact. A magnet of strength 0 counts as absent.
    pub(crate) fn contact(
        &self,
        settings: &Settings,
        sources: &Sources,
        inputs: &Inputs,
        section: impl Fn(usize, f64) -> Pose,
    ) -> Option<Contact> {
        let mut deepest = None;
        if settings.interaction != Interaction::None {
            self.among_rings(&mut deepest);
        }
        for (number, kind) in sources.list().iter().enumerate() {
            let placed = inputs.sources.get(number);
            if let Some(placed) = placed.filter(|placed| sources.is_there(number, placed.strength)) {
                self.with_source((sources.name(number), kind, &placed.pose), &section, &mut deepest);
            }
        }
        deepest
    }

    fn among_rings(&self, deepest: &mut Option<Contact>) {
        for (i, first) in self.chain.rings.iter().enumerate() {
            let welded = |other: &RingBody| other.node == first.node;
            let others = self.chain.rings.iter().enumerate().skip(i + 1);
            for (j, second) in others.filter(|(_, other)| !welded(other)) {
                let depth = overlap(first, &self.nodes[first.node], second, &self.nodes[second.node]);
                add(deepest, Contact { first: Body::Ring(i), second: Body::Ring(j), depth });
            }
        }
    }

    fn with_source(
        &self,
        (source, magnet, at): (SourceName, &Source, &Pose),
        section: impl Fn(usize, f64) -> Pose,
        deepest: &mut Option<Contact>,
    ) {
        let local = |pose: &Pose| at.rotation.tr_mul(&(pose.position - at.position));
        let distance = |pose: &Pose| magnet.distance(&local(pose));
        let reach = magnet.unknown_within();
        if reach > 0.0 {
            let within = |pose: &Pose| reach - local(pose).norm();
            for (i, ring) in self.chain.rings.iter().enumerate() {
                let depth = within(&ring.centre(&self.nodes[ring.node]));
                add(deepest, with_part(Body::Ring(i), (source, 0), depth));
            }
            for (k, element) in self.chain.elements.iter().enumerate() {
                let depth = within(&section(k, 0.5 * element.length));
                add(deepest, with_part(Body::Segment(k), (source, 0), depth));
            }
        }
        for (i, ring) in self.chain.rings.iter().enumerate() {
            let centre = ring.centre(&self.nodes[ring.node]);
            let outline = ring.outline();
            if distance(&centre) < ring.ring.outer_radius + ring.half_length() {
                for (number, part) in magnet.parts().iter().enumerate() {
                    let depth = outline.depth_in(&part.outline, &seen(&centre, at, &part.centre));
                    add(deepest, with_part(Body::Ring(i), (source, number), depth));
                }
            }
        }
        for (k, (element, &radius)) in self.chain.elements.iter().zip(&self.chain.radii).enumerate() {
            let reach = STRETCHED * element.length + radius;
            if distance(&self.nodes[k + 1]) > reach {
                continue;
            }
            for (number, part) in magnet.parts().iter().enumerate() {
                let disc = Outline::cylinder(0.0, radius, 0.0);
                let level = |s: f64| {
                    let pose = seen(&section(k, s), at, &part.centre);
                    disc.level_in(&part.outline, &pose, reach).unwrap_or(f64::NEG_INFINITY)
                };
                // Between two sections nothing can be closer by more than their distance and their relative rotation, at
                // most half a turn in total.
                let worth = -(STRETCHED * element.length + core::f64::consts::PI * radius) / PARTS as f64;
                let (depth, _) = largest(level, [0.0, element.length], PARTS, worth);
                if depth > TOUCHING * radius {
                    add(deepest, with_part(Body::Segment(k), (source, number), depth));
                }
            }
        }
    }
}

/// The pose relative to a part whose centre is at `place` in the frame of the magnet, which is at `at` in the world.
fn seen(pose: &Pose, at: &Pose, place: &Vector3<f64>) -> Pose {
    let pose = pose.seen_from(at);
    Pose { position: pose.position - place, ..pose }
}

fn with_part(first: Body, (source, part): (SourceName, usize), depth: f64) -> Contact {
    Contact { first, second: Body::Source(source, part), depth }
}

/// Keeps the deeper contact.
fn add(deepest: &mut Option<Contact>, contact: Contact) {
    if contact.depth > deepest.map_or(0.0, |deepest| deepest.depth) {
        *deepest = Some(contact);
    }
}
