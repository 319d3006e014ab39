//! Inputs that move during a step, and derivatives of outputs.

use mcm::fmi::Instance;
use mcm::fmi::state::Ending;
use mcm::fmi::value::Value;
use mcm::fmi::variables::Table;

use super::instance::{get, initialised, reference, set};
use super::{BENT, last};
use crate::tolerance::{CENTRAL_DIFFERENCE, DIFFERENCE, EFFECT, ROUNDING, SAME_SHAPE, assert_close};

fn set_rate(instance: &mut Instance, table: &Table, name: &str, rate: f64) -> Ending {
    instance.set_input_derivatives(&[reference(table, name)], &[1], &[rate])
}

fn output_rate(instance: &mut Instance, table: &Table, name: &str) -> f64 {
    instance.output_derivatives(&[reference(table, name)], &[1]).unwrap()[0]
}

#[test]
fn inputs_move_during_the_step_and_stay_where_they_arrive() {
    let (mut moved, table, told) = initialised(BENT);
    let (mut set_there, ..) = initialised(BENT);
    assert_eq!(set_rate(&mut moved, &table, "field.uniform[2]", 0.05), Ending::Ok);
    assert_eq!(moved.do_step(0.0, 0.1), Ending::Ok, "{}", last(&told));
    assert_close("field", &[get(&mut moved, &table, "field.uniform[2]")], &[0.015], ROUNDING);
    assert_eq!(set(&mut set_there, &table, "field.uniform[2]", 0.015), Ending::Ok);
    let there = get(&mut set_there, &table, "tip.angle");
    assert_close("tip", &[get(&mut moved, &table, "tip.angle")], &[there], SAME_SHAPE);
    // The derivatives belonged to that step: the next one holds the inputs.
    assert_eq!(moved.do_step(0.1, 0.1), Ending::Ok);
    assert_close("held", &[get(&mut moved, &table, "field.uniform[2]")], &[0.015], ROUNDING);
    // Set with respect to the beginning of the step, together with the input itself.
    assert_eq!(set_rate(&mut moved, &table, "field.uniform[2]", -0.05), Ending::Ok);
    assert_eq!(set(&mut moved, &table, "field.uniform[2]", 0.01), Ending::Ok);
    assert_eq!(moved.do_step(0.2, 0.1), Ending::Ok);
    assert_close("both", &[get(&mut moved, &table, "field.uniform[2]")], &[0.005], ROUNDING);
}

#[test]
fn derivatives_may_be_set_before_initialisation_and_a_reset_forgets_them() {
    let (mut instance, package, _) = super::instance(BENT);
    let table = package.table();
    for reset in [false, true] {
        assert_eq!(set_rate(&mut instance, table, "field.uniform[2]", 0.1), Ending::Ok);
        if reset {
            instance.reset();
        }
        instance.enter_initialization();
        assert_eq!(instance.exit_initialization(), Ending::Ok);
        assert_eq!(instance.do_step(0.0, 0.1), Ending::Ok);
        let expected = if reset { 0.01 } else { 0.02 };
        assert_close(reset, &[get(&mut instance, table, "field.uniform[2]")], &[expected], ROUNDING);
        instance.reset();
    }
}

/// A clamp that turns under a load by three quarters of a circle in one step must not take the short way round.
#[test]
fn orientations_follow_their_path_and_stay_normalised() {
    let (mut instance, table, told) = initialised(BENT);
    let names = [1, 2, 3, 4].map(|component| format!("base.orientation[{component}]"));
    let read = |instance: &mut Instance| names.each_ref().map(|name| get(instance, &table, name));
    // From (1, 0, 0, 0) towards (-cos 45, 0, 0, sin 45): 270 deg about z.
    let half = core::f64::consts::FRAC_1_SQRT_2;
    for (name, rate) in names.iter().zip([-half - 1.0, 0.0, 0.0, half]) {
        assert_eq!(set_rate(&mut instance, &table, name, rate), Ending::Ok);
    }
    assert_eq!(instance.do_step(0.0, 1.0), Ending::Ok, "{}", last(&told));
    assert_close("orientation", &read(&mut instance), &[-half, 0.0, 0.0, half], ROUNDING);
    // The last part was a fraction of the way: the solve went along, some steps for each part.
    let iterations = instance.get(&[reference(&table, "solver.iterations")], "Integer", Value::integer);
    assert!(iterations.unwrap()[0] > 47, "3/2 pi in parts of 0.1 rad");
    // Through the zero quaternion there is no way.
    for (name, from) in names.iter().zip(read(&mut instance)) {
        assert_eq!(set_rate(&mut instance, &table, name, -from), Ending::Ok);
    }
    assert_eq!(instance.do_step(1.0, 1.0), Ending::Error);
    assert!(last(&told).contains("base.orientation"), "{}", last(&told));
}

