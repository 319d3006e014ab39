//! Fig. 8: torque on the last of two to five rings, by the field of those before it and by its gradient.

use nalgebra::Vector3;
use rayon::prelude::*;

use super::study::{Column, Comparison, Study, Value};
use crate::constants::VACUUM_PERMEABILITY;
use crate::design::{Helix, RingMagnet};
use crate::error::Error;
use crate::geometry::Pose;
use crate::magnetics::{AxialRule, AxialSource};

/// Numbers of rings.
const COUNTS: [usize; 4] = [2, 3, 4, 5];

/// Relative deflections of adjacent rings, deg: one row each.
const DEFLECTIONS: core::ops::RangeInclusive<u32> = 1..=40;

/// Deflection at which the spacing varies, deg, and smallest spacing and its step, mm; as many rows as deflections.
const BENT: f64 = 20.0;
const SPACINGS: (f64, f64) = (3.2, 0.1);

/// Interval of spacings that is searched for the balance, mm; any closer, rings deflected by 40 deg touch.
const BALANCE: [f64; 2] = [1.6, 40.0];

/// Width to which the interval is bisected, mm.
const BALANCE_WIDTH: f64 = 1e-6;

/// Relative accuracy requested for a torque; its parts by field and by gradient nearly cancel.
const ACCURACY: f64 = 1e-7;

/// Torque on the last ring about its centre, in the direction in which the chain bends, N m.
#[derive(Debug, Clone, Copy, Default)]
struct Torque {
    /// By the field: the volume integral of `M x B`.
    field: f64,
    /// By the gradient: the volume integral of `(x - c) x grad(M B)`.
    gradient: f64,
}

/// Bending torques on the last of two to five rings of Table 1, by the fields of the rings before it.
///
/// Adjacent rings are deflected by 1 to 40 degrees and joined by an arc of the helix's length; helices are not
/// magnetised. The two parts are those of Eq. (10) about the ring's centre. Positive torques increase the bending,
/// negative ones reduce it. The torque of the forces between rings about other points is left out, as in the paper.
///
/// # Errors
/// None for the paper's rings; those of the field are passed on.
pub fn fig8() -> Result<Study, Error> {
    let helix = Helix::paper();
    let ring = RingMagnet::paper();
    let source = AxialSource::new(helix.core_inner_radius, helix.radius, ring.length, ring.remanence)?;
    let length = helix.length * 1e3;

    let deflections: Vec<f64> = DEFLECTIONS.map(f64::from).collect();
    let spacings: Vec<f64> = (0..deflections.len()).map(|i| SPACINGS.0 + SPACINGS.1 * i as f64).collect();
    let mut columns =
        vec![Column::new("deflection_deg", deflections.clone()), Column::new("spacing_mm", spacings.clone())];

    for count in COUNTS {
        let torques = deflections
            .par_iter()
            .map(|deflection| torque(&source, count, *deflection, length))
            .collect::<Result<Vec<_>, Error>>()?;
        let spaced = spacings
            .par_iter()
            .map(|spacing| torque(&source, count, BENT, *spacing))
            .collect::<Result<Vec<_>, Error>>()?;
        let balanced = deflections
            .par_iter()
            .map(|deflection| balance(&source, count, *deflection))
            .collect::<Result<Vec<_>, Error>>()?;

        let of =
            |torques: &[Torque], part: fn(&Torque) -> f64| torques.iter().map(|t| part(t) * 1e6).collect();
        let parts: [(&str, &str, Vec<f64>); 5] = [
            ("gradient_torque", "unm", of(&torques, |t| t.gradient)),
            ("field_torque", "unm", of(&torques, |t| t.field)),
            ("torque", "unm", of(&torques, Torque::sum)),
            ("torque_at_20_deg", "unm", of(&spaced, Torque::sum)),
            ("balance_spacing", "mm", balanced),
        ];

        for (name, unit, values) in parts {
            columns.push(Column::new(format!("{name}_{count}_rings_{unit}"), values));
        }
    }

    let comparison = comparison(&columns);
    Ok(Study { columns, marks: Vec::new(), comparison })
}

impl Torque {
    fn sum(&self) -> f64 {
        self.field + self.gradient
    }
}

