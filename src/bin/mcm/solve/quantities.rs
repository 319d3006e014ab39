//! What a solve has found, in the units of the printed table.

use mcm::manipulator::Outputs;
use mcm::manipulator::output_table::{self, OutputRow, Owner};

/// A quantity with its components in a unit.
pub(super) struct Quantity {
    pub(super) name: String,
    pub(super) components: Vec<f64>,
    pub(super) unit: String,
}

/// What the shape and its forces are, in the units of the table.
pub(super) fn quantities(outputs: &Outputs) -> Vec<Quantity> {
    let lines = output_table::rows().filter(|row| row.printed.is_some() && row.is_present(outputs));
    let lines: Vec<&OutputRow> = lines.collect();
    let together = |a: &&OutputRow, b: &&OutputRow| a.owner == b.owner && a.owner.is_body();
    let mut out = Vec::new();
    for rows in lines.chunk_by(together) {
        for item in 0..rows[0].count(outputs) {
            out.extend(rows.iter().filter_map(|row| line(row, outputs, item)));
        }
    }
    out
}

/// The line of number `item` of an output; `None` for one that the table does not have.
fn line(row: &OutputRow, outputs: &Outputs, item: usize) -> Option<Quantity> {
    let printed = row.printed?;
    // Of magnets and coils the external magnet is the first.
    let number = if row.owner == Owner::OtherSource { item + 2 } else { item + 1 };
    let unit = [printed.unit.label, printed.note];
    Some(Quantity {
        name: printed.label.replace("{}", &number.to_string()),
        components: row.read(outputs, item, printed.unit),
        unit: unit.into_iter().filter(|part| !part.is_empty()).collect::<Vec<_>>().join(", "),
    })
}
