//! Further magnets and coils: their poses and strengths, the wrenches on them, and those of all sources on one another.

use super::super::dependency::{Dependency, Known};
use super::super::derivative_role::{DerivativeRole, WrenchPart};
use super::super::host_values::HostValues;
use super::super::units::{CURRENT, FORCE, MOMENT, POSITION, RATIO};
use super::super::variable::{Availability, Request};
use super::access;
use super::outputs::real;
use super::rows::{Draft, Rows};
use crate::manipulator::{Input, Output};

impl Rows {
    pub(super) fn source_inputs(&mut self, start: &HostValues) {
        for (number, (name, is_coil)) in start.source_names().enumerate() {
            let what = if is_coil { "coil" } else { "magnet" };
            let position = access!(|values, index| values.further[index.item].pose.position[index.component]);
            let draft = Draft::input(
                format!("{name}.position"),
                POSITION,
                &format!("Centre of the {what}"),
                position,
            );
            let role = DerivativeRole::Input(Input::SourcePosition(number));
            self.array_of(number, 3, &draft.derivative_role(role).known(Known::Source));

            let orientation =
                access!(|values, index| values.further[index.item].pose.orientation[index.component]);
            let description = format!("Orientation of the {what}, whose axis is its z, as a unit quaternion");
            let draft = Draft::orientation(format!("{name}.orientation"), &description, orientation);
            let role = DerivativeRole::InputQuaternion(Input::SourceRotation(number));
            self.array_of(number, 4, &draft.derivative_role(role).known(Known::Source));

            let strength = access!(|values, index| values.further[index.item].strength);
            let (last, quantity, description) = if is_coil {
                (
                    "current",
                    CURRENT,
                    "Current through the coil; a positive one makes a field along its z in its bore",
                )
            } else {
                ("strength", RATIO, "Factor on the magnet's field; 0 switches it off")
            };
            let draft = Draft::input(format!("{name}.{last}"), quantity, description, strength);
            let role = DerivativeRole::Input(Input::SourceStrength(number));
            self.scalar_of(number, draft.derivative_role(role).known(Known::Source));
        }
    }

    pub(super) fn source_outputs(&mut self, start: &HostValues) {
        for (number, (name, is_coil)) in start.source_names().enumerate() {
            let what = if is_coil { "coil" } else { "magnet" };
            let draft =
                real(format!("{name}.reaction_force"), FORCE, &format!("Force on the {what}"), |o, index| {
                    o.further_reactions.get(index.item).map_or(0.0, |wrench| wrench.force[index.component])
                });
            let role = DerivativeRole::Output(Output::SourceReactionForce(number));
            self.array_of(number, 3, &draft.continuous(role));

            let description = format!("Torque on the {what} about its centre");
            let draft = real(format!("{name}.reaction_torque"), MOMENT, &description, |o, index| {
                o.further_reactions.get(index.item).map_or(0.0, |wrench| wrench.torque[index.component])
            });
            let role = DerivativeRole::Output(Output::SourceReactionTorque(number));
            self.array_of(number, 3, &draft.continuous(role));
        }
        if start.settings.mutual_wrenches {
            self.mutual_wrenches(start);
        }
    }

    fn mutual_wrenches(&mut self, start: &HostValues) {
        let further = start.source_names().map(|(name, _)| name);
        for (number, name) in std::iter::once("magnet".to_owned()).chain(further).enumerate() {
            let mut add = |draft: Draft, part: WrenchPart| {
                let draft = draft.continuous(DerivativeRole::MutualWrench(part));
                let draft = draft.availability(Availability::OnRequest(Request::MutualWrenches));
                self.array_of(number, 3, &draft.dependency(Dependency::Sources));
            };
            let what = if name.starts_with("coil") { "coil" } else { "magnet" };
            let description = format!("Force of all other magnets and coils on the {what}");
            let draft = real(format!("{name}.mutual_force"), FORCE, &description, |o, index| {
                o.mutual_wrenches.get(index.item).map_or(f64::NAN, |wrench| wrench.force[index.component])
            });
            add(draft, WrenchPart::Force);
            let description = format!("Torque of all other magnets and coils on the {what} about its centre");
            let draft = real(format!("{name}.mutual_torque"), MOMENT, &description, |o, index| {
                o.mutual_wrenches.get(index.item).map_or(f64::NAN, |wrench| wrench.torque[index.component])
            });
            add(draft, WrenchPart::Torque);
        }
    }
}
