//! A finer grid in parts of a coarse one.

use nalgebra::Vector3;
use serde::{Deserialize, Serialize};

use super::tricubic::{
    SpacePoint, Tricubic, cell, check_finite, check_length, checked_nodes, rounded, to_coefficients, weighted,
};
use crate::error::Error;

/// Spacing of the coarse grid in that of the fine one.
pub const RATIO: usize = 4;

/// Fine nodes of a brick.
const IN_BRICK: usize = RATIO * RATIO * RATIO;

/// Coefficients of the four fine B-splines from a coarse node on, by those of the coarse B-splines from the node before on:
/// a coarse B-spline is a sum of fine ones (two halvings with the weights 1, 4, 6, 4, 1 over 8).
const FINER: [[f64; 4]; RATIO] = [
    [5.0 / 32.0, 22.0 / 32.0, 5.0 / 32.0, 0.0],
    [1.0 / 16.0, 10.0 / 16.0, 5.0 / 16.0, 0.0],
    [1.0 / 64.0, 31.0 / 64.0, 31.0 / 64.0, 1.0 / 64.0],
    [0.0, 5.0 / 16.0, 10.0 / 16.0, 1.0 / 16.0],
];

/// A function in space on two grids: a coarse one everywhere and, where more is to be seen, another of a quarter of its
/// spacing, so that it takes the memory of a surface rather than that of a space.
///
/// The function is the coarse one plus a correction by fine B-splines. Since a coarse B-spline is a sum of fine ones, the sum
/// is kept where there is a correction and around it: a point needs the 64 coefficients of one grid, and value, gradient and
/// second derivative are continuous, but for rounding (single precision) where one grid follows the other. Where the correction
/// has no gaps nearby, the function is that of a fine grid everywhere.
///
/// D. R. Forsey, R. H. Bartels, Hierarchical B-spline refinement, doi 10.1145/54852.378512.
///
/// ```
/// use mcm::numerics::refinement::Refinement;
/// use mcm::numerics::tricubic::Tricubic;
/// use nalgebra::Vector3;
/// let flat = Tricubic::new([7; 3], vec![1.0; 7 * 7 * 7])?;
/// let bump = core::array::from_fn(|node| if node == 21 { 0.5 } else { 0.0 }); // at (1, 1, 1) in the brick
/// let function = Refinement::new(flat, &[([3, 3, 3], bump)])?;
/// assert!((function.at(&Vector3::repeat(13.0)).value - 1.5).abs() < 1e-3);
/// assert!((function.at(&Vector3::repeat(5.0)).value - 1.0).abs() < 1e-6); // far away
/// # Ok::<(), mcm::error::Error>(())
/// ```
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(try_from = "Stored", into = "Stored")]
pub struct Refinement {
    coarse: Tricubic,
    /// Of each coarse cell the number of its brick, which begins at the cell's first corner; 0 if there is none.
    numbers: Vec<u32>,
    /// Coefficients of the bricks one after another; in each the first coordinate runs fastest.
    coefficients: Vec<f32>,
}

impl Refinement {
    /// Adds to `coarse` a function that has these values at fine nodes, and zero at all others: for each brick its coarse node
    /// and the values of the 64 fine nodes from there on, the first coordinate running fastest.
    ///
    /// Along each axis there are four times as many fine nodes as coarse cells. Where bricks end, what is left of the
    /// correction, which falls by 0.27 with every fine node, is cut.
    ///
    /// # Errors
    /// [`Error::Range`] for more than [`super::tricubic::MOST_NODES`] fine nodes and for values that are not finite in single
    /// precision; [`Error::Unsupported`] for a brick in the two outermost layers of coarse cells.
    pub fn new(coarse: Tricubic, bricks: &[([usize; 3], [f64; IN_BRICK])]) -> Result<Self, Error> {
        let cells = coarse.counts().map(|count| count - 1);
        let counts = cells.map(|cells| cells * RATIO);
        let mut values = vec![0.0; checked_nodes(counts)?];
        let mut kept = vec![false; cells.iter().product()];
        let mut corrected = kept.clone();

        // A B-spline through a value reaches its neighbours: what is kept is a brick and the 26 around it.
        for (brick, given) in bricks {
            if (0..3).any(|axis| brick[axis] < 2 || brick[axis] + 3 > cells[axis]) {
                return Err(Error::Unsupported("a correction reaches the border of its grid".into()));
            }
            for (node, value) in given.iter().enumerate() {
                values[place(counts, fine(*brick, node))] = *value;
            }
            corrected[place(cells, *brick)] = true;
            for neighbour in 0..27 {
                let [x, y, z] = digits(neighbour, 3);
                kept[place(cells, [brick[0] + x - 1, brick[1] + y - 1, brick[2] + z - 1])] = true;
            }
        }

        // Once for all bricks: the B-splines of neighbours overlap.
        to_coefficients(counts, &mut values)?;
        let mut coefficients = Vec::new();
        for (cell, _) in kept.iter().enumerate().filter(|(_, kept)| **kept) {
            let brick = [cell % cells[0], cell / cells[0] % cells[1], cell / (cells[0] * cells[1])];
            let mut sums = finer(&coarse, brick);
            if corrected[cell] {
                for (node, sum) in sums.iter_mut().enumerate() {
                    *sum += values[place(counts, fine(brick, node))];
                }
            }
            coefficients.extend(rounded(&sums));
        }

        Self::try_from(Stored { coarse, kept, coefficients })
    }

