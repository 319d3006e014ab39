//! The report of a solve as JSON, in SI units.

use mcm::error::Error;
use mcm::manipulator::output_table::{self, Derivative, OutputRow, Owner, Scope};
use mcm::manipulator::{Collapse, Jacobian, Outputs};
use nalgebra::SMatrix;
use serde_json::{Value, json};

use crate::verdict;

/// Report of the solve and the shape found, or why the device closes; without a shape, all its numbers are null. With
/// `uncertainty` where it is asked for, null where it cannot be told, and with the `warnings` of a scene that has some.
pub(super) fn as_json(
    (outputs, collapse): (&Outputs, Option<&Collapse>),
    jacobian: &Result<Jacobian, Error>,
    magnet: bool,
    uncertainty: Option<Value>,
    warnings: &[String],
) -> Value {
    let derivatives = jacobian.as_ref().ok().map(|jacobian| {
        json!({
            "tip_by_magnet": magnet.then(|| rows(&jacobian.tip_by_magnet())),
            "tip_by_uniform_field": rows(&jacobian.tip_by_uniform_field()),
        })
    });
    let converged = verdict::converged(outputs);
    let search = [
        ("converged", json!(converged)),
        ("status", json!(verdict::status(outputs))),
        ("outcome", json!(outputs.outcome.name())),
        ("reason", json!(verdict::reason(outputs, collapse))),
        ("progress", json!(outputs.progress)),
        ("stability", json!(verdict::stability(outputs))),
        ("iterations", json!(outputs.iterations)),
        ("residual", json!(outputs.residual)),
        ("interaction", json!(outputs.interaction.name())),
        ("method", json!(outputs.method.name())),
        ("jacobian", json!(derivatives)),
        ("jacobian_note", json!(jacobian.as_ref().err().map(ToString::to_string))),
    ];
    let verdict = [("stable", json!(outputs.stable)), ("snaps", json!(outputs.snaps))];
    let verdict = verdict.map(|(key, value)| (key.to_owned(), value));
    let found = rows_with_keys().filter_map(|(key, row)| Some((key, value(row, outputs)?))).chain(verdict);
    let found = found.map(|(key, value)| (key, if converged { value } else { Value::Null }));
    let search = search.map(|(key, value)| (key.to_owned(), value));
    let uncertainty = uncertainty.map(|told| ("uncertainty".to_owned(), told));
    let odd = (!warnings.is_empty()).then(|| ("warnings".to_owned(), json!(warnings)));
    found.chain(search).chain(uncertainty).chain(odd).collect()
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
