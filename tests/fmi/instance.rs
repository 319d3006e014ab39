//! The life of an instance.

use allocation_counter::measure;
use mcm::equilibrium::Interaction;
use mcm::fmi::state::{Ending, State};
use mcm::fmi::value::Value;
use mcm::fmi::variables::Table;
use mcm::fmi::{Instance, Package};

use super::{BENT, Told, instance, last};
use crate::tolerance::{EFFECT, ROUNDING, SAME_SHAPE, TWO_DECIMALS_DEG, assert_close};

pub(super) fn reference(table: &Table, name: &str) -> u32 {
    table.reference(name).unwrap_or_else(|| panic!("{name}"))
}

pub(super) fn get(instance: &mut Instance, table: &Table, name: &str) -> f64 {
    instance.get(&[reference(table, name)], "Real", Value::real).unwrap()[0]
}

pub(super) fn set(instance: &mut Instance, table: &Table, name: &str, value: f64) -> Ending {
    instance.set(&[reference(table, name)], [Value::Real(value)].into_iter())
}

pub(super) fn initialised(scene: &str) -> (Instance, Table, Told) {
    started(instance(scene))
}

/// An instance from its beginning to the first communication point.
pub(super) fn started((mut instance, package, told): (Instance, Package, Told)) -> (Instance, Table, Told) {
    assert_eq!(instance.setup_experiment(0.0, None), Ending::Ok);
    assert_eq!(instance.enter_initialization(), Ending::Ok);
    assert_eq!(instance.exit_initialization(), Ending::Ok, "{}", last(&told));
    (instance, package.table().clone(), told)
}

#[test]
fn outputs_are_those_of_the_inputs_now_set() {
    let (mut instance, table, _) = initialised(BENT);
    let before = get(&mut instance, &table, "tip.angle");
    assert!(before > 0.1);
    assert_eq!(set(&mut instance, &table, "field.uniform[2]", 0.02), Ending::Ok);
    let bent = get(&mut instance, &table, "tip.angle");
    assert!(bent > before);
    assert_eq!(instance.do_step(0.0, 0.1), Ending::Ok);
    assert_eq!(
        get(&mut instance, &table, "tip.angle").to_bits(),
        bent.to_bits(),
        "the step finds its work done"
    );
    assert_close("time", &[instance.time()], &[0.1], ROUNDING);
}

#[test]
fn reading_does_not_change_the_run() {
    let run = |reads: bool| {
        let (mut instance, table, _) = initialised(BENT);
        for step in 0..5 {
            let field = 0.01 + 0.002 * f64::from(step);
            assert_eq!(set(&mut instance, &table, "field.uniform[2]", field), Ending::Ok);
            if reads {
                get(&mut instance, &table, "tip.angle");
            }
            assert_eq!(instance.do_step(0.1 * f64::from(step), 0.1), Ending::Ok);
        }
        get(&mut instance, &table, "tip.angle").to_bits()
    };
    assert_eq!(run(true), run(false));
}

#[test]
fn bad_values_are_refused_by_name_and_the_instance_goes_on() {
    let (mut instance, table, told) = initialised(BENT);
    let angle = get(&mut instance, &table, "tip.angle");
    assert_eq!(set(&mut instance, &table, "magnet.position[1]", f64::NAN), Ending::Error);
    assert!(last(&told).contains("magnet.position[1] = NaN"), "{}", last(&told));
    assert_eq!(instance.do_step(0.0, 0.1), Ending::Error, "a value was refused");
    assert!(last(&told).contains("the last value of magnet.position[1] was refused"), "{}", last(&told));
    assert_eq!(set(&mut instance, &table, "magnet.position[1]", 0.0), Ending::Ok);
    assert_eq!(set(&mut instance, &table, "base.orientation[2]", 5.0), Ending::Ok, "component by component");
    assert_eq!(instance.do_step(0.0, 0.1), Ending::Error);
    assert!(last(&told).contains("base.orientation"), "{}", last(&told));
    assert_eq!(set(&mut instance, &table, "base.orientation[2]", 0.0), Ending::Ok);
    assert_eq!(instance.do_step(0.0, 0.1), Ending::Ok);
    assert_close("tip angle", &[get(&mut instance, &table, "tip.angle")], &[angle], SAME_SHAPE);
}

