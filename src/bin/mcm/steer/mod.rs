//! `mcm steer`: inputs that bring the tip to a target.

mod keys;
mod table;

use std::path::PathBuf;
use std::process::ExitCode;

use mcm::manipulator::{Inputs, Scene};
use mcm::steer::{Limit, Limits, Move, Residual, Steering, Step, Target, Tolerances};
use nalgebra::Vector3;

use self::keys::{keys, values};
use self::table::targets;
use super::failure::{Failure, NOT_CONVERGED};
use super::files::{read_scene, refuse_same};
use super::output::{Table, print, warn};
use super::progress::progress_bar;
use super::sweep::{Columns, Row, Way};

const MM_PER_M: f64 = 1e3;

/// Brings the tip to a target by moving the magnet, the field, the shaft or currents, along a way without a snap
#[derive(clap::Args)]
#[command(
    group(clap::ArgGroup::new("aim").required(true).multiple(true)
        .args(["tip_angle_deg", "tip_position_mm", "tip_direction", "magnetic_force_mn", "targets", "to"])),
    after_help = "The first place is the scene's. Every step of the way is solved from the shape before; none snaps. Where the target \
cannot be reached, the message names what stops the tip and the way ends as near as it could come.\n\n\
PATH.csv of --targets has a row for each target and some of the columns tip_x_mm, tip_y_mm, tip_z_mm, tip_direction_x, \
tip_direction_y, tip_direction_z, alpha_deg; they are followed one after the other. --to takes the moved inputs of another scene as \
goal, and looks for a way round where the straight one snaps.\n\n\
OUT.csv has the moved keys and the columns of `mcm sweep`, a row for each step of the way, the last one at the target.\n\n\
Example: mcm steer scene.toml --tip-angle-deg 60 --move magnet.position --keep-away-mm 30 --out way.csv\n\n\
Exit status: 0 reached, 1 bad input, 2 not reached (the way is written)."
)]
pub(crate) struct Steer {
    /// Scene file (TOML)
    scene: PathBuf,
    /// Angle between the tip's axis and the base's, deg
    #[arg(long, value_name = "A", allow_hyphen_values = true, conflicts_with_all = ["tip_direction", "targets", "to"])]
    tip_angle_deg: Option<f64>,
    /// Position of the tip, mm
    #[arg(long, value_name = "X,Y,Z", value_parser = vector, allow_hyphen_values = true, conflicts_with_all = ["targets", "to"])]
    tip_position_mm: Option<Vector3<f64>>,
    /// Direction of the tip's axis
    #[arg(long, value_name = "X,Y,Z", value_parser = vector, allow_hyphen_values = true, conflicts_with_all = ["targets", "to"])]
    tip_direction: Option<Vector3<f64>>,
    /// Force of the external field on the device, mN
    #[arg(long, value_name = "X,Y,Z", value_parser = vector, allow_hyphen_values = true, conflicts_with_all = ["targets", "to"])]
    magnetic_force_mn: Option<Vector3<f64>>,
    /// CSV file with targets
    #[arg(long, value_name = "PATH.csv", conflicts_with = "to")]
    targets: Option<PathBuf>,
    /// Scene file whose moved inputs are the goal
    #[arg(long, value_name = "GOAL.toml")]
    to: Option<PathBuf>,
    /// With --to: number of random inputs tried where the straight way snaps
    #[arg(long, value_name = "N", default_value_t = 200)]
    tries: usize,
    /// What may move: magnet.position, magnet.orientation, magnet.strength, field.uniform, feed.insertion, coil.current
    #[arg(long = "move", value_name = "INPUT,...", value_delimiter = ',', required = true)]
    moves: Vec<String>,
    /// Least gap between the magnet and the device, mm
    #[arg(long, value_name = "D", default_value_t = 1.0)]
    keep_away_mm: f64,
    /// Box in which the magnet's centre stays, mm
    #[arg(
        long,
        value_name = "X0,X1,Y0,Y1,Z0,Z1",
        value_delimiter = ',',
        num_args = 1,
        allow_hyphen_values = true
    )]
    box_mm: Option<Vec<f64>>,
    /// Least stability margin, from 0 to below 1
    #[arg(long, value_name = "M", default_value_t = 0.0)]
    margin: f64,
    /// Largest uniform field, mT
    #[arg(long, value_name = "B")]
    field_mt: Option<f64>,
    /// Longest displacement of the magnet in a step, mm
    #[arg(long, value_name = "D", default_value_t = 5.0)]
    step_mm: f64,
    /// Largest turn of the magnet in a step, deg
    #[arg(long, value_name = "A", default_value_t = 5.0)]
    turn_deg: f64,
    /// How near counts as reached, um of the position
    #[arg(long, value_name = "D", default_value_t = 1.0)]
    tolerance_um: f64,
    /// CSV file for the way
    #[arg(long, value_name = "OUT.csv")]
    out: Option<PathBuf>,
}

