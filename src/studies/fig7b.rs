//! Fig. 7B: three segments and a solid cylinder of the same moment in a field of up to 20 mT.

use rayon::prelude::*;

use super::bending::{Bent, Device};
use super::experiment::solid_cylinder;
use super::progress::Progress;
use super::study::{Column, Comparison, Mark, Study, Value};
use crate::design::{Design, Specification};
use crate::equilibrium::{Interaction, Settings};
use crate::error::Error;

/// Number of segments of the measured manipulator.
const SEGMENTS: usize = 3;

/// Largest field of the experiment, T.
const FIELD: f64 = 20e-3;

/// The tip angles that the paper states, deg: three segments, cylinder.
const PAPER: [f64; 2] = [119.0, 16.0];

/// Number of steps, for fields from 0 to 20 mT and directions from 0 to 170 deg.
const ROWS: u32 = 20;
const LAST_TURN: f64 = 170.0;

/// Names of the devices in columns.
const DEVICES: [&str; 6] = ["rings", "full", "rings_stop", "full_stop", "cylinder", "preceding"];

/// Tip angles of three segments and of the solid cylinder, in a perpendicular field that grows to 20 mT, and in 20 mT
/// turning from the base's axis to 170 degrees. Without bending stop a branch may end: the curve ends there.
///
/// # Errors
/// None for the paper's designs; those of the solves are passed on.
pub fn fig7b(progress: &dyn Progress) -> Result<Study, Error> {
    let parts = (0..=ROWS).map(|row| f64::from(row) / f64::from(ROWS));
    let fields: Vec<f64> = parts.clone().map(|part| 1e3 * FIELD * part).collect();
    let turns: Vec<f64> = parts.map(|part| LAST_TURN * part).collect();
    let devices = devices()?;
    progress.more(2 * devices.len());
    let grown = bend(&devices, progress, |device| device.bend(across, &fields))?;
    let turned = bend(&devices, progress, |device| device.bend(turning, &turns))?;
    let comparison = comparison(&devices, &grown, &turned)?;
    let mut columns = vec![Column::new("field_mt", fields), Column::new("turn_deg", turns)];
    let [segments, cylinder] = PAPER;
    let mut marks = vec![Mark::level("paper, segments", segments), Mark::level("paper, cylinder", cylinder)];
    for (way, bent) in [("across", grown), ("turned", turned)] {
        for (name, bent) in DEVICES.into_iter().zip(bent) {
            columns.push(Column::new(format!("alpha_{way}_{name}_deg"), bent.angles));
            marks.extend(bent.end.map(|end| Mark::point(format!("end {way} {name}"), end)));
        }
    }
    Ok(Study { columns, marks, comparison })
}

/// The devices in the order of [`DEVICES`].
fn devices() -> Result<Vec<Device>, Error> {
    let design = Design::new(Specification::paper(SEGMENTS))?;
    let cylinder = solid_cylinder(design.length())?;
    let device = |interaction, bending_stop| {
        // Where a shape ends is told to a hundredth of a degree.
        let (tolerance_position, tolerance_angle) = (1e-5, 1e-3);
        let exact = Settings { tolerance_position, tolerance_angle, ..Settings::default() };
        Device::new(design.clone(), Settings { interaction, bending_stop: Some(bending_stop), ..exact })
    };
    Ok(vec![
        device(Interaction::Rings, false),
        device(Interaction::Full, false),
        device(Interaction::Rings, true),
        device(Interaction::Full, true),
        Device::new(cylinder, Settings::default()),
        device(Interaction::Preceding, false),
    ])
}

fn bend(
    devices: &[Device],
    progress: &dyn Progress,
    along: impl Fn(&Device) -> Result<Bent, Error> + Send + Sync,
) -> Result<Vec<Bent>, Error> {
    let bend = |device| {
        let bent = along(device);
        progress.done();
        bent
    };
    devices.par_iter().map(bend).collect()
}

/// Magnitude (T) and direction (deg) of a perpendicular field of `millitesla`.
fn across(millitesla: f64) -> (f64, f64) {
    (1e-3 * millitesla, 90.0)
}

/// Magnitude (T) and direction (deg) of the largest field, at `degrees` from the base's axis.
fn turning(degrees: f64) -> (f64, f64) {
    (FIELD, degrees)
}

fn comparison(devices: &[Device], grown: &[Bent], turned: &[Bent]) -> Result<Vec<Comparison>, Error> {
    let last = |bent: &Bent, unit: &str| match bent.end {
        Some([place, angle]) => Value::Words(format!("ends at {place:.2} {unit}, at {angle:.1} deg")),
        None => Value::Number(bent.angles[ROWS as usize]),
    };
    let ends = |bent: &Bent| bent.end.map_or(f64::NAN, |[place, _]| place);

    let [paper, paper_cylinder] = PAPER;
    let reached = |device: &Device| device.place_of(turning, paper, [90.0, LAST_TURN]);
    let directions = [reached(&devices[3])?, reached(&devices[2])?];
    let largest = turned[4].angles.iter().copied().fold(0.0, f64::max);
    let field = devices[4].place_of(across, paper_cylinder, [1.0, 60.0])?;

    let row = |quantity: &str, paper, printed, exact, remark: String| Comparison {
        quantity: quantity.into(),
        decimals: 1,
        paper,
        printed,
        exact,
        remark,
    };

    Ok(vec![
        row(
            "three segments, 20 mT at 90 deg, exact with bending stop (deg)",
            Value::Number(paper),
            last(&grown[5], "mT"),
            last(&grown[3], "mT"),
            format!(
                "a field fixed at 90 deg turns the tip to 90 deg at most, so the device's was turned on, in a direction that is \
                 not printed; without stop the exact branch ends at {:.2} mT; as printed, rings attract without reaction, \
                 and the base bears what adds up",
                ends(&grown[1])
            ),
        ),
        row(
            "three segments, 20 mT at 170 deg, exact with bending stop (deg)",
            Value::Number(paper),
            last(&turned[5], "deg"),
            last(&turned[3], "deg"),
            format!(
                "closed windings hold the device near three boundary angles, 120 deg; without stop, `rings` ends at {:.1} deg, \
                 `full` at {:.1}",
                ends(&turned[0]),
                ends(&turned[1])
            ),
        ),
        row(
            "direction of 20 mT that bends three segments to 119 deg, bending stop (deg)",
            Value::Absent,
            Value::Absent,
            Value::Range(directions[0], directions[1]),
            "first `full`, second `rings`: the direction of the experiment would decide between them".into(),
        ),
        row(
            "solid cylinder, 20 mT in the direction that bends it most (deg)",
            Value::Number(paper_cylinder),
            Value::Absent,
            Value::Number(largest),
            format!(
                "no direction bends it to 16 deg, which takes {field:.1} mT across: the cylinder was softer than Eq. (14), (15) \
                 say, or the field stronger"
            ),
        ),
    ])
}
