//! Hysteresis: a magnet whose field opposes the manipulator passes and returns, with different shapes forth and back.

use nalgebra::Vector3;

use super::PATIENCE;
use super::experiment::{SEGMENTS, magnet_pair};
use super::progress::Progress;
use super::study::{Column, Comparison, Mark, Study, Value};
use crate::design::{Design, Specification};
use crate::equilibrium::{Interaction, Settings};
use crate::error::Error;
use crate::geometry::Pose;
use crate::manipulator::{Branch, Inputs, Manipulator, PlacedSource};

/// Distance of the magnet's axis from the manipulator's, m.
const DISTANCE: f64 = 0.12;

/// First and last position of the magnet along the manipulator's axis (mm), and number of steps between them.
pub(super) const FIRST: f64 = -40.0;
pub(super) const LAST: f64 = 0.0;
const STEPS: u32 = 40;

/// Nine segments with bending stop, at the level `rings`. The paper's magnet pair, magnetised along +z, passes along
/// them at 120 mm from axis to axis and returns: its field beside it opposes the manipulator, which turns over.
///
/// # Errors
/// None for the paper's design; those of the solves are passed on.
pub fn hysteresis(progress: &dyn Progress) -> Result<Study, Error> {
    let step = (LAST - FIRST) / f64::from(STEPS);
    let places: Vec<f64> = (0..=STEPS).map(|i| FIRST + step * f64::from(i)).collect();
    let mut branch = Branch::new(manipulator()?, |place| Ok(inputs(place)), LAST - FIRST, step)?;
    progress.more(2 * places.len());

    let mut walk = |places: &mut dyn Iterator<Item = &f64>| {
        let at = |&place: &f64| {
            let outputs = branch.to(place)?;
            progress.done();
            Ok((outputs.tip_angle.to_degrees(), 1e3 * outputs.tip.position.y))
        };
        places.map(at).collect::<Result<(Vec<f64>, Vec<f64>), Error>>()
    };

    let forth = walk(&mut places.iter())?;
    let mut back = walk(&mut places.iter().rev())?;
    back.0.reverse();
    back.1.reverse();

    let (mut marks, mut comparison) = (Vec::new(), Vec::new());
    for fold in branch.folds() {
        let way = if fold.upwards { "forth" } else { "back" };
        let before = fold.before.tip_angle.to_degrees();
        let after = fold.after.as_ref().map_or(f64::NAN, |(_, shape)| shape.tip_angle.to_degrees());
        for (quantity, height) in [("angle", before), ("tip", 1e3 * fold.before.tip.position.y)] {
            marks.push(Mark::point(format!("snap {way}, {quantity}"), [fold.value, height]));
        }
        comparison.push(Comparison {
            quantity: format!("place of the magnet at which nine segments snap over, {way} (mm)"),
            decimals: 2,
            paper: Value::Absent,
            printed: Value::Absent,
            exact: Value::Number(fold.value),
            remark: format!(
                "tip angle {before:.1} deg before, {after:.1} deg after; no such experiment is in the paper"
            ),
        });
    }

    Ok(Study {
        columns: vec![
            Column::new("magnet_z_mm", places),
            Column::new("alpha_forth_deg", forth.0),
            Column::new("alpha_back_deg", back.0),
            Column::new("tip_y_forth_mm", forth.1),
            Column::new("tip_y_back_mm", back.1),
        ],
        marks,
        comparison,
    })
}

/// Nine segments with bending stop beside the paper's magnet pair, at the level `rings`, not yet solved.
///
/// # Errors
/// None for the paper's design.
pub(super) fn manipulator() -> Result<Manipulator, Error> {
    let design = Design::new(Specification::paper(SEGMENTS))?;
    let (interaction, bending_stop) = (Interaction::Rings, Some(true));
    let settings = Settings { interaction, bending_stop, time_budget: PATIENCE, ..Settings::default() };
    Manipulator::new(&design, Some(&magnet_pair()?), settings, 2)
}

/// Inputs with the magnet, magnetised along +z, at `place` (mm) along the manipulator.
pub(super) fn inputs(place: f64) -> Inputs {
    let magnet = Pose { position: Vector3::new(0.0, -DISTANCE, 1e-3 * place), ..Pose::identity() };
    Inputs { sources: vec![PlacedSource { pose: magnet, strength: 1.0 }], ..Inputs::unloaded(SEGMENTS + 1) }
}
