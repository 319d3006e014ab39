//! Nanoseconds per field evaluation beside the crate magba, and of cheaper models with what they err. Of alternating rounds the
//! fastest is kept: what other programs do on the machine drops out. `cargo run --release --example field_speed`.
#![allow(
    clippy::unwrap_used,
    clippy::expect_used,
    clippy::panic,
    clippy::print_stdout,
    dead_code,
    reason = "a program that prints a table; it shares modules with the tests"
)]

#[path = "peer.rs"]
mod peer;
#[path = "../magnetics/reference.rs"]
mod reference;

use core::hint::black_box;
use std::time::Instant;

use mcm::magnetics::{
    AxialMagnet, AxialSource, Coil, Cuboid, Cylinders, Dipole, Jet, ObliqueCylinder, Solenoid, Source, Sphere,
};
use nalgebra::{Matrix3, Vector3};

const ROUNDS: usize = 2000;
const PASSES: usize = 4;

/// Nanoseconds per point of one round.
fn time<T>(points: &[Vector3<f64>], evaluate: impl Fn(&Vector3<f64>) -> T) -> f64 {
    let start = Instant::now();
    for _ in 0..PASSES {
        for point in points {
            black_box(evaluate(black_box(point)));
        }
    }
    start.elapsed().as_secs_f64() * 1e9 / (PASSES * points.len()) as f64
}

fn measure(
    name: &str,
    source: &AxialSource,
    points: &[Vector3<f64>],
    other: impl Fn(&Vector3<f64>) -> [f64; 3],
) {
    let mut best = [f64::INFINITY; 4];
    for _ in 0..ROUNDS {
        let round = [
            time(points, |p| source.field(p)),
            time(points, |p| source.field_gradient(p)),
            time(points, |p| source.jet(p)),
            time(points, &other),
        ];
        best = core::array::from_fn(|i| best[i].min(round[i]));
    }
    let [field, gradient, jet, peer] = best;
    println!("| {name} | {field:.0} | {gradient:.0} | {jet:.0} | {peer:.0} |");
}

/// A model's field, and with its gradient.
fn model(
    [distance, name]: [&str; 2],
    points: &[Vector3<f64>],
    field: impl Fn(&Vector3<f64>) -> Vector3<f64>,
    both: impl Fn(&Vector3<f64>) -> (Vector3<f64>, Matrix3<f64>),
) {
    let exact = |point: &Vector3<f64>| reference::ring().field_gradient(point).expect("no edge");
    let errors = [
        median(points.iter().map(|p| (field(p) - exact(p).0).norm() / exact(p).0.norm())),
        median(points.iter().map(|p| (both(p).1 - exact(p).1).norm() / exact(p).1.norm())),
    ];
    row([distance, name], [fastest(points, field), fastest(points, both)], errors);
}

/// Nanoseconds per point of the fastest round.
fn fastest<T>(points: &[Vector3<f64>], evaluate: impl Fn(&Vector3<f64>) -> T) -> f64 {
    (0..ROUNDS).map(|_| time(points, &evaluate)).fold(f64::INFINITY, f64::min)
}

fn row([distance, name]: [&str; 2], [field, both]: [f64; 2], [of_field, of_gradient]: [f64; 2]) {
    println!("| {distance} | {name} | {field:.1} | {both:.1} | {of_field:.1e} | {of_gradient:.1e} |");
}

fn median(values: impl Iterator<Item = f64>) -> f64 {
    let mut values: Vec<f64> = values.filter(|value| !value.is_nan()).collect();
    values.sort_by(f64::total_cmp);
    values[values.len() / 2]
}

/// All models of the ring at these points, then the exact ones, whose errors are those at the rows of the reference.
fn models(distance: &str, points: &[Vector3<f64>]) {
    let ring = reference::ring();
    let dipole = Dipole::new(Vector3::z() * ring.moment()).expect("finite");
    model(
        [distance, "dipole"],
        points,
        |p| dipole.field(p).expect("apart"),
        |p| dipole.field_gradient(p).expect("apart"),
    );

    for degree in [1, 3, 5, 9, 17] {
        model(
            [distance, &format!("multipoles to {degree}")],
            points,
            |p| ring.multipole_field(p, degree).expect("apart"),
            |p| ring.multipole_field_gradient(p, degree).expect("apart"),
        );
    }

    let rows: Vec<reference::Row<12>> = reference::table("ring_field_dev.csv");
    let expected = |row: &reference::Row<12>| {
        (Vector3::from_row_slice(&row.values[..3]), Matrix3::from_row_slice(&row.values[3..]))
    };
    let of_field = |field: &dyn Fn(&Vector3<f64>) -> Vector3<f64>| {
        median(rows.iter().map(|row| (field(&row.point) - expected(row).0).norm() / expected(row).0.norm()))
    };
    let gradient = median(rows.iter().map(|row| {
        let found = ring.field_gradient(&row.point).expect("no edge").1;
        (found - expected(row).1).norm() / expected(row).1.norm()
    }));

    let times = [fastest(points, |p| ring.field(p)), fastest(points, |p| ring.field_gradient(p))];
    row([distance, "exact"], times, [of_field(&|p| ring.field(p).expect("no edge")), gradient]);
    let times = [fastest(points, peer::ring), f64::NAN];
    row([distance, "magba"], times, [of_field(&|p| peer::ring(p).into()), f64::NAN]);
}

