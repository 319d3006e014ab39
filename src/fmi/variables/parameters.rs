//! Parameters of external magnet, gravity and model.

use super::super::dependency::Known;
use super::super::derivative_role::DerivativeRole;
use super::super::host_values::HostValues;
use super::super::units::{ACCELERATION, ANGLE, LENGTH, RATIO, REMANENCE, TIME};
use super::super::value::{DataType, Enumeration, Item};
use super::super::variable::Access;
use super::access;
use super::rows::{Draft, Rows};
use crate::equilibrium::Interaction;
use crate::equilibrium::quantities::{TIME_BUDGET, TOLERANCE_ANGLE, TOLERANCE_POSITION, TOLERANCE_RELATIVE};
use crate::magnetics::ShapedMagnet;
use crate::magnetics::quantities as of;
use crate::manipulator::Input;

/// Level of local interaction.
pub(super) static INTERACTION: Enumeration = Enumeration {
    name: "Interaction",
    description: "Level of local magnetic interaction",
    items: &{
        let mut items = [const { Item { name: "", value: 0, description: "" } }; Interaction::ALL.len()];
        let mut row = 0;
        while row < items.len() {
            let (level, name, description) = Interaction::ALL[row];
            items[row] = Item { name, value: level as i32, description };
            row += 1;
        }
        items
    },
};

impl Rows {
    pub(super) fn parameters(&mut self, start: &HostValues) {
        for magnet in 0..start.magnets.len() {
            self.magnet(magnet);
        }
        if let Some(magnet) = start.shaped.first() {
            self.shaped_magnet(magnet);
        }
        let gravity = access!(|values, index| values.gravity[index.component]);
        let draft = Draft::parameter("gravity", ACCELERATION, "Acceleration of gravity", gravity).tunable();
        self.array(3, &draft.derivative_role(DerivativeRole::Input(Input::Gravity)));
        self.model_parameters();
    }

    fn magnet(&mut self, item: usize) {
        let mut number = |quantity, unit, access| {
            let draft = Draft::holding(quantity, unit, access).of_item(item).known(Known::Source);
            self.scalar_of(item, draft);
        };
        number(&of::MAGNET_OUTER, LENGTH, access!(|values, index| values.magnets[index.item].radius));
        number(&of::MAGNET_INNER, LENGTH, access!(|values, index| values.magnets[index.item].inner_radius));
        number(&of::MAGNET_LENGTH, LENGTH, access!(|values, index| values.magnets[index.item].length));
        number(&of::OFFSET, LENGTH, access!(|values, index| values.magnets[index.item].offset));
        number(&of::REMANENCE, REMANENCE, access!(|values, index| values.magnets[index.item].remanence));
    }

    /// The numbers of a magnet that is given by its shape.
    fn shaped_magnet(&mut self, magnet: &ShapedMagnet) {
        for (item, (place, quantity)) in magnet.shape.numbered().enumerate() {
            let dimension = access!(|values, index| values.shaped[0].dimensions[index.item]);
            let draft = Draft::holding(quantity, LENGTH, dimension).of_item(place);
            self.scalar_of(item, draft.known(Known::Source));
        }
        for item in 0..3 {
            let component = access!(|values, index| values.shaped[0].direction[index.item]);
            let draft = Draft::holding(&of::DIRECTION, RATIO, component).of_item(item);
            self.scalar_of(item, draft.known(Known::Source));
        }
        let remanence = access!(|values| values.shaped[0].remanence);
        let draft = Draft::holding(&of::DIRECTED_REMANENCE, REMANENCE, remanence);
        self.scalar(draft.known(Known::Source));
    }

    fn model_parameters(&mut self) {
        let interaction = Access::Enumeration {
            get: |values| values.settings.interaction as i32,
            set: |values, number| {
                if let Some((chosen, ..)) = Interaction::ALL.iter().find(|row| row.0 as i32 == number) {
                    values.settings.interaction = *chosen;
                }
            },
        };
        let (data_type, description) =
            (DataType::Enumeration(&INTERACTION), "Level of local magnetic interaction");
        self.scalar(Draft::parameter("model.interaction", data_type, description, interaction));

        let mut tolerance = |quantity, unit, access| {
            self.scalar(Draft::holding(quantity, unit, access).tunable().known(Known::Accuracy));
        };
        let position = access!(|values| values.settings.tolerance_position);
        tolerance(&TOLERANCE_POSITION, LENGTH, position);
        tolerance(&TOLERANCE_ANGLE, ANGLE, access!(|values| values.settings.tolerance_angle));
        let relative = access!(|values| values.settings.tolerance_relative);
        tolerance(&TOLERANCE_RELATIVE, RATIO, relative);

        let bending_stop = Access::Boolean {
            get: |values| values.settings.has_bending_stop(),
            set: |values, on| values.settings.bending_stop = Some(on),
        };
        let description = "Whether a core stiffens once it has bent by its boundary angle, because windings touch; \
                           where it is not set, the level decides: at auto it does";
        self.scalar(Draft::parameter("model.bending_stop", DataType::Boolean, description, bending_stop));

        let budget = access!(|values| values.settings.time_budget);
        self.scalar(Draft::holding(&TIME_BUDGET, TIME, budget).known(Known::Accuracy));
    }
}
