//! The lumen: all branches together, or a wall of any shape.

use std::sync::Arc;

use nalgebra::{Matrix3, Vector3};

use super::branch::Branch;
use super::clearance::Clearance;
use super::grid::DistanceGrid;
use super::mesh::Mesh;
use crate::error::{Error, check};
use crate::geometry::Pose;

/// Length over which the walls of branches merge where they meet, m. It widens a mouth by at most this times ln 2.
const MERGED: f64 = 0.5e-3;

/// Largest error of a grid in the middle of a vessel, in its spacing: see [`DistanceGrid`].
const ROUNDED: f64 = 0.4;

/// Share of a branch in the union below which it is left out.
const NEGLIGIBLE: f64 = 1e-12;

/// The space inside a vessel with its branches.
///
/// It is the union of branches, or given by a grid of distances, as from a mesh. Where several branches meet, their clearances
/// are joined by a smooth maximum, `d ln(sum exp(g/d))`.
///
/// ```
/// use mcm::vessel::{Branch, Lumen};
/// use nalgebra::Vector3;
/// let straight = |name, end: Vector3<f64>| Branch::new(name, &[Vector3::zeros(), end], &[3e-3; 2]);
/// let fork = Lumen::new(vec![straight("left", [0.03, 0.0, 0.05].into())?, straight("right", [-0.03, 0.0, 0.05].into())?])?;
/// let inside = fork.clearance(&Vector3::new(0.024, 0.0, 0.04)); // on the centreline of the left branch
/// assert!((inside.value - 3e-3).abs() < 1e-9);
/// assert!(fork.clearance(&Vector3::new(0.0, 0.0, 0.04)).value < 0.0); // between the branches
/// # Ok::<(), mcm::error::Error>(())
/// ```
#[derive(Debug, Clone, PartialEq)]
pub struct Lumen {
    shape: Shape,
    /// Differs for other shapes; computed once, since a grid has millions of numbers.
    checksum: u32,
}

#[derive(Debug, Clone)]
enum Shape {
    /// Branches and the length over which they merge, m.
    Branches(Vec<Branch>, f64),
    /// Clones share it.
    Grid(Arc<DistanceGrid>),
}

impl PartialEq for Shape {
    fn eq(&self, other: &Self) -> bool {
        match (self, other) {
            (Self::Branches(own, over), Self::Branches(others, other)) => over == other && own == others,
            (Self::Grid(own), Self::Grid(other)) => Arc::ptr_eq(own, other) || own == other,
            _ => false,
        }
    }
}

impl From<Shape> for Lumen {
    fn from(shape: Shape) -> Self {
        let checksum = match &shape {
            Shape::Branches(branches, merged) => {
                let courses: Vec<_> = branches.iter().map(Branch::course).collect();
                crc32fast::hash(format!("{courses:?} {merged:?}").as_bytes())
            }
            Shape::Grid(grid) => grid.checksum(),
        };
        Self { shape, checksum }
    }
}

impl Lumen {
    /// The union of these branches.
    ///
    /// # Errors
    /// [`Error::Count`] for no branch, [`Error::Unsupported`] for two of the same name.
    pub fn new(branches: Vec<Branch>) -> Result<Self, Error> {
        if branches.is_empty() {
            return Err(Error::Count {
                quantity: "list of vessel branches".into(),
                given: 0,
                expected: "at least 1".into(),
            });
        }
        for (number, branch) in branches.iter().enumerate() {
            if branches[..number].iter().any(|other| other.name() == branch.name()) {
                return Err(Error::Unsupported(format!(
                    "two vessel branches are called \"{}\"",
                    branch.name()
                )));
            }
        }
        Ok(Shape::Branches(branches, MERGED).into())
    }

    /// The inside of the wall to which this grid tells the clearance.
    ///
    /// ```
    /// use mcm::vessel::{DistanceGrid, Lumen};
    /// use nalgebra::Vector3;
    /// let box_around = [Vector3::repeat(-0.01), Vector3::repeat(0.01)];
    /// let ball = Lumen::of_grid(DistanceGrid::new(box_around, 1e-3, |point| 0.01 - point.norm())?);
    /// let clearance = ball.clearance(&Vector3::new(0.0, 0.0, 8e-3));
    /// assert!((clearance.value - 2e-3).abs() < 1e-6);
    /// assert!((clearance.gradient + Vector3::z()).norm() < 1e-3);
    /// # Ok::<(), mcm::error::Error>(())
    /// ```
    #[must_use]
    pub fn of_grid(grid: DistanceGrid) -> Self {
        Shape::Grid(Arc::new(grid)).into()
    }

