//! Bands of 95 % of what the paper measured: Shore hardness to 1, remanences to 2 %, the spacing of the rings to 0.05 mm.

use super::experiment::{DISTANCE, SEGMENTS, axis_distance, held_force, magnet_pair};
use super::study::{Column, Comparison, Mark, Study, Value};
use crate::design::{Design, Helix, Specification};
use crate::error::Error;
use crate::manipulator::{Neighbours, SceneFile, Status};
use crate::uncertainty::COVERAGE;

/// One segment with both rings; its field follows.
const SEGMENT: &str = "[design]\nsegments = 1\n[model]\ninteraction = \"full\"\n[field]\n";

/// Three segments whose windings may touch.
const THREE: &str = "[design]\nsegments = 3\n[model]\ninteraction = \"full\"\nbending_stop = true\n[field]\n";

/// Fields of Fig. 7A between which the paper states the gain from the base ring, mT.
const FIELDS: [u32; 2] = [5, 25];

/// The field of Fig. 7B (mT), and its largest angle from the base's axis here, deg.
const FIELD: f64 = 20.0;
const LAST_TURN: u32 = 170;

/// What the paper measured: the gain, the tip angles (deg) of three segments and of the solid cylinder, and the axial force (N).
const GAIN: f64 = 0.31;
const THREE_DEG: f64 = 119.0;
const CYLINDER_DEG: f64 = 16.0;
const FORCE: f64 = 0.09;

/// Offset of the magnet at which the axial force on nine segments is largest, within this range, mm.
const OFFSETS: [i32; 2] = [20, 100];

/// Standard deviations: Shore A hardness, remanences (relative), and length of the helix (mm), which spaces the rings.
const DEVIATIONS: [(&str, Deviation); 3] = [
    ("design.helix.shore_a", Deviation::Absolute(1.0)),
    ("design.ring.remanence_t", Deviation::Relative(0.02)),
    ("design.helix.length_mm", Deviation::Absolute(0.05)),
];

/// What is uncertain of a plain cylinder.
const OF_CYLINDER: [(&str, Deviation); 3] = [
    ("design.shore_a", Deviation::Absolute(1.0)),
    ("design.particle_remanence_t", Deviation::Relative(0.02)),
    ("design.length_mm", Deviation::Absolute(0.05)),
];

#[derive(Clone, Copy)]
enum Deviation {
    Absolute(f64),
    Relative(f64),
}

/// A quantity with its derivatives by the uncertain numbers, each times the number's standard deviation.
#[derive(Clone)]
struct Known {
    value: f64,
    parts: Vec<f64>,
}

impl Known {
    /// Half the width of its band.
    fn band(&self) -> f64 {
        COVERAGE * self.parts.iter().map(|part| part * part).sum::<f64>().sqrt()
    }

    fn low(&self) -> f64 {
        self.value - self.band()
    }

    fn high(&self) -> f64 {
        self.value + self.band()
    }
}

/// The gain `more / less - 1` of two quantities that depend on the same numbers.
fn gain(more: &Known, less: &Known) -> Known {
    let each = more.parts.iter().zip(&less.parts);
    let parts = each.map(|(a, b)| (a - b * more.value / less.value) / less.value).collect();
    Known { value: more.value / less.value - 1.0, parts }
}

fn mean(all: &[Known]) -> Known {
    let count = all.len() as f64;
    let parts = (0..all[0].parts.len()).map(|i| all.iter().map(|one| one.parts[i]).sum::<f64>() / count);
    Known { value: all.iter().map(|one| one.value).sum::<f64>() / count, parts: parts.collect() }
}

