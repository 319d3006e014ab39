//! Fig. 4: the choice of helix length and boundary angle.

use rayon::prelude::*;

use super::progress::Progress;
use super::study::{Column, Comparison, Mark, Study, Value};
use crate::design::{Design, Helix, HelixGeometry, RingMagnet, Segmented, Specification, SpiralVolume};
use crate::equilibrium::{Inputs, Interaction, Settings};
use crate::error::Error;
use crate::manipulator::{Manipulator, Status};

/// Lengths in tenths of a millimetre and boundary angles in degrees. The paper does not print its grid; below these no
/// design meets the constraints.
const LENGTHS: core::ops::RangeInclusive<u32> = 35..=66;
const ANGLES: core::ops::RangeInclusive<u32> = 35..=60;

/// Steps of a coarse grid of round numbers, of which the paper's choice is one.
const COARSE: (u32, u32) = (5, 5);

/// The paper's choice: length in tenths of a millimetre, boundary angle in degrees.
const CHOSEN: (u32, u32) = (40, 40);

/// The manipulator has to bend by this angle (deg) within this length (mm), Eq. (16).
const BEND: (f64, f64) = (120.0, 15.0);

/// Smallest winding height (mm) and height over pitch that can be made.
const LEAST: (f64, f64) = (0.6, 0.9);

/// Rounding allowed in a constraint that is met exactly, as by the paper's own choice.
const SLACK: f64 = 1e-9;

/// Perpendicular field in which the deflection is evaluated, T.
const FIELD: f64 = 0.02;

/// Fraction of the best score from which a design counts as good.
const GOOD: f64 = 0.95;

/// The models: the paper's with its printed volume, ours with the exact one.
const MODELS: [(Interaction, SpiralVolume); 4] = [
    (Interaction::Preceding, SpiralVolume::Printed),
    (Interaction::None, SpiralVolume::Exact),
    (Interaction::Rings, SpiralVolume::Exact),
    (Interaction::Full, SpiralVolume::Exact),
];

const PRINTED: usize = 0;
const EXACT: usize = 3;

/// A combination of length and boundary angle.
struct Candidate {
    tenths: u32,
    degrees: u32,
    helix: Helix,
    geometry: HelixGeometry,
    /// Length in which the manipulator bends by the required angle, the left side of Eq. (16), mm.
    bend: f64,
}

/// Results of a model for a candidate.
#[derive(Clone, Copy)]
struct Scored {
    moment: f64,
    /// Tip angle, deg.
    angle: f64,
    /// Eq. (17), Eq. (18), and their sum.
    scores: [f64; 3],
}

/// The choice of helix length and boundary angle for one segment of Table 1 in a perpendicular field of 20 mT.
///
/// Every design of a grid that meets Eq. (16), `h >= 0.6 mm` and `h/p >= 0.9` is solved. Eq. (17) scores how close its
/// tip angle is to its boundary angle, Eq. (18) its relative moment, both from 0 to 1 over the designs of the grid; the
/// design with the largest sum is chosen.
///
/// # Errors
/// None for the paper's design; those of the solver's settings are passed on.
pub fn fig4(progress: &dyn Progress) -> Result<Study, Error> {
    let grid: Vec<Candidate> = LENGTHS
        .flat_map(|tenths| ANGLES.map(move |degrees| Candidate::new(tenths, degrees)))
        .collect::<Result<_, _>>()?;

    progress.more(MODELS.len() * grid.len());
    let solved =
        MODELS.iter().map(|model| solve(&grid, *model, progress)).collect::<Result<Vec<_>, Error>>()?;
    let scored: Vec<_> = solved.iter().map(|solved| score(&grid, solved)).collect();

    // The paper's grid is not printed: one of round numbers stands for it.
    let on_coarse = |solved: &Vec<Option<(f64, f64)>>| {
        let kept: Vec<_> =
            grid.iter().zip(solved).map(|(c, solved)| solved.filter(|_| c.is_coarse())).collect();
        score(&grid, &kept)
    };
    let coarse: Vec<_> = solved.iter().map(on_coarse).collect();

    let column =
        |name: &str, value: &dyn Fn(&Candidate) -> f64| Column::new(name, grid.iter().map(value).collect());
    let mut columns = vec![
        column("length_mm", &|c| f64::from(c.tenths) / 10.0),
        column("boundary_angle_deg", &|c| f64::from(c.degrees)),
        column("winding_height_mm", &|c| c.geometry.height * 1e3),
        column("height_over_pitch", &|c| c.geometry.height / c.geometry.pitch),
        column("bend_length_mm", &|c| c.bend),
    ];

    for ((level, _), values) in MODELS.iter().zip(&scored) {
        let of = |value: &dyn Fn(&Scored) -> f64| {
            values.iter().map(|scored| scored.as_ref().map_or(f64::NAN, value)).collect()
        };
        let name = level.name();
        columns.push(Column::new(format!("alpha_{name}_deg"), of(&|s| s.angle)));
        columns.push(Column::new(format!("mu_rel_{name}"), of(&|s| s.moment)));
        for (index, score) in ["deflection", "moment", "sum"].into_iter().enumerate() {
            columns.push(Column::new(format!("score_{score}_{name}"), of(&|s| s.scores[index])));
        }
    }

    let chosen = [f64::from(CHOSEN.0) / 10.0, f64::from(CHOSEN.1)];
    let comparison = comparison(&grid, &scored, &coarse);
    Ok(Study { columns, marks: vec![Mark::point("paper", chosen)], comparison })
}

