//! What every answer promises, and whether it keeps it.

use cpu_time::ThreadTime;
use mcm::equilibrium::{Equilibrium, Interaction, Settings, Solution, Verifier};
use mcm::manipulator::{Inputs, Manipulator, Outcome, Outputs, Scene, Status};
use nalgebra::Vector3;

use super::scenes::Walk;
use super::tally::Tally;
use super::worst::Defect;

/// One walk in so many is verified.
const SAMPLE: u64 = 100;

/// Longest step of Newton's method from an answer to an equilibrium of the finer model (1: one element turned by a radian).
const LONGEST_STEP: f64 = 0.2;

/// Answers without a shape after which a walk ends.
const ENOUGH: u32 = 3;

/// Centreline points.
const POINTS: usize = 5;

/// How far a solve may exceed its budget of processor time: a part of it, and the making of one model that verifies, s.
const LATE: f64 = 1.2;
const MAKING: f64 = 0.3;

/// The finer model: degree of the strain modes and accuracy of the pairs.
const DEGREE: usize = 4;
const PAIR_ACCURACY: f64 = 1e-7;

/// Smallest eigenvalue, relative to the elastic energy, below which a shape is unstable: the noise of the differences.
const UNSTABLE: f64 = -1e-6;

/// Largest slope at an answer, in turns of one element by a radian: cheaper models of `auto` aside, 1e-11 and rounding.
const BALANCE: f64 = 1e-7;

/// Distance of the finer model's equilibrium over the length, times the margin: what the model of the answer leaves out.
const FINER: f64 = 5e-3;

/// Solves the scenes of a walk one after the other; `alone` tells them.
pub(crate) fn try_walk(walk: &Walk, index: u64, alone: bool) -> Tally {
    let mut tally = Tally::of_one_walk();
    let texts: Vec<String> = walk.texts().collect();
    let scenes: Vec<Scene> = texts.iter().map(|text| Scene::parse(text, "random").unwrap()).collect();
    let mut manipulator = scenes[0].manipulator(POINTS).unwrap();
    let verified = alone || index.is_multiple_of(SAMPLE);
    let mut twin = verified.then(|| Twin::new(&scenes[0])).flatten();
    let mut without = 0;
    for (step, scene) in scenes.iter().enumerate() {
        if without == ENOUGH {
            break;
        }
        let mut defect = |what: String| tally.defects.push(Defect { index, step, what });
        let before = manipulator.outputs().clone();
        let start = ThreadTime::now();
        let out = manipulator.solve(&scene.inputs).unwrap().clone();
        let seconds = start.elapsed().as_secs_f64();
        if alone {
            println!("# step {step}\n{}", texts[step]);
            println!(
                "# {:?} {:?}, stable {:?}, margin {:.3e}, snaps {}, residual {:.1e}, {} iterations, {:.1} ms, tip {:?}\n",
                out.status,
                out.outcome,
                out.stable,
                out.stability_margin,
                out.snaps,
                out.residual,
                out.iterations,
                1e3 * seconds,
                out.tip.position.as_slice()
            );
        }
        if seconds > LATE * scene.settings.time_budget + MAKING {
            defect(format!("took {seconds:.2} s, {:?}", out.outcome));
        }
        if let Some(name) = not_finite(&out) {
            defect(format!("{name} is not finite, {:?}", out.outcome));
        }
        let contradiction = match out.outcome {
            Outcome::Solved => out.status == Status::NotSolved || out.stable == Some(false),
            Outcome::Neutral => out.status == Status::NotSolved || out.stable == Some(true),
            // The branch goes on from where time ended, and what snapped on the way has snapped.
            Outcome::OutOfBudget(_) => out.status != Status::NotSolved || out.tip != before.tip,
            _ => out.status != Status::NotSolved || out.tip != before.tip || out.snaps != before.snaps,
        };
        if contradiction {
            defect(format!("{:?} contradicts {:?}, stable {:?}", out.outcome, out.status, out.stable));
        }
        tally.count(walk, &out, seconds, (index, step));
        let solved = out.status != Status::NotSolved;
        without += u32::from(!solved);
        let verdict = match &mut twin {
            Some(twin) => twin.verdict(scene, &out),
            None if verified && solved => verdict_of_auto(scene, &manipulator, &out),
            None => continue,
        };
        let defects = verdict.broken.into_iter().map(|what| Defect { index, step, what });
        tally.defects.extend(defects);
        if let Some(figures) = verdict.figures {
            if alone {
                println!("# {figures:?}");
            }
            tally.verified(figures, (index, step));
        }
    }
    tally
}

