//! Outputs: what the last solve answered.

use super::super::slope::Slope;
use super::super::units::{
    ANGLE, DIRECTION, FIELD, FORCE, LENGTH, MOMENT, POSITION, QUATERNION, Quantity, RATIO,
};
use super::super::variable::{Access, At, Kind, Reach, Role, SNAPS};
use super::parameters::INTERACTION;
use super::{Counts, Draft, MARGIN, Rows};
use crate::manipulator::{Outcome, Output, Outputs, Status};

/// An Integer and no enumeration, because some hosts hide those.
fn status_number(status: Status) -> i32 {
    match status {
        Status::Solved => 0,
        Status::NearFold => 1,
        Status::Snapped => 2,
        Status::NotSolved => 3,
    }
}

fn outcome_number(outcome: Outcome) -> i32 {
    match outcome {
        Outcome::Solved => 0,
        Outcome::Neutral => 1,
        Outcome::BranchEnds => 2,
        Outcome::Contact(_) => 3,
        Outcome::OutOfBudget => 4,
    }
}

fn count(number: u32) -> i32 {
    i32::try_from(number).unwrap_or(i32::MAX)
}

type Vector = (&'static str, Quantity, &'static str, fn(&Outputs, At) -> f64, Reach, Output);

/// Name, description, largest value.
type Whole = (&'static str, &'static str, Option<f64>, fn(&Outputs) -> i32);

impl Rows {
    pub(super) fn answers(&mut self, counts: &Counts) {
        self.real(
            Draft::real(
                "tip.angle",
                ANGLE,
                "Angle between the tip's and the base's axis",
                answer(|o, _| o.tip_angle),
            )
            .min(0.0)
            .max(core::f64::consts::PI)
            .slope(Slope::Output(Output::TipAngle)),
        );
        let tip: Vector = (
            "tip.position",
            POSITION,
            "Position of the tip",
            |o, at| o.tip.position[at.axis],
            Reach::Equilibrium,
            Output::TipPosition,
        );
        self.vector(0, tip.0, &tip);
        let orientation = answer(|o, at| o.tip.quaternion()[at.axis]);
        let description = "Orientation of the tip: unit quaternion w, x, y, z with w >= 0";
        let draft = Draft::real("tip.orientation", QUATERNION, description, orientation);
        self.array(4, &draft.role(Role::Output).slope(Slope::TipQuaternion));
        for row in WRENCHES {
            self.vector(0, row.0, row);
        }
        self.shape(counts);
        self.bodies(counts);
        self.solution();
    }

    fn real(&mut self, draft: Draft) {
        self.one(draft.role(Role::Output));
    }

    fn vector(&mut self, item: usize, name: &str, (_, quantity, description, get, reach, output): &Vector) {
        let draft = Draft::real(name, *quantity, description, answer(*get)).role(Role::Output);
        self.item_array(3, item, &draft.reach(*reach).slope(Slope::Output(*output)));
    }

    fn shape(&mut self, counts: &Counts) {
        for point in 0..counts.shape_points {
            // Point and axis are two indices of one array: `shape.position[2,3]`.
            for axis in 0..3 {
                let name = format!("shape.position[{},{}]", point + 1, axis + 1);
                let description = "Point of the centreline, from base to tip";
                let reach = if point == 0 { Reach::BasePoint } else { Reach::Equilibrium };
                let position = answer(|o, at| o.shape[at.item][at.axis]);
                let draft = Draft::real(name.clone(), POSITION, description, position).reach(reach);
                let draft = draft.role(Role::Output).slope(Slope::Output(Output::ShapePoint(point)));
                self.variables.push(draft.at(name, At { item: point, axis }));
            }
        }
        for point in 0..counts.shape_points {
            let name = format!("shape.arc_length[{}]", point + 1);
            let description = "Unstrained arc length of a centreline point from the base";
            let length = answer(|o, at| o.shape_arc_length[at.item]);
            let draft = Draft::real(name, LENGTH, description, length).min(0.0).reach(Reach::Lengths);
            self.item(draft.role(Role::Output).slope(Slope::Still), point);
        }
    }

    fn bodies(&mut self, counts: &Counts) {
        for ring in 0..counts.rings {
            let clamped = ring == 0 && counts.clamped_ring;
            let reach = |clamped_reach| if clamped { clamped_reach } else { Reach::Equilibrium };
            let number = ring + 1;
            let centre: Vector = (
                "",
                POSITION,
                "Centre of the ring magnet",
                |o, at| o.rings[at.item].position[at.axis],
                reach(Reach::ClampedCentre),
                Output::RingPosition(ring),
            );
            self.vector(ring, &format!("ring[{number}].position"), &centre);
            let axis: Vector = (
                "",
                DIRECTION,
                "Axis d3 of the ring magnet",
                |o, at| o.rings[at.item].axis()[at.axis],
                reach(Reach::ClampedAxis),
                Output::RingAxis(ring),
            );
            self.vector(ring, &format!("ring[{number}].axis"), &axis);
        }
        for core in 0..counts.cores {
            let name = format!("core[{}].angle", core + 1);
            let description = "Bending of the core; windings touch at design.helix.boundary_angle";
            let draft =
                Draft::real(name, ANGLE, description, answer(|o, at| o.core_angles[at.item])).min(0.0);
            self.item(draft.role(Role::Output).slope(Slope::Output(Output::CoreAngle(core))), core);
        }
    }