/// Nanoseconds per point for field and gradient of a coil, of the cylinder of its outline and of two such cylinders, in
/// alternating rounds, and the ratios.
fn coils() {
    let dimensions = Coil { inner_radius: 20e-3, outer_radius: 40e-3, length: 60e-3, turns: 600.0 };
    let coil = Source::from(Solenoid::new(dimensions).expect("allowed"));
    let cylinder =
        |offset| AxialMagnet { radius: 40e-3, inner_radius: 0.0, length: 60e-3, offset, remanence: 1.35 };
    let one = Source::from(Cylinders::new(vec![cylinder(0.0)]).expect("allowed"));
    let two = Source::from(Cylinders::new(vec![cylinder(0.0), cylinder(0.07)]).expect("apart"));
    println!(
        "\n| distance from the centre | one cylinder, B and G | two cylinders | coil | coil / cylinder |"
    );
    println!("| --- | --- | --- | --- | --- |");
    for (name, radius) in [("60 to 80 mm", 0.06), ("95 to 130 mm", 0.095), ("300 to 400 mm", 0.3)] {
        let points: Vec<_> = (0..32)
            .map(|k| {
                let (sine, cosine) = (0.1 + 0.04 * f64::from(k)).sin_cos();
                Vector3::new(sine, 0.0, cosine) * radius * (1.0 + 0.01 * f64::from(k))
            })
            .collect();
        let mut best = [f64::INFINITY; 3];
        for _ in 0..ROUNDS {
            let round = [&one, &two, &coil].map(|source| time(&points, |p| source.field_gradient(p)));
            best = core::array::from_fn(|i| best[i].min(round[i]));
        }
        let [one, two, coil] = best;
        println!("| {name} | {one:.0} | {two:.0} | {coil:.0} | {:.1} |", coil / one);
    }
}

/// Nanoseconds per point of a batch of 32, for field and gradient and with the second derivative, of magnets of every shape and about the
/// same size in alternating rounds, and what they cost beside the axial cylinder.
fn shapes() {
    let axial = AxialMagnet { radius: 10e-3, inner_radius: 0.0, length: 20e-3, offset: 0.0, remanence: 1.3 };
    let b = Vector3::new(0.6, 0.3, 1.1);
    let kinds: [(&str, Source); 4] = [
        ("axial cylinder", Cylinders::new(vec![axial]).expect("allowed").into()),
        ("oblique cylinder", ObliqueCylinder::new([0.0, 10e-3], 20e-3, b).expect("allowed").into()),
        ("cuboid", Cuboid::new(Vector3::repeat(20e-3), b).expect("allowed").into()),
        ("sphere", Sphere::new(10e-3, b).expect("allowed").into()),
    ];
    println!(
        "\n| shape, distance | B and G | beside the axial cylinder | B, G and H | beside the axial cylinder |"
    );
    println!("| --- | --- | --- | --- | --- |");
    for (distance, radius) in [("30 to 40 mm", 0.03), ("300 to 400 mm", 0.3)] {
        let points: Vec<_> = (0..32)
            .map(|k| {
                let (sine, cosine) = (0.1 + 0.09 * f64::from(k)).sin_cos();
                Vector3::new(0.8 * sine, 0.6 * sine, cosine) * radius * (1.0 + 0.01 * f64::from(k))
            })
            .collect();
        let mut best = [[f64::INFINITY; 2]; 4];
        let (mut both, mut jets) =
            (vec![(Vector3::zeros(), Matrix3::zeros()); points.len()], vec![Jet::zero(); points.len()]);
        for _ in 0..ROUNDS {
            for ((_, source), best) in kinds.iter().zip(&mut best) {
                let start = Instant::now();
                source.gradients(black_box(&points), &mut both).expect("no edge");
                let first = start.elapsed().as_secs_f64();
                source.jets(black_box(&points), &mut jets).expect("no edge");
                let second = start.elapsed().as_secs_f64() - first;
                black_box((&both, &jets));
                let each = [first, second].map(|time| time * 1e9 / points.len() as f64);
                *best = core::array::from_fn(|i| best[i].min(each[i]));
            }
        }
        for ((name, _), [two, three]) in kinds.iter().zip(best) {
            let [by_two, by_three] = [two / best[0][0], three / best[0][1]];
            println!("| {name}, {distance} | {two:.0} | {by_two:.1} | {three:.0} | {by_three:.1} |");
        }
    }
}

fn main() {
    println!("nanoseconds per point, fastest of {ROUNDS} alternating rounds");
    println!("| source | B | B and G | B, G and H | magba B |\n| --- | --- | --- | --- | --- |");
    let (ring, near) = (reference::ring(), peer::points(2.0e-3));
    measure("ring, 2 to 6 radii", &ring, &near, peer::ring);
    let far: Vec<_> = near.iter().map(|point| point * 8.0).collect();
    measure("ring, 17 to 48 radii", &ring, &far, peer::ring);
    let cylinder = AxialSource::new(0.0, 22.5e-3, 30.0e-3, 1.35).expect("allowed");
    measure("cylinder, 2 to 6 radii", &cylinder, &peer::points(22.5e-3), |p| {
        peer::cylinder(p, 22.5e-3, 30.0e-3)
    });
    coils();
    shapes();
    println!(
        "\nnanoseconds, and median relative errors at the same points, of the last two at the rows of the reference"
    );
    println!(
        "| ring | model | B | B and G | error of B | error of G |\n| --- | --- | --- | --- | --- | --- |"
    );
    models("near", &near);
    models("far", &far);
}
