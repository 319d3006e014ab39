//! Units, and the quantities that are measured in them.

use crate::error::Interval;

/// A unit, expressed in SI base units, with a unit for display.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Unit {
    /// Name of the unit.
    pub name: &'static str,
    /// Exponents of the SI base units, with their attribute names in the model description.
    pub base: &'static [(&'static str, i32)],
    /// The unit for display, and how many of it make one of this unit.
    pub display: Option<(&'static str, f64)>,
}

/// A physical quantity; it becomes a declared type of the model description.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Quantity {
    /// Name of the type.
    pub name: &'static str,
    /// Name of its unit in [`UNITS`].
    pub unit: &'static str,
    /// Description for people.
    pub description: &'static str,
    /// Magnitude of a typical value, in the unit.
    pub nominal: f64,
    /// What the elements of an array of it are, and in which frame; empty where arrays of it are mere lists.
    pub elements: &'static [&'static str],
}

/// A vector in the world frame.
const VECTOR: &[&str] = &["x, world frame", "y, world frame", "z, world frame"];
/// A quaternion that turns vectors of a body into those of the world.
const ROTATION: &[&str] =
    &["w (scalar), body to world", "x, body to world", "y, body to world", "z, body to world"];
/// A vector in the material frame.
const MATERIAL: &[&str] = &["along d1", "along d2", "along d3"];
/// Curvature and twist in the material frame.
const STRAIN: &[&str] = &["u1, about d1", "u2, about d2", "u3, twist about d3"];
/// The gradient of a field without sources: symmetric and without trace, so five elements tell all nine.
const SYMMETRIC: &[&str] = &[
    "dBx/dx, world frame",
    "dBx/dy = dBy/dx, world frame",
    "dBx/dz = dBz/dx, world frame",
    "dBy/dy, world frame",
    "dBy/dz = dBz/dy, world frame",
];

const DEGREES_PER_RADIAN: f64 = 180.0 / core::f64::consts::PI;

/// All units of the interface.
pub const UNITS: &[Unit] = &[
    Unit { name: "1", base: &[], display: None },
    Unit { name: "m", base: &[("m", 1)], display: Some(("mm", 1e3)) },
    Unit { name: "rad", base: &[("rad", 1)], display: Some(("deg", DEGREES_PER_RADIAN)) },
    Unit { name: "T", base: &[("kg", 1), ("s", -2), ("A", -1)], display: Some(("mT", 1e3)) },
    Unit { name: "T/m", base: &[("kg", 1), ("m", -1), ("s", -2), ("A", -1)], display: Some(("mT/mm", 1.0)) },
    Unit { name: "N", base: &[("kg", 1), ("m", 1), ("s", -2)], display: Some(("mN", 1e3)) },
    Unit { name: "N.m", base: &[("kg", 1), ("m", 2), ("s", -2)], display: Some(("mN.m", 1e3)) },
    Unit { name: "m/s2", base: &[("m", 1), ("s", -2)], display: None },
    Unit { name: "Pa", base: &[("kg", 1), ("m", -1), ("s", -2)], display: Some(("MPa", 1e-6)) },
    Unit { name: "s", base: &[("s", 1)], display: Some(("ms", 1e3)) },
    Unit { name: "A", base: &[("A", 1)], display: None },
    Unit { name: "kg/m3", base: &[("kg", 1), ("m", -3)], display: None },
    Unit { name: "1/m", base: &[("m", -1)], display: None },
    Unit { name: "N.m2", base: &[("kg", 1), ("m", 3), ("s", -2)], display: Some(("N.mm2", 1e6)) },
    Unit {
        name: "rad/m",
        base: &[("rad", 1), ("m", -1)],
        display: Some(("deg/mm", DEGREES_PER_RADIAN * 1e-3)),
    },
];

const fn quantity(
    name: &'static str,
    unit: &'static str,
    nominal: f64,
    description: &'static str,
) -> Quantity {
    Quantity { name, unit, description, nominal, elements: &[] }
}

/// Largest size of a number that a host can set, in parts of the usual size of its quantity. Beyond it nothing physical is meant, and
/// powers of it overflow.
const LARGEST: f64 = 1e9;

impl Quantity {
    /// The numbers that a host can set.
    #[must_use]
    pub const fn range(&self) -> Interval {
        Interval::within(LARGEST * self.nominal)
    }

