//! The note on a device that is bent, or has no shape, without any load.

use mcm::design::{Specification, SpiralKind};
use mcm::manipulator::{Collapse, Outputs, Scene, rings_attract};

use crate::verdict;

/// Tip angle above which an unloaded shape is explained, rad.
const REST_ANGLE: f64 = core::f64::consts::PI / 180.0;

/// Why spirals on one side of the axis bend a device at rest.
const ASIDE: &str = "rings attract the spirals beside them off the axis, and the bends of the segments add up; \
    design.spiral_start_deg turns and design.spiral = \"alternating\" mirrors them so that they cancel";

/// Why a device that is symmetric about its axis is bent at rest.
const BUCKLED: &str = "the device is symmetric about its axis, but the attraction of its rings buckles it; \
    a larger design.helix.shore_a or a smaller design.ring.remanence_t leaves it straight";

/// Why the manipulator is shut, or bent although nothing acts on it; empty where something does or it is nearly straight.
pub(super) fn rest_note(scene: &Scene, outputs: &Outputs, collapse: Option<&Collapse>) -> String {
    if let Some(shut) = collapse {
        return format!("\nnote: {shut}\n");
    }
    let loaded = scene.inputs != scene.inputs.without_loads();
    let held = outputs.wall.as_ref().is_some_and(|wall| wall.count > 0);
    let bent = verdict::converged(outputs) && outputs.tip_angle > REST_ANGLE;
    if loaded || held || !bent || !rings_attract(&scene.specification, outputs.interaction) {
        return String::new();
    }

    let why = if is_axisymmetric(&scene.specification) { BUCKLED } else { ASIDE };
    format!("\nnote: bent at rest, without any load: {why}\n")
}

/// Whether the spirals of a device are spread evenly about its axis.
fn is_axisymmetric(specification: &Specification) -> bool {
    matches!(specification, Specification::Segmented(chain) if chain.spiral == SpiralKind::Axisymmetric)
}

#[cfg(test)]
mod tests {
    use mcm::equilibrium::Interaction;

    use super::*;

    #[test]
    fn spirals_are_blamed_only_where_they_are_on_one_side() -> Result<(), mcm::error::Error> {
        let note = |spiral: &str| {
            let scene = Scene::parse(&format!("[design]\nspiral = \"{spiral}\""), "bent")?;
            let straight = scene.manipulator(2)?.outputs().clone();
            let bent = Outputs { tip_angle: 0.5, interaction: Interaction::Full, ..straight };
            Ok::<String, mcm::error::Error>(rest_note(&scene, &bent, None))
        };
        assert!(note("helical")?.contains("spirals"));
        let axisymmetric = note("axisymmetric")?;
        assert!(axisymmetric.contains("bent at rest") && axisymmetric.contains("buckles"), "{axisymmetric}");
        assert!(!axisymmetric.contains("spiral"), "{axisymmetric}");
        Ok(())
    }
}