#[test]
fn outputs_have_derivatives_by_time() {
    let (mut instance, table, _) = initialised(BENT);
    assert_eq!(output_rate(&mut instance, &table, "tip.angle").to_bits(), 0, "inputs are held");
    assert_eq!(set_rate(&mut instance, &table, "field.uniform[2]", 0.02), Ending::Ok);
    assert_eq!(set_rate(&mut instance, &table, "base.orientation[3]", 0.3), Ending::Ok);
    assert_eq!(instance.do_step(0.0, 0.1), Ending::Ok);
    // After the step: the derivatives at its end, from the left.
    instance.save(1);
    for name in [
        "tip.angle",
        "tip.position[2]",
        "tip.orientation[3]",
        "base.reaction_moment[1]",
        "shape.tangent[3,2]",
        "shape.curvature[3,1]",
    ] {
        assert_eq!(instance.restore(1), Ending::Ok);
        let rate = output_rate(&mut instance, &table, name);
        let h = 1e-3;
        let ends = [-h, h].map(|h| {
            assert_eq!(instance.restore(1), Ending::Ok);
            let mut there = |name: &str, rate: f64| {
                let value = get(&mut instance, &table, name) + rate * h;
                assert_eq!(set(&mut instance, &table, name, value), Ending::Ok);
            };
            there("field.uniform[2]", 0.02);
            there("base.orientation[3]", 0.3);
            get(&mut instance, &table, name)
        });
        assert!(rate.abs() > EFFECT, "{name} {rate}");
        assert_close(name, &[rate], &[(ends[1] - ends[0]) / (2.0 * h)], DIFFERENCE);
    }
    assert_eq!(instance.restore(1), Ending::Ok);
    assert_eq!(instance.do_step(0.1, 0.1), Ending::Ok);
    assert_eq!(output_rate(&mut instance, &table, "tip.angle").to_bits(), 0, "held again");
}

/// Bent and twisted out of any plane.
fn loaded() -> String {
    format!("{BENT}\n[load]\ntip_force_n = [0.001, 0.0, -0.002]\ntip_moment_nm = [0.0, 0.0, 2e-6]")
}

/// The variables of a vector at each of five points.
fn at_points(stem: &str) -> Vec<String> {
    (1..=5).flat_map(|point| (1..=3).map(move |axis| format!("{stem}[{point},{axis}]"))).collect()
}

#[test]
fn the_centreline_has_the_derivatives_of_whole_solves() {
    let (mut instance, table, _) = initialised(&loaded());
    instance.save(1);
    for stem in ["shape.tangent", "shape.curvature"] {
        let names = at_points(stem);
        let unknowns: Vec<u32> = names.iter().map(|name| reference(&table, name)).collect();
        for (input, h) in [
            ("field.uniform[1]", 1e-5),
            ("field.uniform[2]", 1e-5),
            ("tip.load_force[1]", 1e-6),
            ("tip.load_moment[3]", 1e-9),
            ("base.orientation[2]", 1e-4),
        ] {
            let known = reference(&table, input);
            let rates = instance.directional_derivative(&unknowns, &[known], &[1.0]).unwrap();
            let [minus, plus] = [-h, h].map(|by| {
                let value = get(&mut instance, &table, input) + by;
                assert_eq!(set(&mut instance, &table, input, value), Ending::Ok);
                let there = instance.get(&unknowns, "Real", Value::real).unwrap();
                assert_eq!(instance.restore(1), Ending::Ok);
                there
            });
            let expected: Vec<f64> = plus.iter().zip(minus).map(|(a, b)| (a - b) / (2.0 * h)).collect();
            assert!(expected.iter().any(|rate| rate.abs() > EFFECT), "{stem} by {input}");
            assert_close((stem, input), &rates, &expected, CENTRAL_DIFFERENCE);
        }
    }
}

