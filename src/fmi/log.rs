//! Messages to the host, by log category.

use std::cell::{Cell, RefCell};

use super::state::Ending;

/// A log category of the model description.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Category {
    /// Instantiation and initialisation that succeeded.
    Events,
    /// What a user should know about a call that succeeded.
    Warning,
    /// Calls that were refused or failed.
    Error,
    /// Every category; only for switching them on or off.
    All,
}

impl Category {
    /// The categories in the order of the model description.
    pub const ALL: [Self; 4] = [Self::Events, Self::Warning, Self::Error, Self::All];

    /// Its name in the model description.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            Self::Events => "logEvents",
            Self::Warning => "logStatusWarning",
            Self::Error => "logStatusError",
            Self::All => "logAll",
        }
    }

    /// Its description in the model description.
    #[must_use]
    pub fn description(self) -> &'static str {
        match self {
            Self::Events => "What was instantiated and initialised",
            Self::Warning => {
                "Near a fold, snapped to another branch, unexpected communication point, unused derivatives, numbers that look like \
                 those of another unit"
            }
            Self::Error => "Refused calls, equilibria that were not found",
            Self::All => "All messages",
        }
    }

    fn named(name: &str) -> Option<Self> {
        Self::ALL.into_iter().find(|category| category.name() == name)
    }
}

/// A function that passes a message to the host, with the status of the call.
pub type Sink = Box<dyn Fn(Ending, Category, &str) + Send>;

/// How often the same message may be repeated without another one in between.
const REPETITIONS: u32 = 10;

/// What is told of once a step.
#[derive(Debug, Clone, Copy)]
enum Told {
    Notice,
    Discard,
}

/// The log of an instance.
///
/// The standard demands that the logger is called whenever a call fails (section 2.1.3). Errors and notices are therefore
/// logged unless the host has switched off their category, events only if the host has switched them on.
pub struct Log {
    sink: Sink,
    on: [bool; 3],
    last: RefCell<(String, u32)>,
    /// Whether a notice, and a discarded call, were told of since the last step: a host that tries many inputs between two steps must
    /// not fill its log.
    told: Cell<[bool; 2]>,
}

impl Log {
    /// A log that passes its messages to `sink`; `events` says whether events are switched on.
    #[must_use]
    pub fn new(sink: Sink, events: bool) -> Self {
        Self { sink, on: [events, true, true], last: RefCell::default(), told: Cell::default() }
    }

    /// Logs an event.
    pub fn event(&self, message: &str) {
        self.tell(Ending::Ok, Category::Events, message);
    }

    /// Logs what a user should know about a call that succeeded.
    ///
    /// The category is the standard's for warnings, but the status is OK, which the call will return: a host that reacts to
    /// the status of a message must not see a warning that no call returns.
    pub fn notice(&self, message: &str) {
        self.tell(Ending::Ok, Category::Warning, message);
    }

    /// Logs what a user should know about a shape, if nothing of the kind was logged since the last step.
    pub fn notice_once(&self, message: &str) {
        if !self.once(Told::Notice) {
            self.notice(message);
        }
    }

    /// Logs why a call failed.
    pub fn error(&self, message: &str) {
        self.tell(Ending::Error, Category::Error, message);
    }

    /// Logs why a call was not answered, after which the host can try another one, if that was not done since the last step.
    pub fn discard_once(&self, message: &str) {
        if !self.once(Told::Discard) {
            self.tell(Ending::Discard, Category::Error, message);
        }
    }

    /// Whether this was told of since the last step; from now on it was.
    fn once(&self, what: Told) -> bool {
        let mut told = self.told.get();
        let before = std::mem::replace(&mut told[what as usize], true);
        self.told.set(told);
        before
    }

    /// Forgets what was told, after a step that succeeded: it may be repeated again.
    pub fn step_done(&self) {
        *self.last.borrow_mut() = Default::default();
        self.told.set(Default::default());
    }

    /// Passes a message on, unless it was repeated too often: a host that repeats a refused call for ever must not fill its
    /// log.
    fn tell(&self, ending: Ending, category: Category, message: &str) {
        if !self.on.get(category as usize).is_some_and(|on| *on) {
            return;
        }
        let times = {
            let mut last = self.last.borrow_mut();
            if last.0 == message {
                last.1 = last.1.saturating_add(1);
            } else {
                *last = (message.to_owned(), 1);
            }
            last.1
        };
        if times < REPETITIONS {
            (self.sink)(ending, category, message);
        } else if times == REPETITIONS {
            (self.sink)(ending, category, &format!("{message} (said {times} times, and not again)"));
        }
    }

    /// Switches categories on or off. Without names, all are switched on, or the events off: errors and notices explain
    /// what a call returns, and are switched off by name only.
    ///
    /// # Errors
    /// The name of the first category that does not exist. Nothing is changed then.
    pub fn choose<'a>(&mut self, on: bool, categories: &[&'a str]) -> Result<(), &'a str> {
        let chosen = categories.iter().map(|name| Category::named(name).ok_or(*name));
        let chosen = chosen.collect::<Result<Vec<_>, _>>()?;
        if on && chosen.is_empty() {
            self.on = [true; 3];
        } else if chosen.is_empty() {
            self.on[Category::Events as usize] = false;
        }
        for category in chosen {
            match self.on.get_mut(category as usize) {
                Some(switch) => *switch = on,
                None => self.on = [on; 3],
            }
        }
        Ok(())
    }
}

impl std::fmt::Debug for Log {
    fn fmt(&self, formatter: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        formatter.debug_struct("Log").field("on", &self.on).finish_non_exhaustive()
    }
}
