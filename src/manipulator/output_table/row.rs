//! What a row of the table says of an output.

use nalgebra::Vector3;

use super::quantity::Quantity;
use super::spelling::{Printed, Spelled, Spelling};
use crate::equilibrium::Output;
use crate::magnetics::Wrench;
use crate::manipulator::Outputs;

/// Which number of an array is meant; both indices start at 0.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub struct Index {
    /// Number of the ring, core, cylinder, source or centreline point that the number belongs to.
    pub item: usize,
    /// Number of the component of its vector, quaternion or gradient.
    pub component: usize,
}

/// What an output is one of.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Owner {
    /// The device: there is one of it.
    Device,
    /// A point of the centreline; the name is that of an array over the points.
    Point,
    /// A ring; `[k]` in the name is its number.
    Ring,
    /// A core; `[k]` in the name is its number.
    Core,
    /// A magnet after the first one, or a coil; `{source}` in name and description stands for it.
    OtherSource,
    /// Any magnet or coil; `{source}` in name and description stands for it.
    Source,
    /// A contact with the wall, of which there are now more and now fewer.
    Contact,
}

impl Owner {
    /// Whether outputs of it are listed body by body: all of the first body, then all of the second.
    #[must_use]
    pub const fn is_body(self) -> bool {
        !matches!(self, Self::Device | Self::Point)
    }
}

/// Which devices have an output.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Scope {
    /// All.
    Always,
    /// Those on a shaft.
    Shaft,
    /// Those in a vessel.
    Vessel,
    /// Those whose scene asks for the wrenches of magnets and coils on one another.
    MutualWrenches,
}

/// A computation that is done only when what it gives is read.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Request {
    /// The stability margin.
    Margin,
    /// The wrench of magnets and coils on one another.
    MutualWrenches,
    /// Tangents and curvatures of the centreline.
    Strains,
}

/// A part of a wrench.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum WrenchPart {
    /// Its force, N.
    Force,
    /// Its torque, N m.
    Torque,
}

impl WrenchPart {
    /// This part of a wrench.
    #[must_use]
    pub fn of(self, wrench: &Wrench) -> Vector3<f64> {
        match self {
            Self::Force => wrench.force,
            Self::Torque => wrench.torque,
        }
    }
}

/// Where the derivatives of an output come from.
#[derive(Debug, Clone, Copy)]
pub enum Derivative {
    /// There are none: a solve adds it to the shape, as the energy.
    OfSolve,
    /// There are none: it is a whole number.
    Whole,
    /// The rows of the Jacobian of this output, of the body or point with this number.
    Rows(fn(usize) -> Output),
    /// The rotation of the tip, whose quaternion it is.
    TipQuaternion,
    /// The length of shaft that is inside, of which arc lengths are shares; without a shaft they do not change.
    ShareOfShaft,
    /// The differences of devices in equilibrium beside the present one.
    Neighbours,
    /// The wrench of all other magnets and coils on one of them.
    MutualWrench(WrenchPart),
}

impl Derivative {
    /// Whether the output is read from a shape, so that it has derivatives unless it is a whole number.
    #[must_use]
    pub const fn is_of_shape(self) -> bool {
        !matches!(self, Self::OfSolve)
    }
}

/// A row of the table: an output, where it is read, and how it is called.
#[derive(Debug, Clone, Copy)]
pub struct OutputRow {
    /// Structured name, as in the FMU.
    pub name: &'static str,
    /// The quantity, which fixes the unit.
    pub quantity: Quantity,
    /// Number of components: 1, 3 of a vector, 4 of a quaternion.
    pub components: usize,
    /// What it is one of.
    pub owner: Owner,
    /// Which devices have it.
    pub scope: Scope,
    /// Description for people.
    pub description: &'static str,
    /// One of its numbers, SI; NaN where there is none.
    pub get: fn(&Outputs, Index) -> f64,
    /// Where its derivatives come from.
    pub derivative: Derivative,
    /// Smallest and largest value, SI.
    pub bounds: [Option<f64>; 2],
    /// The computation that gives it, where a solve does not.
    pub request: Option<Request>,
    /// Whether the FMU has it.
    pub in_fmu: bool,
    /// The beginning of its key in JSON, which ends with the SI unit.
    pub json: Option<&'static str>,
    /// Its columns in the tables of sweeps and of measurements.
    pub column: Option<Spelling>,
    /// Its line in the table for people.
    pub printed: Option<Printed>,
}

