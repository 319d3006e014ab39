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
use crate::design::Specification::{Cylinder, Segmented};
use crate::design::{self, DENSEST_PACKING, MOST_PERMEABLE, Modulus, SpiralKind};

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

/// The same for a density that is optional: 0 stands for the density that follows from the composition.
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
                self.helix();
                self.spiral(segmented.segments);
                self.ring();
                self.backbone(&start.backbone.modulus);
            }
            Cylinder(cylinder) => self.cylinder(&cylinder.material),
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

    fn helix(&mut self) {
        let helix_length = design_access!(Segmented(s) => s.helix.length);
        let draft = length("design.helix.length", "Length of each helix", helix_length);
        self.scalar(draft.known(Known::BodyLength));
        let boundary_angle = design_access!(Segmented(s) => s.helix.boundary_angle);
        let description = "Bending angle of a segment at which adjacent windings touch";
        let draft = Draft::parameter("design.helix.boundary_angle", ANGLE, description, boundary_angle);
        self.scalar(draft.min(0.0));
        let radius = design_access!(Segmented(s) => s.helix.radius);
        self.scalar(length("design.helix.radius", "Outer radius of helix and rings", radius));
        let windings = design_access!(Segmented(s) => s.helix.windings);
        let draft = Draft::parameter("design.helix.windings", RATIO, "Windings of each helix", windings);
        self.scalar(draft.min(1.0));
        let core_outer = design_access!(Segmented(s) => s.helix.core_outer_radius);
        let description = "Outer radius of the core cylinder";
        self.scalar(length("design.helix.core_outer_radius", description, core_outer));
        let core_inner = design_access!(Segmented(s) => s.helix.core_inner_radius);
        let description = "Inner radius of core cylinder, discs and rings";
        self.scalar(length("design.helix.core_inner_radius", description, core_inner));
        let hardness = design_access!(Segmented(s) => s.helix.shore_a);
        self.scalar(shore("design.helix.shore_a", "Shore A hardness of the elastomer", hardness));
        let ratio = design_access!(Segmented(s) => s.helix.poisson);
        self.scalar(poisson("design.helix.poisson", ratio));
        let fraction = design_access!(Segmented(s) => s.helix.volume_fraction);
        self.scalar(volume_fraction("design.helix.volume_fraction", fraction));
        let particles = design_access!(Segmented(s) => s.helix.particle_remanence);
        let description = "Remanence of the magnetic particles";
        self.scalar(remanence("design.helix.particle_remanence", description, particles));
        let composite = density_access!(Segmented(s) => s.helix.density);
        let description = "Density of the composite; 0: by its volume fraction";
        self.scalar(density("design.helix.density", description, composite));
    }

    fn spiral(&mut self, segments: usize) {
        let spiral = Access::Enumeration {
            get: |values| match &values.specification {
                Segmented(s) => match s.spiral {
                    SpiralKind::Helical => 0,
                    SpiralKind::Axisymmetric => 1,
                    SpiralKind::Alternating => 2,
                },
                Cylinder(_) => 0,
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
                Cylinder(_) => f64::NAN,
            },
            set: |values, index, value| {
                if let Segmented(s) = &mut values.specification {
                    s.spiral_start.set(index.component, s.segments, value);
                }
            },
        };
        let description =
            "Angle by which the spiral of each segment is turned about the axis; 0: its sector begins at d1";
        let draft = Draft::parameter("design.spiral_start", ANGLE, description, start);
        self.array(segments, &draft.min(-TAU).max(TAU));
    }

    fn ring(&mut self) {
        let ring_length = design_access!(Segmented(s) => s.ring.length);
        let draft = length("design.ring.length", "Length of each ring magnet", ring_length);
        self.scalar(draft.known(Known::RingLength));
        let of_rings = design_access!(Segmented(s) => s.ring.remanence);
        self.scalar(remanence("design.ring.remanence", "Remanence of the ring magnets", of_rings));
        let permeability = design_access!(Segmented(s) => s.ring.recoil_permeability);
        let description = "Relative recoil permeability of the ring magnets; 1.05 for sintered NdFeB, 1: not weakened by \
                           their own field";
        let draft = Draft::parameter("design.ring.recoil_permeability", RATIO, description, permeability);
        self.scalar(draft.min(1.0).max(MOST_PERMEABLE));
        let of_rings = design_access!(Segmented(s) => s.ring.density);
        self.scalar(density("design.ring.density", "Density of the ring magnets", of_rings));
    }

    fn backbone(&mut self, stiffness: &Modulus) {
        let present = Access::Boolean {
            get: |values| values.backbone_present,
            set: |values, present| values.backbone_present = present,
        };
        let description = "Whether a tube runs through all bodies";
        self.scalar(Draft::parameter("design.backbone.present", DataType::Boolean, description, present));
        let outer_radius = access!(|values| values.backbone.outer_radius);
        self.scalar(length("design.backbone.outer_radius", "Outer radius", outer_radius));
        let inner_radius = access!(|values| values.backbone.inner_radius);
        self.scalar(length("design.backbone.inner_radius", "Inner radius", inner_radius));
        // The packed design states its stiffness in one of two ways, and the variable is named after that one.
        self.scalar(match stiffness {
            Modulus::ShoreA(_) => shore(
                "design.backbone.shore_a",
                "Shore A hardness",
                Access::Real {
                    get: |values, _| match values.backbone.modulus {
                        Modulus::ShoreA(value) | Modulus::Elastic(value) => value,
                    },
                    set: |values, _, value| values.backbone.modulus = Modulus::ShoreA(value),
                },
            ),
            Modulus::Elastic(_) => modulus(
                "design.backbone.elastic_modulus",
                Access::Real {
                    get: |values, _| match values.backbone.modulus {
                        Modulus::ShoreA(value) | Modulus::Elastic(value) => value,
                    },
                    set: |values, _, value| values.backbone.modulus = Modulus::Elastic(value),
                },
            ),
        });
        self.scalar(poisson("design.backbone.poisson", access!(|values| values.backbone.poisson)));
        self.scalar(density("design.backbone.density", "Density", access!(|values| values.backbone.density)));
    }

    fn cylinder(&mut self, material: &CylinderMaterial) {
        use design::Cylinder as Rod;
        let rod_length = design_access!(Cylinder(c) => c.length);
        self.scalar(length("design.cylinder.length", "Length", rod_length).known(Known::BodyLength));
        let radius = design_access!(Cylinder(c) => c.radius);
        self.scalar(length("design.cylinder.radius", "Outer radius", radius));
        let inner_radius = design_access!(Cylinder(c) => c.inner_radius);
        self.scalar(length("design.cylinder.inner_radius", "Inner radius", inner_radius));
        match material {
            Composite { .. } => {
                let hardness =
                    design_access!(Cylinder(Rod { material: Composite { shore_a, .. }, .. }) => *shore_a);
                self.scalar(shore("design.cylinder.shore_a", "Shore A hardness of the elastomer", hardness));
                let ratio =
                    design_access!(Cylinder(Rod { material: Composite { poisson, .. }, .. }) => *poisson);
                self.scalar(poisson("design.cylinder.poisson", ratio));
                let fraction = design_access!(
                    Cylinder(Rod { material: Composite { volume_fraction, .. }, .. }) => *volume_fraction
                );
                self.scalar(volume_fraction("design.cylinder.volume_fraction", fraction));
                let particles = design_access!(
                    Cylinder(Rod { material: Composite { particle_remanence, .. }, .. }) => *particle_remanence
                );
                let description = "Remanence of the magnetic particles";
                self.scalar(remanence("design.cylinder.particle_remanence", description, particles));
            }
            Bulk { .. } => {
                let elastic_modulus = design_access!(
                    Cylinder(Rod { material: Bulk { elastic_modulus, .. }, .. }) => *elastic_modulus
                );
                self.scalar(modulus("design.cylinder.elastic_modulus", elastic_modulus));
                let ratio = design_access!(Cylinder(Rod { material: Bulk { poisson, .. }, .. }) => *poisson);
                self.scalar(poisson("design.cylinder.poisson", ratio));
                let axial =
                    design_access!(Cylinder(Rod { material: Bulk { remanence, .. }, .. }) => *remanence);
                self.scalar(remanence("design.cylinder.remanence", "Remanence along the axis", axial));
            }
        }
        let of_rod = density_access!(Cylinder(c) => c.density);
        self.scalar(density("design.cylinder.density", "Density; 0: by the material's rule", of_rod));
    }
}

fn length(name: &str, description: &str, access: Access) -> Draft {
    Draft::parameter(name, LENGTH, description, access).min(0.0)
}

fn shore(name: &str, description: &str, access: Access) -> Draft {
    Draft::parameter(name, HARDNESS, description, access).min(0.0).max(100.0)
}

fn modulus(name: &str, access: Access) -> Draft {
    Draft::parameter(name, MODULUS, "Young's modulus", access).min(0.0)
}

fn poisson(name: &str, access: Access) -> Draft {
    Draft::parameter(name, RATIO, "Poisson's ratio", access).min(0.0).max(0.5)
}

fn volume_fraction(name: &str, access: Access) -> Draft {
    let description = "Volume fraction of magnetic particles";
    Draft::parameter(name, RATIO, description, access).min(0.0).max(DENSEST_PACKING)
}

fn remanence(name: &str, description: &str, access: Access) -> Draft {
    Draft::parameter(name, REMANENCE, description, access)
}

fn density(name: &str, description: &str, access: Access) -> Draft {
    Draft::parameter(name, DENSITY, description, access).min(0.0)
}
