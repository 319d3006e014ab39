//! Calls that move an instance through its life.

use std::ffi::{CStr, c_void};
use std::ptr;
use std::sync::atomic::Ordering;

use mcm::fmi::ffi::*;

use super::design::{QUICK, SHORT};
use super::*;

/// What an FMU can be instantiated for.
const KINDS: [fmi2Type; 2] = [fmi2Type::fmi2CoSimulation, fmi2Type::fmi2ModelExchange];

/// Handles that were never given.
const STRANGERS: [usize; 3] = [0, 1 << 40, usize::MAX];

const CATEGORIES: [&CStr; 6] =
    [c"logEvents", c"logStatusWarning", c"logStatusError", c"logAll", c"", c"logEverything %n%s"];

impl Host<'_> {
    /// Instantiates one of the designs, mostly as the standard says.
    pub(super) fn instantiate(&mut self) {
        let known = self.designs.len();
        let among = match self.draw.byte() {
            0..=239 => QUICK,
            240..=253 => SHORT,
            _ => known,
        };
        let design = self.draw.below(among);
        let other = self.draw.below(4 * known);
        let environment = ENVIRONMENT.fetch_add(1, Ordering::Relaxed);
        let functions = logger::callbacks(environment);
        let (mut name, mut kind, mut guid) =
            (NAME.as_ptr(), KINDS[usize::from(self.draw.once_in(4))], self.designs[design].guid.as_ptr());
        let (mut location, mut callbacks) = (self.designs[design].location.as_ptr(), &raw const functions);
        match self.draw.byte() % 32 {
            0 => name = ptr::null(),
            1 => name = c"".as_ptr(),
            2 => kind = fmi2Type(u32::from(self.draw.byte())),
            3 => guid = ptr::null(),
            4 => guid = c"{\xff\xfe\x01 %s%n}".as_ptr(),
            5 => location = ptr::null(),
            6 => location = c"file:///nowhere\xff/%zz%".as_ptr(),
            7 => location = c"ftp://example.org/resources".as_ptr(),
            8 => callbacks = ptr::null(),
            9 => location = self.designs.get(other).map_or(location, |other| other.location.as_ptr()),
            _ => {}
        }
        let sound = KINDS.contains(&kind)
            && (name, guid) == (NAME.as_ptr(), self.designs[design].guid.as_ptr())
            && location == self.designs[design].location.as_ptr();
        let start = ThreadTime::now();
        // SAFETY: texts are null or zero-terminated, `callbacks` is null or points to callbacks.
        let handle = unsafe {
            fmi2Instantiate(name, kind, guid, location, callbacks, 0, i32::from(self.draw.byte() & 1))
        };
        self.count("fmi2Instantiate", start.elapsed());
        let said = logger::take(environment);
        assert_eq!(!handle.is_null(), sound, "{said:?}");
        assert!(sound || callbacks.is_null() || said.len() == 1, "an instantiation was refused in silence");
        if name == NAME.as_ptr() {
            self.check_log("fmi2Instantiate", &said);
        }
        self.guests.push(Guest {
            handle,
            design,
            kind,
            environment,
            alive: sound,
            has_logger: !callbacks.is_null(),
            deaf: false,
            last_said: String::new(),
            stage: 0,
            states: Vec::new(),
        });
    }

    pub(super) fn free(&mut self, guest: &Guest) {
        let start = ThreadTime::now();
        fmi2FreeInstance(guest.handle);
        self.count("fmi2FreeInstance", start.elapsed());
        assert!(logger::take(guest.environment).is_empty());
    }

    /// Frees an instance, now and then twice; or makes a stranger of its handle.
    pub(super) fn free_twice(&mut self, guest: &mut Guest) {
        if self.draw.once_in(2) {
            let strangers = STRANGERS.map(ptr::without_provenance_mut::<c_void>);
            let known = guest.handle;
            guest.handle = self.draw.pick(&strangers).unwrap_or(ptr::null_mut());
            self.free(guest);
            let was_alive = std::mem::replace(&mut guest.alive, false);
            self.advance(guest);
            (guest.handle, guest.alive) = (known, was_alive);
        } else {
            self.free(guest);
            guest.alive = false;
        }
    }

    /// The next call of a life in order.
    pub(super) fn advance(&mut self, guest: &mut Guest) {
        let stage = guest.stage;
        // SAFETY: no pointers but the handle.
        let status = match stage {
            0 => self.call(guest, "fmi2SetupExperiment", |it| unsafe {
                fmi2SetupExperiment(it, 1, f64::NAN, 0.0, 0, f64::NAN)
            }),
            1 => self
                .call(guest, "fmi2EnterInitializationMode", |it| unsafe { fmi2EnterInitializationMode(it) }),
            2 => {
                self.call(guest, "fmi2ExitInitializationMode", |it| unsafe { fmi2ExitInitializationMode(it) })
            }
            _ if guest.kind == fmi2Type::fmi2ModelExchange => self.exchange(guest),
            _ => self.step(guest),
        };
        if status == OK {
            guest.stage = (stage + 1).min(3);
        } else if self.draw.once_in(4) {
            // SAFETY: no pointers but the handle.
            if self.call(guest, "fmi2Reset", |it| unsafe { fmi2Reset(it) }) == OK {
                guest.stage = 0;
            } else {
                assert!(!guest.alive, "a reset is always possible");
            }
        }
    }

    /// A step from where the instance stands.
    fn step(&mut self, guest: &mut Guest) -> fmi2Status {
        let mut time = 0.0;
        let asked = self.call(guest, "fmi2GetRealStatus", |it| {
            // SAFETY: one value.
            unsafe { fmi2GetRealStatus(it, fmi2StatusKind::fmi2LastSuccessfulTime, &raw mut time) }
        });
        assert!(asked == ERROR || time.is_finite(), "last successful time {time}");
        let size = f64::from(self.draw.byte()) * 1e-3;
        // SAFETY: no pointers but the handle.
        self.call(guest, "fmi2DoStep", |it| unsafe { fmi2DoStep(it, time, size, 1) })
    }

    /// A step with any numbers.
    pub(super) fn step_anyhow(&mut self, guest: &mut Guest) {
        let (time, size) = (self.draw.real(0.0), self.draw.real(0.1));
        // SAFETY: no pointers but the handle.
        self.call(guest, "fmi2DoStep", |it| unsafe { fmi2DoStep(it, time, size, 0) });
    }

    /// A call that belongs elsewhere in a life.
    pub(super) fn live_out_of_order(&mut self, guest: &mut Guest) {
        let (start, stop) = (self.draw.real(0.0), self.draw.real(1.0));
        // SAFETY: no pointers but the handle.
        match self.draw.byte() % 8 {
            0 => self.call(guest, "fmi2Terminate", |it| unsafe { fmi2Terminate(it) }),
            1 => self.call(guest, "fmi2CancelStep", |it| unsafe { fmi2CancelStep(it) }),
            2 => self
                .call(guest, "fmi2EnterInitializationMode", |it| unsafe { fmi2EnterInitializationMode(it) }),
            3 => {
                self.call(guest, "fmi2ExitInitializationMode", |it| unsafe { fmi2ExitInitializationMode(it) })
            }
            _ => self.call(guest, "fmi2SetupExperiment", |it| unsafe {
                fmi2SetupExperiment(it, 1, stop, start, 1, stop)
            }),
        };
    }

    pub(super) fn debug_logging(&mut self, guest: &mut Guest) {
        let on = i32::from(!self.draw.once_in(4));
        let mut names: Vec<_> = (0..self.draw.below(3))
            .map(|_| self.draw.pick(&CATEGORIES).map_or(ptr::null(), CStr::as_ptr))
            .collect();
        if self.draw.once_in(16) {
            names.push(ptr::null());
        }
        let (length, start) = (names.len(), self.draw.pointer(&names));
        // SAFETY: null, or as many names as said, each null or zero-terminated.
        let status = self
            .call(guest, "fmi2SetDebugLogging", |it| unsafe { fmi2SetDebugLogging(it, on, length, start) });
        if status == OK && length == 0 && on == 1 {
            guest.deaf = false;
        } else if status == OK && length > 0 && on == 0 {
            guest.deaf = true;
        }
    }

    pub(super) fn ask_status(&mut self, guest: &mut Guest) {
        let kind = fmi2StatusKind(u32::from(self.draw.byte() % 6));
        let to_null = self.draw.once_in(8);
        let (mut status, mut real, mut integer, mut boolean, mut string) = (OK, 0.0, 0, 0, ptr::null());
        // SAFETY: null, or one value.
        match self.draw.byte() % 5 {
            0 => self.call(guest, "fmi2GetStatus", |it| unsafe {
                fmi2GetStatus(it, kind, if to_null { ptr::null_mut() } else { &raw mut status })
            }),
            1 => self.call(guest, "fmi2GetRealStatus", |it| unsafe {
                fmi2GetRealStatus(it, kind, if to_null { ptr::null_mut() } else { &raw mut real })
            }),
            2 => self.call(guest, "fmi2GetIntegerStatus", |it| unsafe {
                fmi2GetIntegerStatus(it, kind, if to_null { ptr::null_mut() } else { &raw mut integer })
            }),
            3 => self.call(guest, "fmi2GetBooleanStatus", |it| unsafe {
                fmi2GetBooleanStatus(it, kind, if to_null { ptr::null_mut() } else { &raw mut boolean })
            }),
            _ => self.call(guest, "fmi2GetStringStatus", |it| unsafe {
                fmi2GetStringStatus(it, kind, if to_null { ptr::null_mut() } else { &raw mut string })
            }),
        };
        assert!(real.is_finite() && string.is_null());
    }
}
