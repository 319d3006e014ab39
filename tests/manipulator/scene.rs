//! The scene file: units, defaults, refusals.
#![allow(clippy::float_cmp, reason = "what a file states arrives unrounded")]

use mcm::design::{CylinderMaterial, Modulus, Specification, SpiralKind, SpiralStart};
use mcm::equilibrium::Interaction;
use mcm::magnetics::Outline;
use mcm::manipulator::{Scene, SceneFile};
use proptest::prelude::*;

use super::refusals::refusal;

#[test]
fn example_of_the_documentation_is_read_in_si() {
    let scene = Scene::parse(
        r#"
        [design]
        segments = 3
        tip_magnet = false
        spiral = "axisymmetric"
        [design.helix]
        length_mm = 5
        boundary_angle_deg = 90.0
        [design.ring]
        recoil_permeability = 1.05
        [design.backbone]
        outer_radius_mm = 0.75
        inner_radius_mm = 0.25
        shore_a = 50.0
        poisson = 0.49
        [field]
        uniform_mt = [1.0, 20.0, 0]
        gradient_t_per_m = [1, 2, 3, 4, 5]
        [magnet]
        position_mm = [0.0, -100.0, 25.0]
        cylinders = [{ radius_mm = 10, length_mm = 20, remanence_t = 1.2 }]
        [load]
        tip_force_n = [0.001, 0, 0]
        ring_force_n = [[0, 0, 0], [0, 0, 0.5], [0, 0, 0]]
        [gravity]
        acceleration_m_s2 = [0, 0, -9.81]
        [model]
        interaction = "none"
        method = "potential"
        bending_stop = false
        "#,
        "test",
    )
    .unwrap();
    let Specification::Segmented(design) = &scene.specification else { panic!("not segmented") };
    assert_eq!((design.segments, design.base_magnet, design.tip_magnet), (3, true, false));
    assert_eq!(design.spiral, SpiralKind::Axisymmetric);
    assert_eq!(design.helix.length, 5e-3);
    assert_eq!(design.helix.boundary_angle, core::f64::consts::FRAC_PI_2);
    assert_eq!(design.helix.radius, 2e-3); // Table 1, not stated
    assert_eq!((design.ring.recoil_permeability, design.ring.remanence), (1.05, 1.35));
    assert_eq!(design.backbone.unwrap().modulus, Modulus::ShoreA(50.0));
    assert_eq!(scene.inputs.uniform_field.as_slice(), [0.001, 0.02, 0.0]);
    assert_eq!(scene.inputs.field_gradient, [1.0, 2.0, 3.0, 4.0, 5.0]);
    assert_eq!(scene.inputs.sources[0].pose.position.as_slice(), [0.0, -0.1, 0.025]);
    assert_eq!(scene.inputs.sources[0].strength, 1.0);
    assert_eq!(scene.inputs.ring_forces[1].z, 0.5);
    assert_eq!(scene.inputs.gravity.z, -9.81);
    let [part] = scene.sources.magnet().unwrap().parts() else { panic!("one cylinder") };
    let Outline::Cylinder(outline) = &part.outline else { panic!("a cylinder") };
    assert_eq!((outline.outer_radius(), part.centre.z), (0.01, 0.0));
    assert_eq!(scene.settings.interaction, Interaction::None);
}

#[test]
fn empty_scene_is_table_1_with_nine_segments_unloaded() {
    let scene = Scene::parse("", "test").unwrap();
    assert_eq!(scene.specification, Specification::paper(9));
    assert_eq!(scene.inputs, mcm::manipulator::Inputs::unloaded(10));
    assert!(scene.sources.list().is_empty());
    assert_eq!(scene.settings.interaction, Interaction::Auto);
}

#[test]
fn magnet_without_position_stands_below_the_middle() {
    let scene = Scene::parse("[magnet]", "test").unwrap();
    let length = scene.design().unwrap().length();
    assert_eq!(scene.inputs.sources[0].pose.position.as_slice(), [0.0, -0.12, length / 2.0]);
    assert_eq!(scene.inputs.sources[0].pose.axis().as_slice(), [0.0, 0.0, -1.0]);
    assert_eq!(scene.sources.magnet().unwrap().parts().len(), 2);
}

