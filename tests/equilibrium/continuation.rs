//! Branches through folds: beside closed forms, bisection along the stable part, and the energy.

use mcm::design::{Design, Specification};
use mcm::equilibrium::{Diagram, Equilibrium, Inputs, Interaction, Settings, Solution};
use mcm::manipulator::{Branch, Manipulator};
use mcm::numerics::continuation::{End, PointKind, Walk};
use nalgebra::Vector3;

use crate::rod::table::{Chain, rows_of};
use crate::tolerance::{
    ALONG_ENERGY, CLOSED_FORM_OF_FOLDS, CRITICAL_WITHOUT_PAIRS, ELASTICA, LOCATED, MARGIN, RESIDUAL,
};

/// A field of that size, `degrees` from +z towards +y.
fn field(rings: usize, size: f64, degrees: f64) -> Inputs {
    let (sine, cosine) = degrees.to_radians().sin_cos();
    Inputs { uniform_field: Vector3::new(0.0, sine, cosine) * size, ..Inputs::unloaded(rings) }
}

fn walk(range: [f64; 2], longest_step: f64, points: usize) -> Walk {
    Walk { from: range[0], upwards: true, range, longest_step, points }
}

/// A branch with one fold, and what it belongs to.
struct Traced {
    name: &'static str,
    equilibrium: Equilibrium,
    inputs: fn(f64) -> Inputs,
    range: [f64; 2],
    diagram: Diagram,
}

