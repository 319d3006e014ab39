//! Fig. 5: relative magnetic moment over the number of segments.

use super::study::{Column, Comparison, Mark, Study, Value};
use crate::design::{Helix, RelativeMoment, Segmented, SpiralVolume};
use crate::error::Error;

/// Largest number of segments.
const MOST_SEGMENTS: usize = 20;

/// Number of segments of the manipulator that was built.
const BUILT: usize = 9;

/// The paper's relative moment of that manipulator.
const PAPER: f64 = 0.2;

/// A case: its name in columns, and how its helix differs from Table 1.
type Case = (&'static str, fn(&mut Helix));

const CLOSED: Case = ("closed", |helix| helix.core_inner_radius = 0.0);
const OPEN: Case = ("open", |_| ());
const PLAIN: Case = ("plain", |helix| helix.volume_fraction = 0.0);

/// Relative magnetic moment `mu_rel` (Eq. 4 to 8) of manipulators of Table 1 with 1 to 20 segments.
///
/// Three cases: the core cylinder closed (`r_ic = 0`, the rings' bores too), open as built, and open with helices
/// without particles. Each with the printed volume of the spiral (Eq. 8) and with its exact volume.
///
/// # Errors
/// None for the paper's design; those of [`Segmented::relative_moment`] are passed on.
pub fn fig5() -> Result<Study, Error> {
    let segments: Vec<usize> = (1..=MOST_SEGMENTS).collect();
    let mut columns = vec![Column::new("segments", segments.iter().map(|&s| s as f64).collect())];
    for case in [CLOSED, OPEN, PLAIN] {
        for (volume, name) in [(SpiralVolume::Exact, "exact"), (SpiralVolume::Printed, "printed")] {
            let values = segments.iter().map(|&s| Ok(moment(case, s, volume)?.moment));
            let column = format!("mu_rel_{}_{name}", case.0);
            columns.push(Column::new(column, values.collect::<Result<_, Error>>()?));
        }
    }
    let marks = vec![Mark::point("paper", [BUILT as f64, PAPER])];
    Ok(Study { columns, marks, comparison: comparison()? })
}

fn comparison() -> Result<Vec<Comparison>, Error> {
    let exact = moment(OPEN, BUILT, SpiralVolume::Exact)?;
    let printed = moment(OPEN, BUILT, SpiralVolume::Printed)?;
    Ok(vec![
        Comparison {
            quantity: "mu_rel, S = 9".into(),
            decimals: 4,
            paper: Value::Number(PAPER),
            printed: Value::Number(printed.moment),
            exact: Value::Number(exact.moment),
            remark: "Eq. (8) takes the outer radius for the whole spiral, which makes it 3.5 % too large; both round to 0.2".into(),
        },
        Comparison {
            quantity: "moment over that of a solid cylinder of the rings' remanence, S = 9".into(),
            decimals: 4,
            paper: Value::Absent,
            printed: Value::Absent,
            exact: Value::Number(exact.remanent_moment),
            remark: "Eq. (6) multiplies two ratios of volumes, so mu_rel is not the ratio of the moments".into(),
        },
    ])
}

/// The relative moment of a case with `segments` segments.
fn moment((_, change): Case, segments: usize, spiral: SpiralVolume) -> Result<RelativeMoment, Error> {
    let mut chain = Segmented::paper(segments);
    change(&mut chain.helix);
    chain.relative_moment(spiral)
}