impl OutputRow {
    /// A number of the device that solves give, by differences of neighbouring devices.
    pub(super) const fn new(
        name: &'static str,
        quantity: Quantity,
        description: &'static str,
        get: fn(&Outputs, Index) -> f64,
    ) -> Self {
        Self {
            name,
            quantity,
            components: 1,
            owner: Owner::Device,
            scope: Scope::Always,
            description,
            get,
            derivative: Derivative::Neighbours,
            bounds: [None, None],
            request: None,
            in_fmu: true,
            json: None,
            column: None,
            printed: None,
        }
    }

    pub(super) const fn components(mut self, components: usize) -> Self {
        self.components = components;
        self
    }

    pub(super) const fn vector(self) -> Self {
        self.components(3)
    }

    pub(super) const fn of(mut self, owner: Owner) -> Self {
        self.owner = owner;
        self
    }

    pub(super) const fn scope(mut self, scope: Scope) -> Self {
        self.scope = scope;
        self
    }

    pub(super) const fn derivative(mut self, derivative: Derivative) -> Self {
        self.derivative = derivative;
        self
    }

    pub(super) const fn min(mut self, min: f64) -> Self {
        self.bounds[0] = Some(min);
        self
    }

    pub(super) const fn max(mut self, max: f64) -> Self {
        self.bounds[1] = Some(max);
        self
    }

    pub(super) const fn on_request(mut self, request: Request) -> Self {
        self.request = Some(request);
        self
    }

    pub(super) const fn outside_the_fmu(mut self) -> Self {
        self.in_fmu = false;
        self
    }

    pub(super) const fn json(mut self, stem: &'static str) -> Self {
        self.json = Some(stem);
        self
    }

    pub(super) const fn column(mut self, stem: &'static str, unit: Spelled) -> Self {
        self.column = Some(Spelling { stem, unit });
        self
    }

    pub(super) const fn printed(mut self, label: &'static str, unit: Spelled, note: &'static str) -> Self {
        self.printed = Some(Printed { label, unit, note });
        self
    }

    /// How many there are of it.
    #[must_use]
    pub fn count(&self, outputs: &Outputs) -> usize {
        match self.owner {
            Owner::Device => 1,
            // Those on request are empty until they are computed.
            Owner::Point if self.request == Some(Request::Strains) => outputs.shape_tangents.len(),
            Owner::Point => outputs.shape.len(),
            Owner::Ring => outputs.rings.len(),
            Owner::Core => outputs.core_angles.len(),
            Owner::OtherSource => outputs.on_others().len(),
            Owner::Source => outputs.mutual_wrenches.len(),
            Owner::Contact => outputs.wall.as_ref().map_or(0, |wall| wall.places.len()),
        }
    }

    /// Whether a device with these outputs has it.
    #[must_use]
    pub fn is_present(&self, outputs: &Outputs) -> bool {
        match self.scope {
            Scope::Always => true,
            Scope::Shaft => outputs.feed_length.is_some(),
            Scope::Vessel => outputs.wall.is_some(),
            Scope::MutualWrenches => !outputs.mutual_wrenches.is_empty(),
        }
    }

    /// The components of number `item` of it, in a unit.
    #[must_use]
    pub fn read(&self, outputs: &Outputs, item: usize, unit: Spelled) -> Vec<f64> {
        let component = |component| (self.get)(outputs, Index { item, component }) * unit.per_si;
        (0..self.components).map(component).collect()
    }
}
