//! What the benches of the field share: points, and the same ring and pair in the crate magba, which gives the field alone.

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

/// Points 2.1 to 6 radii from the centre, all around: outside the magnet, inside six extents.
#[allow(dead_code, reason = "each program of this folder uses its own part")]
pub(crate) fn points(radius: f64) -> Vec<Vector3<f64>> {
    (0..64)
        .map(|i| {
            let i = f64::from(i);
            let (distance, polar, azimuth) = (radius * (2.1 + i * 3.9 / 63.0), 0.1 + i * 0.0465, i * 2.4);
            let rho = distance * polar.sin();
            Vector3::new(rho * azimuth.cos(), rho * azimuth.sin(), distance * polar.cos())
        })
        .collect()
}
