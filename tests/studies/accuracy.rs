//! Who is on the front of error against time, and what the picture shows; times themselves are not tested.

use mcm::studies::{Panel, Point, Series, Stroke, accuracy_picture, front};

/// A solve of the drawn scene.
fn point(name: &'static str, time: f64, error: f64) -> Point {
    Point {
        field: "pair",
        segments: 9,
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

#[test]
fn the_picture_shows_the_drawn_scene_and_peers_where_there_are_any() {
    let mut points = points();
    points.push(Point { segments: 3, ..point("potential", 1.0, 1e-9) }); // another scene
    let picture = accuracy_picture(&points, Default::default());
    let [Panel::Places { series, marks, .. }] = picture.panels.as_slice() else { panic!("one panel") };
    assert_eq!(series.iter().map(|s| s.places.len()).sum::<usize>(), 5);
    assert_eq!(marks.len(), 4, "three on the front and how well it is known");
    let peer = Series { label: "peer".into(), colour: 1, stroke: Stroke::Solid, places: vec![[1.0, 1.0]] };
    let panels = accuracy_picture(&points, [Vec::new(), vec![peer.clone()], vec![peer]]).panels;
    assert_eq!(panels.len(), 3, "none where nobody is");
}
