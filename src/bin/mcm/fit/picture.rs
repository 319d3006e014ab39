//! The picture of a fit.

use mcm::fit::Fit;
use mcm::studies::{Column, Curve, Mark, Panel, Stroke, Study};

use super::rows::Rows;

/// Number of outputs that have a panel of their own.
const SHOWN: usize = 3;

/// Half width of the band in which 95 % of normal residuals lie, in deviations.
const BAND: f64 = 1.96;

/// Measured and computed values over the rows, and all residuals in deviations.
pub(super) fn study(rows: &Rows, fit: &Fit) -> Study {
    let count = rows.names.len();
    let numbers = (1..=rows.data.len()).map(|number| number as f64).collect();
    let mut columns = vec![Column::new("row", numbers)];
    let (mut panels, mut residuals) = (Vec::new(), Vec::new());
    let x = || ("row".to_owned(), "row".to_owned());
    for (place, name) in rows.names.iter().enumerate() {
        let own = |values: &[f64]| values.iter().skip(place).step_by(count).copied().collect::<Vec<f64>>();
        let (computed, missing, noise) = (own(fit.computed()), own(fit.residuals()), own(fit.noise()));
        let measured = computed.iter().zip(&missing).map(|(value, missing)| value + missing).collect();
        let relative = missing.iter().zip(noise).map(|(missing, deviation)| missing / deviation).collect();
        let [first, second, third] =
            ["measured", "computed", "residual"].map(|kind| format!("{kind}_{name}"));
        columns.push(Column::new(first.clone(), measured));
        columns.push(Column::new(second.clone(), computed));
        columns.push(Column::new(third.clone(), relative));
        residuals.push(Curve::new(name.clone(), third, place, Stroke::Dots));
        if place < SHOWN {
            panels.push(Panel::Curves {
                title: format!("{name}: measured and fitted"),
                x: x(),
                y: name.clone(),
                curves: vec![
                    Curve::new("fitted", second, place, Stroke::Solid),
                    Curve::new("measured", first, place, Stroke::Dots),
                ],
                marks: Vec::new(),
            });
        }
    }
    panels.push(Panel::Curves {
        title: "residuals".into(),
        x: x(),
        y: "measured less fitted (deviations)".into(),
        curves: residuals,
        marks: vec![Mark::Band("95 % of normal noise".into(), [-BAND, BAND])],
    });
    Study { title: "Measured rows and the fitted model", columns, panels, comparison: Vec::new() }
}
