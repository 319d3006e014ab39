//! What is told to the host, under which category.

use super::state::Ending;

/// A log category of the model description.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Category {
    /// What happened, when all went well.
    Events,
    /// Warnings.
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
            Self::Warning => "Near a fold, snapped to another branch, unexpected communication point",
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

/// The way to the host's log.
///
/// Warnings and errors always go there, each once; what is merely of interest when the host asks for it.
pub struct Log {
    sink: Sink,
    events: bool,
}

impl Log {
    /// A log into `sink`; `events` says whether the host also wants what is merely of interest.
    #[must_use]
    pub fn new(sink: Sink, events: bool) -> Self {
        Self { sink, events }
    }

    /// Tells the host about an event.
    pub fn event(&self, message: &str) {
        if self.events {
            (self.sink)(Ending::Ok, Category::Events, message);
        }
    }

    /// Warns the host.
    pub fn warning(&self, message: &str) {
        (self.sink)(Ending::Warning, Category::Warning, message);
    }

    /// Tells the host why a call failed.
    pub fn error(&self, message: &str) {
        (self.sink)(Ending::Error, Category::Error, message);
    }

    /// Switches events on or off; with names, only if their category or all are named.
    ///
    /// # Errors
    /// The name of the first category that does not exist.
    pub fn choose<'a>(&mut self, on: bool, categories: &[&'a str]) -> Result<(), &'a str> {
        let chosen = categories.iter().map(|name| Category::named(name).ok_or(*name));
        let chosen = chosen.collect::<Result<Vec<_>, _>>()?;
        let named = chosen.is_empty() || chosen.iter().any(|c| matches!(c, Category::Events | Category::All));
        if named {
            self.events = on;
        }
        Ok(())
    }
}

impl std::fmt::Debug for Log {
    fn fmt(&self, formatter: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        formatter.debug_struct("Log").field("events", &self.events).finish_non_exhaustive()
    }
}
