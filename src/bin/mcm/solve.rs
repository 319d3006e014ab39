//! `mcm solve`: one equilibrium.

use std::path::{Path, PathBuf};
use std::process::ExitCode;

use mcm::error::Error;
use mcm::manipulator::{Inputs, Jacobian, Outputs, Status};
use nalgebra::{SMatrix, Vector3};
use serde_json::{Value, json};

use super::doing::Doing;
use super::failure::Failure;
use super::files::{read_scene, refuse_same};
use super::output::{print, warn};
use super::picture::ShapeFile;
use super::verdict;

/// Solves one equilibrium, starting from the unloaded shape.
#[derive(clap::Args)]
#[command(after_help = "Example: mcm solve scene.toml --json | jq .alpha_rad\n\n\
In JSON, jacobian holds exact derivatives: tip_by_magnet (6 x 6, null without a magnet) and tip_by_uniform_field (6 x 3). \
Rows: displacement (m) and rotation (rad) of the tip; columns: displacement (m) and rotation (rad) of the magnet about its \
centre, or the field (T); all along the world's axes. Where they do not exist, as at a fold, jacobian is null and \
jacobian_note says why. stability is stable, unstable, neutral (one direction is free, as about the axis of an antiparallel \
field) or unknown. Where no shape was found, converged is false, outcome and reason say why, progress says how far the \
solve got on the way from the unloaded shape, and all numbers of the shape are null.\n\n\
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
    /// Draw the shape to scale, with rings, vessel, magnet and forces of the wall, in the plane in which it spreads most
    #[arg(long, value_name = "OUT.svg|OUT.png")]
    picture: Option<PathBuf>,
}

/// Tip angle above which an unloaded shape is explained, rad.
const REST_ANGLE: f64 = core::f64::consts::PI / 180.0;

impl Solve {
    /// Runs the command.
    pub(crate) fn run(&self) -> Result<ExitCode, Failure> {
        let written: Vec<&Path> = self.picture.iter().map(PathBuf::as_path).collect();
        refuse_same(&[&self.scene], &written)?;
        let picture = self.picture.as_deref().map(ShapeFile::at).transpose()?;
        let scene = read_scene(&self.scene)?.scene()?;
        let level = scene.settings.interaction.name();
        let doing = Doing::now(format!("making the models of level {level}"));
        let mut manipulator = scene.device(self.shape_points)?;
        let budget = scene.settings.time_budget;
        doing.then(format!(
            "solving at level {level}, which may take {budget} s of processor time (model.time_budget_s)"
        ));
        manipulator.solve(&scene.inputs)?;
        doing.then("derivatives and stability margin");
        let jacobian = manipulator.jacobian();
        let outputs = manipulator.measure_margin();
        if let Some(picture) = picture.filter(|_| verdict::converged(outputs)) {
            doing.then("drawing");
            picture.draw(&self.scene.display().to_string(), &scene, outputs)?;
        }
        drop(doing);
        print(if self.json {
            format!("{:#}\n", as_json(outputs, &jacobian, scene.magnets.is_some()))
        } else {
            as_table(outputs) + rest_note(&scene.inputs, outputs)
        })?;
        Ok(exit_status(outputs))
    }
}

fn exit_status(outputs: &Outputs) -> ExitCode {
    let Some((status, message)) = verdict::warning(outputs) else {
        return ExitCode::SUCCESS;
    };
    warn(&message);
    status.into()
}

