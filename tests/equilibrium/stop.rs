//! The bending stop: windings that touch make a core as stiff as its closed section.

use core::f64::consts::PI;

use mcm::design::{Design, SpanKind, Specification};
use mcm::equilibrium::{Equilibrium, Inputs, Interaction, Report, Settings, Solution};
use nalgebra::{Rotation3, Vector3};

use crate::tolerance::{BEND, KEPT_MARGIN, PAPER_STOP_DEG, ROUNDING, assert_close};

/// The paper's segments without base ring, boundary angle 40 deg.
fn design(segments: usize) -> Design {
    Design::new(Specification::paper(segments)).expect("the paper's design is allowed")
}

fn manipulator(segments: usize, interaction: Interaction, bending_stop: bool) -> Equilibrium {
    let settings = Settings { interaction, bending_stop: Some(bending_stop), ..Settings::default() };
    Equilibrium::new(&design(segments), None, settings, 2).expect("default settings")
}

/// The first core's length, bending stiffness, boundary angle, and bending stiffness once closed.
fn core(design: &Design) -> (f64, f64, f64, f64) {
    let spans = &design.segments()[0].spans;
    let core = spans.iter().find(|span| span.kind == SpanKind::Core).expect("a core");
    let spiral = core.spiral.expect("windings");
    (core.length, core.stiffness.bending, spiral.boundary_angle, spiral.closed_bending)
}

fn moment(about: Vector3<f64>) -> Inputs {
    Inputs { tip_moment: about, ..Inputs::unloaded(2) }
}

fn solve(equilibrium: &mut Equilibrium, inputs: &Inputs) -> Report {
    let report = equilibrium.solve(inputs).expect("finite inputs");
    assert!(report.solved(), "{report:?}");
    report
}

/// A field (T) turned from along the manipulator by `angle` (deg) about x.
fn turned(segments: usize, field: f64, angle: f64) -> Inputs {
    let uniform_field =
        Rotation3::from_axis_angle(&Vector3::x_axis(), angle.to_radians()) * Vector3::new(0.0, 0.0, field);
    Inputs { uniform_field, ..Inputs::unloaded(segments + 1) }
}

/// Angle (deg) between the tip's and the base's `d3`.
fn tip_angle(equilibrium: &Equilibrium) -> f64 {
    equilibrium.tip().rotation[(2, 2)].clamp(-1.0, 1.0).acos().to_degrees()
}

#[test]
fn the_closed_section_is_an_annulus_from_bore_to_outer_radius() {
    let design = design(1);
    let (_, _, angle, closed) = core(&design);
    let Specification::Segmented(paper) = Specification::paper(1) else { unreachable!() };
    let helix = paper.helix;
    let section = PI / 4.0 * (helix.radius.powi(4) - helix.core_inner_radius.powi(4));
    let elastic = 3.325_09e6; // Richter et al., Table 1 by Eq. 14, 15
    assert_close("closed bending stiffness", &[closed], &[elastic * section], crate::tolerance::PRINTED);
    assert_close("boundary angle", &[angle], &[40_f64.to_radians()], ROUNDING);
}

#[test]
fn a_pure_moment_bends_the_closed_core_along_its_second_slope() {
    // The moment is the same everywhere, so that `EI theta / L` and the stop's moment simply add up.
    let design = design(1);
    let (length, bending, boundary, closed) = core(&design);
    let added = closed - bending;
    for direction in [0.0_f64, 1.0, 2.5, 4.0] {
        let axis = Vector3::new(direction.cos(), direction.sin(), 0.0);
        let mut equilibrium = manipulator(1, Interaction::None, true);
        for beyond in [1.06, 1.2, 1.5] {
            let theta = beyond * boundary;
            let size = (bending * theta + added * (theta - boundary)) / length;
            solve(&mut equilibrium, &moment(axis * size));
            let angle = equilibrium.core_angles().next().expect("a core");
            assert_close(format!("{beyond} of the boundary angle"), &[angle], &[theta], BEND);
        }
    }
}

#[test]
fn an_open_core_does_not_know_its_stop() {
    let (_, _, boundary, _) = core(&design(3));
    for interaction in [Interaction::None, Interaction::Rings] {
        let mut with = manipulator(3, interaction, true);
        let mut without = manipulator(3, interaction, false);
        for field in [0.002, 0.005, 0.008] {
            let inputs = turned(3, field, 90.0);
            solve(&mut with, &inputs);
            solve(&mut without, &inputs);
            assert!(with.core_angles().all(|angle| angle < 0.95 * boundary));
            let name = format!("{interaction:?} at {field} T");
            assert_close(&name, with.tip().position.as_slice(), without.tip().position.as_slice(), BEND);
        }
    }
}

