//! Scenes with magnets given by their shape.

use core::f64::consts::PI;

use mcm::error::Error;
use mcm::geometry::Pose;
use mcm::magnetics::{Dipole, Drive, FieldSource, Jet, Part, Source, Sources, Wrench};
use mcm::manipulator::{Followed, Outputs, Scene, SceneFile};
use mcm::numerics::quadrature::gauss_legendre;
use nalgebra::{Matrix3, Vector3};

/// A magnet as many dipoles, in the place of the one whose solid parts it has.
#[derive(Debug)]
struct Lattice {
    dipoles: Vec<(Vector3<f64>, Dipole)>,
    whole: Source,
}

impl Lattice {
    fn sum<T>(
        &self,
        points: &[Vector3<f64>],
        out: &mut [T],
        zero: impl Fn() -> T,
        add: impl Fn(&mut T, &Dipole, &Vector3<f64>) -> Result<(), Error>,
    ) -> Result<(), Error> {
        for (point, out) in points.iter().zip(out) {
            *out = zero();
            self.dipoles.iter().try_for_each(|(place, dipole)| add(out, dipole, &(point - place)))?;
        }
        Ok(())
    }
}

impl FieldSource for Lattice {
    fn drive(&self) -> Drive {
        Drive::Factor
    }
    fn fields(&self, points: &[Vector3<f64>], out: &mut [Vector3<f64>]) -> Result<(), Error> {
        self.sum(points, out, Vector3::zeros, |sum, dipole, arm| {
            *sum += dipole.field(arm)?;
            Ok(())
        })
    }
    fn gradients(
        &self,
        points: &[Vector3<f64>],
        out: &mut [(Vector3<f64>, Matrix3<f64>)],
    ) -> Result<(), Error> {
        self.sum(
            points,
            out,
            || (Vector3::zeros(), Matrix3::zeros()),
            |sum, dipole, arm| {
                let (field, gradient) = dipole.field_gradient(arm)?;
                sum.0 += field;
                sum.1 += gradient;
                Ok(())
            },
        )
    }
    fn jets(&self, points: &[Vector3<f64>], out: &mut [Jet]) -> Result<(), Error> {
        self.sum(points, out, Jet::zero, |sum, dipole, arm| {
            *sum += dipole.jet(arm)?;
            Ok(())
        })
    }
    fn contains_any(&self, points: &[Vector3<f64>]) -> bool {
        self.whole.contains_any(points)
    }
    fn distance(&self, point: &Vector3<f64>) -> f64 {
        self.whole.distance(point)
    }
    fn unknown_within(&self) -> f64 {
        0.0
    }
    fn parts(&self) -> &[Part] {
        self.whole.parts()
    }
    fn moment(&self) -> Vector3<f64> {
        self.dipoles.iter().map(|(_, dipole)| dipole.moment()).sum()
    }
    fn is_axisymmetric(&self) -> bool {
        false
    }
    fn wrench_in(&self, _: &Source, _: &Pose, _: f64) -> Result<Wrench, Error> {
        Err(Error::Unsupported("no wrench on a lattice".into()))
    }
    fn identity(&self) -> &dyn std::fmt::Debug {
        self
    }
}

/// Dipoles at the Gauss points of a cuboid, or of a cylinder (`round`) with these half edges (m).
fn lattice(half: [f64; 3], round: bool, remanence: Vector3<f64>, whole: Source) -> Lattice {
    const COUNT: usize = 10;
    let (nodes, weights) = gauss_legendre(COUNT);
    let mut dipoles = Vec::new();
    let mut put = |place: Vector3<f64>, volume: f64| {
        let dipole = Dipole::new(remanence * (volume / (4e-7 * PI))).unwrap();
        dipoles.push((place, dipole));
    };
    for (z, by_z) in nodes.iter().zip(&weights) {
        for (u, by_u) in nodes.iter().zip(&weights) {
            if round {
                let rho = half[0] * (0.5 * (1.0 + u)).sqrt();
                for step in 0..2 * COUNT {
                    let (sine, cosine) = (PI * step as f64 / COUNT as f64).sin_cos();
                    let volume = 0.25 * half[0] * half[0] * by_u * PI / COUNT as f64 * half[2] * by_z;
                    put(Vector3::new(rho * cosine, rho * sine, half[2] * z), volume);
                }
            } else {
                for (v, by_v) in nodes.iter().zip(&weights) {
                    let volume = half[0] * half[1] * half[2] * by_u * by_v * by_z;
                    put(Vector3::new(half[0] * u, half[1] * v, half[2] * z), volume);
                }
            }
        }
    }
    Lattice { dipoles, whole }
}

