//! Results of a solved shape, independent of the method that found it.

use nalgebra::{Matrix3, Vector3};

use crate::equilibrium::contact::WallForces;
use crate::equilibrium::model::Inputs;
use crate::geometry::Pose;
use crate::magnetics::{Sources, Wrench};

/// The last solved shape and its loads, world frame, SI units; before the first solve, the straight shape at the origin.
pub trait Solution {
    /// Pose of the tip: the distal face of the last body.
    fn tip(&self) -> Pose;

    /// Poses of the rings' centres, from base to tip.
    fn rings(&self) -> impl Iterator<Item = Pose> + '_;

    /// Bending angle of each core (of the whole rod, for a plain cylinder), rad.
    fn core_angles(&self) -> impl Iterator<Item = f64> + '_;

    /// Unstrained arc length (m) and position (m) of the shape points, from base to tip.
    fn shape(&self) -> impl Iterator<Item = (f64, Vector3<f64>)> + '_;

    /// Directors (columns `d1`, `d2`, `d3`, world frame) and curvature (1/m, material frame: about `d1` and `d2`, twist about `d3`) at
    /// the shape points; at a joint that of the section towards the tip, 0 in rigid parts.
    fn shape_strains(&self) -> impl Iterator<Item = (Matrix3<f64>, Vector3<f64>)> + '_;

    /// Total external magnetic wrench on the manipulator, torque about the base position.
    fn magnetic_wrench(&self) -> Wrench;

    /// Force and moment (about the base position) that the clamp exerts.
    fn base_reaction(&self) -> Wrench;

    /// Push (N) that holds a shaft in its port at the inputs of the last solve; `None` without a shaft.
    fn feed_reaction(&self, _inputs: &Inputs) -> Option<f64> {
        None
    }

    /// Forces of the vessel's wall; `None` without a vessel.
    fn wall(&self) -> Option<WallForces> {
        None
    }

    /// The magnets and coils around the manipulator.
    fn sources(&self) -> &Sources;

    /// Wrench on the source of this number about its centre; `inputs` must be those of the last solve.
    fn source_reaction(&self, number: usize, inputs: &Inputs) -> Wrench;

    /// External field (T) at a point, m; `None` inside a magnet or coil.
    fn field_at(&self, inputs: &Inputs, point: &Vector3<f64>) -> Option<Vector3<f64>>;
}
