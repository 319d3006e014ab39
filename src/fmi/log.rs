//! What is told to the host, under which category.

use std::cell::RefCell;

use super::state::Ending;

/// A log category of the model description.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Category {
    /// What happened, when all went well.
    Events,
    /// What a user should know of a call that went well.
    Warning,
    /// Refusals and failures.
    Error,
    /// All of them, when a host chooses what to hear.
    All,
}

impl Category {
    /// Every category.
    pub const ALL: [Self; 4] = [Self::Events, Self::Warning, Self::Error, Self::All];

    /// The standard's name.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            Self::Events => "logEvents",
            Self::Warning => "logStatusWarning",
            Self::Error => "logStatusError",
            Self::All => "logAll",
        }
    }

    /// What is logged under it.
    #[must_use]
    pub fn description(self) -> &'static str {
        match self {
            Self::Events => "What was instantiated and initialised",
            Self::Warning => {
                "Near a fold, snapped to another branch, unexpected communication point, unused derivatives"
            }
            Self::Error => "Refused calls, equilibria that were not found",
            Self::All => "All messages",
        }
    }

    fn named(name: &str) -> Option<Self> {
        Self::ALL.into_iter().find(|category| category.name() == name)
    }
}

/// Takes a message to the host.
pub type Sink = Box<dyn Fn(Ending, Category, &str) + Send>;

/// How often the same message is told in a row.
const REPETITIONS: u32 = 10;

/// The way to the host's log.
///
/// The standard wants the logger called whenever a call does not end well (section 2.1.3), so errors go there unless the
/// host has switched their category off, and so do notices; what is merely of interest goes there when the host asks.
pub struct Log {
    sink: Sink,
    on: [bool; 3],
    last: RefCell<(String, u32)>,
}

impl Log {
    /// A log into `sink`; `events` says whether the host also wants what is merely of interest.
    #[must_use]
    pub fn new(sink: Sink, events: bool) -> Self {
        Self { sink, on: [events, true, true], last: RefCell::default() }
    }

    /// Tells the host about an event.
    pub fn event(&self, message: &str) {
        self.tell(Ending::Ok, Category::Events, message);
    }

    /// Tells the host what a user should know of a call that went well.
    ///
    /// The category is the standard's for warnings, by which a log is filtered; the status that goes with it is that of the
    /// call, OK: a host that acts upon the statuses in its log must not see one that no call has answered.
    pub fn notice(&self, message: &str) {
        self.tell(Ending::Ok, Category::Warning, message);
    }

    /// Tells the host why a call failed.
    pub fn error(&self, message: &str) {
        self.tell(Ending::Error, Category::Error, message);
    }

    /// All is well again: what was said before may be said anew.
    pub fn relieve(&self) {
        *self.last.borrow_mut() = Default::default();
    }

    /// A host that repeats a refused call for ever does not fill its log.
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

    /// Switches categories on or off; without names events alone, as the others explain an answer.
    ///
    /// # Errors
    /// The name of the first category that does not exist; nothing has changed then.
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
