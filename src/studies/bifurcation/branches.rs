//! The columns of a diagram: stable and unstable branches, their folds and branching points, and quasi-static loading.

use super::case::{Case, Loading};
use crate::equilibrium::Diagram;
use crate::numerics::continuation::PointKind;
use crate::studies::study::{Column, Mark};

/// Columns of a diagram under construction: the path parameter, and an angle for each branch.
pub(super) struct Branches {
    /// Prefix of the names of its columns, and end of those of its marks.
    name: &'static str,
    /// The path parameter; NaN in an empty row, which separates two parts of a branch.
    x: Column,
    /// The stable and the unstable part of each branch, and quasi-static loading last.
    y: Vec<Column>,
    marks: Vec<Mark>,
}

impl Branches {
    /// A diagram with this number of branches; `units` are those of the path parameter and of the branches.
    pub(super) fn new(name: &'static str, [x, y]: [&str; 2], branches: usize) -> Self {
        let parts =
            (0..branches).flat_map(|branch| ["stable", "unstable"].map(|part| format!("{branch}_{part}")));
        let column = |part: String| Column::new(format!("{name}_{part}_{y}"), Vec::new());
        Self {
            name,
            x: Column::new(format!("{name}_{x}"), Vec::new()),
            y: parts.chain(["loading".to_owned()]).map(column).collect(),
            marks: Vec::new(),
        }
    }

    /// Adds a row at `x` from pairs of column index and value; the other columns have NaN there.
    fn push(&mut self, x: f64, values: &[(usize, f64)]) {
        self.x.values.push(x);
        for (index, column) in self.y.iter_mut().enumerate() {
            let own = values.iter().find(|(number, _)| *number == index);
            column.values.push(own.map_or(f64::NAN, |(_, value)| *value));
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
    pub(super) fn add(&mut self, branch: usize, case: &Case, diagram: &Diagram) {
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
            for (column, stable) in [(2 * branch, true), (2 * branch + 1, false)] {
                if near.iter().any(|index| regular(*index, stable)) {
                    values.push((column, angle));
                }
            }
            self.push(shape.value, &values);
            let kind = match shape.kind {
                PointKind::Regular => continue,
                PointKind::Fold => "fold",
                PointKind::Branching(_) => "branching point",
            };
            self.marks.push(Mark::point(format!("{kind}, {}", self.name), [shape.value, angle]));
        }
        self.push(f64::NAN, &[]);
    }

    /// Adds the shapes of quasi-static loading.
    pub(super) fn add_loading(&mut self, loading: &Loading) {
        let column = self.y.len() - 1;
        for [value, angle] in &loading.shapes {
            self.push(*value, &[(column, *angle)]);
        }
    }

    pub(super) fn rows(&self) -> usize {
        self.x.values.len()
    }

    /// Adds its columns, padded with NaN to `rows` values, to `columns`, and its marks to `marks`.
    pub(super) fn finish(self, rows: usize, columns: &mut Vec<Column>, marks: &mut Vec<Mark>) {
        let padded = |mut column: Column| {
            column.values.resize(rows, f64::NAN);
            column
        };
        columns.extend([self.x].into_iter().chain(self.y).map(padded));
        marks.extend(self.marks);
    }
}
