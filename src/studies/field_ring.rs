//! Fig. 3E: field of a ring magnet in front of its face.

use nalgebra::Vector3;

use super::study::{Column, Comparison, Study, Value};
use crate::design::{Helix, RingMagnet};
use crate::error::Error;
use crate::magnetics::{AxialSource, Dipole};

/// The window of Fig. 3E in steps of `STEP`: 3 mm to both sides of the axis, 3 to 5 mm from the ring's centre.
const ACROSS: core::ops::RangeInclusive<i32> = -30..=30;
const ALONG: core::ops::RangeInclusive<i32> = 30..=50;
const STEP: f64 = 1e-4;

/// The authors' two fits to their finite-element results, on the axis: distance from the ring's centre (mm); `B_z` (mT)
/// and `dB_z/dz` (T/m) of the fit used for Fig. 7A, then of the one used for Fig. 8.
///
/// Values of the formulas in <https://github.com/MichielRichter/Magnetic-Soft-Helical-Manipulators>, commit ba3fb21:
/// first `Statics/MagneticField`, used there with a factor of 1.8 and its origin in the ring's face, second
/// `Analysis Dipole Interactions/MagneticFields`, with its origin in the ring's centre.
const FITS: [(i32, [f64; 2], [f64; 2]); 5] = [
    (30, [48.358, -29.974], [45.721, -28.118]),
    (35, [35.524, -21.648], [33.678, -20.319]),
    (40, [26.361, -15.358], [25.078, -14.409]),
    (45, [19.853, -10.945], [18.974, -10.260]),
    (50, [15.189, -7.900], [14.603, -7.401]),
];

/// The field of a ring of Table 1 in the window of Fig. 3E, exact, with its gradients; on the axis beside the authors'
/// fits and a dipole.
///
/// # Errors
/// None for the paper's ring; those of the field are passed on.
pub fn field_ring() -> Result<Study, Error> {
    let ring = RingMagnet::paper();
    let helix = Helix::paper();
    let source = AxialSource::new(helix.core_inner_radius, helix.radius, ring.length, ring.remanence)?;
    let dipole = Dipole::new(Vector3::z() * source.moment())?;
    let mut columns: Vec<Column> = [
        "y_mm",
        "z_mm",
        "b_mt",
        "by_mt",
        "bz_mt",
        "dby_dy_t_per_m",
        "dby_dz_t_per_m",
        "dbz_dz_t_per_m",
        "axis_bz_exact_mt",
        "axis_bz_fit_7a_mt",
        "axis_bz_fit_8_mt",
        "axis_bz_dipole_mt",
        "axis_dbz_dz_exact_t_per_m",
        "axis_dbz_dz_fit_7a_t_per_m",
        "axis_dbz_dz_fit_8_t_per_m",
        "axis_dbz_dz_dipole_t_per_m",
    ]
    .into_iter()
    .map(|name| Column::new(name, Vec::new()))
    .collect();
    // The position along the axis varies fastest, so that the points on the axis are consecutive and form a line.
    for (across, along) in ACROSS.flat_map(|across| ALONG.map(move |along| (across, along))) {
        let point = Vector3::new(0.0, f64::from(across), f64::from(along)) * STEP;
        let (field, gradient) = source.field_gradient(&point)?;
        let (far, far_gradient) = dipole.field_gradient(&point)?;
        let fits = FITS.iter().find(|fit| fit.0 == along);
        let [first, second] = fits.map_or([[f64::NAN; 2]; 2], |fit| [fit.1, fit.2]);
        let on_axis = |value: f64| if across == 0 { value } else { f64::NAN };
        let row = [
            point.y * 1e3,
            point.z * 1e3,
            field.norm() * 1e3,
            field.y * 1e3,
            field.z * 1e3,
            gradient[(1, 1)],
            gradient[(1, 2)],
            gradient[(2, 2)],
            on_axis(field.z * 1e3),
            on_axis(first[0]),
            on_axis(second[0]),
            on_axis(far.z * 1e3),
            on_axis(gradient[(2, 2)]),
            on_axis(first[1]),
            on_axis(second[1]),
            on_axis(far_gradient[(2, 2)]),
        ];
        for (column, value) in columns.iter_mut().zip(row) {
            column.values.push(value);
        }
    }
    let comparison = comparison(&columns);
    Ok(Study { columns, marks: Vec::new(), comparison })
}

fn comparison(columns: &[Column]) -> Vec<Comparison> {
    // The row on the axis at the window's far end, where the next ring's centre is.
    let at_next_ring = |name: &str| {
        let column = columns.iter().find(|column| column.name == name);
        column.and_then(|column| column.values.iter().copied().rfind(|v| !v.is_nan())).unwrap_or(f64::NAN)
    };
    let row = |quantity: &str, name: &str, unit: &str| {
        let [exact, first, second, dipole] = ["exact", "fit_7a", "fit_8", "dipole"]
            .map(|source| at_next_ring(&format!("axis_{name}_{source}_{unit}")));
        let error = |value: f64| 100.0 * (value / exact - 1.0);
        Comparison {
            quantity: quantity.into(),
            decimals: 2,
            paper: Value::Absent,
            printed: Value::Number(first),
            exact: Value::Number(exact),
            remark: format!(
                "the authors' published fit behind Fig. 7A is {:+.1} % off, the one behind Fig. 8 {:+.1} %, a dipole {:+.0} %",
                error(first),
                error(second),
                error(dipole)
            ),
        }
    };
    vec![
        row("B_z of a ring 5 mm from its centre (mT)", "bz", "mt"),
        row("dB_z/dz there (T/m)", "dbz_dz", "t_per_m"),
    ]
}
