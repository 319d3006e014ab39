//! What can be measured: the columns of outputs in a table, in any unit.

use std::sync::LazyLock;

use crate::manipulator::Outputs;
use crate::manipulator::output_table::{self, Derivative, Index, OutputRow, Spelled};

/// An output that a row can measure, in the unit of its name.
#[derive(Debug, Clone, Copy)]
pub struct Measurable {
    name: &'static str,
    unit: Spelled,
    row: &'static OutputRow,
    component: usize,
}

impl Measurable {
    /// All of them: the columns of `mcm sweep` that an instrument can tell, by these names or by those of the FMU with `_` instead of
    /// dots (`alpha_deg`, `tip_angle_deg`), also in other units (`alpha_rad`, `tip_x_m`).
    #[must_use]
    pub fn all() -> &'static [Self] {
        static ALL: LazyLock<Vec<Measurable>> = LazyLock::new(|| {
            let known = COLUMNS.iter().map(|known| Measurable {
                name: &known.name,
                unit: known.unit,
                row: known.row,
                component: known.component,
            });
            known.collect()
        });
        &ALL
    }

    /// The one with this name.
    #[must_use]
    pub fn named(name: &str) -> Option<Self> {
        Self::all().iter().find(|known| known.name == name).copied()
    }

    /// Name of its column, with the unit.
    #[must_use]
    pub fn name(&self) -> &'static str {
        self.name
    }

    /// Unit of its column.
    #[must_use]
    pub fn unit(&self) -> &'static str {
        self.unit.label
    }

    /// Its value, in the unit of the column; NaN where the device has none.
    #[must_use]
    pub fn read(&self, outputs: &Outputs) -> f64 {
        (self.row.get)(outputs, Index { item: 0, component: self.component }) * self.unit.per_si
    }
}

/// A spelling of a component of an output.
struct Column {
    name: String,
    unit: Spelled,
    row: &'static OutputRow,
    component: usize,
}

static COLUMNS: LazyLock<Vec<Column>> = LazyLock::new(|| {
    let mut all = Vec::new();
    for row in output_table::rows().filter(|row| is_measurable(row)) {
        for (stem, unit) in row.spellings() {
            let columns = row.columns_in(&stem, unit).into_iter().enumerate();
            all.extend(columns.map(|(component, name)| Column { name, unit, row, component }));
        }
    }
    all
});

/// Whether an instrument can tell it: whether it is read from the shape, and no whole number.
fn is_measurable(row: &OutputRow) -> bool {
    row.derivative.is_of_shape() && !matches!(row.derivative, Derivative::Whole)
}

/// Whether this is a column of `mcm sweep` that no instrument can tell.
pub(super) fn is_untold(title: &str) -> bool {
    let untold = output_table::rows().filter(|row| !is_measurable(row));
    untold.flat_map(OutputRow::columns).any(|column| column == title)
}
