//! Ways from pose to pose past folds.

use super::constants::{EXTENSION, SEED, STRAIGHT_STEPS};
use super::limits::Limit;
use super::rapidly_exploring_random_tree::Tree;
use super::sequential_quadratic_programming::{Step, straight};
use super::state::State;
use super::steering::Steering;
use super::target::Target;
use crate::error::{Error, check};
use crate::manipulator::Inputs;

/// A way between two poses.
#[derive(Debug, Clone, PartialEq)]
pub struct Plan {
    /// The steps, none of which snaps; empty where there is no way.
    pub way: Vec<Step>,
    /// What stops the straight way; `None` where that leads there.
    pub straight: Option<Limit>,
    /// Number of random inputs tried.
    pub tries: usize,
    /// `None` where the way was found.
    pub limit: Option<Limit>,
}

impl Steering {
    /// Looks for a way without a snap from the present inputs to `goal`, whose other inputs are the present ones: the straight one, and
    /// where that meets a fold or a limit, a tree of states grown at random (rapidly-exploring random tree, `LaValle` 1998), from each of which
    /// the straight way is tried again. `shape` asks for one of several shapes that the device may have there.
    ///
    /// The device then stays at the goal, or where it was.
    ///
    /// # Errors
    /// Those of [`Target::check`] and of the solves; [`Error::Range`] for no tries.
    pub fn plan(&mut self, goal: &Inputs, shape: Option<&Target>, tries: usize) -> Result<Plan, Error> {
        shape.map_or(Ok(()), Target::check)?;
        check("number of tries", tries as f64, |v| (1.0..=1e6).contains(&v), "from 1 to 1000000")?;
        goal.check(self.state.inputs.ring_forces.len())?;

        let arrived =
            |state: &State| shape.is_none_or(|shape| shape.misfit(state.outputs(), &self.tolerances) <= 1.0);

        let (state, way, stopped) = straight(&self.state, goal, &self.rules, STRAIGHT_STEPS)?;
        if stopped.is_none() && arrived(&state) {
            (self.state, self.linear) = (state, None);
            return Ok(Plan { way, straight: None, tries: 0, limit: None });
        }

        let mut tree = Tree::new(&self.state, SEED);
        for tried in 1..=tries {
            let drawn = tree.drawn(&self.rules);
            let from = tree.nearest(&self.rules, &drawn);
            let Some((node, _)) = tree.extend(from, &drawn, &self.rules, EXTENSION)? else { continue };

            let (state, way, limit) = straight(tree.state(node), goal, &self.rules, STRAIGHT_STEPS)?;
            if limit.is_none() && arrived(&state) {
                let mut whole = tree.way(node);
                whole.extend(way);
                (self.state, self.linear) = (state, None);
                return Ok(Plan { way: whole, straight: stopped, tries: tried, limit: None });
            }
        }

        Ok(Plan { way: Vec::new(), straight: stopped, tries, limit: Some(Limit::NoWay(tries)) })
    }
}
