//! The lumen: all branches together.

use nalgebra::{Matrix3, Vector3};

use super::branch::Branch;
use super::clearance::Clearance;
use crate::error::{Error, check};

/// Length over which the walls of branches merge where they meet, m. It widens a mouth by at most this times ln 2.
const MERGED: f64 = 0.5e-3;

/// Share of a branch in the union below which it is left out: that of rounding.
const NEGLIGIBLE: f64 = 1e-17;

/// The space inside a vessel with its branches.
///
/// Where several branches meet, their clearances are joined by a smooth maximum, `d ln(sum exp(g/d))`.
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
    branches: Vec<Branch>,
    merged: f64,
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
        Ok(Self { branches, merged: MERGED })
    }

    /// The same with another length (m) over which walls merge.
    ///
    /// # Errors
    /// [`Error::Range`] unless it is positive and at most 10 mm.
    pub fn merged_over(self, length: f64) -> Result<Self, Error> {
        let merged = check(
            "length over which vessel walls merge (m)",
            length,
            |v| v > 0.0 && v <= 0.01,
            "> 0 and <= 0.01",
        )?;
        Ok(Self { merged, ..self })
    }

    /// The branches.
    #[must_use]
    pub fn branches(&self) -> &[Branch] {
        &self.branches
    }

    /// Distance from `point` (m) to the wall, with exact derivatives.
    #[must_use]
    pub fn clearance(&self, point: &Vector3<f64>) -> Clearance {
        if let [only] = &self.branches[..] {
            return only.clearance(point);
        }
        // Branches too far away to count in the union are left out.
        let bounds: Vec<f64> = self.branches.iter().map(|branch| branch.bound(point)).collect();
        let nearest = (0..bounds.len()).max_by(|a, b| bounds[*a].total_cmp(&bounds[*b])).unwrap_or(0);
        let mut each = vec![self.branches[nearest].clearance(point)];
        let mut largest = each[0].value;
        for (number, branch) in self.branches.iter().enumerate() {
            if number != nearest && bounds[number] > largest + self.merged * NEGLIGIBLE.ln() {
                let own = branch.clearance(point);
                largest = largest.max(own.value);
                each.push(own);
            }
        }
        let shares = each.iter().map(|own| ((own.value - largest) / self.merged).exp());
        let sum: f64 = shares.clone().sum();
        let (mut gradient, mut hessian) = (Vector3::zeros(), Matrix3::zeros());
        for (own, share) in each.iter().zip(shares) {
            let share = share / sum;
            if share > NEGLIGIBLE {
                gradient += own.gradient * share;
                hessian += (own.hessian + own.gradient * own.gradient.transpose() / self.merged) * share;
            }
        }
        hessian -= gradient * gradient.transpose() / self.merged;
        Clearance { value: largest + self.merged * sum.ln(), gradient, hessian }
    }
}
