//! Tangents and curvatures of the centreline.

use mcm::design::{Backbone, Cylinder, CylinderMaterial, Design, Segmented, Span, Specification};
use mcm::equilibrium::{Interaction, Settings};
use mcm::geometry::Pose;
use mcm::manipulator::{Inputs, Manipulator, Outputs, Status};
use nalgebra::{Matrix3, Vector3};

use crate::tolerance::{ELASTICA, RESIDUAL, STRAINS_BETWEEN_POINTS, assert_close};

/// Points at which a shape is finely resolved.
const MANY: usize = 2001;

/// A base that stands askew.
fn askew() -> Pose {
    Pose::new([0.003, -0.002, 0.005], [0.8, 0.36, -0.48, 0.0]).unwrap()
}

fn rod() -> Design {
    let material = CylinderMaterial::Bulk { elastic_modulus: 1.5e6, poisson: 0.45, remanence: 0.0 };
    let rod = Cylinder { length: 0.02, radius: 0.001, inner_radius: 0.0, material, density: None };
    Design::new(Specification::Cylinder(rod)).unwrap()
}

/// The shape at `points`, with its tangents and curvatures.
fn bent(design: &Design, inputs: &Inputs, points: usize) -> Outputs {
    let settings =
        Settings { interaction: Interaction::None, tolerance: 1e-13, degree: 4, ..Settings::default() };
    let mut manipulator = Manipulator::new(design, None, settings, points).unwrap();
    assert_eq!(manipulator.solve(inputs).unwrap().status, Status::Solved);
    manipulator.measure_strains().clone()
}

/// Curvature about the axis of a moment (N m) in its section, 1/m.
fn by_moment(moment: f64, span: &Span) -> [f64; 3] {
    [moment / span.stiffness.bending, 0.0, 0.0]
}

/// A moment about the base's `d1` bends all sections about their own: the rod is an arc.
#[test]
fn a_moment_at_the_tip_bends_a_rod_to_an_arc() {
    let (design, base, moment) = (rod(), askew(), 6e-5);
    let span = &design.segments()[0].spans[0];
    let inertia = core::f64::consts::PI * 0.001_f64.powi(4) / 4.0;
    assert_close("E I", &[span.stiffness.bending], &[1.5e6 * inertia], 1e-12);

    let tip_moment = base.rotation.column(0) * moment;
    let out = bent(&design, &Inputs { base, tip_moment, ..Inputs::unloaded(0) }, 9);
    let curvature = moment / (1.5e6 * inertia);
    assert!(curvature * design.length() > 1.0, "bent by {} rad", curvature * design.length());
    for (index, s) in out.shape_arc_length.iter().enumerate() {
        let (sine, cosine) = (curvature * s).sin_cos();
        let tangent = base.rotation * Vector3::new(0.0, -sine, cosine);
        assert_close(("tangent", s), out.shape_tangents[index].as_slice(), tangent.as_slice(), ELASTICA);
        let found = out.shape_curvatures[index];
        assert_close(("curvature", s), found.as_slice(), &by_moment(moment, span), ELASTICA);
    }
}

#[test]
fn a_moment_about_the_axis_twists_a_straight_rod() {
    let (design, base, moment) = (rod(), askew(), 3e-6);
    let inputs = Inputs { base, tip_moment: base.axis() * moment, ..Inputs::unloaded(0) };
    let out = bent(&design, &inputs, 5);
    let twist = moment / design.segments()[0].spans[0].stiffness.torsion;
    for (tangent, curvature) in out.shape_tangents.iter().zip(&out.shape_curvatures) {
        assert_close("tangent", tangent.as_slice(), base.axis().as_slice(), RESIDUAL);
        assert_close("twist", curvature.as_slice(), &[0.0, 0.0, twist], RESIDUAL);
    }
}

/// A segment whose ring is so long that the second and fourth of five points are at the joints of discs and core.
#[test]
fn joints_have_the_curvature_of_the_section_towards_the_tip() {
    let mut paper = Segmented::paper(1);
    paper.ring.length = 0.5 * paper.helix.length - 2.0 * paper.helix.geometry().unwrap().height;
    let design = Design::new(Specification::Segmented(paper)).unwrap();
    let moment = 2e-6;
    let inputs = Inputs { tip_moment: Vector3::new(moment, 0.0, 0.0), ..Inputs::unloaded(2) };
    let out = bent(&design, &inputs, 5);

    let [disc, core, _] = &design.segments()[0].spans[..] else { panic!("three spans") };
    let [in_disc, in_core] = [disc, core].map(|span| by_moment(moment, span));
    assert!(in_core[0] > 2.0 * in_disc[0], "{in_core:?} {in_disc:?}");
    let expected = [[0.0; 3], in_core, in_core, in_disc, [0.0; 3]];
    for (found, expected) in out.shape_curvatures.iter().zip(expected) {
        assert!((found - Vector3::from(expected)).norm() <= ELASTICA * in_core[0], "{found} {expected:?}");
    }
}