/// What independent models found of one answer.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Figures {
    /// Distance of the tip from the finer model's over the length.
    pub(crate) distance: f64,
    /// Smallest real part of the finer model's eigenvalues there.
    pub(crate) margin: f64,
}

#[derive(Debug, Default)]
struct Verdict {
    broken: Vec<String>,
    figures: Option<Figures>,
}

/// The model of a fixed level beside the manipulator, whose shape it tells in full, and a finer one.
struct Twin {
    same: Equilibrium,
    fine: Equilibrium,
    length: f64,
}

impl Twin {
    fn new(scene: &Scene) -> Option<Self> {
        if scene.settings.interaction == Interaction::Auto {
            return None;
        }
        let (design, magnet) = (scene.design().unwrap(), scene.sources.magnet().cloned());
        let fine = Settings { degree: DEGREE, pair_accuracy: PAIR_ACCURACY, ..scene.settings };
        let model = |settings| Equilibrium::new(&design, magnet.as_ref(), settings, 2).unwrap();
        Some(Self { same: model(scene.settings), fine: model(fine), length: design.length() })
    }

    fn verdict(&mut self, scene: &Scene, out: &Outputs) -> Verdict {
        let mut verdict = Verdict::default();
        let report = self.same.solve(&scene.inputs).unwrap();
        // Why there is no shape, and how deep bodies touch, depends on the discretisation.
        let same_ending = report.outcome == out.outcome
            || (!report.solved() && out.status == Status::NotSolved)
            || matches!(report.outcome, Outcome::OutOfBudget(_))
            || matches!(out.outcome, Outcome::OutOfBudget(_));
        if !same_ending {
            verdict
                .broken
                .push(format!("{:?} by the same model again, not {:?}", report.outcome, out.outcome));
        }
        if !report.solved() || out.status == Status::NotSolved {
            return verdict;
        }
        let shape = self.same.unknowns().to_vec();
        let mut copy = self.same.clone();
        let mut verifier = Verifier::new(&mut copy, &scene.inputs, has_potential(scene));
        let (residual, smallest) = (verifier.residual(&shape), verifier.smallest_real_part(&shape));
        if residual.is_none_or(|residual| residual > BALANCE) {
            verdict.broken.push(format!("not in balance: {residual:?}"));
        }
        let neutral = report.outcome == Outcome::Neutral;
        if smallest.is_none_or(|smallest| smallest < UNSTABLE) {
            verdict.broken.push(format!("{:?} but eigenvalue {smallest:?}", report.outcome));
        } else if neutral && smallest.is_some_and(|smallest| smallest > 1e-3) {
            verdict.broken.push(format!("neutral but eigenvalue {smallest:?}"));
        }
        self.fine.adopt(&self.same, &shape, &scene.inputs);
        let start = self.fine.unknowns().to_vec();
        let tip = self.same.tip().position;
        verdict.compare(&mut self.fine, scene, &start, neutral, tip, self.length);
        verdict
    }
}

