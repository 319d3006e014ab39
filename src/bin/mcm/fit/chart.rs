//! Measured against computed values, and the residuals.

use mcm::fit::{Cell, Fit, Measurable};
use mcm::studies::{Column, Curve, Mark, Panel, Stroke, Study};

/// Most outputs that have axes of their own.
const OUTPUTS: usize = 3;

/// The panels of a fit.
pub(super) fn of(fit: &Fit) -> Study {
    // Of each output in the order of the computed values, so that the line of equal ones is a line.
    let mut cells: Vec<&Cell> = fit.cells.iter().collect();
    cells.sort_by(|a, b| {
        (a.output, a.computed).partial_cmp(&(b.output, b.computed)).unwrap_or(core::cmp::Ordering::Equal)
    });
    let outputs: Vec<&Measurable> = Measurable::all()
        .iter()
        .filter(|output| cells.iter().any(|cell| cell.output == output.name()))
        .collect();
    let column = |name: String, output: &str, read: fn(&Cell) -> f64| {
        let value = |cell: &&Cell| if cell.output == output { read(cell) } else { f64::NAN };
        Column::new(name, cells.iter().map(value).collect())
    };
    let mut columns = vec![Column::new("line", cells.iter().map(|cell| cell.line as f64).collect())];
    for output in &outputs {
        let name = output.name();
        columns.push(column(format!("computed {name}"), name, |cell| cell.computed));
        columns.push(column(format!("measured {name}"), name, |cell| cell.measured));
        columns.push(column(format!("residual {name}"), name, |cell| cell.residual));
    }
    let shown = outputs.iter().take(OUTPUTS).enumerate().map(|(number, output)| {
        let (name, unit) = (output.name(), output.unit());
        Panel::Curves {
            title: name.into(),
            x: (format!("computed ({unit})"), format!("computed {name}")),
            y: format!("measured ({unit})"),
            curves: vec![
                Curve::new("equal", format!("computed {name}"), OUTPUTS + 1, Stroke::Solid),
                Curve::new("measured", format!("measured {name}"), number, Stroke::Dots),
            ],
            marks: Vec::new(),
        }
    });
    let mut panels: Vec<Panel> = shown.collect();
    let curve = |(number, output): (usize, &&Measurable)| {
        let label = if outputs.len() > 1 && outputs.len() <= OUTPUTS { output.name() } else { "" };
        Curve::new(label, format!("residual {}", output.name()), number, Stroke::Dots)
    };
    let unit = if fit.stated { "residual (sd)" } else { "residual" };
    let width = 2.0 * if fit.stated { 1.0 } else { fit.scatter };
    panels.push(Panel::Curves {
        title: "residuals".into(),
        x: ("line of the table".into(), "line".into()),
        y: unit.into(),
        curves: outputs.iter().enumerate().map(curve).collect(),
        marks: vec![Mark::Band("two standard deviations".into(), [-width, width])],
    });
    Study { title: "Fit: what was measured, and what is computed", columns, panels, comparison: Vec::new() }
}
