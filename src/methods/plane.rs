//! The plane that contains base axis, field and loads, if there is one.

use nalgebra::Vector3;

use crate::equilibrium::Inputs;
use crate::error::Error;
use crate::geometry::Pose;
use crate::magnetics::{LinearField, Sources};

/// Tolerance of a vector's out-of-plane component relative to its norm: rounding of orientations.
const SLACK: f64 = 1e-9;

/// A plane through the base and its axis.
#[derive(Debug, Clone, Copy)]
pub(super) struct Plane {
    pub(super) base: Pose,
    /// Unit vector in the plane, perpendicular to the base's axis; positive rotations about the normal are towards it.
    pub(super) across: Vector3<f64>,
    pub(super) normal: Vector3<f64>,
}

impl Plane {
    /// The plane of these inputs and of the sources that are switched on.
    ///
    /// # Errors
    /// [`Error::Unsupported`] naming the quantity that lies outside any such plane, or a source that is not axisymmetric.
    pub(super) fn of(inputs: &Inputs, sources: &Sources) -> Result<Self, Error> {
        let base = inputs.base;
        let axis = base.axis();
        let field = LinearField::new(inputs.uniform_field, inputs.field_gradient);
        let gradient = field.gradient();
        let mut inside = vec![
            ("background field", field.at(&base.position)),
            ("field gradient", gradient * axis),
            ("gravity", inputs.gravity),
            ("tip force", inputs.tip_force),
        ];
        inside.extend(inputs.ring_forces.iter().map(|force| ("ring force", *force)));
        let placed = sources.list().iter().zip(&inputs.sources).enumerate();
        for (number, (kind, source)) in placed.filter(|(_, (_, placed))| placed.strength != 0.0) {
            if !kind.is_axisymmetric() {
                let name = sources.name(number);
                return Err(Error::Unsupported(format!(
                    "method \"planar\": the field of {name} leaves the plane, as it is not axisymmetric about its z axis"
                )));
            }
            inside.push(("magnet's axis", source.pose.axis()));
            inside.push(("magnet's position", source.pose.position - base.position));
        }
        // Direction in which the tip moment rotates the tangent.
        let turned = ("tip moment", inputs.tip_moment.cross(&axis));
        let aside = |v: &Vector3<f64>| v - axis * v.dot(&axis);
        let steep = |v: &Vector3<f64>| aside(v).norm() / v.norm().max(f64::MIN_POSITIVE);
        let widest = inside.iter().chain([&turned]).max_by(|a, b| steep(&a.1).total_cmp(&steep(&b.1)));
        let across = widest.filter(|(_, v)| steep(v) > SLACK).and_then(|(_, v)| aside(v).try_normalize(0.0));
        let across = across.unwrap_or_else(|| base.rotation.column(1).into_owned());
        let normal = axis.cross(&across);
        inside.push(("field gradient", gradient * across));
        // Out-of-plane field gradients appear in two products, so they are compared with the norm of the whole matrix.
        let size = |name: &str, v: &Vector3<f64>| {
            if name == "field gradient" { gradient.norm() } else { v.norm() }
        };
        let outside = inside.iter().find(|(name, v)| v.dot(&normal).abs() > SLACK * size(name, v));
        let moment = inputs.tip_moment;
        let about_other = (moment - normal * moment.dot(&normal)).norm() > SLACK * moment.norm();
        match outside.map(|(name, _)| *name).or(about_other.then_some("tip moment's plane")) {
            Some(name) => Err(Error::Unsupported(format!(
                "method \"planar\": the {name} does not lie in one plane with the base's axis and the other loads"
            ))),
            None => Ok(Self { base, across, normal }),
        }
    }
}
