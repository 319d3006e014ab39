//! `mcm sweep`: equilibria while numbers of the scene vary.

mod journal;
mod range;
mod rows;
mod summary;
mod walk;
mod way;

use std::path::{Path, PathBuf};
use std::process::ExitCode;

use mcm::manipulator::SceneFile;

use super::failure::{Failure, NOT_CONVERGED, STOPPED};
use super::files::{read_scene, refuse_same};
use super::interrupt;
use super::output::{Table, is_stream, print, warn};
use super::progress::progress_bar;
use journal::{Journal, Kept};
use range::{MOST_VALUES, Range};
pub(super) use rows::{Columns, Row};
use walk::{Plan, Walk};
pub(super) use way::Way;

/// Follows one branch along the first key, for every combination of the other keys.
#[derive(clap::Args)]
#[command(
    after_help = "KEY is a path in the scene file with indices from 1. Along the first key each solve starts from \
the shape of the one before, as the device would, in steps of at most a hundredth of the range; the combinations of the \
others run in parallel, each from the unloaded shape. Where the branch folds and the shape snaps, the value is located \
to 1e-5 of the range and reported, with the angles before and after. Forces and fields are in the world frame, units \
are in the column names. Scenes with a vessel have columns of its contacts (contact_force_*_n, contact_count, \
largest_contact_force_n, largest_indentation_m), those with a shaft feed_length_m and feed_reaction_force_n.\n\n\
Examples, a field that grows, for three core lengths; a field that turns there and back; a magnet that turns:\n    \
mcm sweep scene.toml --vary 'field.uniform_mt[2]=0:25:26' --vary design.helix.length_mm=3:5:3 --out sweep.csv\n    \
mcm sweep scene.toml --vary field.turn_deg=0:170:171 --back --folds folds.csv --out sweep.csv\n    \
mcm sweep scene.toml --vary magnet.turn_deg=0:90:91 --out sweep.csv\n\n\
Rows that did not converge have no shape: outcome says why, progress how far the last step to them got; the next row starts \
from the unloaded shape. The time budget of the scene (model.time_budget_s) covers all steps to a row and the search for folds; \
reason says what was left out, and where the error of a shape is larger than its tolerance.\n\n\
Until all rows are there they are in OUT.csv.part, in the order in which they were found: after Ctrl-C, a crash or with a full \
disk the same command with --resume goes on from there and ends with the same table.\n\n\
Exit status: 0 done, 1 bad input, 2 some rows did not converge (all files are written), 130 stopped by Ctrl-C."
)]
pub(crate) struct Sweep {
    /// Scene file (TOML)
    scene: PathBuf,
    /// A key and its values: COUNT values from START to STOP, both included
    #[arg(long, value_name = "KEY=START:STOP:COUNT", required = true)]
    vary: Vec<Range>,
    /// Then vary the first key back from its last value to its first, starting on the branch reached
    #[arg(long)]
    back: bool,
    /// CSV file for the results
    #[arg(long, value_name = "OUT.csv")]
    out: PathBuf,
    /// CSV file for the folds: the value of each, and the angles before and after
    #[arg(long, value_name = "FOLDS.csv")]
    folds: Option<PathBuf>,
    /// Go on with a sweep that was cut short, from the rows that it left in OUT.csv.part
    #[arg(long)]
    resume: bool,
}

/// The files that a sweep fills at its end.
struct Tables {
    rows: Table,
    folds: Option<Table>,
}

impl Sweep {
    /// Runs the command.
    pub(crate) fn run(&self) -> Result<ExitCode, Failure> {
        let part = part_of(&self.out);
        let written = [Some(self.out.as_path()), self.folds.as_deref(), part.as_deref()];
        refuse_same(&[&self.scene], &written.into_iter().flatten().collect::<Vec<_>>())?;
        let total = self.count()?;
        let file = read_scene(&self.scene)?;
        self.warn_of_values(&file)?;
        let checking = progress_bar(total, "values checked");
        let plan = Plan::new(file, &self.vary, self.back, || checking.inc(1))?;
        checking.finish_and_clear();
        // All outputs are tried before the first solve.
        let tables =
            Tables { rows: Table::at(&self.out)?, folds: self.folds.as_deref().map(Table::at).transpose()? };
        let (journal, kept) = match &part {
            Some(part) => plan.journal(part, self.resume).map(|(journal, kept)| (Some(journal), kept))?,
            None => (None, plan.nothing_kept()),
        };
        interrupt::ask();
        let filled = self.fill(&plan, tables, journal.as_ref(), kept);
        let left = journal.as_ref().map_or_else(String::new, |journal| {
            format!("; the rows so far are in {}, and --resume goes on", journal.path().display())
        });
        match filled {
            Ok(Some(walks)) => {
                journal.map_or(Ok(()), Journal::remove)?;
                self.report(&walks)
            }
            Ok(None) => {
                warn(&format!("stopped{left}"));
                Ok(STOPPED.into())
            }
            Err(failure) => Err(Failure(failure.0 + &left)),
        }
    }