impl Candidate {
    fn new(tenths: u32, degrees: u32) -> Result<Self, Error> {
        let length = f64::from(tenths) * 1e-4;
        let boundary_angle = f64::from(degrees).to_radians();
        let helix = Helix { length, boundary_angle, ..Helix::paper() };
        let needed = BEND.0 / f64::from(degrees);
        let bend = (needed * length + needed.floor() * RingMagnet::paper().length) * 1e3;
        Ok(Self { tenths, degrees, geometry: helix.geometry()?, helix, bend })
    }

    /// Whether it meets Eq. (16) and can be made.
    fn is_allowed(&self) -> bool {
        let HelixGeometry { height, pitch, .. } = self.geometry;
        self.bend <= BEND.1 + SLACK && height * 1e3 >= LEAST.0 && height / pitch >= LEAST.1
    }

    fn is_at(&self, place: (u32, u32)) -> bool {
        (self.tenths, self.degrees) == place
    }

    fn is_coarse(&self) -> bool {
        self.tenths.is_multiple_of(COARSE.0) && self.degrees.is_multiple_of(COARSE.1)
    }

    /// Relative moment of one segment and its tip angle (deg).
    fn solve(&self, level: Interaction, volume: SpiralVolume) -> Result<(f64, f64), Error> {
        let chain = Segmented { helix: self.helix, ..Segmented::paper(1) };
        let moment = chain.relative_moment(volume)?.moment;
        let mut inputs = Inputs::unloaded(chain.ring_count());
        inputs.uniform_field.y = FIELD;
        let settings = Settings { interaction: level, ..Settings::default() };
        let design = Design::new(Specification::Segmented(chain))?;
        let mut manipulator = Manipulator::new(&design, None, settings, 2)?;
        let outputs = manipulator.solve(&inputs)?;
        let solved = outputs.status != Status::NotSolved;
        Ok((moment, if solved { outputs.tip_angle.to_degrees() } else { f64::NAN }))
    }
}

/// Relative moment and tip angle (deg) by one model, for every candidate that is allowed.
fn solve(
    grid: &[Candidate],
    (level, volume): (Interaction, SpiralVolume),
    progress: &dyn Progress,
) -> Result<Vec<Option<(f64, f64)>>, Error> {
    let allowed = |candidate: &Candidate| {
        let solved = candidate.is_allowed().then(|| candidate.solve(level, volume)).transpose();
        progress.done();
        solved
    };
    grid.par_iter().map(allowed).collect()
}

/// The scores of every candidate that was solved.
fn score(grid: &[Candidate], solved: &[Option<(f64, f64)>]) -> Vec<Option<Scored>> {
    let mismatch = |candidate: &Candidate, angle: f64| (angle - f64::from(candidate.degrees)).abs();
    let each = || grid.iter().zip(solved).filter_map(|(c, solved)| Some((c, (*solved)?)));
    let moments = span(each().map(|(_, (moment, _))| moment));
    let mismatches = span(each().map(|(c, (_, angle))| mismatch(c, angle)));
    let rate = |candidate: &Candidate, (moment, angle): (f64, f64)| {
        let deflection = (mismatches[1] - mismatch(candidate, angle)) / (mismatches[1] - mismatches[0]);
        let strength = (moment - moments[0]) / (moments[1] - moments[0]);
        Scored { moment, angle, scores: [deflection, strength, deflection + strength] }
    };
    grid.iter().zip(solved).map(|(c, solved)| solved.map(|solved| rate(c, solved))).collect()
}

