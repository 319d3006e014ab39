//! Derivatives of the Newtonian potential of a cuboid, in closed form.
//!
//! The mixed second derivatives are potentials of the edges, each a charged line of length `L` at the distances `r_1`, `r_2` of its ends:
//! `T = ln((r_1 + r_2 + L) / (r_1 + r_2 - L))`; the others are the solid angles of the faces. Written by edges instead of by corners
//! (Engel-Herbert and Hesjedal, Journal of Applied Physics 97 (2005), 074504, doi:10.1063/1.1883308), no logarithm is singular on the
//! lines that go on from an edge, and far away two powers of the distance less are lost.

use core::f64::consts::PI;

use nalgebra::Vector3;

use super::shape_derivatives::{Fourth, Second, Third};

/// Distance from an edge, relative to that of its farther end, below which a point counts as lying on it.
const ON_EDGE: f64 = 4.0 * f64::EPSILON;

/// The two other axes of each axis.
const OTHERS: [[usize; 2]; 3] = [[1, 2], [2, 0], [0, 1]];

/// Where a point is, seen from the eight corners of a cuboid; index 0 is the lower corner along an axis, 1 the upper one.
pub(super) struct Corners {
    /// Coordinates of the point from the corners, by axis, m. A zero has the sign that it has outside the face.
    from: [[f64; 2]; 3],
    /// Lengths of the edges by axis, m.
    length: [f64; 3],
    /// Distances from the corners, by bits of the index: one an axis.
    distance: [f64; 8],
}

/// The potential of an edge and its derivatives.
struct Edge {
    /// `T`.
    potential: f64,
    /// `(1/rho) dT/drho`, 1/m2, where `rho` is the distance from the edge's line.
    slope: f64,
    /// `(1/rho) d slope/drho`, 1/m4.
    bend: f64,
}

/// -1 for the lower corner, 1 for the upper one.
const SIGN: [f64; 2] = [-1.0, 1.0];

impl Corners {
    /// A point in the frame of a cuboid with these halves of its edges, m; `None` on an edge.
    #[inline]
    pub(super) fn new(half: &Vector3<f64>, point: &Vector3<f64>) -> Option<Self> {
        let from: [[f64; 2]; 3] = core::array::from_fn(|axis| {
            let beside = |corner: usize| {
                let offset = point[axis] - SIGN[corner] * half[axis];
                if offset == 0.0 { 0.0_f64.copysign(SIGN[corner]) } else { offset }
            };
            [beside(0), beside(1)]
        });
        let squares = from.map(|pair| pair.map(|offset| offset * offset));
        let distance = core::array::from_fn(|corner| {
            (squares[0][corner & 1] + squares[1][corner >> 1 & 1] + squares[2][corner >> 2]).sqrt()
        });
        let out = Self { from, length: (2.0 * half).into(), distance };
        (!out.is_on_edge()).then_some(out)
    }

    fn is_on_edge(&self) -> bool {
        (0..3).any(|axis| {
            let [low, high] = self.from[axis];
            let [one, two] = OTHERS[axis].map(|other| self.from[other].map(f64::abs));
            let rho = one[0].min(one[1]).hypot(two[0].min(two[1]));
            let farther = rho.max(low.abs()).max(high.abs());
            let beyond = high.max(-low).max(0.0);
            rho.hypot(beyond) <= ON_EDGE * farther
        })
    }

    /// Distances of the lower and the upper end of the edge along `axis` at these corners of the two other axes.
    #[inline]
    fn ends(&self, axis: usize, at: [usize; 2]) -> [f64; 2] {
        let [one, two] = OTHERS[axis];
        let corner = at[0] << one | at[1] << two;
        [self.distance[corner], self.distance[corner | 1 << axis]]
    }

    /// The edge along `axis` at these corners of the two other axes.
    #[inline]
    fn edge(&self, axis: usize, at: [usize; 2]) -> Edge {
        let ([low, high], length) = (self.from[axis], self.length[axis]);
        let [r_low, r_high] = self.ends(axis, at);
        let [x, y] = [0, 1].map(|i| self.from[OTHERS[axis][i]][at[i]]);
        let rho2 = x * x + y * y;

        // The sum of the distances exceeds the length by this, without cancellation.
        let beyond = |r: f64, height: f64| rho2 / (r + height.abs());
        let excess = if low * high < 0.0 {
            beyond(r_low, low) + beyond(r_high, high)
        } else if low.abs() > high.abs() {
            beyond(r_low, low) + r_high + high.abs()
        } else {
            beyond(r_high, high) + r_low + low.abs()
        };

        let sum = r_low + r_high;
        let inverse = 1.0 / (r_low * r_high);
        let product = 1.0 / (excess * (sum + length));
        let slope = -2.0 * length * sum * product * inverse;
        let squares = 1.0 / (r_low * r_low) + 1.0 / (r_high * r_high);
        Edge {
            potential: (2.0 * length / excess).ln_1p(),
            slope,
            bend: slope * (inverse - 2.0 * sum * sum * product * inverse - squares),
        }
    }

