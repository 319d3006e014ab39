//! The wall as a mesh: distances against closed forms and independent formulas, and what is no wall.

use std::f64::consts::{PI, TAU};

use mcm::vessel::{Branch, Mesh};
use nalgebra::Vector3;
use rand::rngs::StdRng;
use rand::{RngExt, SeedableRng};

use super::tube::{Corners, arc, cuboid, straight, tube};
use crate::tolerance::{CLEARANCE, MESH_DISTANCE};

const BOX: Vector3<f64> = Vector3::new(0.01, 0.02, 0.03);

/// Random points in a box half as large again as that around these triangles.
fn points_around(mesh: &Mesh, number: u64, count: usize) -> Vec<Vector3<f64>> {
    let mut random = StdRng::seed_from_u64(number);
    let [lower, upper] = mesh.bounds();
    let mut share = || random.random_range(-0.25..1.25_f64);
    let mut any = |_| lower + (upper - lower).component_mul(&Vector3::new(share(), share(), share()));
    (0..count).map(&mut any).collect()
}

/// Distance from a triangle, by its plane or else its three edges.
fn from_triangle(corners: &Corners, point: &Vector3<f64>) -> f64 {
    let edges = [0, 1, 2].map(|i| (corners[i], corners[(i + 1) % 3] - corners[i]));
    let normal = edges[0].1.cross(&edges[1].1);
    if edges.iter().all(|(start, edge)| normal.cross(edge).dot(&(point - start)) >= 0.0) {
        return (point - corners[0]).dot(&normal).abs() / normal.norm();
    }
    let from_edge = edges.map(|(start, edge)| {
        let t = (point - start).dot(&edge) / edge.norm_squared();
        (point - start - edge * t.clamp(0.0, 1.0)).norm()
    });
    from_edge.into_iter().fold(f64::INFINITY, f64::min)
}

/// How often a surface winds around a point, by its solid angles (A. van Oosterom, J. Strackee, doi 10.1109/TBME.1983.325207).
fn winding_number(triangles: &[Corners], point: &Vector3<f64>) -> f64 {
    let angles = triangles.iter().map(|corners| {
        let [a, b, c] = corners.map(|corner| corner - point);
        let [x, y, z] = [a.norm(), b.norm(), c.norm()];
        2.0 * (a.cross(&b).dot(&c)).atan2(x * y * z + a.dot(&b) * z + b.dot(&c) * x + c.dot(&a) * y)
    });
    angles.sum::<f64>() / (4.0 * PI)
}

#[test]
fn distances_from_a_box_are_those_of_geometry() {
    let mesh = Mesh::new(&cuboid(BOX)).unwrap();
    assert!((mesh.volume() - 6e-6).abs() < 1e-20 && (mesh.area() - 2.2e-3).abs() < 1e-17);
    for point in points_around(&mesh, 1, 2000) {
        let beyond = (point - BOX / 2.0).abs() - BOX / 2.0;
        let outside = beyond.sup(&Vector3::zeros()).norm();
        let exact = if outside > 0.0 { -outside } else { -beyond.max() };
        let told = mesh.distance(&point);
        assert!((told - exact).abs() < CLEARANCE, "{point:?}: {told:e}, expected {exact:e}");
    }
    // In front of corners, edges and faces, and on them.
    for (point, exact) in [
        ([-3e-3, -4e-3, -12e-3], -13e-3),
        ([13e-3, 24e-3, 15e-3], -5e-3),
        ([5e-3, 1e-3, 15e-3], 1e-3),
        ([0.0; 3], 0.0),
        ([10e-3, 5e-3, 7e-3], 0.0),
    ] {
        let told = mesh.distance(&point.into());
        assert!((told - exact).abs() < CLEARANCE, "{point:?}: {told:e}, expected {exact:e}");
    }
}

#[test]
fn distances_are_those_of_a_search_over_all_triangles_and_sides_those_of_the_winding_number() {
    // A bent tube whose radius changes along and around, with edges that turn in and out.
    let bent = arc(0.03, 2.5, 6e-3);
    let rough = |t: f64| {
        let (centre, across, radius) = bent(t);
        (centre, across, radius * (1.0 + 0.3 * (23.0 * t).sin()))
    };
    let triangles = tube(rough, 40, 9);
    let mesh = Mesh::new(&triangles).unwrap();
    let mut inside = 0;
    for point in points_around(&mesh, 2, 3000) {
        let all = triangles.iter().map(|corners| from_triangle(corners, &point));
        let exact = all.fold(f64::INFINITY, f64::min);
        let told = mesh.distance(&point);
        assert!((told.abs() - exact).abs() < MESH_DISTANCE, "{point:?}: {told:e}, by search {exact:e}");
        let winds = winding_number(&triangles, &point);
        assert_eq!(told > 0.0, winds.abs() > 0.5, "{point:?}: {told:e}, winding number {winds}");
        inside += usize::from(told > 0.0);
    }
    assert!(inside > 200, "only {inside} points inside");
}

