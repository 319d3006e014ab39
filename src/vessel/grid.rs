//! Distance to the wall, interpolated between samples.

use nalgebra::{Matrix3, Vector3};
use serde::{Deserialize, Serialize};

use super::clearance::Clearance;
use super::sampling::{AROUND, Nodes};
use crate::error::{Error, check};
use crate::numerics::refinement::{RATIO, Refinement};
use crate::numerics::tricubic::SpacePoint;

/// Spacings from the outermost nodes within which a point is moved towards the middle; the wall is as far from there again.
const BORDER: f64 = 8.0;

/// Spacings over which points outside come to rest, and over which their distance from there begins to count.
const SMOOTH: f64 = 4.0;

/// Begins the bytes and changes with their layout.
const VERSION: u32 = 1;

/// The clearance in a vessel of any shape, interpolated between samples with two continuous derivatives.
///
/// Samples lie on a regular grid inside the vessel and down to five spacings behind its wall, elsewhere on one four times as
/// coarse; between them run cubic B-splines. A look-up takes the same time everywhere and no memory. Gradient
/// and second derivative are those of the interpolation. Far outside its grid the clearance falls by the distance from there.
///
/// How far the interpolation is from the distance that was sampled, measured in a straight round tube of radius `R` with
/// spacing `h`, between the wall and a depth of 0.15 R (and of 0.4 R):
///
/// | h / R | value / R | gradient | second derivative, relative |
/// | --- | --- | --- | --- |
/// | 1/4 | 8e-4 (3e-3) | 0.007 (0.03) | 0.1 (0.3) |
/// | 1/6 | 4e-5 (3e-4) | 0.001 (0.007) | 0.02 (0.07) |
/// | 1/8 | 4e-6 (4e-5) | 1.3e-4 (0.0013) | 0.005 (0.02) |
/// | 1/16 | 2.5e-7 (7e-7) | 1e-5 (3e-5) | 0.001 (0.003) |
///
/// - In the middle of a vessel, where opposite walls are equally near, the distance has a kink. Within two spacings it is
///   rounded off, by 0.4 h at most; the effect falls by 0.27 with every spacing from there to the wall. Contacts are near the
///   wall.
/// - A wall of flat facets is seen as such where they are larger than the spacing. Of length `s` along the circumference of
///   that tube, they lie up to `s^2/(8R)` inside it and turn by `s/R` at every edge: the gradient is off by up to half of that,
///   the second derivative, `1/R` of a round wall, is spread to `1.4 s/(R h)` at edges and zero between them. For a smooth wall
///   the facets should be as small as the spacing, better half.
/// - Edges of a wall, as at a mouth, are rounded off in the same way within two spacings.
///
/// Coefficients have single precision, which moves the wall by less than 1e-9 m and the second derivative by less than 0.1 1/m.
///
/// ```
/// use mcm::vessel::DistanceGrid;
/// use nalgebra::Vector3;
/// let box_around = [Vector3::repeat(-0.01), Vector3::repeat(0.01)];
/// let ball = DistanceGrid::new(box_around, 1e-3, |point| 0.01 - point.norm())?;
/// let clearance = ball.clearance(&Vector3::new(0.0, 0.0, 8e-3));
/// assert!((clearance.value - 2e-3).abs() < 1e-6);
/// assert!((clearance.gradient + Vector3::z()).norm() < 1e-3);
/// assert_eq!(DistanceGrid::from_bytes(&ball.to_bytes()?)?, ball);
/// let refused = DistanceGrid::new(box_around, 0.1, |point| 0.01 - point.norm()).unwrap_err();
/// assert!(refused.to_string().starts_with("spacing (m) of the distance grid = 0.1 is not allowed: it must be between"));
/// # Ok::<(), mcm::error::Error>(())
/// ```
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct DistanceGrid {
    /// First node, m.
    origin: Vector3<f64>,
    /// Distance of fine nodes, m.
    spacing: f64,
    /// Clearance, m, over coordinates in units of the spacing.
    field: Refinement,
}

impl DistanceGrid {
    /// Of a clearance (m, positive inside), sampled `spacing` (m) apart. The box, lowest and highest coordinates (m), is one
    /// around the vessel.
    ///
    /// # Errors
    /// [`Error::Range`] for a box that is empty or not finite; for a spacing above an eighth of its shortest side, or so small
    /// that there would be more than [`MOST_NODES`](crate::numerics::tricubic::MOST_NODES) nodes; and where samples are not
    /// finite or differ by more than their distance, as no distance from a wall does. [`Error::Unsupported`] for a vessel that
    /// reaches beyond the box.
    pub fn new(
        bounds: [Vector3<f64>; 2],
        spacing: f64,
        clearance: impl Fn(&Vector3<f64>) -> f64 + Sync,
    ) -> Result<Self, Error> {
        let nodes = Nodes::new(bounds, spacing)?;
        Ok(Self { origin: nodes.origin, spacing, field: nodes.sample(&clearance)? })
    }

    /// Spacing of the fine nodes, m.
    #[must_use]
    pub fn spacing(&self) -> f64 {
        self.spacing
    }

    /// First node, m: node `(i, j, k)` lies `i`, `j` and `k` spacings from there.
    #[must_use]
    pub fn origin(&self) -> Vector3<f64> {
        self.origin
    }

