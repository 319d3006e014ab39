//! `mcm pack`: an FMU for a design, without recompiling.

mod binary;

use std::io::{Cursor, Write};
use std::path::PathBuf;
use std::process::ExitCode;
use std::time::{SystemTime, UNIX_EPOCH};

use mcm::fmi::Package;
use mcm::fmi::package::{DEFAULT_SCENE, DEFAULT_SHAPE_POINTS};
use zip::write::SimpleFileOptions;
use zip::{CompressionMethod, ZipWriter};

use super::failure::Failure;
use super::files::{read_scene, refuse_same};
use super::output::{Output, print};
use binary::Binary;

const LICENSE: &str = include_str!("../../../LICENSE");
const HEADERS_LICENSE: &str = include_str!("../../../fmu/headers/LICENSE");
const CRATES_LICENSES: &str = include_str!("../../../fmu/licenses/crates.txt");
const ICON: &[u8] = include_bytes!("../../../modelDescription/model.png");

/// Packs a design as an FMU.
#[derive(clap::Args)]
#[command(after_help = "Example: mcm pack --scene scene.toml --out mcm.fmu\n\n\
The scene's numbers become the FMU's start values; its rings, cores and cylinders determine the list of variables.\n\
An FMU may support several platforms: --binary win64=mcm.dll --binary darwin64=libmcm.dylib")]
pub(crate) struct Pack {
    /// Scene file (TOML); default: the paper's nine segments beside its magnet pair
    #[arg(long)]
    scene: Option<PathBuf>,
    /// Number of centreline points in the outputs
    #[arg(long, value_name = "N", default_value_t = DEFAULT_SHAPE_POINTS)]
    shape_points: usize,
    /// Shared library for this platform; default: the one in the folder of this program
    #[arg(long)]
    library: Option<PathBuf>,
    /// Shared library for another platform (linux64, linux32, win64, win32 or darwin64); may be repeated
    #[arg(long, value_name = "PLATFORM=FILE")]
    binary: Vec<Binary>,
    /// Leave out terminalsAndIcons.xml, for hosts that refuse it, as some versions of FMI Library
    #[arg(long)]
    no_terminals: bool,
    /// The FMU to write
    #[arg(long, value_name = "FMU")]
    out: PathBuf,
}

impl Pack {
    /// Runs the command.
    pub(crate) fn run(&self) -> Result<ExitCode, Failure> {
        let read = self.scene.iter().chain(&self.library).chain(self.binary.iter().map(Binary::library));
        refuse_same(&read.map(PathBuf::as_path).collect::<Vec<_>>(), &[&self.out])?;
        let out = Output::at(&self.out)?;

        let package = match &self.scene {
            Some(path) => Package::of(&read_scene(path)?, self.shape_points)?,
            None => Package::new(DEFAULT_SCENE, "default scene", self.shape_points)?,
        };

        let mut files: Vec<(String, Vec<u8>)> = vec![
            ("modelDescription.xml".into(), package.model_description(Some(&now()?))?.into()),
            ("model.png".into(), ICON.into()),
            ("documentation/index.html".into(), package.documentation().into()),
            ("documentation/licenses/license.txt".into(), LICENSE.into()),
            ("documentation/licenses/fmi-headers.txt".into(), HEADERS_LICENSE.into()),
            ("documentation/licenses/crates.txt".into(), CRATES_LICENSES.into()),
        ];

        if !self.no_terminals {
            files.push(("terminalsAndIcons/terminalsAndIcons.xml".into(), package.terminals()?.into()));
            files.push(("terminalsAndIcons/icon.png".into(), ICON.into()));
        }

        files.extend(binary::entries(self.library.as_deref(), &self.binary)?);
        for (name, content) in package.resources()? {
            files.push((format!("resources/{name}"), content));
        }

        let bytes = archive(&files).map_err(|reason| Failure::writing(self.out.display(), reason))?;
        out.fill(&bytes)?;
        print(format!("{} {}\n", self.out.display(), package.guid()))?;
        Ok(ExitCode::SUCCESS)
    }
}

/// The archive as FMI 2.0 allows it: Deflate only, forward slashes, no links. The same files give the same bytes.
fn archive(files: &[(String, Vec<u8>)]) -> Result<Vec<u8>, String> {
    let mut archive = ZipWriter::new(Cursor::new(Vec::new()));
    let plain = SimpleFileOptions::default().compression_method(CompressionMethod::Deflated);
    for (name, content) in files {
        let mode = if name.starts_with("binaries/") { 0o755 } else { 0o644 };
        archive.start_file(name, plain.unix_permissions(mode)).map_err(|error| error.to_string())?;
        archive.write_all(content).map_err(|error| error.to_string())?;
    }
    archive.finish().map(Cursor::into_inner).map_err(|error| error.to_string())
}

/// The current time in UTC, in the format of FMI 2.0; `SOURCE_DATE_EPOCH` makes builds reproducible.
fn now() -> Result<String, Failure> {
    let seconds = match std::env::var("SOURCE_DATE_EPOCH") {
        Ok(text) => text
            .parse()
            .map_err(|_| Failure(format!("SOURCE_DATE_EPOCH = {text} is not a number of seconds")))?,
        Err(_) => SystemTime::now().duration_since(UNIX_EPOCH).map_or(0, |time| time.as_secs()),
    };
    let (year, month, day) = date(seconds / 86_400);
    let (hour, minute, second) = (seconds / 3600 % 24, seconds / 60 % 60, seconds % 60);
    Ok(format!("{year:04}-{month:02}-{day:02}T{hour:02}:{minute:02}:{second:02}Z"))
}

/// Year, month and day of a number of days since 1970-01-01: Hinnant's `civil_from_days`
/// (<https://howardhinnant.github.io/date_algorithms.html>).
fn date(days: u64) -> (u64, u64, u64) {
    let shifted = days + 719_468;
    let (era, day_of_era) = (shifted / 146_097, shifted % 146_097);
    let year_of_era = (day_of_era - day_of_era / 1460 + day_of_era / 36_524 - day_of_era / 146_096) / 365;
    let day_of_year = day_of_era - (365 * year_of_era + year_of_era / 4 - year_of_era / 100);
    let month_from_march = (5 * day_of_year + 2) / 153;
    let day = day_of_year - (153 * month_from_march + 2) / 5 + 1;
    let month = if month_from_march < 10 { month_from_march + 3 } else { month_from_march - 9 };
    (year_of_era + era * 400 + u64::from(month <= 2), month, day)
}