#[test]
fn facets_lie_inside_of_a_round_wall_by_their_length_squared_over_8_radii() {
    let branch_of = |radius: f64| {
        let place = |i: i32| {
            let turn = 2.0 * f64::from(i) / 60.0;
            Vector3::new(0.06 * (1.0 - turn.cos()), 0.0, 0.06 * turn.sin())
        };
        let centres: Vec<_> = (0..=60).map(place).collect();
        Branch::new("arc", &centres, &vec![radius; centres.len()]).unwrap()
    };
    let (bend, turn, radius) = (0.06, 2.0, 4e-3);
    let branch = branch_of(radius);
    for around in [24, 48, 96] {
        let mesh = Mesh::new(&tube(arc(bend, turn, radius), around * 4, around)).unwrap();
        let facet = TAU * radius / f64::from(around);
        let mut worst: f64 = 0.0;
        for point in super::points_near(&branch, 3, 4000) {
            let exact = branch.clearance(&point).value;
            // Not beside the ends, which are flat here and half balls there, nor in the middle.
            let t = (point.z).atan2(bend - point.x) / turn;
            if (0.1..0.9).contains(&t) && exact < 0.7 * radius {
                worst = worst.max((mesh.distance(&point) - exact).abs());
            }
        }
        let ratio = worst / (facet * facet / (8.0 * radius));
        println!(
            "{} triangles, facets of {facet:.1e} m: {worst:.1e} m, {ratio:.2} of the sagitta",
            mesh.triangles()
        );
        assert!((0.7..1.3).contains(&ratio), "{around} around: {worst:e}");
    }
}

#[test]
fn orientation_and_order_of_triangles_do_not_matter() {
    let triangles = tube(arc(0.03, 2.0, 4e-3), 20, 8);
    let mesh = Mesh::new(&triangles).unwrap();
    let mut random = StdRng::seed_from_u64(4);
    let mut mixed: Vec<Corners> = triangles.clone();
    for corners in &mut mixed {
        if random.random_range(0..2) == 0 {
            corners.swap(0, 2);
        }
    }
    for changed in [triangles.iter().map(|[a, b, c]| [*c, *b, *a]).collect(), mixed] {
        let other = Mesh::new(&changed).unwrap();
        assert!((other.volume() - mesh.volume()).abs() < 1e-12 * mesh.volume());
        for point in points_around(&mesh, 5, 300) {
            assert!((other.distance(&point) - mesh.distance(&point)).abs() < MESH_DISTANCE);
        }
    }
}

#[test]
fn a_triangle_without_area_is_left_out_where_the_rest_is_closed() {
    let mut triangles = cuboid(BOX);
    let [a, b, _] = triangles[0];
    triangles.push([a, b, a]);
    assert_eq!(Mesh::new(&triangles).unwrap().triangles(), 12);
    // The same edge with a point in the middle on one side only: closed with a flat triangle, open without it.
    let middle = (a + b) / 2.0;
    let c = triangles[0][2];
    triangles.splice(0..1, [[a, middle, c], [middle, b, c], [a, b, middle]]);
    let refused = Mesh::new(&triangles).unwrap_err().to_string();
    let expected = "number of open edges of the vessel's mesh (leaving out 2 without area, first triangle 3)";
    assert!(refused.starts_with(expected), "{refused}");
    assert!(refused.ends_with("= 3 is not allowed: it must be 0, as it is of a closed surface"), "{refused}");
}

#[test]
fn the_narrowest_radius_is_found() {
    for (narrow, share) in [(4e-3, 1.0), (2e-3, 0.5), (1.5e-3, 0.2)] {
        // 4 mm wide but for a share of its length.
        let frame = |t: f64| {
            let (centre, across, wide) = straight(0.2, 4e-3)(t);
            let bump = (1.0 - ((t - 0.5) / (0.5 * share)).powi(2)).clamp(0.0, 0.25) / 0.25;
            (centre, across, wide + (narrow - wide) * bump)
        };
        let mesh = Mesh::new(&tube(frame, 400, 60)).unwrap();
        let told = mesh.narrowest_radius();
        assert!((told / narrow - 1.0).abs() < 0.1, "{told:e}, expected {narrow:e}");
    }
}

