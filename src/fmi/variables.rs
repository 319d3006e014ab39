//! The table of all variables, from which everything else about them follows.

mod answers;
mod parameters;

use super::given::Given;
use super::slope::Slope;
use super::units::{ACCELERATION, FIELD, FORCE, GRADIENT, MOMENT, POSITION, QUATERNION, Quantity, RATIO};
use super::variable::{Access, At, Kind, Reach, Role, Value, Variable};
use crate::design::SpanKind;
use crate::error::Error;
use crate::manipulator::Input;

/// Reads and sets one place of [`Given`].
macro_rules! place {
    (|$given:ident, $at:ident| $place:expr) => {
        Access::Real { get: |$given, $at| $place, set: |$given, $at, value| $place = value }
    };
}
use place;

/// The output that takes a measurement of its own, made when it is asked for.
pub const MARGIN: &str = "stability.margin";

/// Numbers of bodies and points, which fix the length of the arrays.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Counts {
    /// Ring magnets.
    pub rings: usize,
    /// Cores (elements of a plain cylinder).
    pub cores: usize,
    /// Points of the centreline in the outputs.
    pub shape_points: usize,
    /// Whether the first ring is clamped.
    pub clamped_ring: bool,
}

/// The table for one design: value reference `r` is row `r`.
#[derive(Debug, Clone)]
pub struct Table {
    variables: Vec<Variable>,
    counts: Counts,
}

impl Table {
    /// Fewest and most centreline points.
    const SHAPE_POINTS: std::ops::RangeInclusive<usize> = 2..=1000;

    /// The table of the design in `start`.
    ///
    /// # Errors
    /// [`Error::Range`] for a design that is refused, [`Error::Unsupported`] for fewer than 2 or more than
    /// 1000 shape points.
    pub fn new(start: &Given, shape_points: usize) -> Result<Self, Error> {
        if !Self::SHAPE_POINTS.contains(&shape_points) {
            return Err(Error::Unsupported(format!(
                "{shape_points} shape points: there must be from {} to {}",
                Self::SHAPE_POINTS.start(),
                Self::SHAPE_POINTS.end()
            )));
        }
        let design = start.design()?;
        let spans = design.segments().iter().flat_map(|segment| &segment.spans);
        let counts = Counts {
            rings: design.rings().count(),
            cores: spans.filter(|span| span.kind != SpanKind::Disc).count(),
            shape_points,
            clamped_ring: design.base_ring().is_some(),
        };
        let mut rows = Rows::default();
        rows.inputs(&counts);
        rows.parameters(start);
        rows.facts(start, &counts);
        rows.answers(&counts);
        Ok(Self { variables: rows.variables, counts })
    }

    /// All rows.
    #[must_use]
    pub fn variables(&self) -> &[Variable] {
        &self.variables
    }

    /// Lengths of the arrays.
    #[must_use]
    pub fn counts(&self) -> Counts {
        self.counts
    }

    /// The row with this value reference.
    #[must_use]
    pub fn find(&self, reference: u32) -> Option<&Variable> {
        self.variables.get(usize::try_from(reference).ok()?)
    }

    /// The value reference of the variable with this name.
    #[must_use]
    pub fn reference(&self, name: &str) -> Option<u32> {
        self.variables.iter().position(|variable| variable.name == name)?.try_into().ok()
    }
}

/// A row before its name's index and its place in an array are known.
#[derive(Debug, Clone)]
pub(super) struct Draft {
    name: String,
    description: String,
    kind: Kind,
    role: Role,
    access: Access,
    min: Option<f64>,
    max: Option<f64>,
    reach: Reach,
    slope: Slope,
}

impl Draft {
    fn new(name: impl Into<String>, kind: Kind, description: impl Into<String>, access: Access) -> Self {
        Self {
            name: name.into(),
            description: description.into(),
            kind,
            role: Role::Input,
            access,
            min: None,
            max: None,
            reach: Reach::Equilibrium,
            slope: Slope::None,
        }
    }

    fn real(name: impl Into<String>, quantity: Quantity, description: &str, access: Access) -> Self {
        Self::new(name, Kind::Real(quantity), description, access)
    }

    fn role(self, role: Role) -> Self {
        Self { role, ..self }
    }

    fn min(self, min: f64) -> Self {
        Self { min: Some(min), ..self }
    }

    fn max(self, max: f64) -> Self {
        Self { max: Some(max), ..self }
    }

    fn reach(self, reach: Reach) -> Self {
        Self { reach, ..self }
    }

    fn slope(self, slope: Slope) -> Self {
        Self { slope, ..self }
    }

    fn at(self, name: String, at: At) -> Variable {
        let Self { description, kind, role, access, min, max, reach, slope, .. } = self;
        Variable { name, description, kind, role, min, max, at, access, reach, slope }
    }
}

#[derive(Debug, Default)]
pub(super) struct Rows {
    variables: Vec<Variable>,
}

impl Rows {
    fn one(&mut self, draft: Draft) {
        self.item(draft, 0);
    }