#[test]
fn wrong_references_and_types_are_refused_whole() {
    let (mut instance, table, told) = initialised(BENT);
    let strength = reference(&table, "magnet.strength");
    let ending = instance.set(&[strength, 123_456], [Value::Real(0.5), Value::Real(0.5)].into_iter());
    assert_eq!(ending, Ending::Error);
    assert!(last(&told).contains("123456"), "{}", last(&told));
    assert_eq!(
        get(&mut instance, &table, "magnet.strength").to_bits(),
        0,
        "nothing of a refused call is kept"
    );
    assert_eq!(instance.set(&[strength], [Value::Integer(1)].into_iter()), Ending::Error);
    assert_eq!(instance.get(&[reference(&table, "solver.status")], "Real", Value::real), Err(Ending::Error));
    assert!(last(&told).contains("solver.status is not a variable of type Real"), "{}", last(&told));
    let status = set(&mut instance, &table, "tip.angle", 1.0);
    assert_eq!(status, Ending::Error, "{}", last(&told));
    let status = set(&mut instance, &table, "design.helix.length", 0.005);
    assert_eq!(status, Ending::Error, "{}", last(&told));
}

#[test]
fn a_bad_value_in_the_middle_of_a_call_changes_nothing() {
    let (mut instance, package, told) = instance(BENT);
    let table = package.table();
    instance.enter_initialization();
    let of = |name: &str| reference(table, name);
    let (strength, length, stop) =
        (of("magnet.strength"), of("design.helix.length"), of("model.bending_stop"));
    let (level, angle) = (of("model.interaction"), of("tip.angle"));
    let state = |instance: &mut Instance| {
        let reals = instance.get(&[strength, length], "Real", Value::real).unwrap();
        let truth = instance.get(&[stop], "Boolean", Value::boolean).unwrap();
        (reals, truth, instance.get(&[level], "Enumeration", Value::integer).unwrap())
    };
    let before = state(&mut instance);
    let good = [Value::Real(0.5), Value::Real(0.0045), Value::Boolean(true)];
    let bad = [
        (strength, Value::Real(f64::NAN), "magnet.strength = NaN"),
        (strength, Value::Boolean(true), "magnet.strength is not of type Boolean"),
        (level, Value::Integer(99), "model.interaction has no item 99"),
        (angle, Value::Real(0.1), "tip.angle (output) cannot be set"),
        (u32::MAX, Value::Real(0.1), "no variable"),
    ];
    for (reference, value, reason) in bad {
        let references = [strength, length, reference, stop];
        let values = [good[0], good[1], value, good[2]];
        assert_eq!(instance.set(&references, values.into_iter()), Ending::Error);
        assert!(last(&told).contains(reason), "{}", last(&told));
        assert_eq!(state(&mut instance), before, "{reason}");
    }
    for (order, rate) in [(0, 1.0), (1, f64::INFINITY)] {
        let (orders, rates) = ([1, order, 1], [0.1, rate, 0.1]);
        assert_eq!(instance.set_input_derivatives(&[strength; 3], &orders, &rates), Ending::Error);
        assert_eq!(state(&mut instance), before, "{}", last(&told));
    }
    assert_eq!(set(&mut instance, table, "magnet.strength", 1.0), Ending::Ok);
    assert_eq!(instance.set(&[strength, length, stop], good.into_iter()), Ending::Ok);
    assert_ne!(state(&mut instance), before);
}

#[test]
fn the_level_decides_about_the_bending_stop_until_it_is_set() {
    for (scene, asked, level, acts) in [
        ("", None, None, true),
        ("[model]\ninteraction = \"rings\"", None, None, false),
        ("[model]\nbending_stop = false", None, None, false),
        ("", None, Some(Interaction::Rings), false),
        ("[model]\ninteraction = \"rings\"", None, Some(Interaction::Auto), true),
        ("[model]\nbending_stop = true", None, Some(Interaction::Rings), true),
        ("", Some(false), None, false),
        ("", Some(true), Some(Interaction::Rings), true),
        ("[model]\nbending_stop = true", Some(false), Some(Interaction::Full), false),
    ] {
        let (mut instance, package, told) = instance(&format!("{scene}\n[design]\nsegments = 1"));
        let of = |name: &str| [reference(package.table(), name)];
        if let Some(asked) = asked {
            let set = instance.set(&of("model.bending_stop"), [Value::Boolean(asked)].into_iter());
            assert_eq!(set, Ending::Ok, "{}", last(&told));
        }
        if let Some(level) = level {
            let set = instance.set(&of("model.interaction"), [Value::Integer(level as i32)].into_iter());
            assert_eq!(set, Ending::Ok, "{}", last(&told));
        }
        let shown = instance.get(&of("model.bending_stop"), "Boolean", Value::boolean).unwrap()[0];
        assert_eq!(shown, acts, "{scene:?}, {asked:?}, {level:?}");
    }
}

