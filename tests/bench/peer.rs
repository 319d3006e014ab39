//! The same ring and pair in the crate magba, which gives the field alone.

use magba::fields::cylinder_B;
use nalgebra::Vector3;

const REMANENCE: f64 = 1.35;

/// A cylinder of the given radius and length at the origin.
pub(crate) fn cylinder(point: &Vector3<f64>, radius: f64, length: f64) -> [f64; 3] {
    let at = [point.x, point.y, point.z].into();
    #[allow(
        clippy::default_trait_access,
        reason = "the unit quaternion of the peer's own version of nalgebra"
    )]
    let unturned = Default::default();
    let polarization = [0.0, 0.0, REMANENCE].into();
    cylinder_B(at, [0.0; 3].into(), unturned, polarization, 2.0 * radius, length).into()
}

/// The reference ring: an outer minus an inner cylinder.
pub(crate) fn ring(point: &Vector3<f64>) -> [f64; 3] {
    let (outer, inner) = (cylinder(point, 2.0e-3, 1.0e-3), cylinder(point, 0.75e-3, 1.0e-3));
    core::array::from_fn(|i| outer[i] - inner[i])
}

/// The reference pair of cylinders.
#[allow(dead_code, reason = "each program of this folder uses its own part")]
pub(crate) fn pair(point: &Vector3<f64>) -> [f64; 3] {
    let [below, above] =
        [-20.0e-3, 20.0e-3].map(|z| cylinder(&(point - Vector3::new(0.0, 0.0, z)), 22.5e-3, 30.0e-3));
    core::array::from_fn(|i| below[i] + above[i])
}
