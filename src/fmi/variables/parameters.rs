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
        let gravity = access!(|values, index| values.gravity[index.component]);
        let draft = Draft::parameter("gravity", ACCELERATION, "Acceleration of gravity", gravity).tunable();
        self.array(3, &draft.derivative_role(DerivativeRole::Input(Input::Gravity)));
        self.model_parameters();
    }

    fn magnet(&mut self, item: usize) {
        let mut row = |part: &str, quantity, description, min: Option<f64>, access| {
            let name = format!("magnet.design.cylinder[{}].{part}", item + 1);
            let draft = Draft::parameter(name, quantity, description, access);
            self.scalar_of(item, min.into_iter().fold(draft, Draft::min).known(Known::Source));
        };
        let radius = access!(|values, index| values.magnets[index.item].radius);
        row("radius", LENGTH, "Outer radius", Some(0.0), radius);
        let inner_radius = access!(|values, index| values.magnets[index.item].inner_radius);
        row("inner_radius", LENGTH, "Inner radius", Some(0.0), inner_radius);
        let length = access!(|values, index| values.magnets[index.item].length);
        row("length", LENGTH, "Length along the axis", Some(0.0), length);
        let offset = access!(|values, index| values.magnets[index.item].offset);
        row("offset", LENGTH, "Position of its centre along the assembly's axis", None, offset);
        let remanence = access!(|values, index| values.magnets[index.item].remanence);
        row("remanence", REMANENCE, "Remanence along the axis", None, remanence);
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

        let position = access!(|values| values.settings.tolerance_position);
        let description = "How far the tip may be from the converged answer of the model; the relative tolerance may ask for less";
        let draft = Draft::parameter("model.tolerance_position", LENGTH, description, position);
        self.scalar(draft.min(0.0).tunable().known(Known::Accuracy));

        let angle = access!(|values| values.settings.tolerance_angle);
        let description = "How far the tip may be turned against the converged answer of the model";
        let draft = Draft::parameter("model.tolerance_angle", ANGLE, description, angle);
        self.scalar(draft.min(0.0).tunable().known(Known::Accuracy));

        let relative = access!(|values| values.settings.tolerance_relative);
        let description = "How far the tip may be from the converged answer of the model, relative to its distance from its \
                           unloaded place; 0: the other two alone count";
        let draft = Draft::parameter("model.tolerance_relative", RATIO, description, relative);
        self.scalar(draft.min(0.0).max(1.0).tunable().known(Known::Accuracy));

        let bending_stop = Access::Boolean {
            get: |values| values.settings.has_bending_stop(),
            set: |values, on| values.settings.bending_stop = Some(on),
        };
        let description = "Whether a core stiffens once it has bent by its boundary angle, because windings touch; \
                           where it is not set, the level decides: at auto it does";
        self.scalar(Draft::parameter("model.bending_stop", DataType::Boolean, description, bending_stop));

        let budget = access!(|values| values.settings.time_budget);
        let description = "Processor time that a solve may take before it ends as out of budget";
        let draft = Draft::parameter("model.time_budget", TIME, description, budget);
        self.scalar(draft.min(0.0).known(Known::Accuracy));
    }
}
