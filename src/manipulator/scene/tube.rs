//! Tables of tubes and what is in them: the backbone through all bodies, the shaft behind the base, the guidewire.

use serde::{Deserialize, Serialize};

use super::units::{MM_PER_M, PA_PER_MPA};
use crate::design::{Backbone, Guidewire, Modulus};
use crate::error::Error;

#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
#[cfg_attr(test, derive(schemars::JsonSchema))]
#[serde(deny_unknown_fields)]
pub(super) struct BackboneEntries {
    /// Outer radius of the tube.
    pub(super) outer_radius_mm: f64,
    /// Inner radius of the tube.
    pub(super) inner_radius_mm: f64,
    /// Shore A hardness; either this or `elastic_modulus_mpa`.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(super) shore_a: Option<f64>,
    /// Young's modulus; either this or `shore_a`.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(super) elastic_modulus_mpa: Option<f64>,
    /// Poisson's ratio.
    pub(super) poisson: f64,
    /// Density.
    #[serde(default = "water")]
    pub(super) density_kg_m3: f64,
}

/// Density of a polymer tube without filler, rounded, kg/m3.
fn water() -> f64 {
    1000.0
}

impl BackboneEntries {
    /// The tube of the table of this name.
    pub(super) fn si(self, table: &str) -> Result<Backbone, Error> {
        let modulus = match (self.shore_a, self.elastic_modulus_mpa) {
            (Some(hardness), None) => Modulus::ShoreA(hardness),
            (None, Some(modulus)) => Modulus::Elastic(modulus * PA_PER_MPA),
            _ => {
                return Err(Error::Unsupported(format!(
                    "{table} needs either shore_a or elastic_modulus_mpa, and not both"
                )));
            }
        };
        Ok(Backbone {
            outer_radius: self.outer_radius_mm / MM_PER_M,
            inner_radius: self.inner_radius_mm / MM_PER_M,
            modulus,
            poisson: self.poisson,
            density: self.density_kg_m3,
        })
    }
}

#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
#[cfg_attr(test, derive(schemars::JsonSchema))]
#[serde(deny_unknown_fields)]
pub(super) struct GuidewireEntries {
    /// Radius of the wire.
    pub(super) radius_mm: f64,
    /// Young's modulus.
    pub(super) elastic_modulus_mpa: f64,
    /// Arc length from the port, or from the base, that the wire reaches.
    #[serde(default)]
    pub(super) insertion_mm: f64,
}

impl GuidewireEntries {
    pub(super) fn si(self) -> Guidewire {
        Guidewire {
            radius: self.radius_mm / MM_PER_M,
            elastic_modulus: self.elastic_modulus_mpa * PA_PER_MPA,
        }
    }
}
