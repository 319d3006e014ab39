//! Further magnets and coils of an FMU, orientations that nothing is connected to, and states of runs that have ended.

use mcm::fmi::state::{Ending, State};
use mcm::fmi::value::Value;

use super::instance::{get, initialised, reference, set, started};
use super::{BENT, instance, last};

const SCENE: &str = "[design]
segments = 1
[[magnet]]
[[magnet]]
position_mm = [60.0, 60.0, 0.0]
cylinders = [{ radius_mm = 10.0, length_mm = 10.0, remanence_t = 1.2 }]
[[coil]]
position_mm = [-60.0, 60.0, 0.0]
inner_radius_mm = 10.0
outer_radius_mm = 20.0
length_mm = 30.0
turns = 600
current_a = 1.5
[model]
interaction = \"rings\"
";

#[test]
fn further_sources_are_moved_and_answer() {
    let (mut instance, table, _) = initialised(SCENE);
    let start = get(&mut instance, &table, "tip.angle");
    assert_eq!(get(&mut instance, &table, "coil[1].current").to_bits(), 1.5_f64.to_bits());
    assert_eq!(set(&mut instance, &table, "coil[1].current", 9.0), Ending::Ok);
    let with_current = get(&mut instance, &table, "tip.angle");
    assert!((with_current - start).abs() > 1e-5, "{start} {with_current}");
    assert_eq!(set(&mut instance, &table, "magnet[2].position[1]", 0.05), Ending::Ok);
    assert_eq!(instance.do_step(0.0, 0.1), Ending::Ok);
    assert!((get(&mut instance, &table, "tip.angle") - with_current).abs() > 1e-6);
    let sum: f64 =
        ["magnet", "magnet[2]", "coil[1]", "force"]
            .map(|name| {
                if name == "force" { "force.magnetic[2]".into() } else { format!("{name}.reaction_force[2]") }
            })
            .iter()
            .map(|name| get(&mut instance, &table, name))
            .sum();
    assert!(sum.abs() < 1e-12, "{sum}");
}

#[test]
fn the_wrench_on_one_another_is_told_where_it_is_asked_for() {
    let (_, table, _) = initialised(SCENE);
    assert!(table.reference("magnet.mutual_force[1]").is_none(), "not asked for");
    let (mut instance, table, told) = initialised(&format!("{SCENE}mutual_wrenches = true\n"));
    let force = |instance: &mut mcm::fmi::Instance| {
        ["magnet", "magnet[2]", "coil[1]"]
            .map(|of| [1, 2, 3].map(|axis| get(instance, &table, &format!("{of}.mutual_force[{axis}]"))))
    };
    let before = force(&mut instance);
    for axis in 0..3 {
        let sum: f64 = before.iter().map(|own| own[axis]).sum();
        assert!(sum.abs() < 1e-12, "{before:?}");
    }
    assert!(before[0][0].abs() > 1e-3, "{before:?}");
    assert!(get(&mut instance, &table, "coil[1].mutual_torque[1]").abs() > 1e-6);
    // The force on a coil is proportional to its current, also where nothing has stepped in between.
    assert_eq!(set(&mut instance, &table, "coil[1].current", 3.0), Ending::Ok);
    let after = force(&mut instance);
    for (before, after) in before[2].iter().zip(after[2]) {
        assert!((after - 2.0 * before).abs() < 1e-9 * before.abs().max(1e-6), "{before} {after}");
    }
    assert_eq!(instance.do_step(0.0, 0.1), Ending::Ok, "{}", last(&told));
    assert_eq!(force(&mut instance), after);
    // It depends on magnets and coils alone.
    let output = table.find(reference(&table, "magnet[2].mutual_force[1]")).unwrap();
    let depends = |name: &str| output.depends_on(table.find(reference(&table, name)).unwrap()).is_some();
    for name in
        ["magnet.position[2]", "magnet.strength", "coil[1].current", "magnet.design.cylinder[1].radius"]
    {
        assert!(depends(name), "{name}");
    }
    for name in ["base.position[1]", "field.uniform[1]", "design.ring.length", "tip.load_force[1]"] {
        assert!(!depends(name), "{name}");
    }
}

