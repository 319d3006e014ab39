//! The columns of a sweep's table.

use mcm::manipulator::{Outcome, Outputs};
use nalgebra::Vector3;

use super::Way;
use crate::verdict;

/// Tip distance up to which two shapes count as equal, mm: ten thousand times the error that a solve leaves.
const SAME_TIP: f64 = 1e-4;

/// Columns of the shape, which are empty in a row that did not converge.
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
    "stability_margin",
    "error_estimate_m",
];

/// Columns of the solve.
const SEARCH: [&str; 9] = [
    "predicted_fold",
    "stable",
    "stability",
    "snaps",
    "converged",
    "outcome",
    "progress",
    "iterations",
    "residual",
];

/// One line of the table.
pub(super) struct Row {
    varied: Vec<f64>,
    way: Way,
    numbers: Vec<f64>,
    predicted_fold: Option<f64>,
    stable: Option<bool>,
    stability: Option<&'static str>,
    snaps: u32,
    outcome: Outcome,
    progress: f64,
    iterations: u32,
    residual: f64,
}

/// The table's header for these keys.
pub(super) fn header<'a>(keys: impl Iterator<Item = &'a str>) -> impl Iterator<Item = &'a str> {
    keys.chain(["way"]).chain(NUMBERS).chain(SEARCH)
}

impl Row {
    /// The cells in the order of [`header`].
    pub(super) fn cells(&self) -> impl serde::Serialize + '_ {
        let converged = self.converged();
        let numbers: Vec<_> = self.numbers.iter().map(|number| converged.then_some(number)).collect();
        let verdict = (self.predicted_fold, self.stable.filter(|_| converged), self.stability, self.snaps);
        let search = (converged, self.outcome.name(), self.progress, self.iterations, self.residual);
        (&self.varied, self.way, numbers, verdict, search)
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
        numbers.extend([outputs.energy, outputs.stability_margin, outputs.error_estimate]);
        Self {
            varied,
            way,
            numbers,
            predicted_fold,
            stable: outputs.stable,
            stability: verdict::stability(outputs),
            snaps: outputs.snaps,
            outcome: outputs.outcome,
            progress: outputs.progress,
            iterations: outputs.iterations,
            residual: outputs.residual,
        }
    }

    /// The first key's value.
    pub(super) fn value(&self) -> f64 {
        self.varied[0]
    }

    pub(super) fn outcome(&self) -> Outcome {
        self.outcome
    }

    /// The tip angle of the last shape that was found, deg.
    pub(super) fn angle(&self) -> f64 {
        self.numbers[0]
    }

    pub(super) fn way(&self) -> Way {
        self.way
    }

    pub(super) fn converged(&self) -> bool {
        self.outcome.is_solved()
    }

    /// Whether the tip positions differ, or only one of the two rows converged.
    pub(super) fn differs(&self, other: &Self) -> bool {
        let tip = |row: &Self| Vector3::from_row_slice(&row.numbers[1..4]);
        self.converged() != other.converged() || (tip(self) - tip(other)).norm() > SAME_TIP
    }
}