#[test]
fn plain_cylinder_of_composite_or_bulk() {
    let composite = Scene::parse(
        "[design]\nkind = \"cylinder\"\nlength_mm = 40\nradius_mm = 2\nvolume_fraction = 0.2",
        "test",
    );
    let Specification::Cylinder(rod) = composite.unwrap().specification else { panic!("not a cylinder") };
    assert_eq!((rod.length, rod.radius, rod.inner_radius), (0.04, 0.002, 0.0));
    let CylinderMaterial::Composite { shore_a, volume_fraction, .. } = rod.material else {
        panic!("not a composite")
    };
    assert_eq!((shore_a, volume_fraction), (33.0, 0.2));

    let bulk = Scene::parse(
        "[design]\nkind = \"cylinder\"\nlength_mm = 40\nradius_mm = 2\nelastic_modulus_mpa = 1.5\nremanence_t = 0.1",
        "test",
    );
    let Specification::Cylinder(rod) = bulk.unwrap().specification else { panic!("not a cylinder") };
    assert_eq!(rod.material, CylinderMaterial::Bulk { elastic_modulus: 1.5e6, poisson: 0.4, remanence: 0.1 });
}

#[test]
fn one_number_is_replaced_by_its_path() {
    let file = SceneFile::parse("[magnet]\nposition_mm = [1, 2, 3]", "test").unwrap();
    let moved = file.with("magnet.position_mm[2]", -90.0).unwrap().scene().unwrap();
    assert_eq!(moved.inputs.sources[0].pose.position.as_slice(), [0.001, -0.09, 0.003]);
    let shorter = file.with("design.segments", 4.0).unwrap();
    assert_eq!(shorter.scene().unwrap().inputs.ring_forces.len(), 5);
    let force = file.with("load.ring_force_n[10][3]", 0.5).unwrap().scene().unwrap();
    assert_eq!(force.inputs.ring_forces[9].z, 0.5);
    for (key, value, expected) in [
        ("field.uniform_mt", 1.0, "`field.uniform_mt` holds no number"),
        ("field.uniform", 1.0, "unknown key `field.uniform`; did you mean `uniform_mt`?"),
        ("field.uniform_mt[0]", 1.0, "no entry `field.uniform_mt[0]`: indices go from 1 to 3 there"),
        ("field.uniform_mt[4]", 1.0, "no entry `field.uniform_mt[4]`: indices go from 1 to 3 there"),
        ("magnet.strength.x", 1.0, "unknown key `magnet.strength.x`: `x` is not in a table"),
        ("design.segments", 1.5, "design.segments = 1.5 is not allowed: it must be a whole number"),
        ("magnet.strength", f64::NAN, "magnet.strength = NaN is not allowed: it must be finite"),
    ] {
        assert_eq!(file.with(key, value).unwrap_err().to_string(), expected);
    }
}