/// Smallest and largest value.
fn span(values: impl Iterator<Item = f64>) -> [f64; 2] {
    values.fold([f64::INFINITY, f64::NEG_INFINITY], |[low, high], value| [low.min(value), high.max(value)])
}

/// The candidate with the largest sum of scores, and that sum.
fn best<'a>(grid: &'a [Candidate], scored: &[Option<Scored>]) -> Option<(&'a Candidate, f64)> {
    let sums = grid.iter().zip(scored).filter_map(|(c, s)| Some((c, s.as_ref()?.scores[2])));
    sums.filter(|(_, sum)| !sum.is_nan()).max_by(|a, b| a.1.total_cmp(&b.1))
}

fn design(found: Option<(&Candidate, f64)>) -> Value {
    found.map_or(Value::Absent, |(c, _)| {
        Value::Words(format!("{:.1} mm, {} deg", f64::from(c.tenths) / 10.0, c.degrees))
    })
}

fn comparison(
    grid: &[Candidate],
    scored: &[Vec<Option<Scored>>],
    coarse: &[Vec<Option<Scored>>],
) -> Vec<Comparison> {
    let share = |model: usize| {
        let sums = grid.iter().zip(&scored[model]).find(|(c, _)| c.is_at(CHOSEN));
        let own = sums.and_then(|(_, s)| Some(s.as_ref()?.scores[2]));
        own.zip(best(grid, &scored[model])).map_or(Value::Absent, |(own, (_, top))| Value::Number(own / top))
    };

    let good = |model: usize, of: &dyn Fn(&Candidate) -> f64| {
        let Some((_, top)) = best(grid, &scored[model]) else { return Value::Absent };
        let good =
            grid.iter().zip(&scored[model]).filter(|(_, s)| s.is_some_and(|s| s.scores[2] >= GOOD * top));
        let [low, high] = span(good.map(|(c, _)| of(c)));
        Value::Range(low, high)
    };

    let chosen = || Value::Words("4.0 mm, 40 deg".into());

    vec![
        Comparison {
            quantity: "best design on a grid of 0.5 mm, 5 deg".into(),
            decimals: 0,
            paper: chosen(),
            printed: design(best(grid, &coarse[PRINTED])),
            exact: design(best(grid, &coarse[EXACT])),
            remark: format!(
                "of the {} round designs that meet the constraints every level of interaction chooses the paper's; its grid is not printed",
                coarse[EXACT].iter().flatten().count()
            ),
        },
        Comparison {
            quantity: "best design on a grid of 0.1 mm, 1 deg".into(),
            decimals: 0,
            paper: chosen(),
            printed: design(best(grid, &scored[PRINTED])),
            exact: design(best(grid, &scored[EXACT])),
            remark: "on a finer grid the paper's own model goes on along the edge of Eq. (16) to smaller segments; the mutual interactions bend further and prefer larger ones".into(),
        },
        Comparison {
            quantity: "score of 4 mm, 40 deg over the best".into(),
            decimals: 2,
            paper: Value::Absent,
            printed: share(PRINTED),
            exact: share(EXACT),
            remark: "from 0, the worst, to 1, the best".into(),
        },
        Comparison {
            quantity: "lengths within 5 % of the best score (mm)".into(),
            decimals: 1,
            paper: Value::Absent,
            printed: good(PRINTED, &|c| f64::from(c.tenths) / 10.0),
            exact: good(EXACT, &|c| f64::from(c.tenths) / 10.0),
            remark: "the optimum of the paper's model is a corner of the constraints, that of the full model is flat".into(),
        },
        Comparison {
            quantity: "boundary angles within 5 % of the best score (deg)".into(),
            decimals: 0,
            paper: Value::Absent,
            printed: good(PRINTED, &|c| f64::from(c.degrees)),
            exact: good(EXACT, &|c| f64::from(c.degrees)),
            remark: "the same designs".into(),
        },
    ]
}
