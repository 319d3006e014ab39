//! The table that compares the models with the paper, in Markdown.

use mcm::studies::{Comparison, Study, Value};

const HEADER: &str = "\
| quantity | paper | its model as printed | exact model | exact beside paper | what it means |
| --- | --- | --- | --- | --- | --- |
";

/// The table of all studies; each row begins with the name of its figure.
pub(super) fn table<'a>(studies: impl IntoIterator<Item = (&'a str, &'a Study)>) -> String {
    let rows = studies
        .into_iter()
        .flat_map(|(name, study)| study.comparison.iter().map(move |comparison| row(name, comparison)));
    format!("{HEADER}{}", rows.collect::<String>())
}

fn row(name: &str, row: &Comparison) -> String {
    let computed = |value: &Value| written(value, |number| format!("{number:.*}", row.decimals));
    let difference = row.difference().map_or_else(String::new, |share| format!("{:+.1} %", 100.0 * share));
    format!(
        "| {name}: {} | {} | {} | {} | {} | {} |\n",
        row.quantity,
        written(&row.paper, |number| number.to_string()), // with the digits printed in the paper
        computed(&row.printed),
        computed(&row.exact),
        difference,
        row.remark
    )
}

fn written(value: &Value, digits: impl Fn(f64) -> String) -> String {
    match value {
        Value::Absent => String::new(),
        Value::Number(number) => digits(*number),
        Value::Range(low, high) => format!("{} to {}", digits(*low), digits(*high)),
        Value::Words(words) => words.clone(),
    }
}
