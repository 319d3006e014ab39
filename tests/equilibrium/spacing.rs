//! One segment by the length of its helix, which is the gap between its rings: how their attraction softens it, beside a
//! beam column.

use mcm::design::{Design, Helix, Segmented, Specification};
use mcm::equilibrium::{Equilibrium, Inputs, Interaction, Settings, Solution};
use mcm::error::Error;
use mcm::geometry::Pose;
use mcm::magnetics::{AxialSource, Wrench};
use nalgebra::{Matrix2, Matrix4, Matrix4x2, RowVector4, Vector2};

use crate::tolerance::{ADJACENT, WRENCH_ACCURACY, assert_close};

fn design(length: f64) -> Result<Design, Error> {
    let paper = Segmented::paper(1);
    Design::new(Specification::Segmented(Segmented { helix: Helix { length, ..paper.helix }, ..paper }))
}

/// The straight segment as a beam column with shear between two rings: its conditions at the end by the moment and the
/// lateral force at the clamped base, and what those make of the end.
///
/// Along the rod, by unstrained length, with the lateral displacement `w`, the rotation `t`, the moment `m`, the lateral
/// force `V` and the axial force `N` (negative: the rings attract each other):
/// `w' = (1 + N/EA) t + (V - N t)/GA`, `t' = m/EI`, `m' = N w' - (1 + N/EA) V`, `V' = 0`.
/// At its end the ring, half its length `h` further on, feels the slopes of the exact wrench between two rings:
/// `V = F_w (w + h t) + F_t t + F`, `m = T_w (w + h t) + T_t t + h (V - N t)`, with a given force `F`.
struct BeamColumn {
    conditions: Matrix2<f64>,
    end: Matrix4x2<f64>,
    half: f64,
}

impl BeamColumn {
    fn new(length: f64) -> Self {
        let design = design(length).unwrap();
        let ring = design.rings().next().unwrap();
        let source =
            AxialSource::new(ring.inner_radius, ring.outer_radius, ring.length, ring.remanence).unwrap();
        let half = 0.5 * ring.length;
        let wrench = |aside: f64, turned: f64, along: f64| -> Wrench {
            let turn = [(0.5 * turned).cos(), 0.0, (0.5 * turned).sin(), 0.0];
            let pose = Pose::new([aside, 0.0, along], turn).unwrap();
            source.wrench_on(&source, &pose, WRENCH_ACCURACY).unwrap()
        };
        let spans = &design.segments()[0].spans;
        // The rings draw the rod together until its stiffness holds them: Newton's method from the unstrained length.
        let unstrained = ring.length + spans.iter().map(|span| span.length).sum::<f64>();
        let compliance: f64 = spans.iter().map(|span| span.length / span.stiffness.axial).sum();
        let pull = |distance: f64| wrench(0.0, 0.0, distance).force.z;
        let mut distance = unstrained;
        for _ in 0..20 {
            let slope = (pull(distance + 1e-6) - pull(distance - 1e-6)) / 2e-6;
            distance -= (distance - unstrained - compliance * pull(distance)) / (1.0 - compliance * slope);
        }
        let axial = pull(distance);
        // Columns: moment and lateral force at the clamped base; rows: w, t, m, V.
        let mut state = Matrix4x2::zeros();
        (state[(2, 0)], state[(3, 1)]) = (1.0, 1.0);
        for span in spans {
            let (stretch, shear) = (1.0 + axial / span.stiffness.axial, 1.0 / span.stiffness.shear);
            let turn = stretch - axial * shear;
            #[rustfmt::skip]
        let rates = Matrix4::new(
            0.0, turn,         0.0,                           shear,
            0.0, 0.0,          1.0 / span.stiffness.bending,  0.0,
            0.0, axial * turn, 0.0,                           axial * shear - stretch,
            0.0, 0.0,          0.0,                           0.0,
        );
            state = (rates * span.length).exp() * state;
        }
        let slope = |aside: f64, turned: f64, pick: fn(&Wrench) -> f64| {
            let [ahead, back] = [1.0, -1.0].map(|sign| pick(&wrench(sign * aside, sign * turned, distance)));
            0.5 * (ahead - back) / (aside + turned)
        };
        let slopes = |pick: fn(&Wrench) -> f64| [slope(1e-6, 0.0, pick), slope(0.0, 1e-3, pick)];
        let ([force_w, force_t], [torque_w, torque_t]) = (slopes(|w| w.force.x), slopes(|w| w.torque.y));
        let lateral = RowVector4::new(force_w, force_w * half + force_t, 0.0, -1.0);
        let moment = RowVector4::new(torque_w, torque_w * half + torque_t - half * axial, -1.0, half);
        let conditions = Matrix2::from_rows(&[lateral * state, moment * state]);
        Self { conditions, end: state, half }
    }

    /// Displacement and rotation of the ring by a lateral force on it.
    fn pushed(&self, force: f64) -> [f64; 2] {
        let base = self.conditions.lu().solve(&Vector2::new(-force, 0.0)).expect("no critical load");
        let end = self.end * base;
        [end[0] + self.half * end[1], end[1]]
    }
}

#[test]
fn attraction_softens_a_segment_as_it_does_a_beam_column() {
    let force = 1e-6;
    let mut softened = 0.0_f64;
    for length in [1.6e-3, 2.2e-3, 3e-3, 3.5e-3, 4e-3, 6e-3] {
        let settings = Settings { interaction: Interaction::Rings, ..Settings::default() };
        let mut equilibrium = Equilibrium::new(&design(length).unwrap(), None, settings, 2).unwrap();
        let mut inputs = Inputs::unloaded(2);
        inputs.ring_forces[1].x = force;
        assert!(equilibrium.solve(&inputs).unwrap().solved());
        let tip = equilibrium.rings().nth(1).unwrap();
        let bare = Settings { interaction: Interaction::None, ..settings };
        let mut free = Equilibrium::new(&design(length).unwrap(), None, bare, 2).unwrap();
        free.solve(&inputs).unwrap();
        softened = softened.max(tip.axis().x / free.tip().axis().x);
        let expected = BeamColumn::new(length).pushed(force);
        assert_close(
            format!("{length} m"),
            &[tip.position.x / 1e-3, tip.axis().x],
            &[expected[0] / 1e-3, expected[1]],
            ADJACENT,
        );
    }
    assert!((softened - 1.0).abs() > 1e3 * ADJACENT, "the attraction counts: {softened}");
    println!("turned up to {softened} times as far");
}

#[test]
fn no_gap_that_a_helix_can_have_lets_the_rings_turn_it_over() {
    // Two windings and their ends have no room in less than 1.396 mm. The determinant is that of the free column far away.
    let shortest = Helix::paper().radius * Helix::paper().boundary_angle;
    for step in 0..200 {
        let length = shortest * (1.001 + 0.02 * f64::from(step));
        let determinant = BeamColumn::new(length).conditions.determinant();
        assert!(determinant < 0.0, "{length} m: {determinant}");
    }
    assert!(BeamColumn::new(1.0).conditions.determinant() < 0.0);
}
