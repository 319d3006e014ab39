//! Bent shapes of scenes that are symmetric about the axis of the clamp are neutral: they turn about it freely.

use mcm::manipulator::{Outcome, Outputs, Scene};
use nalgebra::{UnitQuaternion, Vector3};

use crate::tolerance::{SAME_ENERGY_TURNED, STATICS_ANGLE_DEG};

/// What acts against the magnetisation, along the axis.
#[derive(Debug, Clone, Copy)]
enum Against {
    Field,
    Magnet,
    Coil,
}

/// A device whose base is turned by `base`, in a field along its axis that is strong enough to bend it.
fn symmetric(segments: usize, level: &str, against: Against, base: UnitQuaternion<f64>) -> String {
    let list = |v: Vector3<f64>| {
        let v = base * v;
        format!("[{:?}, {:?}, {:?}]", v.x, v.y, v.z)
    };
    let orientation = format!("orientation_wxyz = [{:?}, {:?}, {:?}, {:?}]", base.w, base.i, base.j, base.k);
    let source = match against {
        Against::Field => {
            let size = 45.0 * (segments as f64).powf(-1.45);
            format!("[field]\nuniform_mt = {}\n", list(Vector3::z() * -size))
        }
        Against::Magnet => {
            let strength = [-1.0, -0.5, -0.32][segments - 1];
            let place = list(Vector3::z() * -80.0);
            format!("[magnet]\nposition_mm = {place}\n{orientation}\nstrength = {strength:?}\n")
        }
        Against::Coil => format!(
            "[[coil]]\nposition_mm = {}\n{orientation}\ninner_radius_mm = 60\nouter_radius_mm = 80\nlength_mm = 120\n\
             turns = 1000\ncurrent_a = {:?}\n",
            list(Vector3::z() * 3.0 * segments as f64),
            -5.6 * (segments as f64).powf(-1.4),
        ),
    };
    format!(
        "[design]\nsegments = {segments}\nspiral = \"axisymmetric\"\n[model]\ninteraction = \"{level}\"\ntime_budget_s = 60\n\
         [base]\n{orientation}\n{source}"
    )
}

fn solved(text: &str) -> Outputs {
    let scene = Scene::parse(text, "symmetric").expect("a scene");
    let mut device = scene.manipulator(2).expect("allowed");
    device.solve(&scene.inputs).expect("finite inputs");
    device.measure_margin().clone()
}

#[test]
fn bent_shapes_of_symmetric_scenes_are_neutral() {
    let tilted = UnitQuaternion::from_scaled_axis(Vector3::new(0.66, 0.0, 0.88));
    let mut count = 0;
    for (segments, level) in [(1, "none"), (2, "none"), (3, "none"), (1, "auto"), (2, "auto"), (3, "auto")] {
        for against in [Against::Field, Against::Magnet, Against::Coil] {
            for base in [UnitQuaternion::identity(), tilted] {
                let out = solved(&symmetric(segments, level, against, base));
                let case = format!("{segments} {level} {against:?} {base}: {out:?}");
                assert!(out.tip_angle.to_degrees() > 30.0, "{case}");
                assert_eq!((out.outcome, out.stable), (Outcome::Neutral, Some(false)), "{case}");
                assert!(out.stability_margin == 0.0, "{case}");
                count += 1;
            }
        }
    }
    assert_eq!(count, 36);
}

/// What the structure of a scene says of its symmetry, the energies say too.
#[test]
fn a_neutral_shape_is_as_good_when_its_clamp_is_rolled() {
    let [first, rolled] = [0.0, 0.54].map(|roll| {
        let base = UnitQuaternion::from_axis_angle(&Vector3::z_axis(), roll);
        solved(&symmetric(2, "auto", Against::Magnet, base))
    });
    assert_eq!((first.outcome, rolled.outcome), (Outcome::Neutral, Outcome::Neutral));
    let change = (first.energy / rolled.energy - 1.0).abs();
    let turned = (first.tip_angle - rolled.tip_angle).to_degrees().abs();
    assert!(change < SAME_ENERGY_TURNED && turned < STATICS_ANGLE_DEG, "{change:e}, {turned:e} deg");
}

/// A slight asymmetry of any kind decides where the shape settles.
#[test]
fn an_asymmetry_is_no_longer_neutral() {
    let text = symmetric(1, "none", Against::Magnet, UnitQuaternion::identity());
    assert_eq!(solved(&text).outcome, Outcome::Neutral);
    let moved = text.replace("position_mm = [0.0, 0.0, -80.0]", "position_mm = [0.001, 0.0, -80.0]");
    assert_ne!(moved, text);
    for asymmetric in [
        moved,
        format!("{text}[field]\nuniform_mt = [0.001, 0.0, 0.0]\n"),
        format!("{text}[field]\ngradient_t_per_m = [0.001, 0.0, 0.0, 0.0, 0.0]\n"),
        format!("{text}[load]\ntip_force_n = [1e-6, 0.0, 0.0]\n"),
        format!("{text}[gravity]\nacceleration_m_s2 = [0.1, 0.0, 0.0]\n"),
        text.replace("\"axisymmetric\"", "\"helical\""),
    ] {
        let out = solved(&asymmetric);
        assert_eq!((out.outcome, out.stable), (Outcome::Solved, Some(true)), "{asymmetric}: {out:?}");
        assert!(out.stability_margin > 0.0, "{asymmetric}: {out:?}");
    }
}

/// Loads along the axis, and a straight tube about it, leave the turn free.
#[test]
fn loads_along_the_axis_and_a_coaxial_tube_leave_it_free() {
    let text = symmetric(1, "none", Against::Field, UnitQuaternion::identity());
    let loaded = format!(
        "{text}gradient_t_per_m = [-0.1, 0.0, 0.0, -0.1, 0.0]\n[load]\ntip_force_n = [0.0, 0.0, -0.001]\n[gravity]\n\
         acceleration_m_s2 = [0.0, 0.0, -9.81]\n"
    );
    assert_eq!(solved(&loaded).outcome, Outcome::Neutral);
    let tube = |x: f64, radius: f64| {
        format!(
            "{text}[vessel]\n[[vessel.branch]]\nname = \"tube\"\npoints_mm = [[{x:?}, 0.0, -20.0], [{x:?}, 0.0, 40.0]]\n\
             radius_mm = {radius:?}\n"
        )
    };
    let coaxial = solved(&tube(0.0, 3.0));
    assert!(coaxial.wall.as_ref().is_some_and(|wall| wall.count > 0), "no contact: {coaxial:?}");
    assert_eq!(coaxial.outcome, Outcome::Neutral, "{coaxial:?}");
    let aside = solved(&tube(0.4, 3.5));
    assert_eq!((aside.outcome, aside.stable), (Outcome::Solved, Some(true)), "{aside:?}");
}