/// Behind half its length of shaft, a device has its own curvature at the joint, also where it ends in a ring.
#[test]
fn the_joint_with_a_shaft_has_the_curvature_of_the_device() {
    let design = rod().with_shaft(&Backbone::silicone()).unwrap();
    let moment = 4e-6;
    let tip_moment = Vector3::new(moment, 0.0, 0.0);
    let out = bent(&design, &Inputs { insertion: 0.02, tip_moment, ..Inputs::unloaded(0) }, 5);

    let (shaft, device) = (design.shaft().unwrap(), &design.segments()[0].spans[0]);
    let [in_shaft, in_device] = [shaft, device].map(|span| by_moment(moment, span));
    assert!(in_shaft[0] > 1.5 * in_device[0], "{in_shaft:?} {in_device:?}");
    let expected = [in_shaft, in_shaft, in_device, in_device, in_device];
    for (found, expected) in out.shape_curvatures.iter().zip(expected) {
        assert_close("curvature", found.as_slice(), &expected, ELASTICA);
    }

    let ringed = Design::new(Specification::paper(1)).unwrap().with_shaft(&Backbone::silicone()).unwrap();
    let out = bent(&ringed, &Inputs { insertion: 0.006, tip_moment, ..Inputs::unloaded(2) }, 5);
    assert!(out.shape_curvatures[1].x > 0.0);
    assert_eq!(out.shape_curvatures[2], Vector3::zeros(), "in the first ring");
}

/// Forces and moments out of any plane bend and twist three segments.
fn loaded() -> (Design, Outputs) {
    let design = Design::new(Specification::paper(3)).unwrap();
    let inputs = Inputs {
        base: askew(),
        tip_force: Vector3::new(2e-4, -3e-4, 1e-4),
        tip_moment: Vector3::new(1e-6, -1e-6, 3e-6),
        uniform_field: Vector3::new(0.002, 0.004, -0.001),
        ..Inputs::unloaded(4)
    };
    let out = bent(&design, &inputs, MANY);
    (design, out)
}

/// First and last point within each ring and each span, base to tip, with whether it is a ring.
fn parts(design: &Design, out: &Outputs) -> Vec<(bool, [usize; 2])> {
    let ring = |length: f64| (true, length);
    let mut lengths: Vec<(bool, f64)> = design.base_rings().iter().map(|own| ring(own.length)).collect();
    for segment in design.segments() {
        lengths.extend(segment.spans.iter().map(|span| (false, span.length)));
        lengths.extend(segment.rings.iter().map(|own| ring(own.length)));
    }

    let mut start = 0.0;
    let mut part = |(is_ring, length): (bool, f64)| {
        let inside = |s: &f64| *s > start + 1e-9 && *s < start + length - 1e-9;
        let first = out.shape_arc_length.iter().position(inside).unwrap();
        let last = out.shape_arc_length.iter().rposition(inside).unwrap();
        start += length;
        (is_ring, [first, last])
    };
    lengths.into_iter().map(&mut part).collect()
}

#[test]
fn rings_are_straight_and_tangents_turn_by_the_curvature_between_them() {
    let (design, out) = loaded();
    let (s, tangents, curvatures) = (&out.shape_arc_length, &out.shape_tangents, &out.shape_curvatures);
    assert_close("base", tangents[0].as_slice(), askew().axis().as_slice(), RESIDUAL);
    assert_close("tip", tangents[MANY - 1].as_slice(), out.tip.axis().as_slice(), RESIDUAL);

    let largest = curvatures.iter().map(Vector3::norm).fold(0.0, f64::max);
    let (mut ring, mut worst) = (0, 0.0_f64);
    for (is_ring, [first, last]) in parts(&design, &out) {
        if is_ring {
            let axis = out.rings[ring].axis();
            for index in first..=last {
                assert_eq!(curvatures[index], Vector3::zeros());
                assert!((tangents[index] - axis).norm() < RESIDUAL);
            }
            ring += 1;
        } else {
            for index in first + 1..last {
                let turned = (tangents[index + 1] - tangents[index - 1]) / (s[index + 1] - s[index - 1]);
                worst = worst.max((turned.norm() - curvatures[index].xy().norm()).abs() / largest);
            }
        }
    }
    println!("tangents by differences: {worst:.1e}");
    assert!(ring == 4 && worst < STRAINS_BETWEEN_POINTS, "{worst:e}");
    assert!(curvatures.iter().any(|curvature| curvature.z.abs() > 0.1), "nothing twists");
}

