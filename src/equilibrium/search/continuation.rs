//! Bifurcation diagrams: all equilibria on a branch along a path of inputs, through folds, stable or not.

use nalgebra::DVector;

use super::solution::Solution;
use super::solver::Equilibrium;
use crate::equilibrium::model::{ElasticNorm, Inputs, Potential};
use crate::error::{Error, check};
use crate::geometry::Pose;
use crate::numerics::continuation::{End, Family, Local, Point, PointKind, Walk, follow};
use crate::numerics::trust_region::Objective;

/// Finite difference step of the parameter, relative to its span, for the derivative of the gradient.
const DIFFERENCE: f64 = 1e-5;

/// An equilibrium on a branch, stable or not.
#[derive(Debug, Clone, PartialEq)]
pub struct Shape {
    /// The parameter value on the path of inputs.
    pub value: f64,
    /// Strain mode amplitudes.
    pub unknowns: Vec<f64>,
    /// Pose of the tip.
    pub tip: Pose,
    /// Angle between the tip's and the base's `d3`, rad, in `[0, pi]`.
    pub tip_angle: f64,
    /// Potential energy, J.
    pub energy: f64,
    /// Stability margin: smallest eigenvalue of the Hessian in the elastic norm of the strains' variation at the shape; 0 at
    /// a fold, negative where unstable.
    pub margin: f64,
    /// Number of unstable directions; 0 where the shape is stable.
    pub unstable: usize,
    /// Whether it is a fold or a branch point; at these, rounding decides on `unstable`.
    pub kind: PointKind,
}

/// A branch of equilibria along a path of inputs.
#[derive(Debug, Clone, PartialEq)]
pub struct Diagram {
    /// The equilibria in their order along the branch, including folds.
    pub shapes: Vec<Shape>,
    /// Why the branch ends.
    pub end: End,
}

impl Diagram {
    /// The folds: the shapes at which the parameter turns back.
    pub fn folds(&self) -> impl Iterator<Item = &Shape> {
        self.shapes.iter().filter(|shape| shape.kind == PointKind::Fold)
    }
}

impl Equilibrium {
    /// Traces the branch through the present shape, or through the equilibrium next to it, where `inputs` is a function
    /// of one parameter; see [`follow`].
    ///
    /// Lengths of `walk` are in the radian norm, where the whole parameter range counts as one. The inputs are also
    /// evaluated slightly outside the range. The equilibrium itself stays unchanged.
    ///
    /// ```
    /// use mcm::equilibrium::{Equilibrium, Inputs};
    /// use mcm::manipulator::Scene;
    /// use mcm::numerics::continuation::Walk;
    /// // The rings' and the helix' attraction pulls one segment shut at 35.8 mT; beyond the fold the branch goes back as
    /// // the barrier between the open shape and the closed one.
    /// let scene = Scene::parse("[design]\nsegments = 1\n[model]\ninteraction = \"full\"", "doc")?;
    /// let mut equilibrium = Equilibrium::new(&scene.design()?, None, scene.settings, 2)?;
    /// let field = |b: f64| Ok(Inputs { uniform_field: [0.0, b, 0.0].into(), ..Inputs::unloaded(2) });
    /// equilibrium.solve(&field(0.0)?)?;
    /// let walk = Walk { from: 0.0, upwards: true, range: [0.0, 0.04], longest_step: 0.1, points: 100 };
    /// let diagram = equilibrium.trace(field, &walk)?;
    /// let folds: Vec<f64> = diagram.folds().map(|fold| fold.value).collect();
    /// assert!(folds.len() == 1 && (folds[0] - 35.8e-3).abs() < 1e-4);
    /// let unstable: Vec<usize> = diagram.shapes.iter().map(|shape| shape.unstable).collect();
    /// assert!(unstable[0] == 0 && unstable.ends_with(&[1]));
    /// # Ok::<(), mcm::error::Error>(())
    /// ```
    ///
    /// # Errors
    /// [`Error::Range`] for a range without length and as [`follow`]; those of `inputs`; [`Error::Unsupported`] where
    /// forces are not conservative: at the level `preceding`, and with a moment on the tip.
    pub fn trace(
        &self,
        inputs: impl Fn(f64) -> Result<Inputs, Error>,
        walk: &Walk,
    ) -> Result<Diagram, Error> {
        let [low, high] = walk.range;
        let span = check("span of the path", high - low, |v| v > 0.0, "> 0")?;
        check("first value of the walk", walk.from, |v| low <= v && v <= high, "within its range")?;
        let unit = self.chain.radian_norm();
        let scale = DVector::from_iterator(self.freedoms(), self.metric().iter().map(|k| unit / k.sqrt()));
        let start = DVector::from_column_slice(self.unknowns()).component_div(&scale);
        let mut family = Scaled { model: self.clone(), inputs, low, span, unit, scale };
        let part = |value: f64| (value - low) / span;
        let walk = Walk { from: part(walk.from), range: [0.0, 1.0], ..*walk };
        let (points, end) = follow(&mut family, &start, &walk)?;
        let shapes = points.iter().map(|point| family.shape(point)).collect::<Result<_, _>>()?;
        Ok(Diagram { shapes, end })
    }
}

