//! What can be measured: the names of outputs in a table, and how each is read.

use crate::manipulator::Outputs;

const MM: f64 = 1e3;
const MT: f64 = 1e3;

/// An output that a row can measure, in the unit of its name.
#[derive(Debug, Clone, Copy)]
pub struct Measurable {
    name: &'static str,
    unit: &'static str,
    read: fn(&Outputs) -> f64,
}

impl Measurable {
    /// All of them: the columns of `mcm sweep` that an instrument can tell, and `tip_angle_deg` for `alpha_deg`.
    #[must_use]
    pub fn all() -> &'static [Self] {
        &ALL
    }

    /// The one with this name.
    #[must_use]
    pub fn named(name: &str) -> Option<Self> {
        ALL.iter().find(|known| known.name == name).copied()
    }

    /// Name of its column, with the unit.
    #[must_use]
    pub fn name(&self) -> &'static str {
        self.name
    }

    /// Unit of its column.
    #[must_use]
    pub fn unit(&self) -> &'static str {
        self.unit
    }

    /// Its value, in the unit of the column; NaN where the device has none.
    #[must_use]
    pub fn read(&self, outputs: &Outputs) -> f64 {
        (self.read)(outputs)
    }
}

const fn of(name: &'static str, unit: &'static str, read: fn(&Outputs) -> f64) -> Measurable {
    Measurable { name, unit, read }
}

/// Largest bending angle of a core, deg.
fn largest_core_angle(outputs: &Outputs) -> f64 {
    outputs.core_angles.iter().copied().fold(0.0, f64::max).to_degrees()
}

const ALL: [Measurable; 34] = [
    of("alpha_deg", "deg", |out| out.tip_angle.to_degrees()),
    of("tip_angle_deg", "deg", |out| out.tip_angle.to_degrees()),
    of("tip_x_mm", "mm", |out| out.tip.position.x * MM),
    of("tip_y_mm", "mm", |out| out.tip.position.y * MM),
    of("tip_z_mm", "mm", |out| out.tip.position.z * MM),
    of("largest_core_angle_deg", "deg", largest_core_angle),
    of("magnetic_force_x_n", "N", |out| out.magnetic_force.x),
    of("magnetic_force_y_n", "N", |out| out.magnetic_force.y),
    of("magnetic_force_z_n", "N", |out| out.magnetic_force.z),
    of("magnetic_torque_x_nm", "N m", |out| out.magnetic_torque.x),
    of("magnetic_torque_y_nm", "N m", |out| out.magnetic_torque.y),
    of("magnetic_torque_z_nm", "N m", |out| out.magnetic_torque.z),
    of("base_reaction_force_x_n", "N", |out| out.base_reaction_force.x),
    of("base_reaction_force_y_n", "N", |out| out.base_reaction_force.y),
    of("base_reaction_force_z_n", "N", |out| out.base_reaction_force.z),
    of("base_reaction_moment_x_nm", "N m", |out| out.base_reaction_moment.x),
    of("base_reaction_moment_y_nm", "N m", |out| out.base_reaction_moment.y),
    of("base_reaction_moment_z_nm", "N m", |out| out.base_reaction_moment.z),
    of("magnet_reaction_force_x_n", "N", |out| out.magnet_reaction_force.x),
    of("magnet_reaction_force_y_n", "N", |out| out.magnet_reaction_force.y),
    of("magnet_reaction_force_z_n", "N", |out| out.magnet_reaction_force.z),
    of("magnet_reaction_torque_x_nm", "N m", |out| out.magnet_reaction_torque.x),
    of("magnet_reaction_torque_y_nm", "N m", |out| out.magnet_reaction_torque.y),
    of("magnet_reaction_torque_z_nm", "N m", |out| out.magnet_reaction_torque.z),
    of("tip_field_x_mt", "mT", |out| out.tip_field.x * MT),
    of("tip_field_y_mt", "mT", |out| out.tip_field.y * MT),
    of("tip_field_z_mt", "mT", |out| out.tip_field.z * MT),
    of("contact_force_x_n", "N", |out| out.wall.as_ref().map_or(f64::NAN, |wall| wall.force.x)),
    of("contact_force_y_n", "N", |out| out.wall.as_ref().map_or(f64::NAN, |wall| wall.force.y)),
    of("contact_force_z_n", "N", |out| out.wall.as_ref().map_or(f64::NAN, |wall| wall.force.z)),
    of("largest_contact_force_n", "N", |out| out.wall.as_ref().map_or(f64::NAN, |wall| wall.largest_force)),
    of("largest_indentation_m", "m", |out| {
        out.wall.as_ref().map_or(f64::NAN, |wall| wall.largest_indentation)
    }),
    of("feed_length_m", "m", |out| out.feed_length.unwrap_or(f64::NAN)),
    of("feed_reaction_force_n", "N", |out| out.feed_reaction.unwrap_or(f64::NAN)),
];
