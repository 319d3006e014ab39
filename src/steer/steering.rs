//! A device that is steered.

use super::aim::Aim;
use super::bounds::Bodies;
use super::constants::{EXTENSION, SEED, STARTS, TREE_STATES};
use super::limits::{Limit, Limits};
use super::linear::Linear;
use super::moves::{Move, coils, freedoms};
use super::rapidly_exploring_random_tree::Tree;
use super::sequential_quadratic_programming::{Attempt, Step, approach};
use super::state::{Rules, State};
use super::target::{Residual, Target, Tolerances};
use crate::error::Error;
use crate::manipulator::{Inputs, Outputs, Scene, Status};

/// The answer to a target: the inputs, and the way to them.
#[derive(Debug, Clone, PartialEq)]
pub struct Answer {
    /// Whether the target is met within its tolerances.
    pub reached: bool,
    /// What is left, at the end of the way.
    pub residual: Residual,
    /// What stops the tip where it is nearest to its target; `None` where that is reached.
    pub limit: Option<Limit>,
    /// The steps from the state before to the last one, none of which snaps; empty where nothing had to move.
    pub way: Vec<Step>,
}

/// A device whose inputs are moved so that its tip comes where it is wanted.
///
/// It stays where the last target was met, or where it came nearest, and goes on from there.
///
/// ```
/// use mcm::manipulator::Scene;
/// use mcm::steer::{Limits, Move, Steering, Target};
/// let text = "[design]\nsegments = 1\n[field]\nuniform_mt = [0, 10, 0]\n[model]\ninteraction = \"rings\"";
/// let scene = Scene::parse(text, "example")?;
/// let mut steering = Steering::new(&scene, &[Move::UniformField], Limits::default())?;
/// let answer = steering.to(&Target { angle: Some(0.5), ..Target::default() })?;
/// assert!(answer.reached && answer.residual.angle < Some(1e-4));
/// assert!(steering.inputs().uniform_field.norm() > 0.01);
/// # Ok::<(), mcm::error::Error>(())
/// ```
#[derive(Debug, Clone)]
pub struct Steering {
    pub(super) rules: Rules,
    pub(super) tolerances: Tolerances,
    pub(super) state: State,
    pub(super) linear: Option<Linear>,
}

impl Steering {
    /// The device of a scene at the scene's inputs, of which these may move.
    ///
    /// # Errors
    /// [`Error::Unsupported`] where nothing may move, an input that the scene does not have, or a limit that its inputs exceed, and where
    /// they have no shape; those of the limits and of the scene.
    pub fn new(scene: &Scene, moves: &[Move], limits: Limits) -> Result<Self, Error> {
        limits.check()?;
        check_moves(scene, moves)?;
        let refuse = |reason: String| Err(Error::Unsupported(reason));

        let design = scene.design()?;
        let bodies = Bodies { magnet: scene.sources.magnet().cloned(), radius: design.largest_radius() };
        // Two points a segment: the device between them is as near to the magnet to a tenth of a millimetre.
        let mut manipulator = scene.manipulator(2 * design.segments().len() + 2)?;
        let inputs = scene.inputs.clone();
        let outputs = manipulator.solve(&inputs)?;
        if outputs.status == Status::NotSolved {
            let outcome = outputs.outcome.name().replace('_', " ");
            return refuse(format!("the scene's inputs have no shape to begin with: {outcome}"));
        }
        let rules = Rules { bodies, moves: moves.to_vec(), limits };
        let state = State { manipulator, inputs: inputs.clone() };
        // The first place is no step, but keeps to the same limits.
        if let Err(limit) = state.at(&rules, inputs)? {
            return refuse(format!("the scene's inputs already exceed a limit: {limit}"));
        }
        Ok(Self { rules, tolerances: Tolerances::default(), state, linear: None })
    }

    /// This steering with other tolerances.
    ///
    /// # Errors
    /// As [`Tolerances::checked`].
    pub fn with_tolerances(mut self, tolerances: Tolerances) -> Result<Self, Error> {
        self.tolerances = tolerances.checked()?;
        Ok(self)
    }

    /// The present inputs.
    #[must_use]
    pub fn inputs(&self) -> &Inputs {
        &self.state.inputs
    }

    /// The present outputs.
    #[must_use]
    pub fn outputs(&self) -> &Outputs {
        self.state.outputs()
    }

