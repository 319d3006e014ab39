//! Outputs of the manipulator, in the world frame and SI units.

use nalgebra::Vector3;
use serde::{Deserialize, Serialize};

use super::Inputs;
use crate::equilibrium::{Interaction, Outcome, Report, Solution, WallForces};
use crate::geometry::Pose;
use crate::magnetics::{SourceName, Wrench};

/// How the last solve ended.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
pub enum Status {
    /// Solved, on the branch that was followed.
    Solved,
    /// Solved, close to a fold: a small increase of load makes the shape snap.
    NearFold,
    /// Solved, after a jump to another branch in this solve.
    Snapped,
    /// Not solved: the other outputs are the last good ones.
    NotSolved,
}

/// Wrench of the manipulator on a magnet or coil about its centre.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct Reaction {
    /// On which.
    pub source: SourceName,
    /// Force, N.
    pub force: Vector3<f64>,
    /// Torque, N m.
    pub torque: Vector3<f64>,
}

/// The result of one solve.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Outputs {
    /// Angle between the tip's and the base's `d3`, rad, in `[0, pi]`.
    pub tip_angle: f64,
    /// Pose of the tip (distal face of the last body).
    pub tip: Pose,
    /// Total external magnetic force on the manipulator, N.
    pub magnetic_force: Vector3<f64>,
    /// Total external magnetic torque about the base position, N m.
    pub magnetic_torque: Vector3<f64>,
    /// Force that the clamp exerts on the manipulator, N.
    pub base_reaction_force: Vector3<f64>,
    /// Moment that the clamp exerts on the manipulator, about the base position, N m.
    pub base_reaction_moment: Vector3<f64>,
    /// Wrench of the manipulator on each magnet and coil about its centre, in the order of [`super::Inputs::sources`].
    pub reactions: Vec<Reaction>,
    /// Wrench of all other magnets and coils on each, in that order, about its centre, N and N m; empty until
    /// [`super::Manipulator::measure_mutual_wrenches`] computes them.
    pub mutual_wrenches: Vec<Wrench>,
    /// External field at the tip, T.
    pub tip_field: Vector3<f64>,
    /// Unstrained arc length of the shape points, m; first at the base, last at the tip.
    pub shape_arc_length: Vec<f64>,
    /// Centreline points at those arc lengths, m.
    pub shape: Vec<Vector3<f64>>,
    /// Director `d3` at those points, world frame; empty until [`super::Manipulator::measure_strains`] computes them.
    pub shape_tangents: Vec<Vector3<f64>>,
    /// Curvature about `d1` and `d2`, and twist about `d3`, at those points, material frame, 1/m: at a joint those of the section
    /// towards the tip, 0 in rigid parts; empty until [`super::Manipulator::measure_strains`] computes them.
    pub shape_curvatures: Vec<Vector3<f64>>,
    /// Pose of each ring's centre, base to tip.
    pub rings: Vec<Pose>,
    /// Bending angle of each core (of each element of a plain cylinder), rad.
    pub core_angles: Vec<f64>,
    /// Forces of the vessel's wall; `None` without a vessel.
    pub wall: Option<WallForces>,
    /// Length of the shaft inside its port, m; `None` without a shaft.
    pub feed_length: Option<f64>,
    /// Push that holds the shaft in its port, N: derivative of the potential energy with respect to the inserted length; `None`
    /// without a shaft.
    pub feed_reaction: Option<f64>,
    /// Whether the equilibrium is stable; `None` where the method does not compute it. Where loads have no potential, by the eigenvalues of
    /// the whole stiffness matrix.
    pub stable: Option<bool>,
    /// Smallest eigenvalue of the Hessian in the elastic norm of the variation of the strains at the shape: 1 without loads and
    /// interaction, 0 at a fold.
    ///
    /// An upper bound until [`super::Manipulator::measure_margin`] computes it: close near a fold, and outdated by up to some
    /// percent along small steps.
    pub stability_margin: f64,
    /// Jumps to another branch since the first solve.
    pub snaps: u32,
    /// How the solve ended.
    pub status: Status,
    /// Detailed outcome, with the reason where it is not solved.
    pub outcome: Outcome,
    /// Fraction of the input change that the last solve completed, from 0 to 1; 1 where it is solved.
    pub progress: f64,
    /// Newton iterations of the last solve.
    pub iterations: u32,
    /// Residual relative to the elastic forces of the chain, in the norm of the elastic energy.
    pub residual: f64,
    /// Potential energy, J.
    pub energy: f64,
    /// Interaction level of the model in use.
    pub interaction: Interaction,
    /// Degree of the strain modes in use: higher than that of the settings where the tolerances need it.
    pub degree: usize,
    /// Estimated distance of the tip from the converged model, m.
    ///
    /// It covers the degree of the strain modes, the pair quadratures, the residual and, under `auto`, the cheaper interaction.
    /// It is computed at the first solve and again once shape, field or loads have changed by 2 % (by up to 20 % where it is
    /// far below the tolerance), and grows in between. It equals the length where no estimate is available, as for a neutral
    /// shape, and 0 for a comparison method, which computes none.
    pub error_estimate: f64,
    /// Whether the estimated error of the tip's position or angle is larger than its tolerance, as close to a fold, where the finest
    /// discretisation is not enough.
    pub beyond_tolerance: bool,
}