#[test]
fn their_derivatives_are_those_of_solves_beside() {
    for (name, step) in [
        ("magnet[2].position[2]", 1e-4),
        ("magnet[2].orientation[1]", 1e-4),
        ("magnet[2].strength", 1e-3),
        ("coil[1].position[1]", 1e-4),
        ("coil[1].orientation[3]", 1e-4),
        ("coil[1].current", 1e-2),
    ] {
        let (mut instance, table, _) = initialised(SCENE);
        let outputs = ["tip.position[2]", "coil[1].reaction_torque[1]", "magnet[2].reaction_force[1]"];
        let known = reference(&table, name);
        let unknowns = outputs.map(|output| reference(&table, output));
        let exact = instance.directional_derivative(&unknowns, &[known], &[1.0]).unwrap();
        let here = get(&mut instance, &table, name);
        let mut at = |by: f64| {
            assert_eq!(set(&mut instance, &table, name, here + by), Ending::Ok);
            // A quaternion stands for the rotation that it describes when it is normalised.
            if let Some(stem) = name.strip_suffix("]").and_then(|rest| rest.strip_suffix(['1', '3']))
                && stem.contains("orientation")
            {
                let names: Vec<String> = (1..5).map(|i| format!("{stem}{i}]")).collect();
                let values: Vec<f64> = names.iter().map(|name| get(&mut instance, &table, name)).collect();
                let norm = values.iter().map(|v| v * v).sum::<f64>().sqrt();
                for (name, value) in names.iter().zip(&values) {
                    set(&mut instance, &table, name, value / norm);
                }
                let found = outputs.map(|output| get(&mut instance, &table, output));
                for (name, value) in names.iter().zip(&values) {
                    set(&mut instance, &table, name, *value);
                }
                return found;
            }
            outputs.map(|output| get(&mut instance, &table, output))
        };
        let (plus, minus) = (at(step), at(-step));
        for ((exact, plus), (minus, output)) in exact.iter().zip(plus).zip(minus.iter().zip(outputs)) {
            let differences = (plus - minus) / (2.0 * step);
            let size = exact.abs().max(1e-7 / step * exact.abs()).max(1e-9);
            assert!((exact - differences).abs() < 2e-3 * size, "{output} by {name}: {exact} {differences}");
        }
    }
}

#[test]
fn four_zeros_leave_an_orientation_as_it_starts() {
    let scene = format!("{BENT}\n[magnet]\n");
    let (mut connected, table, _) = initialised(&scene);
    let expected = get(&mut connected, &table, "tip.angle");
    let (mut instance, package, told) = instance(&scene);
    for name in ["magnet.orientation", "base.orientation"] {
        for component in 1..=4 {
            let name = format!("{name}[{component}]");
            assert_eq!(set(&mut instance, package.table(), &name, 0.0), Ending::Ok);
        }
    }
    let (mut instance, table, told) = started((instance, package, told));
    assert_eq!(get(&mut instance, &table, "tip.angle").to_bits(), expected.to_bits());
    for step in 0..3 {
        assert_eq!(set(&mut instance, &table, "magnet.position[1]", 0.001 * f64::from(step)), Ending::Ok);
        assert_eq!(instance.do_step(0.1 * f64::from(step), 0.1), Ending::Ok);
    }
    let said = told.lock().unwrap().iter().filter(|line| line.contains("four zeros")).count();
    assert_eq!(said, 1, "told once");
    let by = ["magnet.orientation[1]", "magnet.position[2]"].map(|name| reference(&table, name));
    let of = reference(&table, "tip.angle");
    assert!(instance.directional_derivative(&[of], &by, &[1.0, 1.0]).unwrap()[0].is_finite());
    // A quaternion that is there is still refused where its norm is far from one.
    assert_eq!(set(&mut instance, &table, "magnet.orientation[1]", 0.1), Ending::Ok);
    assert_eq!(instance.do_step(0.3, 0.1), Ending::Error);
}

