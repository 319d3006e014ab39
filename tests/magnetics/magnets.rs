//! Magnets of every shape and direction against values of high precision, and against one another.

use core::f64::consts::PI;
use std::collections::BTreeMap;

use mcm::geometry::{Pose, RotationVector};
use mcm::magnetics::{AxialMagnet, Cuboid, Cylinders, Jet, ObliqueCylinder, Source, Sphere, Wrench};
use nalgebra::{Matrix3, Vector3};

use crate::tolerance::{MAGNET_FIELD, MAGNET_GRADIENT, MAGNET_HESSIAN, NEAR_MAGNET_EDGE};

/// Rows of a table of fields: the magnet, where the point is, its coordinates, and the numbers there.
fn rows(text: &str) -> Vec<(String, String, Vector3<f64>, Vec<f64>)> {
    let mut lines = text.lines();
    assert!(lines.next().is_some_and(|head| head.starts_with("magnet,where,x,y,z,Bx")));
    let rows: Vec<_> = lines
        .map(|line| {
            let mut cells = line.split(',').map(str::to_owned);
            let (magnet, place) = (cells.next().unwrap(), cells.next().unwrap());
            let numbers: Vec<f64> = cells.map(|cell| cell.parse().unwrap()).collect();
            (magnet, place, Vector3::new(numbers[0], numbers[1], numbers[2]), numbers[3..].to_vec())
        })
        .collect();
    assert!(rows.len() > 100);
    rows
}

fn cylinder([inner, outer, length]: [f64; 3], b: [f64; 3]) -> Source {
    ObliqueCylinder::new([inner, outer], length, b.into()).unwrap().into()
}

fn cuboid(size: [f64; 3], b: [f64; 3]) -> Source {
    Cuboid::new(size.into(), b.into()).unwrap().into()
}

/// The magnets of `tests/bench/magnet_field.py`.
fn magnet(name: &str) -> Source {
    match name {
        "cube" => cuboid([0.01; 3], [0.0, 0.0, 1.45]),
        "bar" => cuboid([0.005, 0.012, 0.02], [0.4, -0.6, 1.2]),
        "plate" => cuboid([0.04, 0.03, 0.002], [0.0, 0.0, 1.3]),
        "cylinder" => cylinder([0.0, 0.0225, 0.03], [1.35, 0.0, 0.0]),
        "disc" => cylinder([0.0, 0.02, 0.002], [0.6, 0.5, -0.9]),
        "rod" => cylinder([0.0, 0.002, 0.02], [0.0, 1.2, 0.3]),
        "ring" => cylinder([0.01, 0.03, 0.015], [0.7, -0.3, 1.0]),
        other => panic!("no magnet {other}"),
    }
}

/// Relative errors of field, gradient and second derivative.
fn errors(jet: &Jet, [field, gradient, hessian]: [&[f64]; 3]) -> [f64; 3] {
    let norm = |values: &mut dyn Iterator<Item = f64>| values.map(|v| v * v).sum::<f64>().sqrt();
    let relative = |got: &[f64], expected: &[f64]| {
        assert_eq!(got.len(), expected.len());
        norm(&mut got.iter().zip(expected).map(|(a, b)| a - b)) / norm(&mut expected.iter().copied())
    };
    let g = &jet.gradient;
    let six = [g[(0, 0)], g[(0, 1)], g[(0, 2)], g[(1, 1)], g[(1, 2)], g[(2, 2)]];
    [relative(jet.field.as_slice(), field), relative(&six, gradient), relative(&jet.hessian.0, hessian)]
}

#[test]
fn every_shape_has_the_field_of_high_precision() {
    let mut worst: BTreeMap<(String, String), [f64; 3]> = BTreeMap::new();
    let table = rows(include_str!("magnets.csv"));
    for (name, place, point, numbers) in &table {
        let source = magnet(name);
        let jet = source.jet(point).unwrap();
        let found = errors(&jet, [&numbers[..3], &numbers[3..9], &numbers[9..19]]);
        let entry = worst.entry((name.clone(), place.clone())).or_default();
        *entry = core::array::from_fn(|i| entry[i].max(found[i]));
    }
    for ((name, place), found) in &worst {
        println!("{name} {place} {:.1e} {:.1e} {:.1e}", found[0], found[1], found[2]);
    }
    for ((name, place), found) in worst {
        let allowed = if place == "edge" || place == "face" {
            [NEAR_MAGNET_EDGE; 3]
        } else {
            [MAGNET_FIELD, MAGNET_GRADIENT, MAGNET_HESSIAN]
        };
        for (found, allowed) in found.into_iter().zip(allowed) {
            assert!(found <= allowed, "{name} {place}: {found:e} > {allowed:e}");
        }
    }
}

