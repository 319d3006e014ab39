//! Loads that are not magnetic, and what carries them: weight, tip and ring loads, backbone, moving base.
//!
//! Small loads are compared with a beam of pieces whose stiffness and weight are written out here from the paper's
//! formulas: rings are rigid, the tube runs through all.

use core::f64::consts::PI;

use mcm::design::{Backbone, Design, Helix, Modulus, Segmented, Specification};
use mcm::equilibrium::{Equilibrium, Inputs, Interaction, PlacedSource, Settings, Solution};
use mcm::geometry::{Pose, RotationVector};
use nalgebra::Vector3;

use crate::given::{pair, unloaded_beside_pair};
use crate::tolerance::{LAW, LINEAR, SUPERPOSED, assert_close};

const SEGMENTS: usize = 2;

/// Angle at the tip of a small load, rad: its square is far below [`LINEAR`].
const SMALL: f64 = 1e-5;

/// One ring, disc or core with its part of the tube.
struct Piece {
    start: f64,
    length: f64,
    bending_compliance: f64,
    shear_compliance: f64,
    axial_compliance: f64,
    line_mass: f64,
}

/// A straight cantilever under small loads.
struct Beam {
    pieces: Vec<Piece>,
    length: f64,
}

fn tube_area(outer: f64, inner: f64) -> f64 {
    PI * (outer * outer - inner * inner)
}

fn tube_inertia(outer: f64, inner: f64) -> f64 {
    PI * (outer.powi(4) - inner.powi(4)) / 4.0
}

impl Beam {
    /// Eq. (2), (3), (12) to (15) of Richter et al., with the backbone's stiffness and mass added.
    fn new(chain: &Segmented) -> Self {
        let Helix {
            length, radius, windings, core_outer_radius, core_inner_radius, shore_a, poisson, ..
        } = chain.helix;
        let pitch = radius * chain.helix.boundary_angle / windings;
        let height = (length - windings * pitch) / (2.0 + windings);
        let sector = 2.0 * PI * height / (height + pitch);
        let gent =
            |hardness: f64| 0.0981e6 * (56.0 + 7.66 * hardness) / (0.137_505 * (254.0 - 2.54 * hardness));
        let fraction = chain.helix.volume_fraction;
        let stiffening = (2.5 * fraction / (1.0 - 1.35 * fraction)).exp();
        let (young, shear) =
            (gent(shore_a) * stiffening, gent(shore_a) * stiffening / (2.0 * (1.0 + poisson)));
        let density = chain.helix.density.unwrap_or(7000.0 * fraction + 1000.0 * (1.0 - fraction));
        let tube = chain.backbone.map_or([0.0; 4], |tube| {
            let young = match tube.modulus {
                Modulus::ShoreA(hardness) => gent(hardness),
                Modulus::Elastic(young) => young,
            };
            let area = tube_area(tube.outer_radius, tube.inner_radius);
            let inertia = tube_inertia(tube.outer_radius, tube.inner_radius);
            let shear = young / (2.0 * (1.0 + tube.poisson));
            [young * inertia, shear * area, young * area, tube.density * area]
        });
        let mut pieces = Vec::new();
        let mut start = 0.0;
        let mut add = |length: f64, solid: Option<f64>, line_mass: f64| {
            let compliance = |stiffness: &dyn Fn(f64) -> f64, tube: f64| {
                solid.map_or(0.0, |outer| 1.0 / (stiffness(outer) + tube))
            };
            pieces.push(Piece {
                start,
                length,
                bending_compliance: compliance(&|r| young * tube_inertia(r, core_inner_radius), tube[0]),
                shear_compliance: compliance(&|r| shear * tube_area(r, core_inner_radius), tube[1]),
                axial_compliance: compliance(&|r| young * tube_area(r, core_inner_radius), tube[2]),
                line_mass: line_mass + tube[3],
            });
            start += length;
        };
        let ring_mass = chain.ring.density * tube_area(radius, core_inner_radius);
        let disc_mass = density * tube_area(radius, core_inner_radius);
        let spiral = 0.5 * sector * (radius * radius - core_outer_radius * core_outer_radius);
        let core_mass = density * (tube_area(core_outer_radius, core_inner_radius) + spiral);
        add(chain.ring.length, None, ring_mass);
        for _ in 0..chain.segments {
            add(height, Some(radius), disc_mass);
            add(length - 2.0 * height, Some(core_outer_radius), core_mass);
            add(height, Some(radius), disc_mass);
            add(chain.ring.length, None, ring_mass);
        }
        Self { length: start, pieces }
    }

    /// The deflection at `place` by a force of 1 N across at `force`: the unit load theorem, with Simpson's rule, which
    /// is exact here.
    fn influence(&self, force: f64, place: f64) -> f64 {
        let end = force.min(place);
        let on_piece = |piece: &Piece| {
            let length = (end - piece.start).clamp(0.0, piece.length);
            let levers = |s: f64| (force - s) * (place - s);
            let (from, to) = (piece.start, piece.start + length);
            let mean = (levers(from) + 4.0 * levers(0.5 * (from + to)) + levers(to)) / 6.0;
            length * (piece.bending_compliance * mean + piece.shear_compliance)
        };
        self.pieces.iter().map(on_piece).sum()
    }

