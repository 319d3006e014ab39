//! The way of one device behind the magnet.

use nalgebra::{Matrix3, Vector3};

use super::case::Case;
use crate::error::Error;
use crate::geometry::Pose;
use crate::manipulator::{Inputs, Manipulator, Outcome, Outputs, Status};
use crate::studies::progress::Progress;
use crate::vessel::Branch;

/// Corners of the magnet's way: place of its centre in the plane (mm), direction of its field there (deg, from +z towards
/// +x), and how far it is beneath the plane (mm).
const WAY: &str = include_str!("../../../fmu/navigate_way.csv");

/// Way of the magnet between two communication points, mm.
const STEP: f64 = 2.0;

/// Way that counts as a turn of the magnet by a degree, mm.
const TURN: f64 = 0.4;

/// Speed of the magnet, m/s: half a metre in a minute.
const SPEED: f64 = 8.3e-3;

/// How often a step without a shape is halved.
const HALVINGS: u32 = 4;

/// Number of points of the centreline in the outputs.
const POINTS: usize = 121;

/// A place of the magnet: x, z (mm), heading (deg), distance beneath (mm).
pub(super) type MagnetPose = [f64; 4];

/// What is recorded of a device at a communication point.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Row {
    /// Length of the shaft inside, m.
    pub(super) inside: f64,
    /// The tip, m, and its direction in the plane, rad, from +z towards +x.
    pub(super) tip: Vector3<f64>,
    pub(super) heading: f64,
    /// The magnet's force along its field's direction, N.
    pub(super) axial: f64,
    /// Sum of all normal forces of the wall and the largest one of a contact, N.
    pub(super) wall: f64,
    pub(super) largest: f64,
    /// Largest turns of the device in the plane from one place to one further towards its tip, to either side, rad.
    pub(super) turns: [f64; 2],
}

/// The way of a device.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Walk {
    /// One for each communication point up to the last one with a shape.
    pub(super) rows: Vec<Row>,
    /// Branches of the vessel in which the tip was, in their order.
    pub(super) branches: Vec<String>,
    /// Jumps.
    pub(super) snaps: u32,
    /// Why there is no shape at the next point, if the way ends before its end.
    pub(super) lost: Option<Outcome>,
}

/// The communication points.
///
/// # Errors
/// None for the way above.
pub(super) fn places() -> Result<Vec<MagnetPose>, Error> {
    let corner = |line: &str| {
        let numbers: Vec<f64> = line.split(',').filter_map(|entry| entry.parse().ok()).collect();
        MagnetPose::try_from(numbers).map_err(|numbers| Error::Count {
            quantity: "numbers in a line of the magnet's way".into(),
            given: numbers.len(),
            expected: "4".into(),
        })
    };
    let corners = WAY.lines().skip(1).map(corner).collect::<Result<Vec<_>, _>>()?;
    let mut out: Vec<MagnetPose> = corners.first().copied().into_iter().collect();
    for ends in corners.windows(2) {
        let [dx, dz, turn, deeper] = core::array::from_fn(|k| ends[1][k] - ends[0][k]);
        let length = Vector3::new(dx, dz, deeper).norm().max(TURN * turn.abs());
        let count = (length / STEP).ceil();
        let mut done = 0.0;
        while done < count {
            done += 1.0;
            out.push(core::array::from_fn(|k| ends[0][k] + (ends[1][k] - ends[0][k]) * done / count));
        }
    }
    Ok(out)
}

/// Time (s) of the communication point with this number.
pub(super) fn time(number: usize) -> f64 {
    number as f64 * STEP * 1e-3 / SPEED
}

