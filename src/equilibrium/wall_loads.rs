//! Loads of the vessel's wall on the chain: on its arcs, on the rims of its rings and on its tip.

use super::friction::{Pressure, Where};
use super::grip::Place;
use super::potential::Potential;
use super::terms::Touch;
use super::wall_contacts::{ArcPart, Site, WallContact};
use crate::numerics::quadrature::gauss_legendre;

/// Gauss points of a part of an arc in contact.
const POINTS: usize = 4;

impl Potential<'_> {
    /// Adds the loads of the wall; returns the energy of those that are not on nodes.
    pub(super) fn load_walls(&mut self, unknowns: &[f64]) -> f64 {
        self.work.walls.contacts.clear();
        self.work.walls.on_nodes.clear();
        self.work.walls.friction.clear();
        self.work.friction.pressures.clear();
        if !self.terms.walls.exist() {
            return 0.0;
        }
        self.load_rims();
        self.load_tip();
        self.load_arcs(unknowns) + self.load_friction(unknowns)
    }

    fn load_rims(&mut self) {
        let (walls, mut found) = (self.terms.walls, Vec::new());
        for (number, body) in self.chain.rings.iter().enumerate() {
            let node = self.work.nodes[body.node];
            for (rim, height) in [0.0, body.ring.length].into_iter().enumerate() {
                walls.rim(&node, height, body.ring.outer_radius, &mut found);
                for touch in found.drain(..) {
                    self.load_node(body.node, (Site::Ring(number), Place::Rim(number, rim)), &touch);
                }
            }
        }
    }

    fn load_tip(&mut self) {
        let last = self.chain.elements.len();
        let Some(radius) = self.chain.round_end() else { return };
        let touch = self.terms.walls.tip(&self.work.nodes[last].position, radius);
        if let Some(touch) = touch.filter(|touch| touch.depth > 0.0) {
            self.load_node(last, (Site::Tip, Place::Tip), &touch);
        }
    }

    fn load_node(&mut self, node: usize, (site, place): (Site, Place), touch: &Touch) {
        self.work.load_node(self.chain, node, (touch.load, touch.stiffness));
        self.work.walls.contacts.push(WallContact::new(site, touch));
        self.work.friction.press(Pressure { on: Where::At(place), force: -touch.load.force, arm: touch.arm });
    }

    fn load_arcs(&mut self, unknowns: &[f64]) -> f64 {
        let Some(surface) = self.surface else { return 0.0 };
        let mut parts = std::mem::take(&mut self.work.walls.parts);
        self.find_arcs(surface, unknowns, &mut parts);
        let (places, weights) = gauss_legendre(POINTS);
        let (mut energy, work) = (0.0, &mut *self.work);
        for ArcPart { on: (k, piece), ends: [from, to], deepest, arc } in &parts {
            let (element, amplitudes, node) =
                (&self.chain.elements[*k], self.chain.part(*k, unknowns), work.nodes[*k]);
            let (surface, half) = (&surface.elements[*k], 0.5 * (to - from));
            let growth = work.configurations[*k].growth;
            for (x, weight) in places.iter().zip(&weights) {
                let row = self.chain.tables()[*k].row(*piece, from + half * (1.0 + x));
                let frame = work.configurations[*k].frame_at(element, &row, amplitudes);
                let point = node.transform(&frame.pose.position);
                let radius = surface[*piece].radius;
                let touch = self.terms.walls.rod(&point, radius, growth * half * weight);
                let Some(touch) = touch.filter(|touch| touch.depth > 0.0) else { continue };
                energy += touch.load.energy;
                // The part is deeper in the wall between the points than at them.
                let contact = WallContact::new(Site::Arc(*arc), &touch);
                work.walls.contacts.push(WallContact { depth: touch.depth.max(*deepest), ..contact });
                let on = Where::Along(*k, *piece, row.arc_length);
                work.friction.press(Pressure { on, force: -touch.load.force, arm: touch.arm });
                work.load_row(self.chain, *k, (row, frame), (touch.load, touch.stiffness));
            }
        }
        work.walls.parts = parts;
        energy
    }
}
