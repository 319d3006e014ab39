//! Newton's equations of multiple shooting, condensed to the displacements of the nodes.
//!
//! Element `k` maps the pose `x_k` and wrench `w_k` at its start to its end. The wrenches follow from the poses at both ends by
//! the element's compliance, which leaves one balance equation per node. Without interaction the equations are block
//! tridiagonal; with ring interaction they are dense.

use nalgebra::{DMatrix, DVector, SMatrix, SVector};

/// A block of the equations; `D` is 6 in space, 3 in the plane.
pub(super) type Block<const D: usize> = SMatrix<f64, D, D>;

/// One linearised element: change of its end with respect to its start.
#[derive(Debug, Clone)]
pub(super) struct Link<const D: usize> {
    /// Derivatives of the end pose with respect to start pose and start wrench.
    pub(super) pose: [Block<D>; 2],
    /// Derivatives of the end wrench with respect to both.
    pub(super) wrench: [Block<D>; 2],
    /// Transformation of the next node's displacement to the axes of the defect.
    pub(super) next: Block<D>,
}

/// Derivative of a node's balance with respect to the displacement of a node, both counted from 1.
pub(super) struct Coupling<const D: usize> {
    pub(super) node: usize,
    pub(super) by: usize,
    pub(super) block: Block<D>,
}

/// Residuals (defects) of the matching conditions.
#[derive(Debug, Clone)]
pub(super) struct Defects<const D: usize> {
    /// End pose minus the pose of the next node, by element.
    pub(super) pose: Vec<SVector<f64, D>>,
    /// Wrench at the element's end plus load of the next node minus the wrench after it.
    pub(super) wrench: Vec<SVector<f64, D>>,
}

/// The factorised linear system.
#[derive(Debug)]
pub(super) struct NodeSystem<const D: usize> {
    links: Vec<Link<D>>,
    /// Derivative of the start wrench with respect to the end pose: the inverse of the element's compliance.
    stiffness: Vec<Block<D>>,
    factors: Factors<D>,
}

#[derive(Debug)]
enum Factors<const D: usize> {
    /// Inverses of the pivots, and the blocks below and above the diagonal.
    Tridiagonal(Vec<[Block<D>; 3]>),
    Full(nalgebra::LU<f64, nalgebra::Dyn, nalgebra::Dyn>),
}

/// Changes of all nodes after the base, and of the wrench at the start of each element.
pub(super) struct Solution<const D: usize> {
    pub(super) poses: Vec<SVector<f64, D>>,
    pub(super) wrenches: Vec<SVector<f64, D>>,
}

impl<const D: usize> NodeSystem<D> {
    /// Factorises the system; `None` where it is singular.
    pub(super) fn new(links: Vec<Link<D>>, couplings: &[Coupling<D>]) -> Option<Self> {
        let count = links.len();
        let stiffness: Option<Vec<Block<D>>> = links.iter().map(|link| link.pose[1].try_inverse()).collect();
        let stiffness = stiffness?;
        // Row and column of node k + 1 have number k.
        let mut blocks: Vec<(usize, usize, Block<D>)> =
            couplings.iter().map(|c| (c.node - 1, c.by - 1, c.block)).collect();
        for (k, (link, stiff)) in links.iter().zip(&stiffness).enumerate() {
            // Derivative of the wrench at the start of element k with respect to the poses, added to the balances of its end
            // and its start.
            let mut by_pose = vec![(k, stiff * link.next)];
            if k > 0 {
                by_pose.push((k - 1, -(stiff * link.pose[0])));
                blocks.push((k, k - 1, link.wrench[0]));
            }
            for (by, block) in by_pose {
                blocks.push((k, by, link.wrench[1] * block));
                if k > 0 {
                    blocks.push((k - 1, by, -block));
                }
            }
        }
        let factors = if blocks.iter().all(|(row, column, _)| row.abs_diff(*column) <= 1) {
            tridiagonal(count, &blocks)?
        } else {
            let mut matrix = DMatrix::zeros(D * count, D * count);
            for (row, column, block) in &blocks {
                let mut target = matrix.fixed_view_mut::<D, D>(D * row, D * column);
                target += block;
            }
            Factors::Full(matrix.lu())
        };
        Some(Self { links, stiffness, factors })
    }

    /// The Newton correction for these defects.
    pub(super) fn solve(&self, defects: &Defects<D>) -> Option<Solution<D>> {
        let count = self.links.len();

        let mut right: Vec<SVector<f64, D>> = defects.wrench.iter().map(|defect| -defect).collect();
        for (k, (link, stiff)) in self.links.iter().zip(&self.stiffness).enumerate() {
            let wrench = -(stiff * defects.pose[k]);
            right[k] -= link.wrench[1] * wrench;
            if k > 0 {
                right[k - 1] += wrench;
            }
        }

        match &self.factors {
            Factors::Tridiagonal(rows) => substitute(rows, &mut right),
            Factors::Full(lu) => {
                let mut whole = DVector::from_fn(D * count, |i, _| right[i / D][i % D]);
                if !lu.solve_mut(&mut whole) {
                    return None;
                }
                for (k, block) in right.iter_mut().enumerate() {
                    block.copy_from(&whole.fixed_rows::<D>(D * k));
                }
            }
        }

        // The wrenches, eliminated before, follow from the nodes' motion.
        let wrenches = (0..count).map(|k| {
            let link = &self.links[k];
            let mut end = link.next * right[k] - defects.pose[k];
            if k > 0 {
                end -= link.pose[0] * right[k - 1];
            }
            self.stiffness[k] * end
        });

        Some(Solution { wrenches: wrenches.collect(), poses: right })
    }
}

/// Block elimination without pivoting between blocks.
fn tridiagonal<const D: usize>(count: usize, blocks: &[(usize, usize, Block<D>)]) -> Option<Factors<D>> {
    let mut rows = vec![[Block::<D>::zeros(); 3]; count];
    for (row, column, block) in blocks {
        // Below, on, above the diagonal.
        rows[*row][column + 1 - row] += block;
    }
    for k in 0..count {
        if k > 0 {
            let before = rows[k - 1];
            let eliminated = rows[k][0] * before[1] * before[2];
            rows[k][1] -= eliminated;
        }
        rows[k][1] = rows[k][1].try_inverse()?;
    }
    Some(Factors::Tridiagonal(rows))
}

fn substitute<const D: usize>(rows: &[[Block<D>; 3]], right: &mut [SVector<f64, D>]) {
    for k in 0..rows.len() {
        if k > 0 {
            let carried = rows[k][0] * right[k - 1];
            right[k] -= carried;
        }
        right[k] = rows[k][1] * right[k];
    }
    for k in (0..rows.len().saturating_sub(1)).rev() {
        let next = rows[k][1] * (rows[k][2] * right[k + 1]);
        right[k] -= next;
    }
}
