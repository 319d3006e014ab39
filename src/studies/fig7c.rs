//! Fig. 7C: forces of the magnet pair on the manipulator and on a solid cylinder, both held straight.

use rayon::prelude::*;

use super::experiment::{DISTANCE, SEGMENTS, axis_distance, held_force, magnet_pair, solid_cylinder};
use super::study::{Column, Comparison, Mark, Study, Value};
use crate::design::{Backbone, Design, Segmented, Specification};
use crate::error::Error;

/// Largest offset of the magnet to both sides, mm.
const FARTHEST: i32 = 120;

/// Largest axial force measured, N.
const MEASURED: f64 = 0.09;

/// Axial and attractive force over the offset of the magnet along the device.
///
/// The magnet pair passes at 40 mm from its surface; positive attraction is towards it, positive axial force along the
/// device's magnetisation. Forces on rings, discs and cores are integrated over the magnetic charge of their faces,
/// those on spirals over the volume from the gradient, all in the pair's exact field; nothing bends.
///
/// # Errors
/// None for the paper's devices; those of the field and of the designs are passed on.
pub fn fig7c() -> Result<Study, Error> {
    let manipulator = Design::new(Specification::paper(SEGMENTS))?;
    let cylinder = solid_cylinder(manipulator.length())?;
    let magnet = magnet_pair()?;
    let offsets: Vec<f64> = (-FARTHEST..=FARTHEST).step_by(2).map(f64::from).collect();
    let mut columns = vec![Column::new("offset_mm", offsets.clone())];
    let mut found = Vec::new();
    for (name, design) in [("manipulator", &manipulator), ("cylinder", &cylinder)] {
        let forces = offsets
            .par_iter()
            .map(|offset| held_force(design, &magnet, axis_distance(DISTANCE), offset * 1e-3))
            .collect::<Result<Vec<_>, Error>>()?;
        let axial: Vec<f64> = forces.iter().map(|force| force.z).collect();
        let attraction: Vec<f64> = forces.iter().map(|force| -force.y).collect();
        found.push(Extremes::of(&axial, &attraction));
        columns.push(Column::new(format!("axial_force_{name}_n"), axial));
        columns.push(Column::new(format!("attraction_{name}_n"), attraction));
    }
    let comparison = comparison(&found, &manipulator, &cylinder)?;
    Ok(Study { columns, marks: Mark::band("paper, axial force", [-MEASURED, MEASURED]).into(), comparison })
}

/// Largest forces on one device, N, for the comparison.
struct Extremes {
    axial: f64,
    attraction: f64,
    /// Largest difference between opposite offsets, of the axial force's magnitude and of the attraction, N.
    asymmetry: f64,
}

impl Extremes {
    fn of(axial: &[f64], attraction: &[f64]) -> Self {
        let most = |values: &mut dyn Iterator<Item = f64>| values.fold(0.0, f64::max);
        let odd = axial.iter().zip(axial.iter().rev()).map(|(a, b)| (a + b).abs());
        let even = attraction.iter().zip(attraction.iter().rev()).map(|(a, b)| (a - b).abs());
        Self {
            axial: most(&mut axial.iter().copied()),
            attraction: most(&mut attraction.iter().copied()),
            asymmetry: most(&mut odd.chain(even)),
        }
    }
}

fn comparison(found: &[Extremes], manipulator: &Design, cylinder: &Design) -> Result<Vec<Comparison>, Error> {
    let of = |device: usize, value: fn(&Extremes) -> f64| {
        found.get(device).map_or(Value::Absent, |found| Value::Number(value(found)))
    };

    let with_tube = Segmented { backbone: Some(Backbone::silicone()), ..Segmented::paper(SEGMENTS) };
    let mass = Design::new(Specification::Segmented(with_tube))?.mass();

    let row = |quantity: &str, paper, exact, remark: String| Comparison {
        quantity: quantity.into(),
        decimals: 3,
        paper,
        printed: Value::Absent,
        exact,
        remark,
    };

    Ok(vec![
        row(
            "largest axial force on nine segments (N)",
            Value::Number(MEASURED),
            of(0, |found| found.axial),
            "measured there; here 1.35 T for N45, permeability 1, no misalignment".into(),
        ),
        row(
            "largest axial force on the solid cylinder, Phi = 0.2 (N)",
            Value::Words("similar".into()),
            of(1, |found| found.axial),
            format!(
                "the paper takes equal mu_rel for equal moment; the nine segments' moment is {:.2} times the cylinder's",
                manipulator.moment() / cylinder.moment()
            ),
        ),
        row(
            "largest attraction of nine segments (N)",
            Value::Absent,
            of(0, |found| found.attraction),
            "shown there without a number in the text".into(),
        ),
        row(
            "asymmetry of the forces about offset 0 (N)",
            Value::Words("seen".into()),
            of(0, |found| found.asymmetry),
            "the paper ascribes it to the gap between the magnets, but a pair is as symmetric as one magnet".into(),
        ),
        row(
            "mass of nine segments with their tube (g)",
            Value::Number(2.25),
            Value::Number(mass * 1e3),
            "rings and particles of 7000 kg/m3, the rest 1000, no tube beyond the base; the paper does not say what was weighed".into(),
        ),
    ])
}
