//! The devices that a magnet leads through the aorta, as scenes.

use crate::error::Error;
use crate::manipulator::Scene;
use crate::vessel::Aorta;

/// The nine segments; every second spiral is mirrored, as rings on a common tube do not turn.
const SEGMENTS: &str = "spiral = \"alternating\"\n";

/// The solid cylinder of the same length, diameter and moment (volume fraction 0.2).
const CYLINDER: &str = "kind = \"cylinder\"\nlength_mm = 46.0\nradius_mm = 2.0\nshore_a = 33.0\npoisson = 0.4\n\
                        volume_fraction = 0.2\nparticle_remanence_t = 1.0\n";

/// The silicone tube, 1.5 mm by 0.5 mm.
const SILICONE: &str = "outer_radius_mm = 0.75\ninner_radius_mm = 0.25\nshore_a = 40.0\npoisson = 0.45\n";

/// The PTFE tube for guidewires, 1.48 mm by 1.4 mm.
const PTFE: &str = "outer_radius_mm = 0.74\ninner_radius_mm = 0.7\nelastic_modulus_mpa = 500.0\npoisson = 0.45\n\
                    density_kg_m3 = 2200.0\n";

/// A wire of the paper's diameter, 0.89 mm, with the least of the moduli that Harrison et al. (2011,
/// <https://doi.org/10.1583/11-3592.1>) measured in bending.
const WIRE: &str = "[guidewire]\nradius_mm = 0.445\nelastic_modulus_mpa = 9500.0\n";

/// A device on its shaft, between walls of this coefficient of friction.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Case {
    /// Beginning of its columns' names.
    pub(super) name: &'static str,
    /// The device, in words.
    pub(super) device: &'static str,
    design: &'static str,
    tube: &'static str,
    /// Whether a guidewire follows up to the base of the device.
    pub(super) wired: bool,
    friction: f64,
}

const fn case(name: &'static str, device: &'static str) -> Case {
    Case { name, device, design: SEGMENTS, tube: SILICONE, wired: false, friction: 0.0 }
}

const SEGMENTED: Case = case("mcm", "nine segments");
const SOLID: Case = Case { design: CYLINDER, ..case("cylinder", "solid cylinder") };
const ON_PTFE: Case = Case { tube: PTFE, ..case("ptfe", "segments on PTFE") };

/// All devices.
pub(super) const CASES: [Case; 8] = [
    SEGMENTED,
    Case { name: "mcm_oiled", friction: 0.04, ..SEGMENTED },
    Case { name: "mcm_dry", friction: 1.0, ..SEGMENTED },
    SOLID,
    Case { name: "cylinder_oiled", friction: 0.04, ..SOLID },
    Case { name: "cylinder_dry", friction: 1.0, ..SOLID },
    ON_PTFE,
    Case { name: "ptfe_wire", device: "PTFE, guidewire", wired: true, ..ON_PTFE },
];

impl Case {
    /// Whether the walls are without friction.
    pub(super) fn slides(&self) -> bool {
        self.friction == 0.0
    }

    /// The friction, in words.
    pub(super) fn walls(&self) -> String {
        if self.slides() { "no friction".into() } else { format!("mu {}", self.friction) }
    }

    /// The scene: in the planar aorta, on a shaft that hangs free, at the level `rings`.
    ///
    /// # Errors
    /// None for the paper's designs.
    pub(super) fn scene(&self) -> Result<Scene, Error> {
        let Self { design, tube, friction, .. } = self;
        // A tube through the bores; a solid cylinder has none.
        let backbone = if *design == SEGMENTS { format!("[design.backbone]\n{tube}") } else { String::new() };
        let wire = if self.wired { WIRE } else { "" };
        let vessel = Aorta::planar().scene_text()?;
        let text = format!(
            "[design]\n{design}{backbone}[magnet]\n[feed]\nmode = \"force\"\n[feed.shaft]\n{tube}{wire}\
             [model]\ninteraction = \"rings\"\ntime_budget_s = 10.0\n\
             [vessel]\nwall_modulus_mpa = 1.0\nfriction = {friction}\n{vessel}"
        );
        Scene::parse(&text, self.name)
    }
}
