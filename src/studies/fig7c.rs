//! Fig. 7C: forces of the magnet pair on the manipulator and on a solid cylinder, both held straight.

use rayon::prelude::*;

use super::experiment::{DISTANCE, SEGMENTS, axis_distance, held_force, magnet_pair, solid_cylinder};
use super::study::{Column, Comparison, Curve, Mark, Panel, Stroke, Study, Value};
use crate::design::{Design, Specification};
use crate::error::Error;

/// Offsets of the magnet on both sides, mm.
const FARTHEST: i32 = 120;

/// Largest axial force measured, N.
const MEASURED: f64 = 0.09;

/// Axial and attractive force over the offset of the magnet along the device.
///
/// The magnet pair passes at 40 mm from its surface; positive attraction is towards it, positive axial force along the
/// device's magnetisation. Rings, discs and cores by the magnetic charge of their faces, spirals by volume integrals of the
/// gradient, all in the pair's exact field; nothing bends.
///
/// # Errors
/// None for the paper's devices; those of the field and of the designs are passed on.
pub fn fig7c() -> Result<Study, Error> {
    let manipulator = Design::new(Specification::paper(SEGMENTS))?;
    let cylinder = solid_cylinder(manipulator.length())?;
    let magnet = magnet_pair()?;
    let offsets: Vec<f64> = (-FARTHEST..=FARTHEST).step_by(2).map(f64::from).collect();
    let mut columns = vec![Column::new("offset_mm", offsets.clone())];
    let mut largest = Vec::new();
    for (name, design) in [("manipulator", &manipulator), ("cylinder", &cylinder)] {
        let forces = offsets
            .par_iter()
            .map(|offset| held_force(design, &magnet, axis_distance(DISTANCE), offset * 1e-3))
            .collect::<Result<Vec<_>, Error>>()?;
        let axial: Vec<f64> = forces.iter().map(|force| force.z).collect();
        let attraction: Vec<f64> = forces.iter().map(|force| -force.y).collect();
        let most = |values: &[f64]| values.iter().copied().fold(0.0, f64::max);
        largest.push([most(&axial), most(&attraction)]);
        columns.push(Column::new(format!("axial_force_{name}_n"), axial));
        columns.push(Column::new(format!("attraction_{name}_n"), attraction));
    }
    let panel = |title: &str, label: &str, component: &str, marks| Panel::Curves {
        title: title.into(),
        x: ("offset of the magnet (mm)".into(), "offset_mm".into()),
        y: label.into(),
        curves: vec![
            Curve::new("9 segments", format!("{component}_manipulator_n"), 0, Stroke::Solid),
            Curve::new("solid cylinder, Phi = 0.2", format!("{component}_cylinder_n"), 1, Stroke::Dashed),
        ],
        marks,
    };
    let measured =
        vec![Mark::Level("paper: at most 0.09 N".into(), MEASURED), Mark::Level(String::new(), -MEASURED)];
    Ok(Study {
        title: "Fig. 7C: magnetic force at 40 mm from the magnet pair, held straight",
        columns,
        panels: vec![
            panel("along the device", "axial force (N)", "axial_force", measured),
            panel("towards the magnet", "attraction (N)", "attraction", Vec::new()),
        ],
        comparison: comparison(&largest, manipulator.moment() / cylinder.moment()),
    })
}

fn comparison(largest: &[[f64; 2]], moments: f64) -> Vec<Comparison> {
    let [axial, attraction] = [0, 1].map(|component| [largest[0][component], largest[1][component]]);
    vec![
        Comparison {
            quantity: "largest axial force on nine segments (N)".into(),
            decimals: 3,
            paper: Value::Number(MEASURED),
            printed: Value::Absent,
            exact: Value::Number(axial[0]),
            remark: "measured; the remanence of N45 is a catalogue value, permeability 1 and no misalignment are assumed".into(),
        },
        Comparison {
            quantity: "largest axial force on the solid cylinder, Phi = 0.2 (N)".into(),
            decimals: 3,
            paper: Value::Words("similar".into()),
            printed: Value::Absent,
            exact: Value::Number(axial[1]),
            remark: format!(
                "the paper takes equal mu_rel for equal moment, but the manipulator's moment is {moments:.2} times the cylinder's"
            ),
        },
        Comparison {
            quantity: "largest attraction of nine segments (N)".into(),
            decimals: 3,
            paper: Value::Absent,
            printed: Value::Absent,
            exact: Value::Number(attraction[0]),
            remark: "the paper prints no number".into(),
        },
    ]
}
