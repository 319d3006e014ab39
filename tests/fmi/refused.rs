//! What a host reads after a value was refused, and how it goes on.

use mcm::fmi::Instance;
use mcm::fmi::state::{Ending, Interface, State};
use mcm::fmi::value::Value;
use mcm::fmi::variables::Table;

use super::instance::{get, initialised, reference, set, started};
use super::{BENT, instance, instance_for, last};
use crate::tolerance::{EFFECT, SAME_SHAPE, assert_close};

const REFUSED: [i32; 2] = [3, 6]; // `solver.status`, `solver.outcome`
const SOLVED: [i32; 2] = [0, 0];

/// A device on a shaft, with a guidewire.
const SHAFT: &str = "[design]\nsegments = 1\n[field]\nuniform_mt = [0.0, 5.0, 0.0]\n[model]\ninteraction = \"none\"\n\
     [feed]\nmode = \"insertion\"\ninsertion_mm = 10.0\n[feed.shaft]\nouter_radius_mm = 0.7\ninner_radius_mm = 0.3\n\
     shore_a = 40.0\npoisson = 0.4\n[guidewire]\nradius_mm = 0.2\nelastic_modulus_mpa = 1000.0";

/// The attraction of rings and helix pulls one segment shut at 35.83 mT.
const SHUT: &str =
    "[design]\nsegments = 1\n[model]\ninteraction = \"full\"\n[field]\nuniform_mt = [0, 20, 0]";

fn search(instance: &mut Instance, table: &Table) -> [i32; 2] {
    let read = ["solver.status", "solver.outcome"].map(|name| reference(table, name));
    instance.get(&read, "Integer", Value::integer).unwrap().try_into().unwrap()
}

/// Every result that describes the search is readable.
fn assert_search_is_readable(instance: &mut Instance, table: &Table) {
    for name in ["solver.residual", "solver.progress"] {
        assert!(get(instance, table, name).is_finite(), "{name}");
    }
    for name in ["solver.iterations", "stability.snaps"] {
        assert!(instance.get(&[reference(table, name)], "Integer", Value::integer).is_ok(), "{name}");
    }
}

#[test]
fn a_refused_input_is_reported_until_a_good_one_arrives() {
    for (scene, name, bad, at_once) in [
        (BENT, "magnet.position[2]", f64::NAN, true),
        (BENT, "field.uniform[2]", f64::INFINITY, true),
        (BENT, "field.uniform[2]", f64::NEG_INFINITY, true),
        (BENT, "tip.load_force[1]", 1e308, true),
        (BENT, "magnet.orientation[1]", 3.0, false),
        (BENT, "base.orientation[1]", 0.3, false),
        (BENT, "model.tolerance_position", -1.0, false),
        (BENT, "model.tolerance_relative", 1.5, false),
        (SHAFT, "feed.insertion", 1.5, false),
        (SHAFT, "feed.insertion", -0.001, false),
        (SHAFT, "guidewire.insertion", 3.0, false),
    ] {
        let (mut instance, table, told) = initialised(scene);
        let (angle, good) = (get(&mut instance, &table, "tip.angle"), get(&mut instance, &table, name));
        assert_eq!(search(&mut instance, &table), SOLVED);
        let ending = set(&mut instance, &table, name, bad);
        assert_eq!(ending == Ending::Error, at_once, "{name} = {bad}");
        for _ in 0..2 {
            assert_eq!(search(&mut instance, &table), REFUSED, "{name} = {bad}");
            assert_search_is_readable(&mut instance, &table);
            let kept = get(&mut instance, &table, "tip.angle");
            assert_eq!(kept.to_bits(), angle.to_bits(), "{name} = {bad}: the last good shape");
            assert_eq!(instance.do_step(0.0, 0.1), Ending::Error, "{name} = {bad}");
            let (said, words) = (last(&told), ["norm of", "insertion", "tip position"]);
            assert!(said.contains(name) || words.iter().any(|word| said.contains(word)), "{name}: {said}");
            assert_eq!(instance.state(), State::Stepping);
            assert_eq!(instance.time().to_bits(), 0, "no step was done");
        }
        let of = [reference(&table, "tip.angle")];
        let by = [reference(&table, "field.uniform[2]")];
        assert_eq!(instance.directional_derivative(&of, &by, &[1.0]), Err(Ending::Error));
        assert_eq!(set(&mut instance, &table, name, good), Ending::Ok);
        assert_eq!(search(&mut instance, &table), SOLVED, "{}", last(&told));
        assert_eq!(instance.do_step(0.0, 0.1), Ending::Ok, "{}", last(&told));
        assert_close(name, &[get(&mut instance, &table, "tip.angle")], &[angle], SAME_SHAPE);
    }
}

