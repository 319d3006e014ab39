//! Every number of magnets and coils: what it is called, what it is, and what it may be.

use super::limits::{
    COIL_INNER_RADIUS, COIL_MULTIPOLE, COIL_TURNS, DIRECTED_MAGNET_REMANENCE, DIRECTED_MAGNET_SIZE,
    DIRECTION_COMPONENT, MAGNET_INNER_RADIUS, MAGNET_OFFSET, MAGNET_REMANENCE, SIZE,
};
use crate::error::quantities;

quantities! {
    // Name in errors, key in a scene, variable of the FMU, description, interval in the unit of the library.
    MAGNET_OUTER: "magnet outer radius (m)", "magnet[*].cylinders[*].radius_mm", "magnet.design.cylinder[*].radius", "Outer radius", SIZE;
    MAGNET_INNER: "magnet inner radius (m)", "magnet[*].cylinders[*].inner_radius_mm", "magnet.design.cylinder[*].inner_radius",
        "Inner radius", MAGNET_INNER_RADIUS;
    MAGNET_LENGTH: "magnet length (m)", "magnet[*].cylinders[*].length_mm", "magnet.design.cylinder[*].length", "Length along the axis",
        SIZE;
    OFFSET: "magnet offset (m)", "magnet[*].cylinders[*].offset_mm", "magnet.design.cylinder[*].offset",
        "Position of its centre along the assembly's axis", MAGNET_OFFSET;
    REMANENCE: "magnet remanence (T)", "magnet[*].cylinders[*].remanence_t", "magnet.design.cylinder[*].remanence",
        "Remanence along the axis", MAGNET_REMANENCE;

    EDGE: "magnet edge (m)", "magnet[*].size_mm[*]", "magnet.design.size[*]", "Edge of the cuboid", DIRECTED_MAGNET_SIZE;
    RADIUS: "magnet radius (m)", "magnet[*].radius_mm", "magnet.design.radius", "Outer radius", DIRECTED_MAGNET_SIZE;
    BORE: "magnet bore radius (m)", "magnet[*].inner_radius_mm", "magnet.design.inner_radius", "Inner radius; 0 is solid",
        MAGNET_INNER_RADIUS;
    HEIGHT: "magnet height (m)", "magnet[*].length_mm", "magnet.design.length", "Length along the axis", DIRECTED_MAGNET_SIZE;
    DIRECTION: "component of the magnet's direction", "magnet[*].direction[*]", "magnet.design.direction[*]",
        "Direction of magnetisation, a unit vector in the magnet's frame", DIRECTION_COMPONENT;
    DIRECTED_REMANENCE: "magnet remanence (T)", "magnet[*].remanence_t", "magnet.design.remanence",
        "Remanence along the direction of magnetisation", DIRECTED_MAGNET_REMANENCE;

    COIL_INNER: "coil inner radius (m)", "coil[*].inner_radius_mm", "", "Inner radius of the winding", COIL_INNER_RADIUS;
    COIL_OUTER: "coil outer radius (m)", "coil[*].outer_radius_mm", "", "Outer radius of the winding", SIZE;
    COIL_LENGTH: "coil length (m)", "coil[*].length_mm", "", "Length of the winding along its axis", SIZE;
    TURNS: "coil turns", "coil[*].turns", "", "Number of turns", COIL_TURNS;
    REACH: "coil reach (m)", "coil[*].reach_mm", "", "Distance from which the multipoles of an iron core describe its field", SIZE;
    MULTIPOLE: "coil multipole (T m^(l+2)/A)", "coil[*].multipoles", "", "A multipole of an iron core's field", COIL_MULTIPOLE;
}