#[test]
fn derivatives_that_are_none_are_refused_by_name() {
    let (mut instance, table, told) = initialised(BENT);
    let of = |name: &str| reference(&table, name);
    let field = of("field.uniform[2]");
    for (name, reason) in [
        ("tip.angle", "tip.angle is not a continuous input"),
        ("gravity[1]", "gravity[1] is not a continuous input"),
        ("model.interaction", "model.interaction is not a continuous input"),
    ] {
        assert_eq!(instance.set_input_derivatives(&[of(name)], &[1], &[1.0]), Ending::Error);
        assert!(last(&told).contains(reason), "{}", last(&told));
    }
    assert_eq!(instance.set_input_derivatives(&[field], &[0], &[1.0]), Ending::Error);
    assert!(last(&told).contains("order 0"), "{}", last(&told));
    assert_eq!(instance.set_input_derivatives(&[field], &[1], &[f64::NAN]), Ending::Error);
    assert!(last(&told).contains("field.uniform[2] = NaN"), "{}", last(&told));
    assert_eq!(instance.set_input_derivatives(&[field, field], &[1, 2], &[0.0, 0.0]), Ending::Ok);
    assert_eq!(instance.set_input_derivatives(&[field, field], &[1, 2], &[0.0, 1.0]), Ending::Ok);
    assert!(last(&told).contains("above the first"), "{}", last(&told));
    assert_eq!(instance.output_derivatives(&[of("tip.angle")], &[0]), Err(Ending::Error));
    assert_eq!(instance.output_derivatives(&[of("tip.angle")], &[2]), Ok(vec![0.0]));
    for (unknown, known, reason) in [
        ("stability.margin", "field.uniform[2]", "stability.margin has no derivatives"),
        ("solver.residual", "field.uniform[2]", "solver.residual has no derivatives"),
        ("stability.snaps", "field.uniform[2]", "stability.snaps has no derivatives"),
        ("field.uniform[1]", "field.uniform[2]", "field.uniform[1] has no derivatives"),
        ("tip.angle", "design.helix.length", "by design.helix.length"),
        ("tip.angle", "tip.angle", "by tip.angle"),
    ] {
        assert_eq!(instance.directional_derivative(&[of(unknown)], &[of(known)], &[1.0]), Err(Ending::Error));
        assert!(last(&told).contains(reason), "{}", last(&told));
    }
    assert_eq!(
        instance.directional_derivative(&[of("tip.angle")], &[field], &[f64::NAN]),
        Err(Ending::Error)
    );
    assert_eq!(instance.do_step(0.0, 0.1), Ending::Ok);
}

