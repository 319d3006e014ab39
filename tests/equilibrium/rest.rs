//! The shape without any load: spirals beside rings bend it, and their arrangement says how far.

use core::f64::consts::PI;

use mcm::design::{Design, Helix, Segmented, Specification, SpiralKind, SpiralStart};
use mcm::equilibrium::{Interaction, Settings};
use mcm::geometry::{Pose, RotationVector};
use mcm::manipulator::{Inputs, Manipulator};
use nalgebra::Vector3;

use crate::tolerance::{LAW, REFLECTED_DEG, TURNED_SPIRALS, TWO_DECIMALS_DEG, assert_close};

fn chain(segments: usize, spiral: SpiralKind, start: SpiralStart) -> Segmented {
    Segmented { spiral, spiral_start: start, ..Segmented::paper(segments) }
}

fn degrees(angles: &[f64]) -> SpiralStart {
    SpiralStart::Each(angles.iter().map(|angle| angle.to_radians()).collect())
}

/// The tip under `full`, of inputs that `load` changes from none.
fn tip(chain: Segmented, load: impl FnOnce(&mut Inputs)) -> Pose {
    let design = Design::new(Specification::Segmented(chain)).expect("allowed");
    let mut inputs = Inputs::unloaded(design.rings().count());
    load(&mut inputs);
    let settings = Settings { interaction: Interaction::Full, ..Settings::default() };
    Manipulator::new(&design, None, settings, 2).expect("allowed").solve(&inputs).expect("finite").tip
}

/// Tip angle without loads, deg; from the sine, as the cosine of a small angle has few digits.
fn rest_angle(chain: Segmented) -> f64 {
    tip(chain, |_| ()).axis().cross(&Vector3::z()).norm().asin().to_degrees()
}

#[test]
fn spirals_turned_together_turn_the_shape() {
    const TURN: f64 = 0.9;
    let rotation = RotationVector::new(Vector3::z() * TURN).matrix();
    for kind in [SpiralKind::Helical, SpiralKind::Alternating] {
        let apart = [0.3, -1.2, 2.5];
        let own = tip(chain(3, kind, SpiralStart::Each(apart.to_vec())), |_| ());
        let turned = SpiralStart::Each(apart.map(|angle| angle + TURN).to_vec());
        let other = tip(chain(3, kind, turned), |_| ());
        let bent = own.position - Vector3::z() * own.position.z;
        let sideways = other.position - Vector3::z() * other.position.z;
        println!("{kind:?}: off by {:e}", (sideways - rotation * bent).norm() / bent.norm());
        assert_close(kind, sideways.as_slice(), (rotation * bent).as_slice(), TURNED_SPIRALS);
        assert_close(kind, &[other.position.z], &[own.position.z], TURNED_SPIRALS);
    }
}

/// Turning the spirals is turning the whole device where nothing else tells the directions apart: in a field, too.
#[test]
fn turned_spirals_are_a_turned_base() {
    const TURN: f64 = -2.0;
    let field = |inputs: &mut Inputs| inputs.uniform_field = Vector3::new(0.002, 0.006, 0.003);
    let spirals = tip(chain(2, SpiralKind::Helical, SpiralStart::Same(TURN)), field);
    let base = tip(chain(2, SpiralKind::Helical, SpiralStart::Same(0.0)), |inputs| {
        field(inputs);
        inputs.base.rotation = RotationVector::new(Vector3::z() * TURN).matrix();
    });
    assert_close("position", spirals.position.as_slice(), base.position.as_slice(), TURNED_SPIRALS);
    let (spirals, base) = (spirals.axis(), base.axis());
    assert_close("axis", spirals.as_slice(), base.as_slice(), TURNED_SPIRALS);
}

/// Two segments, the second of which is the first one's mirror image, turned: exchanging the turns exchanges base and tip.
#[test]
fn exchanged_turns_are_a_point_reflection() {
    for windings in [2.0, 2.3] {
        let device = |turns: [f64; 2]| {
            let helix = Helix { windings, ..Helix::paper() };
            let chain =
                Segmented { helix, ..chain(2, SpiralKind::Alternating, SpiralStart::Each(turns.to_vec())) };
            tip(chain, |_| ())
        };
        let (one, other) = (device([0.7, -1.1]), device([-1.1, 0.7]));
        let back = one.rotation.transpose();
        let expected = back * one.position;
        let off = |v: &Vector3<f64>| Vector3::new(v.x, v.y, 0.0);
        println!("off by {:e}", (other.position - expected).norm() / off(&expected).norm());
        assert_close(windings, off(&other.position).as_slice(), off(&expected).as_slice(), TURNED_SPIRALS);
        assert_close(windings, other.rotation.as_slice(), back.as_slice(), TURNED_SPIRALS);
    }
}

/// An even number of alternating segments is its own point reflection: tip and base are parallel, with all end rings or none.
#[test]
fn alternating_spirals_leave_no_angle_or_that_of_one_segment() {
    for (segments, rings, windings) in [(2, true, 2.0), (2, false, 2.0), (2, true, 2.3), (4, true, 2.0)] {
        let device = |spiral| Segmented {
            base_magnet: rings,
            tip_magnet: rings,
            helix: Helix { windings, ..Helix::paper() },
            ..chain(segments, spiral, SpiralStart::Same(0.4))
        };
        let (left, before) =
            (rest_angle(device(SpiralKind::Alternating)), rest_angle(device(SpiralKind::Helical)));
        println!(
            "{segments} segments, end rings {rings}, {windings} windings: {left:e} instead of {before} deg"
        );
        assert!(left <= REFLECTED_DEG && before > 100.0 * REFLECTED_DEG, "{left} instead of {before} deg");
    }
    let angle = |kind| rest_angle(chain(3, kind, SpiralStart::Same(0.0)));
    assert!((angle(SpiralKind::Helical) - 3.33).abs() <= TWO_DECIMALS_DEG, "an independent model's angle");
    assert!((angle(SpiralKind::Alternating) - 0.93).abs() <= TWO_DECIMALS_DEG);
}

#[test]
fn turned_spirals_cancel_in_pairs_and_threes() {
    let angle = |angles: &[f64]| rest_angle(chain(angles.len(), SpiralKind::Helical, degrees(angles)));
    assert!((angle(&[0.0, 0.0]) - 2.11).abs() <= TWO_DECIMALS_DEG);
    assert!((angle(&[0.0, 180.0]) - 0.07).abs() <= TWO_DECIMALS_DEG);
    assert!((angle(&[0.0, 240.0, 120.0]) - 0.04).abs() <= TWO_DECIMALS_DEG);
    assert!((angle(&[0.0, 120.0, 240.0]) - 0.24).abs() <= TWO_DECIMALS_DEG, "this order leaves more");
}

#[test]
fn spread_spirals_have_no_side() {
    let at_rest = |start| tip(chain(2, SpiralKind::Axisymmetric, start), |_| ());
    let (plain, turned) = (at_rest(SpiralStart::Same(0.0)), at_rest(SpiralStart::Each(vec![0.0, PI])));
    assert_eq!(plain, turned, "turning them means nothing");
    assert!((plain.axis() - Vector3::z()).norm() <= LAW, "{}", plain.axis());
}
