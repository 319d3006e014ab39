//! What no level counts: spans acting on spans. Its size, by the forces between the magnetic charges of one segment.
//!
//! Beside the record of `tests/bench/spans_on_spans.py`, which takes differences of energies: here the virtual work of the
//! forces at one bend, on lattices of point charges.

use core::f64::consts::TAU;

use mcm::constants::VACUUM_PERMEABILITY;
use mcm::design::{Design, Span, SpanKind, Specification, Spiral};
use mcm::geometry::RotationVector;
use nalgebra::Vector3;

use crate::tolerance::SPANS_AMONG_THEMSELVES;

/// Cells of the lattices across the spiral's width.
const CELLS: [usize; 2] = [6, 12];

/// The record: by how much of the elastic moment of a core spans on spans would soften it, in percent.
const RECORD: &str = include_str!("../bench/spans_on_spans.csv");

/// A point charge, A m, how it lies in its section, and the section's arc length.
struct Charge {
    strength: f64,
    section: f64,
    local: Vector3<f64>,
}

/// Adds the charges of a sheet between two radii and two angles, on the section `place` gives for an angle.
fn sheet(
    out: &mut Vec<Charge>,
    magnetisation: f64,
    [inner, outer]: [f64; 2],
    [first, last]: [f64; 2],
    cells: usize,
    place: impl Fn(f64) -> (f64, f64),
) {
    // As many cells around as make them about square, the same for parts of a sheet that lie above one another.
    let around = ((last - first) / TAU * 12.0 * cells as f64).round() as usize;
    let (width, turn) = ((outer - inner) / cells as f64, (last - first) / around as f64);
    for i in 0..cells {
        let radius = inner + (i as f64 + 0.5) * width;
        for k in 0..around {
            let angle = first + (k as f64 + 0.5) * turn;
            let (section, ahead) = place(angle);
            out.push(Charge {
                strength: magnetisation * radius * width * turn,
                section,
                local: Vector3::new(radius * angle.cos(), radius * angle.sin(), ahead),
            });
        }
    }
}

/// How the windings follow the bend.
#[derive(Clone, Copy)]
enum Motion {
    /// Every section of the spiral moves with that of the rod.
    Sections,
    /// A winding does not stretch: at every angle the gaps between windings share the bend in proportion.
    Windings,
}

impl Motion {
    /// Its name in the record.
    fn name(self) -> &'static str {
        match self {
            Self::Sections => "sections",
            Self::Windings => "windings",
        }
    }

    /// The section that carries the spiral at an angle, as part of the core, where its own is at `height`.
    fn carrier(self, spiral: &Spiral, angle: f64, height: f64) -> f64 {
        let (turn, rest) = ((angle / TAU).floor(), angle.rem_euclid(TAU));
        match self {
            Self::Sections => height,
            Self::Windings => {
                let gap = (rest - spiral.sector_angle).max(0.0) / (TAU - spiral.sector_angle);
                (turn + gap) / spiral.windings
            }
        }
    }
}

/// The charges of disc, core and disc: faces of the discs and flanks of the spiral. The magnetisation keeps its size and
/// stays normal to sections that stay plane, so that no charge arises elsewhere and none changes.
fn charges(disc: &Span, core: &Span, spiral: &Spiral, motion: Motion, cells: usize) -> Vec<Charge> {
    let mut out = Vec::new();
    let strength = core.magnetisation;
    let width = [spiral.inner_radius, spiral.outer_radius];
    let tube = [disc.inner_radius, spiral.inner_radius];
    let (sector, turns) = (spiral.sector_angle, TAU * spiral.windings);
    for (sign, section, ahead) in [(-1.0, 0.0, -disc.length), (1.0, core.length, disc.length)] {
        let face = |_| (section, ahead);
        sheet(&mut out, sign * strength, tube, [0.0, TAU], (cells / 4).max(1), face);
        sheet(&mut out, sign * strength, width, [0.0, TAU], cells, face);
        let inside = |_| (section, 0.0);
        sheet(&mut out, -sign * strength, width, [sector, TAU], cells, inside);
    }
    // In the parts that lie above the sector and above the rest of the circle.
    let mut from = 0.0;
    while from < turns - 1e-9 {
        for (sign, behind) in [(1.0, 0.0), (-1.0, sector)] {
            let flank = |angle: f64| {
                let height = (angle - behind) / turns;
                let carrier = motion.carrier(spiral, angle, height);
                (carrier * core.length, (height - carrier) * core.length)
            };
            let whole = [from, from + sector, from + TAU, from + TAU + sector];
            let parts = if behind > 0.0 { &whole[1..] } else { &whole[..3] };
            for part in parts.windows(2) {
                sheet(&mut out, sign * strength, width, [part[0], part[1]], cells, flank);
            }
        }
        from += TAU;
    }
    out
}

