//! The command line.

mod accuracy;
mod bifurcation;
mod budget;
mod comparison;
mod failure;
mod fidelity;
mod field;
mod files;
mod pack;
mod picture;
mod solve;
mod stability;
mod study;
mod study_files;
mod sweep;
mod verdict;

use std::process::ExitCode;

use clap::{Parser, Subcommand};

use failure::Failure;

/// Statics of magnetic continuum manipulators: from the pose of the external magnet to shape, tip angle and forces.
#[derive(Parser)]
#[command(
    version,
    after_help = "A scene is a TOML file; values that it omits are those of Table 1 of the paper with nine \
segments, without field or load. Example:\n\n    [design]\n    segments = 3\n    [field]\n    \
uniform_mt = [0.0, 20.0, 0.0]\n\nExit status: 0 done (solve: solved and not known to be unstable), 1 bad input, 2 not converged, \
3 solved but known to be unstable, 4 solved but neutral."
)]
struct Arguments {
    #[command(subcommand)]
    command: Command,
}

#[derive(Subcommand)]
enum Command {
    /// Solves one equilibrium: a table for people, or JSON
    Solve(solve::Solve),
    /// Evaluates the external field of a scene, or the field of one ring, at given points
    Field(field::Field),
    /// Follows an equilibrium while numbers of the scene vary
    Sweep(sweep::Sweep),
    /// Packs a design as an FMI 2.0 co-simulation FMU
    Pack(pack::Pack),
    /// Computes the paper's figures: tables, pictures, and a comparison with the paper
    Study(study::Study),
}

fn main() -> ExitCode {
    let arguments = match Arguments::try_parse() {
        Ok(arguments) => arguments,
        // Help and version are not failures; wrong usage is bad input.
        Err(message) => {
            let printed = message.print();
            let bad = message.use_stderr() || printed.is_err();
            return if bad { failure::BAD_INPUT.into() } else { ExitCode::SUCCESS };
        }
    };
    let outcome = match arguments.command {
        Command::Solve(command) => command.run(),
        Command::Field(command) => command.run(),
        Command::Sweep(command) => command.run(),
        Command::Pack(command) => command.run(),
        Command::Study(command) => command.run(),
    };
    outcome.unwrap_or_else(Failure::report)
}
