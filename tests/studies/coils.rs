//! What eight coils reach.

use mcm::manipulator::Scene;
use mcm::studies::{Value, coils};
use nalgebra::Vector3;

use super::{column, row};

#[test]
fn what_is_reached_is_what_the_fields_of_the_coils_add_up_to() {
    let study = coils().unwrap();
    let Value::Range(least, most) = row(&study, "field of eight coils").exact else { panic!("a range") };
    let fields = column(&study, "field_x_mt");
    assert_eq!(fields[6].to_bits(), least.to_bits(), "the middle is in both");
    // The coils mirror one another in x = 0.
    for k in 0..6 {
        assert!((fields[k] / fields[12 - k] - 1.0).abs() < 0.02, "{fields:?}");
    }
    // Across the four horizontal coils, in the direction x: the currents by the normal equations, and a field that they make.
    let scene = Scene::parse(include_str!("../../fmu/examples/eight_coils.toml"), "coils").unwrap();
    let sources = scene.sources;
    let of_one_ampere: Vec<Vector3<f64>> = sources
        .list()
        .iter()
        .zip(&scene.inputs.sources)
        .map(|(coil, placed)| {
            let local = placed.pose.rotation.tr_mul(&-placed.pose.position);
            placed.pose.rotation * coil.field(&local).unwrap()
        })
        .collect();
    let gram: nalgebra::Matrix3<f64> = of_one_ampere.iter().map(|b| b * b.transpose()).sum();
    let multiplier = gram.try_inverse().unwrap() * Vector3::x();
    let currents: Vec<f64> = of_one_ampere.iter().map(|b| b.dot(&multiplier)).collect();
    let largest = currents.iter().fold(0.0_f64, |most, current| most.max(current.abs()));
    let made: Vector3<f64> = of_one_ampere.iter().zip(&currents).map(|(b, current)| b * *current).sum();
    assert!((made - Vector3::x()).norm() < 1e-12);
    let along_x = 1e3 * 10.0 / largest;
    assert!(least - 1e-9 <= along_x && along_x <= most + 1e-9, "{least} {along_x} {most}");
    // No currents within the limit make more than all coils at the limit.
    let all: f64 = of_one_ampere.iter().map(|b| 1e4 * b.norm()).sum();
    assert!(0.0 < least && most < all, "{least} {most} {all}");
}
