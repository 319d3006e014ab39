//! One and three segments with helices of different lengths, which are the gaps between the rings.
//!
//! No device is stretched: every length is a separate device with its own branch.

use rayon::prelude::*;

use super::{Found, POINTS, POINTS_OF_THREE, pulled};
use crate::design::{Helix, Segmented, Specification};
use crate::error::Error;
use crate::studies::progress::Progress;
use crate::studies::study::Mark;

/// Gaps whose branches are followed, mm, and descriptions of their folds in the table.
const FOLLOWED: [(f64, Option<&str>); 3] = [
    (3.0, Some("one segment, gaps of 3 mm: pulled shut (mT)")),
    (3.4, Some("one segment, gaps of 3.4 mm: pulled shut (mT)")),
    (4.0, None), // its fold is already in the table
];

/// First and last gap for which the critical field is computed, mm, and the number of gaps.
const TRACED: [f64; 2] = [3.0, 4.2];
const COUNT: u32 = 13;

/// Largest field, mT.
const LARGEST: f64 = 60.0;

/// Branches of one segment in a growing field.
pub(super) fn branches() -> Result<Found, Error> {
    let mut found = Found::new("gap", ["mt", "deg"], 3);
    for (branch, (gap, what)) in FOLLOWED.into_iter().enumerate() {
        let case = pulled(spaced(1, gap), [0.0, 40.0], POINTS)?;
        let (diagram, loading) = (case.trace(0.0)?, case.load(false)?);
        found.branches.add(branch, &case, &diagram);
        found.branches.add_loading(&loading);
        if let (Some(shape), Some(what)) = (diagram.folds().next(), what) {
            found.add(what, shape, loading.snaps.first().copied(), None);
        }
    }
    let touching = Helix::paper().boundary_angle.to_degrees();
    found.branches.mark(Mark::level("windings touch, gap", touching));
    Ok(found)
}

/// The field at which the branches of one and of three segments fold, by the gap.
pub(super) fn critical(progress: &dyn Progress) -> Result<Found, Error> {
    let mut found = Found::new("critical", ["mm", "mt"], 2);
    let [first, last] = TRACED;
    let gaps = (0..COUNT).map(|i| first + (last - first) * f64::from(i) / f64::from(COUNT - 1));
    let gaps: Vec<f64> = gaps.collect();
    let chains = [1, 3];
    progress.more(chains.len() * gaps.len());
    for (branch, segments) in chains.into_iter().enumerate() {
        let folds = gaps.par_iter().map(|&gap| {
            let diagram = pulled(spaced(segments, gap), [0.0, LARGEST], POINTS_OF_THREE)?.trace(0.0)?;
            progress.done();
            Ok([gap, diagram.folds().next().map_or(f64::NAN, |shape| shape.value)])
        });
        for place in folds.collect::<Result<Vec<_>, Error>>()? {
            found.branches.put(branch, place);
        }
    }
    Ok(found)
}

/// The paper's design with the given gap between its rings, mm.
fn spaced(segments: usize, gap: f64) -> Specification {
    let paper = Segmented::paper(segments);
    Specification::Segmented(Segmented { helix: Helix { length: 1e-3 * gap, ..paper.helix }, ..paper })
}
