//! Entries of the budget: each quantity, its uncertainty or error, and how it enters the model.

use nalgebra::Vector3;
use serde::Serialize;

use crate::design::{
    Backbone, Design, Segmented, Specification, composite_density, gent_hardness, gent_modulus,
};
use crate::equilibrium::{Interaction, Settings};
use crate::error::Error;
use crate::manipulator::{Inputs, Manipulator, Status};

/// Standard gravity, m/s2.
const GRAVITY: f64 = 9.80665;

/// Relative change of the bending stiffness by the magnetic action of spans on spans, which no level includes: with
/// sections that follow the rod, and with the motion of core and spiral by finite elements
/// (`tests/bench/spans_on_spans.csv`, helical, 20 degrees).
const SPANS_ON_SPANS: &[f64] = &[-0.031, -0.076];

/// Relative change of the core's bending stiffness by the spiral, which is moulded to it but modelled as magnetised
/// mass only: about the two transverse axes of a core between discs and rings, by finite elements
/// (`tests/bench/spiral_stiffness.csv`).
const SPIRAL_STIFFNESS: &[f64] = &[0.168, 0.221];

/// Kind of a budget entry.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Serialize)]
#[serde(rename_all = "lowercase")]
pub enum BudgetKind {
    /// All tolerances together.
    Combined,
    /// A quantity of the model that is known to some tolerance.
    Tolerance,
    /// An effect that the model omits by default.
    Omission,
    /// A comparison of the model with a measurement of the paper.
    Paper,
}

/// A device in a transverse field.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct BudgetScene {
    /// Its name.
    pub name: &'static str,
    /// Number of segments of the paper's design.
    pub segments: usize,
    /// Transverse field, T.
    pub field: f64,
}

/// The scenes of the budget; the first gives the order and the numbers in the chart. The rings of three segments snap
/// together at 17.8 mT, so that their field is well below.
pub const BUDGET_SCENES: [BudgetScene; 2] = [
    BudgetScene { name: "1 segment, 20 mT", segments: 1, field: 20e-3 },
    BudgetScene { name: "3 segments, 10 mT", segments: 3, field: 10e-3 },
];

/// Prefixes of the quantities that the paper's figures compare with a measured number, and their names in the budget.
/// Three segments within 20 mT are omitted, as the direction of the field is not printed.
pub(super) const MEASURED: [(&str, &str); 3] = [
    ("more tip angle by the base ring", "Fig. 7A: gain of angle from the base ring, 31 %"),
    ("solid cylinder, 20 mT", "Fig. 7B: tip angle of the solid cylinder, 16 deg"),
    ("largest axial force on nine segments", "Fig. 7C: axial force on nine segments, 0.09 N"),
];

/// A device with its model settings, field and gravity.
#[derive(Debug, Clone)]
pub(super) struct Setup {
    chain: Segmented,
    settings: Settings,
    /// Magnitude (T) and direction (deg from the base's axis) of the field.
    field: [f64; 2],
    /// Gravitational acceleration along the transverse axis in which the field bends the device, m/s2.
    gravity: f64,
    /// Additional distance between adjacent rings, m.
    spacing: f64,
}

impl Setup {
    /// The scene at the level `full`; if `weighed`, with the weight in the direction in which the field bends it.
    pub(super) fn new(scene: &BudgetScene, weighed: bool) -> Self {
        Self {
            chain: Segmented::paper(scene.segments),
            settings: Settings { interaction: Interaction::Full, ..Settings::default() },
            field: [scene.field, 90.0],
            gravity: if weighed { GRAVITY } else { 0.0 },
            spacing: 0.0,
        }
    }

    /// Tip angle, rad; `None` if the device snaps on the way.
    pub(super) fn tip_angle(&self) -> Result<Option<f64>, Error> {
        let design = Design::new(Specification::Segmented(self.spaced()?))?;
        let mut manipulator = Manipulator::new(&design, None, self.settings, 2)?;
        let [size, direction] = self.field;
        let (sine, cosine) = direction.to_radians().sin_cos();
        let inputs = Inputs {
            uniform_field: Vector3::new(0.0, sine, cosine) * size,
            gravity: Vector3::y() * self.gravity,
            ..Inputs::unloaded(design.rings().count())
        };
        let outputs = manipulator.solve(&inputs)?;
        let stays = matches!(outputs.status, Status::Solved | Status::NearFold);
        Ok(stays.then_some(outputs.tip_angle))
    }

    /// Multiplies all stiffness of the helix by `1 + change`: scales the elastomer's modulus, its common factor.
    fn stiffen(&mut self, change: f64) {
        let hardness = &mut self.chain.helix.shore_a;
        *hardness = gent_hardness((1.0 + change) * gent_modulus(*hardness));
    }

    /// The chain with its rings further apart and unchanged cores between them: both closed ends of a helix grow.
    ///
    /// The pitch `p` grows with the height `h`, which keeps the spiral's section, so that the core has fewer windings.
    fn spaced(&self) -> Result<Segmented, Error> {
        let mut chain = self.chain.clone();
        if self.spacing != 0.0 {
            let before = chain.helix.geometry()?;
            let growth = 1.0 + 0.5 * self.spacing / before.height;
            let windings = before.core_length / (growth * (before.height + before.pitch));
            chain.helix.length += self.spacing;
            chain.helix.windings = windings;
            chain.helix.boundary_angle = growth * before.pitch * windings / chain.helix.radius;
        }
        Ok(chain)
    }
}

