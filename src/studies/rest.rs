//! Rest shape: how far spirals beside rings bend a manipulator without loads, by their arrangement.

use super::study::{Column, Comparison, Study, Value};
use crate::design::{Design, Segmented, Specification, SpiralKind, SpiralStart};
use crate::equilibrium::{Interaction, Settings};
use crate::error::Error;
use crate::manipulator::{Inputs, Manipulator};

/// Largest number of segments.
const MOST_SEGMENTS: usize = 12;

/// Number of segments of the manipulator that was built.
const BUILT: usize = 9;

/// An arrangement: its name in columns, and what it makes of a chain.
type Arrangement = (&'static str, fn(&mut Segmented));

const HELICAL: Arrangement = ("helical", |_| ());
const ALTERNATING: Arrangement = ("alternating", |chain| chain.spiral = SpiralKind::Alternating);
const TURNED: Arrangement =
    ("turned", |chain| chain.spiral_start = SpiralStart::Each(turned(chain.segments)));

/// Tip angle of manipulators of Table 1 with 1 to 12 segments without any load, at the level `full`.
///
/// The rings attract the spirals beside them, which are not symmetric about the axis, and bend each core to a side that turns
/// with its spiral. Three arrangements: all spirals alike, every second one mirrored ([`SpiralKind::Alternating`]), and
/// right-handed ones turned about the axis so that the cores bend in opposite directions, or in three at 120 deg.
///
/// # Errors
/// None for the paper's design; those of the solves are passed on.
pub fn rest() -> Result<Study, Error> {
    let segments: Vec<usize> = (1..=MOST_SEGMENTS).collect();
    let mut columns = vec![Column::new("segments", segments.iter().map(|&s| s as f64).collect())];
    let mut built = Vec::new();
    for arrangement in [HELICAL, ALTERNATING, TURNED] {
        let (name, _) = arrangement;
        let angles =
            segments.iter().map(|&s| tip_angle(arrangement, s)).collect::<Result<Vec<_>, Error>>()?;
        built.push((name, angles[BUILT - 1]));
        columns.push(Column::new(format!("alpha_{name}_deg"), angles));
    }
    Ok(Study { columns, marks: Vec::new(), comparison: built.into_iter().map(comparison).collect() })
}

fn comparison((name, angle): (&str, f64)) -> Comparison {
    let remark = match name {
        "helical" => "all cores bend to the same side; no such experiment is in the paper",
        "alternating" => {
            "the bend of one segment is left where their number is odd, nothing where it is even"
        }
        _ => "by 0, 240, 120, 0, ... deg: the same helices, turned before they are joined",
    };
    Comparison {
        quantity: format!("tip angle of nine segments without any load, {name} (deg)"),
        decimals: 2,
        paper: Value::Absent,
        printed: Value::Absent,
        exact: Value::Number(angle),
        remark: remark.into(),
    }
}

/// Start angles in threes of 0, 240 and 120 deg, and pairs of 0 and 180 deg where their number is no multiple of three, rad.
///
/// In this order the lateral offsets of the threes nearly cancel too: 0, 120, 240 deg leave six to ten times the tip angle.
fn turned(segments: usize) -> Vec<f64> {
    let pairs = match segments {
        1 => return vec![0.0],
        _ => [0, 4, 2][segments % 3],
    };
    let degrees = |k: usize| {
        if k < segments - pairs {
            [0.0, 240.0, 120.0][k % 3]
        } else {
            [0.0, 180.0][(k - (segments - pairs)) % 2]
        }
    };
    (0..segments).map(|k| f64::to_radians(degrees(k))).collect()
}

/// Tip angle of a chain in an arrangement without loads, deg.
fn tip_angle((_, arrange): Arrangement, segments: usize) -> Result<f64, Error> {
    let mut chain = Segmented::paper(segments);
    arrange(&mut chain);
    let design = Design::new(Specification::Segmented(chain))?;
    let settings = Settings { interaction: Interaction::Full, ..Settings::default() };
    let mut manipulator = Manipulator::new(&design, None, settings, 2)?;
    Ok(manipulator.solve(&Inputs::unloaded(segments + 1))?.tip_angle.to_degrees())
}
