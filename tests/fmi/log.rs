//! What the host hears, and how often.

use std::sync::{Arc, Mutex};

use mcm::fmi::log::Log;
use mcm::fmi::state::Ending;
use mcm::fmi::value::Value;

/// A log into a list.
fn log(events: bool) -> (Log, Arc<Mutex<Vec<String>>>) {
    let told = Arc::<Mutex<Vec<String>>>::default();
    let sink = Arc::clone(&told);
    let into = move |_, category: mcm::fmi::log::Category, message: &str| {
        sink.lock().unwrap().push(format!("{}: {message}", category.name()));
    };
    (Log::new(Box::new(into), events), told)
}

fn heard(log: &Log, told: &Mutex<Vec<String>>) -> [bool; 3] {
    told.lock().unwrap().clear();
    log.step_done();
    log.event("e");
    log.notice("w");
    log.error("x");
    let told = told.lock().unwrap();
    ["logEvents: e", "logStatusWarning: w", "logStatusError: x"].map(|said| told.iter().any(|t| t == said))
}

#[test]
fn categories_are_switched_one_by_one() {
    let (mut log, told) = log(false);
    assert_eq!(heard(&log, &told), [false, true, true], "a call that ends badly is explained");
    for (on, categories, expected) in [
        (true, &["logEvents"][..], [true, true, true]),
        (false, &["logStatusWarning"], [true, false, true]),
        (false, &[], [false, false, true]),
        (true, &[], [true, true, true]),
        (false, &["logAll"], [false, false, false]),
        (true, &["logStatusError", "logStatusWarning"], [false, true, true]),
    ] {
        assert_eq!(log.choose(on, categories), Ok(()));
        assert_eq!(heard(&log, &told), expected, "{on} {categories:?}");
    }
    assert_eq!(log.choose(true, &["logEvents", "logNothing"]), Err("logNothing"));
    assert_eq!(heard(&log, &told), [false, true, true], "nothing of a refused call is kept");
}

#[test]
fn a_message_that_repeats_itself_falls_silent() {
    let (log, told) = log(false);
    for _ in 0..10_000 {
        log.error("the same");
    }
    assert_eq!(told.lock().unwrap().len(), 10);
    assert!(told.lock().unwrap()[9].contains("not again"));
    log.error("another");
    log.error("the same");
    assert_eq!(told.lock().unwrap().len(), 12, "another message in between");
    log.step_done();
    log.error("the same");
    assert_eq!(told.lock().unwrap().len(), 13, "after a success");
}

#[test]
fn numbers_that_look_like_those_of_another_unit_are_told_once() {
    let heard = |told: &super::Told| {
        let told = told.lock().unwrap();
        told.iter().filter(|line| line.contains("if it was meant in")).cloned().collect::<Vec<_>>()
    };
    let scene = "[design]\nsegments = 1\n[design.ring]\nlength_mm = 0.001\n[model]\ninteraction = \"none\"";
    let (mut instance, package, told) = super::instance(scene);
    let of_scene = "logStatusWarning: design.ring.length_mm = 0.001: ";
    assert!(matches!(&heard(&told)[..], [only] if only.starts_with(of_scene)), "{:?}", heard(&told));

    // What the host sets is in the unit of the variable.
    told.lock().unwrap().clear();
    for (name, value) in [("design.ring.remanence", 12.0), ("magnet.design.cylinder[1].radius", 22.5)] {
        let reference = super::instance::reference(package.table(), name);
        assert_eq!(instance.set(&[reference], [Value::Real(value)].into_iter()), Ending::Ok);
    }
    assert_eq!(instance.enter_initialization(), Ending::Ok);
    assert_eq!(instance.exit_initialization(), Ending::Ok);
    let odd = heard(&told);
    assert!(
        odd[0].contains("design.ring.remanence = 12: ") && odd[0].contains("in kG, it is 1.2 T"),
        "{odd:?}"
    );
    assert!(
        odd[1].contains("magnet.design.cylinder[1].radius = 22.5: ")
            && odd[1].contains("in mm, it is 22.5 mm")
    );
    assert_eq!(odd.len(), 2, "the scene's own has been told");

    // And where it is refused, too.
    let (mut instance, package, told) = super::instance(super::BENT);
    let reference = super::instance::reference(package.table(), "design.helix.length");
    assert_eq!(instance.set(&[reference], [Value::Real(4.0)].into_iter()), Ending::Ok);
    assert_eq!(instance.enter_initialization(), Ending::Ok);
    assert_eq!(instance.exit_initialization(), Ending::Error);
    assert!(
        super::last(&told).contains("it must be > 0 and <= 1; if it was meant in mm, it is 4 mm"),
        "{}",
        super::last(&told)
    );
}
