//! The report of a solve as JSON, in SI units.

use mcm::error::Error;
use mcm::manipulator::output_table::{self, Derivative, OutputRow, Owner, Scope};
use mcm::manipulator::{Collapse, Jacobian, Outputs};
use mcm::methods::Method;
use nalgebra::SMatrix;
use serde_json::{Value, json};

use crate::verdict;

/// What a solve found.
pub(super) struct Report<'a> {
    pub(super) method: Method,
    pub(super) outputs: &'a Outputs,
    /// Why the device closes, if it does.
    pub(super) collapse: Option<&'a Collapse>,
    pub(super) jacobian: &'a Result<Jacobian, Error>,
    /// Whether the scene has a magnet.
    pub(super) magnet: bool,
    /// Where it is asked for; null where it cannot be told.
    pub(super) uncertainty: Option<Value>,
    /// Warnings of the scene.
    pub(super) warnings: Vec<String>,
}

impl Report<'_> {
    /// All of it; without a shape, all numbers of one are null.
    pub(super) fn as_json(&self) -> Value {
        let (outputs, converged) = (self.outputs, verdict::converged(self.outputs));
        let derivatives = self.jacobian.as_ref().ok().map(|jacobian| {
            json!({
                "tip_by_magnet": jacobian.tip_by_source(0).filter(|_| self.magnet).map(|block| rows(&block)),
                "tip_by_uniform_field": rows(&jacobian.tip_by_uniform_field()),
            })
        });

        let solved = [("stable", json!(outputs.stable)), ("snaps", json!(outputs.snaps))].map(named);
        let shape = rows_with_keys().filter_map(|(key, row)| Some((key, value(row, outputs)?)));
        let found =
            shape.chain(solved).map(|(key, value)| (key, if converged { value } else { Value::Null }));

        let search = [
            ("converged", json!(converged)),
            ("status", json!(verdict::status(outputs))),
            ("outcome", json!(outputs.outcome.name())),
            ("reason", json!(verdict::reason(outputs, self.collapse))),
            ("progress", json!(outputs.progress)),
            ("stability", json!(verdict::stability(outputs))),
            ("iterations", json!(outputs.iterations)),
            ("residual", json!(outputs.residual)),
            ("interaction", json!(outputs.interaction.name())),
            ("method", json!(self.method.name())),
            ("jacobian", json!(derivatives)),
            ("jacobian_note", json!(self.jacobian.as_ref().err().map(ToString::to_string))),
        ];

        let uncertainty = self.uncertainty.clone().map(|bands| named(("uncertainty", bands)));
        let odd = (!self.warnings.is_empty()).then(|| named(("warnings", json!(self.warnings))));
        found.chain(search.map(named)).chain(uncertainty).chain(odd).collect()
    }
}

fn named((key, value): (&str, Value)) -> (String, Value) {
    (key.to_owned(), value)
}

/// The rows of the table of outputs that JSON has, with their keys.
pub(super) fn rows_with_keys() -> impl Iterator<Item = (String, &'static OutputRow)> {
    output_table::rows().filter_map(|row| Some((row.json_key()?, row)))
}

/// The value of an output: a number, a list of components, or a list of these; null where the device has none, `None` for what the scene
/// does not ask for.
pub(super) fn value(row: &OutputRow, outputs: &Outputs) -> Option<Value> {
    if !row.is_present(outputs) {
        return (row.scope != Scope::MutualWrenches).then_some(Value::Null);
    }
    let whole = matches!(row.derivative, Derivative::Whole);
    #[expect(clippy::cast_possible_truncation, reason = "counts of contacts are small")]
    let number = |number: f64| if whole { json!(number as i64) } else { json!(number) };
    let item = |item| {
        let components = row.read(outputs, item, row.quantity.si());
        match components[..] {
            [only] => number(only),
            _ => json!(components),
        }
    };
    Some(match row.owner {
        Owner::Device => item(0),
        _ => (0..row.count(outputs)).map(item).collect(),
    })
}

/// A matrix as a list of its rows.
fn rows<const COLUMNS: usize>(matrix: &SMatrix<f64, 6, COLUMNS>) -> Vec<Vec<f64>> {
    matrix.row_iter().map(|row| row.iter().copied().collect()).collect()
}