#[test]
fn batches_agree_with_single_points() {
    let table = rows(include_str!("magnets.csv"));
    let mut names: Vec<&String> = table.iter().map(|row| &row.0).collect();
    names.dedup();
    for name in names {
        let source = magnet(name);
        let points: Vec<_> = table.iter().filter(|row| row.0 == *name).map(|row| row.2).collect();
        let mut jets = vec![Jet::zero(); points.len()];
        source.jets(&points, &mut jets).unwrap();
        let mut fields = vec![Vector3::zeros(); points.len()];
        source.fields(&points, &mut fields).unwrap();
        for ((point, jet), field) in points.iter().zip(&jets).zip(&fields) {
            let single = source.jet(point).unwrap();
            let close = |a: f64, b: f64| a <= 1e-11 * b;
            assert!(close((jet.field - single.field).norm(), single.field.norm()), "{name} {point}");
            assert!(close((field - single.field).norm(), single.field.norm()), "{name} {point}");
            assert!(close((jet.gradient - single.gradient).norm(), single.gradient.norm()), "{name} {point}");
            let norm = |jet: &Jet| jet.hessian.0.iter().map(|v| v * v).sum::<f64>().sqrt();
            assert!(close(norm(&(*jet + single * -1.0)), norm(&single)), "{name} {point}");
        }
    }
}

#[test]
fn the_shared_reference_agrees() {
    let table = rows(include_str!("../reference/magnets_field_dev.csv"));
    let direction = |name: &str| match name.rsplit('_').next().unwrap() {
        "x" => Vector3::x(),
        "y" => Vector3::y(),
        "z" => Vector3::z(),
        "30deg" => Vector3::new(0.5, 0.0, 0.866_025_403_784_438_6),
        _ if name.starts_with("sphere") => Vector3::new(1.0, 2.0, -2.0) / 3.0,
        _ => Vector3::new(2.0, -3.0, 6.0) / 7.0,
    };
    let mut worst = BTreeMap::new();
    for (name, place, point, numbers) in &table {
        let b = |remanence: f64| -> [f64; 3] { (direction(name) * remanence).into() };
        let source = match name.split('_').next().unwrap() {
            "cube10" => cuboid([0.01; 3], b(1.45)),
            "bar5x12x20" => cuboid([5e-3, 12e-3, 20e-3], b(1.45)),
            "plate40x30x4" => cuboid([40e-3, 30e-3, 4e-3], b(1.45)),
            "sphere25" => Sphere::new(12.5e-3, b(1.32).into()).unwrap().into(),
            "cyl45x30" => cylinder([0.0, 22.5e-3, 30e-3], b(1.35)),
            "ring4x1.5x1" => cylinder([0.75e-3, 2e-3, 1e-3], b(1.35)),
            "ring60x20x15" => cylinder([10e-3, 30e-3, 15e-3], b(1.28)),
            other => panic!("no magnet {other}"),
        };
        let (field, gradient) = source.field_gradient(point).unwrap();
        let expected = Vector3::from_column_slice(&numbers[..3]);
        let slopes = Matrix3::from_row_slice(&numbers[3..12]);
        // Inside a sphere the gradient is zero.
        let scale = slopes.norm().max(1e-9 * expected.norm() / point.norm().max(1e-3));
        let found = [(field - expected).norm() / expected.norm(), (gradient - slopes).norm() / scale];
        let entry: &mut [f64; 2] = worst.entry((name.clone(), place.clone())).or_default();
        *entry = core::array::from_fn(|i| entry[i].max(found[i]));
    }
    for ((name, place), found) in worst {
        println!("{name} {place} {:.1e} {:.1e}", found[0], found[1]);
        assert!(found.iter().all(|error| *error <= NEAR_MAGNET_EDGE), "{name} {place}: {found:?}");
    }
}

