//! Parameters: design, external magnet, model.

use super::super::given::Given;
use super::super::units::{ANGLE, DENSITY, HARDNESS, LENGTH, MODULUS, RATIO, REMANENCE, TIME};
use super::super::variable::{Access, Enumeration, Item, Kind, Role};
use super::{Draft, Rows, place};
use crate::design::Specification::{Cylinder, Segmented};
use crate::design::{self, CylinderMaterial, DENSEST_PACKING, MOST_PERMEABLE, Modulus, SpiralKind};
use crate::equilibrium::Interaction;

/// Level of local interaction.
pub(super) static INTERACTION: Enumeration = Enumeration {
    name: "Interaction",
    description: "Level of local magnetic interaction",
    items: &{
        let mut items = [const { Item { name: "", value: 0, description: "" } }; Interaction::ALL.len()];
        let mut row = 0;
        while row < items.len() {
            let (level, name, description) = Interaction::ALL[row];
            items[row] = Item { name, value: level as i32, description };
            row += 1;
        }
        items
    },
};

/// How the spiral's sector lies in the section.
pub(super) static SPIRAL: Enumeration = Enumeration {
    name: "Spiral",
    description: "How the spiral's sector lies in the section",
    items: &[
        Item { name: "helical", value: 0, description: "The sector turns with arc length, as built" },
        Item { name: "axisymmetric", value: 1, description: "The sector's area is spread over the circle" },
    ],
};

/// Reads and sets a place in one variant of the design. Rows are made only for the packed variant.
macro_rules! part {
    ($variant:pat => $place:expr) => {
        Access::Real {
            get: |given, _| match &given.specification {
                $variant => $place,
                _ => f64::NAN,
            },
            set: |given, _, value| {
                if let $variant = &mut given.specification {
                    $place = value;
                }
            },
        }
    };
}

/// The same for a density, which 0 leaves to the composite's rule.
macro_rules! density {
    ($variant:pat => $place:expr) => {
        Access::Real {
            get: |given, _| match &given.specification {
                $variant => $place.unwrap_or(0.0),
                _ => f64::NAN,
            },
            set: |given, _, value| {
                if let $variant = &mut given.specification {
                    $place = (value != 0.0).then_some(value);
                }
            },
        }
    };
}

impl Rows {
    pub(super) fn parameters(&mut self, start: &Given) {
        match &start.specification {
            Segmented(_) => {
                self.helix();
                self.ring();
                self.backbone(start);
            }
            Cylinder(cylinder) => self.cylinder(&cylinder.material),
        }
        for magnet in 0..start.magnets.len() {
            self.magnet(magnet);
        }
        self.gravity();
        self.one(
            Draft::new(
                "model.interaction",
                Kind::Enumeration(&INTERACTION),
                "Level of local magnetic interaction",
                Access::Choice {
                    get: |given| given.settings.interaction as i32,
                    set: |given, number| {
                        let chosen = Interaction::ALL.iter().find(|row| row.0 as i32 == number);
                        given.settings.interaction = chosen.map_or(given.settings.interaction, |row| row.0);
                        chosen.is_some()
                    },
                },
            )
            .role(Role::Fixed),
        );
        let tolerance = |name, unit, description, access| {
            Draft::real(name, unit, description, access).min(0.0).role(Role::Tunable)
        };
        self.one(tolerance(
            "model.tolerance_position",
            LENGTH,
            "How far the tip may be from the converged answer of the model",
            Access::Real {
                get: |given, _| given.settings.tolerance_position,
                set: |given, _, value| given.settings.tolerance_position = value,
            },
        ));
        self.one(tolerance(
            "model.tolerance_angle",
            ANGLE,
            "How far the tip may be turned against the converged answer of the model",
            Access::Real {
                get: |given, _| given.settings.tolerance_angle,
                set: |given, _, value| given.settings.tolerance_angle = value,
            },
        ));
        self.fixed(Draft::new(
            "model.bending_stop",
            Kind::Boolean,
            "Whether a core stiffens once it has bent by its boundary angle, because windings touch",
            Access::Boolean {
                get: |given| given.settings.bending_stop,
                set: |given, on| given.settings.bending_stop = on,
            },
        ));
        self.fixed(
            Draft::real(
                "model.time_budget",
                TIME,
                "Processor time that a solve may take before it ends as out of budget",
                Access::Real {
                    get: |given, _| given.settings.time_budget,
                    set: |given, _, value| given.settings.time_budget = value,
                },
            )
            .min(0.0),
        );
    }

    fn fixed(&mut self, draft: Draft) {
        self.one(draft.role(Role::Fixed));
    }

