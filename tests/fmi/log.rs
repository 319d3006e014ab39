//! What the host hears, and how often.

use std::sync::{Arc, Mutex};

use mcm::fmi::log::Log;

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
    log.forget_repetitions();
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
    log.forget_repetitions();
    log.error("the same");
    assert_eq!(told.lock().unwrap().len(), 13, "after a success");
}
