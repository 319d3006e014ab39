//! Poses and strengths of further magnets and coils.

use super::super::dependency::Known;
use super::super::derivative_role::DerivativeRole;
use super::super::host_values::HostValues;
use super::super::units::{CURRENT, POSITION, RATIO};
use super::access;
use super::rows::{Draft, Rows};
use crate::manipulator::Input;

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
}
