//! Outputs.

use super::super::dependency::Dependency;
use super::super::derivative_role::DerivativeRole;
use super::super::search_report::SearchReport;
use super::super::units::{
    ANGLE, DIRECTION, FIELD, FORCE, LENGTH, MOMENT, POSITION, QUATERNION, Quantity, RATIO,
};
use super::super::value::DataType;
use super::super::variable::{Access, Availability, Index, Request};
use super::Counts;
use super::parameters::INTERACTION;
use super::rows::{Draft, Rows};
use crate::manipulator::{Outcome, Output, Outputs};

pub(super) fn count(number: u32) -> i32 {
    i32::try_from(number).unwrap_or(i32::MAX)
}

pub(super) fn real(
    name: impl Into<String>,
    quantity: Quantity,
    description: &str,
    get: fn(&Outputs, Index) -> f64,
) -> Draft {
    Draft::result(name, quantity, description, Access::RealOutput(get))
}

pub(super) fn integer(name: &str, description: &str, get: fn(&Outputs) -> i32) -> Draft {
    Draft::result(name, DataType::Integer, description, Access::IntegerOutput(get))
}

/// A number that describes the search for an equilibrium, and that can always be read.
fn count_of_search(name: &str, description: &str, get: fn(&SearchReport) -> i32) -> Draft {
    let draft = Draft::result(name, DataType::Integer, description, Access::IntegerOfSearch(get));
    draft.availability(Availability::Always)
}

/// A ratio that describes the search for an equilibrium, and that can always be read.
fn ratio_of_search(name: &str, description: &str, get: fn(&SearchReport) -> f64) -> Draft {
    let draft = Draft::result(name, RATIO, description, Access::RealOfSearch(get));
    draft.availability(Availability::Always)
}

fn boolean(name: &str, description: &str, get: fn(&Outputs) -> bool) -> Draft {
    Draft::result(name, DataType::Boolean, description, Access::BooleanOutput(get))
}

impl Rows {
    pub(super) fn outputs(&mut self, counts: &Counts) {
        self.tip();
        self.forces();
        self.centreline(counts);
        self.bodies(counts);
        self.stability();
        self.solver();
        self.model_outputs();
    }

    fn tip(&mut self) {
        let angle =
            real("tip.angle", ANGLE, "Angle between the tip's and the base's axis", |o, _| o.tip_angle);
        let angle = angle.min(0.0).max(core::f64::consts::PI);
        self.scalar(angle.continuous(DerivativeRole::Output(Output::TipAngle)));
        let position =
            real("tip.position", POSITION, "Position of the tip", |o, index| o.tip.position[index.component]);
        self.array(3, &position.continuous(DerivativeRole::Output(Output::TipPosition)));
        let orientation = real(
            "tip.orientation",
            QUATERNION,
            "Orientation of the tip as a unit quaternion with w >= 0",
            |o, index| o.tip.quaternion()[index.component],
        );
        self.array(4, &orientation.continuous(DerivativeRole::TipQuaternion));
    }

    fn forces(&mut self) {
        let mut vector = |draft: Draft, output: Output| {
            self.array(3, &draft.continuous(DerivativeRole::Output(output)));
        };
        let description = "Total external magnetic force on the manipulator";
        let draft = real("force.magnetic", FORCE, description, |o, index| o.magnetic_force[index.component]);
        vector(draft, Output::MagneticForce);

        let description = "Total external magnetic torque about the base position";
        let draft =
            real("torque.magnetic", MOMENT, description, |o, index| o.magnetic_torque[index.component]);
        vector(draft, Output::MagneticTorque);

        let description = "Force that the clamp exerts on the manipulator";
        let draft = real("base.reaction_force", FORCE, description, |o, index| {
            o.base_reaction_force[index.component]
        });
        vector(draft.dependency(Dependency::ClampForce), Output::BaseReactionForce);

        let description = "Moment that the clamp exerts about the base position";
        let draft = real("base.reaction_moment", MOMENT, description, |o, index| {
            o.base_reaction_moment[index.component]
        });
        vector(draft.dependency(Dependency::ClampMoment), Output::BaseReactionMoment);

        let description = "Force on the external magnet";
        let draft = real("magnet.reaction_force", FORCE, description, |o, index| {
            o.magnet_reaction_force[index.component]
        });
        vector(draft, Output::MagnetReactionForce);

        let description = "Torque on the external magnet about its centre";
        let draft = real("magnet.reaction_torque", MOMENT, description, |o, index| {
            o.magnet_reaction_torque[index.component]
        });
        vector(draft, Output::MagnetReactionTorque);

        let description = "External field at the tip";
        let draft = real("field.tip", FIELD, description, |o, index| o.tip_field[index.component]);
        vector(draft, Output::TipField);
    }

