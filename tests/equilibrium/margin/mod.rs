//! The stability margin beside that of an independent rod, whose unknowns are the strains themselves.

mod strain_rod;

use mcm::design::{Design, Specification, SpiralKind};
use mcm::equilibrium::{Equilibrium, Inputs, Interaction, Settings, Solution};
use mcm::manipulator::{Outcome, Scene};
use nalgebra::{DVector, Matrix3, Vector3};

use crate::tolerance::{MARGIN_BY_STRAINS, PUSHED_MARGIN, STATICS_LENGTH};
use strain_rod::StrainRod;

/// Pieces of constant strain in each core, or plain rod, in two resolutions, from which is extrapolated: they err by the square
/// of their length.
const IN_CORE: [usize; 2] = [6, 12];
const IN_ROD: [usize; 2] = [3, 6];

/// A value from those of both resolutions.
fn extrapolated<T: core::ops::Mul<f64, Output = T> + core::ops::Sub<Output = T>>(
    [coarse, fine]: [T; 2],
) -> T {
    fine * (4.0 / 3.0) - coarse * (1.0 / 3.0)
}

/// A device without local interaction, whose spirals are axisymmetric: its magnetisation lies on the centreline.
fn axisymmetric(segments: usize) -> Design {
    let mut specification = Specification::paper(segments);
    if let Specification::Segmented(segmented) = &mut specification {
        segmented.spiral = SpiralKind::Axisymmetric;
    }
    Design::new(specification).expect("allowed")
}

#[test]
fn margin_is_that_of_the_strains_themselves() {
    let across = |size: f64| Inputs { uniform_field: Vector3::new(0.0, size, 0.0), ..Inputs::unloaded(2) };
    let pulled = Inputs {
        tip_force: Vector3::new(0.004, 0.002, -0.006),
        field_gradient: [0.1, 0.3, 0.0, -0.2, 0.4],
        ..across(0.012)
    };
    // By two other Hessians of one segment in a field across it, to three digits.
    let published = [0.822, 0.714, 0.651, 0.610];
    let fields = [0.01, 0.02, 0.03, 0.04].map(across);
    let cases = fields.into_iter().zip(published.map(Some)).chain([(pulled, None)]);

    let design = axisymmetric(1);
    for (inputs, published) in cases {
        let settings = Settings {
            interaction: Interaction::None,
            degree: 6,
            fine_stations: true,
            ..Settings::default()
        };
        let mut model = Equilibrium::new(&design, None, settings, 2).expect("allowed");
        assert!(model.solve(&inputs).expect("finite inputs").solved());

        let [xx, xy, xz, yy, yz] = inputs.field_gradient;
        let gradient = Matrix3::new(xx, xy, xz, xy, yy, yz, xz, yz, -xx - yy);
        let found = IN_CORE.map(|count| {
            let field = |point: &Vector3<f64>| inputs.uniform_field + gradient * point;
            let mut rod = StrainRod::new(&design, 0.0, count, &field);
            rod.tip_force = inputs.tip_force;
            let strains = rod.solve(DVector::zeros(rod.size()));
            (rod.energy(&strains, 1.0).1, rod.margin(&strains, false))
        });
        let (tip, expected) = (extrapolated(found.map(|own| own.0)), extrapolated(found.map(|own| own.1)));

        let apart = (tip - model.tip().position).norm() / design.length();
        assert!(apart < 2.0 * STATICS_LENGTH, "{inputs:?}: tips {apart:e} apart");
        let got = model.margin().expect("stable");
        println!("margin {got:.6}, by strains {expected:.6}, published {published:?}");
        assert!((got - expected).abs() < MARGIN_BY_STRAINS, "{got} by the solver, {expected} by strains");
        assert!(published.is_none_or(|published| (got - published).abs() < 1e-3), "{got}, {published:?}");
    }
}