#[test]
fn three_segments_in_a_turned_field_stop_near_120_degrees() {
    // The device stopped at 119 deg (Richter et al., Fig. 7B); three boundary angles are 120 deg.
    for interaction in [Interaction::None, Interaction::Rings, Interaction::Full] {
        let mut equilibrium = manipulator(3, interaction, true);
        for angle in 0..=17 {
            let report = solve(&mut equilibrium, &turned(3, 0.02, 10.0 * f64::from(angle)));
            assert!(report.snaps == 0 && report.stable == Some(true), "{interaction:?}: {report:?}");
        }
        let tip = tip_angle(&equilibrium);
        let cores: Vec<f64> = equilibrium.core_angles().map(f64::to_degrees).collect();
        println!("{interaction:?}: tip {tip:.2} deg, cores {cores:.2?}");
        assert!((tip - 119.0).abs() < PAPER_STOP_DEG, "{interaction:?}: stops at {tip} deg");
        assert!(cores.iter().all(|core| *core < 43.0), "{interaction:?}: cores bend by {cores:?} deg");
    }
}

#[test]
fn a_field_turned_past_the_antiparallel_turns_the_manipulator_over() {
    // At 180 deg it may turn freely about the field; past it, the other side is downhill.
    for interaction in [Interaction::None, Interaction::Rings] {
        let mut equilibrium = manipulator(3, interaction, true);
        let mut reports = Vec::new();
        for angle in [90.0, 150.0, 180.0, 190.0, 210.0] {
            let report = solve(&mut equilibrium, &turned(3, 0.02, angle));
            let side = equilibrium.tip().rotation[(1, 2)];
            reports.push((report.stable, report.snaps, side > 0.0));
        }
        let (held, free) = ((Some(true), 0, false), (Some(false), 0, false));
        let over = [(Some(true), 1, true), (Some(true), 0, true)];
        assert_eq!(reports, [held, held, free, over[0], over[1]], "{interaction:?}");
        let back = tip_angle(&equilibrium);
        let mut direct = manipulator(3, interaction, true);
        for angle in [90.0, 120.0, 150.0] {
            solve(&mut direct, &turned(3, 0.02, angle));
        }
        assert_close("mirrored", &[back], &[tip_angle(&direct)], BEND);
    }
}

#[test]
fn the_stop_keeps_the_attraction_from_ending_in_a_snap() {
    // Without it one segment snaps at 35.83 mT (`full`).
    let mut equilibrium = manipulator(1, Interaction::Full, true);
    for field in 1..=30 {
        let report = solve(&mut equilibrium, &turned(1, 0.002 * f64::from(field), 90.0));
        assert!(report.snaps == 0 && report.stable == Some(true), "{report:?}");
    }
    println!("60 mT: {:.2} deg", tip_angle(&equilibrium));
}

#[test]
fn the_margin_follows_windings_that_close() {
    // Attraction nearly ends in a snap before the windings close and make the softest mode stiff. Steps are so short that
    // the factorisation would be kept, but for their stiffness.
    let Specification::Segmented(mut paper) = Specification::paper(1) else { unreachable!() };
    paper.helix.boundary_angle = 77_f64.to_radians();
    let design = Design::new(Specification::Segmented(paper)).expect("allowed");
    let settings =
        Settings { interaction: Interaction::Full, bending_stop: Some(true), ..Settings::default() };
    let manipulator = || Equilibrium::new(&design, None, settings, 2).expect("default settings");
    let (mut short, mut worst, mut told) = (manipulator(), 0.0_f64, Vec::new());
    for step in 0..=1500 {
        let inputs = turned(1, 0.043 + 4e-6 * f64::from(step), 90.0);
        let margin = solve(&mut short, &inputs).margin;
        if step % 50 == 0 {
            let mut long = manipulator();
            solve(&mut long, &turned(1, 0.042, 90.0));
            let own = solve(&mut long, &inputs).margin;
            worst = worst.max((margin / own - 1.0).abs());
            told.push(own);
        }
    }
    let (least, last) = (told.iter().copied().fold(1.0, f64::min), told[told.len() - 1]);
    println!("margin {:.3}, {least:.3}, {last:.3}: told within {worst:.1e}", told[0]);
    assert!(least < 0.6 * told[0] && last > 2.0 * least, "the windings do not matter: {told:?}");
    assert!(worst <= KEPT_MARGIN, "told within {worst:e}");
}