    fn helix(&mut self) {
        let length = |name, description, access| Draft::real(name, LENGTH, description, access).min(0.0);
        self.fixed(length(
            "design.helix.length",
            "Length of each helix",
            part!(Segmented(s) => s.helix.length),
        ));
        self.fixed(
            Draft::real(
                "design.helix.boundary_angle",
                ANGLE,
                "Bending angle of a segment at which adjacent windings touch",
                part!(Segmented(s) => s.helix.boundary_angle),
            )
            .min(0.0),
        );
        self.fixed(length(
            "design.helix.radius",
            "Outer radius of helix and rings",
            part!(Segmented(s) => s.helix.radius),
        ));
        self.fixed(
            Draft::real(
                "design.helix.windings",
                RATIO,
                "Windings of each helix",
                part!(Segmented(s) => s.helix.windings),
            )
            .min(1.0),
        );
        self.fixed(length(
            "design.helix.core_outer_radius",
            "Outer radius of the core cylinder",
            part!(Segmented(s) => s.helix.core_outer_radius),
        ));
        self.fixed(length(
            "design.helix.core_inner_radius",
            "Inner radius of core cylinder, discs and rings",
            part!(Segmented(s) => s.helix.core_inner_radius),
        ));
        let elastomer = part!(Segmented(s) => s.helix.shore_a);
        self.fixed(shore("design.helix.shore_a", "Shore A hardness of the elastomer", elastomer));
        self.fixed(poisson("design.helix.poisson", part!(Segmented(s) => s.helix.poisson)));
        let fraction = part!(Segmented(s) => s.helix.volume_fraction);
        self.fixed(packing("design.helix.volume_fraction", fraction));
        self.fixed(Draft::real(
            "design.helix.particle_remanence",
            REMANENCE,
            "Remanence of the magnetic particles",
            part!(Segmented(s) => s.helix.particle_remanence),
        ));
        let composite = density!(Segmented(s) => s.helix.density);
        self.fixed(mass(
            "design.helix.density",
            "Density of the composite; 0: by its volume fraction",
            composite,
        ));
        let spiral = Access::Choice {
            get: |given| match &given.specification {
                Segmented(s) => i32::from(s.spiral == SpiralKind::Axisymmetric),
                Cylinder(_) => 0,
            },
            set: |given, number| {
                let kind = match number {
                    0 => SpiralKind::Helical,
                    1 => SpiralKind::Axisymmetric,
                    _ => return false,
                };
                if let Segmented(s) = &mut given.specification {
                    s.spiral = kind;
                }
                true
            },
        };
        let kind = Kind::Enumeration(&SPIRAL);
        self.fixed(Draft::new("design.spiral", kind, "How the spiral's sector lies in the section", spiral));
    }

    fn ring(&mut self) {
        let length = part!(Segmented(s) => s.ring.length);
        self.fixed(Draft::real("design.ring.length", LENGTH, "Length of each ring magnet", length).min(0.0));
        let remanence = part!(Segmented(s) => s.ring.remanence);
        self.fixed(Draft::real(
            "design.ring.remanence",
            REMANENCE,
            "Remanence of the ring magnets",
            remanence,
        ));
        let permeability = part!(Segmented(s) => s.ring.recoil_permeability);
        let description = "Relative recoil permeability of the ring magnets; 1.05 for sintered NdFeB, 1: not weakened by \
                           their own field";
        let recoil = Draft::real("design.ring.recoil_permeability", RATIO, description, permeability);
        self.fixed(recoil.min(1.0).max(MOST_PERMEABLE));
        let density = part!(Segmented(s) => s.ring.density);
        self.fixed(mass("design.ring.density", "Density of the ring magnets", density));
    }

    fn backbone(&mut self, start: &Given) {
        self.fixed(Draft::new(
            "design.backbone.present",
            Kind::Boolean,
            "Whether a tube runs through all bodies",
            Access::Boolean { get: |g| g.backbone_present, set: |g, value| g.backbone_present = value },
        ));
        let tube = [
            ("design.backbone.outer_radius", "Outer radius", place!(|g, _at| g.backbone.outer_radius)),
            ("design.backbone.inner_radius", "Inner radius", place!(|g, _at| g.backbone.inner_radius)),
        ];
        for (name, description, access) in tube {
            self.fixed(Draft::real(name, LENGTH, description, access).min(0.0));
        }
        // The packed design says in which of the two ways its stiffness is stated.
        self.fixed(match start.backbone.modulus {
            Modulus::ShoreA(_) => shore(
                "design.backbone.shore_a",
                "Shore A hardness",
                Access::Real {
                    get: |g, _| match g.backbone.modulus {
                        Modulus::ShoreA(value) | Modulus::Elastic(value) => value,
                    },
                    set: |g, _, value| g.backbone.modulus = Modulus::ShoreA(value),
                },
            ),
            Modulus::Elastic(_) => modulus(
                "design.backbone.elastic_modulus",
                Access::Real {
                    get: |g, _| match g.backbone.modulus {
                        Modulus::ShoreA(value) | Modulus::Elastic(value) => value,
                    },
                    set: |g, _, value| g.backbone.modulus = Modulus::Elastic(value),
                },
            ),
        });
        self.fixed(poisson("design.backbone.poisson", place!(|g, _at| g.backbone.poisson)));
        self.fixed(mass("design.backbone.density", "Density", place!(|g, _at| g.backbone.density)));
    }