    fn solution(&mut self) {
        let stable = Access::BooleanAnswer(|o| o.stable == Some(true));
        let description = "Whether the equilibrium is known to be stable";
        self.real(Draft::new("stability.stable", Kind::Boolean, description, stable));
        let neutral = Access::BooleanAnswer(|o| o.outcome == Outcome::Neutral);
        let description = "Whether one direction is free, as about the axis of an antiparallel field: neither stable nor unstable";
        self.real(Draft::new("stability.neutral", Kind::Boolean, description, neutral));
        self.real(Draft::real(
            MARGIN,
            RATIO,
            "Smallest eigenvalue of the Hessian relative to the elastic energy: 1 unloaded, 0 at a fold",
            answer(|o, _| o.stability_margin),
        ));
        let integers: [Whole; 4] = [
            (SNAPS, "Jumps to another branch since initialisation", None, |o| count(o.snaps)),
            (
                "solver.status",
                "0 solved, 1 near a fold, 2 snapped in this step, 3 not solved (the other outputs are the last good ones)",
                Some(3.0),
                |o| status_number(o.status),
            ),
            (
                "solver.outcome",
                "0 solved, 1 solved but neutral; not solved: 2 the branch ends, 3 bodies touch, 4 out of budget",
                Some(4.0),
                |o| outcome_number(o.outcome),
            ),
            ("solver.iterations", "Newton iterations of the last solve", None, |o| count(o.iterations)),
        ];
        for (name, description, max, get) in integers {
            let draft = Draft::new(name, Kind::Integer, description, Access::IntegerAnswer(get)).min(0.0);
            self.real(Draft { max, ..draft });
        }
        let progress = answer(|o, _| o.progress);
        let description =
            "How far along the last change of inputs an equilibrium was found: 1 where it is solved";
        self.real(Draft::real("solver.progress", RATIO, description, progress).min(0.0).max(1.0));
        let residual = answer(|o, _| o.residual.min(f64::MAX)); // infinite when a solve never began
        let description = "Residual of the last solve relative to the elastic forces";
        self.real(Draft::real("solver.residual", RATIO, description, residual).min(0.0));
        let level = Access::IntegerAnswer(|o| o.interaction as i32);
        let kind = Kind::Enumeration(&INTERACTION);
        let draft = Draft::new("model.level", kind, "Level of local interaction that was used", level);
        self.real(draft);
        let estimate = answer(|o, _| o.error_estimate);
        let description = "Estimated distance of the tip from the converged answer of the model";
        self.real(Draft::real("model.error_estimate", LENGTH, description, estimate).min(0.0));
    }
}

fn answer(get: fn(&Outputs, At) -> f64) -> Access {
    Access::RealAnswer(get)
}

const WRENCHES: &[Vector] = &[
    (
        "force.magnetic",
        FORCE,
        "Total external magnetic force on the manipulator",
        |o, at| o.magnetic_force[at.axis],
        Reach::Equilibrium,
        Output::MagneticForce,
    ),
    (
        "torque.magnetic",
        MOMENT,
        "Total external magnetic torque about the base position",
        |o, at| o.magnetic_torque[at.axis],
        Reach::Equilibrium,
        Output::MagneticTorque,
    ),
    (
        "base.reaction_force",
        FORCE,
        "Force that the clamp exerts on the manipulator",
        |o, at| o.base_reaction_force[at.axis],
        Reach::Clamp,
        Output::BaseReactionForce,
    ),
    (
        "base.reaction_moment",
        MOMENT,
        "Moment that the clamp exerts about the base position",
        |o, at| o.base_reaction_moment[at.axis],
        Reach::Clamp,
        Output::BaseReactionMoment,
    ),
    (
        "magnet.reaction_force",
        FORCE,
        "Force on the external magnet",
        |o, at| o.magnet_reaction_force[at.axis],
        Reach::Equilibrium,
        Output::MagnetReactionForce,
    ),
    (
        "magnet.reaction_torque",
        MOMENT,
        "Torque on the external magnet about its centre",
        |o, at| o.magnet_reaction_torque[at.axis],
        Reach::Equilibrium,
        Output::MagnetReactionTorque,
    ),
    (
        "field.tip",
        FIELD,
        "External field at the tip",
        |o, at| o.tip_field[at.axis],
        Reach::Equilibrium,
        Output::TipField,
    ),
];