    fn centreline(&mut self, counts: &Counts) {
        for point in 0..counts.shape_points {
            // With a shaft, the port's place in the shape is the sum of many parts.
            let fixed = point == 0 && !counts.shaft;
            let dependency = if fixed { Dependency::BasePoint } else { Dependency::Equilibrium };
            for component in 0..3 {
                // Point and component are two indices of one array.
                let name = format!("shape.position[{},{}]", point + 1, component + 1);
                let description = "Point of the centreline, from base to tip";
                let position =
                    real(name, POSITION, description, |o, index| o.shape[index.item][index.component]);
                let position = position.continuous(DerivativeRole::Output(Output::ShapePoint(point)));
                self.component_of(point, component, position.dependency(dependency));
            }
        }
        for point in 0..counts.shape_points {
            let name = format!("shape.arc_length[{}]", point + 1);
            let description = "Unstrained arc length of a centreline point from the base";
            let length = real(name, LENGTH, description, |o, index| o.shape_arc_length[index.item]).min(0.0);
            let (role, dependency) = if counts.shaft {
                let of = counts.shape_points - 1;
                (DerivativeRole::ShareOfFeed { part: point, of }, Dependency::Equilibrium)
            } else {
                (DerivativeRole::Unaffected, Dependency::Lengths)
            };
            self.scalar_of(point, length.continuous(role).dependency(dependency));
        }
    }

    fn bodies(&mut self, counts: &Counts) {
        for ring in 0..counts.rings {
            let (centre, axis) = if ring == 0 && counts.clamped_ring {
                (Dependency::ClampedCentre, Dependency::ClampedAxis)
            } else {
                (Dependency::Equilibrium, Dependency::Equilibrium)
            };
            let name = format!("ring[{}].position", ring + 1);
            let position = real(name, POSITION, "Centre of the ring magnet", |o, index| {
                o.rings[index.item].position[index.component]
            });
            let position = position.continuous(DerivativeRole::Output(Output::RingPosition(ring)));
            self.array_of(ring, 3, &position.dependency(centre));
            let name = format!("ring[{}].axis", ring + 1);
            let direction = real(name, DIRECTION, "Axis d3 of the ring magnet", |o, index| {
                o.rings[index.item].axis()[index.component]
            });
            let direction = direction.continuous(DerivativeRole::Output(Output::RingAxis(ring)));
            self.array_of(ring, 3, &direction.dependency(axis));
        }
        for core in 0..counts.cores {
            let name = format!("core[{}].angle", core + 1);
            let description = "Bending of the core; windings touch at design.helix.boundary_angle";
            let angle = real(name, ANGLE, description, |o, index| o.core_angles[index.item]).min(0.0);
            self.scalar_of(core, angle.continuous(DerivativeRole::Output(Output::CoreAngle(core))));
        }
    }

    fn stability(&mut self) {
        let description = "Whether the equilibrium is known to be stable";
        self.scalar(boolean("stability.stable", description, |o| o.stable == Some(true)));
        let description = "Whether one direction is free, as about the axis of an axisymmetric scene: neither stable nor unstable";
        self.scalar(boolean("stability.neutral", description, |o| o.outcome == Outcome::Neutral));
        let description = "Smallest eigenvalue of the Hessian in the elastic norm of the strains: 1 without loads and interaction, 0 at a fold";
        let margin = real("stability.margin", RATIO, description, |o, _| o.stability_margin);
        self.scalar(margin.availability(Availability::OnRequest(Request::Margin)));
        let description = "Jumps to another branch since initialisation";
        self.scalar(count_of_search("stability.snaps", description, |report| count(report.snaps)).min(0.0));
    }

    fn solver(&mut self) {
        let description = "0 solved, 1 near a fold, 2 snapped in this step, 3 not solved or input refused (the other outputs are the last good ones)";
        self.scalar(count_of_search("solver.status", description, |report| report.status).min(0.0).max(3.0));
        let description = "0 solved, 1 solved but neutral; not solved: 2 the branch ends, 3 bodies touch, 4 out of budget, 5 wedged, 6 input refused";
        self.scalar(
            count_of_search("solver.outcome", description, |report| report.outcome).min(0.0).max(6.0),
        );
        let description = "Newton iterations of the last solve";
        self.scalar(
            count_of_search("solver.iterations", description, |report| count(report.iterations)).min(0.0),
        );
        let description =
            "How far along the last change of inputs an equilibrium was found: 1 where it is solved";
        self.scalar(
            ratio_of_search("solver.progress", description, |report| report.progress).min(0.0).max(1.0),
        );
        let description = "Residual of the last solve relative to the elastic forces";
        self.scalar(ratio_of_search("solver.residual", description, |report| report.residual).min(0.0));
    }

    fn model_outputs(&mut self) {
        let description = "Level of local interaction that was used";
        let level = Access::IntegerOutput(|o| o.interaction as i32);
        self.scalar(Draft::result("model.level", DataType::Enumeration(&INTERACTION), description, level));
        let description = "Estimated distance of the tip from the converged answer of the model";
        self.scalar(real("model.error_estimate", LENGTH, description, |o, _| o.error_estimate).min(0.0));
    }
}
