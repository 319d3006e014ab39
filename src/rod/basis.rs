//! Strain modes of an element: a stress resultant times the local compliance.
//!
//! One element spans a whole segment, stiff discs and soft core alike. Along the core the resultant is a Legendre polynomial.
//! Along a disc it keeps the value at the core's end, may vary linearly where required by a distributed couple, as a polynomial where
//! the disc has a considerable share of the compliance, and may jump
//! where touching windings carry a part of it along the core. The modes are orthogonal in the elastic energy; all but the first
//! leave the element's ends unchanged.

use super::piece::Piece;
use crate::design::Stiffness;
use crate::numerics::lagrange;
use crate::numerics::quadrature::gauss_legendre;

/// Additional Gauss points along a part whose compliance changes: the inverse of a polynomial is integrated.
///
/// A part that becomes three times as stiff from one end to the other is integrated to 1e-13 with it.
const TAPERED: usize = 12;

/// Strain per stress resultant along a part.
#[derive(Debug, Clone)]
pub(super) enum Compliance {
    /// Constant along the part.
    Constant(f64),
    /// The inverse of a stiffness, a polynomial of the fourth degree through these values at five Gauss nodes.
    Tapered([f64; QUARTIC]),
}

/// Number of values that determine the stiffness along a linear taper, which goes with the fourth power of the radius at most.
const QUARTIC: usize = 5;

impl Compliance {
    /// That of a piece, by one of its stiffnesses.
    pub(super) fn of(piece: &Piece<'_>, stiffness: fn(&Stiffness) -> f64) -> Self {
        if piece.span.taper.is_none() {
            return Self::Constant(1.0 / stiffness(&piece.span.stiffness));
        }
        let (nodes, _) = gauss_legendre(QUARTIC);
        let at = |x: f64| piece.span.stiffness_at(piece.from + 0.5 * piece.length * (1.0 + x));
        Self::Tapered(core::array::from_fn(|i| stiffness(&at(nodes[i]))))
    }

    /// At `x` from -1 to 1 along the part.
    fn at(&self, x: f64) -> f64 {
        match self {
            Self::Constant(compliance) => *compliance,
            Self::Tapered(stiffness) => {
                let (nodes, _) = gauss_legendre(QUARTIC);
                let values = lagrange::values(&nodes, x);
                1.0 / values.iter().zip(stiffness).map(|(value, own)| value * own).sum::<f64>()
            }
        }
    }

    /// Number of Gauss points beyond those for a constant compliance.
    fn more_points(&self) -> usize {
        if matches!(self, Self::Tapered(_)) { TAPERED } else { 0 }
    }
}

/// A part of an element.
#[derive(Debug, Clone)]
pub(super) struct Part {
    /// Arc length of its start, m.
    pub(super) start: f64,
    /// Its length, m.
    pub(super) length: f64,
    /// Strain per stress resultant.
    pub(super) compliance: Compliance,
    /// Whether the resultant varies beside the core as it does along the core.
    pub(super) long: bool,
}

impl Part {
    /// Integral of the compliance.
    fn flexibility(&self) -> f64 {
        match self.compliance {
            Compliance::Constant(compliance) => compliance * self.length,
            Compliance::Tapered(_) => {
                let (nodes, weights) = gauss_legendre(TAPERED);
                let compliances = nodes.iter().zip(weights).map(|(x, w)| w * self.compliance.at(*x));
                0.5 * self.length * compliances.sum::<f64>()
            }
        }
    }
}

/// Variation of the resultant in the discs relative to that at the core's ends.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Ends {
    /// Equal to it.
    Constant,
    /// Linear variation from there.
    Linear,
    /// A jump, the same at both ends of the core, and linear variation from there.
    Jump,
}

/// Orthogonal modes `psi_j(s) = compliance(s) pi_j(s) / integral of the compliance`.
///
/// `pi_0 = 1`, so the integral of `psi_0` is one and that of every other mode zero; the mean square of every
/// `pi_j`, weighted by the compliance, is one.
#[derive(Debug, Clone)]
pub(super) struct Modes {
    parts: Vec<Part>,
    core: usize,
    degree: usize,
    ends: Ends,
    total: f64,
    /// Coefficients of each mode in terms of the raw functions.
    coefficients: Vec<Vec<f64>>,
}

impl Modes {
    /// Modes of polynomial degree 0 to `degree` along part `core`.
    pub(super) fn new(parts: Vec<Part>, core: usize, degree: usize, ends: Ends) -> Self {
        let total = parts.iter().map(Part::flexibility).sum();
        let mut out = Self { parts, core, degree, ends, total, coefficients: Vec::new() };
        out.orthogonalise();
        out
    }

    /// Whether others of the same parts are the same.
    pub(super) fn are_built_as(&self, other: &Self) -> bool {
        (self.degree, self.ends) == (other.degree, other.ends)
    }

    /// Number of modes.
    pub(super) fn count(&self) -> usize {
        self.coefficients.len()
    }

    /// Stiffness of each mode: the integral of `psi^2 / compliance`.
    pub(super) fn stiffness(&self) -> f64 {
        1.0 / self.total
    }

    /// Part, arc length and weight of points that integrate products of two resultants of this degree exactly.
    ///
    /// The weights include the compliance and add up to one.
    fn points(&self, degree: usize) -> impl Iterator<Item = (usize, f64, f64)> {
        self.parts.iter().enumerate().flat_map(move |(index, part)| {
            let (nodes, weights) = gauss_legendre(degree + 2 + part.compliance.more_points());
            let scale = 0.5 * part.length;
            let point = |(x, w): (f64, f64)| {
                (index, part.start + scale * (1.0 + x), scale * w * part.compliance.at(x) / self.total)
            };
            nodes.into_iter().zip(weights).map(point).collect::<Vec<_>>()
        })
    }

