//! Loads of a vessel on the chain: of the wall on its arcs, the rims of its rings and its tip, and of friction.

use super::friction::{Friction, NormalForce, Where};
use super::friction_contact::Place;
use super::friction_places::Carrier;
use super::surface::Surface;
use super::wall_contacts::{ArcPart, Site, WallContact, WallContacts};
use super::walls::{Touch, Walls};
use crate::equilibrium::model::{Chain, Inputs, Workspace};
use crate::numerics::quadrature::gauss_legendre;
use crate::rod::Load;
use crate::vessel::Vessel;

/// Gauss points of a part of an arc in contact.
const POINTS: usize = 4;

/// A chain at one shape, placed in its workspace, while the loads of a vessel are added.
pub(super) struct Loading<'a> {
    pub(super) chain: &'a Chain,
    pub(super) unknowns: &'a [f64],
    pub(super) work: &'a mut Workspace,
    pub(super) wall: Walls<'a>,
    pub(super) surface: &'a Surface,
    contacts: &'a mut WallContacts,
    friction: &'a mut Friction,
}

impl<'a> Loading<'a> {
    pub(super) fn new(
        (vessel, surface): (&'a Vessel, &'a Surface),
        (chain, inputs, unknowns): (&'a Chain, &Inputs, &'a [f64]),
        work: &'a mut Workspace,
        (contacts, friction): (&'a mut WallContacts, &'a mut Friction),
    ) -> Self {
        Self { chain, unknowns, work, wall: Walls::new(vessel, inputs), surface, contacts, friction }
    }

    /// Adds all loads; returns the energy (J) of those that are not on nodes.
    pub(super) fn load(&mut self) -> f64 {
        self.load_rims();
        self.load_tip();
        self.load_arcs() + self.load_friction()
    }

    fn load_rims(&mut self) {
        let (wall, chain, mut found) = (self.wall, self.chain, Vec::new());
        for (number, body) in chain.rings.iter().enumerate() {
            let node = self.work.nodes[body.node];
            for (rim, height) in [body.start, body.end()].into_iter().enumerate() {
                wall.rim(&node, height, body.ring.outer_radius, &mut found);
                for touch in found.drain(..) {
                    self.load_node(body.node, (Site::Ring(number), Place::Rim(number, rim)), &touch);
                }
            }
        }
    }

    fn load_tip(&mut self) {
        let last = self.chain.elements.len();
        let Some(radius) = self.chain.round_end() else { return };
        let touch = self.wall.tip(&self.work.nodes[last].position, radius);
        if touch.depth > 0.0 {
            self.load_node(last, (Site::Tip, Place::Tip), &touch);
        }
    }

    fn load_node(&mut self, node: usize, (site, place): (Site, Place), touch: &Touch) {
        self.work.load_node(self.chain, node, (touch.load, touch.stiffness));
        self.contacts.all.push(WallContact::new(site, touch));
        self.friction.press(NormalForce { on: Where::At(place), force: -touch.load.force, arm: touch.arm });
    }

    fn load_arcs(&mut self) -> f64 {
        let mut parts = std::mem::take(&mut self.contacts.parts);
        self.find_arcs(&mut parts);
        let (places, weights) = gauss_legendre(POINTS);

        let mut energy = 0.0;
        for part in &parts {
            let [from, to] = part.ends;
            let half = 0.5 * (to - from);
            for (x, weight) in places.iter().zip(&weights) {
                energy += self.load_arc(part, from + half * (1.0 + x), half * weight);
            }
        }
        self.contacts.parts = parts;
        energy
    }

    /// Adds the load on a Gauss point at `arc_length` (m) that stands for a length `share` (m) of the unstretched element's tables.
    fn load_arc(&mut self, part: &ArcPart, arc_length: f64, share: f64) -> f64 {
        let (k, piece) = part.on;
        let (element, amplitudes) = (&self.chain.elements[k], self.chain.part(k, self.unknowns));
        let row = self.chain.tables()[k].row(piece, arc_length);
        let frame = self.work.configurations[k].frame_at(element, &row, amplitudes);
        let point = self.work.nodes[k].transform(&frame.pose.position);

        let radius = self.surface.elements[k][piece].radius_at(row.arc_length);
        let length = self.work.configurations[k].growth * share;
        let touch = self.wall.rod(&point, radius, length);
        if touch.depth.is_nan() || touch.depth <= 0.0 {
            return 0.0;
        }

        // The part is deeper in the wall between the points than at them.
        let contact = WallContact::new(Site::Arc(part.arc), &touch);
        self.contacts.all.push(WallContact { depth: touch.depth.max(part.deepest), ..contact });
        let on = Where::Along(k, piece, row.arc_length);
        self.friction.press(NormalForce { on, force: -touch.load.force, arm: touch.arm });
        self.work.load_row(self.chain, k, (row, frame), (touch.load, touch.stiffness));
        touch.load.energy
    }

    /// Adds the loads of friction, as remembered; returns the energy of those that are not on nodes.
    fn load_friction(&mut self) -> f64 {
        if !self.friction.acts() {
            return 0.0;
        }
        let coefficient = self.friction.coefficient;

        let mut energy = 0.0;
        for contact in &self.friction.memory.contacts {
            match contact.place.carrier(self.chain, self.surface, self.work.growth) {
                Some(Carrier::Node(node)) => {
                    let (load, stiffness) = contact.load(&self.work.nodes[node], coefficient);
                    self.work.load_node(self.chain, node, (load, stiffness));
                    self.contacts.friction.push((contact.place.ring(), -load.force));
                }
                Some(Carrier::Row(k, row)) => {
                    let (element, amplitudes) = (&self.chain.elements[k], self.chain.part(k, self.unknowns));
                    let frame = self.work.configurations[k].frame_at(element, &row, amplitudes);
                    let at = self.work.nodes[k].compose(&frame.pose);
                    let (load, stiffness) = contact.load(&at, coefficient);
                    energy += load.energy;
                    self.contacts.friction.push((None, -load.force));
                    // Unlike the energy of a line load, this one does not grow with the shaft.
                    let unscaled = Load { energy: 0.0, ..load };
                    self.work.load_row(self.chain, k, (row, frame), (unscaled, stiffness));
                }
                None => {}
            }
        }
        energy
    }
}
