//! A host without manners: bytes become calls of the C interface, and after each call it checks what the FMU promises.
//!
//! The property test, the recorded run and the fuzz target share it.
#![allow(clippy::wildcard_imports, reason = "types and functions of the standard, named by its prefix")]

mod design;

mod draw;

mod exchange;

mod life;

pub(crate) mod logger;

pub(crate) mod start;

mod states;

mod values;

use std::sync::atomic::AtomicUsize;
use std::time::Duration;

use cpu_time::ThreadTime;
use mcm::fmi::bindings::*;

pub(crate) use design::Design;
use draw::Draw;

const OK: fmi2Status = fmi2Status::fmi2OK;
const WARNING: fmi2Status = fmi2Status::fmi2Warning;
const ERROR: fmi2Status = fmi2Status::fmi2Error;

/// Environments of instances, none of them another test's.
static ENVIRONMENT: AtomicUsize = AtomicUsize::new(1_000_000);

/// What `Host` calls each of its instances.
const NAME: &std::ffi::CStr = c"guest";

/// Instances that live at once.
const GUESTS: usize = 3;

/// What was done.
#[derive(Debug, Default, Clone, Copy)]
pub(crate) struct Tally {
    /// Calls of the interface.
    pub(crate) calls: u64,
    /// Those that were answered with OK, Warning (none), Discard and Error.
    pub(crate) endings: [u64; 4],
    /// Messages in the log.
    pub(crate) told: u64,
    /// The call that took longest.
    pub(crate) slowest: (Duration, &'static str),
}

/// An instance, or what is left of one.
struct Guest {
    handle: fmi2Component,
    design: usize,
    /// What it is for.
    kind: fmi2Type,
    environment: usize,
    alive: bool,
    /// Whether it was given a logger.
    has_logger: bool,
    /// Whether the host has refused to hear errors.
    deaf: bool,
    last_said: String,
    /// How many of the calls of a life in order have succeeded.
    stage: u8,
    states: Vec<fmi2FMUstate>,
}

/// The host.
pub(crate) struct Host<'a> {
    designs: &'a [Design],
    draw: Draw<'a>,
    guests: Vec<Guest>,
    /// Serialised states, sound or not.
    blobs: Vec<Vec<u8>>,
    /// Longest time that a call may take.
    patience: Duration,
    tally: Tally,
}

impl<'a> Host<'a> {
    /// A host that will do what `bytes` say, if none of its calls takes longer than `patience`.
    pub(crate) fn new(designs: &'a [Design], bytes: &'a [u8], patience: Duration) -> Self {
        Self {
            designs,
            draw: Draw::new(bytes),
            guests: Vec::new(),
            blobs: Vec::new(),
            patience,
            tally: Tally::default(),
        }
    }

    /// Does it all. A promise that is broken is a panic.
    pub(crate) fn run(mut self) -> Tally {
        while !self.draw.is_empty() {
            self.act();
        }
        while let Some(guest) = self.guests.pop() {
            self.free(&guest);
        }
        self.tally
    }

    fn act(&mut self) {
        if self.guests.is_empty() {
            return self.instantiate();
        }
        let at = self.draw.below(self.guests.len());
        // Taken out, so that host and guest can be used side by side.
        let mut guest = self.guests.swap_remove(at);
        match self.draw.byte() {
            0..=1 if self.guests.len() + 1 < GUESTS => self.instantiate(),
            2..=3 => self.free_twice(&mut guest),
            4..=23 => self.advance(&mut guest),
            24..=29 => self.live_out_of_order(&mut guest),
            30..=45 => self.debug_logging(&mut guest),
            46..=89 => self.set_reals(&mut guest),
            90..=119 => self.set_others(&mut guest),
            120..=131 => self.get_reals(&mut guest),
            132..=139 => self.get_others(&mut guest),
            140..=143 => self.directional_derivative(&mut guest),
            144..=173 => self.set_input_derivatives(&mut guest),
            174..=177 => self.output_derivatives(&mut guest),
            178..=189 => self.save(&mut guest),
            190..=191 => self.restore(&mut guest),
            192..=203 => self.forget(&mut guest),
            204..=205 => self.serialise(&mut guest),
            206..=211 => self.deserialise(&mut guest),
            212..=213 => self.step_anyhow(&mut guest),
            214..=217 => {
                self.exchange(&mut guest);
            }
            _ => self.ask_status(&mut guest),
        }
        if guest.alive || self.guests.is_empty() || !self.draw.once_in(4) {
            self.guests.push(guest);
        }
    }

    /// A call on an instance, and what is promised of every such call.
    fn call(
        &mut self,
        guest: &mut Guest,
        name: &'static str,
        work: impl FnOnce(fmi2Component) -> fmi2Status,
    ) -> fmi2Status {
        let start = ThreadTime::now(); // on a busy machine, waiting is no fault of the FMU
        let status = work(guest.handle);
        let took = start.elapsed();
        self.count(name, took);
        self.tally.endings[status.0 as usize] += 1; // out of range: no status of the standard for a finished call
        assert_ne!(status, WARNING, "{name}: hosts take that for a failure");
        let said = logger::take(guest.environment);
        self.check_log(name, &said);
        if !guest.alive {
            assert_eq!(status, ERROR, "{name} on a freed instance");
        } else if let Some(last) = said.into_iter().next_back() {
            guest.last_said = last;
        } else if status == ERROR && guest.has_logger && !guest.deaf {
            let suppressed = guest.last_said.ends_with("and not again)");
            assert!(suppressed, "{name} ended with {status:?} and nothing said why");
        }
        status
    }

    fn count(&mut self, name: &'static str, took: Duration) {
        self.tally.calls += 1;
        if took > self.tally.slowest.0 {
            self.tally.slowest = (took, name);
        }
        assert!(took < self.patience, "{name} took {took:?}");
    }

    fn check_log(&mut self, name: &str, said: &[String]) {
        self.tally.told += said.len() as u64;
        assert!(said.len() < 5, "{name} floods the log: {said:?}");
        for message in said {
            let known = ["logEvents", "logStatusWarning", "logStatusError"]
                .iter()
                .any(|category| message.starts_with(&format!("guest {category}: ")));
            assert!(known, "{name} says {message}");
            assert!(!message.contains("internal failure"), "{name}: {message}");
        }
    }
}
