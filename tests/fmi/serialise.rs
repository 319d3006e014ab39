//! States as bytes: another instance goes on bit for bit, and what does not fit is refused.

use mcm::fmi::Instance;
use mcm::fmi::state::{Ending, State};
use mcm::fmi::variables::Table;

use super::instance::{get, initialised, reference, set};
use super::{BENT, Told, instance, last};

/// Rings that act on each other beside a magnet: every part of a state counts.
const BESIDE: &str = "[design]\nsegments = 2\n[magnet]";

/// Key of the states.
const KEY: usize = 1;

fn bytes(instance: &mut Instance) -> Vec<u8> {
    assert_eq!(instance.save(KEY), Ending::Ok);
    instance.serialised(KEY).unwrap()
}

/// All real outputs, bit by bit.
fn answers(instance: &mut Instance, table: &Table) -> Vec<u64> {
    let names = [
        "tip.angle",
        "tip.position[2]",
        "magnet.reaction_force[2]",
        "shape.position[3,2]",
        "stability.margin",
    ];
    names.iter().map(|name| get(instance, table, name).to_bits()).collect()
}

/// A few steps, and everything that is answered on the way.
fn run(instance: &mut Instance, table: &Table) -> Vec<Vec<u64>> {
    let step = |index: u32| {
        let position = -0.12 + 0.002 * f64::from(index);
        assert_eq!(set(instance, table, "magnet.position[2]", position), Ending::Ok);
        let time = instance.time();
        assert_eq!(instance.do_step(time, 0.1), Ending::Ok);
        answers(instance, table)
    };
    (0..4).map(step).collect()
}

#[test]
fn another_instance_goes_on_bit_for_bit() {
    let (mut first, table, _) = initialised(BESIDE);
    run(&mut first, &table);
    let reference = reference(&table, "magnet.position[1]");
    assert_eq!(first.set_input_derivatives(&[reference], &[1], &[0.01]), Ending::Ok);
    let kept = bytes(&mut first);
    let (mut second, _, told) = instance(BESIDE);
    assert_eq!(second.deserialise(KEY, &kept), Ending::Ok, "{}", last(&told));
    assert_eq!(second.restore(KEY), Ending::Ok);
    assert_eq!(second.time().to_bits(), first.time().to_bits());
    assert_eq!(bytes(&mut second), kept, "the same bytes again");
    assert_eq!(answers(&mut second, &table), answers(&mut first, &table));
    assert_eq!(run(&mut second, &table), run(&mut first, &table));
    assert_eq!(
        get(&mut second, &table, "magnet.position[1]").to_bits(),
        0.001_f64.to_bits(),
        "the path was taken"
    );
    assert_eq!(first.restore(KEY), Ending::Ok);
    assert_eq!(second.restore(KEY), Ending::Ok);
    assert_eq!(run(&mut second, &table), run(&mut first, &table), "and once more");
}

#[test]
fn every_state_of_life_is_kept() {
    let (mut first, package, _) = instance(BENT);
    let table = package.table();
    assert_eq!(set(&mut first, table, "design.helix.length", 0.0045), Ending::Ok);
    let mut kept = vec![bytes(&mut first)];
    assert_eq!(first.setup_experiment(1.0, Some(2.0)), Ending::Ok);
    first.enter_initialization();
    kept.push(bytes(&mut first));
    assert_eq!(first.exit_initialization(), Ending::Ok);
    kept.push(bytes(&mut first));
    first.terminate();
    kept.push(bytes(&mut first));
    let states = [State::Instantiated, State::Initialization, State::Stepping, State::Terminated];
    for (bytes, state) in kept.iter().zip(states) {
        let (mut second, _, told) = instance(BENT);
        assert_eq!(second.deserialise(KEY, bytes), Ending::Ok, "{}", last(&told));
        assert_eq!(second.restore(KEY), Ending::Ok);
        assert_eq!(second.state(), state);
        if state == State::Initialization {
            assert_eq!(second.exit_initialization(), Ending::Ok);
            assert_eq!(second.do_step(1.0, 2.0), Ending::Ok, "the stop time is that of the first run");
            assert_eq!(get(&mut second, table, "design.helix.length").to_bits(), 0.0045_f64.to_bits());
        }
    }
}

