//! The triangles of a closed surface: which share an edge, and which side is outside.

use std::collections::HashMap;

use nalgebra::Vector3;

use crate::error::{Error, check};

/// Largest coordinate, m: more is a mistaken unit.
const LARGEST: f64 = 10.0;

/// Height of a triangle relative to its longest edge up to which it has no area: rounding of its corners.
const FLAT: f64 = 1e-12;

/// Volume relative to the cube of the extent up to which nothing is enclosed: rounding.
const NO_VOLUME: f64 = 1e-12;

/// A closed, connected surface whose triangles are listed counter-clockwise as seen from outside.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Surface {
    /// Corners, m.
    pub(super) vertices: Vec<Vector3<f64>>,
    /// Numbers of each triangle's corners.
    pub(super) triangles: Vec<[usize; 3]>,
    /// Numbers of the triangles beyond each one's edges; the first edge is that from its first corner to its second.
    pub(super) neighbours: Vec<[usize; 3]>,
    /// Enclosed volume, m3.
    pub(super) volume: f64,
}

/// An edge of a triangle: its ends, the lower number first; triangle and number of the edge there.
type Edge = ([usize; 2], usize, usize);

impl Surface {
    /// From the corners (m) of triangles, in any order and orientation.
    ///
    /// # Errors
    /// As [`super::Mesh::new`].
    pub(super) fn new(given: &[[Vector3<f64>; 3]]) -> Result<Self, Error> {
        if given.is_empty() {
            return Err(Error::Count {
                quantity: "list of triangles of the vessel's mesh".into(),
                given: 0,
                expected: "at least 4".into(),
            });
        }
        for (number, corners) in (1..).zip(given) {
            for value in corners.iter().flat_map(Vector3::iter) {
                let quantity = format!("coordinate (m) of triangle {number} of the vessel's mesh");
                check(&quantity, *value, |v| v.abs() <= LARGEST, "between -10 and 10")?;
            }
        }
        let mut numbers = HashMap::new();
        let mut vertices = Vec::new();
        let mut number_of = |corner: &Vector3<f64>| {
            // Adding zero makes -0 to 0, which is the same place.
            *numbers.entry(corner.map(|v| (v + 0.0).to_bits())).or_insert_with(|| {
                vertices.push(*corner);
                vertices.len() - 1
            })
        };
        let mut flat = Vec::new();
        let mut triangles = Vec::with_capacity(given.len());
        for (number, corners) in (1..).zip(given) {
            if is_flat(corners) {
                flat.push(number);
            } else {
                triangles.push([0, 1, 2].map(|i| number_of(&corners[i])));
            }
        }
        let mut surface = Self { neighbours: Vec::new(), volume: 0.0, vertices, triangles };
        surface.neighbours = surface.pair_edges(&flat)?;
        surface.orient()?;
        surface.check_corners()?;
        Ok(surface)
    }

    /// Corners of a triangle, m.
    pub(super) fn corners(&self, triangle: usize) -> [Vector3<f64>; 3] {
        self.triangles[triangle].map(|corner| self.vertices[corner])
    }

    /// The triangles beyond each one's edges.
    fn pair_edges(&self, flat: &[usize]) -> Result<Vec<[usize; 3]>, Error> {
        let mut edges: Vec<Edge> = Vec::with_capacity(3 * self.triangles.len());
        for (number, corners) in self.triangles.iter().enumerate() {
            for edge in 0..3 {
                let (from, to) = (corners[edge], corners[(edge + 1) % 3]);
                edges.push(([from.min(to), from.max(to)], number, edge));
            }
        }

        edges.sort_unstable();
        let mut neighbours = vec![[0; 3]; self.triangles.len()];
        let (mut open, mut crowded): (Vec<Edge>, Vec<Edge>) = (Vec::new(), Vec::new());

        // On a closed surface each edge is shared by two triangles.
        for group in edges.chunk_by(|a, b| a.0 == b.0) {
            match group {
                [(_, first, edge), (_, second, other)] => {
                    neighbours[*first][*edge] = *second;
                    neighbours[*second][*other] = *first;
                }
                [only] => open.push(*only),
                _ => crowded.push(group[0]),
            }
        }

        self.check_edges(&open, &crowded, flat)?;
        Ok(neighbours)
    }

    /// That there are triangles, and that two share each edge; `flat` are the numbers of triangles without area, left out.
    fn check_edges(&self, open: &[Edge], crowded: &[Edge], flat: &[usize]) -> Result<(), Error> {
        let aside = flat.first().map_or(String::new(), |first| {
            format!(" (leaving out {} without area, first triangle {first})", flat.len())
        });
        for (edges, kind) in [(open, "open edges"), (crowded, "edges shared by more than two triangles")] {
            if let Some((ends, ..)) = edges.iter().min_by_key(|(_, triangle, edge)| (triangle, edge)) {
                let [from, to] = ends.map(|end| in_mm(&self.vertices[end]));
                let quantity =
                    format!("number of {kind} of the vessel's mesh{aside}, the first from {from} to {to},");
                return Err(Error::range(quantity, edges.len() as f64, "0, as it is of a closed surface"));
            }
        }

        if self.triangles.is_empty() {
            return Err(Error::range(
                format!("number of triangles with an area of the vessel's mesh{aside}"),
                0.0,
                "at least 4",
            ));
        }
        Ok(())
    }

