//! `mcm init`: a scene with every key, to begin with.

use std::path::PathBuf;
use std::process::ExitCode;

use super::failure::Failure;
use super::output::{Output, print};

/// Every key with its default and a remark.
const SCENE: &str = include_str!("init.toml");

/// Prints a scene with every key and its default, as a beginning of one's own.
#[derive(clap::Args)]
#[command(after_help = "Example: mcm init --out scene.toml")]
pub(crate) struct Init {
    /// File to write instead of printing; must not exist yet
    #[arg(long, value_name = "SCENE.toml")]
    out: Option<PathBuf>,
}

impl Init {
    /// Runs the command.
    pub(crate) fn run(&self) -> Result<ExitCode, Failure> {
        match &self.out {
            Some(out) if out.exists() => return Err(Failure(format!("{} exists already", out.display()))),
            Some(out) => Output::at(out)?.fill(SCENE.as_bytes())?,
            None => print(SCENE)?,
        }
        Ok(ExitCode::SUCCESS)
    }
}