/// Tip angles (deg) of the device of a scene along fields (T, in the plane of y and z); `None` from where its branch ends.
fn bend(
    text: &str,
    deviations: &[(&str, Deviation)],
    fields: &[[f64; 2]],
) -> Result<Vec<Option<Known>>, Error> {
    let file = SceneFile::parse(text, "study")?;
    let scene = file.scene()?;

    let (keys, sizes) = sized(&file, deviations)?;
    let mut neighbours = Neighbours::new(&file, &keys)?;
    let mut manipulator = scene.manipulator(2)?;
    let mut lost = false;

    let mut each = |[across, along]: [f64; 2]| {
        let mut inputs = scene.inputs.clone();
        (inputs.uniform_field.y, inputs.uniform_field.z) = (across, along);
        lost = lost || !matches!(manipulator.solve(&inputs)?.status, Status::Solved | Status::NearFold);
        if lost {
            return Ok(None);
        }

        let found = neighbours.sensitivities_at(&manipulator, |_| inputs.clone())?;
        let rates = found.of(|outputs| outputs.tip_angle.to_degrees());
        let parts = rates.iter().zip(&sizes).map(|(rate, size)| rate * size).collect();
        Ok(Some(Known { value: manipulator.outputs().tip_angle.to_degrees(), parts }))
    };

    fields.iter().map(|field| each(*field)).collect()
}

/// Keys and standard deviations of the numbers of a scene.
fn sized(file: &SceneFile, deviations: &[(&str, Deviation)]) -> Result<(Vec<String>, Vec<f64>), Error> {
    let size = |(key, deviation): &(&str, Deviation)| {
        Ok(match deviation {
            Deviation::Absolute(size) => *size,
            Deviation::Relative(part) => part * file.number(key)?,
        })
    };
    let sizes = deviations.iter().map(size).collect::<Result<_, Error>>()?;
    Ok((deviations.iter().map(|(key, _)| (*key).to_owned()).collect(), sizes))
}

/// The largest axial force (N) on nine segments that are held straight beside the magnet pair.
fn axial_force() -> Result<Known, Error> {
    let magnet = magnet_pair()?;
    let file = SceneFile::parse(&format!("[design]\nsegments = {SEGMENTS}\n"), "study")?;
    let force = |file: &SceneFile, offset: f64| {
        let design = Design::new(file.scene()?.specification)?;
        Ok::<f64, Error>(held_force(&design, &magnet, axis_distance(DISTANCE), offset * 1e-3)?.z.abs())
    };
    let (mut value, mut place) = (0.0, 0.0);
    for offset in (OFFSETS[0]..=OFFSETS[1]).step_by(2).map(f64::from) {
        let here = force(&file, offset)?;
        if here > value {
            (value, place) = (here, offset);
        }
    }
    // At a largest value its place does not matter to first order.
    let (keys, sizes) = sized(&file, &DEVIATIONS)?;
    let part = |(key, size): (&String, &f64)| {
        let here = file.number(key)?;
        let at = |by: f64| force(&file.with(key, here + by * size)?, place);
        Ok((at(0.1)? - at(-0.1)?) / 0.2)
    };
    let parts = keys.iter().zip(&sizes).map(part).collect::<Result<_, Error>>()?;
    Ok(Known { value, parts })
}

