//! Fig. 7D: field of the magnet pair and its gradients along the device.

use nalgebra::Vector3;

use super::experiment::{DISTANCE, axis_distance, magnet_pair};
use super::study::{Column, Comparison, Mark, Study, Value};
use crate::error::Error;
use crate::magnetics::{Dipole, Source};

/// Distances from the surface of the magnets, mm.
const DISTANCES_MM: [u32; 3] = [30, 40, 50];

/// Largest distance of the points to both sides of the magnet's middle, mm.
const FARTHEST: i32 = 120;

/// Half the length of nine segments, mm.
const HALF_DEVICE: f64 = 23.0;

const MM: f64 = 1e-3;

/// What the paper states along the device at 40 mm: field, mT, and gradient, T/m.
const PAPER_FIELD_MT: [f64; 2] = [20.0, 30.0];
const PAPER_GRADIENT: [f64; 2] = [0.7, 1.0];

/// Field and gradients on lines beside the magnet pair, parallel to its axis.
///
/// `z` runs along the device from the magnet's middle, against the magnet's moment, `y` away from the magnet: the signs
/// are those in the axes of a device that the magnet attracts.
///
/// # Errors
/// None here; those of the field are passed on.
pub fn fig7d() -> Result<Study, Error> {
    let magnet = magnet_pair()?;
    let places: Vec<f64> = (-FARTHEST..=FARTHEST).map(f64::from).collect();
    let mut columns = vec![Column::new("z_mm", places.clone())];
    for distance in DISTANCES_MM {
        let along = places
            .iter()
            .map(|z| beside(&magnet, f64::from(distance) * MM, z * MM))
            .collect::<Result<Vec<_>, Error>>()?;
        let at = format!("at_{distance}");
        for (index, (name, unit)) in
            [("bz", "mt"), ("by", "mt"), ("dbz_dz", "t_per_m"), ("dbz_dy", "t_per_m"), ("dby_dy", "t_per_m")]
                .into_iter()
                .enumerate()
        {
            columns.push(Column::new(
                format!("{name}_{at}_{unit}"),
                along.iter().map(|row| row[index]).collect(),
            ));
        }
    }
    let marks = [Mark::band("paper, field", PAPER_FIELD_MT), Mark::band("paper, gradient", PAPER_GRADIENT)];
    Ok(Study { columns, marks: marks.concat(), comparison: comparison(&magnet, &places)? })
}

/// `B_z`, `B_y` (mT), `dB_z/dz`, `dB_z/dy`, `dB_y/dy` (T/m) at `distance` from the surface and `z` along it (m).
fn beside(magnet: &Source, distance: f64, z: f64) -> Result<[f64; 5], Error> {
    // Half a turn about x lies between the device's axes and the magnet's: y and z change sign.
    let (field, gradient) = magnet.field_gradient(&Vector3::new(0.0, -axis_distance(distance), -z))?;
    let gradients = [(2, 2), (2, 1), (1, 1)].map(|index| gradient[index]);
    Ok([-field.z * 1e3, -field.y * 1e3, gradients[0], gradients[1], gradients[2]])
}

fn comparison(magnet: &Source, places: &[f64]) -> Result<Vec<Comparison>, Error> {
    let stated = |[low, high]: [f64; 2]| Value::Range(low, high);
    let rows = places.iter().map(|z| Ok((*z, beside(magnet, DISTANCE, z * MM)?)));
    let rows = rows.collect::<Result<Vec<_>, Error>>()?;

    let range = |value: fn(&[f64; 5]) -> f64| {
        let along = rows.iter().filter(|(z, _)| z.abs() <= HALF_DEVICE).map(|(_, row)| value(row));
        let [low, high] = along.fold([f64::INFINITY, 0.0_f64], |[low, high], v| [low.min(v), high.max(v)]);
        Value::Range(low, high)
    };

    let (steepest, gradient) = rows
        .iter()
        .map(|(z, row)| (z.abs(), row[2].abs()))
        .fold((0.0, 0.0), |most, next| if next.1 > most.1 { next } else { most });

    let dipole = Dipole::new(magnet.moment())?;
    let single = -dipole.field(&Vector3::new(0.0, axis_distance(DISTANCE), 0.0))?.z * 1e3;

    Ok(vec![
        Comparison {
            quantity: "field along the device at 40 mm (mT)".into(),
            decimals: 1,
            paper: stated(PAPER_FIELD_MT),
            printed: Value::Absent,
            exact: range(|row| row[0].hypot(row[1])),
            remark: format!(
                "inside, with 40 mm counted from the magnets' surface; one dipole of the pair's moment would make {single:.0} mT at the middle"
            ),
        },
        Comparison {
            quantity: "largest dB_z/dz at 40 mm (T/m)".into(),
            decimals: 2,
            paper: stated(PAPER_GRADIENT),
            printed: Value::Absent,
            exact: Value::Number(gradient),
            remark: format!(
                "inside; met {steepest:.0} mm to both sides of the magnet's middle, at which it is zero"
            ),
        },
        Comparison {
            quantity: "size of grad B_z along the device at 40 mm (T/m)".into(),
            decimals: 2,
            paper: stated(PAPER_GRADIENT),
            printed: Value::Absent,
            exact: range(|row| row[2].hypot(row[3])),
            remark: "inside; at the middle all of it is across the device".into(),
        },
    ])
}
