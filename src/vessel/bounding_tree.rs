//! The nearest triangle of many, by a tree of boxes.

use nalgebra::Vector3;

use super::triangle::{Nearest, nearest_on};

/// Largest number of triangles in a leaf: the fastest of 1 to 16, by a fifth (a tube of 100,000 triangles).
const LEAF: usize = 8;

/// Boxes that may wait in a search: the tree halves the triangles, of which there are fewer than 2^32.
const DEEPEST: usize = 40;

/// Boxes around triangles, halved at the median of their middles along the longest side until few are left.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct BoundingTree {
    nodes: Vec<Node>,
    /// Numbers of the triangles and their corners (m), leaf by leaf.
    numbers: Vec<u32>,
    corners: Vec<[Vector3<f64>; 3]>,
}

/// A box, m. The first half of an inner one follows it.
#[derive(Debug, Clone, Copy, PartialEq)]
struct Node {
    lower: Vector3<f64>,
    upper: Vector3<f64>,
    /// Of a leaf the first triangle, else the node of the second half.
    next: u32,
    /// Triangles of a leaf, else 0.
    count: u32,
}

impl Node {
    /// Square of the distance from the box, m2.
    fn distance(&self, point: &Vector3<f64>) -> f64 {
        (self.lower - point).sup(&(point - self.upper)).sup(&Vector3::zeros()).norm_squared()
    }
}

impl BoundingTree {
    /// Of at least one triangle and fewer than 2^32; corners in m.
    pub(super) fn new(triangles: &[[Vector3<f64>; 3]]) -> Self {
        let middles: Vec<_> = triangles.iter().map(|[a, b, c]| (a + b + c) / 3.0).collect();
        #[expect(clippy::cast_possible_truncation, reason = "fewer than 2^32")]
        let mut numbers: Vec<u32> = (0..triangles.len() as u32).collect();
        let mut nodes = Vec::with_capacity(triangles.len());
        divide(triangles, &middles, &mut numbers, 0, &mut nodes);
        let corners = numbers.iter().map(|number| triangles[*number as usize]).collect();
        Self { nodes, numbers, corners }
    }

    /// The box around all triangles, m.
    pub(super) fn bounds(&self) -> [Vector3<f64>; 2] {
        [self.nodes[0].lower, self.nodes[0].upper]
    }

    /// The point of the triangles nearest to `point` (m).
    pub(super) fn nearest(&self, point: &Vector3<f64>) -> Nearest {
        let mut best = Nearest::NONE;
        let mut waiting = [(0, 0.0); DEEPEST];
        let mut count = 1;
        while count > 0 {
            count -= 1;
            let (mut at, distance) = waiting[count];
            if distance >= best.square {
                continue;
            }

            // Down to the leaf in the nearer box; the other box waits, if it can still hold a nearer point.
            while self.nodes[at].count == 0 {
                let halves = [at + 1, self.nodes[at].next as usize];
                let [mut near, mut far] = halves.map(|half| (half, self.nodes[half].distance(point)));
                if far.1 < near.1 {
                    core::mem::swap(&mut near, &mut far);
                }
                if far.1 < best.square {
                    waiting[count] = far;
                    count += 1;
                }
                at = near.0;
                if near.1 >= best.square {
                    break;
                }
            }

            // Empty after the break above: an inner node counts no triangles of its own.
            let Node { next, count: triangles, .. } = self.nodes[at];
            for place in next as usize..(next + triangles) as usize {
                let found = nearest_on(&self.corners[place], point);
                if found.square < best.square {
                    best = Nearest { triangle: self.numbers[place] as usize, ..found };
                }
            }
        }

        best
    }
}

/// Adds the box of these triangles, the first of which is number `start` in the order of the leaves, and its halves.
fn divide(
    triangles: &[[Vector3<f64>; 3]],
    middles: &[Vector3<f64>],
    numbers: &mut [u32],
    start: usize,
    nodes: &mut Vec<Node>,
) {
    let far = Vector3::repeat(f64::INFINITY);
    let (mut lower, mut upper, mut least, mut most) = (far, -far, far, -far);
    for number in numbers.iter().map(|number| *number as usize) {
        for corner in &triangles[number] {
            (lower, upper) = (lower.inf(corner), upper.sup(corner));
        }
        (least, most) = (least.inf(&middles[number]), most.sup(&middles[number]));
    }

    let at = nodes.len();
    #[expect(clippy::cast_possible_truncation, reason = "fewer than 2^32")]
    nodes.push(Node { lower, upper, next: start as u32, count: numbers.len() as u32 });

    // Halved at the median of the middles, along the axis on which these spread most.
    if numbers.len() > LEAF {
        let axis = (most - least).imax();
        let half = numbers.len() / 2;
        numbers.select_nth_unstable_by(half, |a, b| {
            middles[*a as usize][axis].total_cmp(&middles[*b as usize][axis])
        });
        let (first, second) = numbers.split_at_mut(half);
        divide(triangles, middles, first, start, nodes);
        #[expect(clippy::cast_possible_truncation, reason = "fewer nodes than triangles")]
        let next = nodes.len() as u32;
        (nodes[at].next, nodes[at].count) = (next, 0);
        divide(triangles, middles, second, start + half, nodes);
    }
}
