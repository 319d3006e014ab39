//! `mcm fit`: parameters of a device from measured rows.

mod picture;
mod rows;

use std::path::PathBuf;
use std::process::ExitCode;

use mcm::fit::{Fit as Fitted, Loss, Options};

use self::picture::study;
use self::rows::{Rows, read};
use super::doing::Doing;
use super::failure::{Failure, NOT_CONVERGED};
use super::files::{read_scene, refuse_same};
use super::output::{Output, place, print, warn};

/// Fits numbers of a scene to measured rows, and tells how sure they are
#[derive(clap::Args)]
#[command(
    after_help = "DATA.csv has a row for each measurement, in the order in which they were taken: inputs by their keys in the scene \
(field.uniform_mt[2], magnet.position_mm[1], load.tip_force_n[3], ...), measured outputs by their names in the table of `mcm sweep` \
(alpha_deg, tip_y_mm, magnetic_force_z_n, ...), and where it is known the standard deviation of an output as sd_NAME. Without \
deviations they are estimated from the residuals, one for each output. With --use, only these outputs count and other columns are left \
aside.\n\n\
FIT.toml is the scene with the fitted numbers and, in [uncertainty] and [correlation], how sure they are: \
`mcm solve FIT.toml --uncertainty` goes on from there.\n\n\
Example: mcm fit scene.toml --measured data.csv --vary design.helix.shore_a --vary design.ring.remanence_t --out fit.toml\n\n\
Exit status: 0 done, 1 bad input, 2 the rows do not tell all parameters (the scene is written without uncertainty)."
)]
pub(crate) struct Fit {
    /// Scene file (TOML): the numbers to begin with
    scene: PathBuf,
    /// CSV file with the measured rows
    #[arg(long, value_name = "DATA.csv")]
    measured: PathBuf,
    /// A number of the scene to fit, by its key; once for each
    #[arg(long, value_name = "KEY", required = true)]
    vary: Vec<String>,
    /// Measured outputs that count, if not all
    #[arg(long = "use", value_name = "NAME,...", value_delimiter = ',')]
    used: Vec<String>,
    /// Residuals beyond 1.345 deviations count by their size only (Huber's loss), so that outliers do not spoil the fit
    #[arg(long)]
    robust: bool,
    /// Draw measured and computed values and the residuals
    #[arg(long, value_name = "OUT.png")]
    picture: Option<PathBuf>,
    /// Scene file for the result
    #[arg(long, value_name = "FIT.toml")]
    out: PathBuf,
}

impl Fit {
    /// Runs the command.
    pub(crate) fn run(&self) -> Result<ExitCode, Failure> {
        let read_files = [self.scene.as_path(), self.measured.as_path()];
        let pictures: Vec<_> = self.picture.iter().map(PathBuf::as_path).collect();
        refuse_same(&read_files, &pictures)?;
        if let Some(input) = read_files.iter().find(|input| place(input) == place(&self.out)) {
            let (out, input) = (self.out.display(), input.display());
            return Err(Failure(format!("{out} would be written over {input}, which is read")));
        }
        if self.out.extension().is_none_or(|ending| ending != "toml") {
            return Err(Failure(format!("--out {} must end in .toml: it is a scene", self.out.display())));
        }
        if let Some(picture) =
            pictures.iter().find(|path| path.extension().is_none_or(|ending| ending != "png"))
        {
            return Err(Failure(format!("--picture {} must end in .png", picture.display())));
        }
        let file = read_scene(&self.scene)?;
        let rows = read(&self.measured, &file, &self.used)?;
        let output = Output::at(&self.out)?;
        let loss = if self.robust { Loss::Huber } else { Loss::Squares };
        let doing = Doing::now(format!("fitting {} rows", rows.data.len()));
        let fit = Fitted::new(&file, &self.vary, &rows.data, Options { loss, profiles: true })?;
        drop(doing);
        output.fill(fit.scene().to_toml()?.as_bytes())?;
        if let Some(picture) = &self.picture {
            super::picture::write(&study(&rows, &fit), picture)?;
        }
        print(report(&fit) + &quality(&rows, &fit))?;
        if fit.untold().is_empty() {
            return Ok(ExitCode::SUCCESS);
        }
        for untold in fit.untold() {
            warn(&untold.to_string());
        }
        Ok(NOT_CONVERGED.into())
    }
}

/// The table of parameters.
fn report(fit: &Fitted) -> String {
    let width = fit.keys().iter().map(String::len).max().unwrap_or_default().max(9);
    let head = ["start", "fitted", "deviation"].map(|name| format!("{name:>14}")).concat();
    let mut lines = vec![format!("{:<width$}{head}   interval of 95 %\n", "parameter")];
    let numbers = fit.start().iter().zip(fit.values()).zip(fit.deviations()).zip(fit.intervals());
    for (key, (((start, value), deviation), interval)) in fit.keys().iter().zip(numbers) {
        let deviation = if deviation.is_finite() { format!("{deviation:.3e}") } else { "not told".into() };
        let interval = interval.map_or("not told".into(), |[low, high]| format!("{low:.6} to {high:.6}"));
        lines.push(format!("{key:<width$}{start:>14.6}{value:>14.6}{deviation:>14}   {interval}\n"));
    }
    if let Some(covariance) = fit.covariance() {
        for (second, other) in fit.keys().iter().enumerate() {
            for (first, key) in fit.keys().iter().enumerate().take(second) {
                let size = (covariance[(first, first)] * covariance[(second, second)]).sqrt();
                let correlation = covariance[(first, second)] / size;
                lines.push(format!("correlation of {key} and {other}: {correlation:.3}\n"));
            }
        }
    }
    lines.concat()
}

/// How well each quantity is met.
fn quality(rows: &Rows, fit: &Fitted) -> String {
    let each = |(number, name): (usize, &String)| {
        let own = || fit.residuals().iter().zip(fit.noise()).skip(number).step_by(rows.names.len());
        let count = own().count();
        let mean = (own().map(|(residual, _)| residual * residual).sum::<f64>() / count as f64).sqrt();
        let largest = own().map(|(residual, _)| residual.abs()).fold(0.0, f64::max);
        let deviation = own().map(|(_, deviation)| *deviation).fold(0.0, f64::max);
        format!(
            "{name}: {count} values, residuals {mean:.3e} (root mean square), at most {largest:.3e}; deviation {deviation:.3e}\n"
        )
    };
    rows.names.iter().enumerate().map(each).collect::<Vec<_>>().concat()
}