    /// Lowest and highest coordinates (m) between which the vessel lies; a side may be longer by four spacings.
    #[must_use]
    pub fn bounds(&self) -> [Vector3<f64>; 2] {
        let cells = self.field.coarse().counts().map(|count| (count - 1) as f64 - AROUND);
        [[AROUND; 3], cells].map(|at| self.origin + Vector3::from(at) * (RATIO as f64 * self.spacing))
    }

    /// A number that differs for other grids, but for one in four thousand million of them (CRC-32).
    #[must_use]
    pub fn checksum(&self) -> u32 {
        let mut sum = crc32fast::Hasher::new();
        self.origin.iter().chain([&self.spacing]).for_each(|number| sum.update(&number.to_le_bytes()));
        sum.update(&self.field.checksum().to_le_bytes());
        sum.finalize()
    }

    /// Number of coefficients, of 4 bytes each.
    #[must_use]
    pub fn coefficients(&self) -> usize {
        self.field.coefficients()
    }

    /// Distance from `point` (m) to the wall, with the exact derivatives of the interpolation.
    #[must_use]
    pub fn clearance(&self, point: &Vector3<f64>) -> Clearance {
        let place = (point - self.origin) / self.spacing;
        let scale = 1.0 / self.spacing;
        let ends = self.field.coarse().counts().map(|count| ((count - 1) * RATIO) as f64 - BORDER);

        if (0..3).all(|axis| place[axis] >= BORDER && place[axis] <= ends[axis]) {
            let SpacePoint { value, gradient, hessian } = self.field.at(&place);
            return Clearance { value, gradient: gradient * scale, hessian: hessian * (scale * scale) };
        }

        // Near the border and beyond: the value at a point bent inwards, plus the loss by the distance from
        // there.
        let mut bent = place;
        let (mut first, mut second) = (Vector3::repeat(1.0), Vector3::zeros());
        for axis in 0..3 {
            (bent[axis], first[axis], second[axis]) = bend(place[axis], ends[axis]);
        }

        let (inner, outer) = (self.field.at(&bent), self.outside(&(place - bent)));
        let (stays, goes) = (Matrix3::from_diagonal(&first), Matrix3::from_diagonal(&first.map(|v| 1.0 - v)));

        // Second derivatives by the chain rule: the bend's own curvature acts on the gradients' difference.
        let turn = second.component_mul(&(inner.gradient - outer.gradient));

        Clearance {
            value: inner.value + outer.value,
            gradient: (stays * inner.gradient + goes * outer.gradient) * scale,
            hessian: (stays * inner.hessian * stays
                + goes * outer.hessian * goes
                + Matrix3::from_diagonal(&turn))
                * (scale * scale),
        }
    }

    /// What is added for a distance from the grid, m over units of the spacing: `s - sqrt(|e|^2 + s^2)`.
    fn outside(&self, offset: &Vector3<f64>) -> SpacePoint {
        let root = offset.iter().fold(SMOOTH, |root, part| root.hypot(*part));
        let unit = offset / root;
        SpacePoint {
            value: (SMOOTH - root) * self.spacing,
            gradient: unit * -self.spacing,
            hessian: (unit * unit.transpose() - Matrix3::identity()) * (self.spacing / root),
        }
    }

    /// As bytes, with version and checksum.
    ///
    /// # Errors
    /// [`Error::Syntax`] where memory does not suffice.
    pub fn to_bytes(&self) -> Result<Vec<u8>, Error> {
        let mut bytes = postcard::to_stdvec(&(VERSION, self)).map_err(|error| refused(error.to_string()))?;
        bytes.extend(crc32fast::hash(&bytes).to_le_bytes());
        Ok(bytes)
    }

    /// From [`DistanceGrid::to_bytes`].
    ///
    /// # Errors
    /// [`Error::Syntax`] for other or damaged bytes.
    pub fn from_bytes(bytes: &[u8]) -> Result<Self, Error> {
        let (body, sum) = bytes.split_last_chunk::<4>().ok_or_else(|| refused("it is too short".into()))?;
        if crc32fast::hash(body) != u32::from_le_bytes(*sum) {
            return Err(refused("its checksum does not match: it is damaged or no such grid".into()));
        }
        let unreadable = |error: postcard::Error| refused(error.to_string());
        let (version, rest) = postcard::take_from_bytes::<u32>(body).map_err(unreadable)?;
        if version != VERSION {
            return Err(refused(format!("it has version {version}, expected {VERSION}")));
        }
        let grid: Self = postcard::from_bytes(rest).map_err(unreadable)?;
        for value in &grid.origin {
            check("origin (m) of the distance grid", *value, |_| true, "finite")?;
        }
        check("spacing (m) of the distance grid", grid.spacing, |v| v > 0.0, "> 0")?;
        Ok(grid)
    }
}

/// A coordinate, bent so that it stays within the grid, with its derivatives. The first one falls from 1 to 0 over [`SMOOTH`]
/// as `1 - 3 t^2 + 2 t^3`.
fn bend(place: f64, end: f64) -> (f64, f64, f64) {
    let (edge, side) = if place < BORDER {
        (BORDER, -1.0)
    } else if place > end {
        (end, 1.0)
    } else {
        return (place, 1.0, 0.0);
    };
    let t = (side * (place - edge) / SMOOTH).min(1.0);
    let moved = t - t * t * t * (1.0 - 0.5 * t);
    (edge + side * SMOOTH * moved, 1.0 - t * t * (3.0 - 2.0 * t), side * 6.0 * t * (t - 1.0) / SMOOTH)
}

fn refused(reason: String) -> Error {
    Error::Syntax { what: "distance grid of a vessel".into(), reason }
}
