//! History of a branch of equilibria: its last shapes, from which the next one is extrapolated.

use serde::{Deserialize, Serialize};

use crate::equilibrium::model::{Chain, FreeTurn, Inputs};
use crate::numerics::trust_region::spread;

/// Number of earlier shapes that are kept for the predictor.
const EARLIER: usize = 2;

/// The present shape with its inputs, and the shapes before it.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub(crate) struct History {
    pub(crate) unknowns: Vec<f64>,
    pub(crate) inputs: Option<Inputs>,
    /// Shapes and inputs of the previous solves on this branch, the most recent first.
    pub(crate) earlier: Vec<(Vec<f64>, Inputs)>,
    /// Stability margin (of all directions but a free turn) and verdict at the last factorisation.
    pub(crate) margin: f64,
    pub(crate) stable: Option<bool>,
    /// The free turn of the present shape, which is neutral then.
    pub(crate) turn: Option<FreeTurn>,
    /// Direction of least stiffness, the initial guess of the next eigenvalue search.
    pub(crate) softest: Vec<f64>,
}

impl History {
    pub(crate) fn new(chain: &Chain) -> Self {
        let mut softest = vec![0.0; chain.freedoms()];
        spread(&chain.metric, &mut softest, 1.0);
        let unknowns = vec![0.0; chain.freedoms()];
        Self { unknowns, inputs: None, earlier: Vec::new(), margin: 0.0, stable: None, turn: None, softest }
    }

    /// Whether every shape has this number of unknowns and all of them are finite.
    pub(crate) fn fits(&self, freedoms: usize) -> bool {
        let earlier = self.earlier.iter().map(|earlier| &earlier.0);
        let mut lists = [&self.unknowns, &self.softest].into_iter().chain(earlier);
        lists.all(|list| are_finite(list, freedoms)) && self.earlier.len() <= EARLIER
    }

    /// Present and earlier inputs.
    pub(crate) fn all_inputs(&self) -> impl Iterator<Item = &Inputs> {
        self.inputs.iter().chain(self.earlier.iter().map(|earlier| &earlier.1))
    }

    /// Advances to a shape at `inputs`; `last` is the previous shape. With `anew` the earlier shapes are dropped, since
    /// they do not extrapolate to the next one.
    pub(crate) fn advance(&mut self, inputs: &Inputs, last: &[f64], anew: bool) {
        let Some(here) = &mut self.inputs else {
            self.inputs = Some(inputs.clone());
            return;
        };
        if anew {
            self.earlier.clear();
        } else if self.earlier.len() < EARLIER {
            self.earlier.insert(0, (last.to_vec(), here.clone()));
        } else {
            self.earlier.rotate_right(1);
            let (shape, before) = &mut self.earlier[0];
            shape.copy_from_slice(last);
            before.copy_from(here);
        }
        here.copy_from(inputs);
    }

    /// Response to a force relative to that of the shape without loads, as far as it is known: the inverse of the stability margin.
    pub(crate) fn softness(&self) -> f64 {
        if self.stable.is_some() && self.margin > 0.0 { f64::max(1.0, 1.0 / self.margin) } else { 1.0 }
    }

    /// Stays at an equilibrium on the way to inputs that were not reached.
    pub(crate) fn rest_at(&mut self, inputs: Inputs, unknowns: Vec<f64>) {
        (self.inputs, self.unknowns) = (Some(inputs), unknowns);
        self.earlier.clear();
        (self.margin, self.stable, self.turn) = (0.0, None, None);
    }
}

/// Whether the list has this many entries and all of them are finite.
pub(crate) fn are_finite(list: &[f64], count: usize) -> bool {
    list.len() == count && list.iter().all(|x| x.is_finite())
}
