//! Columns clamped at both ends, pressed against one wall.
//!
//! By symmetry half of each is computed, whose far end keeps its direction. It bends in a plane.

use core::f64::consts::PI;

use mcm::equilibrium::{Equilibrium, Inputs, Solution};
use nalgebra::{DVector, Vector3};

use super::held::{Free, Held};
use super::{GAP, LENGTH, MODULUS, RADIUS, STIFF, bending_stiffness, design, model, solve, tube, wall_force};
use crate::tolerance::{CONTACT_PLACE, MARGIN_ALONG_LINE, MARGIN_AT_POINT, WALL_CLOSED_FORM};

/// Length of the whole column, m.
const WHOLE: f64 = 2.0 * LENGTH;

/// Mass per length of heavy columns, kg/m.
const DENSITY: f64 = 1e-5;

/// Force in units of which critical ones are whole numbers, N.
fn unit() -> f64 {
    bending_stiffness() * (PI / WHOLE).powi(2)
}

/// A column under an axial force (N) and a weight per length (N/m) towards the wall, with this moment (N m) on its far end.
fn inputs(axial: f64, weight: f64, moment: f64) -> Inputs {
    Inputs {
        tip_force: Vector3::new(0.0, 0.0, -axial),
        tip_moment: Vector3::new(0.0, moment, 0.0),
        gravity: Vector3::new(weight / DENSITY, 0.0, 0.0),
        ..Inputs::unloaded(0)
    }
}

fn direction(model: &Equilibrium) -> f64 {
    model.tip().axis().x
}

/// Of a moment that holds the far end.
fn moment_unit() -> f64 {
    1e-3 * bending_stiffness() / LENGTH
}

/// How much shorter the half is than its length under the axial force (N).
fn shortening(model: &Equilibrium, axial: f64) -> f64 {
    LENGTH - model.tip().position.z - axial * LENGTH / (MODULUS * PI * RADIUS * RADIUS)
}

/// Half the square of these slopes, by the phase up to `turn`, over a length.
fn shortening_by(slope: impl Fn(f64) -> f64, turn: f64, length: f64) -> f64 {
    let parts = 1000;
    let squares = (0..parts).map(|i| slope(turn * (f64::from(i) + 0.5) / f64::from(parts)).powi(2));
    0.5 * squares.sum::<f64>() * length / f64::from(parts)
}

/// A clamped column of length `L` pressed against one wall at a distance `h` touches it in one point from `P L^2/(pi^2 K) = 4` to 16:
/// with 98.257 and 301.095 `K h/L^3` at 6 and 10.
///
/// In its plane it is as stable as its halves between clamps, which buckle at 16.
#[test]
fn pressed_column_touches_in_a_point_as_in_closed_form() {
    let mut model = model(&design(LENGTH, DENSITY), 8, &tube(STIFF));
    let plane = Free::in_plane(&mut model);
    let start = Vector3::new(1e-2 * unit(), 0.0, -4.5 * unit());
    solve(&mut model, &Inputs { tip_force: start, ..Inputs::unloaded(0) });
    let (mut shape, mut moment) = (plane.weighted(&model), 0.0);
    for (times, tabulated) in
        [(4.2, None), (6.0, Some(98.257)), (10.0, Some(301.095)), (14.0, None), (15.9, None)]
    {
        let axial = times * unit();
        let inputs = |moment: f64| inputs(axial, 0.0, moment);
        let mut held = Held::new(&mut model, &plane, &inputs, &direction, moment_unit());
        held.solve(&mut shape, &mut moment);
        let margin = held.smallest(&shape, moment) - (1.0 - times / 16.0);
        let wave = (axial / bending_stiffness()).sqrt();
        let turn = 0.25 * wave * WHOLE;
        let force = axial * GAP * wave / (turn - turn.tan());
        let scaled = force * WHOLE.powi(3) / (bending_stiffness() * GAP);
        assert!(tabulated.is_none_or(|known| (scaled - known).abs() < 1e-3), "{scaled} {tabulated:?}");
        // Two quarters of a wave.
        let slope = |x: f64| 0.5 * force / axial * (turn.tan() * x.sin() + x.cos() - 1.0);
        let wanted = 2.0 * shortening_by(slope, turn, turn / wave);
        let off = 2.0 * wall_force(&model) / force - 1.0;
        let shorter = shortening(&model, axial) / wanted - 1.0;
        println!("P = {times} pi^2 K/L^2: force {off:.1e}, shortening {shorter:.1e}, margin {margin:.1e}");
        assert!(off.abs() < WALL_CLOSED_FORM && shorter.abs() < WALL_CLOSED_FORM, "{off} {shorter}");
        assert!(margin.abs() < MARGIN_AT_POINT, "{margin}");
    }
}

/// Without contact it buckles at 4.
#[test]
fn a_column_between_clamps_buckles_as_in_closed_form() {
    let mut model = model(&design(LENGTH, DENSITY), 8, &tube(STIFF));
    let plane = Free::in_plane(&mut model);
    let straight = plane.weighted(&model);
    for times in [3.9, 4.1] {
        let inputs = |moment: f64| inputs(times * unit(), 0.0, moment);
        let margin =
            Held::new(&mut model, &plane, &inputs, &direction, moment_unit()).smallest(&straight, 0.0);
        println!("P = {times} pi^2 K/L^2: margin {margin}");
        assert!((margin - (1.0 - times / 4.0)).abs() < WALL_CLOSED_FORM, "{margin}");
    }
}

/// A heavy column that lies on the wall along a line.
struct Line {
    /// Length of its free ends, m.
    end: f64,
    /// `k` times that.
    turn: f64,
    /// Weight per length over `P k^2`, m.
    sag: f64,
}