/// Derivative of the energy by the core's bend about `x` (N m), by the work of the forces between the charges.
fn moment(charges: &[Charge], length: f64, bend: f64) -> f64 {
    let mut points = Vec::with_capacity(charges.len());
    for charge in charges {
        let part = charge.section / length;
        let turned = RotationVector::new(Vector3::x() * (part * bend)).matrix() * charge.local;
        let (sine, cosine) = (part * bend).sin_cos();
        let radius = length / bend;
        let centre = Vector3::new(0.0, -radius * (1.0 - cosine), radius * sine);
        let swing = Vector3::new(0.0, -length * part * sine, length * part * cosine) / bend - centre / bend;
        points.push((charge.strength, centre + turned, swing + Vector3::x().cross(&turned) * part));
    }
    let mut sum = 0.0;
    for (i, (charge, at, velocity)) in points.iter().enumerate() {
        let mut force = 0.0;
        for (other, place, moving) in &points[..i] {
            let arm = at - place;
            let square = arm.norm_squared();
            force += other * arm.dot(&(velocity - moving)) / (square * square.sqrt());
        }
        sum -= charge * force;
    }
    VACUUM_PERMEABILITY / (2.0 * TAU) * sum
}

/// The recorded share for one segment, sections that stay plane and a magnetisation that keeps its size.
fn recorded(motion: Motion, bend: f64) -> f64 {
    let start = format!("helical,{},steady,1,x,{bend},", motion.name());
    let row =
        RECORD.lines().find_map(|line| line.strip_prefix(&start)).unwrap_or_else(|| panic!("no {start}"));
    0.01 * row.split(',').next().unwrap().parse::<f64>().unwrap()
}

#[test]
fn spans_would_bend_one_another_as_recorded() {
    let design = Design::new(Specification::paper(1)).unwrap();
    let [disc, core, far] = &design.segments()[0].spans[..] else { panic!("disc, core, disc") };
    assert_eq!([disc.kind, core.kind, far.kind], [SpanKind::Disc, SpanKind::Core, SpanKind::Disc]);
    let spiral = core.spiral.as_ref().unwrap();
    for motion in [Motion::Sections, Motion::Windings] {
        let lattices = CELLS.map(|cells| charges(disc, core, spiral, motion, cells));
        for bend in [10.0_f64, 30.0] {
            let angle = bend.to_radians();
            let elastic = core.stiffness.bending * angle / core.length;
            // Bent both ways: a helical spiral also has a moment when straight, which bends the rest shape.
            let [coarse, fine] = lattices.each_ref().map(|lattice| {
                let [there, back] = [angle, -angle].map(|angle| moment(lattice, core.length, angle));
                0.5 * (back - there) / elastic
            });
            let (name, expected) = (motion.name(), recorded(motion, bend));
            println!("{name}, {bend} deg: {coarse:.5}, {fine:.5} of the elastic moment, recorded {expected}");
            let [far, near] = [coarse, fine].map(|share| (share - expected).abs());
            assert!(near <= SPANS_AMONG_THEMSELVES, "{name}, {bend} deg: {fine}, expected {expected}");
            assert!(near < 0.5 * far, "{name}, {bend} deg: {coarse}, {fine} do not converge to {expected}");
        }
    }
}
