//! Microseconds per pair of the paper's rings by the gap between their faces, one turned by 0.1 rad, with the rule that is chosen at
//! the default accuracy and beside it the rule of most nodes on the axis; of many rounds the fastest is kept.
//! `cargo run --release --example pair_speed`.
#![allow(
    clippy::unwrap_used,
    clippy::expect_used,
    clippy::print_stdout,
    reason = "a program that prints a table"
)]

use core::hint::black_box;
use std::time::Instant;

use mcm::constants::VACUUM_PERMEABILITY;
use mcm::equilibrium::Settings;
use mcm::geometry::Pose;
use mcm::magnetics::{AxialRule, AxialSource, PairRule, PairTable};
use mcm::rod::{Charges, Load};
use nalgebra::{Rotation3, Vector3};

const ROUNDS: usize = 60;

/// Inner radius, outer radius, length, m.
const RING: [f64; 3] = [0.75e-3, 2.0e-3, 1.0e-3];

/// Turn of the second ring, rad.
const TURN: f64 = 0.1;

fn by_rule(source: &AxialSource, pose: &Pose, rule: PairRule<'_>, stiff: bool) -> Load {
    let magnetisation = source.remanence() / VACUUM_PERMEABILITY;
    let axis = pose.axis();
    let mut load = Load::zero();
    match rule {
        PairRule::Axis(rule, _) => {
            for (height, volume) in rule.points() {
                let (arm, moment) = (axis * height, magnetisation * volume);
                let point = pose.position + arm;
                if stiff {
                    let jet = source.jet(&point).expect("outside");
                    let along = jet.hessian_along(&axis);
                    load.add_dipole(moment, &axis, &arm, &jet.field, &jet.gradient, Some(&along));
                } else {
                    let (field, gradient) = source.field_gradient(&point).expect("outside");
                    load.add_dipole(moment, &axis, &arm, &field, &gradient, None);
                }
            }
        }
        PairRule::Faces(rules) | PairRule::Surface(rules, _) => {
            for (rule, side) in rules.iter().zip([-1.0, 1.0]) {
                let height = side * 0.5 * source.length();
                let mut charges = Charges::new(stiff);
                for (position, area) in rule.points() {
                    let point = pose.transform(&Vector3::new(position.x, position.y, height));
                    let charge = side * magnetisation * area;
                    if stiff {
                        let (potential, field, gradient) =
                            source.potential_field_gradient(&point).expect("outside");
                        charges.add(charge, &position, potential, &field, Some(&gradient));
                    } else {
                        let (potential, field) = source.potential_field(&point).expect("outside");
                        charges.add(charge, &position, potential, &field, None);
                    }
                }
                load += charges.load(&pose.rotation, height);
            }
        }
    }
    load
}

/// Microseconds, those of the fastest round.
fn time<T>(what: impl Fn() -> T) -> f64 {
    let mut best = f64::INFINITY;
    for _ in 0..ROUNDS {
        let start = Instant::now();
        let mut count = 0;
        while start.elapsed().as_secs_f64() < 2e-4 {
            black_box(what());
            count += 1;
        }
        best = best.min(start.elapsed().as_secs_f64() * 1e6 / f64::from(count));
    }
    best
}

fn main() {
    let [inner, outer, length] = RING;
    let source = AxialSource::new(inner, outer, length, 1.35).unwrap();
    let table = PairTable::new(inner, outer, length, Settings::default().pair_accuracy);
    let axis = AxialRule::new(inner, outer, length, AxialRule::MOST_NODES);
    println!(
        "| gap (mm) | rule | nodes | choice (us) | gradient (us) | Hessian (us) | most nodes: gradient | Hessian |"
    );
    println!("| --- | --- | --- | --- | --- | --- | --- | --- |");
    for gap in [0.05, 0.1, 0.2, 0.3, 0.5, 1.0, 1.5, 2.0, 3.0, 3.5, 4.0, 5.0, 7.0, 10.0] {
        let depth = 0.5 * length * TURN.cos() + outer * TURN.sin();
        let pose = Pose {
            position: Vector3::new(0.0, 0.0, 0.5 * length + 1e-3 * gap + depth),
            rotation: Rotation3::new(Vector3::new(TURN, 0.0, 0.0)).into_inner(),
        };
        let choice = time(|| table.choose(&source, black_box(&pose)));
        let rule = table.rule(table.choose(&source, &pose));
        let (name, nodes) = match rule {
            PairRule::Axis(rule, _) => ("axis", rule.points().len()),
            PairRule::Faces(rules) | PairRule::Surface(rules, _) => {
                ("faces", rules.iter().map(|rule| rule.len()).sum())
            }
        };
        let [gradient, hessian] = [false, true].map(|stiff| time(|| by_rule(&source, &pose, rule, stiff)));
        let beside =
            [false, true].map(|stiff| time(|| by_rule(&source, &pose, PairRule::Axis(&axis, 0.0), stiff)));
        println!(
            "| {gap} | {name} | {nodes} | {choice:.2} | {gradient:.2} | {hessian:.2} | {:.2} | {:.2} |",
            beside[0], beside[1]
        );
    }
}