/// The field is free of curl and divergence, and its derivatives are those of differences.
#[test]
fn derivatives_are_those_of_differences() {
    for name in ["cube", "bar", "plate", "cylinder", "disc", "rod", "ring"] {
        let source = magnet(name);
        let point = Vector3::new(0.021, 0.027, 0.0193);
        let jet = source.jet(&point).unwrap();
        assert!(jet.gradient.trace().abs() < 1e-12 * jet.gradient.norm(), "{name}");
        assert_eq!(jet.gradient, jet.gradient.transpose(), "{name}");
        for axis in 0..3 {
            let step = Vector3::ith(axis, 1e-5);
            let [up, down] = [1.0, -1.0].map(|side| source.field_gradient(&(point + step * side)).unwrap());
            let slope = (up.0 - down.0) / 2e-5;
            let bend = (up.1 - down.1) / 2e-5;
            assert!((slope - jet.gradient.column(axis)).norm() < 1e-6 * jet.gradient.norm(), "{name}");
            let along = jet.hessian_along(&Vector3::ith(axis, 1.0));
            assert!((bend - along).norm() < 1e-5 * along.norm(), "{name} {axis}");
        }
    }
}

/// A cylinder whose magnetisation is along its axis is the axial one, also by the formulas of any direction.
#[test]
fn along_the_axis_it_is_the_axial_magnet() {
    let axial = AxialMagnet { radius: 0.03, inner_radius: 0.01, length: 0.015, offset: 0.0, remanence: 1.2 };
    let axial = Source::from(Cylinders::new(vec![axial]).unwrap());
    let any = cylinder([0.01, 0.03, 0.015], [0.0, 0.0, 1.2]);
    for point in
        [[0.0, 0.0, 0.0], [0.02, 0.001, 0.0], [0.035, 0.0, 0.002], [0.1, -0.2, 0.3], [0.005, 0.0, 0.02]]
    {
        let (one, two) = (axial.jet(&point.into()).unwrap(), any.jet(&point.into()).unwrap());
        assert!((one.field - two.field).norm() < 1e-14 * one.field.norm());
        assert!((one.gradient - two.gradient).norm() <= 1e-14 * one.gradient.norm());
    }
    assert!(any.is_axisymmetric() && !cylinder([0.0, 0.03, 0.015], [0.1, 0.0, 1.2]).is_axisymmetric());
}

/// Reversal, scaling and turns: of a cuboid by permuted axes, of a cylinder by a turn about its own axis.
#[test]
fn fields_turn_with_their_magnets() {
    let point = Vector3::new(0.013, -0.011, 0.017);
    let cycle = Matrix3::new(0.0, 0.0, 1.0, 1.0, 0.0, 0.0, 0.0, 1.0, 0.0);
    let size = Vector3::new(0.005, 0.012, 0.02);
    let b = Vector3::new(0.4, -0.6, 1.2);
    let (one, two) = (cuboid(size.into(), b.into()), cuboid((cycle * size).into(), (cycle * b).into()));
    let (first, second) = (one.jet(&point).unwrap().rotated(&cycle), two.jet(&(cycle * point)).unwrap());
    assert!((first.field - second.field).norm() < 1e-14 * first.field.norm());
    assert!((first.gradient - second.gradient).norm() < 1e-13 * first.gradient.norm());

    let turn = RotationVector::new(Vector3::z() * 0.7).matrix();
    let (one, two) =
        (cylinder([0.004, 0.009, 0.01], b.into()), cylinder([0.004, 0.009, 0.01], (turn * b).into()));
    let (first, second) = (one.jet(&point).unwrap().rotated(&turn), two.jet(&(turn * point)).unwrap());
    assert!((first.field - second.field).norm() < 1e-14 * first.field.norm());
    assert!((first.gradient - second.gradient).norm() < 1e-13 * first.gradient.norm());

    let back = cylinder([0.004, 0.009, 0.01], (-b).into()).field(&point).unwrap();
    assert_eq!(back, -one.field(&point).unwrap());
    let mirrored = Matrix3::from_diagonal(&Vector3::new(-1.0, 1.0, 1.0));
    let (plain, image) = (cuboid(size.into(), b.into()), cuboid(size.into(), (-(mirrored * b)).into()));
    // Magnetisation is an axial vector: a mirror keeps the component along its normal.
    let (field, seen) = (plain.field(&point).unwrap(), image.field(&(mirrored * point)).unwrap());
    assert!((seen + mirrored * field).norm() < 1e-14 * field.norm());
}

