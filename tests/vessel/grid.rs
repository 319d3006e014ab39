//! Distance on a grid: its derivatives, its error and order, and far outside.

use std::f64::consts::TAU;
use std::time::Instant;

use allocation_counter::measure;
use mcm::vessel::{Branch, DistanceGrid, Lumen, Mesh};
use nalgebra::{Matrix3, Vector3};
use rand::rngs::StdRng;
use rand::{RngExt, SeedableRng};

use super::tube::{arc, straight, tube};
use super::{STEP, errors_of_derivatives, points_near, winding};
use crate::tolerance::{CLEARANCE_SLOPE, GRID_ACROSS_LEVELS, GRID_OUTSIDE};

/// Box around a branch, m.
fn box_around(branch: &Branch) -> [Vector3<f64>; 2] {
    let balls = (0..=100).map(|i| branch.ball(branch.range().end() * f64::from(i) / 100.0));
    let far = Vector3::repeat(f64::INFINITY);
    balls.fold([far, -far], |[lower, upper], (centre, radius)| {
        [lower.inf(&centre.add_scalar(-radius)), upper.sup(&centre.add_scalar(radius))]
    })
}

fn sampled(branch: &Branch, spacing: f64) -> DistanceGrid {
    DistanceGrid::new(box_around(branch), spacing, |point| branch.clearance(point).value).unwrap()
}

/// Within a cell the interpolation is a cubic along each axis, of which differences of fourth order are exact.
#[test]
fn derivatives_are_those_of_differences() {
    let mut random = StdRng::seed_from_u64(1);
    let (mut slopes, mut curves) = (0.0_f64, 0.0_f64);
    for number in 0..5 {
        let branch = winding(number);
        let grid = sampled(&branch, 4e-4);
        for point in points_near(&branch, number, 200) {
            let mut inner = || random.random_range(0.1..0.9_f64);
            let cell = (point - grid.origin()) / grid.spacing();
            let place = grid.origin() + cell.map(|v| v.floor() + inner()) * grid.spacing();
            let [slope, curve] = errors_of_derivatives(|x| grid.clearance(x), &place, 0.04 * grid.spacing());
            (slopes, curves) = (slopes.max(slope), curves.max(curve));
        }
    }
    println!("gradients to {slopes:.1e}, second derivatives to {curves:.1e}");
    assert!(slopes < CLEARANCE_SLOPE && curves < CLEARANCE_SLOPE, "{slopes:e}, {curves:e}");
}

/// Errors of value (in radii), gradient and second derivative (relative) in a straight tube, down to this depth in radii.
fn errors_in_a_tube(grid: &DistanceGrid, tube: &Branch, radius: f64, depths: [f64; 2]) -> [f64; 3] {
    let mut random = StdRng::seed_from_u64(2);
    let length = *tube.range().end();
    let mut worst = [0.0_f64; 3];
    for _ in 0..4000 {
        let (along, turn) = (random.random_range(0.3..0.7) * length, random.random_range(0.0..TAU));
        let depth = random.random_range(depths[0]..depths[1]) * radius;
        let outwards = Vector3::new(turn.cos(), turn.sin(), 0.0);
        let point = tube.ball(along).0 + frame(tube) * outwards * (radius - depth);
        let (told, exact) = (grid.clearance(&point), tube.clearance(&point));
        let errors = [
            (told.value - exact.value).abs() / radius,
            (told.gradient - exact.gradient).norm(),
            (told.hessian - exact.hessian).norm() / exact.hessian.norm(),
        ];
        worst = core::array::from_fn(|i| worst[i].max(errors[i]));
    }
    worst
}

/// Columns: two directions across a straight branch, and along it.
fn frame(branch: &Branch) -> Matrix3<f64> {
    let along = (branch.ball(*branch.range().end()).0 - branch.ball(0.0).0).normalize();
    let across = along.cross(&Vector3::x()).normalize();
    Matrix3::from_columns(&[across, along.cross(&across), along])
}

