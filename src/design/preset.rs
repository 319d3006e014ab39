//! The devices of Richter et al. as specifications.

use super::material::PARTICLE_DENSITY;
use super::modulus::Modulus;
use super::specification::{Backbone, Helix, RingMagnet, Segmented, Specification, SpiralKind, SpiralStart};

impl Helix {
    /// The helix of Table 1.
    #[must_use]
    pub fn paper() -> Self {
        Self {
            length: 4.0e-3,
            boundary_angle: 40.0_f64.to_radians(),
            radius: 2.0e-3,
            windings: 2.0,
            core_outer_radius: 0.95e-3,
            core_inner_radius: 0.75e-3,
            shore_a: 33.0,
            poisson: 0.4,
            volume_fraction: 0.25,
            particle_remanence: 1.0,
            density: None,
        }
    }
}

impl RingMagnet {
    /// The ring magnets of Table 1; as in the paper, demagnetisation by their own field is neglected.
    #[must_use]
    pub fn paper() -> Self {
        Self {
            length: 1.0e-3,
            remanence: 1.35,
            direction: None,
            recoil_permeability: 1.0,
            density: PARTICLE_DENSITY,
        }
    }
}

impl Segmented {
    /// The manipulator of Table 1 with `segments` segments, all rings, no backbone (as simulated there).
    #[must_use]
    pub fn paper(segments: usize) -> Self {
        Self {
            segments,
            base_magnet: true,
            tip_magnet: true,
            spiral: SpiralKind::Helical,
            spiral_start: SpiralStart::Same(0.0),
            helix: Helix::paper(),
            ring: RingMagnet::paper(),
            lists: Vec::new(),
            ring_directions: Vec::new(),
            backbone: None,
        }
    }
}

impl Specification {
    /// [`Segmented::paper`] as a specification.
    ///
    /// ```
    /// use mcm::design::{Design, Specification};
    /// let design = Design::new(Specification::paper(9))?;
    /// assert!((design.length() - 46.0e-3).abs() < 1e-15);
    /// # Ok::<(), mcm::error::Error>(())
    /// ```
    #[must_use]
    pub fn paper(segments: usize) -> Self {
        Self::Segmented(Segmented::paper(segments))
    }
}

impl Backbone {
    /// The silicone tube: diameters 1.5 mm and 0.5 mm, Shore A 50 by Eq. (14).
    #[must_use]
    pub fn silicone() -> Self {
        Self {
            outer_radius: 0.75e-3,
            inner_radius: 0.25e-3,
            modulus: Modulus::ShoreA(50.0),
            poisson: 0.4,
            density: 1000.0,
        }
    }

    /// The PTFE tube of the guidewire demonstration: diameters 1.48 mm and 1.40 mm.
    ///
    /// Modulus 5e8 Pa: the flexural modulus (ASTM D790) of the data sheet of Teflon PTFE (Chemours, typical
    /// properties), within the 4.0e8 to 5.5e8 Pa of Callister, *Materials Science and Engineering*, 7th ed., Table B.2.
    /// Density 2160 kg/m3: data sheets give 2130 to 2220. Poisson's ratio 0.46: Callister, Table B.3.
    #[must_use]
    pub fn ptfe() -> Self {
        Self {
            outer_radius: 0.74e-3,
            inner_radius: 0.70e-3,
            modulus: Modulus::Elastic(0.5e9),
            poisson: 0.46,
            density: 2160.0,
        }
    }
}
