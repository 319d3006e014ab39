//! Every number of a device: what it is called, what it is, and what it may be.

use super::limits::{
    BACKBONE_OUTER_RADIUS, BOUNDARY_ANGLE, CORE_INNER_RADIUS, CORE_OUTER_RADIUS, DENSITY, ELASTIC_MODULUS,
    GUIDEWIRE_RADIUS, LENGTH, LINE_STIFFNESS, POISSON, RECOIL_PERMEABILITY, REMANENCE, ROD_INNER_RADIUS,
    ROTATIONAL_STIFFNESS, SECTION_INNER_RADIUS, SECTION_RADIUS, SEGMENTS, SHORE_A, SIGNED_REMANENCE,
    SPIRAL_START, TUBE_INNER_RADIUS, VOLUME_FRACTION, WINDINGS,
};
use crate::error::{Interval, quantities};

quantities! {
    // Name in errors, key in a scene, variable of the FMU, description, interval in the unit of the library.
    NUMBER_OF_SEGMENTS: "number of segments", "design.segments", "design.segments", "Number of segments", SEGMENTS;
    HELIX_LENGTH: "helix length L (m)", "design.helix.length_mm", "design.helix.length", "Length of each helix", LENGTH;
    HELIX_BOUNDARY_ANGLE: "boundary angle Theta (rad)", "design.helix.boundary_angle_deg", "design.helix.boundary_angle",
        "Bending angle of a segment at which adjacent windings touch", BOUNDARY_ANGLE;
    HELIX_RADIUS: "helix radius R (m)", "design.helix.radius_mm", "design.helix.radius", "Outer radius of helix and rings", LENGTH;
    HELIX_WINDINGS: "windings W", "design.helix.windings", "design.helix.windings", "Windings of each helix", WINDINGS;
    HELIX_CORE_OUTER_RADIUS: "core outer radius r_oc (m)", "design.helix.core_outer_radius_mm", "design.helix.core_outer_radius",
        "Outer radius of the core cylinder", CORE_OUTER_RADIUS;
    HELIX_CORE_INNER_RADIUS: "core inner radius r_ic (m)", "design.helix.core_inner_radius_mm", "design.helix.core_inner_radius",
        "Inner radius of core cylinder, discs and rings", CORE_INNER_RADIUS;
    HELIX_SHORE_A: "Shore A hardness", "design.helix.shore_a", "design.helix.shore_a", "Shore A hardness of the elastomer", SHORE_A;
    HELIX_POISSON: "Poisson's ratio", "design.helix.poisson", "design.helix.poisson", "Poisson's ratio", POISSON;
    HELIX_VOLUME_FRACTION: "volume fraction Phi", "design.helix.volume_fraction", "design.helix.volume_fraction",
        "Volume fraction of magnetic particles", VOLUME_FRACTION;
    HELIX_PARTICLE_REMANENCE: "particle remanence B_r (T)", "design.helix.particle_remanence_t", "design.helix.particle_remanence",
        "Remanence of the magnetic particles", REMANENCE;
    HELIX_DENSITY: "density (kg/m3)", "design.helix.density_kg_m3", "design.helix.density",
        "Density of the composite; 0: by its volume fraction", DENSITY;
    HELIX_WINDING_HEIGHT: "winding height h (m)", "design.helix", "", "Height of a winding, which follows from other numbers",
        Interval::above(0.0);

    SPIRAL_START_ANGLE: "start angle of the spirals (rad)", "design.spiral_start_deg[*]", "design.spiral_start[*]",
        "Angle by which the spiral of each segment is turned about the axis; 0: its sector begins at d1", SPIRAL_START;

    RING_LENGTH: "ring length L_mag (m)", "design.ring.length_mm", "design.ring.length", "Length of each ring magnet", LENGTH;
    RING_REMANENCE: "ring remanence B_r (T)", "design.ring.remanence_t", "design.ring.remanence", "Remanence of the ring magnets",
        REMANENCE;
    RING_RECOIL_PERMEABILITY: "ring recoil permeability mu_r", "design.ring.recoil_permeability", "design.ring.recoil_permeability",
        "Relative recoil permeability of the ring magnets; 1.05 for sintered NdFeB, 1: not weakened by their own field",
        RECOIL_PERMEABILITY;
    RING_DIRECTION: "length of the direction of magnetisation", "design.ring.direction", "",
        "Direction of the magnetisation of the ring magnets, in the material frame", Interval::FINITE;
    RING_DENSITY: "density (kg/m3)", "design.ring.density_kg_m3", "design.ring.density", "Density of the ring magnets", DENSITY;

    BACKBONE_OUTER: "backbone outer radius (m)", "design.backbone.outer_radius_mm", "design.backbone.outer_radius", "Outer radius",
        BACKBONE_OUTER_RADIUS;
    BACKBONE_INNER: "backbone inner radius (m)", "design.backbone.inner_radius_mm", "design.backbone.inner_radius", "Inner radius",
        TUBE_INNER_RADIUS;
    BACKBONE_SHORE_A: "Shore A hardness", "design.backbone.shore_a", "design.backbone.shore_a", "Shore A hardness", SHORE_A;
    BACKBONE_ELASTIC_MODULUS: "Young's modulus (Pa)", "design.backbone.elastic_modulus_mpa", "design.backbone.elastic_modulus",
        "Young's modulus", ELASTIC_MODULUS;
    BACKBONE_POISSON: "Poisson's ratio", "design.backbone.poisson", "design.backbone.poisson", "Poisson's ratio", POISSON;
    BACKBONE_DENSITY: "density (kg/m3)", "design.backbone.density_kg_m3", "design.backbone.density", "Density", DENSITY;

    ROD_LENGTH: "cylinder length (m)", "design.length_mm", "design.cylinder.length", "Length", LENGTH;
    ROD_RADIUS: "cylinder radius (m)", "design.radius_mm", "design.cylinder.radius", "Outer radius", LENGTH;
    ROD_INNER: "cylinder inner radius (m)", "design.inner_radius_mm", "design.cylinder.inner_radius", "Inner radius", ROD_INNER_RADIUS;
    ROD_SHORE_A: "Shore A hardness", "design.shore_a", "design.cylinder.shore_a", "Shore A hardness of the elastomer", SHORE_A;
    ROD_ELASTIC_MODULUS: "Young's modulus (Pa)", "design.elastic_modulus_mpa", "design.cylinder.elastic_modulus", "Young's modulus",
        ELASTIC_MODULUS;
    ROD_POISSON: "Poisson's ratio", "design.poisson", "design.cylinder.poisson", "Poisson's ratio", POISSON;
    ROD_VOLUME_FRACTION: "volume fraction Phi", "design.volume_fraction", "design.cylinder.volume_fraction",
        "Volume fraction of magnetic particles", VOLUME_FRACTION;
    ROD_PARTICLE_REMANENCE: "particle remanence B_r (T)", "design.particle_remanence_t", "design.cylinder.particle_remanence",
        "Remanence of the magnetic particles", REMANENCE;
    ROD_REMANENCE: "cylinder remanence (T)", "design.remanence_t", "design.cylinder.remanence", "Remanence along the axis", REMANENCE;
    ROD_DENSITY: "density (kg/m3)", "design.density_kg_m3", "design.cylinder.density", "Density; 0: by the material's rule", DENSITY;

    SECTION_LENGTH: "section length (m)", "design.section[*].length_mm", "section[*].length", "Length", LENGTH;
    SECTION_OUTER: "section outer radius (m)", "design.section[*].outer_radius_mm", "section[*].outer_radius", "Outer radius",
        SECTION_RADIUS;
    SECTION_INNER: "section inner radius (m)", "design.section[*].inner_radius_mm", "section[*].inner_radius", "Inner radius",
        SECTION_INNER_RADIUS;
    SECTION_SHORE_A: "Shore A hardness", "design.section[*].shore_a", "section[*].shore_a", "Shore A hardness of the elastomer", SHORE_A;
    SECTION_ELASTIC_MODULUS: "Young's modulus (Pa)", "design.section[*].elastic_modulus_mpa", "section[*].elastic_modulus",
        "Young's modulus", ELASTIC_MODULUS;
    SECTION_POISSON: "Poisson's ratio", "design.section[*].poisson", "section[*].poisson", "Poisson's ratio", POISSON;
    SECTION_BENDING: "bending stiffness (N.m2)", "design.section[*].bending_stiffness_n_m2", "section[*].bending_stiffness",
        "Measured bending stiffness", ROTATIONAL_STIFFNESS;
    SECTION_TORSION: "torsional stiffness (N.m2)", "design.section[*].torsional_stiffness_n_m2", "section[*].torsional_stiffness",
        "Measured torsional stiffness", ROTATIONAL_STIFFNESS;
    SECTION_AXIAL: "axial stiffness (N)", "design.section[*].axial_stiffness_n", "section[*].axial_stiffness",
        "Measured axial stiffness", LINE_STIFFNESS;
    SECTION_SHEAR: "shear stiffness (N)", "design.section[*].shear_stiffness_n", "section[*].shear_stiffness",
        "Measured shear stiffness", LINE_STIFFNESS;
    SECTION_DENSITY: "density (kg/m3)", "design.section[*].density_kg_m3", "section[*].density",
        "Density; 0: by the material's rule", DENSITY;
    SECTION_REMANENCE: "section remanence (T)", "design.section[*].remanence_t", "section[*].remanence",
        "Remanence; negative: reversed", SIGNED_REMANENCE;
    SECTION_VOLUME_FRACTION: "volume fraction Phi", "design.section[*].volume_fraction", "section[*].volume_fraction",
        "Volume fraction of magnetic particles", VOLUME_FRACTION;
    SECTION_PARTICLE_REMANENCE: "particle remanence B_r (T)", "design.section[*].particle_remanence_t",
        "section[*].particle_remanence", "Remanence of the magnetic particles; negative: reversed", SIGNED_REMANENCE;
    SECTION_DIRECTION: "length of the direction of magnetisation", "design.section[*].direction", "section[*].direction",
        "Direction of the magnetisation at the section's start, in the material frame", Interval::FINITE;
    SECTION_TURN: "turn of the direction (rad/m)", "design.section[*].direction_turn_deg_per_mm", "section[*].direction_turn",
        "Turn of that direction along the section, right-handed about the axis", Interval::FINITE;
    SECTION_REST: "rest curvature (1/m)", "design.section[*].rest_curvature_per_m", "section[*].rest_curvature",
        "Curvature about the first two directors, and twist about the third, without loads", Interval::FINITE;

    SHAFT_OUTER: "shaft outer radius (m)", "feed.shaft.outer_radius_mm", "", "Outer radius of the shaft", LENGTH;
    SHAFT_INNER: "shaft inner radius (m)", "feed.shaft.inner_radius_mm", "", "Inner radius of the shaft", TUBE_INNER_RADIUS;
    SHAFT_SHORE_A: "Shore A hardness", "feed.shaft.shore_a", "", "Shore A hardness of the shaft", SHORE_A;
    SHAFT_ELASTIC_MODULUS: "Young's modulus (Pa)", "feed.shaft.elastic_modulus_mpa", "", "Young's modulus of the shaft",
        ELASTIC_MODULUS;
    SHAFT_POISSON: "Poisson's ratio", "feed.shaft.poisson", "", "Poisson's ratio of the shaft", POISSON;
    SHAFT_DENSITY: "density (kg/m3)", "feed.shaft.density_kg_m3", "", "Density of the shaft", DENSITY;

    WIRE_RADIUS: "guidewire radius (m)", "guidewire.radius_mm", "", "Radius of the guidewire", GUIDEWIRE_RADIUS;
    WIRE_ELASTIC_MODULUS: "Young's modulus (Pa)", "guidewire.elastic_modulus_mpa", "", "Young's modulus of the guidewire",
        ELASTIC_MODULUS;
}