impl Verdict {
    /// By the equilibrium of a finer model, found from the answer's shape.
    fn compare(
        &mut self,
        fine: &mut Equilibrium,
        scene: &Scene,
        start: &[f64],
        neutral: bool,
        tip: Vector3<f64>,
        length: f64,
    ) {
        let inputs = &scene.inputs;
        let mut verifier = Verifier::new(fine, inputs, has_potential(scene));
        let Some(shape) = verifier.polished(start, LONGEST_STEP) else {
            if !neutral {
                self.broken.push("no equilibrium of the finer model near it".into());
            }
            return;
        };
        let margin = verifier.smallest_real_part(&shape).unwrap_or(f64::NAN);
        let distance = (tip_at(fine, inputs, &shape) - tip).norm() / length;
        self.figures = Some(Figures { distance, margin });
        if neutral {
            return;
        }
        if margin.is_nan() || margin < UNSTABLE {
            self.broken.push(format!("unstable in the finer model: {margin:e}, tip {distance:e} away"));
        } else if distance * margin.min(1.0) > FINER {
            self.broken.push(format!("tip {distance:e} from the finer model's, margin {margin:e}"));
        }
    }
}

/// Whether the forces have a potential.
fn has_potential(scene: &Scene) -> bool {
    scene.settings.interaction != Interaction::Preceding && scene.inputs.tip_moment == Vector3::zeros()
}

/// Where the tip is in a shape.
fn tip_at(model: &mut Equilibrium, inputs: &Inputs, shape: &[f64]) -> Vector3<f64> {
    let _ = model.gradient(inputs, shape);
    model.tip().position
}

/// By the richest model, through the rings of the answer.
fn verdict_of_auto(scene: &Scene, manipulator: &Manipulator, out: &Outputs) -> Verdict {
    let mut verdict = Verdict::default();
    let design = scene.design().unwrap();
    let settings = Settings {
        interaction: Interaction::Full,
        bending_stop: Some(scene.settings.has_bending_stop()),
        degree: DEGREE,
        pair_accuracy: PAIR_ACCURACY,
        ..scene.settings
    };
    let magnet = scene.sources.magnet().cloned();
    let mut fine = Equilibrium::new(&design, magnet.as_ref(), settings, 2).unwrap();
    let Some(start) = fine.amplitudes_through(&manipulator.outputs().rings) else { return verdict };
    let (neutral, tip) = (out.outcome == Outcome::Neutral, out.tip.position);
    verdict.compare(&mut fine, scene, &start, neutral, tip, design.length());
    verdict
}

fn is_odd<'a>(mut values: impl Iterator<Item = &'a f64>) -> bool {
    values.any(|value| !value.is_finite())
}

/// The first output that is not finite.
fn not_finite(out: &Outputs) -> Option<&'static str> {
    let vectors = [
        ("tip", out.tip.position),
        ("magnetic force", out.magnetic_force),
        ("magnetic torque", out.magnetic_torque),
        ("base reaction force", out.base_reaction_force),
        ("base reaction moment", out.base_reaction_moment),
        ("field at the tip", out.tip_field),
    ];
    let numbers = [
        ("tip angle", out.tip_angle),
        ("stability margin", out.stability_margin),
        ("progress", out.progress),
        ("energy", out.energy),
        ("error estimate", out.error_estimate),
    ];
    let reactions = out.reactions.iter().flat_map(|reaction| {
        [("reaction force of a source", reaction.force), ("reaction torque of a source", reaction.torque)]
    });
    let vectors = vectors.into_iter().chain(reactions).filter(|(_, vector)| is_odd(vector.iter()));
    let vectors = vectors.map(|row| row.0);
    let numbers = numbers.iter().filter(|(_, number)| !number.is_finite()).map(|row| row.0);
    let residual = out.status != Status::NotSolved && !out.residual.is_finite();
    let rings = is_odd(out.rings.iter().flat_map(|pose| pose.position.iter().chain(pose.rotation.iter())));
    let shape = is_odd(out.shape.iter().flat_map(|point| point.iter()));
    let lists = [
        ("residual", residual),
        ("a ring", rings),
        ("the shape", shape),
        ("a core's angle", is_odd(out.core_angles.iter())),
        ("the tip's rotation", is_odd(out.tip.rotation.iter())),
    ];
    vectors.chain(numbers).next().or_else(|| lists.iter().find(|row| row.1).map(|row| row.0))
}