/// Faces have the values outside, edges are refused, and points inside are known as such.
#[test]
fn faces_and_edges() {
    let cube = cuboid([0.01; 3], [0.3, 0.0, 1.45]);
    let [on, above] = [5e-3, 5e-3 + 1e-12].map(|z| cube.field(&Vector3::new(1e-3, 2e-3, z)).unwrap());
    assert!((on - above).norm() < 1e-8);
    assert!(cube.field(&Vector3::new(5e-3, 5e-3, 1e-3)).is_err());
    assert!(cube.field(&Vector3::new(5e-3, -5e-3, 5e-3)).is_err());
    assert!(cube.jet(&Vector3::new(5e-3, 5e-3, 6e-3)).is_ok());
    assert!(cube.field(&Vector3::new(f64::NAN, 0.0, 0.0)).is_err());
    assert!(cube.contains(&Vector3::new(4.9e-3, 0.0, 0.0)) && !cube.contains(&Vector3::new(5e-3, 0.0, 0.0)));
    assert!((cube.distance(&Vector3::new(8e-3, 9e-3, 0.0)) - 5e-3).abs() < 1e-15);

    let disc = cylinder([0.0, 0.02, 0.002], [1.0, 0.0, 0.0]);
    let [on, above] = [1e-3, 1e-3 + 1e-12].map(|z| disc.field(&Vector3::new(1e-3, 2e-3, z)).unwrap());
    assert!((on - above).norm() < 1e-8);
    let side = |rho: f64| disc.field(&Vector3::new(0.6 * rho, 0.8 * rho, 3e-4)).unwrap();
    let mean = 0.5 * (side(0.02 - 1e-12) + side(0.02 + 1e-12));
    assert!((disc.field(&Vector3::new(0.012, 0.016, 3e-4)).unwrap() - mean).norm() < 1e-7);
    assert!(disc.field(&Vector3::new(0.02, 0.0, 1e-3)).is_err());
}

#[test]
fn dimensions_out_of_range_are_refused() {
    let refused = |error: Result<Source, mcm::error::Error>, word: &str| {
        let text = error.unwrap_err().to_string();
        assert!(text.contains(word), "{text}");
    };
    let cuboid = |size: [f64; 3], b: [f64; 3]| Cuboid::new(size.into(), b.into()).map(Source::from);
    refused(cuboid([1e-5, 0.01, 0.01], [0.0, 0.0, 1.0]), "magnet edge (m) = 0.00001");
    refused(cuboid([10.0, 0.01, 0.01], [0.0, 0.0, 1.0]), "magnet edge (m) = 10");
    refused(cuboid([-0.01, 0.01, 0.01], [0.0, 0.0, 1.0]), "magnet edge (m)");
    refused(cuboid([0.01; 3], [2.0, 0.0, 1.0]), "magnet remanence (T)");
    refused(Sphere::new(f64::NAN, Vector3::z()).map(Source::from), "magnet radius (m)");
    let ring = ObliqueCylinder::new([0.02, 0.01], 0.01, Vector3::x()).map(Source::from);
    refused(ring, "magnet bore radius (m)");
}

/// A body in the field of another one: the wrench by charges on the surface and that of many dipoles in the volume.
fn by_dipoles(other: &Source, places: &[(Vector3<f64>, Vector3<f64>)], pose: &Pose) -> Wrench {
    let mut sum = Wrench::NONE;
    for (place, moment) in places {
        let (arm, moment) = (pose.rotation * place, pose.rotation * moment);
        let (field, gradient) = other.field_gradient(&(pose.position + arm)).unwrap();
        let force = gradient * moment;
        sum.force += force;
        sum.torque += arm.cross(&force) + moment.cross(&field);
    }
    sum
}

