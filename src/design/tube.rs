//! The tube through all bores: the backbone of segments, and the shaft behind them.

use super::area::annulus_area;
use super::material::Moduli;
use super::section::{Span, Stiffness};
use super::specification::Backbone;

/// Contribution of a backbone to every section.
pub(super) struct Tube {
    pub(super) stiffness: Stiffness,
    pub(super) line_density: f64,
}

impl Tube {
    pub(super) fn of(backbone: &Backbone) -> Self {
        let moduli = Moduli::bulk(backbone.modulus.elastic(), backbone.poisson);
        Self {
            stiffness: Stiffness::annulus(backbone.inner_radius, backbone.outer_radius, moduli),
            line_density: backbone.density * annulus_area(backbone.inner_radius, backbone.outer_radius),
        }
    }
}

impl Default for Tube {
    /// No backbone.
    fn default() -> Self {
        Self { stiffness: Span::plain().stiffness, line_density: 0.0 }
    }
}
