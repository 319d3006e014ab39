//! Relative magnetic moment of a manipulator, compared with a solid magnet of its size.

use super::area::annulus_area;
use super::checks;
use super::demagnetisation::polarisation;
use super::direction::Direction;
use super::helix::SpiralVolume;
use super::specification::{Helix, RingMagnet, Segmented};
use crate::error::Error;

/// Ratios to a solid cylindrical magnet of equal length and diameter; the first three are in `[0, 1]`.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct RelativeMoment {
    /// Relative absolute volume `V_rel` (Eq. 4).
    pub volume: f64,
    /// Relative magnetic volume `M_rel` (Eq. 5).
    pub magnetic_volume: f64,
    /// Relative magnetic moment `mu_rel = M_rel V_rel` (Eq. 6).
    pub moment: f64,
    /// Magnetic moment relative to that of the solid magnet with the rings' remanence. Eq. (5) considers volumes only
    /// and neglects that rings and particles differ in remanence.
    pub remanent_moment: f64,
}

impl Segmented {
    /// Number of rings of the chain: one between any two segments, and those at its ends.
    #[must_use]
    pub fn ring_count(&self) -> usize {
        self.segments.saturating_sub(1) + usize::from(self.base_magnet) + usize::from(self.tip_magnet)
    }

    /// Relative magnetic moment (Eq. 4 to 6), for the actual number of rings (`S + 1` in the paper).
    ///
    /// ```text
    /// V_rel = (rings V_mag + S V_mpc) / V_tot      M_rel = (rings V_mag + S Phi V_mpc) / V_tot
    /// mu_rel = M_rel V_rel                          V_tot = pi R^2 (S L + rings L_mag)
    /// remanent_moment = (rings V_mag J_ring + S Phi V_mpc B_particle) / (V_tot B_ring)
    /// ```
    ///
    /// Where segments or rings differ, sums take the place of the products. `J_ring` is [`Segmented::ring_polarisation`], the remanence `B_ring` unless the rings' recoil permeability
    /// differs from 1. Without magnetised rings (`B_ring = 0`) the last ratio refers to the particles' remanence.
    ///
    /// # Errors
    /// [`Error::Range`] naming the first quantity out of range.
    pub fn relative_moment(&self, spiral: SpiralVolume) -> Result<RelativeMoment, Error> {
        checks::segmented(self)?;
        let volume_of = |ring: &RingMagnet, helix: &Helix| {
            annulus_area(helix.core_inner_radius, helix.radius) * ring.length
        };
        let (mut composite, mut particles, mut magnets, mut moment, mut whole) = (0.0, 0.0, 0.0, 0.0, 0.0);
        for helix in self.helices() {
            let volume = helix.volumes(spiral)?.total();
            composite += volume;
            particles += volume * helix.volume_fraction;
            moment += volume * helix.volume_fraction * helix.particle_remanence;
            whole += annulus_area(0.0, helix.radius) * helix.length;
        }
        for (ring, helix) in self.ring_magnets() {
            magnets += volume_of(&ring, &helix);
            moment += volume_of(&ring, &helix) * polarisation(&ring, &helix, Direction::Axial).0;
            whole += annulus_area(0.0, helix.radius) * ring.length;
        }

        let volume = (magnets + composite) / whole;
        let magnetic_volume = (magnets + particles) / whole;
        let reference =
            if self.ring.remanence > 0.0 { self.ring.remanence } else { self.helix.particle_remanence };
        let remanent_moment = if reference > 0.0 { moment / (whole * reference) } else { 0.0 };
        Ok(RelativeMoment { volume, magnetic_volume, moment: magnetic_volume * volume, remanent_moment })
    }
}
