//! What the host gives: inputs and parameters as they were set, and what they mean together.

use crate::design::{Backbone, Design, Specification};
use crate::equilibrium::Settings;
use crate::error::Error;
use crate::geometry::Pose;
use crate::magnetics::{Assembly, AxialMagnet};
use crate::manipulator::{Inputs, Manipulator, Scene, SceneFile};
use crate::methods::Method;

/// Position and quaternion as they were set: one component at a time, so not always a rotation.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Placement {
    /// Origin, m.
    pub position: [f64; 3],
    /// Quaternion w, x, y, z.
    pub orientation: [f64; 4],
}

/// Every input and parameter, in SI units.
#[derive(Debug, Clone, PartialEq)]
pub struct Given {
    /// The external magnet.
    pub magnet: Placement,
    /// Factor on its field.
    pub magnet_strength: f64,
    /// Uniform background field.
    pub uniform_field: [f64; 3],
    /// Linear background field.
    pub field_gradient: [f64; 5],
    /// The clamp.
    pub base: Placement,
    /// Load on the tip.
    pub tip_force: [f64; 3],
    /// Load on the tip.
    pub tip_moment: [f64; 3],
    /// Loads on the rings.
    pub ring_forces: Vec<[f64; 3]>,
    /// Gravity.
    pub gravity: [f64; 3],
    /// The design; a segmented one's backbone is kept in `backbone`.
    pub specification: Specification,
    /// The backbone that a segmented design has if `backbone_present`.
    pub backbone: Backbone,
    /// Whether there is a backbone.
    pub backbone_present: bool,
    /// The cylinders of the external magnet.
    pub magnets: Vec<AxialMagnet>,
    /// Model and solver.
    pub settings: Settings,
}

/// The magnet of a scene that has none: the paper's pair where `[magnet]` puts it, switched off.
const SWITCHED_OFF: &str = "[magnet]\nstrength = 0.0";

/// Norm below which a quaternion on a path is no orientation.
const SHORTEST_QUATERNION: f64 = 1e-3;

impl Given {
    /// The start values that a scene states.
    ///
    /// A scene without an external magnet gets the usual one with strength 0, so that it can be switched on.
    ///
    /// # Errors
    /// What [`Scene`] refuses; [`Error::Unsupported`] for another method than the potential one, which alone has
    /// derivatives and a state to save.
    pub fn start(file: &SceneFile) -> Result<Self, Error> {
        let scene = file.scene()?;
        let (method, own) = (scene.solver.method, Method::Potential);
        if method != own {
            let (given, own) = (method.name(), own.name());
            return Err(Error::Unsupported(format!("an FMU solves by method \"{own}\", not \"{given}\"")));
        }
        let (magnets, magnet) = if let Some(magnets) = &scene.magnets {
            (magnets.clone(), scene.inputs.magnet)
        } else {
            let usual = Scene::parse(SWITCHED_OFF, "usual magnet")?;
            (usual.magnets.unwrap_or_default(), usual.inputs.magnet)
        };
        let inputs = &scene.inputs;
        let backbone = match &scene.specification {
            Specification::Segmented(segmented) => segmented.backbone,
            Specification::Cylinder(_) => None,
        };
        Ok(Self {
            magnet: magnet.into(),
            magnet_strength: inputs.magnet_strength,
            uniform_field: inputs.uniform_field.into(),
            field_gradient: inputs.field_gradient,
            base: inputs.base.into(),
            tip_force: inputs.tip_force.into(),
            tip_moment: inputs.tip_moment.into(),
            ring_forces: inputs.ring_forces.iter().map(|&force| force.into()).collect(),
            gravity: inputs.gravity.into(),
            backbone: backbone.unwrap_or_else(Backbone::silicone),
            backbone_present: backbone.is_some(),
            specification: scene.specification,
            magnets,
            settings: scene.settings,
        })
    }

    /// The inputs as the manipulator takes them.
    ///
    /// # Errors
    /// [`Error::Range`] naming the quaternion that is not of unit norm.
    pub fn inputs(&self) -> Result<Inputs, Error> {
        Ok(Inputs {
            magnet: self.magnet.pose("magnet.orientation")?,
            magnet_strength: self.magnet_strength,
            uniform_field: self.uniform_field.into(),
            field_gradient: self.field_gradient,
            base: self.base.pose("base.orientation")?,
            tip_force: self.tip_force.into(),
            tip_moment: self.tip_moment.into(),
            ring_forces: self.ring_forces.iter().map(|&force| force.into()).collect(),
            gravity: self.gravity.into(),
        })
    }

    /// The checked design.
    ///
    /// # Errors
    /// [`Error::Range`] naming the first quantity out of range.
    pub fn design(&self) -> Result<Design, Error> {
        let mut specification = self.specification.clone();
        if let Specification::Segmented(segmented) = &mut specification {
            segmented.backbone = self.backbone_present.then_some(self.backbone);
        }
        Design::new(specification)
    }

    /// The manipulator that the parameters describe, unsolved.
    ///
    /// # Errors
    /// As [`Given::design`], [`Assembly::new`] and [`Manipulator::new`].
    pub fn manipulator(&self, shape_points: usize) -> Result<Manipulator, Error> {
        let magnet = Assembly::new(self.magnets.clone())?;
        Manipulator::new(&self.design()?, Some(&magnet), self.settings, shape_points)
    }
}

impl From<Pose> for Placement {
    fn from(pose: Pose) -> Self {
        Self { position: pose.position.into(), orientation: pose.quaternion() }
    }
}

impl Placement {
    /// Scales the quaternion to unit norm, unless it is too short to tell a direction.
    pub(super) fn normalise(&mut self) {
        let norm = self.orientation.iter().map(|component| component * component).sum::<f64>().sqrt();
        if norm > SHORTEST_QUATERNION {
            self.orientation = self.orientation.map(|component| component / norm);
        }
    }

    fn pose(&self, orientation: &str) -> Result<Pose, Error> {
        Pose::new(self.position, self.orientation).map_err(|error| match error {
            Error::Range { value, allowed, .. } => {
                Error::range(format!("norm of {orientation}"), value, allowed)
            }
            other => other,
        })
    }
}