#[test]
fn spirals_are_turned_by_one_angle_or_a_list() {
    let start = |file: &SceneFile| match file.scene().unwrap().specification {
        Specification::Segmented(chain) => (chain.spiral, chain.spiral_start),
        _ => panic!("segments"),
    };
    let radians = |angles: &[f64]| SpiralStart::Each(angles.iter().map(|angle| angle.to_radians()).collect());
    let parse = |rows: &str| SceneFile::parse(&format!("[design]\nsegments = 3\n{rows}"), "test").unwrap();
    let plain = parse("");
    assert_eq!(start(&plain), (SpiralKind::Helical, SpiralStart::Same(0.0)));
    let one = parse("spiral = \"alternating\"\nspiral_start_deg = 90");
    assert_eq!(start(&one), (SpiralKind::Alternating, SpiralStart::Same(90_f64.to_radians())));
    let list = parse("spiral_start_deg = [0, 240.0, -120]");
    assert_eq!(start(&list).1, radians(&[0.0, 240.0, -120.0]));
    for file in [&plain, &one, &list] {
        assert_eq!(&SceneFile::parse(&file.to_toml().unwrap(), "again").unwrap(), file);
    }
    // A number of the list is replaced; one number for all becomes a list when one of it is named.
    assert_eq!(
        start(&list.with("design.spiral_start_deg[2]", 60.0).unwrap()).1,
        radians(&[0.0, 60.0, -120.0])
    );
    assert_eq!(start(&one.with("design.spiral_start_deg[3]", 60.0).unwrap()).1, radians(&[90.0, 90.0, 60.0]));
    let turned = start(&plain.with("design.spiral_start_deg", 60.0).unwrap()).1;
    assert_eq!(turned, SpiralStart::Same(60_f64.to_radians()));
    for (file, key, expected) in [
        (
            &plain,
            "design.spiral_start_deg[4]",
            "no entry `design.spiral_start_deg[4]`: indices go from 1 to 3 there",
        ),
        (&list, "design.spiral_start_deg", "`design.spiral_start_deg` holds no number"),
    ] {
        assert_eq!(file.with(key, 1.0).unwrap_err().to_string(), expected);
    }
    let refused = list.with("design.segments", 4.0).unwrap().scene().unwrap_err().to_string();
    assert_eq!(refused, "design.spiral_start_deg has 3 entries, expected 4, one for each segment");
}

#[test]
fn field_magnet_and_base_are_turned() {
    let scene = Scene::parse(
        "[field]\nuniform_mt = [0, 0, 20]\nturn_deg = 30\n[magnet]\nposition_mm = [1, 2, 3]\nturn_deg = -90\n\
         turn_axis = [0, 0, 7]\norientation_wxyz = [0.5, 0.5, 0.5, 0.5]\n[base]\nturn_deg = 90\nturn_axis = [0, 1, 0]",
        "test",
    )
    .unwrap();
    let close = |got: &nalgebra::Vector3<f64>, expected: [f64; 3]| {
        assert!((got - nalgebra::Vector3::from(expected)).norm() < 1e-15, "{got}, expected {expected:?}");
    };
    // From +z towards +y unless another axis is given.
    close(&scene.inputs.uniform_field, [0.0, 0.01, 0.02 * 0.75_f64.sqrt()]);
    // The quaternion takes z to x, the turn about z takes x to -y; the position stays.
    close(&scene.inputs.sources[0].pose.axis(), [0.0, -1.0, 0.0]);
    close(&scene.inputs.sources[0].pose.position, [0.001, 0.002, 0.003]);
    close(&scene.inputs.base.axis(), [1.0, 0.0, 0.0]);
    assert_eq!(
        refusal("[field]\nturn_axis = [0, 0, 0]"),
        "test, line 2: length of field.turn_axis = 0 is not allowed: it must be > 0"
    );
    assert_eq!(
        refusal("[base]\nturn_degrees = 3"),
        "test, line 2: unknown key `base.turn_degrees`; did you mean `turn_deg`?"
    );
}

proptest! {
    /// Writing a scene and reading it again changes no bit.
    #[test]
    fn written_text_reads_back_the_same(
        field in proptest::array::uniform3(-1e3..1e3f64),
        position in proptest::array::uniform3(-1e3..1e3f64),
        length in 3.0..1e3f64,
        segments in 1usize..12,
    ) {
        let text = format!(
            "[design]\nsegments = {segments}\n[design.helix]\nlength_mm = {length:?}\n\
             [field]\nuniform_mt = {field:?}\n[magnet]\nposition_mm = {position:?}\n"
        );
        let file = SceneFile::parse(&text, "test").unwrap();
        let again = SceneFile::parse(&file.to_toml().unwrap(), "again").unwrap();
        prop_assert_eq!(&file, &again);
        prop_assert_eq!(file.scene().unwrap(), again.scene().unwrap());
    }
}
