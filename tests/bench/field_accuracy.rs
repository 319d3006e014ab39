//! Largest and median relative error of field, gradient and second derivative over the reference rows, beside those
//! of the crate magba: `cargo run --release --example field_accuracy`.
#![allow(
    clippy::unwrap_used,
    clippy::expect_used,
    clippy::panic,
    clippy::print_stdout,
    reason = "a program that prints a table and stops when a table is missing"
)]

#[path = "../given.rs"]
#[allow(dead_code, reason = "others take all of it")]
mod given;
#[path = "peer.rs"]
mod peer;
#[path = "../magnetics/reference.rs"]
mod reference;

use std::time::Instant;

use given::pair;
use mcm::error::Error;
use mcm::geometry::Pose;
use mcm::magnetics::Jet;
use nalgebra::Vector3;
use reference::{Row, ring, table};

fn main() {
    println!("relative error |dX| / |X|, rows where X = 0 left out");
    println!(
        "| source | quantity | rows | median | max | at x, y, z (m) |\n| --- | --- | --- | --- | --- | --- |"
    );
    let (one, two) = (ring(), pair());
    report("ring", "ring_field_dev.csv", "ring_hessian_dev.csv", |p| one.jet(p), peer::ring);
    report(
        "pair",
        "cylinder_pair_field_dev.csv",
        "cylinder_pair_hessian_dev.csv",
        |p| two.jet(p),
        peer::pair,
    );
    println!("\nring on ring, {WRENCH_TABLE}: error of force and torque relative to |F| + |T|/a");
    println!("| accuracy asked for | median | max | microseconds, mean |\n| --- | --- | --- | --- |");
    for accuracy in [1e-3, 1e-6, 1e-9, 1e-12] {
        wrenches(accuracy);
    }
}

const WRENCH_TABLE: &str = "ring_pair_wrench_dev.csv";

fn wrenches(accuracy: f64) {
    let (source, radius) = (ring(), 2.0e-3);
    let rows: Vec<Row<10>> = table(WRENCH_TABLE);
    let start = Instant::now();
    let mut errors: Vec<f64> = rows
        .iter()
        .map(|Row { point, values }| {
            let orientation = core::array::from_fn(|i| values[i]);
            let pose = Pose::new((*point).into(), orientation).expect("unit quaternion");
            let wrench = source.wrench_on(&source, &pose, accuracy).expect("apart");
            let (force, torque) =
                (Vector3::from_row_slice(&values[4..7]), Vector3::from_row_slice(&values[7..]));
            let error = (wrench.force - force).norm().max((wrench.torque - torque).norm() / radius);
            error / (force.norm() + torque.norm() / radius)
        })
        .collect();
    let time = start.elapsed().as_secs_f64() * 1e6 / rows.len() as f64;
    errors.sort_by(f64::total_cmp);
    println!(
        "| {accuracy:.0e} | {:.1e} | {:.1e} | {time:.1} |",
        errors[rows.len() / 2],
        errors[rows.len() - 1]
    );
}

fn report(
    name: &str,
    fields: &str,
    hessians: &str,
    jet: impl Fn(&Vector3<f64>) -> Result<Jet, Error>,
    other: impl Fn(&Vector3<f64>) -> [f64; 3],
) {
    let ours = |point: &Vector3<f64>| jet(point).expect("no reference point lies on an edge");
    let fields: Vec<Row<12>> = table(fields);
    let hessians: Vec<Row<10>> = table(hessians);
    let errors = |pick: &dyn Fn(&Row<12>) -> Option<f64>| -> Vec<(f64, Vector3<f64>)> {
        fields.iter().filter_map(|row| pick(row).map(|error| (error, row.point))).collect()
    };
    line(name, "B", errors(&|row| relative(ours(&row.point).field.as_slice(), &row.values[..3])));
    line(
        name,
        "G",
        errors(&|row| relative(ours(&row.point).gradient.transpose().as_slice(), &row.values[3..])),
    );
    let third = hessians
        .iter()
        .filter_map(|row| {
            relative(&full(&ours(&row.point).hessian.0), &full(&row.values)).map(|error| (error, row.point))
        })
        .collect();
    line(name, "H", third);
    line(name, "B (magba 0.7)", errors(&|row| relative(&other(&row.point), &row.values[..3])));
}

/// Each entry as often as it stands in the full tensor, so that the norm is the tensor's.
fn full(ten: &[f64; 10]) -> [f64; 10] {
    const COUNT: [f64; 10] = [1.0, 3.0, 3.0, 3.0, 6.0, 3.0, 1.0, 3.0, 3.0, 1.0];
    core::array::from_fn(|i| ten[i] * COUNT[i].sqrt())
}

fn relative(got: &[f64], expected: &[f64]) -> Option<f64> {
    let norm = |values: &mut dyn Iterator<Item = f64>| values.map(|v| v * v).sum::<f64>().sqrt();
    let size = norm(&mut expected.iter().copied());
    let difference = norm(&mut got.iter().zip(expected).map(|(a, b)| a - b));
    (size > 0.0).then_some(difference / size)
}

fn line(source: &str, quantity: &str, mut errors: Vec<(f64, Vector3<f64>)>) {
    errors.sort_by(|a, b| a.0.total_cmp(&b.0));
    let (median, (worst, at)) = (errors[errors.len() / 2].0, errors[errors.len() - 1]);
    println!(
        "| {source} | {quantity} | {} | {median:.1e} | {worst:.1e} | {:.3e}, {:.3e}, {:.3e} |",
        errors.len(),
        at.x,
        at.y,
        at.z
    );
}