    /// Gradient of the stability margin by the freedoms of the moves, in their order and per SI unit: three for a position, two for the
    /// orientation, about the magnet's `d1` and `d2`. By central differences of the margins of neighbouring equilibria; `None` beside a fold.
    ///
    /// # Errors
    /// Those of the solves.
    pub fn margin_gradient(&self) -> Result<Option<Vec<f64>>, Error> {
        let freedoms = freedoms(&self.rules.moves, &self.rules.limits, &self.state.inputs);
        let gradient = self.state.margin_gradient(&freedoms)?;
        let lengths = freedoms.iter().map(|freedom| freedom.along.norm());
        Ok(gradient
            .map(|gradient| gradient.iter().zip(lengths).map(|(rate, length)| rate / length).collect()))
    }

    /// Moves the device to a target: directly, and where that does not lead there, by way of other states that can be reached without a
    /// snap.
    ///
    /// # Errors
    /// Those of [`Target::check`] and of the solves; [`Error::NoDerivatives`] at a fold.
    pub fn to(&mut self, target: &Target) -> Result<Answer, Error> {
        target.check()?;
        let direct = self.approach(target)?;
        let found = if direct.limit.is_none() { direct } else { self.detour(target, direct)? };
        Ok(self.accept(target, found))
    }

    /// What a walk to this target is after.
    pub(super) fn aim<'a>(&'a self, target: &'a Target) -> Aim<'a> {
        Aim { target, tolerances: &self.tolerances, rules: &self.rules }
    }

    /// A direct walk, from the present state.
    pub(super) fn approach(&mut self, target: &Target) -> Result<Attempt, Error> {
        let mut linear = self.linear.take();
        let found = approach(&self.state, &self.aim(target), &mut linear);
        self.linear = linear;
        found
    }

    /// The best of the walks by way of other states, and of the direct one.
    fn detour(&self, target: &Target, direct: Attempt) -> Result<Attempt, Error> {
        let mut tree = Tree::new(&self.state, SEED);
        for _ in 0..TREE_STATES {
            let goal = tree.drawn(&self.rules);
            let from = tree.nearest(&self.rules, &goal);
            tree.extend(from, &goal, &self.rules, EXTENSION)?;
        }
        let aim = self.aim(target);
        let mut starts: Vec<(usize, f64)> =
            tree.states().map(|(index, state)| (index, aim.misfit(state))).collect();
        starts.sort_by(|(_, a), (_, b)| a.total_cmp(b));
        let mut best = direct;
        for (start, _) in starts.into_iter().take(STARTS) {
            let mut attempt = match approach(tree.state(start), &aim, &mut None) {
                Ok(attempt) => attempt,
                // Another start is not at a fold.
                Err(Error::NoDerivatives(_)) => continue,
                Err(error) => return Err(error),
            };
            if attempt.misfit < best.misfit {
                let mut way = tree.way(start);
                way.append(&mut attempt.way);
                best = Attempt { way, ..attempt };
            }
            if best.limit.is_none() {
                break;
            }
        }
        Ok(best)
    }

    /// Stays where a walk has ended, and tells how it went.
    pub(super) fn accept(&mut self, target: &Target, found: Attempt) -> Answer {
        let Attempt { state, way, limit, .. } = found;
        if limit.is_some() {
            self.linear = None;
        }
        self.state = state;
        Answer { reached: limit.is_none(), residual: target.residual(self.outputs()), limit, way }
    }
}

/// That something may move, nothing twice, and only what the scene has.
fn check_moves(scene: &Scene, moves: &[Move]) -> Result<(), Error> {
    let refuse = |reason: String| Err(Error::Unsupported(reason));
    if moves.is_empty() {
        return refuse("nothing may move".into());
    }

    for (number, each) in moves.iter().enumerate() {
        let name = each.name();
        if moves[..number].contains(each) {
            return refuse(format!("`{name}` is named twice"));
        }

        let (known, what) = match each {
            Move::Insertion => (scene.shaft.is_some(), "the scene has no shaft"),
            Move::UniformField => (true, ""),
            Move::CoilCurrent { .. } => {
                (coils(&scene.sources).any(|own| own == *each), "the scene has no such coil")
            }
            _ => (scene.sources.magnet().is_some(), "the scene has no magnet"),
        };
        if !known {
            return refuse(format!("`{name}` cannot be moved: {what}"));
        }
        if *each == Move::Insertion && scene.inputs.feed_force.is_some() {
            return refuse(format!("`{name}` cannot be moved: the push on the shaft is given"));
        }
    }
    Ok(())
}