    /// Projection of the modes of `other`, for the same parts, onto these, by own mode and mode of `other`.
    ///
    /// The amplitudes whose strain is nearest, in the elastic energy, to that of a unit amplitude of each other mode; the same
    /// strain where the degree is at least as high.
    pub(super) fn projection(&self, other: &Self) -> Vec<Vec<f64>> {
        let mut out = vec![vec![0.0; other.count()]; self.count()];
        for (part, s, weight) in self.points(self.degree.max(other.degree)) {
            let values = |modes: &Self| -> Vec<f64> {
                let raw = modes.raw(part, s);
                modes.coefficients.iter().map(|row| row.iter().zip(&raw).map(|(c, v)| c * v).sum()).collect()
            };
            let (own, others) = (values(self), values(other));
            for (row, value) in out.iter_mut().zip(own) {
                row.iter_mut().zip(&others).for_each(|(entry, other)| *entry += weight * value * other);
            }
        }
        out
    }

    /// Gram-Schmidt orthogonalisation, applied twice for full precision, with exact quadrature.
    fn orthogonalise(&mut self) {
        let samples: Vec<(Vec<f64>, f64)> =
            self.points(self.degree).map(|(part, s, weight)| (self.raw(part, s), weight)).collect();
        let raw_count = samples.first().map_or(0, |(values, _)| values.len());
        let combine = |coefficients: &[f64], values: &[f64]| -> f64 {
            coefficients.iter().zip(values).map(|(c, v)| c * v).sum()
        };
        for j in 0..raw_count {
            let mut own = vec![0.0; raw_count];
            own[j] = 1.0;
            for earlier in self.coefficients.iter().chain(&self.coefficients) {
                let along: f64 =
                    samples.iter().map(|(v, w)| w * combine(&own, v) * combine(earlier, v)).sum();
                for (entry, e) in own.iter_mut().zip(earlier) {
                    *entry -= along * e;
                }
            }
            let square: f64 = samples.iter().map(|(v, w)| w * combine(&own, v).powi(2)).sum();
            for entry in &mut own {
                *entry /= square.sqrt();
            }
            self.coefficients.push(own);
        }
    }

    /// Raw functions at `s` in part `index`: Legendre polynomials constant outside the core, powers of the distance from the core in
    /// each disc, and a jump.
    fn raw(&self, index: usize, s: f64) -> Vec<f64> {
        let core = &self.parts[self.core];
        let x = match index.cmp(&self.core) {
            core::cmp::Ordering::Less => -1.0,
            core::cmp::Ordering::Greater => 1.0,
            core::cmp::Ordering::Equal => 2.0 * (s - core.start) / core.length - 1.0,
        };

        // Legendre's recurrence: n P_n = (2n - 1) x P_{n-1} - (n - 1) P_{n-2}.
        let mut values = vec![1.0];
        for j in 1..=self.degree {
            let (n, last) = (j as f64, values[j - 1]);
            let before = if j > 1 { values[j - 2] } else { 0.0 };
            values.push(((2.0 * n - 1.0) * x * last - (n - 1.0) * before) / n);
        }

        // They begin at zero at the disc's face to the core, so that the resultant stays continuous there.
        for (other, part) in self.parts.iter().enumerate().filter(|(other, _)| *other != self.core) {
            let edge = if other < self.core { part.start + part.length } else { part.start };
            let along = if other == index { (s - edge) / part.length } else { 0.0 };
            let mut power = 1.0;
            for _ in 0..self.powers(part) {
                power *= along;
                values.push(power);
            }
        }

        if self.ends == Ends::Jump {
            values.push(if index == self.core { 1.0 } else { 0.0 });
        }
        values
    }

    /// Highest power of the distance from the core in a disc.
    fn powers(&self, disc: &Part) -> usize {
        let slope = usize::from(self.ends != Ends::Constant);
        if disc.long { self.degree.max(slope) } else { slope }
    }

    /// Values of all modes at arc length `s` in part `index`, 1/m.
    pub(super) fn values(&self, index: usize, s: f64) -> Vec<f64> {
        let part = &self.parts[index];
        let factor = part.compliance.at(2.0 * (s - part.start) / part.length - 1.0) / self.total;
        let raw = self.raw(index, s);
        let sum = |row: &Vec<f64>| factor * row.iter().zip(&raw).map(|(c, v)| c * v).sum::<f64>();
        self.coefficients.iter().map(sum).collect()
    }

    /// Integrals of all modes from 0 to `s` in part `index`.
    pub(super) fn integrals(&self, index: usize, s: f64) -> Vec<f64> {
        let mut sum = vec![0.0; self.count()];
        for (other, part) in self.parts.iter().enumerate().take(index + 1) {
            let (nodes, weights) = gauss_legendre(self.degree / 2 + 2 + part.compliance.more_points());
            let length = if other == index { s - part.start } else { part.length };
            for (node, weight) in nodes.iter().zip(&weights) {
                let values = self.values(other, part.start + 0.5 * length * (1.0 + node));
                for (total, value) in sum.iter_mut().zip(values) {
                    *total += 0.5 * length * weight * value;
                }
            }
        }
        sum
    }
}
