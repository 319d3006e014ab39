//! A magnet that passes by with its field against the manipulator: one shape on the way forth, another on the way back.

use nalgebra::Vector3;

use super::experiment::{SEGMENTS, magnet_pair};
use super::study::{Column, Comparison, Curve, Mark, Panel, Stroke, Study, Value};
use crate::design::{Design, Specification};
use crate::equilibrium::{Interaction, Settings};
use crate::error::Error;
use crate::geometry::Pose;
use crate::manipulator::{Branch, Inputs, Manipulator};

/// Distance of the magnet's axis from the manipulator's, m.
const DISTANCE: f64 = 0.12;

/// Places of the magnet along the manipulator's axis: first and last (mm), and steps.
const FIRST: f64 = -80.0;
const LAST: f64 = 70.0;
const STEPS: u32 = 30;

/// Nine segments with bending stop, the paper's pair of magnets passing along them at 120 mm from axis to axis and coming
/// back, magnetised along +z: beside it its field opposes the manipulator, which turns over. `rings`.
///
/// # Errors
/// None for the paper's design; those of the solves are passed on.
pub fn hysteresis() -> Result<Study, Error> {
    let design = Design::new(Specification::paper(SEGMENTS))?;
    let settings = Settings { interaction: Interaction::Rings, bending_stop: true, ..Settings::default() };
    let manipulator = Manipulator::new(&design, Some(&magnet_pair()?), settings, 2)?;
    let rings = design.rings().count();
    let inputs = |place: f64| {
        let magnet = Pose { position: Vector3::new(0.0, -DISTANCE, 1e-3 * place), ..Pose::identity() };
        Ok(Inputs { magnet, magnet_strength: 1.0, ..Inputs::unloaded(rings) })
    };
    let step = (LAST - FIRST) / f64::from(STEPS);
    let places: Vec<f64> = (0..=STEPS).map(|i| FIRST + step * f64::from(i)).collect();
    let mut branch = Branch::new(manipulator, inputs, LAST - FIRST, step)?;
    let mut walk = |places: &mut dyn Iterator<Item = &f64>| {
        places.map(|&place| Ok(branch.to(place)?.tip_angle.to_degrees())).collect::<Result<Vec<f64>, Error>>()
    };
    let forth = walk(&mut places.iter())?;
    let mut back = walk(&mut places.iter().rev())?;
    back.reverse();
    let mut marks = Vec::new();
    let mut comparison = Vec::new();
    for fold in branch.folds() {
        let way = if fold.upwards { "forth" } else { "back" };
        let before = fold.before.tip_angle.to_degrees();
        let after = fold.after.as_ref().map_or(f64::NAN, |(_, shape)| shape.tip_angle.to_degrees());
        marks.push(Mark::Point(format!("snap on the way {way}"), [fold.value, before]));
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
        title: "Hysteresis: a magnet passes nine segments with its field against them, and comes back",
        columns: vec![
            Column::new("magnet_z_mm", places),
            Column::new("alpha_forth_deg", forth),
            Column::new("alpha_back_deg", back),
        ],
        panels: vec![Panel::Curves {
            title: "120 mm from axis to axis; rings, bending stop".into(),
            x: ("place of the magnet along the axis (mm)".into(), "magnet_z_mm".into()),
            y: "tip angle (deg)".into(),
            curves: vec![
                Curve::new("forth", "alpha_forth_deg", 0, Stroke::Solid),
                Curve::new("back", "alpha_back_deg", 1, Stroke::Dashed),
            ],
            marks,
        }],
        comparison,
    })
}