/// The table in the documentation of [`DistanceGrid`].
#[test]
fn the_error_in_a_tube_is_the_documented_one_and_of_fourth_order() {
    const R: f64 = 3e-3;
    let skew = Branch::new("skew", &[Vector3::zeros(), Vector3::new(14e-3, 9e-3, 46e-3)], &[R; 2]).unwrap();
    let errors = |cells: f64, depths| errors_in_a_tube(&sampled(&skew, R / cells), &skew, R, depths);
    for (cells, near, deep) in [
        (4.0, [8e-4, 0.007, 0.1], [3e-3, 0.03, 0.3]),
        (6.0, [4e-5, 0.001, 0.02], [3e-4, 0.007, 0.07]),
        (8.0, [4e-6, 1.3e-4, 0.005], [4e-5, 0.0013, 0.02]),
        (16.0, [2.5e-7, 1e-5, 0.001], [7e-7, 3e-5, 0.003]),
    ] {
        for (depths, documented) in [([0.0, 0.15], near), ([0.15, 0.4], deep)] {
            let measured = errors(cells, depths);
            println!("R/h = {cells}, depths of {depths:?} R: {measured:?}");
            for (measured, documented) in measured.iter().zip(documented) {
                let ratio = measured / documented;
                assert!(ratio < 1.3 && ratio > 0.5, "R/h = {cells}: {measured:e}, said {documented:e}");
            }
        }
    }
    let [coarse, fine] = [10.0, 20.0].map(|cells| errors(cells, [0.0, 0.15]));
    let orders: [f64; 3] = core::array::from_fn(|i| (coarse[i] / fine[i]).log2());
    println!("orders of value, gradient and second derivative: {orders:.2?}");
    assert!(orders[0] > 3.5 && orders[1] > 2.7 && orders[2] > 1.7, "{orders:?}");
}

#[test]
fn a_finely_meshed_tube_is_the_branch_near_its_wall() {
    let (bend, turn, radius) = (0.06, 1.0, 3e-3);
    let place = |i: i32| arc(bend, turn, radius)(f64::from(i) / 60.0).0;
    let centres: Vec<_> = (0..=60).map(place).collect();
    let branch = Branch::new("arc", &centres, &vec![radius; centres.len()]).unwrap();
    for (around, spacing) in [(48, 5e-4), (96, 5e-4), (96, 3.75e-4)] {
        let mesh = Mesh::new(&tube(arc(bend, turn, radius), 3 * around, around)).unwrap();
        let grid = mesh.distance_grid(Some(spacing)).unwrap();
        let facet = TAU * radius / f64::from(around);
        let (sagitta, bow) = (facet * facet / (8.0 * radius), facet / radius);
        let (mut values, mut slopes, mut count) = (0.0_f64, 0.0_f64, 0);
        for point in points_near(&branch, 6, 4000) {
            let exact = branch.clearance(&point);
            let t = point.z.atan2(bend - point.x) / turn;
            if (0.1..0.9).contains(&t) && exact.value.abs() < 0.15 * radius {
                let told = grid.clearance(&point);
                values = values.max((told.value - exact.value).abs());
                slopes = slopes.max((told.gradient - exact.gradient).norm());
                count += 1;
            }
        }
        let [sagittas, turns] = [values / sagitta, slopes / bow];
        println!("{count} points, facets {facet:.1e} m, spacing {spacing:.1e} m:");
        println!("    {values:.1e} m ({sagittas:.1} sagittas), gradients to {slopes:.1e} ({turns:.2} turns)");
        assert!(count > 300 && values < 1.3 * sagitta + 2e-7 && slopes < 0.5 * bow + 0.002);
    }
}

#[test]
fn outside_the_grid_the_clearance_falls_smoothly() {
    let branch = winding(2);
    let grid = sampled(&branch, 5e-4);
    let [lower, upper] = box_around(&branch);
    let centre = (lower + upper) / 2.0;
    let mut random = StdRng::seed_from_u64(3);
    let (mut slopes, mut curves) = (0.0_f64, 0.0_f64);
    for _ in 0..200 {
        let mut any = || random.random_range(-1.0..1.0_f64);
        let away = Vector3::new(any(), any(), any()).normalize();
        let start = (upper - lower).component_mul(&away.map(f64::abs)).norm() / 2.0;
        let mut last = grid.clearance(&(centre + away * (1.2 * start + 5e-3))).value;
        for steps in 1..60 {
            let point = centre + away * (1.2 * start + 5e-3 + 1e-3 * f64::from(steps));
            let told = grid.clearance(&point);
            assert!(told.value < last && told.value < 0.0, "{point:?}: {:e} after {last:e}", told.value);
            last = told.value;
            let [slope, curve] = errors_of_derivatives(|point| grid.clearance(point), &point, STEP);
            (slopes, curves) = (slopes.max(slope), curves.max(curve));
        }
    }
    println!("gradients to {slopes:.1e}, second derivatives to {curves:.1e}");
    assert!(slopes < GRID_OUTSIDE[0] && curves < GRID_OUTSIDE[1], "{slopes:e}, {curves:e}");
    for far in [1.0, 1e6, 1e100, 1e300] {
        let told = grid.clearance(&(Vector3::new(1.0, -2.0, 0.5) * far));
        let all = told.gradient.iter().chain(&told.hessian).chain([&told.value]);
        assert!(all.clone().all(|number| number.is_finite()) && told.value < -far, "{far:e}: {told:?}");
        assert!((told.gradient.norm() - 1.0).abs() < 0.01, "{}", told.gradient.norm());
    }
    assert!(grid.clearance(&Vector3::repeat(f64::NAN)).value.is_nan());
}