impl Line {
    /// The one with free ends of this length and a weight of which `h = 2 sag lightness^2`.
    ///
    /// The fourth and second derivatives obey `w4/k^2 + w2 = k^2 sag`; at the end of the free length the deflection is `h`, slope and
    /// curvature are 0: `h = 2 sag (1 - turn/2 cot(turn/2))^2`. Without weight `turn = 2 pi`.
    fn new(end: f64, lightness: f64) -> Self {
        let [mut below, mut above] = [0.5 * PI, PI];
        for _ in 0..60 {
            let half = 0.5 * (below + above);
            *(if 1.0 - half / half.tan() < lightness { &mut below } else { &mut above }) = half;
        }
        Self { end, turn: below + above, sag: 0.5 * GAP / (lightness * lightness) }
    }

    fn wave(&self) -> f64 {
        self.turn / self.end
    }

    fn axial(&self) -> f64 {
        bending_stiffness() * self.wave().powi(2)
    }

    /// Per length.
    fn weight(&self) -> f64 {
        self.sag * self.axial() * self.wave().powi(2)
    }

    /// Force of the wall where one free end lifts off.
    fn lift_off(&self) -> f64 {
        let (sin, cos) = self.turn.sin_cos();
        self.sag * self.axial() * self.wave() * (self.turn - sin) / (1.0 - cos)
    }

    /// Shortening by one free end.
    fn shortening(&self) -> f64 {
        let (sin, cos) = self.turn.sin_cos();
        let even = 1.0 - self.turn * sin / (1.0 - cos);
        let odd = (self.turn * cos - sin) / (1.0 - cos);
        let slope = |x: f64| self.wave() * self.sag * (even * x.sin() + odd * (1.0 - x.cos()) + x);
        shortening_by(slope, self.turn, self.end)
    }
}

/// Without weight the column lies on the wall from 16 to 36, between free ends of `2 pi/k` that press with `P h k/(2 pi)` where they
/// lift off; it is shorter by 3 to 4.5 `h^2/L`.
#[test]
fn a_light_column_lies_on_the_wall_as_tabulated() {
    for (times, shortening, free) in [(16.0, 3.0, 0.5), (36.0, 4.5, 1.0 / 3.0)] {
        let line = Line::new(free * WHOLE, 1e6);
        let found = [
            line.axial() / unit() / times,
            2.0 * line.shortening() * WHOLE / (GAP * GAP) / shortening,
            line.lift_off() * line.end / (line.axial() * GAP),
        ];
        assert!(found.iter().all(|ratio| (ratio - 1.0).abs() < 1e-5), "{found:?}");
    }
}

/// The wall's modulus, a lightness and the elements of the free end.
const LYING: [(f64, f64, f64); 6] = [
    (1e5, 10.0, 7.0),
    (1e6, 10.0, 7.0),
    (1e7, 10.0, 7.0),
    (1e7, 10.0, 6.0),
    (1e7, 10.0, 5.0),
    (1e7, 40.0, 7.0),
];

/// Under a dead load alone nothing holds a column that lies on the wall: its free ends are columns between clamps at their critical
/// load. A weight towards the wall holds it, here from 9 % of what the wall bears down to 0.2 %.
#[test]
fn pressed_column_lies_on_the_wall_as_in_closed_form() {
    let mut now = [0.0, 300.0 * bending_stiffness() * GAP / LENGTH.powi(4)];
    let (mut shape, mut moment, mut last) = (DVector::zeros(0), 0.0, f64::INFINITY);
    for (modulus, lightness, elements) in LYING {
        let mut model = model(&design(LENGTH, DENSITY), 8, &tube(modulus));
        let plane = Free::in_plane(&mut model);
        if shape.is_empty() {
            solve(&mut model, &inputs(now[0], now[1], 0.0));
            shape = plane.weighted(&model);
        }
        let line = Line::new(elements / 8.0 * LENGTH, lightness);
        let [axial, weight] = now;
        let mut margin = 0.0;
        for part in [0.2, 0.4, 0.6, 0.8, 1.0] {
            now = [axial + part * (line.axial() - axial), weight * (line.weight() / weight).powf(part)];
            let inputs = |moment: f64| inputs(now[0], now[1], moment);
            let mut held = Held::new(&mut model, &plane, &inputs, &direction, moment_unit());
            held.solve(&mut shape, &mut moment);
            margin = held.smallest(&shape, moment);
        }
        let walls = model.wall().expect("a vessel");
        let borne = line.weight() * (LENGTH - line.end);
        let force = line.lift_off() + borne;
        let about = line.lift_off() * line.end + 0.5 * borne * (LENGTH + line.end);
        let found = walls.places.iter().map(|[place, force]| -place.z * force.x).sum::<f64>();
        let off = wall_force(&model) / force - 1.0;
        let place = (found / wall_force(&model) - about / force) / LENGTH;
        let shorter = shortening(&model, line.axial()) / line.shortening() - 1.0;
        let wanted = 1.0 - (0.5 * line.turn / PI).powi(2);
        println!(
            "wall of {modulus:.0e} Pa, P = {:.1} pi^2 K/L^2, {:.1e} of the force is weight: force {off:.1e}, shortening {shorter:.1e}, \
            place {place:.1e}, margin {margin:.4} beside {wanted:.4}",
            line.axial() / unit(),
            borne / force
        );
        assert!((margin - wanted).abs() < MARGIN_ALONG_LINE, "{margin} {wanted}");
        let worst = off.abs().max(shorter.abs());
        if modulus < 1e7 {
            assert!(worst < 0.2 * last, "{worst} after {last}");
            last = worst;
        } else {
            assert!(worst < WALL_CLOSED_FORM && place.abs() < CONTACT_PLACE, "{off} {shorter} {place}");
        }
    }
}
