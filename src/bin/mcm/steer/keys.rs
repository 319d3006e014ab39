//! What moves, by its keys in a scene.

use mcm::manipulator::Inputs;
use mcm::steer::Move;

/// The keys of these moves, one for each number.
pub(super) fn keys(moves: &[Move]) -> Vec<String> {
    let numbered = |key: &str, count: usize| (1..=count).map(|number| format!("{key}[{number}]")).collect();
    let each = |each: &Move| match each {
        Move::MagnetPosition => numbered("magnet.position_mm", 3),
        Move::MagnetOrientation => numbered("magnet.orientation_wxyz", 4),
        Move::MagnetStrength => vec!["magnet.strength".into()],
        Move::UniformField => numbered("field.uniform_mt", 3),
        Move::Insertion => vec!["feed.insertion_mm".into()],
        Move::CoilCurrent { coil, .. } => vec![format!("coil[{}].current_a", coil + 1)],
    };
    moves.iter().flat_map(each).collect()
}

/// Their values, in the units of the keys.
pub(super) fn values(moves: &[Move], inputs: &Inputs) -> Vec<f64> {
    let each = |each: &Move| match each {
        Move::MagnetPosition => (inputs.sources[0].pose.position * 1e3).as_slice().to_vec(),
        Move::MagnetOrientation => inputs.sources[0].pose.quaternion().to_vec(),
        Move::MagnetStrength => vec![inputs.sources[0].strength],
        Move::UniformField => (inputs.uniform_field * 1e3).as_slice().to_vec(),
        Move::Insertion => vec![inputs.insertion * 1e3],
        Move::CoilCurrent { source, .. } => vec![inputs.sources[*source].strength],
    };
    moves.iter().flat_map(each).collect()
}
