//! Poses and strengths of magnets and coils beside the external magnet.

use super::super::dependency::Known;
use super::super::derivative_role::DerivativeRole;
use super::super::host_values::HostValues;
use super::super::units::{CURRENT, POSITION, RATIO};
use super::access;
use super::rows::{Draft, Rows};
use crate::magnetics::Drive;
use crate::manipulator::Input;

impl Rows {
    pub(super) fn source_inputs(&mut self, start: &HostValues) {
        for (number, (name, drive)) in start.source_names().enumerate().skip(1) {
            let what = drive.noun();
            let position = access!(|values, index| values.sources[index.item].pose.position[index.component]);
            let draft = Draft::input(
                format!("{name}.position"),
                POSITION,
                &format!("Centre of the {what}"),
                position,
            );
            let role = DerivativeRole::Input(Input::SourcePosition(number));
            self.array_of(number, 3, &draft.derivative_role(role).known(Known::Source));

            let orientation =
                access!(|values, index| values.sources[index.item].pose.orientation[index.component]);
            let description = format!("Orientation of the {what}, whose axis is its z, as a unit quaternion");
            let draft = Draft::orientation(format!("{name}.orientation"), &description, orientation);
            let role = DerivativeRole::InputQuaternion(Input::SourceRotation(number));
            self.array_of(number, 4, &draft.derivative_role(role).known(Known::Source));

            let strength = access!(|values, index| values.sources[index.item].strength);
            let (last, quantity, description) = match drive {
                Drive::Factor => ("strength", RATIO, "Factor on the magnet's field; 0 switches it off"),
                Drive::Current => (
                    "current",
                    CURRENT,
                    "Current through the coil; a positive one makes a field along its z in its bore",
                ),
            };
            let draft = Draft::input(format!("{name}.{last}"), quantity, description, strength);
            let role = DerivativeRole::Input(Input::SourceStrength(number));
            self.scalar_of(number, draft.derivative_role(role).known(Known::Source));
        }
    }
}
