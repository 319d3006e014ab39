//! Inputs.

use super::super::dependency::Known;
use super::super::derivative_role::DerivativeRole;
use super::super::units::{FIELD, FORCE, GRADIENT, MOMENT, POSITION, RATIO};
use super::rows::{Draft, Rows};
use super::{Counts, access};
use crate::manipulator::Input;

impl Rows {
    pub(super) fn inputs(&mut self, counts: &Counts) {
        let position = access!(|values, index| values.sources[0].pose.position[index.component]);
        let draft =
            Draft::input("magnet.position", POSITION, "Centre of the external magnet assembly", position);
        let draft = draft.derivative_role(DerivativeRole::Input(Input::SourcePosition(0)));
        self.array(3, &draft.known(Known::Source));

        let orientation = access!(|values, index| values.sources[0].pose.orientation[index.component]);
        let description =
            "Orientation of the external magnet assembly, whose dipole axis is its z, as a unit quaternion";
        let draft = Draft::orientation("magnet.orientation", description, orientation);
        let draft = draft.derivative_role(DerivativeRole::InputQuaternion(Input::SourceRotation(0)));
        self.array(4, &draft.known(Known::Source));

        let strength = access!(|values| values.sources[0].strength);
        let description = "Factor on the external magnet's field; 0 switches it off";
        let draft = Draft::input("magnet.strength", RATIO, description, strength);
        let draft = draft.derivative_role(DerivativeRole::Input(Input::SourceStrength(0)));
        self.scalar(draft.known(Known::Source));

        let uniform = access!(|values, index| values.uniform_field[index.component]);
        let draft = Draft::input("field.uniform", FIELD, "Uniform background field", uniform);
        self.array(3, &draft.derivative_role(DerivativeRole::Input(Input::UniformField)));

        let gradient = access!(|values, index| values.field_gradient[index.component]);
        let description = "Gradient of a linear field about the world origin";
        let draft = Draft::input("field.gradient", GRADIENT, description, gradient);
        self.array(5, &draft.derivative_role(DerivativeRole::Input(Input::FieldGradient)));

        self.base();
        self.loads(counts);
    }

    fn base(&mut self) {
        let position = access!(|values, index| values.base.position[index.component]);
        let draft = Draft::input("base.position", POSITION, "Position of the clamped base", position);
        let draft = draft.derivative_role(DerivativeRole::Input(Input::BasePosition));
        self.array(3, &draft.known(Known::BasePosition));

        let orientation = access!(|values, index| values.base.orientation[index.component]);
        let description = "Orientation of the clamped base as a unit quaternion";
        let draft = Draft::orientation("base.orientation", description, orientation);
        let draft = draft.derivative_role(DerivativeRole::InputQuaternion(Input::BaseRotation));
        self.array(4, &draft.known(Known::BaseOrientation));
    }

    fn loads(&mut self, counts: &Counts) {
        let force = access!(|values, index| values.tip_force[index.component]);
        let draft = Draft::input("tip.load_force", FORCE, "Force on the tip", force);
        self.array(3, &draft.derivative_role(DerivativeRole::Input(Input::TipForce)));

        let moment = access!(|values, index| values.tip_moment[index.component]);
        let draft = Draft::input("tip.load_moment", MOMENT, "Moment on the tip", moment);
        self.array(3, &draft.derivative_role(DerivativeRole::Input(Input::TipMoment)));

        for ring in 0..counts.rings {
            let clamped = ring < counts.clamped_rings;
            let name = format!("ring[{}].load_force", ring + 1);
            let force = access!(|values, index| values.ring_forces[index.item][index.component]);
            let draft = Draft::input(name, FORCE, "Force at the ring's centre", force);
            let draft = draft.derivative_role(DerivativeRole::Input(Input::RingForce(ring)));
            let known = if clamped { Known::ClampedRingForce } else { Known::Other };
            self.array_of(ring, 3, &draft.known(known));
        }
    }
}
