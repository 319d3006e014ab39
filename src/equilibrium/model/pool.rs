//! The chains that live in this process: models of one design and discretisation share one.

use std::sync::{Arc, Mutex, PoisonError, Weak};

use super::chain::Chain;
use super::settings::Settings;
use crate::design::Design;
use crate::error::Error;

type Live = Vec<Weak<Chain>>;

static LIVE: Mutex<Live> = Mutex::new(Vec::new());

fn live<T>(work: impl FnOnce(&mut Live) -> T) -> T {
    work(&mut LIVE.lock().unwrap_or_else(PoisonError::into_inner))
}

impl Chain {
    /// The chain of `design` under `settings`: one that lives already, or a new one.
    ///
    /// # Errors
    /// As [`Chain::new`].
    pub(crate) fn shared(design: &Design, settings: &Settings) -> Result<Arc<Self>, Error> {
        // Outside the lock, which a chain takes when it is dropped.
        let all: Vec<Arc<Self>> = live(|live| live.iter().filter_map(Weak::upgrade).collect());
        if let Some(equal) = all.iter().find(|chain| chain.is_of(design, settings)) {
            return Ok(Arc::clone(equal));
        }
        let made = Arc::new(Self::beside(design, settings, &all)?);
        live(|live| live.push(Arc::downgrade(&made)));
        Ok(made)
    }
}

impl Drop for Chain {
    fn drop(&mut self) {
        live(|live| {
            live.retain(|chain| chain.strong_count() > 0);
            if live.is_empty() {
                *live = Vec::new(); // its storage would be lost when a host unloads the library
            }
        });
    }
}
