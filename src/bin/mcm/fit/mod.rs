//! `mcm fit`: numbers of the scene from measured rows.

mod chart;
mod report;

use std::path::{Path, PathBuf};
use std::process::ExitCode;
use std::str::FromStr;

use mcm::fit::{Loss, Measurements, Settings};
use mcm::manipulator::SceneFile;

use super::doing::Doing;
use super::failure::{Failure, NOT_CONVERGED};
use super::files::{bad_table, is_scene, open_table, read_scene, refuse_over};
use super::output::{Output, print, warn};
use super::picture::SvgFile;

/// Finds numbers of the scene from measured rows, and how sure they are.
#[derive(clap::Args)]
#[command(
    after_help = "DATA.csv has a row for each measurement. Its columns are inputs, by their key in the scene (field.uniform_mt[2], \
magnet.position_mm[3], ...) or their name in the FMU in SI units (field.uniform[2], ...); measured outputs, by the names of `mcm sweep` \
(tip_x_mm, alpha_deg or tip_angle_deg, magnetic_force_x_n, ...); and sd_ before the name of an output, the standard deviation of each of \
its values. Other inputs keep the scene's values. An empty cell was not measured.\n\n\
Where no standard deviation is stated, all values count alike, and how well they are measured follows from what is left; outputs in \
different units then need --sigma. Each row is solved from the unloaded shape. The fit starts at the scene's values.\n\n\
FIT.toml is the scene with the fitted values, and tables [uncertainty] and [correlation], for `mcm solve FIT.toml --uncertainty`.\n\n\
Example: mcm fit scene.toml --measured data.csv --vary design.helix.shore_a --vary design.ring.remanence_t --out fit.toml\n\n\
Exit status: 0 done, 1 bad input, 2 some rows do not count because they have no shape, or the fit did not come to an end (the scene is \
written)."
)]
pub(crate) struct Fit {
    /// Scene file (TOML)
    scene: PathBuf,
    /// CSV file with the measured rows
    #[arg(long, value_name = "DATA.csv")]
    measured: PathBuf,
    /// A number of the scene to find
    #[arg(long, value_name = "KEY", required = true)]
    vary: Vec<String>,
    /// Scene with the fitted values
    #[arg(long, value_name = "FIT.toml")]
    out: PathBuf,
    /// Standard deviation of an output, in the unit of its column, where the table states none
    #[arg(long, value_name = "OUTPUT=VALUE")]
    sigma: Vec<Deviation>,
    /// Let outliers count little: the Huber loss instead of squares
    #[arg(long)]
    robust: bool,
    /// Draw measured against computed values, and residuals
    #[arg(long, value_name = "OUT.svg")]
    picture: Option<PathBuf>,
}

/// A standard deviation of an output.
#[derive(Debug, Clone)]
struct Deviation {
    output: String,
    value: f64,
}

impl FromStr for Deviation {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        let parts =
            text.split_once('=').and_then(|(output, value)| Some((output, value.trim().parse().ok()?)));
        let (output, value) = parts
            .ok_or_else(|| format!("\"{text}\" is not of the form OUTPUT=VALUE, as in alpha_deg=0.5"))?;
        Ok(Self { output: output.trim().into(), value })
    }
}

impl Fit {
    /// Runs the command.
    pub(crate) fn run(&self) -> Result<ExitCode, Failure> {
        let written: Vec<&Path> =
            [Some(&self.out), self.picture.as_ref()].into_iter().flatten().map(PathBuf::as_path).collect();
        refuse_over(&[&self.scene, &self.measured], &written)?;

        if !is_scene(&self.out) {
            return Err(Failure(format!("--out {} must end in .toml: it is a scene", self.out.display())));
        }
        if let Some((key, _)) = self.vary.iter().find_map(|key| key.split_once('=')) {
            return Err(Failure(format!(
                "--vary takes a key alone here, --vary {key}: the fit starts at the scene's value"
            )));
        }

        let picture = self.picture.as_deref().map(|path| SvgFile::at("--picture", path)).transpose()?;

        // All files are opened before the fit, which may take minutes.
        let file = read_scene(&self.scene)?;
        let measured = self.measurements(&file)?;
        let out = Output::at(&self.out)?;

        let doing = Doing::now(format!("fitting {} rows", measured.rows().len()));
        let loss = if self.robust { Loss::Huber } else { Loss::Squares };
        let settings = Settings { loss, ..Settings::default() };
        let fit = mcm::fit::Fit::new(&file, &self.vary, &measured, &settings)?;

        if let Some(picture) = picture {
            doing.then("drawing");
            picture.fill(&chart::of(&fit).draw())?;
        }

        drop(doing);
        out.fill(fit.scene()?.to_toml()?.as_bytes())?;
        print(report::of(&fit))?;

        let ignored = measured.ignored();
        if !ignored.is_empty() {
            print(format!("\ncolumns that are neither inputs nor measured: {}\n", ignored.join(", ")))?;
        }
        for (line, reason) in &fit.lost {
            warn(&format!("line {line} does not count: {reason}"));
        }
        for (line, reason) in &fit.doubtful {
            warn(&format!("line {line} {reason}"));
        }
        if !fit.converged {
            warn("the fit did not come to an end: its values are the best so far");
        }

        let complete = fit.converged && fit.lost.is_empty();
        Ok(if complete { ExitCode::SUCCESS } else { NOT_CONVERGED.into() })
    }

    fn measurements(&self, file: &SceneFile) -> Result<Measurements, Failure> {
        let name = self.measured.display();
        let mut table = open_table(&self.measured)?;
        let bad = |error: csv::Error| bad_table(&self.measured, &error);
        let header = table.headers().map_err(bad)?.clone();
        let titles: Vec<&str> = header.iter().collect();
        let records = table.records().collect::<Result<Vec<_>, _>>().map_err(bad)?;
        let line = |record: &csv::StringRecord| record.position().map_or(0, csv::Position::line);
        let rows = records.iter().map(|record| (line(record), record.iter().collect()));
        let within = |error: mcm::error::Error| Failure(format!("{name}: {error}"));
        let measured = Measurements::parse(file, &titles, rows).map_err(within)?;
        let mut deviations = self.sigma.iter();
        let with = deviations.try_fold(measured, |measured, Deviation { output, value }| {
            measured.with_deviation(output, *value)
        });
        Ok(with?)
    }
}