    /// The tip's deflection in a field of gravity across, m.
    fn sag(&self, gravity: f64) -> f64 {
        let by_weight = |piece: &Piece| {
            let at = |part: f64| self.influence(piece.start + part * piece.length, self.length);
            // Of third degree in the force's place; Boole's rule is exact to the fifth.
            let boole = 7.0 * (at(0.0) + at(1.0)) + 32.0 * (at(0.25) + at(0.75)) + 12.0 * at(0.5);
            piece.line_mass * piece.length * boole / 90.0
        };
        gravity * self.pieces.iter().map(by_weight).sum::<f64>()
    }

    /// The tip's angle by a moment of 1 N m at it.
    fn rotation(&self) -> f64 {
        self.pieces.iter().map(|piece| piece.length * piece.bending_compliance).sum()
    }

    /// The tip's way along the axis by a force of 1 N at it.
    fn extension(&self) -> f64 {
        self.pieces.iter().map(|piece| piece.length * piece.axial_compliance).sum()
    }
}

fn chain(backbone: Option<Backbone>) -> Segmented {
    let Specification::Segmented(paper) = Specification::paper(SEGMENTS) else { unreachable!() };
    Segmented { backbone, ..paper }
}

/// Without a backbone, and with either of the presets.
fn chains() -> [(&'static str, Segmented); 3] {
    [
        ("no backbone", chain(None)),
        ("silicone", chain(Some(Backbone::silicone()))),
        ("PTFE", chain(Some(Backbone::ptfe()))),
    ]
}

fn equilibrium(chain: &Segmented, interaction: Interaction) -> Equilibrium {
    let design = Design::new(Specification::Segmented(chain.clone())).expect("allowed");
    let settings = Settings { interaction, ..Settings::default() };
    Equilibrium::new(&design, Some(&pair()), settings, 2).expect("allowed")
}

fn solved(equilibrium: &mut Equilibrium, inputs: &Inputs) {
    let report = equilibrium.solve(inputs).expect("finite inputs");
    assert!(report.solved() && report.snaps == 0, "{report:?}");
}

fn unloaded() -> Inputs {
    unloaded_beside_pair(SEGMENTS + 1)
}

#[test]
fn small_tip_loads_bend_as_a_beam_with_the_backbone_beside() {
    for (name, chain) in chains() {
        let beam = Beam::new(&chain);
        let mut device = equilibrium(&chain, Interaction::None);
        let force = SMALL * beam.length / beam.influence(beam.length, beam.length);
        solved(&mut device, &Inputs { tip_force: Vector3::new(0.0, force, 0.0), ..unloaded() });
        let expected = force * beam.influence(beam.length, beam.length);
        assert_close((name, "across"), &[device.tip().position.y], &[expected], LINEAR);
        let force = SMALL * beam.length / beam.extension();
        solved(&mut device, &Inputs { tip_force: Vector3::new(0.0, 0.0, force), ..unloaded() });
        let stretch = device.tip().position.z - beam.length;
        assert_close((name, "along"), &[stretch], &[force * beam.extension()], LINEAR);
    }
}

#[test]
fn a_tip_moment_bends_to_an_arc_of_any_angle_with_the_backbone_beside() {
    for (name, chain) in chains() {
        let beam = Beam::new(&chain);
        for angle in [0.1, 1.0] {
            let mut device = equilibrium(&chain, Interaction::None);
            let tip_moment = Vector3::new(-angle / beam.rotation(), 0.0, 0.0);
            solved(&mut device, &Inputs { tip_moment, ..unloaded() });
            let axis = device.tip().axis();
            assert_close((name, angle), &[axis.y.atan2(axis.z)], &[angle], LAW);
        }
    }
}

#[test]
fn every_mass_sags_as_a_beam_of_its_density() {
    for (name, chain) in chains() {
        let mut rings = Segmented { helix: Helix { density: Some(0.0), ..chain.helix }, ..chain.clone() };
        let mut helices = chain.clone();
        helices.ring.density = 0.0;
        let tube = Segmented { ring: helices.ring, ..rings.clone() };
        for other in [&mut rings, &mut helices] {
            other.backbone.iter_mut().for_each(|tube| tube.density = 0.0);
        }
        for (heavy, chain) in [("rings", rings), ("helices", helices), ("backbone", tube), ("all", chain)] {
            let beam = Beam::new(&chain);
            let sag = beam.sag(1.0);
            if chain.backbone.is_none() && heavy == "backbone" {
                assert!(sag <= 0.0, "a mass that is not there: {sag}");
                continue;
            }
            let gravity = SMALL * beam.length / sag;
            let mut device = equilibrium(&chain, Interaction::None);
            solved(&mut device, &Inputs { gravity: Vector3::new(0.0, -gravity, 0.0), ..unloaded() });
            assert_close((name, heavy), &[device.tip().position.y], &[-SMALL * beam.length], LINEAR);
        }
    }
}

#[test]
fn a_force_on_a_ring_moves_every_ring_as_a_beam() {
    let chain = chain(Some(Backbone::silicone()));
    let beam = Beam::new(&chain);
    let centres: Vec<f64> =
        (0..=SEGMENTS).map(|k| 0.5e-3 + k as f64 * (chain.helix.length + chain.ring.length)).collect();
    let mut device = equilibrium(&chain, Interaction::None);
    for (loaded, &at) in centres.iter().enumerate().skip(1) {
        let force = SMALL * beam.length / beam.influence(at, beam.length);
        let mut inputs = unloaded();
        inputs.ring_forces[loaded].x = force;
        solved(&mut device, &inputs);
        let got: Vec<f64> = device.rings().map(|ring| ring.position.x).collect();
        let expected: Vec<f64> = centres.iter().map(|&place| force * beam.influence(at, place)).collect();
        assert_close(loaded, &got, &expected, LINEAR);
    }
    // The clamped ring takes its force itself.
    let mut inputs = unloaded();
    inputs.ring_forces[0].x = 1.0;
    solved(&mut device, &inputs);
    assert!(device.tip().position.x.abs() <= LAW * beam.length);
    assert_close("clamp", device.base_reaction().force.as_slice(), &[-1.0, 0.0, 0.0], LAW);
}

/// Every kind of load, small; the attraction of the rings is there throughout.
fn small_loads() -> [Inputs; 5] {
    let mut loads = [0; 5].map(|_| unloaded());
    loads[0].gravity = Vector3::new(2e-3, -1e-3, 3e-3);
    loads[1].tip_force = Vector3::new(-1e-7, 2e-7, 1e-7);
    loads[2].tip_moment = Vector3::new(2e-9, 1e-9, -3e-9);
    loads[3].ring_forces[1] = Vector3::new(1e-7, 1e-7, -2e-7);
    loads[4].uniform_field = Vector3::new(2e-7, -1e-7, 0.0);
    loads
}

#[test]
fn small_loads_superpose() {
    for interaction in [Interaction::None, Interaction::Rings, Interaction::Full] {
        let chain = chain(Some(Backbone::silicone()));
        let mut device = equilibrium(&chain, interaction);
        solved(&mut device, &unloaded());
        let rest = device.tip().position;
        let mut together = unloaded();
        let mut sum = Vector3::zeros();
        for load in small_loads() {
            solved(&mut device, &load);
            let moved = device.tip().position - rest;
            assert!(moved.norm() > 0.01 * SMALL * rest.norm(), "{load:?} moves nothing: {moved}");
            sum += moved;
            together.gravity += load.gravity;
            together.tip_force += load.tip_force;
            together.tip_moment += load.tip_moment;
            together.ring_forces[1] += load.ring_forces[1];
            together.uniform_field += load.uniform_field;
        }
        solved(&mut device, &together);
        let moved = device.tip().position - rest;
        assert_close(interaction, moved.as_slice(), sum.as_slice(), SUPERPOSED);
    }
}

/// The base inserted along its axis or turned about it, the magnet fixed, is the base fixed and the magnet moved the
/// other way: step by step, on one branch.
#[test]
fn only_where_the_magnet_is_seen_from_the_base_counts() {
    let chain = chain(None);
    let (mut inserted, mut still) =
        (equilibrium(&chain, Interaction::Rings), equilibrium(&chain, Interaction::Rings));
    let mut angles = Vec::new();
    for step in 0..=20 {
        let part = f64::from(step) / 20.0;
        let mut inputs = unloaded();
        let pose = Pose::new([0.0, -0.08, 0.02], [0.6, 0.8, 0.0, 0.0]).expect("a pose");
        inputs.sources = vec![PlacedSource { pose, strength: 1.0 }];
        inputs.base = Pose {
            position: Vector3::new(0.0, 0.0, 0.04 * part - 0.02),
            rotation: RotationVector::new(Vector3::new(0.0, 0.0, 2.0 * part)).matrix(),
        };
        solved(&mut inserted, &inputs);
        let back = inputs.base.rotation.transpose();
        let seen = Pose {
            position: back * (inputs.sources[0].pose.position - inputs.base.position),
            rotation: back * inputs.sources[0].pose.rotation,
        };
        solved(
            &mut still,
            &Inputs {
                sources: vec![PlacedSource { pose: seen, strength: 1.0 }],
                base: Pose::identity(),
                ..inputs.clone()
            },
        );
        let (one, two) = (inserted.tip(), inputs.base.compose(&still.tip()));
        assert_close(step, one.position.as_slice(), two.position.as_slice(), LAW);
        assert_close(step, one.rotation.as_slice(), two.rotation.as_slice(), LAW);
        let (one, two) = (inserted.base_reaction(), still.base_reaction());
        assert_close(step, one.force.as_slice(), (inputs.base.rotation * two.force).as_slice(), LAW);
        angles.push(inserted.tip().axis().angle(&inputs.base.axis()).to_degrees());
    }
    assert!((angles[20] - angles[0]).abs() > 1.0, "no test of the insertion: {angles:?}");
}