fn places() -> Pose {
    Pose::new([0.012, 0.017, 0.024], [0.8, 0.36, 0.48, 0.0]).unwrap()
}

/// Force and torque of two magnets on one another cancel, whichever of them is asked.
#[test]
fn third_law_between_all_shapes() {
    let axial = AxialMagnet { radius: 5e-3, inner_radius: 2e-3, length: 4e-3, offset: 0.0, remanence: 1.2 };
    let sources = [
        Source::from(Cylinders::new(vec![axial]).unwrap()),
        cuboid([0.006, 0.01, 0.014], [0.4, -0.6, 1.0]),
        Source::from(Sphere::new(6e-3, Vector3::new(0.5, 0.9, -0.7)).unwrap()),
        cylinder([0.002, 0.007, 0.01], [1.0, 0.3, 0.2]),
    ];
    let pose = places();
    let back = Pose::identity().seen_from(&pose);
    for (i, one) in sources.iter().enumerate() {
        for (j, other) in sources.iter().enumerate() {
            let on_other = one.wrench_on_source(other, &pose, 1e-9).unwrap();
            let on_one = other.wrench_on_source(one, &back, 1e-9).unwrap().reaction(&back.position);
            let seen = Wrench { force: pose.rotation * on_one.force, torque: pose.rotation * on_one.torque };
            let scale = on_other.force.norm() + on_other.torque.norm() / 6e-3;
            assert!((seen.force - on_other.force).norm() < 2e-9 * scale, "{i} {j}");
            assert!((seen.torque - on_other.torque).norm() < 2e-9 * scale * 6e-3, "{i} {j}");
        }
    }
}

/// The wrench on a cuboid is that on a lattice of dipoles, and the derivative of their energy.
#[test]
fn wrench_is_that_of_a_lattice_and_of_the_energy() {
    let other = cylinder([0.002, 0.007, 0.01], [1.0, 0.3, 0.2]);
    let (size, b) = ([0.006, 0.01, 0.014], Vector3::new(0.4, -0.6, 1.0));
    let body = cuboid(size, b.into());
    let (nodes, weights) = mcm::numerics::quadrature::gauss_legendre(8);
    let volume = size.iter().product::<f64>();
    let mut lattice = Vec::new();
    for (x, a) in nodes.iter().zip(&weights) {
        for (y, c) in nodes.iter().zip(&weights) {
            for (z, d) in nodes.iter().zip(&weights) {
                let place = Vector3::new(x * size[0], y * size[1], z * size[2]) * 0.5;
                lattice.push((place, b * (a * c * d * volume / 8.0 / (4e-7 * PI))));
            }
        }
    }
    let pose = places();
    let exact = other.wrench_on_source(&body, &pose, 1e-9).unwrap();
    let summed = by_dipoles(&other, &lattice, &pose);
    let scale = exact.force.norm() + exact.torque.norm() / 6e-3;
    assert!((summed.force - exact.force).norm() < 1e-6 * scale);
    assert!((summed.torque - exact.torque).norm() < 1e-6 * scale * 6e-3);

    let energy = |pose: &Pose| -> f64 {
        let each = lattice.iter().map(|(place, moment)| {
            let field = other.field(&pose.transform(place)).unwrap();
            -(pose.rotation * moment).dot(&field)
        });
        each.sum()
    };
    for axis in 0..3 {
        let unit = Vector3::ith(axis, 1.0);
        let moved = |h: f64| energy(&Pose { position: pose.position + unit * h, ..pose });
        let force = -(moved(1e-5) - moved(-1e-5)) / 2e-5;
        assert!((force - exact.force[axis]).abs() < 1e-5 * scale, "{axis}");
        let turned = |h: f64| {
            energy(&Pose { rotation: RotationVector::new(unit * h).matrix() * pose.rotation, ..pose })
        };
        let torque = -(turned(1e-4) - turned(-1e-4)) / 2e-4;
        assert!((torque - exact.torque[axis]).abs() < 1e-5 * scale * 6e-3, "{axis}");
    }
}
