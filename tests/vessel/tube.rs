//! Tubes made of triangles.

use std::f64::consts::TAU;

use nalgebra::Vector3;

/// The corners of a triangle, m.
pub(crate) type Corners = [Vector3<f64>; 3];

/// A centre, two directions across, and a radius.
pub(crate) type Frame = (Vector3<f64>, [Vector3<f64>; 2], f64);

/// A tube with flat ends: rings of `around` points at `along + 1` places, from 0 to 1, of these frames.
pub(crate) fn tube(frame: impl Fn(f64) -> Frame, along: u32, around: u32) -> Vec<Corners> {
    let at = |i: u32, j: u32| {
        let (centre, [u, v], radius) = frame(f64::from(i) / f64::from(along));
        let (sin, cos) = (TAU * f64::from(j % around) / f64::from(around)).sin_cos();
        centre + (u * cos + v * sin) * radius
    };
    let mut out = Vec::new();
    for j in 0..around {
        for i in 0..along {
            let [a, b, c, d] = [at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j + 1)];
            out.extend([[a, b, c], [a, c, d]]);
        }
        out.push([frame(0.0).0, at(0, j), at(0, j + 1)]);
        out.push([frame(1.0).0, at(along, j + 1), at(along, j)]);
    }
    out
}

/// Along +z from the origin.
pub(crate) fn straight(length: f64, radius: f64) -> impl Fn(f64) -> Frame {
    move |t| (Vector3::z() * (t * length), [Vector3::x(), Vector3::y()], radius)
}

/// An arc of this radius in the x-z plane, from the origin along +z.
pub(crate) fn arc(bend: f64, turn: f64, radius: f64) -> impl Fn(f64) -> Frame {
    move |t| {
        let (sin, cos) = (t * turn).sin_cos();
        let centre = Vector3::new(bend * (1.0 - cos), 0.0, bend * sin);
        (centre, [Vector3::new(cos, 0.0, -sin), Vector3::y()], radius)
    }
}

/// A box from the origin with these sides (m).
pub(crate) fn cuboid(sides: Vector3<f64>) -> Vec<Corners> {
    let corner =
        |n: usize| Vector3::new((n & 1) as f64, (n >> 1 & 1) as f64, (n >> 2) as f64).component_mul(&sides);
    let faces = [[0, 2, 3, 1], [4, 5, 7, 6], [0, 1, 5, 4], [2, 6, 7, 3], [0, 4, 6, 2], [1, 3, 7, 5]];
    faces.iter().flat_map(|&[a, b, c, d]| [[a, b, c], [a, c, d]]).map(|three| three.map(corner)).collect()
}

/// Triangles moved by this much, m.
pub(crate) fn shifted(triangles: Vec<Corners>, by: Vector3<f64>) -> Vec<Corners> {
    triangles.into_iter().map(|corners| corners.map(|corner| corner + by)).collect()
}

/// Triangles (m) as a binary STL file in mm.
pub(crate) fn stl(triangles: &[Corners], header: &str) -> Vec<u8> {
    let mut out = format!("{header:80}").into_bytes();
    out.extend(u32::try_from(triangles.len()).unwrap().to_le_bytes());
    for corners in triangles {
        let numbers = [0.0; 3].into_iter().chain(corners.iter().flat_map(|corner| corner.iter().copied()));
        numbers.for_each(|number| out.extend(((1e3 * number) as f32).to_le_bytes()));
        out.extend([0, 0]);
    }
    out
}
