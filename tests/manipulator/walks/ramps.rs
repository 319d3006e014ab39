//! Random ramps of one input, followed in three sizes of steps: snaps and ends must not depend on them.

use core::f64::consts::PI;

use mcm::geometry::{Pose, RotationVector};
use mcm::manipulator::{Branch, Inputs, Scene, Status};
use nalgebra::Vector3;
use rand::RngExt;
use rand::rngs::StdRng;

use crate::given::{direction, of_case};

/// Numbers of steps of a ramp.
const STEPS: [usize; 3] = [12, 27, 50];

/// Farthest apart that the same fold may be, of the whole ramp: steps follow a turned input along chords.
const SAME_FOLD: f64 = 2e-3;

/// Farthest apart that the same tips may be, m: each is within the default tolerance of its model.
const SAME_TIP: f64 = 1e-4;

/// A scene, and the input that changes along the ramp from 0 to 1.
#[derive(Debug, Clone)]
pub(crate) struct Ramp {
    text: String,
    change: Change,
}

#[derive(Debug, Clone, Copy)]
enum Change {
    /// The first magnet grows to its strength.
    Strength,
    /// The first magnet turns by a rotation vector, rad.
    Turn(Vector3<f64>),
    /// The first magnet moves, m.
    Shift(Vector3<f64>),
    /// The uniform field turns by a rotation vector, rad.
    Field(Vector3<f64>),
    /// A force on the tip grows, N.
    Force(Vector3<f64>),
}

/// What a walk of a ramp told.
#[derive(Debug, Clone, PartialEq)]
struct Told {
    /// Where the branch was left, in parts of the ramp.
    folds: Vec<f64>,
    /// Whether no shape was found beyond the last of them, so that the walk ended there.
    ended: bool,
    tip: Vector3<f64>,
}

/// How the walks of a ramp went beside one another.
#[derive(Debug, Clone, PartialEq)]
pub(crate) enum Verdict {
    /// There is no stable shape at the start.
    Unfit,
    /// All tell the same folds, so many, and come to the same end; whether that is an end of the branch.
    Alike(usize, bool),
    /// They do not.
    Differs(String),
}

impl Ramp {
    /// The ramp of this number.
    pub(crate) fn random(seed: u64, index: u64) -> Self {
        let random = &mut of_case(seed, index);
        let mut tables = vec![device(random)];

        let change = match random.random_range(0..5) {
            0 => Change::Strength,
            1 => Change::Turn(direction(random) * random.random_range(0.5..1.5 * PI)),
            2 => Change::Shift(direction(random) * random.random_range(0.01..0.03)),
            3 => Change::Field(
                direction(random).cross(&Vector3::z()).normalize() * random.random_range(2.5..1.5 * PI),
            ),
            _ => Change::Force(direction(random) * random.random_range(1e-4..3e-3)),
        };
        let of_magnet = matches!(change, Change::Strength | Change::Turn(_) | Change::Shift(_));
        if !of_magnet || random.random_bool(0.3) {
            // First along the device, so that a turn against it comes close to where the shape may snap over.
            let field: Vector3<f64> =
                (0.1 * direction(random) + Vector3::z()) * random.random_range(5.0..40.0);
            tables.push(format!("[field]\nuniform_mt = {:?}\n", field.as_slice()));
        }
        let place = direction(random);
        for number in 0..random.random_range(usize::from(of_magnet)..=2) {
            // Magnets on either side do not touch one another.
            tables.push(magnet(random, [place, -place][number]));
        }
        Self { text: tables.concat(), change }
    }

    fn at(&self, scene: &Scene, part: f64) -> Inputs {
        let mut out = scene.inputs.clone();
        let turned = |by: Vector3<f64>| RotationVector::new(by * part).matrix();
        match self.change {
            Change::Strength => out.sources[0].strength *= part,
            Change::Turn(by) => out.sources[0].pose.rotation = turned(by) * out.sources[0].pose.rotation,
            Change::Shift(by) => out.sources[0].pose.position += by * part,
            Change::Field(by) => out.uniform_field = turned(by) * out.uniform_field,
            Change::Force(force) => out.tip_force = force * part,
        }
        out
    }

    /// Follows it in so many steps; `None` without a stable shape at its start.
    fn walk(&self, scene: &Scene, steps: usize) -> Option<Told> {
        let manipulator = scene.manipulator(2).expect("an allowed scene");
        let step = 1.0 / steps as f64;
        let mut branch =
            Branch::new(manipulator, |part| Ok(self.at(scene, part)), 1.0, step).expect("a path");
        let start = branch.to(0.0).expect("finite inputs");
        if start.status == Status::NotSolved || start.stable != Some(true) {
            return None;
        }

        let mut ended = false;
        for number in 1..=steps {
            ended = branch.to(number as f64 * step).expect("finite inputs").status == Status::NotSolved;
            assert!(branch.left_out().is_none(), "{:?}", branch.left_out());
            if ended {
                break;
            }
        }
        let folds = branch.folds().iter().map(|fold| fold.value).collect();
        Some(Told { folds, ended, tip: branch.outputs().tip.position })
    }

    /// Follows it in steps of all sizes.
    pub(crate) fn compare(&self) -> Verdict {
        let scene = Scene::parse(&self.text, "ramp").expect("an allowed scene");
        let walks = STEPS.map(|steps| self.walk(&scene, steps));
        let [Some(first), rest @ ..] = &walks else { return Verdict::Unfit };
        for (steps, other) in STEPS[1..].iter().zip(rest) {
            if let Some(how) = other.as_ref().map_or(Some("no start".into()), |other| first.differs(other)) {
                return Verdict::Differs(format!("{} and {steps} steps: {how}", STEPS[0]));
            }
        }
        Verdict::Alike(first.folds.len(), first.ended)
    }
}

impl Told {
    /// How another walk of the same ramp differs, if it does.
    fn differs(&self, other: &Self) -> Option<String> {
        let pairs = || self.folds.iter().zip(&other.folds);
        let same = self.folds.len() == other.folds.len()
            && self.ended == other.ended
            && pairs().all(|(a, b)| (a - b).abs() <= SAME_FOLD);
        let apart = (self.tip - other.tip).norm();
        // At an end of the branch, the last shapes are a step before it.
        let together = self.ended || apart <= SAME_TIP;
        (!same || !together).then(|| format!("{self:?}, {other:?}, tips {:.1} um apart", 1e6 * apart))
    }
}

/// A device that stands, at one of the levels.
fn device(random: &mut StdRng) -> String {
    let segments = [1, 1, 2, 2, 3][random.random_range(0..5)];
    let level = ["auto", "full", "rings", "rings", "none", "none"][random.random_range(0..6)];
    let shore = random.random_range(26.0..40.0);
    format!(
        "[design]\nsegments = {segments}\n[design.helix]\nshore_a = {shore}\n[model]\ninteraction = \"{level}\"\n\
         time_budget_s = 600\n"
    )
}

/// The paper's pair in a direction from the base, turned anyhow.
fn magnet(random: &mut StdRng, towards: Vector3<f64>) -> String {
    let place = towards * random.random_range(50.0..100.0);
    let rotation = RotationVector::new(direction(random) * random.random_range(0.0..PI)).matrix();
    let turn = Pose { rotation, ..Pose::identity() }.quaternion();
    let strength = random.random_range(-1.0..1.0);
    format!(
        "[[magnet]]\nposition_mm = {:?}\norientation_wxyz = {turn:?}\nstrength = {strength}\n",
        place.as_slice()
    )
}
