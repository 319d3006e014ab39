//! Parameters and constants of the design.

use core::f64::consts::TAU;

use super::super::dependency::Known;
use super::super::host_values::HostValues;
use super::super::units::{ANGLE, DENSITY, HARDNESS, LENGTH, MODULUS, RATIO, REMANENCE};
use super::super::value::{DataType, Enumeration, Item, Value};
use super::super::variable::Access;
use super::rows::{Draft, Rows};
use super::{Counts, access};
use crate::design::CylinderMaterial::{self, Bulk, Composite};
use crate::design::Specification::{Cylinder, Sections, Segmented};
use crate::design::{self, Modulus, SpiralKind, quantities as of};

/// How the spirals are arranged.
static SPIRAL: Enumeration = Enumeration {
    name: "Spiral",
    description: "How the spirals are arranged",
    items: &[
        Item { name: "helical", value: 0, description: "All are right-handed, as built" },
        Item { name: "axisymmetric", value: 1, description: "The sector's area is spread over the circle" },
        Item { name: "alternating", value: 2, description: "Every second spiral is mirrored: left-handed" },
    ],
};

/// Reads and sets one number of one kind of design. Only the rows of the packed design's own kind are written, so that the
/// NaN is never read.
macro_rules! design_access {
    ($design:pat => $number:expr) => {
        Access::Real {
            get: |values, _| match &values.specification {
                $design => $number,
                _ => f64::NAN,
            },
            set: |values, _, value| {
                if let $design = &mut values.specification {
                    $number = value;
                }
            },
        }
    };
}

/// Reads and sets a density that is optional: 0 stands for the density that follows from the composition.
macro_rules! density_access {
    ($design:pat => $density:expr) => {
        Access::Real {
            get: |values, _| match &values.specification {
                $design => $density.unwrap_or(0.0),
                _ => f64::NAN,
            },
            set: |values, _, value| {
                if let $design = &mut values.specification {
                    $density = (value != 0.0).then_some(value);
                }
            },
        }
    };
}

impl Rows {
    pub(super) fn design_parameters(&mut self, start: &HostValues) {
        match &start.specification {
            Segmented(segmented) => {
                self.helix(segmented);
                self.spiral(segmented.segments);
                self.ring(segmented);
                self.backbone(&start.backbone.modulus);
            }
            Cylinder(cylinder) => self.cylinder(&cylinder.material),
            Sections(device) => self.sections(device),
        }
    }

    pub(super) fn design_constants(&mut self, start: &HostValues, counts: &Counts) {
        let count = |number: usize| Value::Integer(i32::try_from(number).unwrap_or(i32::MAX));
        let mut constant = |name, description, value| self.scalar(Draft::constant(name, description, value));
        if let Segmented(segmented) = &start.specification {
            constant("design.segments", "Number of segments", count(segmented.segments));
            let base = Value::Boolean(segmented.base_magnet);
            constant("design.base_magnet", "Whether the chain starts with a ring magnet", base);
            let tip = Value::Boolean(segmented.tip_magnet);
            constant("design.tip_magnet", "Whether the chain ends with a ring magnet", tip);
        }
        constant("design.rings", "Number of ring magnets", count(counts.rings));
        constant("shape.points", "Number of centreline points", count(counts.shape_points));
    }

    fn helix(&mut self, chain: &design::Segmented) {
        let length = design_access!(Segmented(s) => s.helix.length);
        let draft = Draft::holding(&of::HELIX_LENGTH, LENGTH, length).known(Known::BodyLength);
        self.for_each(chain, draft, &of::HELIX_LENGTH);
        let mut number = |quantity, unit, access| {
            self.for_each(chain, Draft::holding(quantity, unit, access), quantity);
        };
        number(&of::HELIX_BOUNDARY_ANGLE, ANGLE, design_access!(Segmented(s) => s.helix.boundary_angle));
        number(&of::HELIX_RADIUS, LENGTH, design_access!(Segmented(s) => s.helix.radius));
        number(&of::HELIX_WINDINGS, RATIO, design_access!(Segmented(s) => s.helix.windings));
        number(
            &of::HELIX_CORE_OUTER_RADIUS,
            LENGTH,
            design_access!(Segmented(s) => s.helix.core_outer_radius),
        );
        number(
            &of::HELIX_CORE_INNER_RADIUS,
            LENGTH,
            design_access!(Segmented(s) => s.helix.core_inner_radius),
        );

        number(&of::HELIX_SHORE_A, HARDNESS, design_access!(Segmented(s) => s.helix.shore_a));
        number(&of::HELIX_POISSON, RATIO, design_access!(Segmented(s) => s.helix.poisson));
        number(&of::HELIX_VOLUME_FRACTION, RATIO, design_access!(Segmented(s) => s.helix.volume_fraction));
        let particles = design_access!(Segmented(s) => s.helix.particle_remanence);
        number(&of::HELIX_PARTICLE_REMANENCE, REMANENCE, particles);
        number(&of::HELIX_DENSITY, DENSITY, density_access!(Segmented(s) => s.helix.density));
    }