    fn cylinder(&mut self, material: &CylinderMaterial) {
        use crate::design::CylinderMaterial::{Bulk, Composite};
        use design::Cylinder as Rod;
        let dimensions = [
            ("design.cylinder.length", "Length", part!(Cylinder(c) => c.length)),
            ("design.cylinder.radius", "Outer radius", part!(Cylinder(c) => c.radius)),
            ("design.cylinder.inner_radius", "Inner radius", part!(Cylinder(c) => c.inner_radius)),
        ];
        for (name, description, access) in dimensions {
            self.fixed(Draft::real(name, LENGTH, description, access).min(0.0));
        }
        match material {
            Composite { .. } => {
                self.fixed(shore(
                    "design.cylinder.shore_a",
                    "Shore A hardness of the elastomer",
                    part!(Cylinder(Rod { material: Composite { shore_a, .. }, .. }) => *shore_a),
                ));
                self.fixed(poisson(
                    "design.cylinder.poisson",
                    part!(Cylinder(Rod { material: Composite { poisson, .. }, .. }) => *poisson),
                ));
                self.fixed(packing(
                    "design.cylinder.volume_fraction",
                    part!(Cylinder(Rod { material: Composite { volume_fraction, .. }, .. }) => *volume_fraction),
                ));
                self.fixed(Draft::real(
                    "design.cylinder.particle_remanence",
                    REMANENCE,
                    "Remanence of the magnetic particles",
                    part!(Cylinder(Rod { material: Composite { particle_remanence, .. }, .. }) => *particle_remanence),
                ));
            }
            Bulk { .. } => {
                self.fixed(modulus(
                    "design.cylinder.elastic_modulus",
                    part!(Cylinder(Rod { material: Bulk { elastic_modulus, .. }, .. }) => *elastic_modulus),
                ));
                self.fixed(poisson(
                    "design.cylinder.poisson",
                    part!(Cylinder(Rod { material: Bulk { poisson, .. }, .. }) => *poisson),
                ));
                self.fixed(Draft::real(
                    "design.cylinder.remanence",
                    REMANENCE,
                    "Remanence along the axis",
                    part!(Cylinder(Rod { material: Bulk { remanence, .. }, .. }) => *remanence),
                ));
            }
        }
        let density = density!(Cylinder(c) => c.density);
        self.fixed(mass("design.cylinder.density", "Density; 0: by the material's rule", density));
    }

    fn magnet(&mut self, item: usize) {
        let rows = [
            ("radius", LENGTH, "Outer radius", place!(|g, at| g.magnets[at.item].radius)),
            ("inner_radius", LENGTH, "Inner radius", place!(|g, at| g.magnets[at.item].inner_radius)),
            ("length", LENGTH, "Length along the axis", place!(|g, at| g.magnets[at.item].length)),
            (
                "offset",
                LENGTH,
                "Position of its centre along the assembly's axis",
                place!(|g, at| g.magnets[at.item].offset),
            ),
            (
                "remanence",
                REMANENCE,
                "Remanence along the axis",
                place!(|g, at| g.magnets[at.item].remanence),
            ),
        ];
        for (part, quantity, description, access) in rows {
            let name = format!("magnet.design.cylinder[{}].{part}", item + 1);
            let draft = Draft::real(name, quantity, description, access).role(Role::Fixed);
            let signed = part == "offset" || part == "remanence";
            self.item(if signed { draft } else { draft.min(0.0) }, item);
        }
    }
}

fn shore(name: &str, description: &str, access: Access) -> Draft {
    Draft::real(name, HARDNESS, description, access).min(0.0).max(100.0)
}

fn modulus(name: &str, access: Access) -> Draft {
    Draft::real(name, MODULUS, "Young's modulus", access).min(0.0)
}

fn poisson(name: &str, access: Access) -> Draft {
    Draft::real(name, RATIO, "Poisson's ratio", access).min(-1.0).max(0.5)
}

fn packing(name: &str, access: Access) -> Draft {
    Draft::real(name, RATIO, "Volume fraction of magnetic particles", access).min(0.0).max(DENSEST_PACKING)
}

fn mass(name: &str, description: &str, access: Access) -> Draft {
    Draft::real(name, DENSITY, description, access).min(0.0)
}
