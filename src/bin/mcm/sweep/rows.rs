//! The columns of a sweep's table.

use mcm::manipulator::{Outputs, Status};

use nalgebra::Vector3;

use super::Way;

/// Tips closer than this are those of one shape, mm: ten thousand times what a solve leaves.
const SAME_TIP: f64 = 1e-4;

const NUMBERS: [&str; 29] = [
    "alpha_deg",
    "tip_x_mm",
    "tip_y_mm",
    "tip_z_mm",
    "largest_core_angle_deg",
    "magnetic_force_x_n",
    "magnetic_force_y_n",
    "magnetic_force_z_n",
    "magnetic_torque_x_nm",
    "magnetic_torque_y_nm",
    "magnetic_torque_z_nm",
    "base_reaction_force_x_n",
    "base_reaction_force_y_n",
    "base_reaction_force_z_n",
    "base_reaction_moment_x_nm",
    "base_reaction_moment_y_nm",
    "base_reaction_moment_z_nm",
    "magnet_reaction_force_x_n",
    "magnet_reaction_force_y_n",
    "magnet_reaction_force_z_n",
    "magnet_reaction_torque_x_nm",
    "magnet_reaction_torque_y_nm",
    "magnet_reaction_torque_z_nm",
    "tip_field_x_mt",
    "tip_field_y_mt",
    "tip_field_z_mt",
    "energy_j",
    "residual",
    "stability_margin",
];

const FLAGS: [&str; 4] = ["stable", "snaps", "converged", "iterations"];

/// One line of the table.
pub(super) struct Row {
    varied: Vec<f64>,
    way: Way,
    numbers: Vec<f64>,
    predicted_fold: Option<f64>,
    flags: (Option<bool>, u32, bool, u32),
}

/// The table's header for these keys.
pub(super) fn header<'a>(keys: impl Iterator<Item = &'a str>) -> impl Iterator<Item = &'a str> {
    keys.chain(["way"]).chain(NUMBERS).chain(["predicted_fold"]).chain(FLAGS)
}

impl Row {
    /// The cells in the order of [`header`].
    pub(super) fn cells(&self) -> impl serde::Serialize + '_ {
        (&self.varied, self.way, &self.numbers, self.predicted_fold, self.flags)
    }

    pub(super) fn new(varied: Vec<f64>, way: Way, outputs: &Outputs, predicted_fold: Option<f64>) -> Self {
        const MM_PER_M: f64 = 1e3;
        const MT_PER_T: f64 = 1e3;
        let largest = outputs.core_angles.iter().copied().fold(0.0, f64::max);
        let mut numbers = vec![outputs.tip_angle.to_degrees()];
        numbers.extend(&(outputs.tip.position * MM_PER_M));
        numbers.push(largest.to_degrees());
        for vector in [
            &outputs.magnetic_force,
            &outputs.magnetic_torque,
            &outputs.base_reaction_force,
            &outputs.base_reaction_moment,
            &outputs.magnet_reaction_force,
            &outputs.magnet_reaction_torque,
            &(outputs.tip_field * MT_PER_T),
        ] {
            numbers.extend(vector);
        }
        numbers.extend([outputs.energy, outputs.residual, outputs.stability_margin]);
        let converged = outputs.status != Status::NotSolved;
        let flags = (outputs.stable, outputs.snaps, converged, outputs.iterations);
        Self { varied, way, numbers, predicted_fold, flags }
    }

    /// The first key's value.
    pub(super) fn value(&self) -> f64 {
        self.varied[0]
    }

    /// The tip angle, deg.
    pub(super) fn angle(&self) -> f64 {
        self.numbers[0]
    }

    pub(super) fn way(&self) -> Way {
        self.way
    }

    pub(super) fn converged(&self) -> bool {
        self.flags.2
    }

    /// Whether the tip is elsewhere, or one of the two is no solved shape.
    pub(super) fn differs(&self, other: &Self) -> bool {
        let tip = |row: &Self| Vector3::from_row_slice(&row.numbers[1..4]);
        self.converged() != other.converged() || (tip(self) - tip(other)).norm() > SAME_TIP
    }
}