    /// Turns triangles so that neighbours agree and the normals point outwards.
    fn orient(&mut self) -> Result<(), Error> {
        let mut turned: Vec<Option<bool>> = vec![None; self.triangles.len()];
        turned[0] = Some(false);
        let (mut waiting, mut reached) = (vec![0], 1);
        while let Some(triangle) = waiting.pop() {
            let own = turned[triangle] == Some(true);
            for edge in 0..3 {
                let other = self.neighbours[triangle][edge];
                // Two that agree run through their edge in opposite directions.
                let turn = own ^ self.runs_along(other, triangle, edge);
                match turned[other] {
                    None => {
                        turned[other] = Some(turn);
                        waiting.push(other);
                        reached += 1;
                    }
                    Some(known) if known != turn => {
                        return Err(Error::Unsupported(format!(
                            "the vessel's mesh has no inside: it is a one-sided surface, seen at {}",
                            in_mm(&self.corners(triangle)[edge])
                        )));
                    }
                    Some(_) => {}
                }
            }
        }
        if let Some(apart) = turned.iter().position(Option::is_none) {
            let place = in_mm(&self.corners(apart)[0]);
            let quantity = format!(
                "number of triangles of the vessel's mesh that do not hang together with the first one, one at {place},"
            );
            return Err(Error::range(quantity, (turned.len() - reached) as f64, "0, for one surface"));
        }
        let volume = self.volume_if(&turned);
        let extent =
            self.vertices.iter().fold(0.0_f64, |extent, v| extent.max((v - self.vertices[0]).norm()));
        let quantity = "volume (m3) enclosed by the vessel's mesh";
        check(quantity, volume.abs(), |v| v > NO_VOLUME * extent.powi(3), "> 0")?;
        self.volume = volume.abs();
        for (triangle, turned) in turned.iter().enumerate() {
            if (*turned == Some(true)) ^ (volume < 0.0) {
                self.triangles[triangle].swap(1, 2);
                self.neighbours[triangle].swap(0, 2);
            }
        }
        Ok(())
    }

    /// Whether `other` runs through this edge of `triangle` in the same direction.
    fn runs_along(&self, other: usize, triangle: usize, edge: usize) -> bool {
        let corners = self.triangles[triangle];
        let (from, to) = (corners[edge], corners[(edge + 1) % 3]);
        (0..3).any(|i| self.triangles[other][i] == from && self.triangles[other][(i + 1) % 3] == to)
    }

    /// Enclosed volume with some of the triangles turned, m3; positive if the normals point outwards.
    fn volume_if(&self, turned: &[Option<bool>]) -> f64 {
        let origin = self.vertices[0];
        let sixfold = turned.iter().enumerate().map(|(triangle, turned)| {
            let [a, b, c] = self.corners(triangle).map(|corner| corner - origin);
            a.cross(&b).dot(&c) * if *turned == Some(true) { -1.0 } else { 1.0 }
        });
        sixfold.sum::<f64>() / 6.0
    }

    /// That the triangles around each corner are one fan.
    fn check_corners(&self) -> Result<(), Error> {
        let mut around = vec![0_usize; self.vertices.len()];
        for corner in self.triangles.iter().flatten() {
            around[*corner] += 1;
        }

        let mut seen = vec![false; self.vertices.len()];
        for first in 0..self.triangles.len() {
            for corner in self.triangles[first] {
                if core::mem::replace(&mut seen[corner], true) {
                    continue;
                }

                // Around the corner from neighbour to neighbour, until the first triangle comes again.
                let (mut triangle, mut fan) = (first, 0);
                while fan <= around[corner] && (fan == 0 || triangle != first) {
                    let edge = self.triangles[triangle].iter().position(|own| *own == corner);
                    triangle = self.neighbours[triangle][edge.unwrap_or(0)];
                    fan += 1;
                }

                if fan != around[corner] {
                    return Err(Error::Unsupported(format!(
                        "the vessel's mesh touches itself in a single point at {}",
                        in_mm(&self.vertices[corner])
                    )));
                }
            }
        }

        Ok(())
    }
}

/// Whether a triangle has no area.
fn is_flat([a, b, c]: &[Vector3<f64>; 3]) -> bool {
    let longest = (b - a).norm_squared().max((c - b).norm_squared()).max((a - c).norm_squared());
    (b - a).cross(&(c - a)).norm() <= FLAT * longest
}

/// A place in words.
pub(super) fn in_mm(place: &Vector3<f64>) -> String {
    format!("({:.3}, {:.3}, {:.3}) mm", 1e3 * place.x, 1e3 * place.y, 1e3 * place.z)
}