/// One entry of the budget.
pub(super) struct Entry {
    pub(super) kind: BudgetKind,
    pub(super) quantity: &'static str,
    /// Size of the change, as printed.
    pub(super) change: &'static str,
    /// The changes as arguments of `vary`.
    pub(super) steps: &'static [f64],
    /// Whether the weight acts.
    pub(super) weighed: bool,
    pub(super) vary: fn(&mut Setup, f64),
}

/// Applies a change to a device.
type Vary = fn(&mut Setup, f64);

const fn tolerance(quantity: &'static str, change: &'static str, steps: &'static [f64], vary: Vary) -> Entry {
    Entry { kind: BudgetKind::Tolerance, quantity, change, steps, weighed: false, vary }
}

const fn omission(quantity: &'static str, change: &'static str, steps: &'static [f64], vary: Vary) -> Entry {
    Entry { kind: BudgetKind::Omission, quantity, change, steps, weighed: false, vary }
}

/// Changes in metres, and as fractions.
const TENTH_MM: &[f64] = &[-1e-4, 1e-4];
const TWENTIETH_MM: &[f64] = &[-5e-5, 5e-5];
const ONE_PERCENT: &[f64] = &[-0.01, 0.01];
const TWO_PERCENT: &[f64] = &[-0.02, 0.02];
const FIVE_PERCENT: &[f64] = &[-0.05, 0.05];
const TEN_PERCENT: &[f64] = &[-0.1, 0.1];

/// The tolerances are those of hardness testers, of lengths cast in printed moulds, of magnets by their data sheets,
/// and of a coil system. On the omissions: data sheets give a recoil permeability of 1.05 for sintered `NdFeB`;
/// elastomers are nearly incompressible (the paper's ratio is 0.4); rings of grade N48, as used, have 1.37 to 1.42 T.
pub(super) static ENTRIES: [Entry; 21] = [
    tolerance("Shore A hardness of the elastomer", "±1", &[-1.0, 1.0], |s, d| s.chain.helix.shore_a += d),
    tolerance("remanence of the rings", "±2 %", TWO_PERCENT, |s, d| s.chain.ring.remanence *= 1.0 + d),
    tolerance("remanence of the particles", "±5 %", FIVE_PERCENT, |s, d| {
        s.chain.helix.particle_remanence *= 1.0 + d;
    }),
    tolerance("volume fraction of particles", "±0.01", ONE_PERCENT, |s, d| {
        s.chain.helix.volume_fraction += d;
    }),
    tolerance("length of the helix", "±0.1 mm", TENTH_MM, |s, d| s.chain.helix.length += d),
    tolerance("spacing of the rings, same core", "±0.1 mm", TENTH_MM, |s, d| s.spacing = d),
    tolerance("length of the rings", "±0.05 mm", TWENTIETH_MM, |s, d| s.chain.ring.length += d),
    tolerance("outer radius of helix and rings", "±0.05 mm", TWENTIETH_MM, |s, d| s.chain.helix.radius += d),
    tolerance("outer radius of the core", "±0.05 mm", TWENTIETH_MM, |s, d| {
        s.chain.helix.core_outer_radius += d;
    }),
    tolerance("inner radius of core and rings", "±0.05 mm", TWENTIETH_MM, |s, d| {
        s.chain.helix.core_inner_radius += d;
    }),
    tolerance("size of the field", "±1 %", ONE_PERCENT, |s, d| s.field[0] *= 1.0 + d),
    tolerance("direction of the field", "±1 deg", &[-1.0, 1.0], |s, d| s.field[1] += d),
    Entry {
        weighed: true,
        ..tolerance("density of the composite, weight across", "±10 %", TEN_PERCENT, |s, d| {
            let helix = &mut s.chain.helix;
            helix.density = Some((1.0 + d) * composite_density(helix.volume_fraction));
        })
    },
    Entry {
        weighed: true,
        ..tolerance("density of the rings, weight across", "±10 %", TEN_PERCENT, |s, d| {
            s.chain.ring.density *= 1.0 + d;
        })
    },
    omission("recoil permeability of the rings", "1.05", &[1.05], |s, d| {
        s.chain.ring.recoil_permeability = d;
    }),
    omission("spans on spans", "-3.1 to -7.6 % stiffness", SPANS_ON_SPANS, Setup::stiffen),
    omission("stiffness of the spiral", "17 to 22 % more", SPIRAL_STIFFNESS, Setup::stiffen),
    omission("weight, across the device", "up or down", &[-GRAVITY, GRAVITY], |s, d| s.gravity = d),
    omission("Poisson's ratio, not 0.4", "0.49 to 0.499", &[0.49, 0.499], |s, d| s.chain.helix.poisson = d),
    omission("rings of N48, not 1.35 T", "1.37 to 1.42 T", &[1.37, 1.42], |s, d| s.chain.ring.remanence = d),
    omission("silicone tube through the bore", "1.5 / 0.5 mm", &[1.0], |s, _| {
        s.chain.backbone = Some(Backbone::silicone());
    }),
];
