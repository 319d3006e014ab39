//! The stages of a first solve, from the straight shape to the one at the inputs that were asked for.

use super::path::{FirstStep, Stage};
use crate::equilibrium::model::Inputs;

/// Share of the progress of a first solve until a shaft is pushed in.
const BEGUN: f64 = 0.2;

/// Length (m) by which a shaft is pushed in at first.
const PUSHED: f64 = 2e-3;

/// Share of the way from the soft to the actual wall that is tried first.
const STIFFER: f64 = 0.125;

/// Progress at which a first solve has its unloaded shape, in a wall as wide as it needs; in a soft, then a lined wall; all loads; and
/// the actual wall.
const PROGRESS: [f64; 5] = [0.0, 0.2, 0.4, 0.8, 1.0];

/// The wall of a vessel while a first shape is sought: wide and soft, then narrow, then lined.
#[derive(Debug, Clone, Copy, Default)]
pub(super) struct FirstWall {
    /// Widening of the lumen (m) with which the straight chain fits into it.
    pub(super) widening: f64,
    /// Softening while the lumen narrows around the chain.
    pub(super) narrowing: f64,
    /// Softening while the loads are applied.
    pub(super) lining: f64,
}

/// Where a first solve begins, and its stages.
#[derive(Debug)]
pub(super) struct FirstSolve {
    /// Inputs without loads, at which the straight chain is nearly in equilibrium.
    pub(super) free: Inputs,
    pub(super) stages: Vec<Stage>,
}

/// Inputs of a first solve before its shaft, if there is any, is pushed in under the loads of the target.
pub(super) fn outside(target: &Inputs) -> Inputs {
    Inputs { insertion: 0.0, ..target.clone() }
}

impl FirstSolve {
    /// The first solve at `target` from the straight shape.
    pub(super) fn at(target: &Inputs, wall: &FirstWall) -> Self {
        let FirstWall { widening, narrowing, lining } = *wall;
        let unloaded = Inputs { softening: lining, ..target.without_loads() };
        let lined = Inputs { softening: lining, ..target.clone() };
        let softening = if widening > 0.0 { narrowing } else { lining };
        let free = Inputs { widening, softening, ..unloaded.clone() };

        let mut stages = Vec::new();
        if widening > 0.0 {
            // A vessel that the straight shape does not fit into narrows around it, with a soft wall that then stiffens.
            let narrow = Inputs { softening, ..unloaded.clone() };
            stages.push(stage([&free, &narrow], [0, 1], FirstStep::Part(0.5)));
            stages.push(stage([&narrow, &unloaded], [1, 2], FirstStep::Part(STIFFER)));
        }

        // A wall far stiffer than those of vessels lets none of its contacts change smoothly: it becomes so last.
        let hardens = lined != *target;
        let range = [if widening > 0.0 { 2 } else { 0 }, if hardens { 3 } else { 4 }];
        stages.extend(loading([&unloaded, &lined], range));
        if hardens {
            stages.push(stage([&lined, target], [3, 4], FirstStep::Part(STIFFER)));
        }
        Self { free, stages }
    }

    /// The first solve at `target` from the straight shape without a shaft, as [`outside`] makes it, which is then pushed in.
    pub(super) fn pushed_in(target: &Inputs, wall: &FirstWall) -> Self {
        let outside = outside(target);
        let mut first = Self::at(&outside, wall);
        for stage in &mut first.stages {
            stage.progress = stage.progress.map(|progress| BEGUN * progress);
        }
        first.stages.push(Stage {
            from: outside,
            to: target.clone(),
            progress: [BEGUN, 1.0],
            first: FirstStep::Part((PUSHED / target.insertion).min(1.0)),
        });
        first
    }
}

/// The stages that apply the loads of `target` to the shape under internal forces alone.
fn loading([unloaded, target]: [&Inputs; 2], range: [usize; 2]) -> Vec<Stage> {
    let held = target.without_moment();
    if held == *target {
        return vec![stage([unloaded, target], range, FirstStep::Predicted)];
    }
    // A non-conservative load does not select the branch: it is applied last, to the shape under all other loads.
    let mut first = stage([unloaded, &held], range, FirstStep::Predicted);
    let mut last = stage([&held, target], range, FirstStep::Part(1.0));
    let middle = 0.5 * (first.progress[0] + first.progress[1]);
    (first.progress[1], last.progress[0]) = (middle, middle);
    vec![first, last]
}

/// A stage between two points of progress.
fn stage([from, to]: [&Inputs; 2], range: [usize; 2], first: FirstStep) -> Stage {
    Stage { from: from.clone(), to: to.clone(), progress: range.map(|point| PROGRESS[point]), first }
}
