//! Outputs that every device has: pose of the tip, loads, shape, bodies.

use nalgebra::Vector3;

use super::quantity::{ANGLE, DIRECTION, ENERGY, FIELD, FORCE, LENGTH, MOMENT, POSITION, QUATERNION, RATIO};
use super::row::{Derivative, Index, OutputRow, Owner, Request};
use super::spelling::{DEG, J, M, MM, MN, MT, N, NM, NUMBER, UNM};
use crate::equilibrium::Output;
use crate::manipulator::{Outputs, Reaction};

/// Largest bending angle of a core, rad.
fn largest_core_angle(outputs: &Outputs) -> f64 {
    outputs.core_angles.iter().copied().fold(0.0, f64::max)
}

/// A component of the reaction on the external magnet; 0 without one.
fn on_magnet(outputs: &Outputs, at: Index, part: fn(&Reaction) -> &Vector3<f64>) -> f64 {
    outputs.on_magnet().map_or(0.0, |reaction| part(reaction)[at.component])
}

/// Outputs that every device has.
pub const DEVICE: &[OutputRow] = &[
    OutputRow::new("tip.angle", ANGLE, "Angle between the tip's and the base's axis", |out, _| out.tip_angle)
        .min(0.0)
        .max(core::f64::consts::PI)
        .derivative(Derivative::Rows(|_| Output::TipAngle))
        .json("alpha")
        .column("alpha", DEG)
        .printed("tip angle", DEG, ""),
    OutputRow::new("tip.position", POSITION, "Position of the tip", |out, at| out.tip.position[at.component])
        .vector()
        .derivative(Derivative::Rows(|_| Output::TipPosition))
        .json("tip_position")
        .column("tip", MM)
        .printed("tip position", MM, ""),
    OutputRow::new(
        "tip.orientation",
        QUATERNION,
        "Orientation of the tip as a unit quaternion with w >= 0",
        |out, at| out.tip.quaternion()[at.component],
    )
    .components(4)
    .derivative(Derivative::TipQuaternion)
    .json("tip_orientation_wxyz"),
    OutputRow::new("tip.direction", DIRECTION, "Axis d3 of the tip", |out, at| out.tip.axis()[at.component])
        .vector()
        .outside_the_fmu()
        .printed("tip direction", NUMBER, ""),
    OutputRow::new("core.largest_angle", ANGLE, "Largest bending of a core", |out, _| {
        largest_core_angle(out)
    })
    .outside_the_fmu()
    .column("largest_core_angle", DEG)
    .printed("largest core angle", DEG, ""),
    OutputRow::new("force.magnetic", FORCE, "Total external magnetic force on the manipulator", |out, at| {
        out.magnetic_force[at.component]
    })
    .vector()
    .derivative(Derivative::Rows(|_| Output::MagneticForce))
    .json("magnetic_force")
    .column("magnetic_force", N)
    .printed("magnetic force", MN, ""),
    OutputRow::new(
        "torque.magnetic",
        MOMENT,
        "Total external magnetic torque about the base position",
        |out, at| out.magnetic_torque[at.component],
    )
    .vector()
    .derivative(Derivative::Rows(|_| Output::MagneticTorque))
    .json("magnetic_torque")
    .column("magnetic_torque", NM)
    .printed("magnetic torque", UNM, "about the base"),
    OutputRow::new(
        "base.reaction_force",
        FORCE,
        "Force that the clamp exerts on the manipulator",
        |out, at| out.base_reaction_force[at.component],
    )
    .vector()
    .derivative(Derivative::Rows(|_| Output::BaseReactionForce))
    .json("base_reaction_force")
    .column("base_reaction_force", N)
    .printed("base reaction force", MN, ""),
    OutputRow::new(
        "base.reaction_moment",
        MOMENT,
        "Moment that the clamp exerts about the base position",
        |out, at| out.base_reaction_moment[at.component],
    )
    .vector()
    .derivative(Derivative::Rows(|_| Output::BaseReactionMoment))
    .json("base_reaction_moment")
    .column("base_reaction_moment", NM)
    .printed("base reaction moment", UNM, ""),
    OutputRow::new("magnet.reaction_force", FORCE, "Force on the external magnet", |out, at| {
        on_magnet(out, at, |reaction| &reaction.force)
    })
    .vector()
    .derivative(Derivative::Rows(|_| Output::SourceReactionForce(0)))
    .json("magnet_reaction_force")
    .column("magnet_reaction_force", N)
    .printed("magnet reaction force", MN, ""),
    OutputRow::new(
        "magnet.reaction_torque",
        MOMENT,
        "Torque on the external magnet about its centre",
        |out, at| on_magnet(out, at, |reaction| &reaction.torque),
    )
    .vector()
    .derivative(Derivative::Rows(|_| Output::SourceReactionTorque(0)))
    .json("magnet_reaction_torque")
    .column("magnet_reaction_torque", NM)
    .printed("magnet reaction torque", UNM, "about its centre"),
    OutputRow::new("field.tip", FIELD, "External field at the tip", |out, at| out.tip_field[at.component])
        .vector()
        .derivative(Derivative::Rows(|_| Output::TipField))
        .column("tip_field", MT)
        .printed("external field at tip", MT, ""),
    OutputRow::new("shape.position", POSITION, "Point of the centreline, from base to tip", |out, at| {
        out.shape[at.item][at.component]
    })
    .of(Owner::Point)
    .vector()
    .derivative(Derivative::Rows(Output::ShapePoint))
    .json("shape"),
    OutputRow::new(
        "shape.arc_length",
        LENGTH,
        "Unstrained arc length of a centreline point from the base",
        |out, at| out.shape_arc_length[at.item],
    )
    .of(Owner::Point)
    .min(0.0)
    .derivative(Derivative::ShareOfShaft)
    .json("shape_arc_lengths"),
    OutputRow::new("ring[k].position", POSITION, "Centre of the ring magnet", |out, at| {
        out.rings[at.item].position[at.component]
    })
    .of(Owner::Ring)
    .vector()
    .derivative(Derivative::Rows(Output::RingPosition))
    .json("ring_positions"),
    OutputRow::new("ring[k].axis", DIRECTION, "Axis d3 of the ring magnet", |out, at| {
        out.rings[at.item].axis()[at.component]
    })
    .of(Owner::Ring)
    .vector()
    .derivative(Derivative::Rows(Output::RingAxis)),
    OutputRow::new(
        "core[k].angle",
        ANGLE,
        "Bending of the core; windings touch at design.helix.boundary_angle",
        |out, at| out.core_angles[at.item],
    )
    .of(Owner::Core)
    .min(0.0)
    .derivative(Derivative::Rows(Output::CoreAngle))
    .json("core_angles"),
];

/// Numbers that a solve adds to the shape.
pub const SOLVE: &[OutputRow] = &[
    OutputRow::new("energy", ENERGY, "Potential energy", |out, _| out.energy)
        .outside_the_fmu()
        .derivative(Derivative::OfSolve)
        .json("energy")
        .column("energy", J),
    OutputRow::new(
        "stability.margin",
        RATIO,
        "Smallest eigenvalue of the Hessian in the elastic norm of the strains: 1 without loads and interaction, 0 at a fold",
        |out, _| out.stability_margin,
    )
    .derivative(Derivative::OfSolve)
    .on_request(Request::Margin)
    .json("stability_margin")
    .column("stability_margin", NUMBER),
    OutputRow::new(
        "model.error_estimate",
        LENGTH,
        "Estimated distance of the tip from the converged answer of the model",
        |out, _| out.error_estimate,
    )
    .min(0.0)
    .derivative(Derivative::OfSolve)
    .json("error_estimate")
    .column("error_estimate", M),
];