#[test]
fn a_state_of_a_run_that_has_ended_goes_on_in_a_longer_one() {
    let run = |stop: f64| {
        let (mut instance, package, told) = instance(BENT);
        assert_eq!(instance.setup_experiment(0.0, Some(stop)), Ending::Ok);
        assert_eq!(instance.enter_initialization(), Ending::Ok);
        assert_eq!(instance.exit_initialization(), Ending::Ok, "{}", last(&told));
        (instance, package, told)
    };
    let (mut short, ..) = run(0.1);
    assert_eq!(short.do_step(0.0, 0.1), Ending::Ok);
    assert_eq!(short.save(1), Ending::Ok);
    let bytes = short.serialised(1).unwrap();
    assert_eq!(short.do_step(0.1, 0.1), Ending::Error, "its own stop time holds");
    let (mut long, ..) = run(1.0);
    assert_eq!(long.deserialise(1, &bytes), Ending::Ok);
    assert_eq!(long.restore(1), Ending::Ok);
    assert_eq!(long.do_step(0.1, 0.5), Ending::Ok);
    assert_eq!(long.do_step(0.6, 0.5), Ending::Error, "beyond its stop time");
}

#[test]
fn messages_have_no_words_of_the_language() {
    let (mut instance, _, told) = instance(BENT);
    for call in mcm::fmi::state::ALLOWED.iter().map(|row| row.0) {
        let _ = instance.allows(call, "fmi2Call");
    }
    assert_eq!(instance.enter_initialization(), Ending::Ok);
    let (table, reals) = (instance_table(), ["tip.angle", "stability.stable", "model.interaction"]);
    for name in reals {
        for value in [Value::Real(1.0), Value::Integer(77), Value::Boolean(true)] {
            let _ = instance.set(&[reference(&table, name)], [value].into_iter());
        }
    }
    assert_eq!(instance.exit_initialization(), Ending::Error, "values were refused");
    assert_eq!(instance.reset(), Ending::Ok);
    assert_eq!(instance.enter_initialization(), Ending::Ok);
    assert_eq!(instance.exit_initialization(), Ending::Ok);
    assert_eq!(instance.terminate(), Ending::Ok);
    let _ = instance.allows(mcm::fmi::state::Call::DoStep, "fmi2DoStep");
    let said = told.lock().unwrap().join("\n");
    assert!(
        said.contains("is not allowed before initialisation") && said.contains("after termination"),
        "{said}"
    );
    for state in [State::Instantiated, State::Initialization, State::Stepping, State::Terminated] {
        assert!(!said.contains(&format!("{state:?}")), "{said}");
    }
    assert!(!said.contains("Real(") && !said.contains("Integer(") && !said.contains("Some("), "{said}");
}

fn instance_table() -> mcm::fmi::variables::Table {
    instance(BENT).1.table().clone()
}

/// The numbers of a magnet that is given by its shape are parameters; a direction that is no unit vector is refused by its name.
#[test]
fn a_shape_is_set_by_its_parameters() {
    const CUBOID: &str = "[design]\nsegments = 1\n[magnet]\nposition_mm = [0, -60, 3]\nshape = \"cuboid\"\n\
                          size_mm = [20, 20, 10]\nremanence_t = 1.2\n[model]\ninteraction = \"rings\"\n";
    let angle = |scene: &str, changes: &[(&str, f64)]| {
        let (mut instance, package, _) = instance(scene);
        let table = package.table().clone();
        for (name, value) in changes {
            assert_eq!(set(&mut instance, &table, name, *value), Ending::Ok, "{name}");
        }
        assert_eq!(instance.setup_experiment(0.0, None), Ending::Ok);
        assert_eq!(instance.enter_initialization(), Ending::Ok);
        match instance.exit_initialization() {
            Ending::Ok => Some(get(&mut instance, &table, "tip.angle")),
            _ => None,
        }
    };
    let changes = [
        ("magnet.design.size[3]", 0.015),
        ("magnet.design.direction[2]", 0.6),
        ("magnet.design.direction[3]", -0.8),
        ("magnet.design.remanence", -1.1),
    ];
    let set_anew = angle(CUBOID, &changes).unwrap();
    let stated =
        CUBOID.replace("20, 20, 10", "20, 20, 15").replace("= 1.2", "= -1.1\ndirection = [0, 0.6, -0.8]");
    assert_eq!(set_anew.to_bits(), angle(&stated, &[]).unwrap().to_bits());
    assert!((set_anew - angle(CUBOID, &[]).unwrap()).abs() > 1e-3);
    assert_eq!(angle(CUBOID, &[("magnet.design.direction[3]", 0.5)]), None);
}
