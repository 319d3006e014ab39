//! `mcm study`: the paper's figures as tables.

use std::path::PathBuf;
use std::process::ExitCode;

use clap::ValueEnum;
use mcm::error::Error;
use mcm::studies::{self, Progress};
use rayon::prelude::*;

use super::failure::Failure;
use super::output::print;
use super::progress::Parts;
use super::study_files::{leave_study, tell};
use super::{accuracy, bifurcation, budget, comparison, fidelity, stability};

/// Computes figures of the paper as tables, and how they compare with the paper.
#[derive(clap::Args)]
#[command(
    after_help = "A study leaves its numbers in NAME.csv. Where there are values of the paper or events such as snaps and folds to \
show beside them, they are in NAME-marks.csv, with an empty x for a level. `tests/charts/draw DIR` draws them.\n\n\
`all` computes every figure of the paper and also writes the comparison to comparison.md. It does \
not include `accuracy` and `fidelity`, which measure times, `bifurcation`, `stability` and `fig9`, which take long, and \
`budget`, which is not a figure of the paper.\n\n\
Example: mcm study fig5 --out figures"
)]
pub(crate) struct Study {
    /// Figure or study to compute
    #[arg(value_enum)]
    name: Name,
    /// Folder for the tables; created if it does not exist
    #[arg(long, value_name = "DIR")]
    out: PathBuf,
}

/// Name of a study.
#[derive(Clone, Copy, PartialEq, Eq, ValueEnum)]
#[value(rename_all = "snake_case")]
enum Name {
    /// Fig. 3E: field of one ring magnet
    FieldRing,
    /// Fig. 4: choice of helix length and boundary angle
    Fig4,
    /// Fig. 5: relative magnetic moment over the number of segments
    Fig5,
    /// Fig. 7A: one segment in a perpendicular field, gain from the base ring
    Fig7a,
    /// Fig. 7B: three segments and a solid cylinder within 20 mT
    Fig7b,
    /// Fig. 7C: forces of the magnet pair on devices held straight
    Fig7c,
    /// Fig. 7D: field of the magnet pair
    Fig7d,
    /// Fig. 8: torque on the last of several rings
    Fig8,
    /// Fig. 9: devices that a magnet leads through an abdominal aorta; takes half an hour
    Fig9,
    /// A magnet passes nine segments with its field against them, and comes back
    Hysteresis,
    /// Measured values beside bands of 95 % from the tolerances of hardness, remanence and spacing
    Bands,
    /// Tip angle without any load, over the number of segments, by arrangement of the spirals
    Rest,
    /// Field and gradient that eight coils reach
    Coils,
    /// A path of the magnet in few communication steps and in many
    #[value(name = "communication-step")]
    CommunicationStep,
    /// Error against time of all methods, and their Pareto fronts
    Accuracy,
    /// How much tolerances and omissions of the model change the tip angle
    Budget,
    /// Time saved by the level auto, by tolerance
    Fidelity,
    /// Stable and unstable equilibria, their folds, and predictions of snaps
    Bifurcation,
    /// Where methods fail, by field strength and direction, from cold and warm starts
    Stability,
    /// Every figure
    All,
}

/// A study, computed while its progress is told.
type Computed = fn(&dyn Progress) -> Result<studies::Study, Error>;

impl Name {
    /// The study of this name; `None` for all, and for those with their own tables.
    fn study(self) -> Option<Computed> {
        match self {
            Self::FieldRing => Some(|_| studies::field_ring()),
            Self::Fig4 => Some(studies::fig4),
            Self::Fig5 => Some(|_| studies::fig5()),
            Self::Fig7a => Some(|_| studies::fig7a()),
            Self::Fig7b => Some(studies::fig7b),
            Self::Fig7c => Some(|_| studies::fig7c()),
            Self::Fig7d => Some(|_| studies::fig7d()),
            Self::Fig8 => Some(|_| studies::fig8()),
            Self::Fig9 => Some(|progress| studies::fig9(usize::MAX, progress)),
            Self::Hysteresis => Some(studies::hysteresis),
            Self::Bands => Some(|_| studies::bands()),
            Self::Rest => Some(|_| studies::rest()),
            Self::Coils => Some(|_| studies::coils()),
            Self::CommunicationStep => Some(studies::communication_step),
            Self::Accuracy
            | Self::Budget
            | Self::Fidelity
            | Self::Bifurcation
            | Self::Stability
            | Self::All => None,
        }
    }

    /// The name on the command line.
    fn typed(self) -> String {
        self.to_possible_value().map_or_else(String::new, |value| value.get_name().into())
    }
}

impl Study {
    /// Runs the command.
    pub(crate) fn run(&self) -> Result<ExitCode, Failure> {
        if self.out.is_file() {
            return Err(Failure(format!("{} is a file: --out names a folder", self.out.display())));
        }
        std::fs::create_dir_all(&self.out)
            .map_err(|error| Failure(format!("cannot create {}: {error}", self.out.display())))?;
        // Tried before the work, which may take long.
        tempfile::tempfile_in(&self.out)
            .map_err(|error| Failure::writing(format!("in {}", self.out.display()), error.kind()))?;
        match self.name {
            Name::Accuracy => return accuracy::run(&self.out),
            Name::Budget => return budget::run(&self.out),
            Name::Fidelity => return fidelity::run(&self.out),
            Name::Bifurcation => return bifurcation::run(&self.out),
            Name::Stability => return stability::run(&self.out),
            _ => {}
        }
        let wanted = |name: &Name| self.name == Name::All && *name != Name::Fig9 || *name == self.name;
        let chosen: Vec<_> = Name::value_variants()
            .iter()
            .filter(|name| wanted(name))
            .filter_map(|name| Some((name.typed(), name.study()?)))
            .collect();
        let parts = Parts::of("parts of {msg}");
        parts.0.set_message(self.name.typed());
        parts.more(chosen.len());
        let computed = chosen
            .into_par_iter()
            .map(|(name, study)| {
                parts.0.set_message(name.clone());
                let study = study(&parts)?;
                leave_study(&self.out, &name, &study)?;
                parts.done();
                Ok((name, study))
            })
            .collect::<Result<Vec<_>, Failure>>()?;
        parts.0.finish_and_clear();
        let table = comparison::table(computed.iter().map(|(name, study)| (name.as_str(), study)));
        if self.name == Name::All {
            return tell(&self.out, "comparison", &table);
        }
        print(table)?;
        Ok(ExitCode::SUCCESS)
    }
}