#[test]
fn a_refused_design_names_the_parameter() {
    for (name, value) in [
        ("design.helix.shore_a", -5.0),
        ("design.helix.length", 4.5),
        ("model.time_budget", 0.0),
        ("design.spiral_start[2]", 7.0),
    ] {
        let (mut instance, package, told) = instance("[design]\nsegments = 2");
        let table = package.table();
        assert_eq!(set(&mut instance, table, name, value), Ending::Ok);
        instance.enter_initialization();
        assert_eq!(instance.exit_initialization(), Ending::Error);
        assert!(last(&told).contains(name), "{}", last(&told));
    }
}

#[test]
fn setting_a_variable_copies_nothing_else() {
    let (mut instance, table, _) = initialised(BENT);
    let (strength, ring) = (reference(&table, "magnet.strength"), reference(&table, "ring[1].load_force[1]"));
    for value in [0.5, 0.25] {
        let values = [Value::Real(value); 2].into_iter();
        let set = measure(|| assert_eq!(instance.set(&[strength, ring], values), Ending::Ok));
        assert_eq!(set.count_total, 0, "allocations");
    }
}

#[test]
fn parameters_are_checked_at_the_end_of_initialisation() {
    let (mut instance, package, told) = instance(BENT);
    let table = package.table();
    instance.enter_initialization();
    assert_eq!(set(&mut instance, table, "design.helix.core_inner_radius", 0.003), Ending::Ok);
    assert_eq!(instance.exit_initialization(), Ending::Error);
    assert_eq!(instance.state(), State::Initialization, "{}", last(&told));
    assert_eq!(set(&mut instance, table, "design.helix.core_inner_radius", 0.0007), Ending::Ok);
    assert_eq!(instance.exit_initialization(), Ending::Ok, "{}", last(&told));
    let soft = get(&mut instance, table, "tip.angle");
    instance.reset();
    instance.enter_initialization();
    let reference_angle = get(&mut instance, table, "tip.angle");
    assert!((soft - reference_angle).abs() > EFFECT, "the parameter had an effect, and reset took it back");
}

#[test]
fn the_first_equilibrium_does_not_depend_on_what_was_read_before() {
    let run = |reads: bool| {
        let (mut instance, package, _) = instance(BENT);
        instance.enter_initialization();
        if reads {
            set(&mut instance, package.table(), "field.uniform[1]", 0.02);
            get(&mut instance, package.table(), "tip.angle");
            set(&mut instance, package.table(), "field.uniform[1]", 0.0);
        }
        assert_eq!(instance.exit_initialization(), Ending::Ok);
        get(&mut instance, package.table(), "tip.angle").to_bits()
    };
    assert_eq!(run(true), run(false));
}

#[test]
fn a_saved_state_repeats_the_run() {
    let (mut instance, table, told) = initialised(BENT);
    instance.save(7);
    let run = |instance: &mut Instance| {
        assert_eq!(set(instance, &table, "field.uniform[2]", 0.017), Ending::Ok);
        assert_eq!(instance.do_step(0.0, 0.5), Ending::Ok);
        (get(instance, &table, "tip.angle").to_bits(), instance.time().to_bits())
    };
    let first = run(&mut instance);
    assert_eq!(instance.restore(7), Ending::Ok);
    assert_eq!(run(&mut instance), first);
    assert_eq!(instance.restore(8), Ending::Error);
    assert!(last(&told).contains("FMU state"));
    assert_eq!(instance.forget(7), Ending::Ok);
    assert_eq!(instance.forget(7), Ending::Error);
}

#[test]
fn times_are_compared_with_slack_and_strange_ones_refused() {
    let (mut instance, package, told) = instance(BENT);
    assert_eq!(instance.setup_experiment(1.0, Some(0.0)), Ending::Error);
    assert_eq!(instance.setup_experiment(f64::NAN, None), Ending::Error);
    assert_eq!(instance.setup_experiment(0.0, Some(0.3)), Ending::Ok);
    instance.enter_initialization();
    assert_eq!(instance.exit_initialization(), Ending::Ok);
    let quiet = told.lock().unwrap().len();
    assert_eq!(instance.do_step(0.0, 0.1), Ending::Ok);
    assert_eq!(instance.do_step(0.1, 0.1), Ending::Ok);
    assert_eq!(instance.do_step(0.2, 0.099_999_999_999_999_98), Ending::Ok);
    assert_eq!(told.lock().unwrap().len(), quiet, "{}", last(&told));
    for (time, step) in [(f64::NAN, 0.1), (0.3, f64::INFINITY), (0.3, -0.1), (0.3, 0.1)] {
        assert_eq!(instance.do_step(time, step), Ending::Error, "{time} {step}");
    }
    assert_eq!(instance.do_step(0.05, 0.1), Ending::Ok, "another time than expected");
    assert!(last(&told).starts_with("logStatusWarning: step from t = 0.05"), "{}", last(&told));
    assert!(get(&mut instance, package.table(), "tip.angle") > 0.1);
}