/// Report of the solve and the shape found; without a shape, all its numbers are null.
fn as_json(outputs: &Outputs, jacobian: &Result<Jacobian, Error>, magnet: bool) -> Value {
    let vector = |v: &Vector3<f64>| json!([v.x, v.y, v.z]);
    let derivatives = jacobian.as_ref().ok().map(|jacobian| {
        json!({
            "tip_by_magnet": magnet.then(|| rows(&jacobian.tip_by_magnet())),
            "tip_by_uniform_field": rows(&jacobian.tip_by_uniform_field()),
        })
    });
    // Places of the contacts (0) or forces there (1).
    let contacts = |which: usize| {
        let places = outputs.wall.as_ref().map(|wall| wall.places.iter());
        json!(places.map(|places| places.map(|contact| vector(&contact[which])).collect::<Vec<_>>()))
    };
    let shape = [
        ("alpha_rad", json!(outputs.tip_angle)),
        ("tip_position_m", vector(&outputs.tip.position)),
        ("tip_orientation_wxyz", json!(outputs.tip.quaternion())),
        ("magnetic_force_n", vector(&outputs.magnetic_force)),
        ("magnetic_torque_nm", vector(&outputs.magnetic_torque)),
        ("base_reaction_force_n", vector(&outputs.base_reaction_force)),
        ("base_reaction_moment_nm", vector(&outputs.base_reaction_moment)),
        ("magnet_reaction_force_n", vector(&outputs.magnet_reaction_force)),
        ("magnet_reaction_torque_nm", vector(&outputs.magnet_reaction_torque)),
        ("ring_positions_m", outputs.rings.iter().map(|ring| vector(&ring.position)).collect()),
        ("core_angles_rad", json!(outputs.core_angles)),
        ("shape_m", outputs.shape.iter().map(vector).collect()),
        ("contact_force_n", json!(outputs.wall.as_ref().map(|wall| vector(&wall.force)))),
        ("contact_count", json!(outputs.wall.as_ref().map(|wall| wall.count))),
        ("largest_contact_force_n", json!(outputs.wall.as_ref().map(|wall| wall.largest_force))),
        ("largest_indentation_m", json!(outputs.wall.as_ref().map(|wall| wall.largest_indentation))),
        (
            "ring_contact_forces_n",
            json!(outputs.wall.as_ref().map(|wall| wall.rings.iter().map(vector).collect::<Vec<_>>())),
        ),
        ("contact_places_m", contacts(0)),
        ("contact_forces_n", contacts(1)),
        ("feed_length_m", json!(outputs.feed_length)),
        ("feed_reaction_force_n", json!(outputs.feed_reaction)),
        ("stable", json!(outputs.stable)),
        ("stability_margin", json!(outputs.stability_margin)),
        ("snaps", json!(outputs.snaps)),
        ("energy_j", json!(outputs.energy)),
        ("error_estimate_m", json!(outputs.error_estimate)),
    ];
    let converged = verdict::converged(outputs);
    let search = [
        ("converged", json!(converged)),
        ("status", json!(verdict::status(outputs))),
        ("outcome", json!(outputs.outcome.name())),
        ("reason", json!(verdict::reason(outputs))),
        ("progress", json!(outputs.progress)),
        ("stability", json!(verdict::stability(outputs))),
        ("iterations", json!(outputs.iterations)),
        ("residual", json!(outputs.residual)),
        ("interaction", json!(outputs.interaction.name())),
        ("method", json!(outputs.method.name())),
        ("jacobian", json!(derivatives)),
        ("jacobian_note", json!(jacobian.as_ref().err().map(ToString::to_string))),
    ];
    let shape = shape.map(|(key, value)| (key, if converged { value } else { Value::Null }));
    shape.into_iter().chain(search).map(|(key, value)| (key.to_owned(), value)).collect()
}

/// Why the manipulator is bent although nothing acts on it; empty where something does or it is nearly straight.
fn rest_note(inputs: &Inputs, outputs: &Outputs) -> &'static str {
    let loaded = *inputs != inputs.without_loads();
    if loaded || !verdict::converged(outputs) || outputs.tip_angle <= REST_ANGLE {
        return "";
    }
    "\nnote: bent at rest, without any load: rings attract the spirals beside them off the axis, and the bends of the segments add up; \
     design.spiral_start_deg turns and design.spiral = \"alternating\" mirrors them so that they cancel\n"
}

