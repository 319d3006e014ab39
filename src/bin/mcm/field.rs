//! `mcm field`: magnetic field at points.

use std::path::PathBuf;
use std::process::ExitCode;

use mcm::error::Error;
use mcm::magnetics::{AxialSource, LinearField, Sources};
use mcm::manipulator::{Inputs, PlacedSource, Scene};
use nalgebra::{Matrix3, Vector3};

use super::failure::Failure;
use super::files::{bad_table, open_table, read_scene, refuse_same};
use super::output::{Table, warn};

/// Columns of the points.
const POINT: [&str; 3] = ["x_m", "y_m", "z_m"];

/// Columns of the output after those of the point.
const FIELD: [&str; 12] = [
    "Bx_t",
    "By_t",
    "Bz_t",
    "dBx_dx_t_per_m",
    "dBx_dy_t_per_m",
    "dBx_dz_t_per_m",
    "dBy_dx_t_per_m",
    "dBy_dy_t_per_m",
    "dBy_dz_t_per_m",
    "dBz_dx_t_per_m",
    "dBz_dy_t_per_m",
    "dBz_dz_t_per_m",
];

/// Most points without a field that are named one by one.
const MOST_TOLD: usize = 20;

/// Evaluates the external field (world frame) and its gradient at points of a CSV file.
#[derive(clap::Args)]
#[command(
    after_help = "POINTS.csv has the columns x_m, y_m, z_m; FIELD.csv repeats them and adds Bx_t, By_t, Bz_t and \
the nine dBi_dxj_t_per_m, in full precision.\n\
Where the field is infinite, on an edge of a magnet, and where it is not known, within the reach of an iron core, the row has the point \
alone, and a warning names it.\n\n\
Example: mcm field scene.toml --at points.csv --out field.csv\n\n\
Exit status: 0 done, also with such rows, 1 bad input."
)]
pub(crate) struct Field {
    /// Scene file (TOML)
    scene: PathBuf,
    /// CSV file with the points
    #[arg(long, value_name = "POINTS.csv")]
    at: PathBuf,
    /// CSV file to write
    #[arg(long, value_name = "FIELD.csv")]
    out: PathBuf,
    /// Evaluate the field of one ring of the design, at the origin with its axis along z, instead of the external field
    #[arg(long)]
    ring: bool,
}

impl Field {
    /// Runs the command.
    pub(crate) fn run(&self) -> Result<ExitCode, Failure> {
        refuse_same(&[&self.scene, &self.at], &[&self.out])?;
        let mut table = Table::at(&self.out)?;
        let scene = read_scene(&self.scene)?.scene()?;
        let source = if self.ring { Source::ring(&scene)? } else { Source::external(scene) };
        let points = self.points()?;
        table.header(POINT.iter().chain(&FIELD))?;
        let mut lost = Vec::new();
        for (line, point) in points {
            match source.field_gradient(&point) {
                Ok((field, gradient)) => {
                    // Matrices are stored by column; the table lists dBx_dx, dBx_dy, ... by row.
                    let numbers = [point, field];
                    let row: Vec<f64> =
                        numbers.iter().flatten().chain(&gradient.transpose()).copied().collect();
                    table.row(row)?;
                }
                Err(error) => {
                    let empty = FIELD.map(|_| None);
                    let row: Vec<Option<f64>> = point.iter().copied().map(Some).chain(empty).collect();
                    table.row(row)?;
                    let [x, y, z] = point.into();
                    lost.push(format!("line {line}, ({x}, {y}, {z}) m has no field: {error}"));
                }
            }
        }
        table.complete()?;
        self.tell(&lost);
        Ok(ExitCode::SUCCESS)
    }

    /// Warns of points that have no field.
    fn tell(&self, lost: &[String]) {
        let file = self.at.display();
        for each in lost.iter().take(MOST_TOLD) {
            warn(&format!("{file}, {each}"));
        }
        if lost.len() > MOST_TOLD {
            warn(&format!("{file}: {} more points have no field", lost.len() - MOST_TOLD));
        }
    }

    /// The points (m) with their line numbers in the file.
    fn points(&self) -> Result<Vec<(u64, Vector3<f64>)>, Failure> {
        let name = self.at.display();
        let mut table = open_table(&self.at)?;
        let header = table.headers().map_err(|error| bad_table(&self.at, &error))?.clone();

        let mut columns = [0; 3];
        for (column, wanted) in columns.iter_mut().zip(POINT) {
            *column = header.iter().position(|title| title == wanted).ok_or_else(|| {
                let titles: Vec<&str> = header.iter().collect();
                Failure(format!("{name} has no column {wanted}; it has {}", titles.join(", ")))
            })?;
        }

        let mut points = Vec::new();
        for record in table.records() {
            let record = record.map_err(|error| bad_table(&self.at, &error))?;
            let line = record.position().map_or(0, csv::Position::line);
            let mut point = Vector3::zeros();
            for ((entry, &column), title) in point.iter_mut().zip(&columns).zip(POINT) {
                let text = record.get(column).unwrap_or_default();
                *entry = text.parse().ok().filter(|number: &f64| number.is_finite()).ok_or_else(|| {
                    Failure(format!("{name}, line {line}: {title} = \"{text}\" is not a finite number"))
                })?;
            }
            points.push((line, point));
        }

        Ok(points)
    }
}

/// Source of the field.
enum Source {
    Ring(AxialSource),
    External { inputs: Box<Inputs>, sources: Sources },
}

impl Source {
    fn ring(scene: &Scene) -> Result<Self, Failure> {
        let design = scene.design()?;
        let ring = design.rings().next();
        let ring = ring.ok_or_else(|| Failure("the design of this scene has no ring".into()))?;
        Ok(Self::Ring(AxialSource::new(ring.inner_radius, ring.outer_radius, ring.length, ring.remanence)?))
    }

    fn external(scene: Scene) -> Self {
        Self::External { inputs: Box::new(scene.inputs), sources: scene.sources }
    }

    /// Field (T) and gradient (T/m) at a point (m) in the world frame.
    fn field_gradient(&self, point: &Vector3<f64>) -> Result<(Vector3<f64>, Matrix3<f64>), Error> {
        let (inputs, sources) = match self {
            Self::Ring(ring) => return ring.field_gradient(point),
            Self::External { inputs, sources } => (inputs, sources),
        };
        let background = LinearField::new(inputs.uniform_field, inputs.field_gradient);
        let (mut field, mut gradient) = (background.at(point), background.gradient());
        for (source, PlacedSource { pose, strength }) in sources.list().iter().zip(&inputs.sources) {
            let (own_field, own_gradient) = source.field_gradient_from(pose, point)?;
            field += own_field * *strength;
            gradient += own_gradient * *strength;
        }
        Ok((field, gradient))
    }
}
