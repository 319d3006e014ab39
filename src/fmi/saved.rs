//! Saved states of an instance, in memory and as bytes.

use super::instance::Instance;
use super::serialise::{from_bytes, to_bytes};
use super::state::Ending;

const UNKNOWN: &str = "this FMU state is not, or no longer, one of this instance";

impl Instance {
    /// Keeps the present state under `key`.
    pub fn save(&mut self, key: usize) -> Ending {
        self.saved.insert(key, self.condition.clone());
        Ending::Ok
    }

    /// Whether a state is kept under `key`.
    #[must_use]
    pub fn has_saved(&self, key: usize) -> bool {
        self.saved.contains_key(&key)
    }

    /// Goes back to the state kept under `key`.
    pub fn restore(&mut self, key: usize) -> Ending {
        match self.saved.get(&key) {
            Some(condition) => {
                self.condition = condition.clone();
                Ending::Ok
            }
            None => self.refuse(UNKNOWN),
        }
    }

    /// Forgets the state kept under `key`.
    pub fn forget(&mut self, key: usize) -> Ending {
        match self.saved.remove(&key) {
            Some(_) => Ending::Ok,
            None => self.refuse(UNKNOWN),
        }
    }

    /// The state kept under `key` as bytes, which any instance of the same FMU reads, also in another process.
    ///
    /// # Errors
    /// The ending, when there is no such state.
    pub fn serialised(&self, key: usize) -> Result<Vec<u8>, Ending> {
        let condition = self.saved.get(&key).ok_or_else(|| self.refuse(UNKNOWN))?;
        to_bytes(condition, &self.package).map_err(|error| self.refuse(&error.to_string()))
    }

    /// Keeps the state that `bytes` hold under `key`.
    pub fn deserialise(&mut self, key: usize, bytes: &[u8]) -> Ending {
        match from_bytes(bytes, &self.package) {
            Ok(condition) => {
                self.saved.insert(key, condition);
                Ending::Ok
            }
            Err(error) => self.refuse(&error.to_string()),
        }
    }
}