const DIRECTION: &str = "direction = [0.6, 0.0, 0.8]";

/// A device with a magnet of this kind beside it.
fn scene(level: &str, magnet: &str) -> Scene {
    let text = format!(
        "[design]\nsegments = 2\n[field]\nuniform_mt = [3.0, 2.0, 0.0]\n[model]\ninteraction = \"{level}\"\ntime_budget_s = 300.0\n\
         [magnet]\nposition_mm = [5.0, -45.0, 12.0]\norientation_wxyz = [0.8, 0.36, 0.48, 0.0]\n{magnet}"
    );
    Scene::parse(&text, "test").unwrap()
}

fn solve(scene: &Scene) -> Outputs {
    let mut manipulator = scene.manipulator(5).unwrap();
    manipulator.solve(&scene.inputs).unwrap().clone()
}

#[test]
fn every_shape_at_every_level_is_a_lattice_of_dipoles() {
    let remanence = Vector3::new(0.6, 0.0, 0.8) * 1.3;
    let shapes = [
        ("shape = \"cuboid\"\nsize_mm = [14.0, 20.0, 24.0]", Some(([7e-3, 10e-3, 12e-3], false))),
        ("shape = \"cylinder\"\nradius_mm = 11.0\nlength_mm = 22.0", Some(([11e-3, 11e-3, 11e-3], true))),
        ("shape = \"sphere\"\nradius_mm = 12.0", None),
    ];
    for level in ["none", "rings", "full", "auto"] {
        for (text, half) in &shapes {
            let own = scene(level, &format!("{text}\n{DIRECTION}\nremanence_t = 1.3"));
            let whole = own.sources.list()[0].clone();
            let replaced: Source = if let Some((half, round)) = half {
                lattice(*half, *round, remanence, whole).into()
            } else {
                let dipole = Dipole::new(remanence * (4.0 / 3.0 * PI * 12e-3_f64.powi(3) / (4e-7 * PI)));
                Lattice { dipoles: vec![(Vector3::zeros(), dipole.unwrap())], whole }.into()
            };
            let other = Scene { sources: Sources::new(vec![replaced]).unwrap(), ..own.clone() };
            let (one, two) = (solve(&own), solve(&other));
            assert!(one.tip_angle > 0.05, "{level} {text}: {}", one.tip_angle);
            let apart = (one.tip.position - two.tip.position).norm();
            assert!(apart < 1e-8, "{level} {text}: tips are {apart:e} m apart");
            let [reaction, expected] = [&one, &two].map(|outputs| outputs.reactions[0].force);
            assert!((reaction - expected).norm() < 1e-5 * expected.norm(), "{level} {text}");
            let [torque, expected] = [&one, &two].map(|outputs| outputs.reactions[0].torque);
            assert!((torque - expected).norm() < 1e-5 * expected.norm(), "{level} {text}");
        }
    }
}

/// A cylinder whose direction lies along its axis is the axial one, bit for bit.
#[test]
fn a_cylinder_along_its_axis_is_the_axial_magnet() {
    let shaped = "shape = \"cylinder\"\nradius_mm = 11.0\nlength_mm = 22.0\nremanence_t = 1.3";
    let listed = "cylinders = [{ radius_mm = 11.0, length_mm = 22.0, remanence_t = 1.3 }]";
    let [one, two] = [shaped, listed].map(|text| solve(&scene("full", text)));
    assert_eq!(one.tip.position, two.tip.position);
    assert_eq!(one.reactions[0].torque, two.reactions[0].torque);
}