#[test]
fn what_a_refused_call_was_to_change_counts_as_refused_and_what_it_repeats_does_not() {
    let (mut instance, table, told) = initialised(BENT);
    let names = ["magnet.position[1]", "magnet.position[2]", "magnet.strength"];
    let references = names.map(|name| reference(&table, name));
    let kept = names.map(|name| get(&mut instance, &table, name));
    let call = [f64::NAN, kept[1] - 0.01, kept[2]].map(Value::Real);
    assert_eq!(instance.set(&references, call.into_iter()), Ending::Error);
    assert_eq!(set(&mut instance, &table, names[0], kept[0]), Ending::Ok);
    assert_eq!(search(&mut instance, &table), REFUSED, "the second value was not taken either");
    assert_eq!(instance.do_step(0.0, 0.1), Ending::Error);
    assert!(last(&told).contains("the last value of magnet.position[2] was refused"), "{}", last(&told));
    assert_eq!(set(&mut instance, &table, names[1], kept[1]), Ending::Ok);
    assert_eq!(search(&mut instance, &table), SOLVED);
    assert_eq!(instance.do_step(0.0, 0.1), Ending::Ok);
    // Calls that are wrong in themselves, and change nothing, do not stop a run.
    assert_eq!(instance.set(&[123_456], [Value::Real(1.0)].into_iter()), Ending::Error);
    assert_eq!(set(&mut instance, &table, "tip.angle", 1.0), Ending::Error);
    assert_eq!(set(&mut instance, &table, "design.helix.length", 0.005), Ending::Error);
    assert_eq!(search(&mut instance, &table), SOLVED);
    assert_eq!(instance.do_step(0.1, 0.1), Ending::Ok);
}

#[test]
fn a_refused_time_derivative_stops_the_step_that_would_hold_its_input() {
    let (mut instance, table, told) = initialised(BENT);
    let field = [reference(&table, "field.uniform[2]")];
    assert_eq!(instance.set_input_derivatives(&field, &[1], &[f64::NAN]), Ending::Error);
    assert_eq!(search(&mut instance, &table), REFUSED);
    assert_eq!(instance.do_step(0.0, 0.1), Ending::Error, "{}", last(&told));
    assert_eq!(instance.set_input_derivatives(&field, &[1], &[0.01]), Ending::Ok);
    assert_eq!(instance.do_step(0.0, 0.1), Ending::Ok, "{}", last(&told));
    assert_eq!(search(&mut instance, &table), SOLVED);
}

#[test]
fn refused_parameters_keep_a_run_from_beginning() {
    for (name, bad) in
        [("design.helix.core_inner_radius", f64::NAN), ("design.helix.core_inner_radius", 0.003)]
    {
        let (mut instance, package, told) = instance(BENT);
        let table = package.table();
        instance.enter_initialization();
        set(&mut instance, table, name, bad);
        assert_eq!(search(&mut instance, table), REFUSED, "{bad}");
        assert_search_is_readable(&mut instance, table);
        assert_eq!(instance.exit_initialization(), Ending::Error, "{bad}");
        assert!(last(&told).contains("radius"), "{}", last(&told));
        assert_eq!(instance.state(), State::Initialization);
        assert_eq!(set(&mut instance, table, name, 0.0007), Ending::Ok);
        assert_eq!(search(&mut instance, table), SOLVED);
        assert_eq!(instance.exit_initialization(), Ending::Ok, "{}", last(&told));
    }
}

