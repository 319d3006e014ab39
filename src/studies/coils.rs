//! What eight coils round a workspace reach: field and gradient by the least currents, within a limit of current.

use nalgebra::{DMatrix, DVector, Matrix3, Vector3};

use super::study::{Column, Comparison, Study, Value};
use crate::equilibrium::PlacedSource;
use crate::error::Error;
use crate::magnetics::Sources;
use crate::manipulator::Scene;

/// Eight coils, arranged as in the `OctoMag`.
const SCENE: &str = include_str!("../../fmu/examples/eight_coils.toml");

/// Largest current through a coil, A.
const LIMIT: f64 = 10.0;

/// Places along each axis, mm from the point that all coils point at.
const PLACES_MM: [f64; 13] =
    [-30.0, -25.0, -20.0, -15.0, -10.0, -5.0, 0.0, 5.0, 10.0, 15.0, 20.0, 25.0, 30.0];

/// Number of directions of a field or gradient that are tried; the opposite ones need the opposite currents.
const DIRECTIONS: usize = 200;

/// Field and gradient per ampere at a place.
struct Map {
    /// Rows of the field `B_x`, `B_y`, `B_z`, T/A, over those of [`components`], T/(m A); a column for each coil.
    rows: DMatrix<f64>,
}

/// The five components that a curl- and divergence-free gradient has: `dBx/dx`, `dBx/dy`, `dBx/dz`, `dBy/dy`, `dBy/dz`.
fn components(gradient: &Matrix3<f64>) -> [f64; 5] {
    [gradient[(0, 0)], gradient[(0, 1)], gradient[(0, 2)], gradient[(1, 1)], gradient[(1, 2)]]
}

impl Map {
    fn at(sources: &Sources, placed: &[PlacedSource], point: &Vector3<f64>) -> Result<Self, Error> {
        let mut rows = DMatrix::zeros(8, placed.len());
        for ((coil, PlacedSource { pose, .. }), mut column) in
            sources.list().iter().zip(placed).zip(rows.column_iter_mut())
        {
            let (field, gradient) = coil.field_gradient_from(pose, point)?;
            column.rows_mut(0, 3).copy_from(&field);
            column.rows_mut(3, 5).copy_from_slice(&components(&gradient));
        }
        Ok(Self { rows })
    }

    /// How much of each of `wanted` the least currents make before one of them is at the limit: smallest and largest.
    fn reach(&self, wanted: &[DVector<f64>]) -> Result<[f64; 2], Error> {
        let given = wanted.first().map_or(0, DVector::len);
        let rows = self.rows.rows(0, given).into_owned();
        let inverse = rows.pseudo_inverse(0.0).map_err(|reason| Error::Unsupported(reason.into()))?;
        let reached = wanted.iter().map(|wanted| LIMIT / (&inverse * wanted).amax());
        Ok(reached
            .fold([f64::INFINITY, 0.0], |[least, most], reached| [least.min(reached), most.max(reached)]))
    }
}

/// Directions evenly over half a sphere.
fn directions() -> impl Iterator<Item = Vector3<f64>> {
    let golden = core::f64::consts::PI * (3.0 - 5.0_f64.sqrt());
    (0..DIRECTIONS).map(move |k| {
        let z = (k as f64 + 0.5) / DIRECTIONS as f64;
        let (sine, cosine) = (golden * k as f64).sin_cos();
        let across = (1.0 - z * z).sqrt();
        Vector3::new(across * cosine, across * sine, z)
    })
}

/// Field and gradient that the eight coils of `fmu/examples/eight_coils.toml` reach in every direction with at most 10 A, along two
/// axes through the middle of their workspace.
///
/// The currents are the least ones (by the sum of their squares) that make the field `B n`, whatever its gradient, or no field and the
/// gradient with `dB_n/dn = G` that is symmetric about `n`; the direction `n` in which they reach least counts. The same map is used by
/// M. P. Kummer et al., `OctoMag`, <https://doi.org/10.1109/TRO.2010.2073030>.
///
/// # Errors
/// None for these coils; those of the fields are passed on.
pub fn coils() -> Result<Study, Error> {
    let scene = Scene::parse(SCENE, "eight coils")?;
    let (sources, placed) = (&scene.sources, &scene.inputs.sources);

    let fields: Vec<_> = directions().map(|n| DVector::from_column_slice(n.as_slice())).collect();

    let gradients: Vec<_> = directions()
        .map(|n| {
            let gradient = 1.5 * n * n.transpose() - 0.5 * Matrix3::identity();
            let five = components(&gradient);
            DVector::from_iterator(8, [0.0; 3].into_iter().chain(five))
        })
        .collect();

    let mut columns = vec![Column::new("place_mm", PLACES_MM.to_vec())];
    for (axis, name) in [(0, "x"), (2, "z")] {
        let reached = PLACES_MM.map(|place| {
            let map = Map::at(sources, placed, &(Vector3::ith(axis, 1e-3 * place)))?;
            Ok::<_, Error>([1e3 * map.reach(&fields)?[0], map.reach(&gradients)?[0]])
        });
        let reached = reached.into_iter().collect::<Result<Vec<_>, _>>()?;
        let part = |part: usize| reached.iter().map(|reached| reached[part]).collect();
        columns.push(Column::new(format!("field_{name}_mt"), part(0)));
        columns.push(Column::new(format!("gradient_{name}_t_per_m"), part(1)));
    }

    let middle = Map::at(sources, placed, &Vector3::zeros())?;
    let [field, gradient] = [middle.reach(&fields)?, middle.reach(&gradients)?];

    let row = |quantity: &str, [least, most]: [f64; 2], remark: &str| Comparison {
        quantity: quantity.into(),
        decimals: 2,
        paper: Value::Absent,
        printed: Value::Absent,
        exact: Value::Range(least, most),
        remark: remark.into(),
    };

    Ok(Study {
        columns,
        marks: Vec::new(),
        comparison: vec![
            row(
                "field of eight coils in the middle, 10 A, by direction (mT)",
                field.map(|field| 1e3 * field),
                "least currents; 1500 turns each, no iron",
            ),
            row(
                "gradient of eight coils in the middle, 10 A, without a field, by direction (T/m)",
                gradient,
                "dB_n/dn along any direction n",
            ),
        ],
    })
}
