//! Inputs and parameters of shaft, guidewire and vessel: only the FMU of a scene that has them has these.

use super::super::dependency::Known;
use super::super::derivative_role::DerivativeRole;
use super::super::host_values::HostValues;
use super::super::units::{ANGLE, FORCE, LENGTH, MODULUS, RATIO};
use super::super::value::{DataType, Enumeration, Item};
use super::super::variable::Access;
use super::access;
use super::rows::{Draft, Rows};
use crate::manipulator::{FeedMode, Input};
use crate::vessel::quantities::{FRICTION, WALL_MODULUS};

/// How the device is held at its base.
static FEED: Enumeration = Enumeration {
    name: "FeedMode",
    description: "How the device is held at its base",
    items: &[
        Item {
            name: "clamped",
            value: FeedMode::Clamped as i32,
            description: "The base holds the first body",
        },
        Item {
            name: "insertion",
            value: FeedMode::Insertion as i32,
            description: "The base is a port through which a shaft of given length is pushed in",
        },
        Item {
            name: "force",
            value: FeedMode::Force as i32,
            description: "A given force pushes the shaft in through the port",
        },
    ],
};

impl Rows {
    /// Inputs of a shaft.
    pub(super) fn feed_inputs(&mut self, start: &HostValues) {
        if start.shaft.is_none() {
            return;
        }
        let insertion = access!(|values| values.insertion);
        let description = "Length of shaft inside the port, whose pose is that of the base";
        let draft = Draft::input("feed.insertion", LENGTH, description, insertion).min(0.0).max(1.0);
        self.scalar(draft.derivative_role(DerivativeRole::Input(Input::Insertion)));
        let roll = access!(|values| values.roll);
        let draft = Draft::input("feed.roll", ANGLE, "Turn of the shaft about its axis in the port", roll);
        self.scalar(draft.derivative_role(DerivativeRole::Input(Input::Roll)));
        let force = access!(|values| values.feed_force);
        let draft = Draft::input("feed.force", FORCE, "Push on the shaft in mode force", force);
        self.scalar(draft.derivative_role(DerivativeRole::Input(Input::FeedForce)));
    }

    /// Input of a guidewire.
    pub(super) fn guidewire_input(&mut self, start: &HostValues) {
        if start.guidewire.is_none() {
            return;
        }
        let insertion = access!(|values| values.guidewire_insertion);
        let description = "Arc length from the port, or the base without a shaft, that the guidewire reaches";
        let draft = Draft::input("guidewire.insertion", LENGTH, description, insertion).min(0.0).max(2.0);
        self.scalar(draft.derivative_role(DerivativeRole::Input(Input::GuidewireInsertion)));
    }

    /// Parameters of shaft and vessel.
    pub(super) fn vessel_parameters(&mut self, start: &HostValues) {
        if start.shaft.is_some() {
            let mode = Access::Enumeration {
                get: |values| values.feed_mode as i32,
                set: |values, number| {
                    let modes = [FeedMode::Clamped, FeedMode::Insertion, FeedMode::Force];
                    let named = modes.into_iter().find(|mode| *mode as i32 == number);
                    values.feed_mode = named.unwrap_or(values.feed_mode);
                },
            };
            let description = "How the device is held at its base";
            self.scalar(Draft::parameter("feed.mode", DataType::Enumeration(&FEED), description, mode));
        }
        if start.vessel.is_some() {
            let modulus = access!(|values| values.wall_modulus);
            self.scalar(Draft::holding(&WALL_MODULUS, MODULUS, modulus));
            let friction = access!(|values| values.friction);
            self.scalar(Draft::holding(&FRICTION, RATIO, friction).tunable().known(Known::Friction));
        }
    }
}