/// Measured values of the paper beside bands of 95 % of the exact model, from the tolerances of hardness, remanence and spacing.
///
/// # Errors
/// None for the paper's devices; those of the solves are passed on.
pub fn bands() -> Result<Study, Error> {
    let across: Vec<[f64; 2]> = (1..=FIELDS[1]).map(|field| [1e-3 * f64::from(field), 0.0]).collect();
    let with = bend(SEGMENT, &DEVIATIONS, &across)?;
    let bare = SEGMENT.replace("segments = 1", "segments = 1\nbase_magnet = false");
    let without = bend(&bare, &DEVIATIONS, &across)?;

    let gains: Vec<Option<Known>> =
        with.iter().zip(&without).map(|(more, less)| Some(gain(more.as_ref()?, less.as_ref()?))).collect();

    let degrees: Vec<u32> = (60..=LAST_TURN).step_by(5).collect();
    let turned: Vec<[f64; 2]> = degrees
        .iter()
        .map(|degrees| {
            let (sine, cosine) = f64::from(*degrees).to_radians().sin_cos();
            [1e-3 * FIELD * sine, 1e-3 * FIELD * cosine]
        })
        .collect();

    let three = bend(THREE, &DEVIATIONS, &turned)?;

    let length = 1e3 * Design::new(Specification::paper(3))?.length();
    let Helix { radius, shore_a, poisson, particle_remanence, .. } = Helix::paper();
    let cylinder = format!(
        "[design]\nkind = \"cylinder\"\nlength_mm = {length}\nradius_mm = {}\nshore_a = {shore_a}\npoisson = {poisson}\n\
         volume_fraction = 0.2\nparticle_remanence_t = {particle_remanence}\n[field]\n",
        1e3 * radius
    );
    let cylinder = bend(&cylinder, &OF_CYLINDER, &turned)?;

    let stated: Vec<Known> = gains[FIELDS[0] as usize - 1..].iter().flatten().cloned().collect();
    let most = cylinder.iter().flatten().max_by(|a, b| a.value.total_cmp(&b.value)).cloned();

    let rows = [
        ("more tip angle by the base ring, mean of 5 to 25 mT", 3, GAIN, Some(mean(&stated))),
        (
            "three segments, 20 mT at 170 deg, bending stop (deg)",
            1,
            THREE_DEG,
            three.last().cloned().flatten(),
        ),
        ("solid cylinder, 20 mT in the direction that bends it most (deg)", 1, CYLINDER_DEG, most),
        ("largest axial force on nine segments (N)", 4, FORCE, Some(axial_force()?)),
    ];

    let comparison = rows
        .into_iter()
        .filter_map(|(quantity, decimals, paper, known)| Some(compared(quantity, decimals, paper, &known?)));
    let comparison = comparison.collect();

    let (count, fields): (usize, Vec<f64>) = (turned.len(), (1..=FIELDS[1]).map(f64::from).collect());
    let mut columns = vec![Column::new("field_mt", fields)];
    columns.extend(limits("alpha", "_deg", &with));
    columns.extend(limits("gain", "", &gains));
    columns.push(Column::new("direction_deg", degrees.into_iter().map(f64::from).collect()));
    columns.extend(limits("alpha_three", "_deg", &three));
    columns.extend(limits("alpha_cylinder", "_deg", &cylinder));
    let rows = columns.iter().map(|column| column.values.len()).max().unwrap_or(count);
    for column in &mut columns {
        column.values.resize(rows, f64::NAN);
    }

    let marks = [("gain", GAIN), ("three segments", THREE_DEG), ("cylinder", CYLINDER_DEG)]
        .map(|(quantity, measured)| Mark::level(format!("paper, {quantity}"), measured));
    Ok(Study { columns, marks: marks.into(), comparison })
}

/// Columns of a quantity and of the limits of its band.
fn limits(name: &str, unit: &str, values: &[Option<Known>]) -> [Column; 3] {
    let read = |of: fn(&Known) -> f64| values.iter().map(|one| one.as_ref().map_or(f64::NAN, of)).collect();
    [
        Column::new(format!("{name}{unit}"), read(|one| one.value)),
        Column::new(format!("{name}_low{unit}"), read(Known::low)),
        Column::new(format!("{name}_high{unit}"), read(Known::high)),
    ]
}

fn compared(quantity: &str, decimals: usize, paper: f64, known: &Known) -> Comparison {
    let widths = (paper - known.value).abs() / known.band();
    let (low, high) = (known.low(), known.high());
    let verdict = if widths <= 1.0 { "inside" } else { "outside" };
    Comparison {
        quantity: format!("{quantity}, with its band of 95 %"),
        decimals,
        paper: Value::Number(paper),
        printed: Value::Absent,
        exact: Value::Number(known.value),
        remark: format!(
            "{verdict}: the band is {low:.decimals$} to {high:.decimals$}, the measured value {widths:.1} half widths from its middle"
        ),
    }
}
