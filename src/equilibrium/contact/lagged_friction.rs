//! Friction from shape to shape: normal forces lag behind the shape, and stick points follow the places that slide.

use nalgebra::Vector3;

use super::friction::NormalForce;
use super::friction_contact::{FrictionContact, Place};
use super::friction_places::{Carrier, KeptShape, Placing};
use super::vessel_contact::VesselContact;
use crate::equilibrium::model::{Chain, Workspace};

/// Change of the friction forces from pass to pass at which they have settled, relative to the largest that they could be.
const SETTLED: f64 = 1e-4;

/// Change of a friction force at which it has settled, N: far below what matters.
const NOTHING: f64 = 1e-8;

/// Normal force (N) below which there is none: its square could underflow.
const LEAST: f64 = 1e-30;

impl VesselContact {
    /// The friction contacts under the normal forces of the shape evaluated last. Stick points of new ones are where their places were
    /// in the shape `from`.
    pub(crate) fn lagged(&self, chain: &Chain, work: &Workspace, from: &KeptShape) -> Vec<FrictionContact> {
        let (friction, surface) = (&self.friction, self.surface());
        let (here, from) = (Placing::of(work, chain, surface), from.placing(chain, surface));
        let earlier = &friction.memory.contacts;

        let mut out = Vec::new();
        for Sum { place, force, normal, arm } in summed(&friction.normal_forces, &here) {
            let Some(frame) = here.frame(place) else { continue };
            let (normal, arm) = (normal.normalize(), frame.rotation.tr_mul(&(arm / force)));
            let start = from.frame_or_outside(place);
            let known = earlier.binary_search_by_key(&place, |contact| contact.place);
            out.push(if let Ok(number) = known {
                let mut contact = earlier[number];
                contact.on_arm(&arm, &start.rotation);
                FrictionContact { normal, force, ..contact }
            } else {
                let stick_point = start.position + start.rotation * arm;
                FrictionContact { place, stick_point, arm, normal, force }
            });
        }
        out
    }

    /// Change of the friction forces at the present shape to those of `next`, relative to what counts as settled.
    pub(crate) fn change(&self, chain: &Chain, work: &Workspace, next: &[FrictionContact]) -> f64 {
        let coefficient = self.friction.coefficient;
        let here = Placing::of(work, chain, self.surface());
        let pull = |contact: &FrictionContact| {
            here.frame(contact.place).map_or_else(Vector3::zeros, |frame| contact.pull(&frame, coefficient))
        };

        // Both lists are in the order of their places; what is in one alone appears or disappears whole.
        let (mut change, mut largest) = (0.0, 0.0);
        let mut gone = self.friction.memory.contacts.iter().peekable();
        for contact in next {
            while let Some(lost) = gone.next_if(|old| old.place < contact.place) {
                change += pull(lost).norm();
            }
            let before = gone.next_if(|old| old.place == contact.place).map_or_else(Vector3::zeros, pull);
            change += (pull(contact) - before).norm();
            largest += coefficient * contact.force;
        }
        change += gone.map(|lost| pull(lost).norm()).sum::<f64>();
        change / (SETTLED * largest + NOTHING)
    }

    /// Return mapping of all stick points to the present shape.
    pub(crate) fn return_map(&mut self, chain: &Chain, work: &Workspace) {
        let mut contacts = std::mem::take(&mut self.friction.memory.contacts);
        let here = Placing::of(work, chain, self.surface());
        for contact in &mut contacts {
            if let Some(frame) = here.frame(contact.place) {
                contact.return_map(&frame);
            }
        }
        self.friction.memory.contacts = contacts;
    }

    /// Derivative of the energy of friction with respect to the inserted length, N: at fixed places of the shaft's curve, what
    /// holds on to its stick point moves along that curve.
    pub(crate) fn friction_push(&self, chain: &Chain, work: &Workspace) -> f64 {
        if !self.friction.acts() {
            return 0.0;
        }
        let (length, inserted) = (chain.inserted(1.0), chain.inserted(work.growth));

        let mut push = 0.0;
        for contact in &self.friction.memory.contacts {
            let Some(behind) = contact.place.behind() else { continue };
            let Some(Carrier::Row(k, row)) = contact.place.carrier(chain, self.surface(), work.growth) else {
                continue;
            };
            let (element, amplitudes) = (&chain.elements[k], chain.part(k, &work.placed));
            let configuration = &work.configurations[k];
            let (_, tangent) = configuration.curve_at(element, &row, amplitudes);
            let turning = configuration.turning_at(element, &row, amplitudes);

            let node = &work.nodes[k];
            let frame = node.compose(&configuration.pose_at(element, &row, amplitudes));
            let (load, _) = contact.load(&frame, self.friction.coefficient);
            let per_arc =
                load.force.dot(&(node.rotation * tangent)) + load.moment().dot(&(node.rotation * turning));
            push += per_arc * length * behind / (inserted * inserted);
        }
        push
    }
}

/// Normal forces on one place.
struct Sum {
    place: Place,
    /// Sum of their magnitudes, N.
    force: f64,
    /// Their sum, those to the other side turned round: opposite walls are alike for friction.
    normal: Vector3<f64>,
    /// Sum of magnitudes times arms, N m.
    arm: Vector3<f64>,
}

/// The normal forces, shared among the places and summed there, in the order of the places.
fn summed(normal_forces: &[NormalForce], here: &Placing<'_>) -> Vec<Sum> {
    let mut parts: Vec<Sum> = Vec::new();
    for NormalForce { on, force, arm } in normal_forces {
        for (place, share) in here.shares(*on) {
            let size = share * force.norm();
            if size > LEAST {
                parts.push(Sum { place, force: size, normal: force * share, arm: arm * size });
            }
        }
    }
    parts.sort_by_key(|sum| sum.place);

    let mut out: Vec<Sum> = Vec::new();
    for part in parts {
        match out.last_mut().filter(|last| last.place == part.place) {
            Some(last) => {
                let side = if last.normal.dot(&part.normal) < 0.0 { -1.0 } else { 1.0 };
                last.force += part.force;
                last.normal += part.normal * side;
                last.arm += part.arm;
            }
            None => out.push(part),
        }
    }
    out
}
