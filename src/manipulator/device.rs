//! The manipulator: a design, an external magnet, and the last shape.

use nalgebra::Vector3;

use super::{Inputs, Outputs, Status};
use crate::design::Design;
use crate::equilibrium::{Report, Settings, Solver};
use crate::error::Error;
use crate::magnetics::Assembly;

/// A manipulator that remembers its shape from one solve to the next.
///
/// A clone is a full snapshot: it answers bit for bit as the original would.
///
/// ```
/// use mcm::design::{Design, Specification};
/// use mcm::equilibrium::Settings;
/// use mcm::manipulator::{Inputs, Manipulator, Status};
/// let design = Design::new(Specification::paper(1))?;
/// let mut manipulator = Manipulator::new(&design, None, Settings::default(), 11)?;
/// let mut inputs = Inputs::unloaded(2);
/// inputs.uniform_field.y = 0.02;
/// let outputs = manipulator.solve(&inputs)?;
/// assert_eq!(outputs.status, Status::Solved);
/// assert!((outputs.tip_angle.to_degrees() - 34.78).abs() < 0.01);
/// inputs.uniform_field.y = f64::NAN;
/// assert!(manipulator.solve(&inputs).is_err());
/// # Ok::<(), mcm::error::Error>(())
/// ```
#[derive(Debug, Clone)]
pub struct Manipulator {
    solver: Solver,
    outputs: Outputs,
}

impl Manipulator {
    /// A manipulator of `design` near `magnet` (`None`: no external magnet), unsolved.
    ///
    /// `shape_points` is the number of centreline points in the outputs, at least 2.
    ///
    /// # Errors
    /// [`Error`] for settings out of range, or a method that cannot solve the model asked for.
    pub fn new(
        design: &Design,
        magnet: Option<&Assembly>,
        settings: Settings,
        shape_points: usize,
    ) -> Result<Self, Error> {
        let solver = Solver::new(design, magnet, settings, shape_points)?;
        let outputs = straight(&solver);
        Ok(Self { solver, outputs })
    }

    /// Follows the equilibrium from the last inputs to `inputs` (the first time: from the unloaded shape).
    ///
    /// A solve that fails is no error: it says [`Status::NotSolved`] and keeps the last good outputs.
    ///
    /// # Errors
    /// [`Error::Range`] or [`Error::Count`] for inputs that are not finite or not of the right length; the
    /// state is then untouched.
    pub fn solve(&mut self, inputs: &Inputs) -> Result<&Outputs, Error> {
        let report = self.solver.solve(inputs)?;
        if report.solved {
            self.observe(inputs, &report);
        } else {
            self.outputs.status = Status::NotSolved;
            self.outputs.iterations = report.iterations;
            self.outputs.residual = report.residual;
        }
        Ok(&self.outputs)
    }

    /// The outputs of the last solve; before the first, those of the straight unloaded shape at the origin.
    #[must_use]
    pub fn outputs(&self) -> &Outputs {
        &self.outputs
    }

    /// Measures the stability margin of the last solved shape, which a solve alone bounds from above, and puts
    /// it into the outputs.
    pub fn measure_margin(&mut self) -> &Outputs {
        if let Some(margin) = self.solver.margin() {
            self.outputs.stability_margin = margin;
        }
        &self.outputs
    }

    /// Forgets the shape and the count of snaps.
    pub fn reset(&mut self) {
        self.solver.reset();
        self.outputs = straight(&self.solver);
    }

    fn observe(&mut self, inputs: &Inputs, report: &Report) {
        let (solver, out) = (&self.solver, &mut self.outputs);
        out.tip = solver.tip();
        out.tip_angle = inputs.base.axis().angle(&out.tip.axis());
        let magnetic = solver.magnetic_wrench();
        (out.magnetic_force, out.magnetic_torque) = (magnetic.force, magnetic.torque);
        let base = solver.base_reaction();
        (out.base_reaction_force, out.base_reaction_moment) = (base.force, base.torque);
        let magnet = solver.magnet_reaction(inputs);
        (out.magnet_reaction_force, out.magnet_reaction_torque) = (magnet.force, magnet.torque);
        out.tip_field = solver.field_at(inputs, &out.tip.position).unwrap_or_default();
        copy_shape(solver, out);
        out.stable = report.stable;
        out.stability_margin = report.margin;
        out.snaps += report.snaps;
        out.status = if report.snaps > 0 {
            Status::Snapped
        } else if report.stable.is_some() && report.margin < solver.settings().fold_margin {
            Status::NearFold
        } else {
            Status::Solved
        };
        out.iterations = report.iterations;
        out.residual = report.residual;
        out.energy = report.energy;
    }
}

fn copy_shape(solver: &Solver, out: &mut Outputs) {
    for ((slot, place), (arc_length, position)) in
        out.shape.iter_mut().zip(&mut out.shape_arc_length).zip(solver.shape())
    {
        (*slot, *place) = (position, arc_length);
    }
    out.rings.iter_mut().zip(solver.rings()).for_each(|(slot, pose)| *slot = pose);
    out.core_angles.iter_mut().zip(solver.core_angles()).for_each(|(slot, angle)| *slot = angle);
}

/// Outputs of the straight, unloaded manipulator at the origin.
fn straight(solver: &Solver) -> Outputs {
    let zero = Vector3::zeros();
    let (shape_arc_length, shape) = solver.shape().unzip();
    Outputs {
        tip_angle: 0.0,
        tip: solver.tip(),
        magnetic_force: zero,
        magnetic_torque: zero,
        base_reaction_force: zero,
        base_reaction_moment: zero,
        magnet_reaction_force: zero,
        magnet_reaction_torque: zero,
        tip_field: zero,
        shape_arc_length,
        shape,
        rings: solver.rings().collect(),
        core_angles: solver.core_angles().collect(),
        stable: Some(true),
        stability_margin: 1.0,
        snaps: 0,
        status: Status::Solved,
        iterations: 0,
        residual: 0.0,
        energy: 0.0,
        interaction: solver.settings().interaction,
        method: solver.settings().method,
    }
}
