//! The inner wall of a vessel as a closed surface of triangles.

use nalgebra::Vector3;

use super::bounding_tree::BoundingTree;
use super::grid::DistanceGrid;
use super::sampling::allowed_spacings;
use super::surface::Surface;
use super::triangle::{Nearest, Part};
use crate::error::Error;

/// Number of triangles, spread over the list, at which the width is measured.
const MEASURED: usize = 4000;

/// A ball counts as empty when what reaches into it would not make its radius smaller than by this factor: a round tube touches
/// its largest balls all around.
const EMPTY: f64 = 0.95;

/// Steps of a ball that shrinks until it is empty; it takes about five.
const STEPS: usize = 50;

/// Cosine of the angle at a ball's centre between the two places that it touches: below it these are opposite walls and not
/// two sides of a corner.
const OPPOSITE: f64 = -0.5;

/// Share of the measured wall that may be narrower: roughness.
const ROUGH: f64 = 0.02;

/// Default spacings of a grid in the narrowest radius: the finest and the coarsest. Measured on a straight tube: gradients to
/// 0.002 and 0.03 down to 0.4 radii from the wall.
const PER_RADIUS: [f64; 2] = [1.0 / 8.0, 1.0 / 4.0];

/// The inner wall of a vessel, a closed surface of triangles.
///
/// The distance to it is exact, but it has kinks where two parts of the wall are equally near: in the middle of a vessel and,
/// since facets are flat, in front of every edge. [`Mesh::distance_grid`] smooths them. All ends are walls: the mesh has to
/// reach beyond the place where a device enters. A surface that crosses itself is noticed only by [`Mesh::distance_grid`].
///
/// ```
/// use mcm::vessel::Mesh;
/// use nalgebra::Vector3;
/// // A box of 10 x 10 x 20 mm: the eight corners, two triangles on each side.
/// let corner = |n: usize| Vector3::new((n & 1) as f64, (n >> 1 & 1) as f64, (n >> 2) as f64 * 2.0) * 0.01;
/// let sides = [[0, 1, 3, 2], [4, 6, 7, 5], [0, 4, 5, 1], [2, 3, 7, 6], [0, 2, 6, 4], [1, 5, 7, 3]];
/// let triangles: Vec<_> =
///     sides.iter().flat_map(|&[a, b, c, d]| [[a, b, c], [a, c, d]]).map(|three| three.map(corner)).collect();
/// let mesh = Mesh::new(&triangles)?;
/// assert!((mesh.distance(&Vector3::new(5e-3, 4e-3, 9e-3)) - 4e-3).abs() < 1e-15);
/// assert!((mesh.distance(&Vector3::new(-3e-3, -4e-3, 9e-3)) + 5e-3).abs() < 1e-15);
/// let refused = Mesh::new(&triangles[1..]).unwrap_err().to_string();
/// assert!(refused.starts_with("number of open edges of the vessel's mesh, the first from (0.000, 0.000, 0.000) mm"));
/// # Ok::<(), mcm::error::Error>(())
/// ```
#[derive(Debug, Clone, PartialEq)]
pub struct Mesh {
    surface: Surface,
    tree: BoundingTree,
    /// Unit normals of the triangles, outwards.
    faces: Vec<Vector3<f64>>,
    /// Sums of the normals around each corner, weighted by angle.
    corners: Vec<Vector3<f64>>,
    /// Area, m2.
    area: f64,
}

impl Mesh {
    /// The surface of these triangles, each given by its corners (m).
    ///
    /// Corners at exactly the same place are one. Triangles may be listed in any orientation: they are turned so that
    /// neighbours agree and the volume is positive. A triangle without area is left out.
    ///
    /// # Errors
    /// [`Error::Count`] for no triangle; [`Error::Range`] for a coordinate that is not finite or beyond 10 m, for edges that do
    /// not belong to exactly two triangles, for several separate surfaces, and where no volume is enclosed;
    /// [`Error::Unsupported`] for a surface that has only one side or touches itself in a point. Triangles are counted from 1.
    pub fn new(triangles: &[[Vector3<f64>; 3]]) -> Result<Self, Error> {
        let surface = Surface::new(triangles)?;
        let mut corners = vec![Vector3::zeros(); surface.vertices.len()];
        let mut faces = Vec::with_capacity(surface.triangles.len());
        let mut placed = Vec::with_capacity(surface.triangles.len());
        let mut area = 0.0;
        for (triangle, numbers) in surface.triangles.iter().enumerate() {
            let points = surface.corners(triangle);
            let across = (points[1] - points[0]).cross(&(points[2] - points[0]));
            let normal = across.normalize();
            for (i, number) in numbers.iter().enumerate() {
                let (next, last) = (points[(i + 1) % 3] - points[i], points[(i + 2) % 3] - points[i]);
                corners[*number] += normal * next.angle(&last);
            }
            area += 0.5 * across.norm();
            faces.push(normal);
            placed.push(points);
        }
        Ok(Self { tree: BoundingTree::new(&placed), surface, faces, corners, area })
    }

    /// Number of triangles with an area.
    #[must_use]
    pub fn triangles(&self) -> usize {
        self.faces.len()
    }

    /// Volume enclosed, m3.
    #[must_use]
    pub fn volume(&self) -> f64 {
        self.surface.volume
    }

    /// Area of the wall, m2.
    #[must_use]
    pub fn area(&self) -> f64 {
        self.area
    }

    /// Lowest and highest coordinates, m.
    #[must_use]
    pub fn bounds(&self) -> [Vector3<f64>; 2] {
        self.tree.bounds()
    }

