//! Progress bars.

use indicatif::{ProgressBar, ProgressStyle};
use mcm::studies;

/// The progress of a study as a bar.
pub(crate) struct Parts(pub(crate) ProgressBar);

impl studies::Progress for Parts {
    fn more(&self, parts: usize) {
        self.0.inc_length(parts as u64);
    }

    fn done(&self) {
        self.0.inc(1);
    }
}

impl Parts {
    /// The bar of a study with its parts counted as `what`.
    pub(crate) fn of(what: &str) -> Self {
        Self(progress_bar(0, what))
    }
}

/// Progress bar on standard error; hidden where that is not a terminal.
pub(crate) fn progress_bar(count: u64, what: &str) -> ProgressBar {
    let bar = ProgressBar::new(count);
    let template = format!("{{bar:40}} {{pos}}/{{len}} {what}, {{elapsed}}");
    if let Ok(style) = ProgressStyle::with_template(&template) {
        bar.set_style(style);
    }
    bar.enable_steady_tick(std::time::Duration::from_millis(100));
    bar
}
