//! A rod whose unknowns are its strains, constant in each piece: an independent model for stability margins.

use mcm::design::{Design, Ring, Span, SpanKind};
use mcm::geometry::RotationVector;
use nalgebra::{DMatrix, DVector, Matrix3, SymmetricEigen, Vector3};

use crate::differences::derivative;

/// Step of the differences of energies in scaled strains, in which the elastic energy is half their square.
const STEP: f64 = 1e-2;

/// Step of the length's scale: it has the same effect as such a strain.
const LENGTH_STEP: f64 = 1e-3;

/// Pieces of constant strain in each disc.
const IN_DISC: usize = 2;

/// Unit of energy, J: it keeps the scaled strains at order one.
const UNIT: f64 = 1e-5;

/// A piece of constant strain, or a rigid ring.
#[derive(Debug, Clone, Copy)]
struct Piece {
    length: f64,
    /// Square roots of the elastic stiffness of the six strains, scaled by the unit of energy; `None` where it is rigid.
    roots: Option<[f64; 6]>,
    /// Magnetic moment along `d3` (A m2) at its middle.
    moment: f64,
    /// Whether its length is that of the fed shaft.
    grows: bool,
}

/// A rod of pieces of constant strain (curvature `u`, stretch `v`), clamped at the origin along `z`.
pub(super) struct StrainRod<'a> {
    pieces: Vec<Piece>,
    /// The field (T) at a point (m).
    pub(super) field: &'a dyn Fn(&Vector3<f64>) -> Vector3<f64>,
    pub(super) tip_force: Vector3<f64>,
}

fn pieces_of(span: &Span, count: usize, grows: bool) -> Vec<Piece> {
    let length = span.length / count as f64;
    let k = span.stiffness;
    let roots =
        [k.bending, k.bending, k.torsion, k.shear, k.shear, k.axial].map(|k| (k * length / UNIT).sqrt());
    vec![Piece { length, roots: Some(roots), moment: span.moment() / count as f64, grows }; count]
}

impl<'a> StrainRod<'a> {
    /// `count` pieces in each core or rod, and in the whole of a shaft of this length (m).
    pub(super) fn new(
        design: &Design,
        shaft: f64,
        count: usize,
        field: &'a dyn Fn(&Vector3<f64>) -> Vector3<f64>,
    ) -> Self {
        let ring =
            |ring: &Ring| Piece { length: ring.length, roots: None, moment: ring.moment(), grows: false };
        let mut pieces = Vec::new();
        if let Some(span) = design.shaft() {
            pieces.extend(pieces_of(&Span { length: shaft, ..span.clone() }, 2 * count, true));
        }
        pieces.extend(design.base_rings().iter().map(ring));
        for segment in design.segments() {
            for span in &segment.spans {
                let count = if span.kind == SpanKind::Disc { IN_DISC } else { count };
                pieces.extend(pieces_of(span, count, false));
            }
            pieces.extend(segment.rings.iter().map(ring));
        }
        Self { pieces, field, tip_force: Vector3::zeros() }
    }

    /// Number of strains.
    pub(super) fn size(&self) -> usize {
        6 * self.pieces.iter().filter(|piece| piece.roots.is_some()).count()
    }

    /// Energy in its unit, and the tip's position (m), at scaled strains; the shaft is longer by the factor `scale`.
    pub(super) fn energy(&self, x: &DVector<f64>, scale: f64) -> (f64, Vector3<f64>) {
        let (mut position, mut rotation) = (Vector3::zeros(), Matrix3::identity());
        let (mut energy, mut next) = (0.0, 0);
        for piece in &self.pieces {
            let scale = if piece.grows { scale } else { 1.0 };
            let half_length = 0.5 * scale * piece.length;
            let half = |rotation: &Matrix3<f64>, position: &Vector3<f64>| {
                let Some(roots) = piece.roots else {
                    return (*rotation, position + rotation * Vector3::z() * half_length);
                };
                let strain = |i: usize| x[next + i] / roots[i];
                let turn = RotationVector::new(Vector3::new(strain(0), strain(1), strain(2)) * half_length);
                let stretch = Vector3::new(strain(3), strain(4), 1.0 + strain(5)) * half_length;
                // The left Jacobian integrates the directors along the piece.
                (rotation * turn.matrix(), position + rotation * turn.left_jacobian() * stretch)
            };
            let (middle_rotation, middle) = half(&rotation, &position);
            energy -= scale * piece.moment * middle_rotation.column(2).dot(&(self.field)(&middle)) / UNIT;
            (rotation, position) = half(&middle_rotation, &middle);
            if piece.roots.is_some() {
                energy += 0.5 * scale * x.rows(next, 6).norm_squared();
                next += 6;
            }
        }
        (energy - self.tip_force.dot(&position) / UNIT, position)
    }

    fn gradient(&self, x: &DVector<f64>, scale: f64) -> DVector<f64> {
        DVector::from_fn(x.len(), |i, _| {
            derivative(STEP, |by| {
                let mut moved = x.clone();
                moved[i] += by;
                self.energy(&moved, scale).0
            })
        })
    }

    fn hessian(&self, x: &DVector<f64>) -> DMatrix<f64> {
        let mut out = DMatrix::zeros(x.len(), x.len());
        for i in 0..x.len() {
            let at = |by: f64| {
                let mut moved = x.clone();
                moved[i] += by;
                self.gradient(&moved, 1.0)
            };
            out.set_column(i, &((at(STEP) - at(-STEP)) / (2.0 * STEP)));
        }
        (&out + out.transpose()) * 0.5
    }

    /// Equilibrium strains from `start`, by Newton's method with the Hessian there, renewed once.
    pub(super) fn solve(&self, start: DVector<f64>) -> DVector<f64> {
        let mut x = start;
        for _ in 0..2 {
            let factor = self.hessian(&x).cholesky().expect("stable");
            for _ in 0..15 {
                let step = factor.solve(&self.gradient(&x, 1.0));
                x -= &step;
                if step.norm() < 1e-9 {
                    return x;
                }
            }
        }
        x
    }

    /// Smallest eigenvalue at these strains, whose elastic norm is their own; with the length of the shaft condensed where it is
    /// free.
    pub(super) fn margin(&self, x: &DVector<f64>, is_free: bool) -> f64 {
        let mut hessian = self.hessian(x);
        if is_free {
            let h = LENGTH_STEP;
            let slope = (self.gradient(x, 1.0 + h) - self.gradient(x, 1.0 - h)) / (2.0 * h);
            let [less, same, more] = [1.0 - h, 1.0, 1.0 + h].map(|scale| self.energy(x, scale).0);
            let curve = (less - 2.0 * same + more) / (h * h);
            hessian -= &slope * slope.transpose() / curve;
        }
        SymmetricEigen::new(hessian).eigenvalues.min()
    }
}
