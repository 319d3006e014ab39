//! Calls that save and restore states.

use std::ptr;

use mcm::fmi::ffi::*;

use super::*;

/// States that one instance keeps at once.
const STATES: usize = 4;

/// Serialised states that the host keeps.
const BLOBS: usize = 4;

impl Host<'_> {
    /// One of the instance's states; seldom none, one that was forgotten, or no state at all.
    fn state(&mut self, guest: &Guest) -> fmi2FMUstate {
        let odd = ptr::without_provenance_mut(self.draw.below(64));
        if self.draw.once_in(8) { odd } else { self.draw.pick(&guest.states).unwrap_or(odd) }
    }

    pub(super) fn save(&mut self, guest: &mut Guest) {
        if guest.states.len() > STATES {
            return self.forget(guest);
        }
        let again = self.draw.once_in(4);
        let mut state = if again { self.state(guest) } else { ptr::null_mut() };
        let before = state;
        let to = if self.draw.once_in(16) { ptr::null_mut() } else { &raw mut state };
        // SAFETY: null, or one handle.
        let status = self.call(guest, "fmi2GetFMUstate", |it| unsafe { fmi2GetFMUstate(it, to) });
        guest.keep(status, before, state);
    }

    pub(super) fn restore(&mut self, guest: &mut Guest) {
        let state = self.state(guest);
        // SAFETY: a handle, which is looked up.
        let status = self.call(guest, "fmi2SetFMUstate", |it| unsafe { fmi2SetFMUstate(it, state) });
        assert_eq!(status == OK, guest.alive && guest.states.contains(&state), "{status:?}");
        if status == OK {
            guest.stage = 3;
        }
    }

    pub(super) fn forget(&mut self, guest: &mut Guest) {
        let mut state = self.state(guest);
        let (before, known) = (state, guest.states.iter().position(|&known| known == state));
        let at = if self.draw.once_in(16) { ptr::null_mut() } else { &raw mut state };
        // SAFETY: null, or one handle.
        let status = self.call(guest, "fmi2FreeFMUstate", |it| unsafe { fmi2FreeFMUstate(it, at) });
        if status == OK && !at.is_null() && !before.is_null() {
            assert!(state.is_null());
            guest.states.swap_remove(known.expect("only what was given can be freed"));
        } else {
            assert_eq!(state, before);
        }
    }

    pub(super) fn serialise(&mut self, guest: &mut Guest) {
        let (state, mut size) = (self.state(guest), 0);
        let asked = self.call(guest, "fmi2SerializedFMUstateSize", |it| {
            // SAFETY: a handle, which is looked up, and one size.
            unsafe { fmi2SerializedFMUstateSize(it, state, &raw mut size) }
        });
        let room = match self.draw.byte() % 8 {
            0 => size.saturating_sub(1),
            1 => size + 100,
            _ => size,
        };
        let mut bytes = vec![0x55_u8; room + 1];
        let to = if self.draw.once_in(16) { ptr::null_mut() } else { bytes.as_mut_ptr() };
        let status = self.call(guest, "fmi2SerializeFMUstate", |it| {
            // SAFETY: a handle, which is looked up, and room for as many bytes as said.
            unsafe { fmi2SerializeFMUstate(it, state, to.cast(), room) }
        });
        assert_eq!(status == OK, asked == OK && room >= size && !to.is_null(), "{asked:?} {status:?}");
        let written = if status == OK { size } else { 0 };
        assert!(bytes[written..].iter().all(|&byte| byte == 0x55), "written beyond the end");
        if status == OK && self.blobs.len() < BLOBS {
            bytes.truncate(size);
            self.blobs.push(bytes);
        }
    }

    pub(super) fn deserialise(&mut self, guest: &mut Guest) {
        let fresh = self.draw.once_in(8);
        let mut blob = if self.blobs.is_empty() || fresh {
            (0..self.draw.byte()).map(|_| self.draw.byte()).collect()
        } else {
            let at = self.draw.below(self.blobs.len());
            self.blobs[at].clone()
        };
        match self.draw.byte() % 4 {
            0 => blob.truncate(self.draw.below(256) * blob.len() / 256),
            1 if !blob.is_empty() => {
                let at = self.draw.below(256) * blob.len() / 256;
                blob[at] ^= 1 << self.draw.below(8);
            }
            _ => {}
        }
        let again = self.draw.once_in(4);
        let mut state = if again { self.state(guest) } else { ptr::null_mut() };
        let before = state;
        let (from, length) = (self.draw.pointer(&blob), blob.len());
        let to = if self.draw.once_in(16) { ptr::null_mut() } else { &raw mut state };
        let status = self.call(guest, "fmi2DeSerializeFMUstate", |it| {
            // SAFETY: null, or as many bytes as said; null, or one handle.
            unsafe { fmi2DeSerializeFMUstate(it, from.cast(), length, to) }
        });
        assert!(status != OK || self.blobs.contains(&blob), "a state that was altered is taken");
        guest.keep(status, before, state);
    }
}

impl Guest {
    /// Notes a state that the FMU has given.
    fn keep(&mut self, status: fmi2Status, before: fmi2FMUstate, now: fmi2FMUstate) {
        if status != OK {
            assert_eq!(now, before, "refused, and written");
        } else if before.is_null() {
            assert!(!now.is_null() && !self.states.contains(&now), "a state of its own");
            self.states.push(now);
        } else {
            assert_eq!(now, before);
        }
    }
}
