//! Loads of friction on the chain.

use super::friction_places::Carrier;
use super::potential::Potential;
use crate::rod::Load;

impl Potential<'_> {
    /// Adds the loads of friction, as remembered; returns the energy of those that are not on nodes.
    pub(super) fn load_friction(&mut self, unknowns: &[f64]) -> f64 {
        let Some(surface) = self.surface.filter(|_| self.work.friction.acts()) else { return 0.0 };
        let grips = std::mem::take(&mut self.work.friction.memory.grips);
        let (mut energy, work) = (0.0, &mut *self.work);
        let coefficient = work.friction.coefficient;
        for grip in &grips {
            match grip.place.carrier(self.chain, surface, work.growth) {
                Some(Carrier::Node(node)) => {
                    let (load, stiffness) = grip.load(&work.nodes[node], coefficient);
                    work.load_node(self.chain, node, (load, stiffness));
                    work.walls.friction.push((grip.place.ring(), -load.force));
                }
                Some(Carrier::Row(k, row)) => {
                    let element = &self.chain.elements[k];
                    let frame = work.configurations[k].frame_at(element, &row, self.chain.part(k, unknowns));
                    let node = work.nodes[k];
                    let (load, stiffness) = grip.load(&node.compose(&frame.pose), coefficient);
                    energy += load.energy;
                    work.walls.friction.push((None, -load.force));
                    // Unlike the energy of a line load, this one does not grow with the shaft.
                    work.load_row(self.chain, k, (row, frame), (Load { energy: 0.0, ..load }, stiffness));
                }
                None => {}
            }
        }
        work.friction.memory.grips = grips;
        energy
    }
}
