//! The command line.

mod accuracy;
mod bifurcation;
mod budget;
mod comparison;
mod doing;
mod failure;
mod fidelity;
mod field;
mod files;
mod fit;
mod follow;
mod init;
mod interrupt;
mod nearest;
mod numbers;
mod output;
mod pack;
mod picture;
mod plot;
mod progress;
mod solve;
mod stability;
mod steer;
mod study;
mod study_files;
mod sweep;
mod verdict;

use std::process::ExitCode;

use clap::{Parser, Subcommand};
use mcm::numerics::processor::Instructions;

use failure::Failure;
use output::print;

/// Statics of magnetic continuum manipulators: from the pose of the external magnet to shape, tip angle and forces.
#[derive(Parser)]
#[command(
    version,
    disable_version_flag = true,
    arg_required_else_help = true,
    after_help = "A scene is a TOML file; values that it omits are those of Table 1 of the paper with nine \
segments, without field or load. Example:\n\n    [design]\n    segments = 3\n    [field]\n    \
uniform_mt = [0.0, 20.0, 0.0]\n\nExit status: 0 done (solve: solved and not known to be unstable), 1 bad input, 2 not converged, \
3 solved but known to be unstable, 4 solved but neutral."
)]
struct Arguments {
    /// Print version
    #[arg(short = 'V', long)]
    version: bool,
    /// With --version: also which instructions evaluate fields and matrix products, and the number of threads
    #[arg(long, requires = "version")]
    verbose: bool,
    #[command(subcommand)]
    command: Option<Command>,
}

#[derive(Subcommand)]
enum Command {
    /// Prints a scene with every key, to begin with
    Init(init::Init),
    /// Solves one equilibrium: a table for people, or JSON
    Solve(solve::Solve),
    /// Evaluates the external field of a scene, or the field of one ring, at given points
    Field(field::Field),
    /// Follows an equilibrium while numbers of the scene vary
    Sweep(sweep::Sweep),
    /// Follows an equilibrium along a recorded path of inputs
    Follow(follow::Follow),
    /// Brings the tip to a target by moving the magnet, the field or the shaft
    Steer(Box<steer::Steer>),
    /// Finds numbers of the scene from measured rows, and how sure they are
    Fit(fit::Fit),
    /// Draws columns of a table as curves, to look at them
    Plot(plot::Plot),
    /// Packs a design as an FMI 2.0 FMU for co-simulation and model exchange
    Pack(pack::Pack),
    /// Computes the paper's figures: tables, and a comparison with the paper
    Study(study::Study),
}

fn main() -> ExitCode {
    let arguments = match Arguments::try_parse() {
        Ok(arguments) => arguments,
        // Help and version are not failures; wrong usage is bad input.
        Err(message) => {
            // Where nobody reads it, the exit status still says which.
            drop(message.print());
            return if message.use_stderr() { failure::BAD_INPUT.into() } else { ExitCode::SUCCESS };
        }
    };
    if let Err(failure) = interrupt::listen() {
        return failure.report();
    }
    let outcome = match arguments.command {
        _ if arguments.version => version(arguments.verbose),
        Some(Command::Init(command)) => command.run(),
        Some(Command::Solve(command)) => command.run(),
        Some(Command::Field(command)) => command.run(),
        Some(Command::Sweep(command)) => command.run(),
        Some(Command::Follow(command)) => command.run(),
        Some(Command::Steer(command)) => command.run(),
        Some(Command::Fit(command)) => command.run(),
        Some(Command::Plot(command)) => command.run(),
        Some(Command::Pack(command)) => command.run(),
        Some(Command::Study(command)) => command.run(),
        // Clap prints the help where nothing is given.
        None => Ok(failure::BAD_INPUT.into()),
    };
    outcome.unwrap_or_else(Failure::report)
}

/// Prints the version; `verbose` adds how fields at many points are evaluated, and on how many threads scenes are solved.
fn version(verbose: bool) -> Result<ExitCode, Failure> {
    let more = if verbose {
        let (instructions, threads) = (Instructions::in_use(), rayon::current_num_threads());
        format!("instructions for fields and products: {instructions}\nthreads: {threads}\n")
    } else {
        String::new()
    };
    print(format!("mcm {}\n{more}", env!("CARGO_PKG_VERSION")))?;
    Ok(ExitCode::SUCCESS)
}
