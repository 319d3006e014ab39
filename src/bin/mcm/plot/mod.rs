//! `mcm plot`: columns of a table as curves.

mod curves;
mod sheet;

use std::path::PathBuf;
use std::process::ExitCode;

use self::curves::Curves;
use self::sheet::Sheet;
use super::failure::Failure;
use super::files::refuse_same;
use super::output::print;
use super::picture::SvgFile;
use super::picture::chart::{Chart, Panel};
use super::picture::units::label;

/// The ordinate unless another is asked for, which also ends the columns of what was varied.
const ANGLE: &str = "alpha_deg";

/// Draws columns of a table as curves over another column.
#[derive(clap::Args)]
#[command(
    after_help = "TABLE.csv is what `mcm sweep`, `follow` or `steer` has written, or any table of numbers under titles. Without --x \
the first column that varies is the abscissa, without --y the tip angle alpha_deg is drawn, or the second column that varies. Several \
columns after --y have axes of their own below one another. Where further keys were varied (the columns before alpha_deg), each \
combination of their values has a curve.\n\n\
A curve has a gap where a value is missing. Rings mark snaps, dots lead to them and to shapes that are unstable or not converged; the \
way back is dashed. Units are read from the names of the columns.\n\n\
Examples:\n    mcm plot sweep.csv --out sweep.svg\n    \
mcm plot sweep.csv --x 'field.uniform_mt[2]' --y alpha_deg tip_z_mm stability_margin --out sweep.svg\n\n\
Browsers show SVG and Inkscape edits it; `rsvg-convert sweep.svg -o sweep.png` makes pixels of it."
)]
pub(crate) struct Plot {
    /// Table (CSV)
    #[arg(value_name = "TABLE.csv")]
    table: PathBuf,
    /// Column of the abscissa
    #[arg(long, value_name = "COLUMN")]
    x: Option<String>,
    /// Columns of the ordinates
    #[arg(long, value_name = "COLUMN", num_args = 1..)]
    y: Vec<String>,
    /// Picture (SVG)
    #[arg(long, value_name = "OUT.svg")]
    out: PathBuf,
}

impl Plot {
    /// Runs the command.
    pub(crate) fn run(&self) -> Result<ExitCode, Failure> {
        refuse_same(&[&self.table], &[&self.out])?;
        let picture = SvgFile::at("--out", &self.out)?;
        let sheet = Sheet::read(&self.table)?;
        let (x, ordinates) = self.columns(&sheet)?;
        let curves = Curves::of(&sheet, x, ANGLE)?;
        let panel = |y: usize| {
            Ok(Panel {
                labels: [x, y].map(|column| label(&sheet.titles[column])),
                curves: curves.of_column(&sheet, y)?,
                band: None,
            })
        };
        let panels = ordinates.iter().map(|y| panel(*y)).collect::<Result<_, Failure>>()?;
        let title = self.table.file_name().unwrap_or_default().to_string_lossy().into_owned();
        picture.fill(&Chart { title, one_abscissa: true, panels }.draw())?;
        let names: Vec<&str> = ordinates.iter().map(|y| sheet.titles[*y].as_str()).collect();
        let (names, x, count) = (names.join(", "), &sheet.titles[x], curves.count());
        print(format!("{}: {names} over {x}, curves: {count}\n", self.out.display()))?;
        Ok(ExitCode::SUCCESS)
    }

    /// The columns of the abscissa and of the ordinates.
    fn columns(&self, sheet: &Sheet) -> Result<(usize, Vec<usize>), Failure> {
        let mut varied = sheet.varied();
        let x = match &self.x {
            Some(name) => sheet.find(name)?,
            None => varied.next().ok_or_else(|| sheet.failure("no column of numbers varies"))?,
        };
        if !self.y.is_empty() {
            let found = self.y.iter().map(|name| sheet.find(name));
            return Ok((x, found.collect::<Result<_, Failure>>()?));
        }
        let angle = sheet.titles.iter().position(|title| title == ANGLE).filter(|angle| *angle != x);
        let y = angle.or_else(|| sheet.varied().find(|column| *column != x));
        let y = y.ok_or_else(|| sheet.failure("only one column of numbers varies: name another with --y"))?;
        Ok((x, vec![y]))
    }
}
