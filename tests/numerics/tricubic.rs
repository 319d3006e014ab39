//! Interpolation by cubic B-splines in space, on one grid and on two.

use mcm::numerics::refinement::{RATIO, Refinement};
use mcm::numerics::tricubic::{SpacePoint, Tricubic};
use nalgebra::{Matrix3, Vector3};
use rand::rngs::StdRng;
use rand::{RngExt, SeedableRng};

use crate::tolerance::SINGLE;

/// A smooth function with its derivatives; lengths in `scale`.
fn wave(point: &Vector3<f64>, scale: f64) -> SpacePoint {
    let k = Vector3::new(1.0, 0.7, -0.4) / scale;
    let (sin, cos) = k.dot(point).sin_cos();
    SpacePoint { value: sin, gradient: k * cos, hessian: k * k.transpose() * -sin }
}

fn place(node: usize, counts: [usize; 3]) -> Vector3<f64> {
    let [x, y, _] = counts;
    Vector3::new((node % x) as f64, (node / x % y) as f64, (node / (x * y)) as f64)
}

fn sampled(counts: [usize; 3], value: impl Fn(&Vector3<f64>) -> f64) -> Tricubic {
    let values = (0..counts.iter().product()).map(|node| value(&place(node, counts)));
    Tricubic::new(counts, values.collect()).unwrap()
}

fn difference(a: &SpacePoint, b: &SpacePoint) -> [f64; 3] {
    [(a.value - b.value).abs(), (a.gradient - b.gradient).norm(), (a.hessian - b.hessian).norm()]
}

#[test]
fn it_goes_through_any_values() {
    let counts = [7, 4, 9];
    let mut random = StdRng::seed_from_u64(1);
    let values: Vec<f64> = (0..counts.iter().product()).map(|_| random.random_range(-1.0..1.0_f64)).collect();
    let function = Tricubic::new(counts, values.clone()).unwrap();
    for (node, value) in values.iter().enumerate() {
        let point = place(node, counts);
        if (0..3).all(|axis| point[axis] >= 1.0 && point[axis] <= counts[axis] as f64 - 2.0) {
            assert!((function.at(&point).value - value).abs() < 10.0 * SINGLE, "{point:?}");
        }
    }
}

#[test]
fn errors_are_of_fourth_third_and_second_order() {
    let worst = |count: usize| {
        let scale = count as f64 / 4.0;
        let function = sampled([count; 3], |point| wave(point, scale).value);
        let mut random = StdRng::seed_from_u64(2);
        let mut worst = [0.0_f64; 3];
        for _ in 0..2000 {
            // Far from the ends, where the second derivative is not that of a spline.
            let mut any = || random.random_range(0.4..0.6_f64) * (count - 1) as f64;
            let point = Vector3::new(any(), any(), any());
            let errors = difference(&function.at(&point), &wave(&point, scale));
            worst = core::array::from_fn(|i| worst[i].max(errors[i] * scale.powi(i as i32)));
        }
        worst
    };
    let (coarse, fine) = (worst(24), worst(48));
    let orders: [f64; 3] = core::array::from_fn(|i| (coarse[i] / fine[i]).log2());
    println!("orders of value, gradient and second derivative: {orders:.2?}, errors {fine:?}");
    assert!(orders[0] > 3.7 && orders[1] > 2.8 && orders[2] > 1.8, "{orders:?}");
}

#[test]
fn derivatives_are_continuous() {
    let counts = [8; 3];
    let mut random = StdRng::seed_from_u64(3);
    let function = sampled(counts, |point| (12.9 * point.x + 78.2 * point.y + 37.7 * point.z).sin());
    for _ in 0..500 {
        let mut any = || random.random_range(1.0..6.0_f64);
        let mut point = Vector3::new(any(), any(), any());
        let axis = point.imax();
        point[axis] = point[axis].round().min(5.0);
        let sides = [-1e-9, 1e-9].map(|more| function.at(&(point + Vector3::ith(axis, more))));
        let jumps = difference(&sides[0], &sides[1]);
        assert!(jumps.iter().all(|jump| *jump < 1e-7), "{jumps:?}");
    }
}

#[test]
fn two_grids_are_the_fine_one_where_all_is_fine() {
    let (cells, scale) = (10, 9.0);
    let coarse = sampled([cells + 1; 3], |point| wave(&(point * RATIO as f64), scale).value);
    // Corrections in all but the two outermost layers.
    let mut bricks = Vec::new();
    for number in 0..cells.pow(3) {
        let cell = [number % cells, number / cells % cells, number / (cells * cells)];
        if cell.iter().all(|index| (2..=cells - 3).contains(index)) {
            let values = core::array::from_fn(|node| {
                let fine = place(node, [RATIO; 3]) + Vector3::from(cell.map(|index| (index * RATIO) as f64));
                wave(&fine, scale).value - coarse.at(&(fine / RATIO as f64)).value
            });
            bricks.push((cell, values));
        }
    }
    let both = Refinement::new(coarse.clone(), &bricks).unwrap();
    let fine = sampled([cells * RATIO; 3], |point| wave(point, scale).value);
    let mut random = StdRng::seed_from_u64(4);
    for _ in 0..1000 {
        let mut any =
            |range: core::ops::Range<f64>| Vector3::from_fn(|_, _| random.random_range(range.clone()));
        // Ten nodes from where corrections and the fine grid end: 0.27^10 is 2e-6 of what is cut there.
        let inside = any(18.0..21.0);
        let jumps = difference(&both.at(&inside), &fine.at(&inside));
        assert!(jumps.iter().all(|jump| *jump < 20.0 * SINGLE), "{inside:?}: {jumps:?}");
        let mut border = any(4.0..35.0);
        border.x = 4.0 + (border.x - 4.0) / 31.0 * 1.9;
        let alone = coarse.at(&(border / 4.0));
        let alone =
            SpacePoint { value: alone.value, gradient: alone.gradient / 4.0, hessian: alone.hessian / 16.0 };
        let jumps = difference(&both.at(&border), &alone);
        assert!(jumps.iter().all(|jump| *jump < 20.0 * SINGLE), "{border:?}: {jumps:?}");
    }
}

#[test]
fn what_is_no_grid_is_refused() {
    let ones = |counts: [usize; 3]| Tricubic::new(counts, vec![1.0; counts.iter().product()]);
    assert!(ones([4, 3, 5]).unwrap_err().to_string().contains("number of nodes along an axis of a grid = 3"));
    let many = Tricubic::new([1 << 20; 3], Vec::new()).unwrap_err().to_string();
    assert!(many.contains("number of nodes of a grid = 1152921504606847000 is not allowed"), "{many}");
    let few = Tricubic::new([4; 3], vec![0.0; 63]).unwrap_err().to_string();
    assert_eq!(few, "values at the nodes of a grid has 63 entries, expected 64");
    let large = Tricubic::new([4; 3], vec![1e39; 64]).unwrap_err().to_string();
    assert!(large.contains("coefficient of a grid = inf is not allowed"), "{large}");
    for cell in [[1, 3, 3], [3, 3, 4]] {
        let refused = Refinement::new(ones([7; 3]).unwrap(), &[(cell, [0.0; 64])]).unwrap_err();
        assert_eq!(refused.to_string(), "a correction reaches the border of its grid");
    }
    let flat = ones([7; 3]).unwrap().at(&Vector3::repeat(2.3));
    assert!((flat.value - 1.0).abs() < SINGLE && flat.hessian.abs() < Matrix3::repeat(10.0 * SINGLE));
}