    fn spiral(&mut self, segments: usize) {
        let spiral = Access::Enumeration {
            get: |values| match &values.specification {
                Segmented(s) => match s.spiral {
                    SpiralKind::Helical => 0,
                    SpiralKind::Axisymmetric => 1,
                    SpiralKind::Alternating => 2,
                },
                Cylinder(_) | Sections(_) => 0,
            },
            set: |values, number| {
                if let Segmented(s) = &mut values.specification {
                    s.spiral = match number {
                        0 => SpiralKind::Helical,
                        1 => SpiralKind::Axisymmetric,
                        2 => SpiralKind::Alternating,
                        _ => s.spiral,
                    };
                }
            },
        };

        let data_type = DataType::Enumeration(&SPIRAL);
        self.scalar(Draft::parameter("design.spiral", data_type, SPIRAL.description, spiral));

        let start = Access::Real {
            get: |values, index| match &values.specification {
                Segmented(s) => s.spiral_start.of(index.component),
                Cylinder(_) | Sections(_) => f64::NAN,
            },
            set: |values, index, value| {
                if let Segmented(s) = &mut values.specification {
                    s.spiral_start.set(index.component, s.segments, value);
                }
            },
        };

        let description = of::SPIRAL_START_ANGLE.description;
        let draft = Draft::parameter("design.spiral_start", ANGLE, description, start);
        self.array(segments, &draft.min(-TAU).max(TAU));
    }

    fn ring(&mut self, chain: &design::Segmented) {
        let length = design_access!(Segmented(s) => s.ring.length);
        let draft = Draft::holding(&of::RING_LENGTH, LENGTH, length).known(Known::RingLength);
        self.for_each(chain, draft, &of::RING_LENGTH);
        let mut number = |quantity, unit, access| {
            self.for_each(chain, Draft::holding(quantity, unit, access), quantity);
        };
        number(&of::RING_REMANENCE, REMANENCE, design_access!(Segmented(s) => s.ring.remanence));
        let permeability = design_access!(Segmented(s) => s.ring.recoil_permeability);
        number(&of::RING_RECOIL_PERMEABILITY, RATIO, permeability);
        number(&of::RING_DENSITY, DENSITY, design_access!(Segmented(s) => s.ring.density));
    }

    fn backbone(&mut self, stiffness: &Modulus) {
        let present = Access::Boolean {
            get: |values| values.backbone_present,
            set: |values, present| values.backbone_present = present,
        };
        let description = "Whether a tube runs through all bodies";
        self.scalar(Draft::parameter("design.backbone.present", DataType::Boolean, description, present));

        let mut number = |quantity, unit, access| self.scalar(Draft::holding(quantity, unit, access));
        number(&of::BACKBONE_OUTER, LENGTH, access!(|values| values.backbone.outer_radius));
        number(&of::BACKBONE_INNER, LENGTH, access!(|values| values.backbone.inner_radius));
        // The packed design states its stiffness in one of two ways, and the variable is named after that one.
        let get = |values: &HostValues, _| match values.backbone.modulus {
            Modulus::ShoreA(value) | Modulus::Elastic(value) => value,
        };
        match stiffness {
            Modulus::ShoreA(_) => {
                let set =
                    |values: &mut HostValues, _, value| values.backbone.modulus = Modulus::ShoreA(value);
                number(&of::BACKBONE_SHORE_A, HARDNESS, Access::Real { get, set });
            }
            Modulus::Elastic(_) => {
                let set =
                    |values: &mut HostValues, _, value| values.backbone.modulus = Modulus::Elastic(value);
                number(&of::BACKBONE_ELASTIC_MODULUS, MODULUS, Access::Real { get, set });
            }
        }
        number(&of::BACKBONE_POISSON, RATIO, access!(|values| values.backbone.poisson));
        number(&of::BACKBONE_DENSITY, DENSITY, access!(|values| values.backbone.density));
    }

    fn cylinder(&mut self, material: &CylinderMaterial) {
        use design::Cylinder as Rod;

        let length = design_access!(Cylinder(c) => c.length);
        self.scalar(Draft::holding(&of::ROD_LENGTH, LENGTH, length).known(Known::BodyLength));
        let mut number = |quantity, unit, access| self.scalar(Draft::holding(quantity, unit, access));
        number(&of::ROD_RADIUS, LENGTH, design_access!(Cylinder(c) => c.radius));
        number(&of::ROD_INNER, LENGTH, design_access!(Cylinder(c) => c.inner_radius));
        match material {
            Composite { .. } => {
                let hardness =
                    design_access!(Cylinder(Rod { material: Composite { shore_a, .. }, .. }) => *shore_a);
                number(&of::ROD_SHORE_A, HARDNESS, hardness);
                let ratio =
                    design_access!(Cylinder(Rod { material: Composite { poisson, .. }, .. }) => *poisson);
                number(&of::ROD_POISSON, RATIO, ratio);
                let fraction = design_access!(
                    Cylinder(Rod { material: Composite { volume_fraction, .. }, .. }) => *volume_fraction
                );
                number(&of::ROD_VOLUME_FRACTION, RATIO, fraction);
                let particles = design_access!(
                    Cylinder(Rod { material: Composite { particle_remanence, .. }, .. }) => *particle_remanence
                );
                number(&of::ROD_PARTICLE_REMANENCE, REMANENCE, particles);
            }
            Bulk { .. } => {
                let elastic_modulus = design_access!(
                    Cylinder(Rod { material: Bulk { elastic_modulus, .. }, .. }) => *elastic_modulus
                );
                number(&of::ROD_ELASTIC_MODULUS, MODULUS, elastic_modulus);
                let ratio = design_access!(Cylinder(Rod { material: Bulk { poisson, .. }, .. }) => *poisson);
                number(&of::ROD_POISSON, RATIO, ratio);
                let axial =
                    design_access!(Cylinder(Rod { material: Bulk { remanence, .. }, .. }) => *remanence);
                number(&of::ROD_REMANENCE, REMANENCE, axial);
            }
        }
        number(&of::ROD_DENSITY, DENSITY, density_access!(Cylinder(c) => c.density));
    }
}
