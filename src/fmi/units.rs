//! Units, and the quantities that are measured in them.

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
    pub nominal: Option<f64>,
}

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
];

const fn quantity(
    name: &'static str,
    unit: &'static str,
    nominal: Option<f64>,
    description: &'static str,
) -> Quantity {
    Quantity { name, unit, description, nominal }
}

/// Position in the world frame, m.
pub const POSITION: Quantity = quantity("Position", "m", Some(0.01), "Position in the world frame");
/// Length, m.
pub const LENGTH: Quantity = quantity("Length", "m", Some(0.001), "Length");
/// Angle, rad.
pub const ANGLE: Quantity = quantity("Angle", "rad", Some(1.0), "Angle");
/// Component of a unit quaternion, 1.
pub const QUATERNION: Quantity =
    quantity("Quaternion", "1", None, "Component of a unit quaternion w, x, y, z, body to world");
/// Component of a unit vector, 1.
pub const DIRECTION: Quantity = quantity("Direction", "1", None, "Component of a unit vector, world frame");
/// Dimensionless number, 1.
pub const RATIO: Quantity = quantity("Ratio", "1", None, "Dimensionless number");
/// Shore A hardness, 1.
pub const HARDNESS: Quantity = quantity("ShoreA", "1", Some(10.0), "Shore A hardness");
/// Magnetic flux density, T.
pub const FIELD: Quantity = quantity("FluxDensity", "T", Some(0.01), "Magnetic flux density, world frame");
/// Remanence, T.
pub const REMANENCE: Quantity = quantity("Remanence", "T", Some(1.0), "Remanent flux density along the axis");
/// Gradient of the magnetic flux density, T/m.
pub const GRADIENT: Quantity =
    quantity("FieldGradient", "T/m", Some(1.0), "Gradient of the magnetic flux density, world frame");
/// Force, N.
pub const FORCE: Quantity = quantity("Force", "N", Some(0.01), "Force, world frame");
/// Moment or torque, N.m.
pub const MOMENT: Quantity = quantity("Moment", "N.m", Some(0.001), "Moment or torque, world frame");
/// Acceleration, m/s2.
pub const ACCELERATION: Quantity = quantity("Acceleration", "m/s2", Some(10.0), "Acceleration, world frame");
/// Young's modulus, Pa.
pub const MODULUS: Quantity = quantity("ElasticModulus", "Pa", Some(1e6), "Young's modulus");
/// Density, kg/m3.
pub const DENSITY: Quantity = quantity("Density", "kg/m3", Some(1000.0), "Mass per volume");
/// Electric current, A.
pub const CURRENT: Quantity = quantity("Current", "A", Some(1.0), "Electric current");
/// Processor time, s.
pub const TIME: Quantity = quantity("ProcessorTime", "s", Some(1.0), "Processor time");

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
];