/// One segment in a growing field, three in one that turns: through the fold, until the rings are close to each other.
fn traced() -> Vec<Traced> {
    type Given = (&'static str, usize, Interaction, fn(f64) -> Inputs, [f64; 2], usize);
    let cases: [Given; 2] = [
        ("full", 1, Interaction::Full, |size| field(2, size, 90.0), [0.0, 0.04], 130),
        ("rings", 3, Interaction::Rings, |degrees| field(4, 0.02, degrees), [0.0, 170.0], 160),
    ];
    let trace = |(name, segments, interaction, inputs, range, points): Given| {
        let design = Design::new(Specification::paper(segments)).unwrap();
        let settings = Settings { interaction, ..Settings::default() };
        let mut equilibrium = Equilibrium::new(&design, None, settings, 2).unwrap();
        assert!(equilibrium.solve(&inputs(range[0])).unwrap().solved());
        let diagram = equilibrium.trace(|value| Ok(inputs(value)), &walk(range, 0.03, points)).unwrap();
        Traced { name, equilibrium, inputs, range, diagram }
    };
    cases.into_iter().map(trace).collect()
}

#[test]
fn the_turned_dipole_keeps_to_its_closed_form_through_both_folds() {
    let rows = rows_of("tip_dipole_snap");
    let value = |quantity: &str| rows.iter().find(|row| row.quantity == quantity).expect(quantity);
    let (theta, phi) = (value("theta_fold"), value("phi_fold").value);
    let lam = theta.parameter("Lam");
    let mut chain = Chain::new(1);
    let size = lam * chain.unit_field;
    chain.equilibrium.solve(&field(1, size, 0.0)).unwrap();
    let turning = |degrees: f64| Ok(field(1, size, degrees));
    let diagram = chain.equilibrium.trace(turning, &walk([0.0, 360.0], 0.1, 400)).unwrap();
    assert_eq!((diagram.end, diagram.shapes.last().unwrap().value), (End::Range, 360.0));
    let bent = |index: usize| {
        let axis = diagram.shapes[index].tip.axis();
        axis.y.atan2(axis.z)
    };
    for (index, shape) in diagram.shapes.iter().enumerate() {
        let arc = lam * (shape.value.to_radians() - bent(index)).sin();
        assert!((bent(index) - arc).abs() <= ELASTICA, "{} deg: {} rad, not {arc}", shape.value, bent(index));
    }
    // Out of the plane the arc is unstable between 180 degrees on both its sides, in the plane between the folds.
    let expected = [
        (180.0, PointKind::Branching(1), [0, 1]),
        (phi, PointKind::Fold, [1, 2]),
        (360.0 - phi, PointKind::Fold, [2, 1]),
        (180.0, PointKind::Branching(1), [1, 0]),
    ];
    let special: Vec<usize> =
        (0..diagram.shapes.len()).filter(|&index| diagram.shapes[index].kind != PointKind::Regular).collect();
    assert_eq!(special.len(), expected.len());
    for (&index, (value, kind, unstable)) in special.iter().zip(expected) {
        let shape = &diagram.shapes[index];
        assert_eq!(
            (shape.kind, [index - 1, index + 1].map(|i| diagram.shapes[i].unstable)),
            (kind, unstable)
        );
        let error = (shape.value / value - 1.0).abs();
        assert!(error <= CLOSED_FORM_OF_FOLDS, "{kind:?} at {}, expected {value}: {error:e}", shape.value);
        println!("{kind:?} at {value}: {error:e}");
    }
    assert!((bent(special[1]) - theta.value).abs() <= ELASTICA, "{} rad", bent(special[1]));
}

#[test]
fn the_straight_chain_forks_at_its_critical_field_in_both_planes() {
    for row in rows_of("chain_buckling") {
        let mut chain = Chain::new(row.parameter("N") as usize);
        let (rings, unit) = (chain.rings, chain.unit_field);
        chain.equilibrium.solve(&field(rings, 0.0, 180.0)).unwrap();
        let growing = |lam: f64| Ok(field(rings, lam * unit, 180.0));
        let diagram = chain.equilibrium.trace(growing, &walk([0.0, 1.5 * row.value], 0.1, 400)).unwrap();
        let forks: Vec<_> = diagram.shapes.iter().filter(|shape| shape.kind != PointKind::Regular).collect();
        assert_eq!(forks.len(), 1, "{row:?}");
        assert_eq!(forks[0].kind, PointKind::Branching(2), "{row:?}");
        let error = (forks[0].value / row.value - 1.0).abs();
        assert!(error <= CRITICAL_WITHOUT_PAIRS, "{row:?}: {error:e}");
        assert_eq!(diagram.shapes.last().unwrap().unstable, 2, "{row:?}");
    }
}

#[test]
fn unstable_shapes_are_in_balance_and_lose_one_direction_at_the_fold() {
    for Traced { name, mut equilibrium, inputs, diagram, .. } in traced() {
        let metric = equilibrium.metric().to_vec();
        let (mut unstable, mut worst) = (0, 0.0_f64);
        for shape in &diagram.shapes {
            let (_, gradient) = equilibrium.gradient(&inputs(shape.value), &shape.unknowns).expect("apart");
            let dual = gradient.iter().zip(&metric).map(|(g, k)| g * g / (k * metric[0])).sum::<f64>().sqrt();
            worst = worst.max(dual);
            assert!(dual <= RESIDUAL, "{name}, {}: residual {dual:e}", shape.value);
            unstable += usize::from(shape.unstable > 0);
        }
        assert!(unstable > 20, "{name}: only {unstable} unstable shapes");
        let fold = diagram.shapes.iter().position(|shape| shape.kind == PointKind::Fold).expect("a fold");
        let around = [fold - 1, fold + 1].map(|index| diagram.shapes[index].unstable);
        assert_eq!((around, diagram.folds().count()), ([0, 1], 1), "{name}");
        println!("{name}: residual {worst:e}");
    }
}

#[test]
fn folds_are_where_bisection_along_the_stable_branch_ends() {
    for Traced { name, equilibrium, inputs, range, diagram } in traced() {
        let segments = equilibrium.rings().count() - 1;
        let design = Design::new(Specification::paper(segments)).unwrap();
        let settings = equilibrium.settings().as_discretised();
        let manipulator = Manipulator::new(&design, None, settings, 2).unwrap();
        let span = range[1] - range[0];
        let mut branch = Branch::new(manipulator, |value| Ok(inputs(value)), span, span / 40.0).unwrap();
        branch.to(range[0]).unwrap();
        branch.to(range[1]).unwrap();
        let (fold, located) = (diagram.folds().next().expect("a fold").value, branch.folds()[0].value);
        assert!((fold - located).abs() <= LOCATED * span, "{name}: fold at {fold}, bisection {located}");
    }
}

#[test]
fn the_energy_changes_along_the_branch_as_by_the_inputs_alone() {
    for Traced { name, mut equilibrium, inputs, range, diagram } in traced() {
        // In balance the shape's change does no work: dE/dp is the slope of the energy at a fixed shape.
        let step = 1e-4 * (range[1] - range[0]);
        let mut slope = |value: f64, unknowns: &[f64]| {
            let mut energy = |value: f64| equilibrium.gradient(&inputs(value), unknowns).expect("apart").0;
            (energy(value + step) - energy(value - step)) / (2.0 * step)
        };
        let slopes: Vec<f64> =
            diagram.shapes.iter().map(|shape| slope(shape.value, &shape.unknowns)).collect();
        let largest = slopes.iter().fold(0.0_f64, |a, b| a.max(b.abs()));
        let mut worst = 0.0_f64;
        for (pair, slopes) in diagram.shapes.windows(2).zip(slopes.windows(2)) {
            let way = pair[1].value - pair[0].value;
            let expected = 0.5 * (slopes[0] + slopes[1]) * way;
            let error =
                (pair[1].energy - pair[0].energy - expected).abs() / (largest * (range[1] - range[0]));
            worst = worst.max(error);
            assert!(error <= ALONG_ENERGY, "{name}, {}: {error:e}", pair[0].value);
        }
        println!("{name}: energy {worst:e}");
    }
}

#[test]
fn margins_of_stable_shapes_are_those_of_the_solver() {
    for Traced { name, mut equilibrium, inputs, diagram, .. } in traced() {
        for shape in diagram.shapes.iter().take_while(|shape| shape.unstable == 0).step_by(10) {
            assert!(equilibrium.solve(&inputs(shape.value)).unwrap().solved());
            let expected = equilibrium.margin().expect("stable");
            let error = (shape.margin / expected - 1.0).abs();
            assert!(error <= MARGIN, "{name}, {}: margin {}, solver {expected}", shape.value, shape.margin);
        }
    }
}

#[test]
fn what_has_no_potential_or_no_range_is_refused() {
    let design = Design::new(Specification::paper(3)).unwrap();
    let settings = Settings { interaction: Interaction::Preceding, ..Settings::default() };
    let equilibrium = Equilibrium::new(&design, None, settings, 2).unwrap();
    let growing = |size: f64| Ok(field(4, size, 90.0));
    let refused = |walk: Walk| equilibrium.trace(growing, &walk).unwrap_err().to_string();
    assert!(refused(walk([0.0, 0.01], 0.1, 9)).contains("not at the level `preceding`"));
    assert!(refused(walk([0.01, 0.01], 0.1, 9)).starts_with("span of the path"));
    let outside = Walk { from: 0.02, ..walk([0.0, 0.01], 0.1, 9) };
    assert!(refused(outside).starts_with("first value of the walk = 0.02 is not allowed"));
    let wrong = |_: f64| Ok(Inputs::unloaded(9));
    assert!(
        equilibrium.trace(wrong, &walk([0.0, 1.0], 0.1, 9)).unwrap_err().to_string().contains("ring forces")
    );
}
