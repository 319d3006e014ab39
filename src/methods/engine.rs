//! Common interface of the comparison methods: each solves in given surroundings from its own last solution.

use super::arcs::Arcs;
use super::collocation::Collocation;
use super::line::Line;
use super::method::Method;
use super::multiple_shooting::{self, Spatial};
use super::node_shape::NodeShape;
use super::planar::InPlane;
use super::plane::Plane;
use super::settings::Settings;
use super::shape::Shape;
use super::shooting::Shooting;
use super::surroundings::Surroundings;
use crate::numerics::levenberg_marquardt::Ending;

/// A method and its last solution.
#[derive(Debug, Clone)]
pub(super) enum Engine {
    Shooting(Shooting),
    MultipleShooting(NodeShape),
    Planar(NodeShape),
    Collocation(Collocation),
    Arcs(Arcs),
}

impl Engine {
    /// The straight shape; `None` for the potential method, which is not a comparison method.
    pub(super) fn new(line: &Line, settings: &Settings) -> Option<Self> {
        match settings.method {
            Method::Potential => None,
            Method::ShootingPaper => Some(Self::Shooting(Shooting::new(false, settings.steps))),
            Method::ShootingExact => Some(Self::Shooting(Shooting::new(true, settings.steps))),
            Method::MultipleShooting => Some(Self::MultipleShooting(NodeShape::straight(line))),
            Method::Planar => Some(Self::Planar(NodeShape::straight(line))),
            Method::Collocation => Some(Self::Collocation(Collocation::straight(line, settings))),
            Method::ConstantCurvature => Some(Self::Arcs(Arcs::straight(line))),
        }
    }

    /// Solves from the last solution, which is kept if that fails.
    pub(super) fn solve(&mut self, around: &Surroundings<'_>, settings: &Settings) -> Ending {
        let base = &around.inputs.base;
        let (tolerance, iterations) = (settings.tolerance, settings.iterations);
        match self {
            Self::Shooting(shooting) => shooting.solve(around, tolerance, iterations),
            Self::MultipleShooting(shape) => {
                *shape = shape.carried(base);
                let space = Spatial::new(around, settings.steps);
                multiple_shooting::solve(around, &space, shape, tolerance, iterations)
            }
            Self::Planar(shape) => {
                let Ok(plane) = Plane::of(around.inputs, around.sources) else {
                    return Ending { converged: false, iterations: 0, residual: f64::INFINITY };
                };
                *shape = plane.carried(shape);
                let plane = InPlane::new(around, plane, settings.steps);
                multiple_shooting::solve(around, &plane, shape, tolerance, iterations)
            }
            Self::Collocation(collocation) => collocation.solve(around, settings),
            Self::Arcs(arcs) => arcs.solve(around, tolerance, iterations),
        }
    }

    /// The shape of the last solution, in the surroundings in which it was found.
    pub(super) fn shape(&self, around: &Surroundings<'_>, settings: &Settings) -> Option<Shape> {
        let of_nodes =
            |shape: &NodeShape, trace| Shape { nodes: shape.nodes.clone(), base: shape.wrenches[0], trace };
        match self {
            Self::Shooting(shooting) => shooting.shape(around),
            Self::MultipleShooting(shape) => {
                let trace = multiple_shooting::trace(around, &Spatial::new(around, settings.steps), shape)?;
                Some(of_nodes(shape, trace))
            }
            Self::Planar(shape) => {
                let plane = Plane::of(around.inputs, around.sources).ok()?;
                let plane = InPlane::new(around, plane, settings.steps);
                Some(of_nodes(shape, multiple_shooting::trace(around, &plane, shape)?))
            }
            Self::Collocation(collocation) => collocation.shape(around),
            Self::Arcs(arcs) => arcs.shape(around),
        }
    }
}
