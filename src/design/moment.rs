//! Relative magnetic moment of a manipulator, compared with a solid magnet of its size.

use super::helix::{SpiralVolume, annulus_area};
use super::limits;
use super::specification::Segmented;
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
    /// `J_ring` is [`Segmented::ring_polarisation`], the remanence `B_ring` unless the rings' recoil permeability
    /// differs from 1. Without magnetised rings (`B_ring = 0`) the last ratio refers to the particles' remanence.
    ///
    /// # Errors
    /// [`Error::Range`] naming the first quantity out of range.
    pub fn relative_moment(&self, spiral: SpiralVolume) -> Result<RelativeMoment, Error> {
        limits::segmented(self)?;
        let helix = &self.helix;
        let (segments, rings) = (self.segments as f64, self.ring_count() as f64);
        let composite = segments * helix.volumes(spiral)?.total();
        let particles = composite * helix.volume_fraction;
        let magnets = rings * annulus_area(helix.core_inner_radius, helix.radius) * self.ring.length;
        let whole = annulus_area(0.0, helix.radius) * (segments * helix.length + rings * self.ring.length);
        let volume = (magnets + composite) / whole;
        let magnetic_volume = (magnets + particles) / whole;
        let reference =
            if self.ring.remanence > 0.0 { self.ring.remanence } else { helix.particle_remanence };
        let moment = magnets * self.ring_polarisation() + particles * helix.particle_remanence;
        let remanent_moment = if reference > 0.0 { moment / (whole * reference) } else { 0.0 };
        Ok(RelativeMoment { volume, magnetic_volume, moment: magnetic_volume * volume, remanent_moment })
    }
}