/// A matrix as a list of its rows.
fn rows<const COLUMNS: usize>(matrix: &SMatrix<f64, 6, COLUMNS>) -> Vec<Vec<f64>> {
    matrix.row_iter().map(|row| row.iter().copied().collect()).collect()
}

fn as_table(outputs: &Outputs) -> String {
    let row = |name: &str, value: String, unit: &str| format!("{name:<22} {value:>36}  {unit}\n");
    let vector = |name: &str, v: &Vector3<f64>, factor: f64, unit: &str| {
        let entry = |x: f64| format!("{:>12.4}", x * factor);
        row(name, [entry(v.x), entry(v.y), entry(v.z)].concat(), unit)
    };
    let search = format!(
        "{} iterations, residual {:.1e}, interaction {}\n",
        outputs.iterations,
        outputs.residual,
        outputs.interaction.name()
    );
    let Some(stability) = verdict::stability(outputs) else {
        return format!(
            "not converged; {search}\n{}{}",
            row("outcome", outputs.outcome.name().replace('_', " "), ""),
            row(
                "progress",
                format!("{:.1}", 100.0 * outputs.progress),
                "% of the way from the unloaded shape"
            )
        );
    };
    let status = match (outputs.status, stability) {
        (Status::NearFold, "stable") => "solved, close to a fold: a little more load and the shape snaps",
        (Status::Snapped, _) => "solved, after a snap to another branch",
        _ => "solved",
    };
    let stable = match stability {
        "neutral" => "neutral: one direction is free",
        "unknown" => "stability unknown: this model has no potential",
        known => known,
    };
    let contacts = |outputs: &Outputs| {
        let wall = outputs.wall.as_ref().map(|wall| {
            [
                row("contacts with the wall", wall.count.to_string(), ""),
                vector("force of the wall", &wall.force, 1e3, "mN"),
                row("largest contact force", format!("{:.4}", 1e3 * wall.largest_force), "mN"),
                row("largest indentation", format!("{:.4}", 1e6 * wall.largest_indentation), "um"),
            ]
            .concat()
        });
        let feed = outputs.feed_length.zip(outputs.feed_reaction).map(|(length, push)| {
            row("inserted length", format!("{:.4}", 1e3 * length), "mm")
                + &row("push at the port", format!("{:.4}", 1e3 * push), "mN")
        });
        [wall, feed].into_iter().flatten().collect::<String>()
    };
    let largest = outputs.core_angles.iter().copied().fold(0.0, f64::max);
    [
        format!("{status}; {stable}; {search}\n"),
        row("tip angle", format!("{:.4}", outputs.tip_angle.to_degrees()), "deg"),
        vector("tip position", &outputs.tip.position, 1e3, "mm"),
        vector("tip direction", &outputs.tip.axis(), 1.0, ""),
        row("largest core angle", format!("{:.4}", largest.to_degrees()), "deg"),
        vector("magnetic force", &outputs.magnetic_force, 1e3, "mN"),
        vector("magnetic torque", &outputs.magnetic_torque, 1e6, "mN.mm, about the base"),
        vector("base reaction force", &outputs.base_reaction_force, 1e3, "mN"),
        vector("base reaction moment", &outputs.base_reaction_moment, 1e6, "mN.mm"),
        vector("magnet reaction force", &outputs.magnet_reaction_force, 1e3, "mN"),
        vector("magnet reaction torque", &outputs.magnet_reaction_torque, 1e6, "mN.mm, about its centre"),
        vector("external field at tip", &outputs.tip_field, 1e3, "mT"),
        contacts(outputs),
        row("stability margin", format!("{:.4}", outputs.stability_margin), "of the unloaded shape's"),
        row("error estimate", format!("{:.4}", outputs.error_estimate * 1e6), "um, of the tip position"),
        row("snaps", outputs.snaps.to_string(), ""),
        row("energy", format!("{:.4}", outputs.energy * 1e6), "uJ"),
    ]
    .concat()
}