    /// Angle of the face normal to `axis` at its corner `side`, between the ends of its edge at the corner `beside` of the first of the
    /// other axes.
    #[inline]
    fn angle(&self, axis: usize, side: usize, beside: usize) -> f64 {
        let [one, two] = OTHERS[axis];
        let (x, y) = (self.from[axis][side], self.from[one][beside]);
        let [low, high] = self.from[two];
        let corner = side << axis | beside << one;
        let [r_low, r_high] = [self.distance[corner], self.distance[corner | 1 << two]];
        let cross = low.abs() * r_high + high.abs() * r_low;
        let difference = if low * high < 0.0 {
            cross
        } else {
            self.length[two] * (low.abs() + high.abs()) * (x * x + y * y) / cross
        };
        (x * y * difference).atan2(x * x * r_low * r_high + y * y * low * high)
    }

    /// Sums over the four edges along `axis` of their signs times numbers of the edge, of which the point is this far away along the two
    /// other axes.
    #[inline]
    fn of_edges<const COUNT: usize>(
        &self,
        axis: usize,
        numbers: impl Fn(&Edge, f64, f64) -> [f64; COUNT],
    ) -> [f64; COUNT] {
        let mut sums = [0.0; COUNT];
        for (i, first) in SIGN.iter().enumerate() {
            for (j, second) in SIGN.iter().enumerate() {
                let [x, y] = [self.from[OTHERS[axis][0]][i], self.from[OTHERS[axis][1]][j]];
                let each = numbers(&self.edge(axis, [i, j]), x, y);
                for (sum, number) in sums.iter_mut().zip(each) {
                    *sum += first * second * number;
                }
            }
        }
        sums.map(|sum| sum / (4.0 * PI))
    }

    /// Sum over the corners of their signs times a number of the corner, by its bits.
    #[inline]
    fn of_corners(number: impl Fn(usize) -> f64) -> f64 {
        let sign = |corner: usize| SIGN[corner & 1] * SIGN[corner >> 1 & 1] * SIGN[corner >> 2];
        (0..8).map(|corner| sign(corner) * number(corner)).sum::<f64>() / (4.0 * PI)
    }

    /// The second derivatives of the potential; their sum is 0 outside and -1 inside.
    pub(super) fn second(&self) -> Second {
        let face = |axis: usize| {
            let mut sum = 0.0;
            for (side, first) in SIGN.iter().enumerate() {
                for (beside, second) in SIGN.iter().enumerate() {
                    sum -= first * second * self.angle(axis, side, beside);
                }
            }
            sum / (4.0 * PI)
        };
        let [[yz], [xz], [xy]] = [0, 1, 2].map(|axis| self.of_edges(axis, |edge, _, _| [edge.potential]));
        [face(0), xy, xz, face(1), yz, face(2)]
    }

    /// The third derivatives of the potential, 1/m.
    pub(super) fn third(&self) -> Third {
        // Of the edges along each axis, the derivatives along the two others.
        let pairs = [0, 1, 2].map(|axis| self.of_edges(axis, |edge, x, y| [x * edge.slope, y * edge.slope]));
        let [[yyz, yzz], [xzz, xxz], [xxy, xyy]] = pairs;
        let xyz = -Self::of_corners(|corner| 1.0 / self.distance[corner]);
        [-xyy - xzz, xxy, xxz, xyy, xyz, xzz, -xxy - yzz, yyz, yzz, -xxz - yyz]
    }

    /// The fourth derivatives of the potential, 1/m2.
    pub(super) fn fourth(&self) -> Fourth {
        // Of the edges along each axis: d1 d1, d1 d2 and d2 d2.
        let triples = [0, 1, 2].map(|axis| {
            self.of_edges(axis, |edge, x, y| {
                let Edge { slope, bend, .. } = edge;
                [slope + x * x * bend, x * y * bend, slope + y * y * bend]
            })
        });
        let [[yyyz, yyzz, yzzz], [xzzz, xxzz, xxxz], [xxxy, xxyy, xyyy]] = triples;
        let of_corners = |axis: usize| {
            Self::of_corners(|corner| self.from[axis][corner >> axis & 1] / self.distance[corner].powi(3))
        };
        let [xxyz, xyyz, xyzz] = [0, 1, 2].map(of_corners);
        [
            -xxyy - xxzz,
            xxxy,
            xxxz,
            xxyy,
            xxyz,
            xxzz,
            xyyy,
            xyyz,
            xyzz,
            xzzz,
            -xxyy - yyzz,
            yyyz,
            yyzz,
            yzzz,
            -xxzz - yyzz,
        ]
    }
}
