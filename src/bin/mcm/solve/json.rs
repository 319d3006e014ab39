//! The report of a solve as JSON, in SI units.

use mcm::error::Error;
use mcm::magnetics::Wrench;
use mcm::manipulator::{Collapse, Jacobian, Outputs};
use nalgebra::{SMatrix, Vector3};
use serde_json::{Value, json};

use crate::verdict;

/// Report of the solve and the shape found, or why the device closes; without a shape, all its numbers are null. With
/// `uncertainty` where it is asked for, null where it cannot be told, and with the `warnings` of a scene that has some.
pub(super) fn as_json(
    (outputs, collapse): (&Outputs, Option<&Collapse>),
    jacobian: &Result<Jacobian, Error>,
    magnet: bool,
    uncertainty: Option<Value>,
    warnings: &[String],
) -> Value {
    let derivatives = jacobian.as_ref().ok().map(|jacobian| {
        json!({
            "tip_by_magnet": magnet.then(|| rows(&jacobian.tip_by_magnet())),
            "tip_by_uniform_field": rows(&jacobian.tip_by_uniform_field()),
        })
    });
    let converged = verdict::converged(outputs);
    let search = [
        ("converged", json!(converged)),
        ("status", json!(verdict::status(outputs))),
        ("outcome", json!(outputs.outcome.name())),
        ("reason", json!(verdict::reason(outputs, collapse))),
        ("progress", json!(outputs.progress)),
        ("stability", json!(verdict::stability(outputs))),
        ("iterations", json!(outputs.iterations)),
        ("residual", json!(outputs.residual)),
        ("interaction", json!(outputs.interaction.name())),
        ("method", json!(outputs.method.name())),
        ("jacobian", json!(derivatives)),
        ("jacobian_note", json!(jacobian.as_ref().err().map(ToString::to_string))),
    ];
    let verdict = [
        ("stable", json!(outputs.stable)),
        ("stability_margin", json!(outputs.stability_margin)),
        ("snaps", json!(outputs.snaps)),
        ("energy_j", json!(outputs.energy)),
        ("error_estimate_m", json!(outputs.error_estimate)),
    ];
    let mutual = mutual_wrenches(outputs).into_iter().flatten();
    let found = shape(outputs).into_iter().chain(mutual).chain(verdict);
    let found = found.map(|(key, value)| (key, if converged { value } else { Value::Null }));
    let uncertainty = uncertainty.map(|told| ("uncertainty", told));
    let odd = (!warnings.is_empty()).then(|| ("warnings", json!(warnings)));
    found.chain(search).chain(uncertainty).chain(odd).map(|(key, value)| (key.to_owned(), value)).collect()
}

/// The wrench of magnets and coils on one another, where it is asked for.
fn mutual_wrenches(outputs: &Outputs) -> Option<[(&'static str, Value); 2]> {
    let all = Some(&outputs.mutual_wrenches).filter(|all| !all.is_empty())?;
    let list = |of: fn(&Wrench) -> Vector3<f64>| all.iter().map(|own| json!(of(own).as_slice())).collect();
    Some([("mutual_forces_n", list(|own| own.force)), ("mutual_torques_nm", list(|own| own.torque))])
}

/// The shape found and its forces.
pub(super) fn shape(outputs: &Outputs) -> [(&'static str, Value); 23] {
    let vector = |v: &Vector3<f64>| json!([v.x, v.y, v.z]);
    // Places of the contacts (0) or forces there (1).
    let contacts = |which: usize| {
        let places = outputs.wall.as_ref().map(|wall| wall.places.iter());
        json!(places.map(|places| places.map(|contact| vector(&contact[which])).collect::<Vec<_>>()))
    };
    [
        ("alpha_rad", json!(outputs.tip_angle)),
        ("tip_position_m", vector(&outputs.tip.position)),
        ("tip_orientation_wxyz", json!(outputs.tip.quaternion())),
        ("magnetic_force_n", vector(&outputs.magnetic_force)),
        ("magnetic_torque_nm", vector(&outputs.magnetic_torque)),
        ("base_reaction_force_n", vector(&outputs.base_reaction_force)),
        ("base_reaction_moment_nm", vector(&outputs.base_reaction_moment)),
        ("magnet_reaction_force_n", vector(&outputs.magnet_reaction_force)),
        ("magnet_reaction_torque_nm", vector(&outputs.magnet_reaction_torque)),
        (
            "further_reaction_forces_n",
            outputs.further_reactions.iter().map(|own| vector(&own.force)).collect(),
        ),
        (
            "further_reaction_torques_nm",
            outputs.further_reactions.iter().map(|own| vector(&own.torque)).collect(),
        ),
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
    ]
}

/// A matrix as a list of its rows.
fn rows<const COLUMNS: usize>(matrix: &SMatrix<f64, 6, COLUMNS>) -> Vec<Vec<f64>> {
    matrix.row_iter().map(|row| row.iter().copied().collect()).collect()
}