/// Degree, and so the number of unknowns, changes the margin only by what it changes in the shape.
#[test]
fn margin_does_not_depend_on_the_degree_at_bent_shapes() {
    let inputs = Inputs { uniform_field: Vector3::new(0.0, 0.01, -0.002), ..Inputs::unloaded(4) };
    let margins = [2, 4, 6].map(|degree| {
        let settings = Settings { interaction: Interaction::None, degree, ..Settings::default() };
        let mut model = Equilibrium::new(&axisymmetric(3), None, settings, 2).expect("allowed");
        assert!(model.solve(&inputs).expect("finite inputs").solved());
        model.margin().expect("stable")
    });
    println!("{margins:?}");
    assert!(
        margins.iter().all(|margin| (margin / margins[2] - 1.0).abs() < MARGIN_BY_STRAINS),
        "{margins:?}"
    );
}

/// The length of a shaft under a given push has no elastic energy of its own.
#[test]
fn length_of_a_pushed_shaft_is_condensed() {
    let text = "[design]\nkind = \"cylinder\"\nlength_mm = 10.0\nradius_mm = 0.75\nelastic_modulus_mpa = 1.0\npoisson = 0.45\n\
                remanence_t = 0.2\n[magnet]\nposition_mm = [0.0, -90.0, 25.0]\norientation_wxyz = [0.0, 1.0, 0.0, 0.0]\n\
                strength = 0.03\n[feed]\nmode = \"force\"\ninsertion_mm = 30.0\nforce_n = 0.0\n[feed.shaft]\n\
                outer_radius_mm = 0.75\ninner_radius_mm = 0.25\nelastic_modulus_mpa = 1.0\npoisson = 0.45\n[model]\n\
                interaction = \"none\"\ntime_budget_s = 60.0\n";
    let scene = Scene::parse(text, "pushed").expect("a scene");
    let mut device = scene.manipulator(2).expect("allowed");
    let solved = device.solve(&scene.inputs).expect("finite inputs").clone();
    assert_eq!((solved.outcome, solved.stable), (Outcome::Solved, Some(true)));
    let length = solved.feed_length.expect("a shaft");
    let got = device.measure_margin().stability_margin;
    assert!(
        (solved.stability_margin - got).abs() < MARGIN_BY_STRAINS,
        "{} told, {got} measured",
        solved.stability_margin
    );
    let held =
        Scene::parse(&text.replace("\"force\"", "\"insertion\"").replace("force_n = 0.0\n", ""), "held");
    let held = held.expect("a scene");
    let mut clamped = held.manipulator(2).expect("allowed");
    clamped.solve(&Inputs { insertion: length, ..held.inputs.clone() }).expect("finite inputs");
    let fixed = clamped.measure_margin().stability_margin;

    let design = scene.design().expect("a design");
    let model = Equilibrium::new(&design, &scene.sources, scene.settings, 2).expect("allowed");
    let field = |point: &Vector3<f64>| model.field_at(&scene.inputs, point).expect("outside the magnet");
    let found = IN_ROD.map(|count| {
        let rod = StrainRod::new(&design, length, count, &field);
        let strains = rod.solve(DVector::zeros(rod.size()));
        [rod.margin(&strains, true), rod.margin(&strains, false)]
    });
    let [expected, expected_fixed] = [0, 1].map(|own| extrapolated(found.map(|margins| margins[own])));
    println!(
        "length {length}: free {got:.6}, by strains {expected:.6}; fixed {fixed:.6}, by strains {expected_fixed:.6}"
    );
    assert!((got - expected).abs() < PUSHED_MARGIN, "{got} by the solver, {expected} by strains");
    assert!(
        (fixed - expected_fixed).abs() < PUSHED_MARGIN,
        "{fixed} by the solver, {expected_fixed} by strains"
    );
    assert!((expected - expected_fixed).abs() > 10.0 * PUSHED_MARGIN, "nothing is condensed");
}