#[test]
fn inputs_refused_in_initialisation_mode_leave_the_shape_that_was_read_there() {
    let (mut instance, package, told) = instance(BENT);
    let table = package.table();
    instance.enter_initialization();
    let angle = get(&mut instance, table, "tip.angle");
    assert_eq!(set(&mut instance, table, "base.orientation[1]", 0.3), Ending::Ok);
    assert_eq!(search(&mut instance, table), REFUSED);
    assert_eq!(get(&mut instance, table, "tip.angle").to_bits(), angle.to_bits());
    assert_eq!(instance.exit_initialization(), Ending::Error, "{}", last(&told));
    assert_eq!(set(&mut instance, table, "base.orientation[1]", 1.0), Ending::Ok);
    assert_eq!(instance.exit_initialization(), Ending::Ok, "{}", last(&told));
    assert_eq!(get(&mut instance, table, "tip.angle").to_bits(), angle.to_bits());
}

#[test]
fn a_saved_state_knows_what_was_refused() {
    for (name, bad, good) in [
        ("field.uniform[2]", f64::NAN, 0.01),
        ("base.orientation[1]", 0.3, 1.0),
        ("model.tolerance_position", 0.0, 1e-4),
        ("model.tolerance_relative", -1.0, 1e-4),
    ] {
        let (mut instance, table, told) = initialised(BENT);
        set(&mut instance, &table, name, bad);
        assert_eq!(search(&mut instance, &table), REFUSED);
        instance.save(1);
        let bytes = instance.serialised(1).unwrap();
        assert_eq!(instance.reset(), Ending::Ok);
        assert_eq!(instance.deserialise(2, &bytes), Ending::Ok, "{}", last(&told));
        assert_eq!(instance.restore(2), Ending::Ok);
        assert_eq!(search(&mut instance, &table), REFUSED);
        assert_eq!(instance.do_step(0.0, 0.1), Ending::Error);
        assert_eq!(set(&mut instance, &table, name, good), Ending::Ok);
        assert_eq!(instance.do_step(0.0, 0.1), Ending::Ok, "{}", last(&told));
    }
}

#[test]
fn in_model_exchange_a_refused_trial_leaves_the_accepted_shape() {
    let package = mcm::fmi::Package::new(BENT, "test scene", 5).unwrap();
    let (mut instance, table, told) = {
        let (mut instance, package, told) = instance_for(Interface::ModelExchange, package);
        instance.enter_initialization();
        assert_eq!(instance.exit_initialization(), Ending::Ok);
        (instance, package.table().clone(), told)
    };
    assert_eq!(instance.enter_continuous_time_mode(), Ending::Ok);
    let angle = get(&mut instance, &table, "tip.angle");
    for (name, bad, good) in [("field.uniform[2]", f64::NAN, 0.01), ("base.orientation[1]", 0.3, 1.0)] {
        set(&mut instance, &table, name, bad);
        assert_eq!(search(&mut instance, &table), REFUSED, "{name}");
        assert_eq!(get(&mut instance, &table, "tip.angle").to_bits(), angle.to_bits());
        assert_eq!(instance.completed_integrator_step(), Err(Ending::Error), "{}", last(&told));
        assert_eq!(set(&mut instance, &table, name, good), Ending::Ok);
        assert_eq!(search(&mut instance, &table), SOLVED);
        assert_eq!(instance.completed_integrator_step(), Ok(false), "{}", last(&told));
    }
}

