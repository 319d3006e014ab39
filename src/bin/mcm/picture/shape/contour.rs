//! Lines on which a function on a grid is zero: marching squares, the plane case of W. E. Lorensen and H. E. Cline,
//! Marching cubes, doi 10.1145/37402.37422.

use std::collections::BTreeMap;

use super::outline::Outline;

/// A side of the grid's cells: its first node, and whether it leads to the next row instead of the next column.
type Side = (usize, bool);

/// Closed lines around the nodes with positive values, in steps of the grid from its first node. The rows of `values` have
/// `columns` nodes; those on the border of the grid must not be positive, so that every line closes.
pub(super) fn closed_lines(values: &[f64], columns: usize) -> Vec<Outline> {
    let rows = values.len() / columns;
    let cells = (0..rows.saturating_sub(1))
        .flat_map(|row| (0..columns - 1).map(move |column| row * columns + column));
    let mut next: BTreeMap<Side, Side> = cells.flat_map(|node| pieces(values, columns, node)).collect();
    let mut out = Vec::new();
    while let Some((first, mut side)) = next.pop_first() {
        let mut line = vec![place(values, columns, first)];
        while side != first {
            line.push(place(values, columns, side));
            match next.remove(&side) {
                Some(further) => side = further,
                None => break, // the border is positive there
            }
        }
        out.push(line);
    }
    out
}

/// The pieces of line in the cell after a node, each from a side to a side, with what is positive at their left.
fn pieces(values: &[f64], columns: usize, node: usize) -> Vec<(Side, Side)> {
    // Counterclockwise; each side follows the corner of the same number.
    let corners = [node, node + 1, node + columns + 1, node + columns];
    let sides = [(node, false), (node + 1, true), (node + columns, false), (node, true)];
    let positive = |number: usize| values[corners[number % 4]] > 0.0;
    let begins = |number: usize| positive(number) && !positive(number + 1);
    let ends = |number: usize| !positive(number) && positive(number + 1);
    // Where opposite corners are positive, they belong together if the middle is positive.
    let together = corners.iter().map(|corner| values[*corner]).sum::<f64>() > 0.0;
    let end_of = |begin: usize| {
        let mut after = (1..4).map(|step| if together { begin + step } else { begin + 4 - step });
        after.find(|number| ends(number % 4))
    };
    let begin = (0..4).filter(|number| begins(*number));
    begin.filter_map(|begin| Some((sides[begin], sides[end_of(begin)? % 4]))).collect()
}

/// Where the function is zero on a side, by linear interpolation.
fn place(values: &[f64], columns: usize, (node, upwards): Side) -> (f64, f64) {
    let (here, there) = (values[node], values[if upwards { node + columns } else { node + 1 }]);
    let share = here / (here - there);
    let (x, y) = ((node % columns) as f64, (node / columns) as f64);
    if upwards { (x, y + share) } else { (x + share, y) }
}

#[cfg(test)]
mod tests {
    use super::*;

    const COLUMNS: usize = 41;

    fn lines(function: impl Fn(f64, f64) -> f64) -> Vec<Outline> {
        let node = |number: usize| ((number % COLUMNS) as f64, (number / COLUMNS) as f64);
        let values: Vec<f64> = (0..COLUMNS * COLUMNS)
            .map(|number| {
                let (x, y) = node(number);
                function(x - 20.0, y - 20.0)
            })
            .collect();
        closed_lines(&values, COLUMNS)
    }

    /// Area inside a closed line, positive if it lies to the left.
    fn area(line: &Outline) -> f64 {
        let pairs = line.iter().zip(line.iter().cycle().skip(1));
        0.5 * pairs.map(|((x, y), (u, v))| x * v - u * y).sum::<f64>()
    }

    #[test]
    fn a_ring_has_two_lines_with_its_inside_at_their_left() {
        let mut areas: Vec<f64> =
            lines(|x, y| (4.0 - (x.hypot(y) - 10.0).abs()).min(4.0)).iter().map(area).collect();
        areas.sort_by(f64::total_cmp);
        let expected = [6.0, 14.0].map(|radius: f64| core::f64::consts::PI * radius * radius);
        assert_eq!(areas.len(), 2);
        assert!((areas[0] / -expected[0] - 1.0).abs() < 0.01, "{areas:?}");
        assert!((areas[1] / expected[1] - 1.0).abs() < 0.01, "{areas:?}");
    }

    #[test]
    fn places_lie_on_the_line() {
        for (x, y) in lines(|x, y| 100.0 - x * x - y * y).concat() {
            assert!(((x - 20.0).hypot(y - 20.0) - 10.0).abs() < 0.03, "{x}, {y}");
        }
    }

    #[test]
    fn in_a_saddle_the_middle_decides() {
        for (middle, count) in [(-3.0, 2), (-0.5, 1)] {
            let mut values = [-1.0; 16];
            (values[5], values[10], values[6], values[9]) = (1.0, 1.0, middle, middle);
            assert_eq!(closed_lines(&values, 4).len(), count);
        }
        assert!(closed_lines(&[-1.0; 9], 3).is_empty());
    }
}
