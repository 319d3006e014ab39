//! Continuation of stationary points: folds and branching points that are known in closed form.

use core::ops::Range;

use mcm::error::Error;
use mcm::numerics::continuation::{End, Family, Local, PointKind, Walk, follow};
use nalgebra::{DMatrix, DVector};

use crate::tolerance::{ON_BRANCH, SINGULAR};

/// Where the second variable loses its stability.
const CROSSING: f64 = 0.2;

/// `x^4/4 - x^2/2 - p x + (CROSSING - p) y^2/2`: folds in `x` at `p = -+2/(3 sqrt 3)`, `y` stable below the crossing.
struct Cusp;

impl Family for Cusp {
    fn at(&mut self, at: &DVector<f64>, p: f64) -> Result<Option<Local>, Error> {
        let [x, y] = [at[0], at[1]];
        let local = Local {
            gradient: DVector::from_vec(vec![x * x * x - x - p, (CROSSING - p) * y]),
            hessian: DMatrix::from_row_slice(2, 2, &[3.0 * x * x - 1.0, 0.0, 0.0, CROSSING - p]),
            drift: DVector::from_vec(vec![-1.0, -y]),
        };
        // Defined up to x = 1.2 only.
        Ok((x < 1.2).then_some(local))
    }
}

const WALK: Walk = Walk { from: -1.0, upwards: true, range: [-1.0, 1.0], longest_step: 0.1, points: 1000 };

#[test]
fn the_cusp_is_followed_through_both_folds_and_the_crossing() {
    let (points, end) = follow(&mut Cusp, &DVector::from_vec(vec![-1.3, 0.0]), &WALK).unwrap();
    assert_eq!(end, End::Stuck, "it ends where the potential does");
    for point in &points {
        let x = point.x[0];
        assert!((x * x * x - x - point.parameter).abs() <= ON_BRANCH, "off the branch: {point:?}");
    }
    let special: Vec<_> = points.iter().filter(|point| point.kind != PointKind::Regular).collect();
    let fold = 2.0 / (3.0 * 3.0_f64.sqrt());
    // Up, over the crossing of `y`, to the upper fold, back over the crossing to the lower fold, and up over it again.
    let expected = [
        (CROSSING, PointKind::Branching(1)),
        (fold, PointKind::Fold),
        (CROSSING, PointKind::Branching(1)),
        (-fold, PointKind::Fold),
        (CROSSING, PointKind::Branching(1)),
    ];
    assert_eq!(special.len(), expected.len(), "{special:?}");
    for (point, (parameter, kind)) in special.iter().zip(expected) {
        assert_eq!(point.kind, kind);
        let error = (point.parameter - parameter).abs();
        assert!(error <= SINGULAR, "{kind:?} at {}, expected {parameter}: {error:e}", point.parameter);
    }
    let near = |x: f64, parameter: Range<f64>| {
        let mut points = points.iter();
        points
            .find(|point| (point.x[0] - x).abs() < 0.1 && parameter.contains(&point.parameter))
            .unwrap()
            .negative()
    };
    assert_eq!([near(-1.2, -1.0..0.0), near(-0.3, 0.2..1.0), near(0.3, -1.0..0.0)], [0, 2, 1]);
}

#[test]
fn a_walk_ends_at_the_limit_of_its_range_or_with_its_last_point() {
    let start = DVector::from_vec(vec![-1.3, 0.0]);
    let (points, end) = follow(&mut Cusp, &start, &Walk { range: [-1.0, 0.1], ..WALK }).unwrap();
    assert_eq!((end, points.last().unwrap().parameter), (End::Range, 0.1));
    let (points, end) = follow(&mut Cusp, &start, &Walk { points: 7, ..WALK }).unwrap();
    assert_eq!((end, points.len()), (End::Points, 7));
    let (points, end) = follow(&mut Cusp, &DVector::from_vec(vec![3.0, 0.0]), &WALK).unwrap();
    assert_eq!((end, points.len()), (End::Stuck, 0), "nothing is found where the potential is not defined");
    let refused = follow(&mut Cusp, &start, &Walk { from: 2.0, ..WALK }).unwrap_err().to_string();
    assert_eq!(refused, "first parameter of the walk = 2 is not allowed: it must be within its range");
}
