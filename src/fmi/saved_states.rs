//! FMU states that the host has saved, in memory and as bytes.

use super::instance::Instance;
use super::serialise::{from_bytes, to_bytes};
use super::state::Ending;

pub(super) const UNKNOWN: &str = "this FMU state is not, or no longer, one of this instance";

impl Instance {
    /// Saves the present FMU state under `handle`.
    pub fn save(&mut self, handle: usize) -> Ending {
        self.saved_states.insert(handle, self.fmu_state.clone());
        Ending::Ok
    }

    /// Whether an FMU state is saved under `handle`.
    #[must_use]
    pub fn has_saved(&self, handle: usize) -> bool {
        self.saved_states.contains_key(&handle)
    }

    /// Restores the FMU state saved under `handle`.
    pub fn restore(&mut self, handle: usize) -> Ending {
        match self.saved_states.get(&handle) {
            Some(fmu_state) => {
                self.fmu_state = fmu_state.clone();
                Ending::Ok
            }
            None => self.refuse(UNKNOWN),
        }
    }

    /// Frees the FMU state saved under `handle`.
    pub fn forget(&mut self, handle: usize) -> Ending {
        match self.saved_states.remove(&handle) {
            Some(_) => Ending::Ok,
            None => self.refuse(UNKNOWN),
        }
    }

    /// The FMU state saved under `handle` as bytes. Any instance of the same FMU can read them, also in another process.
    ///
    /// # Errors
    /// [`Ending::Error`], explained in the log, when there is no such state or when it cannot be written.
    pub fn serialised(&self, handle: usize) -> Result<Vec<u8>, Ending> {
        let fmu_state = self.saved_states.get(&handle).ok_or_else(|| self.refuse(UNKNOWN))?;
        to_bytes(fmu_state, &self.package).map_err(|error| self.refuse(&error.to_string()))
    }

    /// Saves the FMU state that `bytes` hold under `handle`.
    pub fn deserialise(&mut self, handle: usize, bytes: &[u8]) -> Ending {
        match from_bytes(bytes, &self.package) {
            Ok(fmu_state) if fmu_state.state.interface().is_some_and(|of| of != self.interface()) => {
                let own = self.interface().in_words();
                self.refuse(&format!(
                    "the state is one of the other interface, and this instance is for {own}"
                ))
            }
            Ok(fmu_state) => {
                self.saved_states.insert(handle, fmu_state);
                Ending::Ok
            }
            Err(error) => self.refuse(&error.to_string()),
        }
    }
}