/// Parameters of the design, of the magnet and of the vessel's surroundings are known while they can still be set.
#[test]
fn during_initialisation_parameters_have_derivatives() {
    let scene = "[design]\nsegments = 2\n[field]\nuniform_mt = [0.0, 5.0, 0.0]\n[magnet]\n";
    let at = |changed: Option<(&str, f64)>| {
        let (mut instance, package, told) = super::instance(scene);
        instance.enter_initialization();
        if let Some((name, value)) = changed {
            assert_eq!(set(&mut instance, package.table(), name, value), Ending::Ok, "{}", last(&told));
        }
        (instance, package, told)
    };
    let outputs = [
        "tip.angle",
        "tip.position[2]",
        "magnet.reaction_torque[1]",
        "shape.arc_length[5]",
        "shape.tangent[5,2]",
        "shape.curvature[4,1]",
    ];
    for name in [
        "design.helix.shore_a",
        "design.helix.length",
        "design.ring.remanence",
        "magnet.design.cylinder[1].remanence",
    ] {
        let (mut instance, package, told) = at(None);
        let table = package.table();
        let unknowns = outputs.map(|output| reference(table, output));
        let knowns = [reference(table, name), reference(table, "field.uniform[2]")];
        let found = instance.directional_derivative(&unknowns, &knowns, &[1.0, 0.0]);
        let found = found.unwrap_or_else(|_| panic!("{name}: {}", last(&told)));
        let both = instance.directional_derivative(&unknowns, &knowns, &[0.5, 2.0]).unwrap();
        let field = instance.directional_derivative(&unknowns, &knowns[1..], &[2.0]).unwrap();
        let value = get(&mut instance, table, name);
        for (index, output) in outputs.into_iter().enumerate() {
            let h = 1e-3 * value;
            let ends = [-h, h].map(|h| get(&mut at(Some((name, value + h))).0, table, output));
            let expected = (ends[1] - ends[0]) / (2.0 * h);
            let error = (found[index] - expected).abs() / (1e-6 + expected.abs());
            assert!(error < 1e-4, "{output} by {name}: {}, by differences {expected}", found[index]);
            assert_close(name, &[both[index]], &[0.5 * found[index] + field[index]], ROUNDING);
        }
        assert_eq!(instance.exit_initialization(), Ending::Ok);
        assert_eq!(instance.directional_derivative(&unknowns, &knowns[..1], &[1.0]), Err(Ending::Error));
        assert!(last(&told).contains("initialisation is over"), "{}", last(&told));
    }
}

/// A straight rod under its buckling load has no derivatives.
#[test]
fn at_a_fold_there_are_no_derivatives_and_the_log_says_so() {
    let (mut instance, table, told) = initialised(
        "[design]\nkind = \"cylinder\"\nlength_mm = 20.0\nradius_mm = 0.5\nelastic_modulus_mpa = 1.0\n\
         remanence_t = 0.0\n[model]\ninteraction = \"none\"",
    );
    // Euler's load of a clamped rod, pi^2 E I / (4 L^2); compression shortens the rod by a part in 1e3.
    let inertia = core::f64::consts::PI * 0.5e-3_f64.powi(4) / 4.0;
    let euler = core::f64::consts::PI.powi(2) * 1e6 * inertia / (4.0 * 0.02_f64.powi(2));
    let (tip, load) = (reference(&table, "tip.position[1]"), reference(&table, "tip.load_force[1]"));
    instance.save(1);
    let mut flexible = |force: f64| {
        told.lock().unwrap().clear();
        assert_eq!(instance.restore(1), Ending::Ok);
        assert_eq!(set(&mut instance, &table, "tip.load_force[3]", -force), Ending::Ok);
        let straight = instance.directional_derivative(&[tip], &[load], &[1.0]).map(|rates| rates[0]);
        straight.map_err(|_| {
            told.lock().unwrap().iter().any(|said| said.contains("no derivatives: the shape is at a fold"))
        })
    };
    let (mut low, mut high) = (0.9 * euler, 1.1 * euler);
    assert!(flexible(low).unwrap() > flexible(0.5 * low).unwrap());
    let found = (0..40).any(|_| {
        let middle = 0.5 * (low + high);
        let outcome = flexible(middle);
        if outcome.is_ok_and(|rate| rate > 0.0) && middle < euler {
            low = middle;
        } else {
            high = middle;
        }
        outcome == Err(true)
    });
    assert!(found && (high / euler - 1.0).abs() < 0.01, "{low} {high} {euler}");
}

#[test]
fn derivatives_beyond_all_numbers_are_refused() {
    let (mut instance, table, told) = initialised(BENT);
    let (angle, field) = (reference(&table, "tip.angle"), reference(&table, "field.uniform[2]"));
    assert_eq!(instance.directional_derivative(&[angle], &[field], &[f64::MAX]), Err(Ending::Error));
    assert!(last(&told).contains("too large"), "{}", last(&told));
    assert!(instance.directional_derivative(&[angle], &[field], &[1.0]).unwrap()[0] > 1.0);
}