#[test]
fn what_is_no_wall_is_refused_with_its_place() {
    let whole = cuboid(BOX);
    let with = |change: &dyn Fn(&mut Vec<Corners>)| {
        let mut triangles = whole.clone();
        change(&mut triangles);
        triangles
    };
    let shifted = |by: Vector3<f64>| whole.iter().map(move |corners| corners.map(|corner| corner + by));
    // Six points, of which every two are joined by an edge: a closed surface with one side.
    let six = [[0, 0, 0], [9, 0, 1], [2, 8, 0], [1, 2, 7], [8, 7, 6], [4, 1, 9]];
    let faces = ["123", "134", "145", "156", "162", "235", "346", "452", "563", "624"];
    let corner = |digit: u8| Vector3::from(six[usize::from(digit - b'1')].map(f64::from)) * 1e-3;
    let one_sided = faces.map(|face| [0, 1, 2].map(|i| corner(face.as_bytes()[i])));
    for (triangles, expected) in [
        (Vec::new(), "list of triangles of the vessel's mesh has 0 entries"),
        (with(&|t| t[4][1].y = f64::NAN), "coordinate (m) of triangle 5 of the vessel's mesh = NaN"),
        (with(&|t| t[11][0].x = -f64::INFINITY), "coordinate (m) of triangle 12 of the vessel's mesh = -inf"),
        (with(&|t| t[0][2].z = 30.0), "= 30 is not allowed: it must be between -10 and 10"),
        (
            vec![[Vector3::zeros(); 3]],
            "with an area of the vessel's mesh (leaving out 1 without area, first triangle 1)",
        ),
        (
            with(&|t| t.retain(|corners| *corners != whole[2])),
            "number of open edges of the vessel's mesh, the first from (0.000, 0.000, 30.000) mm to",
        ),
        (
            with(&|t| *t = t.split_off(2)),
            "mm, = 4 is not allowed: it must be 0, as it is of a closed surface",
        ),
        (
            with(&|t| t.push(t[0])),
            "number of edges shared by more than two triangles of the vessel's mesh, the first from",
        ),
        (
            with(&|t| t.extend(shifted(Vector3::repeat(0.05)))),
            "do not hang together with the first one, one at (50.000, ",
        ),
        (with(&|t| t.extend(shifted(BOX))), "do not hang together"),
        (with(&|t| t.truncate(1)), "= 3 is not allowed"),
        (vec![whole[0], whole[0]], "volume (m3) enclosed by the vessel's mesh = 0"),
        (one_sided.to_vec(), "the vessel's mesh has no inside: it is a one-sided surface, seen at ("),
        (pinched(), "the vessel's mesh touches itself in a single point at (0.000, 0.000, 5.000) mm"),
    ] {
        let refused = Mesh::new(&triangles).unwrap_err().to_string();
        assert!(refused.contains(expected), "{refused}\nexpected {expected}");
    }
}

/// A ring around the z axis whose hole is closed to a point: a tube of square section that touches the axis with one corner.
fn pinched() -> Vec<Corners> {
    let section = |turn: f64| {
        let out = Vector3::new(turn.cos(), turn.sin(), 0.0) * 1e-3;
        let up = Vector3::z() * 1e-3;
        [up * 5.0, out * 5.0, out * 8.0 + up * 5.0, out * 5.0 + up * 9.0]
    };
    let mut out = Vec::new();
    for i in 0..8 {
        let [a, b] = [i, (i + 1) % 8].map(|i| section(TAU * f64::from(i) / 8.0));
        for j in 0..4 {
            let k = (j + 1) % 4;
            out.extend([[a[j], a[k], b[k]], [a[j], b[k], b[j]]]);
        }
    }
    out
}

#[test]
fn a_wall_that_crosses_itself_is_noticed_when_it_is_sampled() {
    let mesh = Mesh::new(&tube(arc(0.02, 1.1 * TAU, 4e-3), 100, 16)).unwrap();
    let refused = mesh.distance_grid(Some(5e-4)).unwrap_err().to_string();
    assert!(refused.starts_with("change of the clearance per length at ("), "{refused}");
    assert!(refused.ends_with("it must be between -1 and 1, or the wall crosses itself there"), "{refused}");
}
