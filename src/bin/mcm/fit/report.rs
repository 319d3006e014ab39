//! What a fit found, as a table for people.

use mcm::fit::{Cell, Fit, Measurable, Parameter};

/// Correlation from which two parameters are named.
const COUPLED: f64 = 0.95;

/// Probability of residuals below which the stated deviations are doubted.
const UNLIKELY: f64 = 0.001;

/// The whole report.
pub(super) fn of(fit: &Fit) -> String {
    let mut out = vec![parameters(fit), "\nresiduals, measured minus computed\n".into()];
    for output in Measurable::all() {
        let cells: Vec<&Cell> = fit.cells.iter().filter(|cell| cell.output == output.name()).collect();
        out.push(residuals(output, &cells));
    }
    out.push(scatter(fit));

    let light = fit.cells.iter().filter(|cell| cell.weight < 0.5).collect::<Vec<_>>();
    if !light.is_empty() {
        let lines: Vec<String> =
            light.iter().map(|cell| format!("{} ({})", cell.line, cell.output)).collect();
        out.push(format!("values that count less than half, by line: {}\n", lines.join(", ")));
    }

    for direction in &fit.directions {
        let changes = direction.keys.iter().zip(&direction.changes);
        let changes: Vec<String> = changes.map(|(key, change)| format!("{change:+.3} {key}")).collect();
        let words = direction.words();
        out.push(format!(
            "\n{words}: they change by {:.2} standard deviations along\n    {}\n",
            direction.strength,
            changes.join(" ")
        ));
    }

    if !fit.experiments.is_empty() {
        out.push("what would help most, of what was tried:\n".into());
    }
    for experiment in &fit.experiments {
        out.push(format!("    {}\n", experiment.words()));
    }

    out.concat()
}

fn parameters(fit: &Fit) -> String {
    let width = fit.parameters.iter().map(|each| each.key.len()).max().unwrap_or_default().max(9);
    let head =
        format!("{:width$} {:>12} {:>12} {:>12}   95 % interval\n", "parameter", "start", "fitted", "sd");
    let mut out = vec![head];

    for Parameter { key, start, value, deviation, interval, at_limit } in &fit.parameters {
        let deviation = deviation.map_or("unknown".into(), |deviation| format!("{deviation:.2e}"));
        let [low, high] = interval.map(|end| end.map_or("open".into(), digits));
        let interval = if deviation == "unknown" { "unknown".into() } else { format!("{low} to {high}") };
        let limit = if *at_limit { "   at the end of its range" } else { "" };
        out.push(format!(
            "{key:width$} {:>12} {:>12} {deviation:>12}   {interval}{limit}\n",
            digits(*start),
            digits(*value)
        ));
    }

    for (i, first) in fit.parameters.iter().enumerate() {
        for (j, second) in fit.parameters.iter().enumerate().skip(i + 1) {
            let value = fit.correlation[(i, j)];
            if value.abs() > COUPLED {
                out.push(format!("correlation of {} and {}: {value:.3}\n", first.key, second.key));
            }
        }
    }

    out.concat()
}

/// Seven significant digits.
fn digits(value: f64) -> String {
    let rounded: f64 = format!("{value:.6e}").parse().unwrap_or(value);
    rounded.to_string()
}

fn residuals(output: &Measurable, cells: &[&Cell]) -> String {
    let error = |cell: &&Cell| cell.measured - cell.computed;
    let largest = cells.iter().max_by(|a, b| error(a).abs().total_cmp(&error(b).abs()));
    let Some(largest) = largest else { return String::new() };
    let squares: f64 = cells.iter().map(|cell| error(cell).powi(2)).sum();
    format!(
        "{:26} {:>6} values, root mean square {:.3e} {unit}, largest {:.3e} {unit} in line {}\n",
        output.name(),
        cells.len(),
        (squares / cells.len() as f64).sqrt(),
        error(largest),
        largest.line,
        unit = output.unit()
    )
}

fn scatter(fit: &Fit) -> String {
    let Fit { scatter, freedoms, stated, probability, .. } = fit;
    if *freedoms == 0 {
        return "as many parameters as values: nothing is left to tell how well they are measured\n".into();
    }
    if !stated {
        return format!("standard deviation of a value, from {freedoms} degrees of freedom: {scatter:.3e}\n");
    }
    let doubt = match probability {
        Some(probability) if *probability < UNLIKELY => {
            ": so large by chance once in a thousand at most; the model or the stated deviations are wrong"
        }
        _ => "",
    };
    format!("residuals are {scatter:.3} times the stated deviations, {freedoms} degrees of freedom{doubt}\n")
}