/// The potential in scaled variables, in which the elastic energy is half their square times `unit^2`, and with the
/// parameter relative to its span.
struct Scaled<F> {
    model: Equilibrium,
    inputs: F,
    low: f64,
    span: f64,
    unit: f64,
    /// Unknowns per unit of the scaled variables.
    scale: DVector<f64>,
}

impl<F: Fn(f64) -> Result<Inputs, Error>> Scaled<F> {
    fn value(&self, parameter: f64) -> f64 {
        self.low + self.span * parameter
    }

    fn inputs(&self, parameter: f64) -> Result<Inputs, Error> {
        let inputs = (self.inputs)(self.value(parameter))?;
        inputs.check(self.model.chain.rings.len())?;
        Ok(inputs)
    }

    fn shape(&mut self, point: &Point) -> Result<Shape, Error> {
        let inputs = self.inputs(point.parameter)?;
        let unknowns: Vec<f64> = point.x.component_mul(&self.scale).as_slice().to_vec();
        let mut potential = self.model.potential(&inputs, &unknowns);
        let energy = potential.linearise(&unknowns).unwrap_or(f64::NAN);
        let hessian = potential.hessian();
        let mut norm = ElasticNorm::default();
        norm.update(&self.model.chain, &self.model.work.configurations);
        let tip = self.model.tip();
        Ok(Shape {
            value: self.value(point.parameter),
            tip,
            tip_angle: inputs.base.axis().angle(&tip.axis()),
            energy,
            margin: norm.smallest(&hessian),
            unstable: point.negative(),
            kind: point.kind,
            unknowns,
        })
    }
}

impl<F: Fn(f64) -> Result<Inputs, Error>> Family for Scaled<F> {
    fn at(&mut self, x: &DVector<f64>, parameter: f64) -> Result<Option<Local>, Error> {
        let unknowns = x.component_mul(&self.scale);
        let unknowns = unknowns.as_slice();
        let [before, here, after] = [parameter - DIFFERENCE, parameter, parameter + DIFFERENCE]
            .map(|parameter| self.inputs(parameter));
        let (before, here, after) = (before?, here?, after?);

        let per_unit = &self.scale / (self.unit * self.unit);
        let scaled = |potential: &Potential<'_>| {
            DVector::from_column_slice(potential.gradient()).component_mul(&per_unit)
        };
        let mut potential = self.model.potential(&here, unknowns);
        if !potential.terms.have_potential() {
            let reason = "branches are traced where all forces have a potential: not at the level `preceding`, nor with a \
                          moment on the tip";
            return Err(Error::Unsupported(reason.into()));
        }
        if potential.linearise(unknowns).is_none() {
            return Ok(None);
        }

        let gradient = scaled(&potential);
        let mut hessian = potential.hessian();
        for (mut column, factor) in hessian.column_iter_mut().zip(&self.scale) {
            column.component_mul_assign(&per_unit);
            column *= *factor;
        }

        // By the same quadrature rules, whose change would count as one of the parameter.
        let mut beside = [DVector::zeros(0), DVector::zeros(0)];
        for (slot, inputs) in beside.iter_mut().zip([&before, &after]) {
            let mut potential = self.model.potential_as_ruled(inputs);
            if potential.slope(unknowns).is_none() {
                return Ok(None);
            }
            *slot = scaled(&potential);
        }
        let [before, after] = beside;
        Ok(Some(Local { gradient, hessian, drift: (after - before) / (2.0 * DIFFERENCE) }))
    }
}