#[test]
fn where_fine_samples_end_nothing_jumps_but_by_rounding() {
    let branch = winding(4);
    let grid = sampled(&branch, 5e-4);
    let mut random = StdRng::seed_from_u64(5);
    let (mut worst, mut seen) = ([0.0_f64; 3], 0);
    for point in points_near(&branch, 4, 20_000) {
        // Both sides of a plane of nodes, up to 20 spacings behind the wall.
        let centre = branch.ball(random.random_range(0.0..*branch.range().end())).0;
        let place = centre + (point - centre) * random.random_range(0.5..2.0_f64);
        let mut cell = (place - grid.origin()) / grid.spacing();
        let axis = random.random_range(0..3);
        cell[axis] = cell[axis].round();
        let place = grid.origin() + cell * grid.spacing();
        let [a, b] = [-1e-12, 1e-12].map(|more| grid.clearance(&(place + Vector3::ith(axis, more))));
        let jumps =
            [(b.value - a.value).abs(), (b.gradient - a.gradient).norm(), (b.hessian - a.hessian).norm()];
        worst = core::array::from_fn(|i| worst[i].max(jumps[i]));
        seen += usize::from(jumps[1] > 1e-7);
    }
    println!("{worst:?}, {seen} changes of the grid");
    assert!(seen > 20, "only {seen} changes of the grid");
    assert!(worst.iter().zip(GRID_ACROSS_LEVELS).all(|(jump, most)| *jump < most), "{worst:?}");
}

#[test]
fn bytes_are_the_grid_and_damage_is_seen() {
    let grid = sampled(&winding(1), 8e-4);
    let bytes = grid.to_bytes().unwrap();
    assert!(bytes.len() < 5 * grid.coefficients(), "{} for {}", bytes.len(), grid.coefficients());
    assert_eq!(DistanceGrid::from_bytes(&bytes).unwrap(), grid);
    let changed = |place: usize| {
        let mut bytes = bytes.clone();
        bytes[place] ^= 4;
        bytes
    };
    let mut newer = bytes[..bytes.len() - 4].to_vec();
    newer[0] += 1;
    let mut short = bytes[..1000].to_vec();
    for body in [&mut newer, &mut short] {
        let sum = crc32fast::hash(body).to_le_bytes();
        body.extend(sum);
    }
    for (bytes, expected) in [
        (Vec::new(), "distance grid of a vessel: it is too short"),
        (bytes[..bytes.len() - 1].to_vec(), "its checksum does not match"),
        (changed(0), "its checksum does not match"),
        (changed(bytes.len() / 2), "its checksum does not match"),
        (newer, "it has version 2, expected 1"),
        (short, "distance grid of a vessel: "),
    ] {
        let refused = DistanceGrid::from_bytes(&bytes).unwrap_err().to_string();
        assert!(refused.contains(expected), "{refused}");
    }
}

#[test]
fn no_bytes_make_it_panic() {
    let bytes = sampled(&winding(1), 1.2e-3).to_bytes().unwrap();
    let mut random = StdRng::seed_from_u64(8);
    let mut read = 0;
    for number in 0..300 {
        let mut body = bytes[..bytes.len() - 4].to_vec();
        // The head holds origin, spacing and numbers of nodes.
        let reach = if number % 2 == 0 { 50 } else { body.len() };
        body[random.random_range(0..reach)] = random.random_range(0..=255);
        let sum = crc32fast::hash(&body).to_le_bytes();
        body.extend(sum);
        if let Ok(grid) = DistanceGrid::from_bytes(&body) {
            read += 1;
            for point in [[0.0; 3], [2e-3, -1e-3, 0.05], [-0.3, 7.0, 1e9]] {
                let _ = grid.clearance(&point.into());
            }
        }
    }
    assert!((20..300).contains(&read), "{read} were read");
}