#[test]
fn after_a_panic_a_reset_gives_a_fresh_start() {
    let (mut instance, table, told) = initialised(BENT);
    let angle = get(&mut instance, &table, "tip.angle").to_bits();
    instance.save(1);
    assert_eq!(instance.break_down("for the test"), Ending::Error);
    assert!(last(&told).contains("for the test"));
    assert_eq!(instance.state(), State::Broken);
    assert_eq!(instance.reset(), Ending::Ok);
    assert_eq!(instance.restore(1), Ending::Error, "nothing from before is trusted");
    instance.enter_initialization();
    assert_eq!(instance.exit_initialization(), Ending::Ok);
    assert_eq!(get(&mut instance, &table, "tip.angle").to_bits(), angle);
}

#[test]
fn log_categories_are_those_declared() {
    let (mut instance, _, told) = instance(BENT);
    assert_eq!(instance.set_debug_logging(true, &[]), Ending::Ok);
    assert_eq!(instance.set_debug_logging(true, &["logEvents", "logAll"]), Ending::Ok);
    assert_eq!(instance.set_debug_logging(true, &["logNothing"]), Ending::Error);
    assert!(last(&told).contains("logNothing"));
}

#[test]
fn a_step_that_ends_nowhere_is_refused() {
    let (mut instance, _, told) = initialised(BENT);
    for (time, step) in [(1e308, 1e308), (0.0, f64::INFINITY), (f64::NAN, 0.1), (0.0, -0.1)] {
        assert_eq!(instance.do_step(time, step), Ending::Error);
        assert!(
            last(&told).contains("both must be finite, and the step size not negative"),
            "{}",
            last(&told)
        );
    }
    assert_eq!(instance.time().to_bits(), 0);
    assert_eq!(instance.do_step(0.0, 0.1), Ending::Ok);
}

#[test]
fn spirals_are_turned_by_parameters() {
    const SCENE: &str = "[design]\nsegments = 2\n[magnet]\nstrength = 0.0\n[model]\ninteraction = \"full\"\n";
    let start = |turn: f64| {
        let (mut instance, package, told) = instance(SCENE);
        let table = package.table().clone();
        assert_eq!(instance.setup_experiment(0.0, None), Ending::Ok);
        assert_eq!(set(&mut instance, &table, "design.spiral_start[2]", turn), Ending::Ok, "{}", last(&told));
        assert_eq!(instance.enter_initialization(), Ending::Ok);
        let ending = instance.exit_initialization();
        (instance, table, told, ending)
    };
    let angle = |turn: f64| {
        let (mut instance, table, told, ending) = start(turn);
        assert_eq!(ending, Ending::Ok, "{}", last(&told));
        get(&mut instance, &table, "tip.angle").to_degrees()
    };
    let (aligned, opposite) = (angle(0.0), angle(core::f64::consts::PI));
    assert!((aligned - 2.11).abs() <= TWO_DECIMALS_DEG, "{aligned} deg");
    assert!((opposite - 0.07).abs() <= TWO_DECIMALS_DEG, "{opposite} deg");
    let (_, _, told, ending) = start(7.0);
    assert_eq!(ending, Ending::Error);
    let message = last(&told);
    assert!(message.contains("spiral of segment 2 (rad)) = 7 is not allowed"), "{message}");
}

#[test]
fn the_relative_tolerance_can_be_changed_between_steps() {
    let scene =
        "[design]\nsegments = 2\n[field]\nuniform_mt = [0.0, 4.0, 0.0]\n[model]\ntolerance_relative = 0.0\n";
    let (mut instance, table, _) = initialised(scene);
    let estimate = |instance: &mut Instance| get(instance, &table, "model.error_estimate");
    let before = estimate(&mut instance);
    assert_eq!(set(&mut instance, &table, "model.tolerance_relative", 1e-5), Ending::Ok);
    assert_eq!(instance.do_step(0.0, 0.1), Ending::Ok);
    let after = estimate(&mut instance);
    let way = get(&mut instance, &table, "tip.position[2]");
    assert!(way > 1e-4 && before > 1e-5 * way && after <= 1.1e-5 * way, "{before}, {after}, {way}");
    assert_eq!(set(&mut instance, &table, "model.tolerance_relative", -1.0), Ending::Ok);
    assert_eq!(instance.do_step(0.1, 0.1), Ending::Error);
}