/// Torque on the last of `count` rings, adjacent ones deflected by `deflection` (deg) over an arc of `spacing` (mm).
fn torque(ring: &AxialSource, count: usize, deflection: f64, spacing: f64) -> Result<Torque, Error> {
    let step = next(ring.length(), deflection.to_radians(), spacing * 1e-3)?;
    let rule = AxialRule::new(ring.inner_radius(), ring.outer_radius(), ring.length(), AxialRule::MOST_NODES);
    let magnetisation = ring.remanence() / VACUUM_PERMEABILITY;
    let mut sum = Torque::default();
    let mut pose = Pose::identity();
    for _ in 1..count {
        pose = pose.compose(&step); // the last ring as seen from one before it
        let whole = ring.wrench_on(ring, &pose, ACCURACY)?.torque.x;
        let axis = pose.axis();
        let mut field = Vector3::zeros();
        for (height, volume) in rule.points() {
            field += ring.field(&(pose.position + axis * height))? * volume;
        }
        let by_field = magnetisation * axis.cross(&field).x;
        sum.field += by_field;
        sum.gradient += whole - by_field;
    }
    Ok(sum)
}

/// Pose of a ring's centre relative to that of the ring before it.
fn next(ring_length: f64, deflection: f64, spacing: f64) -> Result<Pose, Error> {
    let half = Pose::identity().advanced(0.5 * ring_length);
    let radius = spacing / deflection;
    let (sine, cosine) = deflection.sin_cos();
    let (half_sine, half_cosine) = (0.5 * deflection).sin_cos();
    // A turn about x rotates the axis towards -y.
    let arc = Pose::new([0.0, -radius * (1.0 - cosine), radius * sine], [half_cosine, half_sine, 0.0, 0.0])?;
    Ok(half.compose(&arc).compose(&half))
}

/// Spacing (mm) at which field and gradient balance; NaN when there is none in the range.
fn balance(ring: &AxialSource, count: usize, deflection: f64) -> Result<f64, Error> {
    let bends_on = |spacing: f64| Ok::<_, Error>(torque(ring, count, deflection, spacing)?.sum() > 0.0);
    let [mut near, mut far] = BALANCE;
    if !bends_on(near)? || bends_on(far)? {
        return Ok(f64::NAN);
    }
    while far - near > BALANCE_WIDTH {
        let middle = 0.5 * (near + far);
        if bends_on(middle)? { near = middle } else { far = middle }
    }
    Ok(0.5 * (near + far))
}

fn comparison(columns: &[Column]) -> Vec<Comparison> {
    let values = |name: String| {
        columns.iter().find(|column| column.name == name).map_or(&[][..], |column| column.values.as_slice())
    };

    let mut rows = Vec::new();
    for count in COUNTS {
        let won = || {
            let sums = DEFLECTIONS.zip(values(format!("torque_{count}_rings_unm")));
            sums.filter(|(_, sum)| **sum > 0.0).map(|(deflection, _)| deflection)
        };
        let exact = won().min().zip(won().max()).map_or_else(
            || Value::Words("none".into()),
            |(least, most)| Value::Range(f64::from(least), f64::from(most)),
        );
        rows.push(Comparison {
            quantity: format!(
                "{count} rings, 4 mm: deflections at which the gradient wins and bends on (deg)"
            ),
            decimals: 0,
            paper: Value::Words(if count == 2 { "all" } else { "shifts to the field" }.into()),
            printed: Value::Absent,
            exact,
            remark: balance_remark(values(format!("balance_spacing_{count}_rings_mm"))),
        });
    }

    let last = |part: &str| values(format!("{part}_torque_2_rings_unm")).last().copied().unwrap_or(f64::NAN);
    rows.push(Comparison {
        quantity: "2 rings, 4 mm, 40 deg: sum of both torques (uN m)".into(),
        decimals: 2,
        paper: Value::Absent,
        printed: Value::Absent,
        exact: Value::Number(last("gradient") + last("field")),
        remark: format!(
            "what is left of {:.2} by the gradient and {:.2} by the field",
            last("gradient"),
            last("field")
        ),
    });
    rows
}

fn balance_remark(spacings: &[f64]) -> String {
    let low = spacings.iter().copied().fold(f64::INFINITY, f64::min);
    let high = spacings.iter().copied().fold(0.0, f64::max);
    format!(
        "field and gradient balance at a spacing of {low:.2} mm (1 deg) to {high:.2} mm (40 deg): closer, the gradient wins"
    )
}