#[test]
fn what_makes_no_grid_is_refused() {
    let ball = |point: &Vector3<f64>| 0.01 - point.norm();
    let around = [Vector3::repeat(-0.01), Vector3::repeat(0.01)];
    let of = |bounds, spacing| DistanceGrid::new(bounds, spacing, ball).unwrap_err().to_string();
    let [lower, upper] = around;
    for (refused, expected) in [
        (of(around, 0.0), "spacing (m) of the distance grid = 0 is not allowed: it must be between"),
        (of(around, f64::NAN), "spacing (m) of the distance grid = NaN"),
        (of(around, 1e-6), "spacing (m) of the distance grid = 0.000001"),
        (of(around, 3e-3), "between 6.99e-5 and 2.50e-3 for a vessel of this size"),
        (of([upper, lower], 1e-3), "side (m) of the box around a vessel = -0.02"),
        (of([lower, Vector3::repeat(f64::NAN)], 1e-3), "side (m) of the box around a vessel = NaN"),
        (
            of([lower, Vector3::new(90.0, 0.0, 0.0)], 1e-3),
            "longest side of the box around a vessel, in its shortest one,",
        ),
        (
            of([lower, Vector3::repeat(0.0)], 5e-4),
            "the vessel reaches beyond the box given for its distance grid, at (",
        ),
    ] {
        assert!(refused.contains(expected), "{refused}\nexpected {expected}");
    }
    for wrong in [|point: &Vector3<f64>| 2.0 * (0.01 - point.norm()), |_: &Vector3<f64>| f64::NAN] {
        let refused = DistanceGrid::new(around, 1e-3, wrong).unwrap_err().to_string();
        assert!(refused.contains("change of the clearance per length at ("), "{refused}");
    }
}

#[test]
fn a_lumen_of_a_mesh_is_that_of_its_grid() {
    let mesh = Mesh::new(&tube(straight(0.04, 4e-3), 60, 40)).unwrap();
    let (grid, lumen) = (mesh.distance_grid(None).unwrap(), Lumen::from_mesh(&mesh, None).unwrap());
    // Facets of 0.63 mm, between an eighth and a quarter of the radius.
    assert!((grid.spacing() - 6.3e-4).abs() < 0.4e-4, "{:e}", grid.spacing());
    assert!(mesh.deviation(&grid) < 0.3 * grid.spacing(), "{:e}", mesh.deviation(&grid));
    assert_eq!(lumen.grid(), Some(&grid));
    assert!(lumen.branches().is_empty());
    let point = Vector3::new(1e-3, -2e-3, 0.02);
    assert_eq!(lumen.clearance(&point), grid.clearance(&point));
    assert_eq!(lumen, Lumen::of_grid(grid));
    let refused = lumen.merged_over(1e-3).unwrap_err().to_string();
    assert_eq!(refused, "a vessel given by a mesh has no branches that could merge");
}

#[test]
fn a_look_up_allocates_nothing() {
    let grid = sampled(&winding(6), 6e-4);
    let points = [Vector3::new(0.0, 0.0, 0.05), Vector3::new(5.0, 0.0, 0.0), Vector3::new(0.0, 9e-3, 0.02)];
    let info = measure(|| assert!(points.iter().all(|point| grid.clearance(point).value.is_finite())));
    assert_eq!(info.count_total, 0);
}

/// A hundred thousand triangles take seconds: the time itself depends on the machine and is printed.
#[test]
fn a_hundred_thousand_triangles_take_seconds() {
    let start = Instant::now();
    let mesh = Mesh::new(&tube(arc(0.1, 2.0, 8e-3), 800, 64)).unwrap();
    let made = start.elapsed();
    let start = Instant::now();
    let grid = mesh.distance_grid(Some(1e-3)).unwrap();
    let sampled = start.elapsed();
    println!(
        "{} triangles: mesh {made:.2?}, {} coefficients {sampled:.2?}, {} bytes",
        mesh.triangles(),
        grid.coefficients(),
        grid.to_bytes().unwrap().len()
    );
    let start = Instant::now();
    let count = 100_000;
    let sum: f64 = (0..count)
        .map(|i| {
            let t = 0.1 + 0.8 * f64::from(i) / f64::from(count); // the ends are flat
            let (centre, [across, _], radius) = arc(0.1, 2.0, 8e-3)(t);
            grid.clearance(&(centre + across * (0.8 * radius))).value
        })
        .sum();
    println!("{:.0?} a look-up", start.elapsed() / count as u32);
    assert!((sum / f64::from(count) - 1.6e-3).abs() < 1e-5);
    assert!(sampled.as_secs() < 60);
}
