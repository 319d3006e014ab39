//! Model exchange: the values of co-simulation, from the last accepted step whatever else is tried.

use mcm::fmi::state::{Call, Ending, Interface, State};
use mcm::fmi::value::Value;
use mcm::fmi::variables::Table;
use mcm::fmi::{Instance, Package};

use super::instance::{get, initialised, reference, set};
use super::{BENT, Told, instance_for, last};

/// Rings in a row turn over against the field of 40 mT, and back at another one.
const SNAPPING: &str = "[design]\nsegments = 9\n[magnet]\nposition_mm = [0, -120, -80]\nturn_deg = 180\n\
                        [model]\ninteraction = \"none\"";

/// The attraction of rings and helix pulls one segment shut at 35.83 mT.
const SHUT: &str =
    "[design]\nsegments = 1\n[model]\ninteraction = \"full\"\n[field]\nuniform_mt = [0, 20, 0]";

/// An instance for model exchange in continuous-time mode.
fn running(scene: &str) -> (Instance, Table, Told) {
    let package = Package::new(scene, "test scene", 5).unwrap();
    let (mut instance, package, told) = instance_for(Interface::ModelExchange, package);
    instance.setup_experiment(0.0, None);
    instance.enter_initialization();
    assert_eq!(instance.exit_initialization(), Ending::Ok, "{}", last(&told));
    assert_eq!(instance.state(), State::Event);
    assert_eq!(instance.new_discrete_states(), Ending::Ok);
    assert_eq!(instance.enter_continuous_time_mode(), Ending::Ok);
    (instance, package.table().clone(), told)
}

fn whole(instance: &mut Instance, table: &Table, name: &str) -> Result<i32, Ending> {
    instance.get(&[reference(table, name)], "Integer", Value::integer).map(|values| values[0])
}

#[test]
fn values_and_derivatives_are_those_of_co_simulation() {
    let (mut stepped, table, _) = initialised(BENT);
    let (mut tried, ..) = running(BENT);
    assert_eq!(set(&mut stepped, &table, "field.uniform[2]", 0.012), Ending::Ok);
    assert_eq!(stepped.do_step(0.0, 0.1), Ending::Ok);
    assert_eq!(set(&mut tried, &table, "field.uniform[2]", 0.012), Ending::Ok);
    for name in ["tip.angle", "tip.position[2]", "shape.position[3,3]", "stability.margin"] {
        assert_eq!(
            get(&mut tried, &table, name).to_bits(),
            get(&mut stepped, &table, name).to_bits(),
            "{name}"
        );
    }
    let derivative = |instance: &mut Instance| {
        let of = [reference(&table, "tip.angle"), reference(&table, "tip.position[3]")];
        instance.directional_derivative(&of, &[reference(&table, "field.uniform[2]")], &[1.0]).unwrap()
    };
    assert_eq!(derivative(&mut tried), derivative(&mut stepped));
}

#[test]
fn what_was_tried_leaves_no_trace() {
    let (mut instance, table, told) = running(&format!("{SNAPPING}\ntime_budget_s = 20.0"));
    let place = |instance: &mut Instance, z: f64| {
        assert_eq!(set(instance, &table, "magnet.position[3]", z), Ending::Ok);
        let angle = instance.get(&[reference(&table, "tip.angle")], "Real", Value::real);
        angle.unwrap_or_else(|_| panic!("{}", last(&told)))[0]
    };
    let here = place(&mut instance, -0.079);
    let beyond = place(&mut instance, 0.07);
    assert_eq!(whole(&mut instance, &table, "stability.snaps"), Ok(1), "the way there leads over a fold");
    assert_eq!(place(&mut instance, -0.079).to_bits(), here.to_bits());
    assert_eq!(place(&mut instance, 0.07).to_bits(), beyond.to_bits());
    assert_eq!(whole(&mut instance, &table, "stability.snaps"), Ok(1), "tried twice, snapped once");
    // Accepted, it is an event, and the past of all that follows.
    assert_eq!(instance.completed_integrator_step(), Ok(true), "{}", last(&told));
    assert_eq!(instance.completed_integrator_step(), Ok(false));
    assert_eq!(instance.enter_event_mode(), Ending::Ok);
    assert_eq!(instance.new_discrete_states(), Ending::Ok);
    let other = place(&mut instance, 0.06);
    assert_ne!(other.to_bits(), beyond.to_bits());
    assert_eq!(whole(&mut instance, &table, "stability.snaps"), Ok(1));
    // A saved state knows what was accepted, also as bytes.
    instance.save(1);
    let bytes = instance.serialised(1).unwrap();
    place(&mut instance, -0.079);
    assert!(instance.completed_integrator_step().is_ok());
    assert_eq!(instance.deserialise(2, &bytes), Ending::Ok, "{}", last(&told));
    assert_eq!(instance.restore(2), Ending::Ok);
    assert_eq!(get(&mut instance, &table, "tip.angle").to_bits(), other.to_bits());
    assert_eq!(place(&mut instance, 0.07).to_bits(), beyond.to_bits());
}

