//! What the wall of a vessel does to the manipulator.

use nalgebra::Vector3;
use serde::{Deserialize, Serialize};

use super::wall_contacts::{Site, WallContacts};

/// Forces of the wall on the manipulator, world axes.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct WallForces {
    /// Number of separate contacts: each ring, each arc of soft material or shaft, and a round tip.
    pub count: usize,
    /// Total force with friction, N.
    pub force: Vector3<f64>,
    /// Sum of the magnitudes of all local normal forces, N.
    pub sum: f64,
    /// Normal force of the contact with the largest one, N.
    pub largest_force: f64,
    /// Largest depth in the wall, m.
    pub largest_indentation: f64,
    /// Force with friction on each ring, base to tip, N.
    pub rings: Vec<Vector3<f64>>,
    /// Place on the wall (m, the mean weighted by force) and force (N) of each separate contact.
    pub places: Vec<[Vector3<f64>; 2]>,
}

impl WallForces {
    /// The sum of these loads on a chain with so many rings.
    pub(crate) fn of(WallContacts { all: contacts, friction, .. }: &WallContacts, rings: usize) -> Self {
        let mut out = Self {
            count: 0,
            force: Vector3::zeros(),
            sum: 0.0,
            largest_force: 0.0,
            largest_indentation: 0.0,
            rings: vec![Vector3::zeros(); rings],
            places: Vec::new(),
        };
        for own in contacts.chunk_by(|a, b| a.site == b.site) {
            let force: Vector3<f64> = own.iter().map(|contact| contact.force).sum();
            let weight: f64 = own.iter().map(|contact| contact.force.norm()).sum();
            let middle: Vector3<f64> = own.iter().map(|contact| contact.at * contact.force.norm()).sum();
            // Without weight the force is too small to be told from zero.
            out.places.push([if weight > 0.0 { middle / weight } else { own[0].at }, force]);
            out.count += 1;
            out.force += force;
            out.largest_force = out.largest_force.max(force.norm());
            if let Site::Ring(number) = own[0].site {
                out.rings[number] = force;
            }
        }
        for (ring, force) in friction {
            out.force += force;
            if let Some(number) = ring {
                out.rings[*number] += force;
            }
        }
        for contact in contacts {
            out.sum += contact.force.norm();
            out.largest_indentation = out.largest_indentation.max(contact.depth);
        }
        out
    }
}