    /// This quantity, where arrays of it have these elements.
    const fn with(self, elements: &'static [&'static str]) -> Self {
        Self { elements, ..self }
    }
}

/// Position in the world frame, m.
pub const POSITION: Quantity = quantity("Position", "m", 0.01, "Position in the world frame").with(VECTOR);
/// Length, m.
pub const LENGTH: Quantity = quantity("Length", "m", 0.001, "Length");
/// Angle, rad.
pub const ANGLE: Quantity = quantity("Angle", "rad", 1.0, "Angle");
/// Component of a unit quaternion, 1.
pub const QUATERNION: Quantity =
    quantity("Quaternion", "1", 1.0, "Component of a unit quaternion w, x, y, z, body to world")
        .with(ROTATION);
/// Component of a unit vector, 1.
pub const DIRECTION: Quantity =
    quantity("Direction", "1", 1.0, "Component of a unit vector, world frame").with(VECTOR);
/// Dimensionless number, 1.
pub const RATIO: Quantity = quantity("Ratio", "1", 1.0, "Dimensionless number");
/// Shore A hardness, 1.
pub const HARDNESS: Quantity = quantity("ShoreA", "1", 10.0, "Shore A hardness");
/// Magnetic flux density, T.
pub const FIELD: Quantity =
    quantity("FluxDensity", "T", 0.01, "Magnetic flux density, world frame").with(VECTOR);
/// Remanence, T.
pub const REMANENCE: Quantity = quantity("Remanence", "T", 1.0, "Remanent flux density along the axis");
/// Gradient of the magnetic flux density, T/m.
pub const GRADIENT: Quantity =
    quantity("FieldGradient", "T/m", 1.0, "Gradient of the magnetic flux density, world frame")
        .with(SYMMETRIC);
/// Force, N.
pub const FORCE: Quantity = quantity("Force", "N", 0.01, "Force, world frame").with(VECTOR);
/// Moment or torque, N.m.
pub const MOMENT: Quantity = quantity("Moment", "N.m", 0.001, "Moment or torque, world frame").with(VECTOR);
/// Acceleration, m/s2.
pub const ACCELERATION: Quantity =
    quantity("Acceleration", "m/s2", 10.0, "Acceleration, world frame").with(VECTOR);
/// Young's modulus, Pa.
pub const MODULUS: Quantity = quantity("ElasticModulus", "Pa", 1e6, "Young's modulus");
/// Density, kg/m3.
pub const DENSITY: Quantity = quantity("Density", "kg/m3", 1000.0, "Mass per volume");
/// Electric current, A.
pub const CURRENT: Quantity = quantity("Current", "A", 1.0, "Electric current");
/// Curvature, 1/m.
pub const CURVATURE: Quantity =
    quantity("Curvature", "1/m", 100.0, "Rotation of the directors per arc length, material frame")
        .with(STRAIN);
/// Component of a unit vector in the material frame, 1.
pub const MATERIAL_DIRECTION: Quantity =
    quantity("MaterialDirection", "1", 1.0, "Component of a unit vector, material frame").with(MATERIAL);
/// Turn of a direction along the axis, rad/m.
pub const TURN: Quantity = quantity("Turn", "rad/m", 100.0, "Turn about the axis per arc length");
/// Bending or torsional stiffness, N m2.
pub const ROTATIONAL_STIFFNESS: Quantity =
    quantity("RotationalStiffness", "N.m2", 1e-6, "Bending or torsional stiffness");
/// Axial or shear stiffness, N.
pub const LINE_STIFFNESS: Quantity = quantity("LineStiffness", "N", 10.0, "Axial or shear stiffness");
/// Energy, J; no variable of the FMU is one.
pub const ENERGY: Quantity = quantity("Energy", "J", 1e-6, "Energy");
/// Processor time, s.
pub const TIME: Quantity = quantity("ProcessorTime", "s", 1.0, "Processor time");

/// All quantities, in the order of the model description.
pub const QUANTITIES: &[Quantity] = &[
    POSITION,
    LENGTH,
    ANGLE,
    QUATERNION,
    DIRECTION,
    RATIO,
    HARDNESS,
    FIELD,
    REMANENCE,
    GRADIENT,
    FORCE,
    MOMENT,
    ACCELERATION,
    MODULUS,
    DENSITY,
    CURRENT,
    TIME,
    CURVATURE,
    MATERIAL_DIRECTION,
    TURN,
    ROTATIONAL_STIFFNESS,
    LINE_STIFFNESS,
];
