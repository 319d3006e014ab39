//! A branch of equilibria: its last shapes, and where they lead to expect the next one.

use serde::{Deserialize, Serialize};

use super::chain::Chain;
use super::inputs::Inputs;
use crate::numerics::trust_region::spread;

/// Shapes before the present one that are kept to predict the next.
const EARLIER: usize = 2;

/// The shape, and the inputs at which it is in equilibrium.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub(super) struct History {
    pub(super) unknowns: Vec<f64>,
    pub(super) inputs: Option<Inputs>,
    /// Shape and inputs of the solves before on this branch, the last one first.
    pub(super) earlier: Vec<(Vec<f64>, Inputs)>,
    /// Margin and verdict at the last factorisation.
    pub(super) margin: f64,
    pub(super) stable: Option<bool>,
    /// Direction of least stiffness, the first guess for the next search.
    pub(super) softest: Vec<f64>,
}

impl History {
    pub(super) fn new(chain: &Chain) -> Self {
        let mut softest = vec![0.0; chain.freedoms()];
        spread(&chain.metric, &mut softest, 1.0);
        let unknowns = vec![0.0; chain.freedoms()];
        Self { unknowns, inputs: None, earlier: Vec::new(), margin: 0.0, stable: None, softest }
    }

    /// Whether that many unknowns are those of every shape, and all of them are finite.
    pub(super) fn fits(&self, freedoms: usize) -> bool {
        let earlier = self.earlier.iter().map(|earlier| &earlier.0);
        let mut lists = [&self.unknowns, &self.softest].into_iter().chain(earlier);
        lists.all(|list| are_finite(list, freedoms)) && self.earlier.len() <= EARLIER
    }

    /// All inputs.
    pub(super) fn all_inputs(&self) -> impl Iterator<Item = &Inputs> {
        self.inputs.iter().chain(self.earlier.iter().map(|earlier| &earlier.1))
    }

    /// Goes on to a shape at `inputs`; `last` is the shape before, from which no line leads on where it begins `anew`.
    pub(super) fn advance(&mut self, inputs: &Inputs, last: &[f64], anew: bool) {
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

    /// Rests at an equilibrium on the way to inputs that were not reached.
    pub(super) fn rest_at(&mut self, inputs: Inputs, unknowns: Vec<f64>) {
        (self.inputs, self.unknowns) = (Some(inputs), unknowns);
        self.earlier.clear();
        (self.margin, self.stable) = (0.0, None);
    }
}

/// Whether these are so many finite numbers.
pub(super) fn are_finite(list: &[f64], count: usize) -> bool {
    list.len() == count && list.iter().all(|x| x.is_finite())
}
