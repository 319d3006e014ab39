//! The nearest point of one triangle.

use nalgebra::Vector3;

/// The part of a triangle on which a point lies.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Part {
    /// Inside.
    Face,
    /// On the edge from the corner of this number to the next.
    Edge(usize),
    /// On the corner of this number.
    Corner(usize),
}

/// The point of a surface nearest to another.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Nearest {
    /// Number of the triangle.
    pub(super) triangle: usize,
    pub(super) part: Part,
    /// The point, m.
    pub(super) point: Vector3<f64>,
    /// Square of the distance, m2.
    pub(super) square: f64,
}

impl Nearest {
    /// Farther away than any point.
    pub(super) const NONE: Self =
        Self { triangle: 0, part: Part::Face, point: Vector3::new(0.0, 0.0, 0.0), square: f64::INFINITY };
}

/// The point of the triangle with these corners nearest to `point`; its number is left 0.
///
/// C. Ericson, Real-Time Collision Detection, Morgan Kaufmann 2005, section 5.1.5: which corner, edge or face is the nearest
/// follows from the signs of products of edges and offsets.
pub(super) fn nearest_on([a, b, c]: &[Vector3<f64>; 3], point: &Vector3<f64>) -> Nearest {
    let (ab, ac) = (b - a, c - a);
    let found = |part, at: Vector3<f64>| Nearest {
        triangle: 0,
        part,
        point: at,
        square: (point - at).norm_squared(),
    };

    let from = point - a;
    let (b_of_a, c_of_a) = (ab.dot(&from), ac.dot(&from));
    if b_of_a <= 0.0 && c_of_a <= 0.0 {
        return found(Part::Corner(0), *a);
    }

    let from = point - b;
    let (b_of_b, c_of_b) = (ab.dot(&from), ac.dot(&from));
    if b_of_b >= 0.0 && c_of_b <= b_of_b {
        return found(Part::Corner(1), *b);
    }

    let from = point - c;
    let (b_of_c, c_of_c) = (ab.dot(&from), ac.dot(&from));
    if c_of_c >= 0.0 && b_of_c <= c_of_c {
        return found(Part::Corner(2), *c);
    }

    // Products of edges and offsets are the barycentric coordinates, not normalised: that of c, then of b and
    // a.
    let of_c = b_of_a * c_of_b - b_of_b * c_of_a;
    if of_c <= 0.0 && b_of_a >= 0.0 && b_of_b <= 0.0 {
        return found(Part::Edge(0), a + ab * (b_of_a / (b_of_a - b_of_b)));
    }

    let of_b = b_of_c * c_of_a - b_of_a * c_of_c;
    if of_b <= 0.0 && c_of_a >= 0.0 && c_of_c <= 0.0 {
        return found(Part::Edge(2), a + ac * (c_of_a / (c_of_a - c_of_c)));
    }

    let of_a = b_of_b * c_of_c - b_of_c * c_of_b;
    let (to_b, to_c) = (b_of_c - c_of_c, c_of_b - b_of_b);
    if of_a <= 0.0 && to_b >= 0.0 && to_c >= 0.0 {
        return found(Part::Edge(1), b + (c - b) * (to_c / (to_b + to_c)));
    }

    let whole = of_a + of_b + of_c;
    found(Part::Face, a + ab * (of_b / whole) + ac * (of_c / whole))
}