    /// The function on the coarse grid.
    #[must_use]
    pub fn coarse(&self) -> &Tricubic {
        &self.coarse
    }

    /// Number of coefficients of both grids.
    #[must_use]
    pub fn coefficients(&self) -> usize {
        self.coefficients.len() + self.coarse.counts().iter().product::<usize>()
    }

    /// A number that differs for other functions, but for one in four thousand million of them (CRC-32).
    #[must_use]
    pub fn checksum(&self) -> u32 {
        let mut sum = crc32fast::Hasher::new();
        self.coarse.counts().iter().for_each(|count| sum.update(&(*count as u64).to_le_bytes()));
        self.numbers.iter().for_each(|number| sum.update(&number.to_le_bytes()));
        for coefficient in self.coarse.coefficients().iter().chain(&self.coefficients) {
            sum.update(&coefficient.to_le_bytes());
        }
        sum.finalize()
    }

    /// Value and derivatives at a point in units of the fine spacing. Its coordinates are between 4 and 4 times the number of
    /// coarse nodes less 8.
    #[must_use]
    pub fn at(&self, point: &Vector3<f64>) -> SpacePoint {
        let cells = self.coarse.counts().map(|count| count - 1);
        let (first, weights) = cell(cells.map(|count| count * RATIO), point);
        if let Some(around) = self.around(cells, first) {
            return weighted(&around, &weights);
        }
        let scale = 1.0 / RATIO as f64;
        let SpacePoint { value, gradient, hessian } = self.coarse.at(&(point * scale));
        SpacePoint { value, gradient: gradient * scale, hessian: hessian * (scale * scale) }
    }

    /// The 64 coefficients from this fine node on, row by row, if all are kept.
    fn around(&self, cells: [usize; 3], first: [usize; 3]) -> Option<[[f32; 4]; 16]> {
        let [low, high] = [0, RATIO - 1].map(|last| first.map(|node| (node + last) / RATIO));
        let mut starts = [0; 8];
        for (corner, start) in starts.iter_mut().enumerate() {
            let brick =
                core::array::from_fn(|axis| if corner >> axis & 1 == 0 { low[axis] } else { high[axis] });
            *start = (self.numbers[place(cells, brick)] as usize).checked_sub(1)? * IN_BRICK;
        }
        let [x, y, z] = first.map(|node| node % RATIO);
        Some(core::array::from_fn(|row| {
            let [j, k] = [y + row % 4, z + row / 4];
            let half = j / RATIO * 2 + k / RATIO * 4;
            let line = (k % RATIO * RATIO + j % RATIO) * RATIO;
            let mut both = [0.0; 2 * RATIO];
            for (four, start) in both.chunks_exact_mut(RATIO).zip(&starts[half..half + 2]) {
                four.copy_from_slice(&self.coefficients[start + line..start + line + RATIO]);
            }
            core::array::from_fn(|i| both[x + i])
        }))
    }
}

/// How a function is written down.
#[derive(Clone, Serialize, Deserialize)]
struct Stored {
    coarse: Tricubic,
    kept: Vec<bool>,
    coefficients: Vec<f32>,
}

impl From<Refinement> for Stored {
    fn from(Refinement { coarse, numbers, coefficients }: Refinement) -> Self {
        Self { coarse, kept: numbers.iter().map(|number| *number != 0).collect(), coefficients }
    }
}

impl TryFrom<Stored> for Refinement {
    type Error = Error;

    fn try_from(Stored { coarse, kept, coefficients }: Stored) -> Result<Self, Error> {
        let cells = coarse.counts().map(|count| count - 1);
        checked_nodes(cells.map(|cells| cells * RATIO))?;
        check_length("cells of a grid", kept.len(), cells.iter().product())?;
        let bricks = kept.iter().filter(|kept| **kept).count();
        check_length("coefficients of a grid", coefficients.len(), bricks * IN_BRICK)?;
        check_finite(&coefficients)?;
        let mut last = 0;
        let number = |kept: bool| {
            last += u32::from(kept);
            if kept { last } else { 0 }
        };
        Ok(Self { coarse, numbers: kept.into_iter().map(number).collect(), coefficients })
    }
}

/// The coarse function's coefficients of the fine nodes of a brick.
fn finer(coarse: &Tricubic, brick: [usize; 3]) -> [f64; IN_BRICK] {
    let around = coarse.around(brick.map(|node| node - 1));
    core::array::from_fn(|node| {
        let [x, y, z] = digits(node, RATIO).map(|index| FINER[index]);
        let row = |row: &[f32; 4]| (0..4).map(|i| f64::from(row[i]) * x[i]).sum::<f64>();
        (0..16).map(|line| row(&around[line]) * y[line % 4] * z[line / 4]).sum()
    })
}

/// A number in this base, the lowest digit first.
fn digits(number: usize, base: usize) -> [usize; 3] {
    [number % base, number / base % base, number / (base * base)]
}

/// A fine node of a brick.
fn fine(brick: [usize; 3], node: usize) -> [usize; 3] {
    let within = digits(node, RATIO);
    core::array::from_fn(|axis| brick[axis] * RATIO + within[axis])
}

/// Place in a list in which the first coordinate runs fastest.
fn place(counts: [usize; 3], [i, j, k]: [usize; 3]) -> usize {
    (k * counts[1] + j) * counts[0] + i
}
