//! Chart panel of a diagram: stable and unstable branches, their folds, and quasi-static loading.

use super::case::{Case, Loading};
use crate::equilibrium::Diagram;
use crate::numerics::continuation::PointKind;
use crate::studies::study::{Column, Curve, Mark, Panel, Stroke};

/// Names and labels of a diagram.
pub(super) struct Drawing {
    /// Prefix of the names of its columns.
    pub(super) name: &'static str,
    pub(super) title: &'static str,
    /// Quantity and unit of the abscissa.
    pub(super) x: [&'static str; 2],
    /// Quantity and unit of the ordinate.
    pub(super) y: [&'static str; 2],
    /// Legend labels of the stable branches, one colour each.
    pub(super) branches: &'static [&'static str],
    /// Whether the legend explains dashes, dots and circles.
    pub(super) explained: bool,
}

/// A panel under construction: values of the abscissa, and a column for each curve.
pub(super) struct Canvas {
    drawing: Drawing,
    x: Vec<f64>,
    curves: Vec<(Curve, Vec<f64>)>,
    marks: Vec<Mark>,
}

impl Canvas {
    pub(super) fn new(drawing: Drawing) -> Self {
        let mut curves = Vec::new();
        let mut add = |label: &str, part: String, colour, stroke| {
            let column = format!("{}_{part}_{}", drawing.name, drawing.y[1].to_lowercase());
            curves.push((Curve::new(label, column, colour, stroke), Vec::new()));
        };
        let explained = |label| if drawing.explained { label } else { "" };
        for (branch, label) in drawing.branches.iter().enumerate() {
            add(label, format!("{branch}_stable"), 2 * branch, Stroke::Solid);
            add(explained("unstable"), format!("{branch}_unstable"), 2 * branch, Stroke::Dashed);
        }
        add(explained("loading"), "loading".into(), 1, Stroke::Dots);
        Self { drawing, x: Vec::new(), curves, marks: Vec::new() }
    }

    /// Adds a row at `x` from pairs of curve index and value; the other curves have NaN there.
    fn push(&mut self, x: f64, values: &[(usize, f64)]) {
        self.x.push(x);
        for (index, (_, column)) in self.curves.iter_mut().enumerate() {
            let own = values.iter().find(|(curve, _)| *curve == index);
            column.push(own.map_or(f64::NAN, |(_, value)| *value));
        }
    }

    /// Adds a point of the stable branch with this index.
    pub(super) fn put(&mut self, branch: usize, [x, y]: [f64; 2]) {
        self.push(x, &[(2 * branch, y)]);
    }

    /// Adds a mark.
    pub(super) fn mark(&mut self, mark: Mark) {
        self.marks.push(mark);
    }

    /// Adds a part of the branch with this index.
    pub(super) fn draw(&mut self, branch: usize, case: &Case, diagram: &Diagram) {
        let shapes = &diagram.shapes;
        let regular = |index: Option<usize>, stable: bool| {
            let shape = index.and_then(|index| shapes.get(index));
            shape.is_some_and(|shape| shape.kind == PointKind::Regular && (shape.unstable == 0) == stable)
        };
        for (index, shape) in shapes.iter().enumerate() {
            let angle = (case.angle)(&shape.tip);
            // A fold or branching point belongs to the curves of both its neighbours, so that they meet.
            let near = [Some(index), index.checked_sub(1), Some(index + 1)];
            let near = if shape.kind == PointKind::Regular { &near[..1] } else { &near[1..] };
            let mut values = Vec::new();
            for (curve, stable) in [(2 * branch, true), (2 * branch + 1, false)] {
                if near.iter().any(|index| regular(*index, stable)) {
                    values.push((curve, angle));
                }
            }
            self.push(shape.value, &values);
            if shape.kind != PointKind::Regular {
                let first = self.drawing.explained && self.marks.is_empty();
                let label = if first { "fold" } else { "" };
                self.marks.push(Mark::Point(label.into(), [shape.value, angle]));
            }
        }
        self.push(f64::NAN, &[]);
    }

    pub(super) fn draw_loading(&mut self, loading: &Loading) {
        let curve = self.curves.len() - 1;
        for [value, angle] in &loading.shapes {
            self.push(*value, &[(curve, *angle)]);
        }
    }

    pub(super) fn rows(&self) -> usize {
        self.x.len()
    }

    /// Returns the panel and adds its columns, padded with NaN to `rows` values, to `columns`.
    pub(super) fn finish(self, rows: usize, columns: &mut Vec<Column>) -> Panel {
        let Self { drawing, x, curves, marks } = self;
        let [quantity, unit] = drawing.x;
        let abscissa = format!("{}_{}", drawing.name, unit.to_lowercase());
        let mut add = |name: String, mut values: Vec<f64>| {
            values.resize(rows, f64::NAN);
            columns.push(Column::new(name, values));
        };
        add(abscissa.clone(), x);
        let mut drawn = Vec::new();
        for (curve, values) in curves {
            add(curve.column.clone(), values);
            drawn.push(curve);
        }
        Panel::Curves {
            title: drawing.title.into(),
            x: (format!("{quantity} ({unit})"), abscissa),
            y: format!("{} ({})", drawing.y[0], drawing.y[1]),
            curves: drawn,
            marks,
        }
    }
}