/// The way of a device through these places.
///
/// # Errors
/// None for the paper's designs.
pub(super) fn walk(case: &Case, places: &[MagnetPose], progress: &dyn Progress) -> Result<Walk, Error> {
    let scene = case.scene()?;
    let branches = || scene.vessel.iter().flat_map(|vessel| vessel.lumen.branches());
    let mut device = scene.manipulator(POINTS)?;
    let mut here: Option<Inputs> = None;
    let mut out = Walk { rows: Vec::new(), branches: Vec::new(), snaps: 0, lost: None };

    for (number, place) in places.iter().enumerate() {
        // A free feed: the magnet alone pulls the device on.
        let mut next = Inputs { feed_force: Some(0.0), ..scene.inputs.clone() };
        next.sources[0].pose = magnet(place);
        if let Some(last) = out.rows.last().filter(|_| case.wired) {
            next.guidewire_insertion = last.inside;
        }

        if !step(&mut device, [here.as_ref().unwrap_or(&next), &next], HALVINGS)? {
            out.lost = Some(device.outputs().outcome);
            places[number..].iter().for_each(|_| progress.done());
            break;
        }

        let outputs = device.outputs();
        out.snaps = outputs.snaps;
        out.rows.push(Row::of(outputs, place));

        // The tip is in the branch in which it lies deepest.
        let clearance = |branch: &Branch| branch.clearance(&outputs.tip.position).value;
        let widest = branches().max_by(|a, b| clearance(a).total_cmp(&clearance(b)));
        let name = widest.map_or("", Branch::name);
        if out.branches.last().is_none_or(|last| last != name) {
            out.branches.push(name.into());
        }

        here = Some(next);
        progress.done();
    }
    Ok(out)
}

/// Moves the inputs from one end to the other, in shorter steps where no shape is found; whether there is one.
fn step(device: &mut Manipulator, [from, to]: [&Inputs; 2], halvings: u32) -> Result<bool, Error> {
    let kept = device.snapshot();
    if device.solve(to)?.status != Status::NotSolved {
        return Ok(true);
    }
    let Some(left) = halvings.checked_sub(1) else { return Ok(false) };
    device.restore(&kept)?;
    let middle = from.between(to, 0.5);
    Ok(step(device, [from, &middle], left)? && step(device, [&middle, to], left)?)
}

/// The magnet's pose: its axis points against the heading, so that its field at the vessels points along it.
fn magnet(&[x, z, heading, beneath]: &MagnetPose) -> Pose {
    let against = -along(heading);
    let across = Vector3::y().cross(&against);
    Pose {
        position: Vector3::new(x, -beneath, z) * 1e-3,
        rotation: Matrix3::from_columns(&[across, Vector3::y(), against]),
    }
}

/// Direction in the plane of the vessels, from +z towards +x (deg).
fn along(heading: f64) -> Vector3<f64> {
    let (sine, cosine) = heading.to_radians().sin_cos();
    Vector3::new(sine, 0.0, cosine)
}

impl Row {
    fn of(outputs: &Outputs, place: &MagnetPose) -> Self {
        let direction = |axis: &Vector3<f64>| axis.x.atan2(axis.z);
        let inside = outputs.feed_length.unwrap_or(0.0);
        let device = outputs.shape_arc_length.iter().zip(&outputs.shape).filter(|(s, _)| **s >= inside);
        let points: Vec<&Vector3<f64>> = device.map(|(_, point)| point).collect();
        let headings: Vec<f64> = points.windows(2).map(|pair| direction(&(pair[1] - pair[0]))).collect();
        let wall = outputs.wall.as_ref();
        Self {
            inside,
            tip: outputs.tip.position,
            heading: direction(&outputs.tip.axis()),
            axial: outputs.magnetic_force.dot(&along(place[2])),
            wall: wall.map_or(0.0, |wall| wall.sum),
            largest: wall.map_or(0.0, |wall| wall.largest_force),
            turns: [1.0, -1.0].map(|side| largest_rise(headings.iter().map(|heading| side * heading))),
        }
    }
}

/// Largest rise from one of these values to a later one.
fn largest_rise(values: impl Iterator<Item = f64>) -> f64 {
    let (mut least, mut rise) = (f64::INFINITY, 0.0_f64);
    for value in values {
        least = least.min(value);
        rise = rise.max(value - least);
    }
    rise
}