    /// Distance from `point` (m) to the nearest triangle, m: positive inside, negative outside.
    ///
    /// On which side the point lies follows from the normal at the nearest place: that of the face, the sum of both at an edge,
    /// and the sum weighted by angles at a corner: J. A. Baerentzen, H. Aanaes, Signed distance computation using the angle
    /// weighted pseudonormal, doi 10.1109/TVCG.2005.49.
    #[must_use]
    pub fn distance(&self, point: &Vector3<f64>) -> f64 {
        let nearest = self.tree.nearest(point);
        let outwards = self.normal(&nearest).dot(&(point - nearest.point));
        let distance = nearest.square.sqrt();
        if outwards > 0.0 { -distance } else { distance }
    }

    /// The normal by which a point is known to be outside.
    fn normal(&self, nearest: &Nearest) -> Vector3<f64> {
        let own = self.faces[nearest.triangle];
        match nearest.part {
            Part::Face => own,
            Part::Edge(edge) => own + self.faces[self.surface.neighbours[nearest.triangle][edge]],
            Part::Corner(corner) => self.corners[self.surface.triangles[nearest.triangle][corner]],
        }
    }

    /// Radius (m) of the narrowest part: the largest ball that touches two opposite walls there. A fiftieth of the wall may be
    /// narrower, as it is in pits.
    ///
    /// From some thousand triangles a ball that touches there shrinks until it is empty: J. Ma, S. W. Bae, S. Choi, 3D medial
    /// axis point approximation using nearest neighbors and the normal field, doi 10.1007/s00371-011-0594-7. Where no walls are
    /// opposite, it is that of a round tube of the same volume and area.
    #[must_use]
    pub fn narrowest_radius(&self) -> f64 {
        let step = self.triangles().div_ceil(MEASURED);
        let balls = (0..self.triangles()).step_by(step).filter_map(|triangle| self.ball(triangle));
        let mut balls: Vec<[f64; 2]> = balls.collect();
        balls.sort_by(|a, b| a[0].total_cmp(&b[0]));
        let mut rough = ROUGH * balls.iter().map(|[_, area]| area).sum::<f64>();
        let narrowest = balls.iter().find(|[_, area]| {
            rough -= area;
            rough <= 0.0
        });
        narrowest.map_or(2.0 * self.volume() / self.area, |[radius, _]| *radius)
    }

    /// Radius (m) of the largest empty ball that touches the wall in the middle of a triangle, and the triangle's area (m2);
    /// `None` if the ball lies in a corner.
    fn ball(&self, triangle: usize) -> Option<[f64; 2]> {
        let [a, b, c] = self.surface.corners(triangle);
        let (middle, inwards) = ((a + b + c) / 3.0, -self.faces[triangle]);
        let [lower, upper] = self.bounds();
        let (mut radius, mut other) = ((upper - lower).norm(), middle);
        for _ in 0..STEPS {
            let found = self.tree.nearest(&(middle + inwards * radius)).point;
            let chord = found - middle;
            let smaller = 0.5 * chord.norm_squared() / chord.dot(&inwards);
            // Not smaller, or NaN where the ball touches at its own triangle only: it is empty.
            if !(smaller > 0.0 && smaller < radius * EMPTY) {
                break;
            }
            (radius, other) = (smaller, found);
        }
        let centre = middle + inwards * radius;
        let cosine = (middle - centre).dot(&(other - centre)) / (radius * radius);
        (cosine < OPPOSITE).then(|| [radius, 0.5 * (b - a).cross(&(c - a)).norm()])
    }

    /// The clearance from this wall with continuous derivatives, from samples `spacing` (m) apart.
    ///
    /// `None` takes the mean of the triangles' shortest edges, but at least an eighth and at most a quarter of the narrowest
    /// radius, and no less than memory allows: a finer grid shows the facets, a coarser one the kink in the middle of the
    /// vessel ([`DistanceGrid`] says what that does). How far the grid is from this wall is told by [`Mesh::deviation`].
    ///
    /// # Errors
    /// As [`DistanceGrid::new`], as where the surface crosses itself.
    pub fn distance_grid(&self, spacing: Option<f64>) -> Result<DistanceGrid, Error> {
        let spacing = match spacing {
            Some(spacing) => spacing,
            None => self.default_spacing()?,
        };
        DistanceGrid::new(self.bounds(), spacing, |point| self.distance(point))
    }

    fn default_spacing(&self) -> Result<f64, Error> {
        let shortest = (0..self.triangles()).map(|triangle| {
            let [a, b, c] = self.surface.corners(triangle);
            (b - a).norm().min((c - b).norm()).min((a - c).norm())
        });
        let facet = shortest.sum::<f64>() / self.triangles() as f64;
        let [fine, coarse] = PER_RADIUS.map(|share| share * self.narrowest_radius());
        let [finest, coarsest] = allowed_spacings(self.bounds())?;
        Ok(facet.clamp(fine, coarse).max(finest).min(coarsest))
    }

    /// Largest clearance (m, without sign) that a grid tells in the middle of a triangle, where it should be zero. It is larger
    /// at sharp edges, such as those of flat ends, than along a smooth wall.
    #[must_use]
    pub fn deviation(&self, grid: &DistanceGrid) -> f64 {
        let middles = (0..self.triangles())
            .map(|triangle| self.surface.corners(triangle).iter().sum::<Vector3<f64>>() / 3.0);
        middles.map(|middle| grid.clearance(&middle).value.abs()).fold(0.0, f64::max)
    }
}
