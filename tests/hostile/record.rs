//! Long runs of the C interface, to be recorded:
//!
//! ```text
//! cargo run --release --example hostile calls 10000000     # random calls; further: first seed, seconds a call may take
//! cargo run --release --example hostile cycles 1000        # instances made, initialised, stepped and freed
//! cargo run --release --example hostile steps 1000000      # steps of one instance
//! ```
#![allow(unsafe_code, reason = "the functions under test take raw pointers")]
#![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic, reason = "a broken promise stops the run")]
#![allow(clippy::print_stdout, reason = "tells what it measured")]
#![allow(clippy::wildcard_imports, reason = "types and functions of the standard, named by its prefix")]
#![allow(missing_docs, reason = "a program")]

mod host;

use std::fs;
use std::panic::{AssertUnwindSafe, catch_unwind, resume_unwind};
use std::path::PathBuf;
use std::process::ExitCode;
use std::sync::Mutex;
use std::sync::atomic::{AtomicU64, Ordering};
use std::thread;
use std::time::{Duration, Instant};

use host::start::{initialise, instantiate};
use host::{Design, Host, Tally};
use mcm::fmi::bindings::*;
use mcm::fmi::ffi::*;
use rand::rngs::StdRng;
use rand::{Rng, SeedableRng};

/// Hosts at once.
const THREADS: u32 = 4;

/// Step of time, s.
const STEP: f64 = 1e-3;

/// Bytes of one host's decisions: some hundred calls.
const BYTES: usize = 4096;

fn main() -> ExitCode {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    let number = |at: usize| arguments.get(at).and_then(|text| text.parse::<u64>().ok());
    match (arguments.first().map(String::as_str), number(1)) {
        (Some("calls"), Some(count)) => {
            calls(count, number(2).unwrap_or(0), Duration::from_secs(number(3).unwrap_or(1)));
        }
        (Some("cycles"), Some(count)) => cycles(count),
        (Some("steps"), Some(count)) => steps(count),
        _ => {
            println!("say: calls COUNT [SEED [SECONDS]], cycles COUNT, or steps COUNT");
            return ExitCode::FAILURE;
        }
    }
    ExitCode::SUCCESS
}

/// Random calls on some threads, every host with a seed of its own, until there are so many. A call that takes longer
/// than `patience` hangs.
fn calls(count: u64, first: u64, patience: Duration) {
    let folder = folder();
    let designs = Design::all(&folder);
    let (sum, next, start) = (Mutex::new(Tally::default()), AtomicU64::new(first), Instant::now());
    let hosts = || {
        while sum.lock().unwrap().calls < count {
            let seed = next.fetch_add(1, Ordering::Relaxed);
            let mut bytes = [0; BYTES];
            StdRng::seed_from_u64(seed).fill_bytes(&mut bytes);
            match catch_unwind(AssertUnwindSafe(|| Host::new(&designs, &bytes, patience).run())) {
                Ok(tally) => add(&mut sum.lock().unwrap(), &tally),
                Err(broken) => {
                    println!("seed {seed}");
                    resume_unwind(broken);
                }
            }
        }
    };
    thread::scope(|scope| {
        for _ in 0..THREADS {
            scope.spawn(hosts);
        }
    });
    let sum = sum.into_inner().unwrap();
    let [ok, _, discard, error] = sum.endings; // a warning ends the run
    let ((slowest, name), hosts) = (sum.slowest, next.into_inner() - first);
    println!("{} calls of {hosts} hosts in {:.0} s", sum.calls, start.elapsed().as_secs_f64());
    println!("OK {ok}, Discard {discard}, Error {error}; {} messages", sum.told);
    println!("slowest: {name}, {:.0} ms", 1e3 * slowest.as_secs_f64());
    fs::remove_dir_all(folder).unwrap();
}

fn add(sum: &mut Tally, more: &Tally) {
    sum.calls += more.calls;
    sum.told += more.told;
    for (sum, more) in sum.endings.iter_mut().zip(more.endings) {
        *sum += more;
    }
    if more.slowest.0 > sum.slowest.0 {
        sum.slowest = more.slowest;
    }
}

/// Instances come and go.
fn cycles(count: u64) {
    on_a_design(|design| {
        watched(count, |_| {
            // SAFETY: the location is zero-terminated.
            let component = unsafe { instantiate(&design.guid, design.location.as_ptr(), 1) };
            initialise(component);
            step(component, design, 0);
            fmi2FreeInstance(component);
        });
    });
}

/// One instance steps and steps.
fn steps(count: u64) {
    on_a_design(|design| {
        // SAFETY: the location is zero-terminated.
        let component = unsafe { instantiate(&design.guid, design.location.as_ptr(), 1) };
        initialise(component);
        watched(count, |index| step(component, design, index));
        fmi2FreeInstance(component);
    });
}

/// Work with the first design, one segment beside the magnet.
fn on_a_design(work: impl FnOnce(&Design)) {
    let folder = folder();
    work(&Design::all(&folder)[0]);
    fs::remove_dir_all(folder).unwrap();
}

/// A step with the magnet on its way to and fro, and all that it answers.
fn step(component: fmi2Component, design: &Design, index: u64) {
    let (input, time) = (design.inputs[0], index as f64 * STEP);
    let value = design.start(input) + 0.01 * time.sin();
    let mut answers = vec![f64::NAN; design.outputs.len()];
    // SAFETY: as many values as references.
    unsafe {
        assert_eq!(fmi2SetReal(component, &raw const input, 1, &raw const value), fmi2Status::fmi2OK);
        assert_eq!(fmi2DoStep(component, time, STEP, 1), fmi2Status::fmi2OK);
        let (references, to) = (design.outputs.as_ptr(), answers.as_mut_ptr());
        assert_eq!(fmi2GetReal(component, references, answers.len(), to), fmi2Status::fmi2OK);
    }
    assert!(answers.iter().all(|answer| answer.is_finite()));
}

/// Does it so often; says how the memory of this process grows.
fn watched(count: u64, mut work: impl FnMut(u64)) {
    let (tenth, start) = ((count / 10).max(1), Instant::now());
    for index in 0..count {
        work(index);
        if (index + 1) % tenth == 0 {
            println!("{}: {} kB after {:.0} s", index + 1, resident(), start.elapsed().as_secs_f64());
        }
    }
}

/// Memory of this process in kB, as Linux tells it.
fn resident() -> String {
    let status = fs::read_to_string("/proc/self/status").unwrap_or_default();
    let line = status.lines().find_map(|line| line.strip_prefix("VmRSS:")).unwrap_or("?");
    line.trim_end_matches("kB").trim().to_owned()
}

/// A folder of this process's own.
fn folder() -> PathBuf {
    std::env::temp_dir().join(format!("mcm hostile {}", std::process::id()))
}
