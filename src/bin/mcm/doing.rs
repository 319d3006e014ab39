//! What a command is doing: told on standard error once it has taken some time.

use std::io::Write;
use std::sync::{Arc, Condvar, Mutex, MutexGuard, PoisonError};
use std::thread::JoinHandle;
use std::time::Duration;

/// How long a command may be silent.
const PATIENCE: Duration = Duration::from_secs(2);

/// The present stage of a command, until this is dropped.
pub(crate) struct Doing {
    shared: Arc<Shared>,
    teller: Option<JoinHandle<()>>,
}

#[derive(Default)]
struct Shared {
    /// `None` when the command is done.
    stage: Mutex<Option<String>>,
    changed: Condvar,
}

impl Shared {
    fn stage(&self) -> MutexGuard<'_, Option<String>> {
        self.stage.lock().unwrap_or_else(PoisonError::into_inner)
    }

    /// Waits, then tells this stage and all later ones.
    fn tell(&self) {
        let start = self.stage();
        let silent = self.changed.wait_timeout_while(start, PATIENCE, |stage| stage.is_some());
        let mut stage = silent.unwrap_or_else(PoisonError::into_inner).0;
        while let Some(words) = stage.clone() {
            // Where standard error is closed nobody waits to be told.
            let _ = writeln!(std::io::stderr(), "{words} ...");
            let changed = self.changed.wait_while(stage, |stage| stage.as_ref() == Some(&words));
            stage = changed.unwrap_or_else(PoisonError::into_inner);
        }
    }
}

impl Doing {
    /// Begins with this stage.
    pub(crate) fn now(stage: impl Into<String>) -> Self {
        let shared = Arc::new(Shared { stage: Mutex::new(Some(stage.into())), ..Shared::default() });
        let told = Arc::clone(&shared);
        Self { shared, teller: Some(std::thread::spawn(move || told.tell())) }
    }

    /// Goes on to the next stage.
    pub(crate) fn then(&self, stage: impl Into<String>) {
        self.set(Some(stage.into()));
    }

    fn set(&self, stage: Option<String>) {
        *self.shared.stage() = stage;
        self.shared.changed.notify_all();
    }
}

impl Drop for Doing {
    fn drop(&mut self) {
        self.set(None);
        drop(self.teller.take().map(JoinHandle::join));
    }
}
