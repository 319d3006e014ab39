//! Partner FMU `Arm`: the end effector of a robot arm that carries the external magnet along a commanded path.
//!
//! The wrist is a spring and a damper side by side, `damping d' + stiffness d = force`: the force on the magnet pulls it
//! off the path by the deflection `d`, which starts at zero and tends to `force / stiffness`. The force is taken as
//! constant during a step, for which the solution is exact.
//!
//! The path starts at the magnet's start pose of `mcm.fmu`, travels and turns about x, and ends at rest after `duration`.

use fmu_from_struct::prelude::*;

/// The variables; SI units, world frame. The crate writes the model description from it.
#[derive(Fmu, Default)]
#[fmu_from_struct(fmi_version = 2)]
pub struct Arm {
    /// Stiffness of the wrist, N/m.
    #[fmu_from_struct(parameter)]
    #[fmu_from_struct(start_value = 10.0)]
    pub stiffness: f64,
    /// Damping of the wrist, N s/m.
    #[fmu_from_struct(start_value = 2.0)]
    pub damping: f64,
    /// Time from the start to the end of the path, s.
    #[fmu_from_struct(start_value = 4.0)]
    pub duration: f64,
    /// Start of the path, m.
    pub start_x: f64,
    #[fmu_from_struct(start_value = -0.12)]
    pub start_y: f64,
    #[fmu_from_struct(start_value = 0.023)]
    pub start_z: f64,
    /// From the start to the end of the path, m.
    #[fmu_from_struct(start_value = 0.01)]
    pub travel_x: f64,
    pub travel_y: f64,
    #[fmu_from_struct(start_value = 0.06)]
    pub travel_z: f64,
    /// Turn about x from the start to the end, rad.
    #[fmu_from_struct(start_value = 0.5)]
    pub turn: f64,
    /// Force on the magnet, N.
    #[fmu_from_struct(input)]
    pub force_x: f64,
    pub force_y: f64,
    pub force_z: f64,
    /// Centre of the magnet, m. The start values of the outputs are for masters that read them during initialisation.
    #[fmu_from_struct(output)]
    pub position_x: f64,
    #[fmu_from_struct(start_value = -0.12)]
    pub position_y: f64,
    #[fmu_from_struct(start_value = 0.023)]
    pub position_z: f64,
    /// Orientation of the magnet, a unit quaternion; at first its axis points along -z.
    pub orientation_w: f64,
    #[fmu_from_struct(start_value = 1.0)]
    pub orientation_x: f64,
    pub orientation_y: f64,
    pub orientation_z: f64,
    /// How far the force has pulled the magnet off the path, m.
    pub deflection_x: f64,
    pub deflection_y: f64,
    pub deflection_z: f64,
}

impl Arm {
    /// Puts the magnet where the path and the deflection have it at `time`.
    fn place(&mut self, time: f64) {
        let share = (time / self.duration).clamp(0.0, 1.0);
        let eased = share * share * (3.0 - 2.0 * share);
        self.position_x = self.start_x + eased * self.travel_x + self.deflection_x;
        self.position_y = self.start_y + eased * self.travel_y + self.deflection_y;
        self.position_z = self.start_z + eased * self.travel_z + self.deflection_z;
        // A turn about x by pi and then by the commanded angle.
        let half = 0.5 * eased * self.turn;
        self.orientation_w = -half.sin();
        self.orientation_x = half.cos();
    }
}

impl FmuFunctions for Arm {
    fn exit_initialization_mode(&mut self) {
        self.place(0.0);
    }

    fn do_step(&mut self, time: f64, step: f64) {
        let kept = (-step * self.stiffness / self.damping).exp();
        let relaxed = |deflection: f64, force: f64| kept * deflection + (1.0 - kept) * force / self.stiffness;
        self.deflection_x = relaxed(self.deflection_x, self.force_x);
        self.deflection_y = relaxed(self.deflection_y, self.force_y);
        self.deflection_z = relaxed(self.deflection_z, self.force_z);
        self.place(time + step);
    }
}
