//! Every number of a vessel's wall: what it is called, what it is, and what it may be.

use crate::error::{Interval, quantities};

quantities! {
    // Name in errors, key in a scene, variable of the FMU, description, interval in the unit of the library.
    WALL_MODULUS: "vessel wall modulus (Pa)", "vessel.wall_modulus_mpa", "vessel.wall_modulus", "Young's modulus of the wall",
        Interval::at_least(1e3).at_most(1e12);
    FRICTION: "vessel friction", "vessel.friction", "vessel.friction", "Coefficient of Coulomb friction between the device and the wall",
        Interval::at_least(0.0).at_most(10.0);
}
