//! `mcm solve`: one equilibrium.

mod json;
mod quantities;
mod rest;
mod table;
mod uncertainty;

use std::path::{Path, PathBuf};
use std::process::ExitCode;

use mcm::error::Error;
use mcm::manipulator::{Collapse, Followed, Manipulator, Outputs, SceneFile};
use mcm::methods::Device;
use serde_json::Value;

use self::json::Report;
use self::rest::rest_note;
use self::table::as_table;
use self::uncertainty::Told;
use super::doing::Doing;
use super::failure::Failure;
use super::files::{read_scene, refuse_same};
use super::output::{print, warn};
use super::picture::{SvgFile, shape};
use super::verdict;

/// Solves one equilibrium, starting from the unloaded shape.
#[derive(clap::Args)]
#[command(after_help = "Example: mcm solve scene.toml --json | jq .alpha_rad\n\n\
In JSON, jacobian holds exact derivatives: tip_by_magnet (6 x 6, null without a magnet) and tip_by_uniform_field (6 x 3). \
Rows: displacement (m) and rotation (rad) of the tip; columns: displacement (m) and rotation (rad) of the magnet about its \
centre, or the field (T); all along the world's axes. Where they do not exist, as at a fold, jacobian is null and \
jacobian_note says why. With --uncertainty, uncertainty.band_95 holds half the width of the band of each number, under the \
same keys, and uncertainty.sensitivities the derivatives by each number of [uncertainty], in the unit of its key; \
uncertainty is null where there are none. stability is stable, unstable, neutral (one direction is free, as about the axis of an axisymmetric \
scene) or unknown. Where no shape was found, converged is false, outcome and reason say why, progress says how far the \
solve got on the way from the unloaded shape, and all numbers of the shape are null. Where the rings pull the unloaded device shut, \
or bend it by more than 90 deg, reason names a number of the design with which it stands. warnings, where there are \
any, names numbers of the scene that look like those of another unit.\n\n\
Exit status: 0 solved and stable (or stability unknown: any \
method but \"potential\"), 1 bad input, 2 not converged, \
3 solved but known to be unstable, 4 solved but neutral.")]
pub(crate) struct Solve {
    /// Scene file (TOML)
    scene: PathBuf,
    /// Print JSON in SI units instead of a table
    #[arg(long)]
    json: bool,
    /// Number of centreline points in the shape
    #[arg(long, value_name = "N", default_value_t = 101)]
    shape_points: usize,
    /// Draw the shape to scale, with rings, vessel, magnets, coils and forces of the wall, in the plane in which it bends
    #[arg(long, value_name = "OUT.svg")]
    picture: Option<PathBuf>,
    /// With --picture: draw in this plane
    #[arg(long, value_name = "PLANE", requires = "picture")]
    view: Option<shape::Plane>,
    /// Bands of 95 % of all outputs, from the standard deviations in the scene's table [uncertainty]
    #[arg(long)]
    uncertainty: bool,
    /// With --uncertainty: also draw and solve this many random devices, which tells how likely a snap is
    #[arg(long, value_name = "N", requires = "uncertainty")]
    samples: Option<usize>,
}

impl Solve {
    /// Runs the command.
    pub(crate) fn run(&self) -> Result<ExitCode, Failure> {
        let written: Vec<&Path> = self.picture.iter().map(PathBuf::as_path).collect();
        refuse_same(&[&self.scene], &written)?;
        let picture = self.picture.as_deref().map(|path| SvgFile::at("--picture", path)).transpose()?;
        let file = read_scene(&self.scene)?;
        let scene = file.scene()?;

        let (level, budget) = (scene.settings.interaction.name(), scene.settings.time_budget);
        let doing = Doing::now(format!("making the models of level {level}"));
        let mut manipulator = Device::of(&scene, self.shape_points)?;
        doing.then(format!(
            "solving at level {level}, which may take {budget} s of processor time (model.time_budget_s)"
        ));
        manipulator.solve(&scene.inputs)?;

        doing.then("derivatives and stability margin");
        let jacobian = manipulator.jacobian();
        manipulator.measure_margin();
        let mut outputs = manipulator.measure_strains().clone();
        if let Some(picture) = picture.filter(|_| verdict::converged(&outputs)) {
            doing.then("drawing");
            picture.fill(&shape::draw(&self.scene.display().to_string(), &scene, &outputs, self.view)?)?;
        }
        if scene.settings.mutual_wrenches {
            doing.then("the wrench of magnets and coils on one another");
            outputs.mutual_wrenches = scene.inputs.mutual_wrenches(&scene.sources)?;
        }

        let bands = self.bands(&file, manipulator.manipulator(), &doing)?;
        doing.then("whether the rings pull the unloaded device shut");
        let collapse = Collapse::of(&file, &scene, &outputs)?;
        drop(doing);

        let collapse = collapse.as_ref();
        print(if self.json {
            let uncertainty = self.uncertainty.then(|| bands.as_ref().map_or(Value::Null, Told::as_json));
            let (magnet, warnings) = (scene.sources.magnet().is_some(), file.warnings()?);
            let method = manipulator.method();
            let (outputs, jacobian) = (&outputs, &jacobian);
            let report = Report { method, outputs, collapse, jacobian, magnet, uncertainty, warnings };
            format!("{:#}\n", report.as_json())
        } else {
            let note = bands.as_ref().map_or_else(String::new, Told::note);
            as_table(&outputs, bands.as_ref()) + &note + &rest_note(&scene, &outputs, collapse)
        })?;
        Ok(exit_status(&outputs, collapse))
    }

    /// Bands of the outputs, where they are asked for and exist; a warning says why not.
    fn bands(
        &self,
        file: &SceneFile,
        manipulator: Option<&Manipulator>,
        doing: &Doing,
    ) -> Result<Option<Told>, Failure> {
        if !self.uncertainty {
            return Ok(None);
        }
        let Some(manipulator) = manipulator else {
            warn("no bands: they need method \"potential\"");
            return Ok(None);
        };

        doing.then("bands of the outputs");
        match Told::of(file, manipulator, self.samples) {
            Ok(bands) => Ok(Some(bands)),
            Err(error @ Error::NoDerivatives(_)) => {
                warn(&format!("no bands: {error}"));
                Ok(None)
            }
            Err(error) => Err(error.into()),
        }
    }
}

fn exit_status(outputs: &Outputs, collapse: Option<&Collapse>) -> ExitCode {
    if let Some(doubt) = verdict::doubt(outputs) {
        warn(&doubt);
    }
    if let Some(shut) = collapse.filter(|_| verdict::converged(outputs)) {
        warn(&shut.to_string());
    }
    let Some((status, message)) = verdict::warning(outputs, collapse) else {
        return ExitCode::SUCCESS;
    };
    warn(&message);
    status.into()
}
