//! Measured against computed values, and the residuals.

use mcm::fit::{Cell, Fit, Measurable};

use crate::picture::chart::{Chart, Curve, Panel, Run, Stroke, colour};
use crate::picture::units::label;

/// Most outputs that have axes of their own.
const OUTPUTS: usize = 3;

/// The chart of a fit.
pub(super) fn of(fit: &Fit) -> Chart {
    let cells_of = |output: &Measurable| -> Vec<&Cell> {
        fit.cells.iter().filter(|cell| cell.output == output.name()).collect()
    };
    let outputs: Vec<(&Measurable, Vec<&Cell>)> = Measurable::all()
        .iter()
        .map(|output| (output, cells_of(output)))
        .filter(|(_, cells)| !cells.is_empty())
        .collect();

    let count = outputs.len();
    let points = |number: usize, name: &str, points: Vec<(f64, f64)>| Curve {
        name: name.into(),
        colour: colour(number, count),
        runs: vec![Run { stroke: Stroke::Points, points }],
        snaps: Vec::new(),
    };

    let compared = outputs.iter().enumerate().take(OUTPUTS).map(|(number, (output, cells))| {
        let computed = cells.iter().map(|cell| cell.computed);
        let (least, most) =
            (computed.clone().fold(f64::INFINITY, f64::min), computed.fold(f64::NEG_INFINITY, f64::max));
        let equal = Curve {
            name: "equal".into(),
            colour: colour(number, count),
            runs: vec![Run { stroke: Stroke::Solid, points: vec![(least, least), (most, most)] }],
            snaps: Vec::new(),
        };
        let measured = cells.iter().map(|cell| (cell.computed, cell.measured)).collect();
        Panel {
            labels: ["computed", "measured"].map(|what| format!("{what} {}", label(output.name()))),
            curves: vec![equal, points(number, "", measured)],
            band: None,
        }
    });
    let mut panels: Vec<Panel> = compared.collect();

    let residuals = outputs.iter().enumerate().map(|(number, (output, cells))| {
        let name = if count > 1 { output.name() } else { "" };
        points(number, name, cells.iter().map(|cell| (cell.line as f64, cell.residual)).collect())
    });

    let width = 2.0 * if fit.stated { 1.0 } else { fit.scatter };
    panels.push(Panel {
        labels: ["line of the table", if fit.stated { "residual (sd)" } else { "residual" }]
            .map(String::from),
        curves: residuals.collect(),
        band: Some(("two sd".into(), [-width, width])),
    });

    Chart { title: "Fit: what was measured, and what is computed".into(), one_abscissa: false, panels }
}
