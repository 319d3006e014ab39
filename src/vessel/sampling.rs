//! Where a distance is sampled: coarsely everywhere, finely inside the vessel and near its wall.

use nalgebra::Vector3;

use super::surface::in_mm;
use crate::error::{Error, check};
use crate::numerics::refinement::{RATIO, Refinement};
use crate::numerics::tricubic::{MOST_NODES, Tricubic};

/// Coarse cells around the box.
pub(super) const AROUND: f64 = 4.0;

/// Coarse cells at the border that hold no fine samples.
const EDGE: usize = 2;

/// Depth outside the wall down to which fine samples count fully, and beyond which they do not count, in fine spacings.
const FADES: [f64; 2] = [3.0, 5.0];

/// Fine cells along the shortest side of the box.
const FEWEST: f64 = 8.0;

/// Largest slope of a distance, with its rounding.
const STEEPEST: f64 = 1.0 + 1e-6;

/// Fine nodes of a coarse cell.
const IN_CELL: usize = RATIO * RATIO * RATIO;

/// Nodes of both grids: fine node `(i, j, k)` lies `i`, `j` and `k` spacings from the origin, every fourth is a coarse one.
pub(super) struct Nodes {
    pub(super) origin: Vector3<f64>,
    spacing: f64,
    /// Coarse nodes along the axes.
    counts: [usize; 3],
}

impl Nodes {
    /// Of this fine spacing (m), around a box (m).
    ///
    /// # Errors
    /// [`Error::Range`] as [`super::DistanceGrid::new`].
    pub(super) fn new(bounds: [Vector3<f64>; 2], spacing: f64) -> Result<Self, Error> {
        let [finest, coarsest] = allowed_spacings(bounds)?;
        let range = format!("between {finest:.2e} and {coarsest:.2e} for a vessel of this size");
        let holds = |v: f64| v >= finest && v <= coarsest;
        check("spacing (m) of the distance grid", spacing, holds, &range)?;
        let [lower, upper] = bounds;
        let cells = cells(&(upper - lower), spacing);
        #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "a checked count")]
        let counts = core::array::from_fn(|axis| cells[axis] as usize + 1);
        let origin = (lower + upper - cells * (RATIO as f64 * spacing)) / 2.0;
        Ok(Self { origin, spacing, counts })
    }

    fn point(&self, node: [usize; 3]) -> Vector3<f64> {
        self.origin + Vector3::from(node.map(|index| index as f64)) * self.spacing
    }

    /// The fine node at a coarse one.
    fn coarse(&self, number: usize) -> [usize; 3] {
        digits(number, self.counts).map(|index| index * RATIO)
    }

    /// The function through a clearance (m) at the nodes: coarse ones everywhere, fine ones where it is above the second of
    /// [`FADES`].
    ///
    /// # Errors
    /// [`Error::Range`] as [`super::DistanceGrid::new`].
    pub(super) fn sample(
        &self,
        clearance: &(impl Fn(&Vector3<f64>) -> f64 + Sync),
    ) -> Result<Refinement, Error> {
        let [x, y, z] = self.counts;
        let wide = each(x * y * z, |number| clearance(&self.point(self.coarse(number))));
        let at = |[i, j, k]: [usize; 3]| wide[(k * y + j) * x + i];
        self.check_slopes(self.counts, RATIO, [0; 3], at)?;
        // A cell has no sample that counts unless a corner, at most half a diagonal away, is nearly as high.
        let deepest = -(FADES[1] + 0.5 * 3.0_f64.sqrt() * RATIO as f64) * self.spacing;
        let near = |cell: &[usize; 3]| {
            (0..3).all(|axis| cell[axis] + 1 < self.counts[axis])
                && (0..8).any(|corner| {
                    at(core::array::from_fn(|axis| cell[axis] + (corner >> axis & 1))) > deepest
                })
        };
        let cells: Vec<[usize; 3]> =
            (0..wide.len()).map(|number| digits(number, self.counts)).filter(near).collect();
        let coarse = Tricubic::new(self.counts, wide.clone())?;
        let bricks = each(cells.len(), |number| {
            let first = cells[number].map(|index| index * RATIO);
            let node = |within: usize| {
                let within = digits(within, [RATIO; 3]);
                core::array::from_fn(|axis| first[axis] + within[axis])
            };
            let values: [f64; IN_CELL] = core::array::from_fn(|within| clearance(&self.point(node(within))));
            self.check_slopes([RATIO; 3], 1, first, |[i, j, k]| values[(k * RATIO + j) * RATIO + i])?;
            Ok(core::array::from_fn(|within| {
                let rough =
                    coarse.at(&(Vector3::from(node(within).map(|index| index as f64)) / RATIO as f64));
                self.share(values[within]) * (values[within] - rough.value)
            }))
        });
        let bricks: Vec<[f64; IN_CELL]> = bricks.into_iter().collect::<Result<_, Error>>()?;
        let counted =
            cells.into_iter().zip(bricks).filter(|(_, values)| values.iter().any(|value| *value != 0.0));
        let counted: Vec<_> = counted.collect();
        for (cell, _) in &counted {
            if (0..3).any(|axis| cell[axis] < EDGE || cell[axis] + EDGE + 2 > self.counts[axis]) {
                return Err(Error::Unsupported(format!(
                    "the vessel reaches beyond the box given for its distance grid, at {}",
                    in_mm(&self.point(cell.map(|index| index * RATIO)))
                )));
            }
        }
        Refinement::new(coarse, &counted)
    }

