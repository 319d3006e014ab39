//! The plane onto which a solved scene is drawn: that of the device's bend, or one that was asked for.

use mcm::nalgebra::{Matrix3, Vector3};
use mcm::vessel::Lumen;

/// Cosine above which a direction counts as that of an axis of the world.
const ALONG: f64 = 0.99;

/// Length of a base's axis in the plane above which it points to the right.
const SEEN: f64 = 0.5;

/// Spread of a device across its length, in parts of that along it, from which its own bend decides, whatever is around it. An arc of an
/// angle a, in rad, has 0.13 a: this is one of a degree.
const BENT: f64 = 0.0022;

/// Weight of a point beside the device, which decides for a straight one, and of the axes for the case that nothing decides.
const BESIDE: f64 = 1e-3;
const UNDECIDED: [f64; 3] = [0.0, 2e-6, 4e-6];

/// Distance from the device up to which the vessel counts, m, and number of places along each axis at which it is looked at.
const AROUND: f64 = 0.03;
const PLACES: usize = 24;

/// A plane of two axes of the world.
#[derive(Debug, Clone, Copy, PartialEq, Eq, clap::ValueEnum)]
pub(crate) enum Plane {
    #[value(name = "x-z")]
    Xz,
    #[value(name = "y-z")]
    Yz,
    #[value(name = "x-y")]
    Xy,
}

impl Plane {
    fn normal(self) -> Vector3<f64> {
        match self {
            Self::Xz => Vector3::y(),
            Self::Yz => Vector3::x(),
            Self::Xy => Vector3::z(),
        }
    }
}

/// A plane with two directions in it, and the one towards the viewer.
pub(super) struct View {
    right: Vector3<f64>,
    up: Vector3<f64>,
    pub(super) towards: Vector3<f64>,
}

impl View {
    /// The plane asked for, or that in which a device with these centreline points bends. Where it is straight, the vessel around it
    /// decides, or else a place `beside` it. The device's base points along `base`, which is drawn to the right.
    pub(super) fn of(
        plane: Option<Plane>,
        shape: &[Vector3<f64>],
        lumen: Option<&Lumen>,
        beside: Option<Vector3<f64>>,
        base: &Vector3<f64>,
    ) -> Self {
        let normal = plane.map_or_else(|| normal(shape, lumen, beside), Plane::normal);
        let in_plane = |direction: &Vector3<f64>| direction - normal * normal.dot(direction);
        let mut candidates = [*base, Vector3::z(), Vector3::x()].into_iter().map(|axis| in_plane(&axis));
        let right = candidates.find(|axis| axis.norm() > SEEN).unwrap_or_else(|| in_plane(&Vector3::y()));
        let right = right.normalize();
        // An axis of the world near the base's one, unless it would leave the plane asked for.
        let right = Some(aligned(right)).filter(|near| normal.dot(near).abs() < 1e-12).unwrap_or(right);
        let up = normal.cross(&right);
        let up = aligned(if up[up.iamax()] < 0.0 { -up } else { up });
        Self { right, up, towards: right.cross(&up) }
    }

    /// Coordinates of a point (m) in the plane, mm.
    pub(super) fn at(&self, point: &Vector3<f64>) -> (f64, f64) {
        (1e3 * self.right.dot(point), 1e3 * self.up.dot(point))
    }

    /// The point (m) with these coordinates (mm), `depth` (m) before the plane through the origin.
    pub(super) fn point(&self, (x, y): (f64, f64), depth: f64) -> Vector3<f64> {
        self.right * (1e-3 * x) + self.up * (1e-3 * y) + self.towards * depth
    }

    /// Labels of the axes.
    pub(super) fn labels(&self) -> [String; 2] {
        [self.right, self.up].map(|direction| {
            let axis = direction.iamax();
            if direction[axis] > 1.0 - f64::EPSILON {
                return format!("{} (mm)", ["x", "y", "z"][axis]);
            }
            let [x, y, z] =
                <[f64; 3]>::from(direction).map(|part| format!("{part:.2}").replace("-0.00", "0.00"));
            format!("along ({x}, {y}, {z}) (mm)")
        })
    }
}

/// The direction from which a device is seen to bend most.
fn normal(shape: &[Vector3<f64>], lumen: Option<&Lumen>, beside: Option<Vector3<f64>>) -> Vector3<f64> {
    let own = mean_square(shape);
    let mut spread = Matrix3::from_diagonal(&Vector3::from(UNDECIDED)) * own.trace() + own;
    let mut sizes: [f64; 3] = own.symmetric_eigenvalues().into();
    sizes.sort_by(f64::total_cmp);
    if sizes[1] < BENT * BENT * sizes[2] {
        spread += mean_square(&lumen.map_or_else(Vec::new, |lumen| inside(lumen, shape)));
        if let Some(beside) = beside.filter(|_| lumen.is_none()) {
            let middle = shape.iter().sum::<Vector3<f64>>() / shape.len() as f64;
            let offset = beside - middle;
            spread += offset * offset.transpose() * BESIDE;
        }
    }
    let eigen = spread.symmetric_eigen();
    aligned(eigen.eigenvectors.column(eigen.eigenvalues.imin()).into_owned())
}

/// The axis of the world that this direction nearly is, or the direction itself.
fn aligned(direction: Vector3<f64>) -> Vector3<f64> {
    let axis = direction.iamax();
    if direction[axis].abs() < ALONG { direction } else { Vector3::ith(axis, direction[axis].signum()) }
}

/// Mean of the squares of the distances from the mean, m2.
fn mean_square(points: &[Vector3<f64>]) -> Matrix3<f64> {
    let count = points.len().max(1) as f64;
    let mean = points.iter().sum::<Vector3<f64>>() / count;
    points.iter().map(|point| (point - mean) * (point - mean).transpose()).sum::<Matrix3<f64>>() / count
}

/// Places in the lumen around the device.
fn inside(lumen: &Lumen, shape: &[Vector3<f64>]) -> Vec<Vector3<f64>> {
    let bound = |choose: fn(&Vector3<f64>, &Vector3<f64>) -> Vector3<f64>, air: f64| {
        shape.iter().copied().reduce(|a, b| choose(&a, &b)).unwrap_or_default().add_scalar(air)
    };
    let (low, high) = (bound(Vector3::inf, -AROUND), bound(Vector3::sup, AROUND));
    let place = |number: usize| {
        let digits = [number % PLACES, number / PLACES % PLACES, number / (PLACES * PLACES)];
        let share = Vector3::from(digits.map(|digit| (digit as f64 + 0.5) / PLACES as f64));
        low + (high - low).component_mul(&share)
    };
    (0..PLACES.pow(3)).map(place).filter(|place| lumen.clearance(place).value > 0.0).collect()
}
