//! How calls end: for a host that takes every status but OK for a failure, and for one that wants to know why.

use mcm::fmi::Instance;
use mcm::fmi::state::{Ending, State};
use mcm::fmi::value::Value;
use mcm::fmi::variables::Table;

use super::instance::{get, initialised, reference, set};
use super::{BENT, instance, last};

/// Nine segments, and the paper's pair of magnets that passes by with its field against them, and comes back.
const PASSING: &str = "[design]\nsegments = 9\n[magnet]\nposition_mm = [0, -120, -80]\nturn_deg = 180\n\
                       [model]\ninteraction = \"none\"";

/// The attraction of rings and helix pulls one segment shut at 35.83 mT.
const SHUT: &str =
    "[design]\nsegments = 1\n[model]\ninteraction = \"full\"\n[field]\nuniform_mt = [0, 60, 0]";

fn whole(instance: &mut Instance, table: &Table, name: &str) -> i32 {
    instance.get(&[reference(table, name)], "Integer", Value::integer).unwrap()[0]
}

fn truth(instance: &mut Instance, table: &Table, name: &str) -> bool {
    instance.get(&[reference(table, name)], "Boolean", Value::boolean).unwrap()[0]
}

#[test]
fn a_host_that_wants_ok_alone_runs_through_snaps_and_back() {
    const STEPS: i32 = 60;
    let (mut instance, table, told) = initialised(PASSING);
    let place = |step: i32| -0.08 + 0.15 * f64::from(STEPS - (STEPS - step).abs()) / f64::from(STEPS);
    let (mut snapped, mut near) = (0, 0);
    for step in 1..=2 * STEPS {
        assert_eq!(set(&mut instance, &table, "magnet.position[3]", place(step)), Ending::Ok);
        // Every second time the outputs are read first, so that the snap happens in a read.
        if step % 2 == 0 {
            get(&mut instance, &table, "tip.angle");
        }
        let time = instance.time();
        assert_eq!(instance.do_step(time, 0.1), Ending::Ok, "{}", last(&told));
        match whole(&mut instance, &table, "solver.status") {
            2 => snapped += 1,
            1 => near += 1,
            status => assert_eq!(status, 0),
        }
        assert_eq!(get(&mut instance, &table, "solver.progress").to_bits(), 1.0_f64.to_bits());
    }
    assert_eq!(snapped, 2, "one snap each way");
    assert_eq!(whole(&mut instance, &table, "stability.snaps"), 2);
    let said = |word: &str| told.lock().unwrap().iter().filter(|line| line.contains(word)).count();
    assert_eq!(said("logStatusWarning: snapped to another branch"), 2);
    assert_eq!(near > 0, said("logStatusWarning: near a fold") > 0, "{near} steps near a fold");
    assert_eq!(said("logStatusError"), 0);
}

#[test]
fn initialisation_near_a_fold_and_at_a_neutral_shape_is_ok() {
    let against =
        "[design]\nsegments = 3\n[model]\ninteraction = \"none\"\n[field]\nuniform_mt = [0, 0, -20]";
    let (mut instance, table, told) = initialised(against);
    assert_eq!(whole(&mut instance, &table, "solver.outcome"), 1);
    assert!(truth(&mut instance, &table, "stability.neutral"));
    assert!(!truth(&mut instance, &table, "stability.stable"));
    assert!(
        last(&told).starts_with("logStatusWarning: ") && last(&told).contains("neutral"),
        "{}",
        last(&told)
    );
}

#[test]
fn a_first_pose_without_a_solution_says_so_and_promises_nothing() {
    let (mut instance, package, told) = instance(SHUT);
    let table = package.table();
    instance.enter_initialization();
    assert_eq!(instance.exit_initialization(), Ending::Error);
    assert_eq!(instance.state(), State::Failed);
    let said = last(&told);
    assert!(said.contains("no equilibrium found for the first inputs"), "{said}");
    assert!(said.contains("% of the way from the unloaded shape") && !said.contains("last good"), "{said}");
    // What tells of the search can be read, and nothing that would be made up.
    assert_eq!(whole(&mut instance, table, "solver.status"), 3);
    assert!(whole(&mut instance, table, "solver.outcome") >= 2);
    assert_eq!(whole(&mut instance, table, "stability.snaps"), 0);
    assert!((0.0..1.0).contains(&get(&mut instance, table, "solver.progress")));
    for name in ["tip.angle", "force.magnetic[2]", "stability.margin", "ring[1].position[3]"] {
        assert_eq!(instance.get(&[reference(table, name)], "Real", Value::real), Err(Ending::Error));
        assert!(last(&told).contains("no equilibrium was found yet"), "{}", last(&told));
    }
    instance.reset();
    instance.enter_initialization();
    set(&mut instance, table, "field.uniform[2]", 0.02);
    assert_eq!(instance.exit_initialization(), Ending::Ok, "{}", last(&told));
}

#[test]
fn a_first_pose_inside_the_magnet_names_what_touches() {
    let inside = "[design]\nsegments = 3\n[magnet]\nposition_mm = [0, -23, 8]\nstrength = 1e-6\n\
                  [model]\ninteraction = \"none\"";
    let (mut instance, package, told) = instance(inside);
    instance.enter_initialization();
    assert_eq!(instance.exit_initialization(), Ending::Error);
    let said = last(&told);
    assert!(
        said.contains("bodies touch: ring") && said.contains("mm deep in part 2 of the external magnet"),
        "{said}"
    );
    assert_eq!(whole(&mut instance, package.table(), "solver.outcome"), 3);
}

#[test]
fn a_later_failure_keeps_the_last_good_outputs_and_says_why() {
    let (mut instance, table, told) = initialised(&SHUT.replace("60", "20"));
    let angle = get(&mut instance, &table, "tip.angle");
    assert_eq!(set(&mut instance, &table, "field.uniform[2]", 0.06), Ending::Ok);
    instance.save(3);
    assert_eq!(instance.do_step(0.0, 0.1), Ending::Error);
    let said = last(&told);
    assert!(said.contains("% of the way") && said.contains("the last good outputs can be read"), "{said}");
    assert_eq!(get(&mut instance, &table, "tip.angle").to_bits(), angle.to_bits());
    assert_eq!(whole(&mut instance, &table, "solver.status"), 3);
    // A saved state knows whether there is a shape.
    instance.save(4);
    let bytes = instance.serialised(4).unwrap();
    assert_eq!(instance.deserialise(5, &bytes), Ending::Ok, "{}", last(&told));
    assert_eq!(instance.restore(5), Ending::Ok);
    assert_eq!(get(&mut instance, &table, "tip.angle").to_bits(), angle.to_bits());
    assert!(whole(&mut instance, &table, "solver.outcome") >= 2);
}

#[test]
fn a_time_budget_that_is_none_is_refused() {
    let (mut instance, package, told) = instance(BENT);
    instance.enter_initialization();
    assert_eq!(set(&mut instance, package.table(), "model.time_budget", 0.0), Ending::Ok);
    assert_eq!(instance.exit_initialization(), Ending::Error);
    assert!(last(&told).contains("model.time_budget (processor time of a solve (s)) = 0"), "{}", last(&told));
    assert_eq!(set(&mut instance, package.table(), "model.time_budget", 0.5), Ending::Ok);
    assert_eq!(instance.exit_initialization(), Ending::Ok, "{}", last(&told));
}