    /// Walks all walks and writes their tables; `None` if they were stopped before the end.
    fn fill(
        &self,
        plan: &Plan,
        tables: Tables,
        journal: Option<&Journal>,
        kept: Vec<Kept>,
    ) -> Result<Option<Vec<Walk>>, Failure> {
        let Tables { rows: mut table, folds } = tables;
        let [_, rows] = plan.rows();
        let bar = progress_bar(rows as u64, "rows");
        let walks = plan.run(journal, kept, &bar)?;
        bar.finish_and_clear();
        if let Some(walks) = &walks {
            let keys = self.keys();
            table.header(plan.columns().header(keys.iter().copied()))?;
            walks.iter().flat_map(|walk| &walk.rows).try_for_each(|row| table.row(row.cells()))?;
            folds.map_or(Ok(()), |folds| summary::write_folds(folds, &keys, walks))?;
            table.complete()?;
        }
        Ok(walks)
    }

    /// Warns of keys with values that look like those of another unit, while the scene's own does not.
    fn warn_of_values(&self, file: &SceneFile) -> Result<(), Failure> {
        let own = file.warnings()?;
        for Range { key, values } in &self.vary {
            // Of values in a row the first or the last is the oddest.
            for value in values.first().into_iter().chain(values.last()) {
                let varied = file.with(key, *value)?.warnings()?;
                if let Some(odd) = varied.into_iter().find(|odd| !own.contains(odd)) {
                    warn(&format!("--vary {odd}"));
                    break;
                }
            }
        }
        Ok(())
    }

    fn keys(&self) -> Vec<&str> {
        self.vary.iter().map(|range| range.key.as_str()).collect()
    }

    /// Number of combinations of all values. A key may occur once only.
    fn count(&self) -> Result<u64, Failure> {
        for (number, range) in self.vary.iter().enumerate() {
            if self.vary[..number].iter().any(|other| other.key == range.key) {
                return Err(Failure(format!("--vary {} occurs twice", range.key)));
            }
        }
        let counts = self.vary.iter().map(|range| range.values.len() as u64);
        let total = counts.clone().try_fold(1, u64::checked_mul).filter(|total| *total <= MOST_VALUES.into());
        total.ok_or_else(|| {
            let counts: Vec<String> = counts.map(|count| count.to_string()).collect();
            Failure(format!("{} rows are too many: at most {MOST_VALUES}", counts.join(" x ")))
        })
    }

    /// Prints a summary and returns the exit status.
    fn report(&self, walks: &[Walk]) -> Result<ExitCode, Failure> {
        let keys = self.keys();
        let rows = || walks.iter().flat_map(|walk| &walk.rows);
        let folds: usize = walks.iter().map(|walk| walk.folds.len()).sum();
        let told: String = walks.iter().map(|walk| summary::describe(&keys, walk)).collect();
        print(format!("{}: {} rows, folds met: {folds}\n{told}", self.out.display(), rows().count()))?;

        let noted = rows().filter(|row| row.converged() && row.is_noted());
        if let Some(first) = noted.clone().next() {
            let (count, value) = (noted.count(), first.value());
            warn(&format!(
                "{count} of {} rows have a reason for doubt; first {} = {value}: {}",
                rows().count(),
                keys[0],
                first.reason()
            ));
        }

        let lost = rows().filter(|row| !row.converged());
        let Some(first) = lost.clone().next() else { return Ok(ExitCode::SUCCESS) };
        warn(&format!(
            "{} of {} rows did not converge and hold no shape; first {:.0} % of the step to {} = {}: {}",
            lost.count(),
            rows().count(),
            100.0 * first.progress(),
            keys[0],
            first.value(),
            first.reason()
        ));
        Ok(NOT_CONVERGED.into())
    }
}

/// Beside the table, the file that keeps its rows until all are there; `None` for a device or a pipe.
fn part_of(out: &Path) -> Option<PathBuf> {
    let name = format!("{}.part", out.file_name()?.to_string_lossy());
    (!is_stream(out)).then(|| out.with_file_name(name))
}
