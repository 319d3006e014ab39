//! Fig. 7C: forces on devices held straight.

use mcm::design::{Design, Helix, Segmented, Specification};
use mcm::equilibrium::{Interaction, Settings};
use mcm::geometry::Pose;
use mcm::magnetics::{AxialMagnet, Cylinders, Source};
use mcm::manipulator::{Inputs, Manipulator, PlacedSource};
use mcm::studies::fig7c;

use super::{column, number, row, row_with};
use crate::tolerance::{HELD, PRINTED_THREE_DECIMALS, SAME_SHAPE_OF_MAGNETISATION, assert_close};

#[test]
fn forces_are_those_on_a_manipulator_too_stiff_to_bend() {
    // Gent's relation diverges at Shore A 100: this is 2e15 Pa. The solver's forces come from energies at a few points.
    let helix = Helix { shore_a: 99.999_999_9, ..Helix::paper() };
    let design = Design::new(Specification::Segmented(Segmented { helix, ..Segmented::paper(9) })).unwrap();
    let magnet =
        |offset| AxialMagnet { radius: 22.5e-3, inner_radius: 0.0, length: 30e-3, offset, remanence: 1.35 };
    let pair = Source::from(Cylinders::new(vec![magnet(-20e-3), magnet(20e-3)]).unwrap());
    let settings = Settings { interaction: Interaction::None, pair_accuracy: 1e-10, ..Settings::default() };
    let study = fig7c().unwrap();
    for offset in [-70, -40, 0, 10, 40] {
        let mut inputs = Inputs::unloaded(10);
        let along = 23e-3 + f64::from(offset) * 1e-3;
        let pose = Pose::new([0.0, -62.5e-3, along], [0.0, 1.0, 0.0, 0.0]).unwrap();
        inputs.sources = vec![PlacedSource { pose, strength: 1.0 }];
        let mut stiff = Manipulator::new(&design, Some(&pair), settings, 2).unwrap();
        let force = stiff.solve(&inputs).unwrap().magnetic_force;
        let index = row_with(&study, "offset_mm", f64::from(offset));
        let held = |name: &str| column(&study, name)[index];
        let got = [held("axial_force_manipulator_n"), held("attraction_manipulator_n")];
        assert_close(offset, &got, &[force.z, -force.y], HELD);
    }
}

#[test]
fn largest_forces_are_those_of_an_independent_sum() {
    let study = fig7c().unwrap();
    for (quantity, newtons) in
        [("largest axial force on nine segments", 0.103), ("largest attraction of nine segments", 0.146)]
    {
        let got = number(&row(&study, quantity).exact);
        assert!((got - newtons).abs() <= PRINTED_THREE_DECIMALS, "{quantity}: {got}");
    }
}

#[test]
fn force_goes_with_the_moment_and_not_with_the_papers_relative_moment() {
    let study = fig7c().unwrap();
    let largest =
        |device: &str| column(&study, &format!("axial_force_{device}_n")).iter().copied().fold(0.0, f64::max);
    // Rings and helices: 10 rings of pi (4 - 0.5625) mm3 at 1.35 T, 9 helices of 29.61 mm3 at 0.25 T; a solid cylinder
    // of 46 mm at 0.2 T.
    let ring = core::f64::consts::PI * 3.4375;
    let moments = (10.0 * ring * 1.35 + 9.0 * 29.61 * 0.25) / (core::f64::consts::PI * 4.0 * 46.0 * 0.2);
    assert_close(
        "ratio",
        &[largest("manipulator") / largest("cylinder")],
        &[moments],
        SAME_SHAPE_OF_MAGNETISATION,
    );
}
