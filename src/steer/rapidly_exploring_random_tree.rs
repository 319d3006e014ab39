//! A rapidly exploring random tree of equilibria that were reached from one of them without a snap: a map of where the tip can be brought.

use nalgebra::{DVector, UnitQuaternion, Vector3};
use rand::rngs::StdRng;
use rand::{RngExt, SeedableRng};

use super::constants::{DRAWN_CURRENT, DRAWN_FIELD, DRAWN_INSERTION, DRAWN_STRENGTH, DRAWN_TRAVEL};
use super::moves::{MAGNET, Move, between};
use super::sequential_quadratic_programming::{Step, straight};
use super::state::{Rules, State};
use crate::error::Error;
use crate::manipulator::Inputs;

/// A state, and the way that led to it from another one.
#[derive(Debug, Clone)]
struct Node {
    state: State,
    parent: usize,
    way: Vec<Step>,
}

/// States that are connected without snaps; the first is the root.
#[derive(Debug)]
pub(super) struct Tree {
    nodes: Vec<Node>,
    random: StdRng,
}

impl Tree {
    pub(super) fn new(root: &State, seed: u64) -> Self {
        let root = Node { state: root.clone(), parent: 0, way: Vec::new() };
        Self { nodes: vec![root], random: StdRng::seed_from_u64(seed) }
    }

    /// The states, but for the root.
    pub(super) fn states(&self) -> impl Iterator<Item = (usize, &State)> {
        self.nodes.iter().map(|node| &node.state).enumerate().skip(1)
    }

    pub(super) fn state(&self, index: usize) -> &State {
        &self.nodes[index].state
    }

    /// The way from the root to a state.
    pub(super) fn way(&self, index: usize) -> Vec<Step> {
        let (mut ways, mut at) = (Vec::new(), index);
        while at != 0 {
            ways.push(self.nodes[at].way.clone());
            at = self.nodes[at].parent;
        }
        ways.into_iter().rev().flatten().collect()
    }

    /// Random inputs about those of the root, within the workspace.
    pub(super) fn drawn(&mut self, rules: &Rules) -> Inputs {
        let mut out = self.nodes[0].state.inputs.clone();
        let random = &mut self.random;
        let mut number = || 2.0 * random.random::<f64>() - 1.0;

        for each in &rules.moves {
            match each {
                Move::MagnetPosition => {
                    let place = &mut out.sources[MAGNET].pose.position;
                    let centre = *place;
                    let around = Vector3::repeat(DRAWN_TRAVEL);
                    let [low, high] = rules.limits.workspace.unwrap_or([centre - around, centre + around]);
                    *place = (low + high) * 0.5 + (high - low).map(|side| 0.5 * side * number());
                }
                Move::MagnetOrientation => {
                    let axis = Vector3::from_fn(|_, _| number());
                    let pose = &mut out.sources[MAGNET].pose;
                    if let Some(turn) = UnitQuaternion::rotation_between(&pose.axis(), &axis) {
                        pose.rotation = turn.to_rotation_matrix().matrix() * pose.rotation;
                    }
                }
                Move::MagnetStrength => out.sources[MAGNET].strength *= 1.0 + DRAWN_STRENGTH * number(),
                Move::UniformField => {
                    // The cube of the components lies within the ball of the largest field.
                    let most = rules.limits.field.unwrap_or(DRAWN_FIELD) / 3.0_f64.sqrt();
                    out.uniform_field = Vector3::from_fn(|_, _| most * number());
                }
                Move::CoilCurrent { source, .. } => out.sources[*source].strength += DRAWN_CURRENT * number(),
                Move::Insertion => {
                    out.insertion = (out.insertion + DRAWN_INSERTION * number()).clamp(0.0, 1.0);
                }
            }
        }

        out
    }

    /// The state nearest to these inputs, in longest steps.
    pub(super) fn nearest(&self, rules: &Rules, goal: &Inputs) -> usize {
        let far = |node: &Node| -> f64 {
            let rest: DVector<f64> = between(&node.state.inputs, &node.state.freedoms(rules), goal);
            rest.norm_squared()
        };
        let distances = self.nodes.iter().map(far).enumerate();
        distances.min_by(|(_, a), (_, b)| a.total_cmp(b)).map_or(0, |(index, _)| index)
    }

    /// Walks from a state straight towards `goal`, at most so many steps, and keeps where that ends; `None` where no step was possible,
    /// otherwise the new state and whether it is at the goal.
    pub(super) fn extend(
        &mut self,
        from: usize,
        goal: &Inputs,
        rules: &Rules,
        most: usize,
    ) -> Result<Option<(usize, bool)>, Error> {
        let (state, way, limit) = straight(&self.nodes[from].state, goal, rules, most)?;
        if way.is_empty() {
            return Ok(limit.is_none().then_some((from, true)));
        }
        self.nodes.push(Node { state, parent: from, way });
        Ok(Some((self.nodes.len() - 1, limit.is_none())))
    }
}