    /// How much a fine sample counts.
    fn share(&self, clearance: f64) -> f64 {
        let depth = ((-clearance / self.spacing - FADES[0]) / (FADES[1] - FADES[0])).clamp(0.0, 1.0);
        1.0 - depth * depth * (3.0 - 2.0 * depth)
    }

    /// That the values of neighbours differ by no more than their distance; neighbours are `step` fine nodes apart.
    fn check_slopes(
        &self,
        counts: [usize; 3],
        step: usize,
        first: [usize; 3],
        value: impl Fn([usize; 3]) -> f64,
    ) -> Result<(), Error> {
        for number in 0..counts.iter().product() {
            let node = digits(number, counts);
            for axis in (0..3).filter(|axis| node[*axis] > 0) {
                let mut before = node;
                before[axis] -= 1;
                let slope = (value(node) - value(before)) / (step as f64 * self.spacing);
                if slope.is_nan() || slope.abs() > STEEPEST {
                    let place = self.point(core::array::from_fn(|axis| first[axis] + step * node[axis]));
                    let quantity = format!("change of the clearance per length at {}", in_mm(&place));
                    let range = "between -1 and 1, or the wall crosses itself there";
                    return Err(Error::range(quantity, slope, range));
                }
            }
        }
        Ok(())
    }
}

/// The finest and the coarsest spacing (m) of a grid around a box (m): for as many nodes as there may be, and for
/// [`FEWEST`] fine cells along its shortest side.
pub(super) fn allowed_spacings([lower, upper]: [Vector3<f64>; 2]) -> Result<[f64; 2], Error> {
    let sides = upper - lower;
    for side in &sides {
        check("side (m) of the box around a vessel", *side, |v| v > 0.0 && v < 100.0, "> 0 and < 100")?;
    }
    let mut finest = (sides.product() / MOST_NODES as f64).cbrt();
    while (cells(&sides, finest) * RATIO as f64).product() > MOST_NODES as f64 {
        finest *= 1.01;
    }
    let coarsest = sides.min() / FEWEST;
    check(
        "longest side of the box around a vessel, in its shortest one,",
        sides.max() / sides.min(),
        |_| finest <= coarsest,
        "less: a grid with 2^25 nodes would be too coarse",
    )?;
    Ok([finest, coarsest])
}

/// Coarse cells along the axes.
fn cells(sides: &Vector3<f64>, spacing: f64) -> Vector3<f64> {
    sides.map(|side| (side / (RATIO as f64 * spacing)).ceil() + 2.0 * AROUND)
}

/// Coordinates of a number in a list in which the first coordinate runs fastest.
fn digits(number: usize, [x, y, _]: [usize; 3]) -> [usize; 3] {
    [number % x, number / x % y, number / (x * y)]
}

/// The values of all numbers below `count`, on all cores with the feature `parallel`.
fn each<T: Send>(count: usize, value: impl Fn(usize) -> T + Send + Sync) -> Vec<T> {
    #[cfg(feature = "parallel")]
    {
        use rayon::prelude::*;
        (0..count).into_par_iter().map(value).collect()
    }
    #[cfg(not(feature = "parallel"))]
    (0..count).map(value).collect()
}