    /// A scalar that belongs to body or point `item`.
    fn item(&mut self, draft: Draft, item: usize) {
        let name = draft.name.clone();
        self.variables.push(draft.at(name, At { item, axis: 0 }));
    }

    /// `name[1]` to `name[length]`.
    fn array(&mut self, length: usize, draft: &Draft) {
        self.item_array(length, 0, draft);
    }

    /// The same for body `item`.
    fn item_array(&mut self, length: usize, item: usize, draft: &Draft) {
        for axis in 0..length {
            let name = format!("{}[{}]", draft.name, axis + 1);
            self.variables.push(draft.clone().at(name, At { item, axis }));
        }
    }

    fn inputs(&mut self, counts: &Counts) {
        self.array(
            3,
            &Draft::real(
                "magnet.position",
                POSITION,
                "Centre of the external magnet assembly",
                place!(|g, at| g.magnet.position[at.axis]),
            )
            .slope(Slope::Input(Input::MagnetPosition)),
        );
        self.array(
            4,
            &Draft::real(
                "magnet.orientation",
                QUATERNION,
                "Orientation of the external magnet assembly, whose dipole axis is its z: unit quaternion w, x, y, z",
                place!(|g, at| g.magnet.orientation[at.axis]),
            ).slope(Slope::InputQuaternion(Input::MagnetRotation)),
        );
        self.one(
            Draft::real(
                "magnet.strength",
                RATIO,
                "Factor on the external magnet's field; 0 switches it off",
                place!(|g, _at| g.magnet_strength),
            )
            .slope(Slope::Input(Input::MagnetStrength)),
        );
        self.array(
            3,
            &Draft::real(
                "field.uniform",
                FIELD,
                "Uniform background field",
                place!(|g, at| g.uniform_field[at.axis]),
            )
            .slope(Slope::Input(Input::UniformField)),
        );
        self.array(
            5,
            &Draft::real(
                "field.gradient",
                GRADIENT,
                "dBx/dx, dBx/dy, dBx/dz, dBy/dy, dBy/dz of a linear field about the world origin",
                place!(|g, at| g.field_gradient[at.axis]),
            )
            .slope(Slope::Input(Input::FieldGradient)),
        );
        self.array(
            3,
            &Draft::real(
                "base.position",
                POSITION,
                "Position of the clamped base",
                place!(|g, at| g.base.position[at.axis]),
            )
            .slope(Slope::Input(Input::BasePosition)),
        );
        self.array(
            4,
            &Draft::real(
                "base.orientation",
                QUATERNION,
                "Orientation of the clamped base: unit quaternion w, x, y, z",
                place!(|g, at| g.base.orientation[at.axis]),
            )
            .slope(Slope::InputQuaternion(Input::BaseRotation)),
        );
        self.array(
            3,
            &Draft::real("tip.load_force", FORCE, "Force on the tip", place!(|g, at| g.tip_force[at.axis]))
                .slope(Slope::Input(Input::TipForce)),
        );
        self.array(
            3,
            &Draft::real(
                "tip.load_moment",
                MOMENT,
                "Moment on the tip",
                place!(|g, at| g.tip_moment[at.axis]),
            )
            .slope(Slope::Input(Input::TipMoment)),
        );
        for ring in 0..counts.rings {
            let name = format!("ring[{}].load_force", ring + 1);
            let load = place!(|g, at| g.ring_forces[at.item][at.axis]);
            let draft = Draft::real(name, FORCE, "Force at the ring's centre", load);
            self.item_array(3, ring, &draft.slope(Slope::Input(Input::RingForce(ring))));
        }
    }

    fn facts(&mut self, start: &Given, counts: &Counts) {
        use crate::design::Specification::{Cylinder, Segmented};
        let mut fact = |name: &str, description: &str, value: Value| {
            let kind = if matches!(value, Value::Boolean(_)) { Kind::Boolean } else { Kind::Integer };
            self.one(Draft::new(name, kind, description, Access::Fact(value)).role(Role::Constant));
        };
        let count = |number: usize| Value::Integer(i32::try_from(number).unwrap_or(i32::MAX));
        match &start.specification {
            Segmented(segmented) => {
                fact("design.segments", "Number of segments", count(segmented.segments));
                let base = Value::Boolean(segmented.base_magnet);
                fact("design.base_magnet", "Whether the chain starts with a ring magnet", base);
                let tip = Value::Boolean(segmented.tip_magnet);
                fact("design.tip_magnet", "Whether the chain ends with a ring magnet", tip);
            }
            Cylinder(_) => {}
        }
        fact("design.rings", "Number of ring magnets", count(counts.rings));
        fact("shape.points", "Number of centreline points", count(counts.shape_points));
    }

    fn gravity(&mut self) {
        let gravity = place!(|g, at| g.gravity[at.axis]);
        let draft = Draft::real("gravity", ACCELERATION, "Acceleration of gravity", gravity);
        self.array(3, &draft.role(Role::Tunable).slope(Slope::Input(Input::Gravity)));
    }
}