#[test]
fn a_read_without_equilibrium_accepts_new_inputs() {
    let (mut instance, table, told) = initialised(SHUT);
    let angle = get(&mut instance, &table, "tip.angle");
    assert_eq!(set(&mut instance, &table, "field.uniform[2]", 0.06), Ending::Ok);
    for _ in 0..2 {
        assert_eq!(instance.get(&[reference(&table, "tip.angle")], "Real", Value::real), Err(Ending::Error));
        assert!(
            last(&told).contains("% of the way") && last(&told).contains("set other inputs"),
            "{}",
            last(&told)
        );
        assert_eq!(search(&mut instance, &table)[0], 3);
        assert_eq!(instance.state(), State::Stepping);
    }
    assert_eq!(set(&mut instance, &table, "field.uniform[2]", 0.02), Ending::Ok);
    assert_close("angle", &[get(&mut instance, &table, "tip.angle")], &[angle], SAME_SHAPE);
    assert_eq!(instance.do_step(0.0, 0.1), Ending::Ok, "{}", last(&told));
    // A step there fails, whether the inputs were tried before or not.
    for tried in [false, true] {
        instance.save(1);
        assert_eq!(set(&mut instance, &table, "field.uniform[2]", 0.06), Ending::Ok);
        if tried {
            assert!(instance.get(&[reference(&table, "tip.angle")], "Real", Value::real).is_err());
        }
        assert_eq!(instance.do_step(0.1, 0.1), Ending::Error);
        assert!(last(&told).contains("the last good outputs can be read"), "{}", last(&told));
        assert_eq!(instance.state(), State::Failed);
        assert_close("angle", &[get(&mut instance, &table, "tip.angle")], &[angle], SAME_SHAPE);
        assert_eq!(instance.restore(1), Ending::Ok);
    }
}

#[test]
fn orientations_of_any_clear_norm_are_normalised_and_the_log_says_so_once() {
    let (mut unit, table, _) = initialised(BENT);
    let half = 7.5_f64.to_radians() / 2.0;
    for (component, value) in [(1, half.cos()), (2, half.sin())] {
        set(&mut unit, &table, &format!("base.orientation[{component}]"), value);
    }
    let expected = ["tip.position[2]", "tip.angle"].map(|name| get(&mut unit, &table, name));
    let exact = quaternion_columns(&mut unit, &table);
    for norm in [0.51, half.cos(), 1.01, 1.99] {
        let (mut instance, table, told) = initialised(BENT);
        for step in 0..2 {
            for (component, value) in [(1, norm * half.cos()), (2, norm * half.sin())] {
                set(&mut instance, &table, &format!("base.orientation[{component}]"), value);
            }
            assert_eq!(instance.do_step(f64::from(step), 1.0), Ending::Ok, "{}", last(&told));
        }
        let found = ["tip.position[2]", "tip.angle"].map(|name| get(&mut instance, &table, name));
        assert_close(norm, &found, &expected, SAME_SHAPE);
        let said = told.lock().unwrap().iter().filter(|line| line.contains("normalised")).count();
        assert_eq!(said, 1, "norm {norm}: {:?}", told.lock().unwrap());
        // The shape depends on the direction alone: derivatives fall with the norm, and along the quaternion they vanish.
        let columns = quaternion_columns(&mut instance, &table);
        let scaled: Vec<f64> = exact.iter().map(|rate| rate / norm).collect();
        assert_close(norm, &columns, &scaled, SAME_SHAPE);
        let along = columns[0] * half.cos() + columns[1] * half.sin();
        assert!(along.abs() < SAME_SHAPE * columns[1].abs(), "{along} {columns:?}");
    }
}

/// Derivatives of `tip.position[2]` by the components of the base's quaternion.
fn quaternion_columns(instance: &mut Instance, table: &Table) -> Vec<f64> {
    let of = [reference(table, "tip.position[2]")];
    let column = |component| {
        let by = [reference(table, &format!("base.orientation[{component}]"))];
        instance.directional_derivative(&of, &by, &[1.0]).unwrap()[0]
    };
    (1..=4).map(column).collect()
}