/// Interaction level, degree and error estimate of a solution.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Resolution {
    pub(crate) interaction: Interaction,
    pub(crate) degree: usize,
    /// Estimated distance of the tip from the converged model, m.
    pub(crate) error_estimate: f64,
    /// Whether it is larger than what is allowed.
    pub(crate) beyond_tolerance: bool,
}

impl Outputs {
    /// Outputs of the straight, unloaded manipulator at the origin, the state of a new or reset `solution`.
    pub(crate) fn straight(solution: &impl Solution, resolution: Resolution) -> Self {
        let zero = Vector3::zeros();

        let (shape_arc_length, shape) = solution.shape().unzip();
        let Resolution { interaction, degree, error_estimate, beyond_tolerance } = resolution;

        Self {
            tip_angle: 0.0,
            tip: solution.tip(),
            magnetic_force: zero,
            magnetic_torque: zero,
            base_reaction_force: zero,
            base_reaction_moment: zero,
            reactions: Vec::new(),
            mutual_wrenches: Vec::new(),
            tip_field: zero,
            shape_arc_length,
            shape,
            shape_tangents: Vec::new(),
            shape_curvatures: Vec::new(),
            rings: solution.rings().collect(),
            core_angles: solution.core_angles().collect(),
            wall: solution.wall(),
            feed_length: None,
            feed_reaction: None,
            stable: Some(true),
            stability_margin: 1.0,
            snaps: 0,
            status: Status::Solved,
            outcome: Outcome::Solved,
            progress: 1.0,
            iterations: 0,
            residual: 0.0,
            energy: 0.0,
            interaction,
            degree,
            error_estimate,
            beyond_tolerance,
        }
    }

    /// Reads the shape and wrenches of the last solve, at `inputs`, without allocating but for the forces of a wall.
    pub(crate) fn read(&mut self, solution: &impl Solution, inputs: &Inputs, resolution: Resolution) {
        self.tip = solution.tip();
        self.tip_angle = inputs.base.axis().angle(&self.tip.axis());
        let magnetic = solution.magnetic_wrench();
        (self.magnetic_force, self.magnetic_torque) = (magnetic.force, magnetic.torque);
        let base = solution.base_reaction();
        (self.base_reaction_force, self.base_reaction_moment) = (base.force, base.torque);

        // Not known at this shape: computed only where they are asked for.
        self.mutual_wrenches.clear();
        self.shape_tangents.clear();
        self.shape_curvatures.clear();
        self.reactions.clear();

        self.reactions.extend((0..inputs.sources.len()).map(|number| {
            let Wrench { force, torque } = solution.source_reaction(number, inputs);
            Reaction { source: solution.sources().name(number), force, torque }
        }));

        self.tip_field = solution.field_at(inputs, &self.tip.position).unwrap_or_default();
        self.wall = solution.wall();
        self.feed_reaction = solution.feed_reaction(inputs);
        self.feed_length = self.feed_reaction.map(|_| inputs.insertion);

        let places = self.shape.iter_mut().zip(&mut self.shape_arc_length);
        places.zip(solution.shape()).for_each(|((point, place), (s, at))| (*point, *place) = (at, s));
        self.rings.iter_mut().zip(solution.rings()).for_each(|(slot, pose)| *slot = pose);
        self.core_angles.iter_mut().zip(solution.core_angles()).for_each(|(slot, angle)| *slot = angle);

        let Resolution { interaction, degree, error_estimate, beyond_tolerance } = resolution;
        (self.interaction, self.degree) = (interaction, degree);
        (self.error_estimate, self.beyond_tolerance) = (error_estimate, beyond_tolerance);
    }

    /// The reaction on the external magnet, if there is one.
    pub(super) fn on_magnet(&self) -> Option<&Reaction> {
        self.reactions.first().filter(|reaction| reaction.source == SourceName::Magnet(0))
    }

    /// The reactions on all other magnets and coils.
    pub(super) fn on_others(&self) -> &[Reaction] {
        self.reactions.get(usize::from(self.on_magnet().is_some())..).unwrap_or(&[])
    }

    /// Whether the strains of the shape are computed.
    pub(super) fn has_strains(&self) -> bool {
        !self.shape_tangents.is_empty()
    }

    /// Reads tangents and curvatures of the shape, unless they are there already.
    pub(crate) fn read_strains(&mut self, solution: &impl Solution) {
        if self.has_strains() {
            return;
        }
        for (directors, curvature) in solution.shape_strains() {
            self.shape_tangents.push(directors.column(2).into_owned());
            self.shape_curvatures.push(curvature);
        }
    }

    /// Records how a solve ended; without a solution, the previous shape and its quantities are kept.
    pub(crate) fn record(&mut self, report: &Report, fold_margin: f64) {
        (self.outcome, self.progress) = (report.outcome, report.progress);
        (self.iterations, self.residual) = (report.iterations, report.residual);
        if !report.solved() {
            self.status = Status::NotSolved;
            if matches!(report.outcome, Outcome::OutOfBudget(_)) {
                self.snaps += report.snaps; // the branch has been followed up to there
            }
            return;
        }
        (self.stable, self.stability_margin) = (report.stable, report.margin);
        self.snaps += report.snaps;
        self.status = if report.snaps > 0 {
            Status::Snapped
        } else if report.stable.is_some() && report.margin < fold_margin {
            Status::NearFold
        } else {
            Status::Solved
        };
        self.energy = report.energy;
    }
}
