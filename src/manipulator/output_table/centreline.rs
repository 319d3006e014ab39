//! Outputs of the centreline beside its points: tangents and curvatures.

use nalgebra::Vector3;

use super::quantity::{CURVATURE, DIRECTION};
use super::row::{Derivative, Index, OutputRow, Owner, Request};
use crate::equilibrium::Output;

/// A component at a point; NaN before it is computed.
fn at_point(vectors: &[Vector3<f64>], at: Index) -> f64 {
    vectors.get(at.item).map_or(f64::NAN, |vector| vector[at.component])
}

/// Tangents and curvatures.
pub const CENTRELINE: &[OutputRow] = &[
    OutputRow::new("shape.tangent", DIRECTION, "Director d3 at a centreline point", |out, at| {
        at_point(&out.shape_tangents, at)
    })
    .of(Owner::Point)
    .vector()
    .derivative(Derivative::Rows(Output::ShapeTangent))
    .on_request(Request::Strains)
    .json("shape_tangents"),
    OutputRow::new(
        "shape.curvature",
        CURVATURE,
        "Curvature at a centreline point, 0 in rigid parts, at a joint that of the section towards the tip",
        |out, at| at_point(&out.shape_curvatures, at),
    )
    .of(Owner::Point)
    .vector()
    .derivative(Derivative::Rows(Output::ShapeCurvature))
    .on_request(Request::Strains)
    .json("shape_curvatures"),
];
