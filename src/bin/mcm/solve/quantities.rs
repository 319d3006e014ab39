//! What a solve has found, in the units of the table.

use std::borrow::Cow;

use mcm::manipulator::Outputs;
use nalgebra::Vector3;

/// A quantity with its components in a unit.
pub(super) struct Quantity {
    pub(super) name: Cow<'static, str>,
    pub(super) components: Vec<f64>,
    pub(super) unit: &'static str,
}

/// What the shape and its forces are, in the units of the table.
pub(super) fn quantities(outputs: &Outputs) -> Vec<Quantity> {
    let number = |name: &'static str, number: f64, unit| Quantity {
        name: name.into(),
        components: vec![number],
        unit,
    };
    let vector = |name: &'static str, v: &Vector3<f64>, factor: f64, unit| Quantity {
        name: name.into(),
        components: (v * factor).as_slice().to_vec(),
        unit,
    };
    let largest = outputs.core_angles.iter().copied().fold(0.0, f64::max);
    let mut out = vec![
        number("tip angle", outputs.tip_angle.to_degrees(), "deg"),
        vector("tip position", &outputs.tip.position, 1e3, "mm"),
        vector("tip direction", &outputs.tip.axis(), 1.0, ""),
        number("largest core angle", largest.to_degrees(), "deg"),
        vector("magnetic force", &outputs.magnetic_force, 1e3, "mN"),
        vector("magnetic torque", &outputs.magnetic_torque, 1e6, "mN.mm, about the base"),
        vector("base reaction force", &outputs.base_reaction_force, 1e3, "mN"),
        vector("base reaction moment", &outputs.base_reaction_moment, 1e6, "mN.mm"),
        vector("magnet reaction force", &outputs.magnet_reaction_force, 1e3, "mN"),
        vector("magnet reaction torque", &outputs.magnet_reaction_torque, 1e6, "mN.mm, about its centre"),
        vector("external field at tip", &outputs.tip_field, 1e3, "mT"),
    ];
    for (number, wrench) in (2..).zip(&outputs.further_reactions) {
        let named = |what: &str, v: &Vector3<f64>, factor: f64, unit| Quantity {
            name: format!("{what} on source {number}").into(),
            ..vector("", v, factor, unit)
        };
        out.push(named("force", &wrench.force, 1e3, "mN, magnets first, then coils"));
        out.push(named("torque", &wrench.torque, 1e6, "mN.mm, about its centre"));
    }
    if let Some(wall) = &outputs.wall {
        out.push(vector("force of the wall", &wall.force, 1e3, "mN"));
        out.push(number("largest contact force", 1e3 * wall.largest_force, "mN"));
        out.push(number("largest indentation", 1e6 * wall.largest_indentation, "um"));
    }
    if let Some((length, push)) = outputs.feed_length.zip(outputs.feed_reaction) {
        out.push(number("inserted length", 1e3 * length, "mm"));
        out.push(number("push at the port", 1e3 * push, "mN"));
    }
    out
}