/// Edges in another order are the same magnet in a turned frame.
#[test]
fn a_turned_frame_is_a_turned_magnet() {
    let upright = scene(
        "rings",
        "shape = \"cuboid\"\nsize_mm = [14.0, 20.0, 24.0]\ndirection = [0.6, 0.0, 0.8]\nremanence_t = 1.3",
    );
    // The frame turned by a third of a turn about its diagonal: its x, y, z are the other's y, z, x.
    let mut turned = scene(
        "rings",
        "shape = \"cuboid\"\nsize_mm = [20.0, 24.0, 14.0]\ndirection = [0.0, 0.8, 0.6]\nremanence_t = 1.3",
    );
    let cycle = Matrix3::new(0.0, 0.0, 1.0, 1.0, 0.0, 0.0, 0.0, 1.0, 0.0);
    turned.inputs.sources[0].pose.rotation *= cycle;
    let (one, two) = (solve(&upright), solve(&turned));
    assert!((one.tip.position - two.tip.position).norm() < 1e-10);
    assert!(
        (one.reactions[0].torque - two.reactions[0].torque).norm() < 1e-8 * one.reactions[0].torque.norm()
    );
}

/// A scene and its mirror image: magnetisation is an axial vector, and keeps its component along the mirror's normal.
#[test]
fn a_mirrored_scene_has_the_mirrored_shape() {
    let text = |x: f64, b: [f64; 3], field: [f64; 3]| {
        format!(
            "[design]\nsegments = 2\nspiral = \"axisymmetric\"\n[field]\nuniform_mt = {field:?}\n[model]\ninteraction = \"rings\"\n\
             [magnet]\nposition_mm = [{x:?}, -45.0, 12.0]\norientation_wxyz = [1.0, 0.0, 0.0, 0.0]\nshape = \"cuboid\"\n\
             size_mm = [14.0, 20.0, 24.0]\ndirection = {b:?}\nremanence_t = 1.3"
        )
    };
    // The device's own magnetisation, along z, is reversed by the mirror: all others with it, which leaves forces.
    let plain = Scene::parse(&text(9.0, [0.6, 0.0, 0.8], [3.0, 2.0, 1.0]), "test").unwrap();
    let image = Scene::parse(&text(-9.0, [-0.6, 0.0, 0.8], [-3.0, 2.0, 1.0]), "test").unwrap();
    let (one, two) = (solve(&plain), solve(&image));
    let mirrored = Vector3::new(-two.tip.position.x, two.tip.position.y, two.tip.position.z);
    assert!((one.tip.position - mirrored).norm() < 1e-9);
    let [force, other] = [&one, &two].map(|outputs| outputs.reactions[0].force);
    assert!((force - Vector3::new(-other.x, other.y, other.z)).norm() < 1e-7 * force.norm());
}

#[test]
fn a_grade_is_a_remanence_with_its_deviation() {
    let text = "[[magnet]]\nshape = \"sphere\"\nradius_mm = 10.0\ngrade = \"N52\"\n\
                [[magnet]]\nposition_mm = [0, 200, 0]\nshape = \"cuboid\"\nsize_mm = [10, 10, 10]\ngrade = \"N42\"";
    let file = SceneFile::parse(text, "test").unwrap();
    assert!((file.number("magnet[1].remanence_t").unwrap() - 1.455).abs() < 1e-15);
    let uncertainty = file.uncertainty().unwrap();
    assert_eq!(uncertainty.keys, ["magnet[1].remanence_t", "magnet[2].remanence_t"]);
    assert!((uncertainty.deviations[0] - 0.0125).abs() < 1e-15);
    assert!((uncertainty.deviations[1] - 0.01).abs() < 1e-15);

    // A deviation that the scene states itself holds, and what is written can be read again.
    let own = format!("{text}\n[uncertainty]\n\"magnet[1].remanence_t\" = 0.02");
    let stated = SceneFile::parse(&own, "test").unwrap().uncertainty().unwrap().deviations[0];
    assert!((stated - 0.02).abs() < 1e-15, "{stated}");
    let written = file.to_toml().unwrap();
    assert_eq!(SceneFile::parse(&written, "written").unwrap(), file);
    let longer = file.with("magnet[2].size_mm[3]", 12.0).unwrap();
    assert!((longer.number("magnet[2].size_mm[3]").unwrap() - 12.0).abs() < 1e-12);
}

