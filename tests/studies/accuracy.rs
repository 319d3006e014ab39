//! Which solves are on the front of error against time; times themselves are not tested.

use mcm::studies::{Point, front};

/// A solve of one scene.
fn point(name: &'static str, time: f64, error: f64) -> Point {
    Point {
        field: "pair",
        segments: 9,
        length_mm: 46.0,
        interaction: "rings",
        start: "warm",
        name,
        resolution: String::new(),
        time_us: Some(time),
        tip_over_length: Some(error),
        angle_deg: Some(0.0),
        wrench_relative: Some(0.0),
        reference_over_length: Some(1e-8),
    }
}

fn points() -> Vec<Point> {
    let lost = Point { time_us: None, tip_over_length: None, ..point("shooting", 0.0, 0.0) };
    vec![
        point("collocation", 30.0, 1e-7),
        point("potential", 10.0, 1e-4),
        point("shooting", 20.0, 1e-3), // slower and worse
        lost,
        point("potential", 40.0, 1e-12), // no better than the next: the reference does not know
        point("planar", 35.0, 1e-9),
    ]
}

#[test]
fn the_front_is_who_nobody_beats() {
    let points = points();
    let found: Vec<(&str, f64)> =
        front(&points).into_iter().filter_map(|p| Some((p.name, p.place()?[1]))).collect();
    assert_eq!(found, [("potential", 1e-4), ("collocation", 1e-7), ("planar", 1e-8)]);
    let [first, other] = [&points[0], &Point { start: "cold", ..points[1].clone() }];
    assert!(first.beside(&points[1]) && !first.beside(other));
}