#[test]
fn an_orientation_that_is_hardly_there_is_not_connected() {
    let scene = format!("{BENT}\n[magnet]\n");
    let (mut connected, table, _) = initialised(&scene);
    let expected = get(&mut connected, &table, "tip.angle");
    let (mut instance, package, told) = instance(&scene);
    let table = package.table();
    for component in 1..=4 {
        for name in ["magnet.orientation", "base.orientation"] {
            set(&mut instance, table, &format!("{name}[{component}]"), 0.0);
        }
    }
    let (mut instance, table, told) = started((instance, package, told));
    for component in 1..=4 {
        let name = format!("magnet.orientation[{component}]");
        assert_eq!(set(&mut instance, &table, &name, 1e-8), Ending::Ok, "as for a difference");
        assert_eq!(get(&mut instance, &table, "tip.angle").to_bits(), expected.to_bits(), "{}", last(&told));
        let (of, by) = ([reference(&table, "tip.angle")], [reference(&table, &name)]);
        assert_eq!(instance.directional_derivative(&of, &by, &[1.0]), Ok(vec![0.0]), "its start value holds");
        assert_eq!(set(&mut instance, &table, &name, 0.0), Ending::Ok);
    }
    // A magnet that is switched off is no body, also where its strength is varied.
    for (name, value) in [("magnet.strength", 0.0), ("magnet.position[2]", 0.0), ("magnet.position[3]", 0.0)]
    {
        assert_eq!(set(&mut instance, &table, name, value), Ending::Ok);
    }
    let off = get(&mut instance, &table, "tip.angle");
    for strength in [1e-8, -1e-8] {
        assert_eq!(set(&mut instance, &table, "magnet.strength", strength), Ending::Ok);
        assert_close("off", &[get(&mut instance, &table, "tip.angle")], &[off], SAME_SHAPE);
    }
    assert_eq!(set(&mut instance, &table, "magnet.strength", 0.0), Ending::Ok);
    for (norm, connected) in [(0.0009, false), (0.0011, true), (0.49, true), (2.01, true)] {
        assert_eq!(set(&mut instance, &table, "magnet.orientation[2]", norm), Ending::Ok);
        assert_eq!(search(&mut instance, &table) == REFUSED, connected, "{norm}");
    }
}

#[test]
fn times_that_are_refused_keep_a_run_from_beginning() {
    let (mut instance, package, told) = instance(BENT);
    for (start, stop) in [(f64::NAN, None), (f64::INFINITY, None), (0.0, Some(f64::NAN)), (1.0, Some(0.5))] {
        assert_eq!(instance.setup_experiment(start, stop), Ending::Error);
        assert_eq!(instance.time().to_bits(), 0, "nothing of it is kept");
        assert_eq!(instance.enter_initialization(), Ending::Error);
        assert!(last(&told).contains("start or stop time was refused"), "{}", last(&told));
    }
    assert_eq!(instance.setup_experiment(1.0, Some(2.0)), Ending::Ok);
    assert_eq!(instance.enter_initialization(), Ending::Ok);
    assert_eq!(instance.exit_initialization(), Ending::Ok);
    assert_eq!(instance.do_step(1.0, 0.5), Ending::Ok, "{}", last(&told));
    assert!(get(&mut instance, package.table(), "tip.angle") > EFFECT);
}

#[test]
fn numbers_that_nothing_physical_has_are_out_of_range_and_no_fold() {
    let package = mcm::fmi::Package::built_in().unwrap();
    for variable in package.table().variables().iter().filter(|variable| !variable.is_result()) {
        for number in [1e308, -1e308, 1e155] {
            let refused = variable.check(Value::Real(number)).unwrap_err().to_string();
            let real = matches!(variable.data_type, mcm::fmi::value::DataType::Real(_));
            assert!(
                !real || refused.contains(&variable.name) && refused.contains("must be from -"),
                "{refused}"
            );
        }
    }
}
