//! Time of one field evaluation: ring and cylinder, field, gradient, second derivative, beside the crate magba's field
//! at the same points in the same run: `cargo bench --bench field`.
#![allow(
    clippy::unwrap_used,
    clippy::expect_used,
    clippy::panic,
    missing_docs,
    reason = "a program that stops when a table is missing; criterion's macros write undocumented items"
)]

#[path = "peer.rs"]
mod peer;
#[allow(dead_code, reason = "shared with the tests")]
#[path = "../magnetics/reference.rs"]
mod reference;

use core::hint::black_box;

use criterion::{BenchmarkGroup, Criterion, criterion_group, criterion_main, measurement::WallTime};
use mcm::geometry::Pose;
use mcm::magnetics::{AxialSource, DipoleSheet, FieldAccuracy};
use nalgebra::{Vector2, Vector3};

fn measure(
    group: &mut BenchmarkGroup<'_, WallTime>,
    points: &[Vector3<f64>],
    source: &AxialSource,
    other: impl Fn(&Vector3<f64>) -> [f64; 3],
) {
    let mut next = points.iter().cycle();
    let mut point = move || black_box(next.next().expect("there are points"));
    group.bench_function("B", |b| b.iter(|| source.field(point())));
    group.bench_function("B+G", |b| b.iter(|| source.field_gradient(point())));
    group.bench_function("B+G+H", |b| b.iter(|| source.jet(point())));
    group.bench_function("magba B", |b| b.iter(|| other(point())));
    let (mut fields, mut jets) = (Vec::new(), Vec::new());
    let count = points.len();
    group.bench_function(format!("B+G at {count} points"), |b| {
        b.iter(|| source.field_gradients(black_box(points), &mut fields));
    });
    // A section of the manipulator, four radii away.
    let dipoles: Vec<_> = points.iter().map(|at| (Vector2::new(0.2 * at.x, 0.2 * at.y), 1e-6)).collect();
    let (sheet, pose) = (DipoleSheet::new(&dipoles), Pose::identity().advanced(4.0 * source.outer_radius()));
    for accuracy in [FieldAccuracy::Exact, FieldAccuracy::Rough, FieldAccuracy::Multipoles(9)] {
        let name = |order| format!("{order} of {count} dipoles, {accuracy:?}");
        group.bench_function(name("B+G"), |b| b.iter(|| source.on_sheet(&sheet, &pose, accuracy)));
        group.bench_function(name("B+G+H"), |b| b.iter(|| source.second_on_sheet(&sheet, &pose, accuracy)));
    }
    group.bench_function(format!("B+G+H at {count} points"), |b| {
        b.iter(|| source.jets(black_box(points), &mut jets));
    });
}

fn field(criterion: &mut Criterion) {
    let ring = reference::ring();
    let mut group = criterion.benchmark_group("ring");
    measure(&mut group, &peer::points(2.0e-3), &ring, peer::ring);
    group.finish();

    let far: Vec<_> = peer::points(2.0e-3).iter().map(|point| point * 8.0).collect();
    let mut group = criterion.benchmark_group("ring, 17 to 48 radii away");
    measure(&mut group, &far, &ring, peer::ring);
    group.finish();

    let cylinder = AxialSource::new(0.0, 22.5e-3, 30.0e-3, 1.35).expect("allowed");
    let mut group = criterion.benchmark_group("cylinder");
    measure(&mut group, &peer::points(22.5e-3), &cylinder, |point| peer::cylinder(point, 22.5e-3, 30.0e-3));
    group.finish();
}

criterion_group! {
    name = benches;
    // Plots need a font, which not every machine has.
    config = Criterion::default().without_plots();
    targets = field
}
criterion_main!(benches);