/// Three numbers with commas between them.
fn vector(text: &str) -> Result<Vector3<f64>, String> {
    let numbers: Result<Vec<f64>, _> = text.split(',').map(|part| part.trim().parse::<f64>()).collect();
    match numbers.map_err(|error| error.to_string())?.as_slice() {
        [x, y, z] => Ok(Vector3::new(*x, *y, *z)),
        other => Err(format!("{} numbers instead of three, as in 0,-5.5,20", other.len())),
    }
}

/// What became of the question.
struct Found {
    way: Vec<Step>,
    limit: Option<Limit>,
    note: String,
    /// How far it is from a target that is not reached.
    off: Option<String>,
}

impl Steer {
    /// Runs the command.
    pub(crate) fn run(&self) -> Result<ExitCode, Failure> {
        let read: Vec<_> =
            [Some(&self.scene), self.targets.as_ref(), self.to.as_ref()].into_iter().flatten().collect();
        let read: Vec<_> = read.into_iter().map(PathBuf::as_path).collect();
        let written: Vec<_> = self.out.iter().map(PathBuf::as_path).collect();
        refuse_same(&read, &written)?;

        let scene = read_scene(&self.scene)?.scene()?;
        let moves =
            self.moves.iter().map(|name| Move::named(name, &scene)).collect::<Result<Vec<_>, _>>()?.concat();

        let mut table = self.out.as_deref().map(Table::at).transpose()?;
        let columns = Columns::of(&scene);
        if let Some(table) = &mut table {
            table.header(columns.header(keys(&moves).iter().map(String::as_str)))?;
        }

        let tolerances = Tolerances { position: self.tolerance_um / 1e6, ..Tolerances::default() };
        let mut steering = Steering::new(&scene, &moves, self.limits()?)?.with_tolerances(tolerances)?;
        let start = Step { inputs: steering.inputs().clone(), outputs: steering.outputs().clone() };

        let found = self.found(&mut steering, &moves)?;
        if let Some(mut table) = table {
            for step in [start].iter().chain(&found.way) {
                let row = Row::new(columns, values(&moves, &step.inputs), Way::Forth, &step.outputs, None);
                table.row(row.cells())?;
            }
            table.complete()?;
        }

        print(format!("{}\n{} steps, none snaps\n{}", found.note, found.way.len(), here(&moves, &steering)))?;

        let Some(limit) = found.limit else { return Ok(ExitCode::SUCCESS) };
        let off = found.off.map_or_else(String::new, |off| format!("; {off}"));
        warn(&format!("not reached: {limit}{off}"));
        Ok(NOT_CONVERGED.into())
    }

    fn found(&self, steering: &mut Steering, moves: &[Move]) -> Result<Found, Failure> {
        if let Some(goal) = &self.to {
            return self.past_folds(steering, &goal_of(steering, &read_scene(goal)?.scene()?, moves));
        }
        if let Some(path) = &self.targets {
            return along(steering, &targets(path)?);
        }
        let target = Target {
            position: self.tip_position_mm.map(|position| position / MM_PER_M),
            direction: self.tip_direction,
            angle: self.tip_angle_deg.map(f64::to_radians),
            force: self.magnetic_force_mn.map(|force| force / MM_PER_M),
        };
        let answer = steering.to(&target)?;
        let off = told(&answer.residual);
        let note = format!("{}: {off}", if answer.reached { "reached" } else { "nearest" });
        Ok(Found { way: answer.way, limit: answer.limit, note, off: Some(off) })
    }

