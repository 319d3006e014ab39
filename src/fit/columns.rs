//! What the columns of a measured table mean.

use super::measurable::{Measurable, is_untold};
use crate::error::Error;
use crate::manipulator::SceneFile;

/// In front of the name of an output: the standard deviation of each of its values.
const DEVIATION: &str = "sd_";

/// Columns of `mcm sweep` and `mcm follow` that are no outputs and do not act on the device.
const IGNORED: [&str; 13] = [
    "time",
    "way",
    "predicted_fold",
    "stable",
    "stability",
    "snaps",
    "converged",
    "outcome",
    "progress",
    "iterations",
    "residual",
    "interaction",
    "reason",
];

/// Inputs of the FMU, in SI units: the key of a scene for each, and what one unit is there.
const HOST: [(&str, &str, f64); 12] = [
    ("magnet.position", "magnet.position_mm", 1e3),
    ("magnet.orientation", "magnet.orientation_wxyz", 1.0),
    ("field.uniform", "field.uniform_mt", 1e3),
    ("field.gradient", "field.gradient_t_per_m", 1.0),
    ("base.position", "base.position_mm", 1e3),
    ("base.orientation", "base.orientation_wxyz", 1.0),
    ("tip.load_force", "load.tip_force_n", 1.0),
    ("tip.load_moment", "load.tip_moment_nm", 1.0),
    ("gravity", "gravity.acceleration_m_s2", 1.0),
    ("feed.insertion", "feed.insertion_mm", 1e3),
    ("feed.roll", "feed.roll_deg", 180.0 / core::f64::consts::PI),
    ("guidewire.insertion", "guidewire.insertion_mm", 1e3),
];

/// Meaning of a column.
#[derive(Debug, Clone)]
pub(super) enum Column {
    /// A number of the scene, and its unit in units of the scene.
    Input {
        key: String,
        factor: f64,
    },
    Measured(Measurable),
    Deviation(Measurable),
    Ignored,
}

impl Column {
    /// The column with this title, in a table about the scene.
    ///
    /// # Errors
    /// [`Error::Unsupported`] for a title that means nothing, naming the nearest.
    pub(super) fn of(title: &str, scene: &SceneFile) -> Result<Self, Error> {
        if IGNORED.contains(&title) || is_untold(title) {
            return Ok(Self::Ignored);
        }
        if let Some(measured) = Measurable::named(title) {
            return Ok(Self::Measured(measured));
        }
        if let Some(measured) = title.strip_prefix(DEVIATION).and_then(Measurable::named) {
            return Ok(Self::Deviation(measured));
        }
        let (name, index) = title.split_at(title.find('[').unwrap_or(title.len()));
        let host = HOST.iter().find(|row| row.0 == name);
        let (key, factor) = host.map_or((title.to_owned(), 1.0), |row| (format!("{}{index}", row.1), row.2));
        match scene.with(&key, 1.0) {
            // Whether this value is allowed does not matter here.
            Ok(_) | Err(Error::Syntax { .. } | Error::Range { .. }) => Ok(Self::Input { key, factor }),
            Err(reason) => Err(Error::Unsupported(format!(
                "column `{title}` is no output that can be measured{}, and no input: {reason}",
                nearest(title)
            ))),
        }
    }
}

fn nearest(title: &str) -> String {
    let title = title.strip_prefix(DEVIATION).unwrap_or(title);
    let similarity = |known: &Measurable| strsim::normalized_damerau_levenshtein(title, known.name());
    let best = Measurable::all().iter().max_by(|a, b| similarity(a).total_cmp(&similarity(b)));
    best.filter(|known| similarity(known) > 0.6)
        .map_or(String::new(), |known| format!(" (did you mean `{}`?)", known.name()))
}
