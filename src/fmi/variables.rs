//! The table of all variables. The model description, the documentation and every call that reads or sets a variable
//! follow from it.

mod design;

mod inputs;

mod outputs;

mod parameters;

mod rows;

mod sections;

mod sources;

mod vessel;

use super::host_values::HostValues;
use super::variable::{Causality, Variable};
use crate::design::unit_mistake::UnitRule;
use crate::error::Error;
use rows::Rows;

/// Reads and sets one number of [`HostValues`].
macro_rules! access {
    (|$values:ident, $index:ident| $number:expr) => {
        $crate::fmi::variable::Access::Real {
            get: |$values, $index| $number,
            set: |$values, $index, value| $number = value,
        }
    };
    (|$values:ident| $number:expr) => {
        $crate::fmi::variable::Access::Real {
            get: |$values, _| $number,
            set: |$values, _, value| $number = value,
        }
    };
}
use access;

/// Numbers of bodies and centreline points, which fix the lengths of the arrays.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Counts {
    /// Ring magnets.
    pub rings: usize,
    /// Cores of the helices, or elastic parts between rigid ones.
    pub cores: usize,
    /// Points of the centreline among the outputs.
    pub shape_points: usize,
    /// Whether the device sits on a shaft.
    pub shaft: bool,
    /// Number of rings that are clamped, the first ones.
    pub clamped_rings: usize,
}

/// The table for one design: the variable with value reference `r` is row `r`.
#[derive(Debug, Clone)]
pub struct Table {
    variables: Vec<Variable>,
    counts: Counts,
}

impl Table {
    /// Fewest and most centreline points.
    const SHAPE_POINTS: std::ops::RangeInclusive<usize> = 2..=1000;

    /// The table for the design that `start` describes, with this number of centreline points.
    ///
    /// # Errors
    /// Those of [`HostValues::design`]; [`Error::Unsupported`] for fewer than 2 or more than 1000 centreline points.
    pub fn new(start: &HostValues, shape_points: usize) -> Result<Self, Error> {
        if !Self::SHAPE_POINTS.contains(&shape_points) {
            return Err(Error::Unsupported(format!(
                "{shape_points} shape points: there must be from {} to {}",
                Self::SHAPE_POINTS.start(),
                Self::SHAPE_POINTS.end()
            )));
        }
        let design = start.design()?;
        let counts = Counts {
            rings: design.rings().count(),
            cores: design.segments().len(),
            shape_points,
            shaft: start.shaft.is_some(),
            // On a shaft the rings move.
            clamped_rings: if start.shaft.is_none() { design.base_rings().len() } else { 0 },
        };
        let mut rows = Rows::default();
        rows.inputs(&counts);
        rows.source_inputs(start);
        rows.feed_inputs(start);
        rows.guidewire_input(start);
        rows.design_parameters(start);
        rows.parameters(start);
        rows.vessel_parameters(start);
        rows.design_constants(start, &counts);
        rows.outputs(start, &counts);
        Ok(Self { variables: rows.variables, counts })
    }

    /// All rows, in the order of their value references.
    #[must_use]
    pub fn variables(&self) -> &[Variable] {
        &self.variables
    }

    /// Lengths of the arrays.
    #[must_use]
    pub fn counts(&self) -> Counts {
        self.counts
    }

    /// The variable with this value reference.
    #[must_use]
    pub fn find(&self, reference: u32) -> Option<&Variable> {
        self.variables.get(usize::try_from(reference).ok()?)
    }

    /// The error with the name of the parameter at fault, where it is about one of these.
    #[must_use]
    pub fn named(&self, error: Error) -> Error {
        let Error::Range { quantity, value, allowed, identity: Some(identity) } = &error else {
            return error;
        };
        let name = identity.variable();
        if self.reference(&name).is_none() {
            return error;
        }

        let guess = UnitRule::of(&name).and_then(|rule| rule.guess(*value, 1.0));
        let guess = guess.map_or_else(String::new, |guess| format!("; {guess}"));
        Error::range(format!("{name} ({quantity})"), *value, format!("{allowed}{guess}"))
    }

    /// Parameters that are allowed, but look as if they were given in another unit, each in a sentence that begins with its name; but for
    /// those that are as in `start`.
    #[must_use]
    pub fn warnings(&self, values: &HostValues, start: &HostValues) -> Vec<String> {
        let parameters = self.variables.iter().filter(|variable| variable.causality == Causality::Parameter);
        let odd = |variable: &Variable| {
            let own = variable.host_value(values).filter(|own| variable.host_value(start) != Some(*own));
            let mistake = UnitRule::of(&variable.name)?.mistake(&variable.name, own?.real()?, 1.0)?;
            Some(mistake.to_string())
        };
        parameters.filter_map(odd).collect()
    }

    /// The value reference of the variable with this name.
    #[must_use]
    pub fn reference(&self, name: &str) -> Option<u32> {
        self.variables.iter().position(|variable| variable.name == name)?.try_into().ok()
    }
}