    /// The way to other inputs.
    fn past_folds(&self, steering: &mut Steering, goal: &Inputs) -> Result<Found, Failure> {
        let plan = steering.plan(goal, None, self.tries)?;
        let note = match (plan.straight, plan.limit) {
            (None, _) => "the straight way leads there".into(),
            (Some(limit), None) => {
                format!("a way round was found after {} tries; on the straight one, {limit}", plan.tries)
            }
            (Some(limit), Some(_)) => format!("on the straight way, {limit}"),
        };
        Ok(Found { way: plan.way, limit: plan.limit, note, off: None })
    }

    fn limits(&self) -> Result<Limits, Failure> {
        let workspace = match self.box_mm.as_deref() {
            None => None,
            Some(&[x0, x1, y0, y1, z0, z1]) => {
                Some([Vector3::new(x0, y0, z0) / MM_PER_M, Vector3::new(x1, y1, z1) / MM_PER_M])
            }
            Some(other) => {
                let given = other.len();
                return Err(Failure(format!(
                    "--box-mm has {given} numbers, expected six: X0,X1,Y0,Y1,Z0,Z1"
                )));
            }
        };
        Ok(Limits {
            workspace,
            distance: self.keep_away_mm / MM_PER_M,
            margin: self.margin,
            field: self.field_mt.map(|field| field / 1e3),
            step: self.step_mm / MM_PER_M,
            turn: self.turn_deg.to_radians(),
        })
    }
}

/// The way along targets, up to the first that is not met.
fn along(steering: &mut Steering, targets: &[Target]) -> Result<Found, Failure> {
    let bar = progress_bar(targets.len() as u64, "targets");
    let (mut way, mut limit, mut worst) = (Vec::new(), None, 0.0_f64);
    let (mut met, mut off) = (0, None);
    for target in targets {
        for answer in steering.track(std::slice::from_ref(target))? {
            limit = answer.limit;
            worst = answer.residual.position.unwrap_or(0.0).max(worst);
            off = limit.map(|_| told(&answer.residual));
            way.extend(answer.way);
        }
        bar.inc(1);
        if limit.is_some() {
            break;
        }
        met += 1;
    }
    bar.finish_and_clear();
    let note = format!("{met} of {} targets met, the tip at most {:.4} um off", targets.len(), worst * 1e6);
    Ok(Found { way, limit, note, off })
}

/// The present inputs with the moved ones of another scene.
fn goal_of(steering: &Steering, goal: &Scene, moves: &[Move]) -> Inputs {
    let mut inputs = steering.inputs().clone();
    let (sources, goals) = (&mut inputs.sources, &goal.inputs.sources);
    for each in moves {
        match each {
            Move::MagnetPosition => sources[0].pose.position = goals[0].pose.position,
            Move::MagnetOrientation => sources[0].pose.rotation = goals[0].pose.rotation,
            Move::MagnetStrength => sources[0].strength = goals[0].strength,
            Move::UniformField => inputs.uniform_field = goal.inputs.uniform_field,
            Move::Insertion => inputs.insertion = goal.inputs.insertion,
            Move::CoilCurrent { source, .. } => sources[*source].strength = goals[*source].strength,
        }
    }
    inputs
}

/// What is left of a target, in words.
fn told(residual: &Residual) -> String {
    let Residual { position, direction, angle, force } = residual;
    let parts = [
        position.map(|apart| format!("position {:.4} um off", apart * 1e6)),
        direction.map(|apart| format!("direction {:.6} deg off", apart.to_degrees())),
        angle.map(|apart| format!("angle {:.6} deg off", apart.to_degrees())),
        force.map(|apart| format!("force {:.4} uN off", apart * 1e6)),
    ];
    parts.into_iter().flatten().collect::<Vec<_>>().join(", ")
}

/// The present values of what moves, as in a scene, and the stability margin.
fn here(moves: &[Move], steering: &Steering) -> String {
    let values = values(moves, steering.inputs());
    let lines: Vec<String> =
        keys(moves).iter().zip(values).map(|(key, value)| format!("{key:<32} {value:>14.6}\n")).collect();
    let margin = steering.outputs().stability_margin;
    format!("{}{:<32} {margin:>14.6}\n", lines.concat(), "stability margin")
}