/// Asserts that these bytes are refused for `reason`, and that the instance goes on.
fn refused(instance: &mut Instance, told: &Told, bytes: &[u8], reason: &str) {
    assert_eq!(instance.deserialise(KEY, bytes), Ending::Error, "{reason}");
    assert!(last(told).contains("serialised FMU state: ") && last(told).contains(reason), "{}", last(told));
    assert!(!instance.has_saved(KEY));
    // Another message in between, or the log would fall silent.
    assert_eq!(instance.forget(KEY), Ending::Error);
    told.lock().unwrap().clear();
}

#[test]
fn bytes_that_do_not_fit_are_refused_with_the_reason() {
    let (mut writer, _, _) = initialised(BENT);
    let kept = bytes(&mut writer);
    let (mut reader, table, told) = initialised(BENT);
    let angle = get(&mut reader, &table, "tip.angle");
    refused(&mut reader, &told, &[], "too short");
    refused(&mut reader, &told, b"a file of another program, long enough", "none of this FMU");
    for length in (24..kept.len()).step_by(7).chain([kept.len() - 1]) {
        refused(&mut reader, &told, &kept[..length], "bytes where");
    }
    refused(&mut reader, &told, &[&kept[..], &[0]].concat(), "bytes where");
    for at in (24..kept.len()).step_by(11) {
        let mut altered = kept.clone();
        altered[at] ^= 1 << (at % 8);
        refused(&mut reader, &told, &altered, "checksum");
    }
    let mut later = kept.clone();
    later[8] += 1;
    refused(&mut reader, &told, &later, "its format is 17");
    let (mut other, ..) = initialised(&BENT.replace("10.0", "11.0"));
    refused(&mut reader, &told, &bytes(&mut other), "of the design {");
    assert_eq!(reader.do_step(0.0, 0.1), Ending::Ok);
    assert_eq!(get(&mut reader, &table, "tip.angle").to_bits(), angle.to_bits());
}

#[test]
fn forged_bytes_with_the_right_checksum_do_no_harm() {
    let (mut writer, _, _) = initialised(BENT);
    let kept = bytes(&mut writer);
    let (mut reader, table, told) = initialised(BENT);
    let mut refusals = 0;
    for at in (24..kept.len()).step_by(3) {
        let mut forged = kept.clone();
        forged[at] ^= 0xff;
        let sum = crc32fast::hash(&forged[24..]).to_le_bytes();
        forged[20..24].copy_from_slice(&sum);
        match reader.deserialise(KEY, &forged) {
            Ending::Ok => {
                // A number was changed into another one: whatever it is, steps end with an ending.
                assert_eq!(reader.restore(KEY), Ending::Ok);
                let time = reader.time();
                let _ = reader.do_step(time, 0.1);
                assert_eq!(reader.reset(), Ending::Ok);
            }
            ending => {
                assert_eq!(ending, Ending::Error);
                refusals += 1;
            }
        }
    }
    assert!(refusals > 20, "{refusals}");
    assert!(told.lock().unwrap().iter().all(|said| !said.contains("internal failure")));
    reader.reset();
    reader.enter_initialization();
    assert_eq!(reader.exit_initialization(), Ending::Ok);
    assert!(get(&mut reader, &table, "tip.angle") > 0.1);
}

#[test]
fn with_other_tolerances_than_at_the_start_it_goes_on_bit_for_bit() {
    for (name, value) in [
        ("model.tolerance_position", 2e-5),
        ("model.tolerance_angle", 1e-3),
        ("model.tolerance_relative", 3e-3),
    ] {
        let (mut first, table, _) = initialised(BESIDE);
        assert_eq!(set(&mut first, &table, name, value), Ending::Ok);
        run(&mut first, &table);
        let kept = bytes(&mut first);
        let (mut second, _, told) = instance(BESIDE);
        assert_eq!(second.deserialise(KEY, &kept), Ending::Ok, "{}", last(&told));
        assert_eq!(second.restore(KEY), Ending::Ok);
        assert_eq!(run(&mut second, &table), run(&mut first, &table), "{name}");
        assert_eq!(bytes(&mut second), bytes(&mut first), "{name}");
    }
}

#[test]
fn a_state_that_is_not_kept_has_no_bytes() {
    let (instance, _, told) = initialised(BENT);
    assert_eq!(instance.serialised(5), Err(Ending::Error));
    assert!(last(&told).contains("FMU state"));
}
