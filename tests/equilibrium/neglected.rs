//! What no level counts: spans acting on spans. Its size, by bodies of revolution along a bent segment.
//!
//! Twice as many slices add half of what the last doubling added: from 8.5 to 9.4 % of the elastic moment at 10 degrees.

use mcm::constants::VACUUM_PERMEABILITY;
use mcm::design::{Design, Span, SpanKind, Specification};
use mcm::geometry::{Pose, RotationVector};
use mcm::magnetics::AxialSource;
use nalgebra::Vector3;

use crate::tolerance::SPANS_AMONG_THEMSELVES;

/// Slices of the core, an even number; the two that touch at its middle are left out.
const SLICES: usize = 16;

const ACCURACY: f64 = 1e-3;

/// A span's part as a body of revolution, the spiral spread over the circle, at the pose of its centre.
type Body = (AxialSource, Pose);

fn bodies(span: &Span, parts: usize, place: impl Fn(f64) -> Pose) -> Vec<Body> {
    let length = span.length / parts as f64;
    let remanence = VACUUM_PERMEABILITY * span.magnetisation;
    let mut out = Vec::new();
    for part in 0..parts {
        let at = place((part as f64 + 0.5) * length);
        let mut add = |inner, outer, share| {
            out.push((AxialSource::new(inner, outer, length, share * remanence).unwrap(), at));
        };
        add(span.inner_radius, span.outer_radius, 1.0);
        if let Some(spiral) = &span.spiral {
            add(spiral.inner_radius, spiral.outer_radius, spiral.sector_angle / core::f64::consts::TAU);
        }
    }
    out
}

/// Moment about `pivot` that the first bodies exert on the others.
fn moment(first: &[Body], second: &[Body], pivot: &Vector3<f64>) -> Vector3<f64> {
    let mut sum = Vector3::zeros();
    for (source, at) in first {
        for (body, pose) in second {
            let seen = Pose {
                position: at.rotation.tr_mul(&(pose.position - at.position)),
                rotation: at.rotation.tr_mul(&pose.rotation),
            };
            let wrench = source.wrench_on(body, &seen, ACCURACY).unwrap();
            let (force, torque) = (at.rotation * wrench.force, at.rotation * wrench.torque);
            sum += torque + (pose.position - pivot).cross(&force);
        }
    }
    sum
}

#[test]
fn spans_would_bend_one_another_by_a_tenth_of_what_bends_them() {
    let design = Design::new(Specification::paper(2)).unwrap();
    let [near, core, far] = &design.segments()[0].spans[..] else { panic!("disc, core, disc") };
    assert_eq!([near.kind, core.kind, far.kind], [SpanKind::Disc, SpanKind::Core, SpanKind::Disc]);
    let ring = design.segments()[0].ring.as_ref().unwrap();
    for bend in [10.0_f64, 20.0, 30.0].map(f64::to_radians) {
        // The core as an arc about x, from the origin; the discs are straight beyond its ends.
        let radius = core.length / bend;
        let on_arc = |s: f64| Pose {
            position: Vector3::new(0.0, -radius * (1.0 - (s / radius).cos()), radius * (s / radius).sin()),
            rotation: RotationVector::new(Vector3::x() * (s / radius)).matrix(),
        };
        let end = on_arc(core.length);
        let cores = bodies(core, SLICES, on_arc);
        let (before, after) = cores.split_at(cores.len() / 2);
        let step = cores.len() / SLICES;
        let mut fixed = bodies(near, 1, |s| on_arc(0.0).advanced(s - near.length));
        fixed.extend_from_slice(before);
        // The far disc, and what follows beyond the ring, turn together.
        let next = far.length + ring.length;
        let mut moved = bodies(far, 1, |s| end.advanced(s));
        moved.extend(bodies(near, 1, |s| end.advanced(next + s)));
        let pivot = on_arc(0.5 * core.length).position;
        let mut whole = moment(&fixed, &moved, &pivot) + moment(&fixed, &after[step..], &pivot);
        whole += moment(&fixed[..fixed.len() - step], &after[..step], &pivot);
        let elastic = core.stiffness.bending * bend / core.length;
        let share = whole.x / elastic;
        println!(
            "bent by {:.0} deg: {:.2} uN m, {share:.3} of the elastic moment",
            bend.to_degrees(),
            1e6 * whole.x
        );
        assert!((share - 0.1).abs() <= SPANS_AMONG_THEMSELVES, "{bend} rad: {share}");
    }
}