#[test]
fn a_trial_without_equilibrium_is_discarded_and_the_host_tries_another() {
    let (mut instance, table, told) = running(SHUT);
    let before = get(&mut instance, &table, "tip.angle");
    assert_eq!(set(&mut instance, &table, "field.uniform[2]", 0.06), Ending::Ok);
    let angle = [reference(&table, "tip.angle")];
    assert_eq!(instance.get(&angle, "Real", Value::real), Err(Ending::Discard));
    let said = last(&told);
    assert!(said.contains("% of the way") && said.contains("the last accepted step"), "{said}");
    let known = told.lock().unwrap().len();
    assert_eq!(instance.get(&angle, "Real", Value::real), Err(Ending::Discard));
    assert_eq!(instance.completed_integrator_step(), Err(Ending::Discard));
    assert_eq!(told.lock().unwrap().len(), known, "nothing is solved twice, or told twice");
    assert_eq!(whole(&mut instance, &table, "solver.status"), Ok(3));
    assert_eq!(instance.state(), State::ContinuousTime);
    assert_eq!(set(&mut instance, &table, "field.uniform[2]", 0.02), Ending::Ok);
    assert_eq!(get(&mut instance, &table, "tip.angle").to_bits(), before.to_bits());
    assert_eq!(whole(&mut instance, &table, "solver.status"), Ok(0));
}

#[test]
fn each_interface_refuses_the_calls_and_states_of_the_other() {
    let (mut exchange, table, told) = running(BENT);
    let (mut stepped, _, heard) = initialised(BENT);
    assert!(!exchange.allows(Call::DoStep, "fmi2DoStep"));
    assert_eq!(
        last(&told),
        "logStatusError: fmi2DoStep is a function of co-simulation, and this instance is for model exchange"
    );
    assert!(!stepped.allows(Call::SetTime, "fmi2SetTime"));
    assert!(last(&heard).contains("this instance is for co-simulation"), "{}", last(&heard));
    exchange.save(1);
    let bytes = exchange.serialised(1).unwrap();
    assert_eq!(stepped.deserialise(1, &bytes), Ending::Error);
    assert!(last(&heard).contains("of the other interface"), "{}", last(&heard));
    assert_eq!(exchange.expect_none("continuous states", 0), Ending::Ok);
    assert_eq!(exchange.expect_none("continuous states", 1), Ending::Error);
    assert_eq!(exchange.set_time(f64::NAN), Ending::Error);
    // Only continuous inputs move in continuous-time mode.
    assert_eq!(set(&mut exchange, &table, "gravity[3]", -9.81), Ending::Error);
    assert!(last(&told).contains("gravity[3] (tunable parameter) cannot be set in continuous-time mode"));
    assert_eq!(exchange.enter_event_mode(), Ending::Ok);
    assert_eq!(set(&mut exchange, &table, "gravity[3]", -9.81), Ending::Ok);
}

/// IPOPT tries many poses, each beyond the fold or without an equilibrium, before it takes a step.
#[test]
fn trials_are_told_of_once_a_step() {
    let said =
        |told: &Told, words: &str| told.lock().unwrap().iter().filter(|line| line.contains(words)).count();
    let patient = format!("{SNAPPING}\ntime_budget_s = 20.0");
    let (mut instance, table, told) = running(&patient);
    for step in 1..=2 {
        for trial in 0..20 {
            let z = 0.06 + 0.0005 * f64::from(trial);
            assert_eq!(set(&mut instance, &table, "magnet.position[3]", z), Ending::Ok);
            assert!(get(&mut instance, &table, "tip.angle").is_finite());
            assert_eq!(whole(&mut instance, &table, "stability.snaps"), Ok(1));
        }
        assert_eq!(said(&told, "snapped to another branch"), step, "{:?}", told.lock().unwrap());
        assert_eq!(set(&mut instance, &table, "magnet.position[3]", -0.079), Ending::Ok);
        assert_eq!(instance.completed_integrator_step(), Ok(false));
    }
    let (mut instance, table, told) = running(SHUT);
    for step in 1..=2 {
        for trial in 0..20 {
            let field = 0.04 + 0.001 * f64::from(trial);
            assert_eq!(set(&mut instance, &table, "field.uniform[2]", field), Ending::Ok);
            assert_eq!(whole(&mut instance, &table, "solver.status"), Ok(3));
            let angle = instance.get(&[reference(&table, "tip.angle")], "Real", Value::real);
            assert_eq!(angle, Err(Ending::Discard));
        }
        assert_eq!(said(&told, "% of the way"), step, "{:?}", told.lock().unwrap());
        assert_eq!(set(&mut instance, &table, "field.uniform[2]", 0.02), Ending::Ok);
        assert_eq!(instance.completed_integrator_step(), Ok(false));
    }
}