#[test]
fn what_a_magnet_cannot_be_is_refused_by_its_key() {
    let cases = [
        ("shape = \"cuboid\"\nsize_mm = [0.01, 0.01, 0.01]\nremanence_t = 1.0", "magnet.size_mm"),
        ("shape = \"cuboid\"\nsize_mm = [10.0, -10.0, 10.0]\nremanence_t = 1.0", "-10"),
        ("shape = \"cuboid\"\nsize_mm = [10.0, 10.0]\nremanence_t = 1.0", "size_mm"),
        ("shape = \"cuboid\"\nremanence_t = 1.0", "magnet.size_mm is missing"),
        ("shape = \"cuboid\"\nsize_mm = [10, 10, 10]", "magnet.remanence_t is missing"),
        (
            "shape = \"cuboid\"\nsize_mm = [10, 10, 10]\nradius_mm = 3\nremanence_t = 1.0",
            "magnet.radius_mm has no meaning",
        ),
        ("shape = \"sphere\"\nradius_mm = 0.0125\nremanence_t = 1.0", "magnet.radius_mm"),
        ("shape = \"sphere\"\nradius_mm = 12.5\nremanence_t = 2.5", "magnet.remanence_t"),
        ("shape = \"sphere\"\nradius_mm = 12.5\nremanence_t = 1.0\ndirection = [0, 0, 0]", "direction"),
        ("shape = \"sphere\"\nradius_mm = 12.5\nremanence_t = 1.0\ndirection = [1, 1, 0]", "direction"),
        ("shape = \"sphere\"\nradius_mm = 12.5\ngrade = \"N53\"", "did you mean `N5"),
        (
            "shape = \"sphere\"\nradius_mm = 12.5\ngrade = \"N52\"\nremanence_t = 1.4",
            "magnet.grade has no meaning",
        ),
        ("shape = \"cube\"\nsize_mm = [10, 10, 10]", "choose one of cuboid, sphere, cylinder"),
        ("radius_mm = 12.5\nremanence_t = 1.0", "needs magnet.shape"),
        (
            "shape = \"cylinder\"\nradius_mm = 5\ninner_radius_mm = 6\nlength_mm = 4\nremanence_t = 1",
            "inner_radius_mm",
        ),
        (
            "shape = \"sphere\"\nradius_mm = 12.5\nremanence_t = 1\ncylinders = [{ radius_mm = 1, length_mm = 1, remanence_t = 1 }]",
            "magnet.cylinders has no meaning",
        ),
    ];
    for (text, word) in cases {
        let error = SceneFile::parse(&format!("[magnet]\n{text}"), "test").unwrap_err().to_string();
        assert!(error.contains(word), "{text}: {error}");
        println!("{error}");
    }
}

/// The planar method refuses a magnet whose field leaves the plane.
#[test]
fn the_planar_method_refuses_a_cuboid() {
    let text = "[design]\nsegments = 1\n[model]\ninteraction = \"none\"\nmethod = \"planar\"\n[magnet]\nposition_mm = [0, -80, 10]\n\
                shape = \"cuboid\"\nsize_mm = [10, 10, 10]\nremanence_t = 1.0";
    let scene = Scene::parse(text, "test").unwrap();
    let mut device = mcm::methods::Device::of(&scene, 5).unwrap();
    let refused = device.solve(&scene.inputs).unwrap_err().to_string();
    assert!(refused.contains("leaves the plane"), "{refused}");
}

/// Magnets that overlap by their true solids are refused, such as a cube in the corner of another one's box; others are not.
#[test]
fn solids_overlap_as_they_are() {
    let pair = |x: f64, y: f64, shape: &str| {
        let text = format!(
            "[[magnet]]\nposition_mm = [0, -80, 0]\norientation_wxyz = [1, 0, 0, 0]\nshape = \"cuboid\"\nsize_mm = [20, 20, 20]\nremanence_t = 1.0\n\
             [[magnet]]\nposition_mm = [{x:?}, {y:?}, 0.0]\norientation_wxyz = [1, 0, 0, 0]\n{shape}\nremanence_t = 1.0"
        );
        Scene::parse(&text, "test").map(|_| ()).map_err(|error| error.to_string())
    };
    let ball = "shape = \"sphere\"\nradius_mm = 10";
    assert!(pair(17.2, -62.8, ball).is_ok()); // beyond the corner, though within both boxes
    assert!(pair(16.9, -63.1, ball).unwrap_err().contains("overlap"));
    assert!(pair(19.9, -80.0, ball).unwrap_err().contains("overlap by 0.1"));
    let ring = "shape = \"cylinder\"\nradius_mm = 30\ninner_radius_mm = 14.2\nlength_mm = 10";
    assert!(pair(0.0, -80.0, ring).is_ok()); // around the cube
    assert!(pair(0.2, -80.2, ring).unwrap_err().contains("overlap"));
}