/// The rotation by the curvature from point to point, by its exponential at their means, ends at the tip's directors.
#[test]
fn directors_follow_from_the_curvature_along_the_device() {
    let (design, out) = loaded();
    let mut rotation = askew().rotation;
    for (is_ring, [first, last]) in parts(&design, &out) {
        if is_ring {
            continue;
        }
        // The ends of the span are no points of the shape.
        let [before, after] = ends(&design, &out, [first, last]);
        rotation *= exponential(out.shape_curvatures[first] * before);
        for index in first..last {
            let mean = (out.shape_curvatures[index] + out.shape_curvatures[index + 1]) / 2.0;
            rotation *= exponential(mean * out.shape_arc_length[1]);
        }
        rotation *= exponential(out.shape_curvatures[last] * after);
    }
    let error = (rotation - out.tip.rotation).norm();
    println!("directors by the curvature: {error:.1e}");
    assert!(error < STRAINS_BETWEEN_POINTS, "{error:e}");
}

/// Length of the span with these first and last points that lies before the first and after the last, m.
fn ends(design: &Design, out: &Outputs, [first, last]: [usize; 2]) -> [f64; 2] {
    let mut joints = vec![0.0];
    let mut add = |length: f64| joints.push(joints[joints.len() - 1] + length);
    design.base_rings().iter().for_each(|ring| add(ring.length));
    for segment in design.segments() {
        segment.spans.iter().for_each(|span| add(span.length));
        segment.rings.iter().for_each(|ring| add(ring.length));
    }
    let start = joints.iter().rfind(|joint| **joint <= out.shape_arc_length[first]).unwrap();
    let end = joints.iter().find(|joint| **joint >= out.shape_arc_length[last]).unwrap();
    [out.shape_arc_length[first] - start, end - out.shape_arc_length[last]]
}

/// The rotation by a rotation vector, rad.
fn exponential(vector: Vector3<f64>) -> Matrix3<f64> {
    nalgebra::Rotation3::new(vector).into_inner()
}

/// Under a moment about one axis, the curvature along a core adds up to its angle.
#[test]
fn the_curvature_along_a_core_adds_up_to_its_angle() {
    let design = Design::new(Specification::paper(2)).unwrap();
    let tip_moment = Vector3::new(3e-6, 0.0, 0.0);
    let inputs = Inputs { tip_moment, uniform_field: Vector3::new(0.0, 0.003, 0.0), ..Inputs::unloaded(3) };
    let out = bent(&design, &inputs, MANY);
    let spans: Vec<_> = parts(&design, &out).into_iter().filter(|(is_ring, _)| !is_ring).collect();
    let cores = spans.iter().skip(1).step_by(3);
    for ((_, [first, last]), angle) in cores.zip(&out.core_angles) {
        let length = out.shape_arc_length[1];
        let curvature = |index: usize| out.shape_curvatures[index].x;
        let within: f64 = (*first..*last).map(|index| 0.5 * (curvature(index) + curvature(index + 1))).sum();
        let [before, after] = ends(&design, &out, [*first, *last]);
        let sum = within * length + before * curvature(*first) + after * curvature(*last);
        assert!(angle.abs() > 0.05, "{angle}");
        assert_close("core", &[sum.abs()], &[*angle], STRAINS_BETWEEN_POINTS);
    }
    assert_eq!(out.core_angles.len(), 2);
}

#[test]
fn they_belong_to_the_last_shape_and_are_computed_only_when_asked_for() {
    let design = rod();
    let inputs = |moment| Inputs { tip_moment: Vector3::new(moment, 0.0, 0.0), ..Inputs::unloaded(0) };
    let mut manipulator = Manipulator::new(&design, None, Settings::default(), 3).unwrap();
    manipulator.solve(&inputs(1e-6)).unwrap();
    assert!(manipulator.outputs().shape_curvatures.is_empty());
    let first = manipulator.measure_strains().shape_curvatures.clone();
    assert_eq!(manipulator.measure_strains().shape_curvatures, first);
    manipulator.solve(&inputs(2e-6)).unwrap();
    assert!(manipulator.outputs().shape_tangents.is_empty());
    let second = manipulator.measure_strains().shape_curvatures.clone();
    assert_close("twice", &[second[1].x], &[2.0 * first[1].x], ELASTICA);
}
