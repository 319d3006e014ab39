//! Segments whose rings are closer than the paper's: pairs summed up over their charged faces.

use mcm::design::{Design, Helix, Segmented, Specification};
use mcm::equilibrium::{Equilibrium, Inputs, Settings, Solution};
use mcm::geometry::Pose;
use mcm::magnetics::AxialSource;
use nalgebra::Vector3;

use crate::differences::{Direction, assert_derivatives};
use crate::magnetics::face_integral::by_faces;
use crate::tolerance::{FACES_BALANCE, FACES_HESSIAN, FACES_SLOPE, PAIRS, assert_close};

/// Helix lengths (m) and how many such segments stay straight under their attraction: the rings' centres are a millimetre
/// further apart than that. Three of the shorter ones pull themselves shut.
const CHAINS: [(f64, usize); 4] = [(1.6e-3, 1), (1.6e-3, 2), (2.2e-3, 1), (2.2e-3, 3)];

fn design(length: f64, segments: usize) -> Design {
    let paper = Segmented::paper(segments);
    let helix = Helix { length, ..paper.helix };
    Design::new(Specification::Segmented(Segmented { helix, ..paper })).expect("allowed")
}

/// Heights of the ring centres of a straight chain over its first one: each segment is shortened by what the rings on one
/// side of it pull at those on the other, by its compliance. Found by iteration from the unstrained lengths.
fn heights(design: &Design) -> Vec<f64> {
    let ring = design.rings().next().expect("rings");
    let source =
        AxialSource::new(ring.inner_radius, ring.outer_radius, ring.length, ring.remanence).expect("allowed");
    let pull = |distance: f64| {
        let pose = Pose::new([0.0, 0.0, distance], [1.0, 0.0, 0.0, 0.0]).expect("a pose");
        by_faces(&source, &source, &pose).1.force.z
    };
    let spans = &design.segments()[0].spans;
    let unstrained = ring.length + spans.iter().map(|span| span.length).sum::<f64>();
    let compliance: f64 = spans.iter().map(|span| span.length / span.stiffness.axial).sum();
    let count = design.segments().len();
    let mut heights: Vec<f64> = (0..=count).map(|k| unstrained * k as f64).collect();
    for _ in 0..100 {
        let lengths = (0..count).map(|k| {
            let across = (0..=k).flat_map(|i| (k + 1..=count).map(move |j| (i, j)));
            unstrained + compliance * across.map(|(i, j)| pull(heights[j] - heights[i])).sum::<f64>()
        });
        let next: Vec<f64> = core::iter::once(0.0)
            .chain(lengths.scan(0.0, |height, length| {
                *height += length;
                Some(*height)
            }))
            .collect();
        let moved = next.iter().zip(&heights).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max);
        heights = next;
        if moved < 1e-15 {
            return heights;
        }
    }
    panic!("the rings pull the segments shut");
}

#[test]
fn attraction_and_axial_stiffness_balance() {
    for (length, segments) in CHAINS {
        let design = design(length, segments);
        let mut equilibrium = Equilibrium::new(&design, None, Settings::default(), 2).expect("allowed");
        let report = equilibrium.solve(&Inputs::unloaded(segments + 1)).expect("finite");
        assert!(report.solved() && report.stable == Some(true), "{report:?}");
        let rings: Vec<Pose> = equilibrium.rings().collect();
        let expected = heights(&design);
        let free = design.rings().next().expect("rings").length + length;
        for (k, height) in expected.iter().enumerate().skip(1) {
            let got = rings[k].position.z - rings[0].position.z;
            let [got, expected] = [got, *height].map(|height| free * k as f64 - height);
            let name = format!("{length} m, ring {k} of {segments}");
            println!("{name}: {expected:e} m shorter, {:e}", got / expected - 1.0);
            assert!(expected > 1e-6, "{name}: the attraction counts");
            assert_close(&name, &[got], &[expected], FACES_BALANCE);
        }
    }
}

/// A chain, and a direction through a bent shape of it.
fn bent(length: f64, segments: usize, settings: Settings) -> (Equilibrium, Direction) {
    let equilibrium = Equilibrium::new(&design(length, segments), None, settings, 2).expect("allowed");
    let metric = equilibrium.metric();
    let vector = |seed: f64, size: f64| {
        let unit = |k: &f64| size * (metric[0] / k).sqrt();
        metric
            .iter()
            .enumerate()
            .map(|(i, k)| unit(k) * (12.9898 * (i as f64 + 1.0) + 78.233 * seed).sin())
            .collect()
    };
    let (shape, along) = (vector(1.0, 0.12), vector(2.0, 1.0));
    let allowed = [FACES_SLOPE, FACES_HESSIAN];
    (equilibrium, Direction { shape, along, steps: [1e-4, 1e-5], shift: 30.0, allowed })
}

#[test]
fn energy_gradient_and_hessian_are_of_one_function() {
    for (length, segments) in CHAINS.into_iter().filter(|chain| chain.1 < 3) {
        let mut inputs = Inputs::unloaded(segments + 1);
        inputs.uniform_field = Vector3::new(0.004, 0.012, -0.003);
        // Rules on the axis, for rings further apart, have large weights, which make a noise of 1e-8 here out of rounding.
        let default = Settings::default();
        let pair_accuracy = if segments == 1 { default.pair_accuracy } else { PAIRS };
        let (mut equilibrium, direction) = bent(length, segments, Settings { pair_accuracy, ..default });
        assert_derivatives(format!("{length} m"), &mut equilibrium, &inputs, &direction);
    }
}

#[test]
fn a_short_helix_follows_a_field_as_the_best_rules_have_it() {
    // Two of the shorter ones are all but pulled shut: a field does the rest.
    for (length, segments) in CHAINS.into_iter().filter(|chain| *chain != (1.6e-3, 2)) {
        let solve = |pair_accuracy: f64| {
            let settings = Settings { pair_accuracy, ..Settings::default() };
            let mut equilibrium =
                Equilibrium::new(&design(length, segments), None, settings, 2).expect("allowed");
            let mut iterations = 0;
            for step in 0..=10 {
                let mut inputs = Inputs::unloaded(segments + 1);
                inputs.uniform_field = Vector3::new(0.0, 3e-4 * f64::from(step), 0.0);
                let report = equilibrium.solve(&inputs).expect("finite");
                assert!(report.solved() && report.snaps == 0, "{length} m, step {step}: {report:?}");
                iterations += report.iterations;
            }
            (equilibrium.tip().position, iterations)
        };
        let (default, best) = (solve(Settings::default().pair_accuracy), solve(PAIRS));
        let error = (default.0 - best.0).norm() / design(length, segments).length();
        println!("{length} m: {} and {} iterations, {error:e} of the length apart", default.1, best.1);
        assert!(error <= FACES_BALANCE, "{length} m: {error:e}");
        assert!(default.1 <= 11 * 12, "Newton's method converges: {} iterations", default.1);
    }
}
