//! Fig. 9: a magnet leads nine segments and a solid cylinder through an abdominal aorta.

mod case;
mod walk;

use rayon::prelude::*;

use self::case::{CASES, Case};
use self::walk::{Row, Walk, places, time, walk};
use super::progress::Progress;
use super::study::{Column, Comparison, Mark, Study, Value};
use crate::error::Error;

/// Largest axial force that the paper measured, N.
const AXIAL: f64 = 0.09;

/// Turn of a device to one side from which on it has the form of a J, and to both sides of an S, rad.
const TURNED: f64 = core::f64::consts::FRAC_PI_6;

/// What is recorded of each device: end of the column's name, and the value.
type Recorded = (&'static str, fn(&Row) -> f64);

const RECORDED: [Recorded; 9] = [
    ("inside_mm", |row| 1e3 * row.inside),
    ("tip_x_mm", |row| 1e3 * row.tip.x),
    ("tip_z_mm", |row| 1e3 * row.tip.z),
    ("tip_heading_deg", |row| row.heading.to_degrees()),
    ("axial_n", |row| row.axial),
    ("wall_n", |row| row.wall),
    ("largest_contact_n", |row| row.largest),
    ("turned_to_x_deg", |row| row.turns[0].to_degrees()),
    ("turned_from_x_deg", |row| row.turns[1].to_degrees()),
];

/// The paper's magnet pair goes beneath a planar abdominal aorta, with its field along its way, and drags along a device whose
/// shaft hangs free: nine segments or the solid cylinder on the silicone tube, without friction, with that of catheters on
/// vessels and dry; nine segments on the PTFE tube, alone and with a guidewire up to their base. All at the level `rings`; the
/// wall is of the phantom's silicone. The way was found by hand for the nine segments. All forces are predictions.
///
/// It goes as far as so many communication points; `usize::MAX` is the whole way.
///
/// # Errors
/// None for the paper's designs.
pub fn fig9(points: usize, progress: &dyn Progress) -> Result<Study, Error> {
    let mut places = places()?;
    places.truncate(points);
    progress.more(places.len() * CASES.len());
    let walks =
        CASES.par_iter().map(|case| walk(case, &places, progress)).collect::<Result<Vec<Walk>, Error>>()?;
    let times = (1..=places.len()).map(time).collect();
    let mut columns = vec![Column::new("time_s", times)];
    for (index, name) in ["magnet_x_mm", "magnet_z_mm", "heading_deg", "beneath_mm"].into_iter().enumerate() {
        columns.push(Column::new(name, places.iter().map(|place| place[index]).collect()));
    }
    for (case, walk) in CASES.iter().zip(&walks) {
        for (ending, value) in RECORDED {
            let values = (0..places.len()).map(|number| walk.rows.get(number).map_or(f64::NAN, value));
            columns.push(Column::new(format!("{}_{ending}", case.name), values.collect()));
        }
    }
    let comparison =
        CASES.iter().zip(&walks).map(|(case, walk)| comparison(case, walk, places.len())).collect();
    Ok(Study { columns, marks: vec![Mark::level("paper, pull", AXIAL)], comparison })
}

fn comparison(case: &Case, walk: &Walk, points: usize) -> Comparison {
    let most = |value: fn(&Row) -> f64| walk.rows.iter().map(value).fold(0.0, f64::max);
    let both = |row: &Row| row.turns[0].min(row.turns[1]);
    let either = |row: &Row| row.turns[0].max(row.turns[1]);
    let (one_way, both_ways) = (most(either), most(both));

    let form = match (one_way >= TURNED, both_ways >= TURNED) {
        (false, _) => "neither J nor S",
        (true, false) => "J, no S",
        (true, true) => "J and S",
    };

    let (inside, heading) = walk.rows.last().map_or((0.0, 0.0), |row| (row.inside, row.heading));
    let end = match walk.lost {
        None => "the end of the path".to_owned(),
        Some(outcome) => {
            format!("no shape found after {} of {points} steps ({})", walk.rows.len(), outcome.name())
        }
    };

    Comparison {
        quantity: format!("the path of {}, {}: tip in", case.device, case.walls()),
        decimals: 0,
        paper: if case.name == "mcm" || case.name == "mcm_oiled" {
            Value::Words("left iliac, aorta, superior mesenteric".into())
        } else {
            Value::Absent
        },
        printed: Value::Absent,
        exact: Value::Words(walk.branches.join(", ")),
        remark: format!(
            "{end}: {:.0} mm of shaft inside, tip turned to {:.0} deg, snaps: {}; bends by up to {:.0} deg to one side and \
             {:.0} deg to both sides ({form}); pull at most {:.3} N, wall {:.3} N in sum, {:.3} N in one contact",
            1e3 * inside,
            heading.to_degrees(),
            walk.snaps,
            one_way.to_degrees(),
            both_ways.to_degrees(),
            most(|row| row.axial.abs()),
            most(|row| row.wall),
            most(|row| row.largest),
        ),
    }
}