    /// The inside of a mesh; for the spacing (m) of its samples see [`Mesh::distance_grid`].
    ///
    /// # Errors
    /// As [`Mesh::distance_grid`].
    pub fn from_mesh(mesh: &Mesh, spacing: Option<f64>) -> Result<Self, Error> {
        mesh.distance_grid(spacing).map(Self::of_grid)
    }

    /// This lumen with another length (m) over which walls merge.
    ///
    /// # Errors
    /// [`Error::Range`] unless it is positive and at most 10 mm, [`Error::Unsupported`] where there are no branches.
    pub fn merged_over(self, length: f64) -> Result<Self, Error> {
        let merged = check(
            "length over which vessel walls merge (m)",
            length,
            |v| v > 0.0 && v <= 0.01,
            "> 0 and <= 0.01",
        )?;
        match self.shape {
            Shape::Branches(branches, _) => Ok(Shape::Branches(branches, merged).into()),
            Shape::Grid(_) => {
                Err(Error::Unsupported("a vessel given by a mesh has no branches that could merge".into()))
            }
        }
    }

    /// The branches; none if the wall is given by a grid.
    #[must_use]
    pub fn branches(&self) -> &[Branch] {
        match &self.shape {
            Shape::Branches(branches, _) => branches,
            Shape::Grid(_) => &[],
        }
    }

    /// The grid of distances, if the wall is given by one.
    #[must_use]
    pub fn grid(&self) -> Option<&DistanceGrid> {
        match &self.shape {
            Shape::Branches(..) => None,
            Shape::Grid(grid) => Some(grid),
        }
    }

    /// How far the clearance may be from the distance to the wall, m: that of a grid rounds off the middle of a vessel.
    #[must_use]
    pub fn rounding(&self) -> f64 {
        self.grid().map_or(0.0, |grid| ROUNDED * grid.spacing())
    }

    /// Whether it is symmetric about the axis of `frame`: its branches lie on that axis. A mesh is not.
    #[must_use]
    pub fn is_symmetric_about(&self, frame: &Pose) -> bool {
        match &self.shape {
            Shape::Branches(branches, _) => branches.iter().all(|branch| branch.is_coaxial_with(frame)),
            Shape::Grid(_) => false,
        }
    }

    /// A number that differs for other lumens, but for one in four thousand million of them (CRC-32).
    #[must_use]
    pub fn checksum(&self) -> u32 {
        self.checksum
    }

    /// Distance from `point` (m) to the wall, with exact derivatives.
    #[must_use]
    pub fn clearance(&self, point: &Vector3<f64>) -> Clearance {
        match &self.shape {
            Shape::Branches(branches, _) if branches.len() == 1 => branches[0].clearance(point),
            Shape::Branches(branches, merged) => union(branches, *merged, point),
            Shape::Grid(grid) => grid.clearance(point),
        }
    }
}

/// The smooth maximum of several clearances.
fn union(branches: &[Branch], merged: f64, point: &Vector3<f64>) -> Clearance {
    let bounds = branches.iter().map(|branch| branch.bound(point)).enumerate();
    let nearest = bounds.max_by(|a, b| a.1.total_cmp(&b.1)).map_or(0, |(number, _)| number);
    let first = branches[nearest].clearance(point);
    let (mut largest, mut sum) = (first.value, 1.0);
    let (mut gradient, mut hessian) = (first.gradient, moment(&first, merged));
    for (number, branch) in branches.iter().enumerate() {
        // Branches too far away to count are left out.
        let least = largest + merged * NEGLIGIBLE.ln();
        let Some(own) = Some(branch)
            .filter(|_| number != nearest)
            .and_then(|branch| branch.clearance_above(point, least))
        else {
            continue;
        };
        let share = ((own.value - first.value) / merged).exp();
        largest = largest.max(own.value);
        sum += share;
        gradient += own.gradient * share;
        hessian += moment(&own, merged) * share;
    }
    gradient /= sum;
    hessian = hessian / sum - gradient * gradient.transpose() / merged;
    Clearance { value: first.value + merged * sum.ln(), gradient, hessian }
}

/// What a clearance adds to the second derivative of the smooth maximum.
fn moment(own: &Clearance, merged: f64) -> Matrix3<f64> {
    own.hessian + own.gradient * own.gradient.transpose() / merged
}
