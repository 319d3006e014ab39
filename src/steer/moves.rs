//! The inputs that may move, and their freedoms.

use nalgebra::{DVector, Vector3};

use super::constants::{CURRENT_STEP, FIELD_STEP, INSERTION_STEP, STRENGTH_STEP};
use super::limits::Limits;
use crate::error::Error;
use crate::geometry::{Pose, RotationVector};
use crate::magnetics::{Drive, Sources};
use crate::manipulator::{Input, Inputs, Jacobian, Output, Scene};

/// An input that may be moved.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Move {
    /// Position of the external magnet.
    MagnetPosition,
    /// Direction of the external magnet's axis; its spin about that axis does nothing.
    MagnetOrientation,
    /// Factor on the field of the external magnet.
    MagnetStrength,
    /// Uniform background field.
    UniformField,
    /// Length of shaft inside the port.
    Insertion,
    /// Current through a coil, both counted from 0: its number among the coils, and among all sources.
    CoilCurrent {
        /// Number of the coil.
        coil: usize,
        /// Its place in [`Inputs::sources`].
        source: usize,
    },
}

/// The external magnet among the sources.
pub(super) const MAGNET: usize = 0;

/// Its pose among the inputs.
pub(super) const MAGNET_POSITION: Input = Input::SourcePosition(MAGNET);
pub(super) const MAGNET_ROTATION: Input = Input::SourceRotation(MAGNET);

/// The name that stands for the currents of all coils.
const CURRENTS: &str = "coil.current";

/// Names of all other moves.
const NAMES: [(&str, Move); 5] = [
    ("magnet.position", Move::MagnetPosition),
    ("magnet.orientation", Move::MagnetOrientation),
    ("magnet.strength", Move::MagnetStrength),
    ("field.uniform", Move::UniformField),
    ("feed.insertion", Move::Insertion),
];

impl Move {
    /// The moves with this name in a scene: `magnet.position`, `magnet.orientation`, `magnet.strength`, `field.uniform`,
    /// `feed.insertion`; `coil.current` are the currents of all its coils.
    ///
    /// # Errors
    /// [`Error::Unsupported`] for another name, and for currents where there is no coil.
    pub fn named(name: &str, scene: &Scene) -> Result<Vec<Self>, Error> {
        if name == CURRENTS {
            let all: Vec<Self> = coils(&scene.sources).collect();
            let none = || Error::Unsupported(format!("`{name}` cannot be moved: the scene has no coil"));
            return if all.is_empty() { Err(none()) } else { Ok(all) };
        }
        let found = NAMES.iter().find(|(known, _)| *known == name).map(|(_, each)| vec![*each]);
        found.ok_or_else(|| {
            let known: Vec<&str> = NAMES.iter().map(|(known, _)| *known).chain([CURRENTS]).collect();
            Error::Unsupported(format!("`{name}` cannot be moved; what can: {}", known.join(", ")))
        })
    }

    /// Its name.
    #[must_use]
    pub fn name(self) -> &'static str {
        NAMES.iter().find(|(_, each)| *each == self).map_or(CURRENTS, |(name, _)| name)
    }
}

/// The currents of all coils among these sources.
pub(super) fn coils(sources: &Sources) -> impl Iterator<Item = Move> {
    let driven = sources.list().iter().enumerate().filter(|(_, source)| source.drive() == Drive::Current);
    driven.enumerate().map(|(coil, (source, _))| Move::CoilCurrent { coil, source })
}

/// One freedom: an input and the direction along which it moves by one step.
#[derive(Debug, Clone, Copy)]
pub(super) struct Freedom {
    pub(super) input: Input,
    pub(super) along: Vector3<f64>,
}

impl Freedom {
    /// Rate of an output, at most three numbers, by one step of this freedom.
    pub(super) fn rate(&self, jacobian: &Jacobian, output: Output) -> Vector3<f64> {
        let Some(block) = jacobian.block(output, self.input) else { return Vector3::zeros() };
        let mut out = Vector3::zeros();
        for (row, rate) in out.iter_mut().enumerate().take(block.nrows()) {
            *rate = block.row(row).iter().zip(&self.along).map(|(a, b)| a * b).sum();
        }
        out
    }
}

/// The freedoms of these moves at `inputs`, each a step long.
pub(super) fn freedoms(moves: &[Move], limits: &Limits, inputs: &Inputs) -> Vec<Freedom> {
    let mut out = Vec::new();
    let mut add = |input, along| out.push(Freedom { input, along });
    let axes = [Vector3::x(), Vector3::y(), Vector3::z()];

    for each in moves {
        match each {
            Move::MagnetPosition => {
                for axis in axes {
                    add(MAGNET_POSITION, axis * limits.step);
                }
            }
            Move::MagnetOrientation => {
                // Not the third column: a spin about the magnet's own axis changes nothing.
                for column in 0..2 {
                    let across = inputs.sources[MAGNET].pose.rotation.column(column).into_owned();
                    add(MAGNET_ROTATION, across * limits.turn);
                }
            }
            Move::MagnetStrength => add(Input::SourceStrength(MAGNET), Vector3::x() * STRENGTH_STEP),
            Move::UniformField => {
                for axis in axes {
                    add(Input::UniformField, axis * FIELD_STEP);
                }
            }
            Move::Insertion => add(Input::Insertion, Vector3::x() * INSERTION_STEP),
            Move::CoilCurrent { source, .. } => {
                add(Input::SourceStrength(*source), Vector3::x() * CURRENT_STEP);
            }
        }
    }

    out
}

/// The inputs after a step of the freedoms, in units of their longest steps.
pub(super) fn moved(inputs: &Inputs, freedoms: &[Freedom], step: &DVector<f64>) -> Inputs {
    let mut out = inputs.clone();
    let mut turn = Vector3::zeros();
    for (freedom, by) in freedoms.iter().zip(step) {
        let by = freedom.along * *by;
        match freedom.input {
            Input::SourcePosition(source) => out.sources[source].pose.position += by,
            Input::SourceRotation(_) => turn += by,
            Input::SourceStrength(source) => out.sources[source].strength += by.x,
            Input::UniformField => out.uniform_field += by,
            _ => out.insertion += by.x,
        }
    }
    if let Some(magnet) = out.sources.get_mut(MAGNET) {
        magnet.pose.rotation = turned(&magnet.pose, turn);
    }
    out
}

/// The rotation of a pose turned by a rotation vector, made orthogonal anew.
fn turned(pose: &Pose, by: Vector3<f64>) -> nalgebra::Matrix3<f64> {
    if by == Vector3::zeros() {
        return pose.rotation;
    }
    let rotation = RotationVector::new(by).matrix() * pose.rotation;
    let (first, axis) = (rotation.column(0).into_owned(), rotation.column(2).normalize());
    let second = axis.cross(&first).normalize();
    nalgebra::Matrix3::from_columns(&[second.cross(&axis), second, axis])
}

/// The step that leads from the inputs of these freedoms to `goal`, without the magnet's spin.
pub(super) fn between(inputs: &Inputs, freedoms: &[Freedom], goal: &Inputs) -> DVector<f64> {
    let strength = |inputs: &Inputs, source: usize| inputs.sources[source].strength;
    let position = |inputs: &Inputs, source: usize| inputs.sources[source].pose.position;
    let each = |freedom: &Freedom| {
        let by = match freedom.input {
            Input::SourcePosition(source) => position(goal, source) - position(inputs, source),
            Input::SourceRotation(source) => {
                let [from, to] = [inputs, goal].map(|inputs| inputs.sources[source].pose);
                turn(&from.axis(), &to.axis(), &from.rotation.column(0).into_owned())
            }
            Input::SourceStrength(source) => {
                Vector3::x() * (strength(goal, source) - strength(inputs, source))
            }
            Input::UniformField => goal.uniform_field - inputs.uniform_field,
            _ => Vector3::x() * (goal.insertion - inputs.insertion),
        };
        by.dot(&freedom.along) / freedom.along.norm_squared()
    };
    DVector::from_iterator(freedoms.len(), freedoms.iter().map(each))
}

/// The shortest rotation vector that turns `from` onto `to`; opposite ones turn about `across`.
pub(super) fn turn(from: &Vector3<f64>, to: &Vector3<f64>, across: &Vector3<f64>) -> Vector3<f64> {
    let (angle, axis) = (from.angle(to), from.cross(to));
    match axis.try_normalize(f64::EPSILON * from.norm() * to.norm()) {
        Some(axis) => axis * angle,
        None if angle > 1.0 => across * angle,
        None => Vector3::zeros(),
    }
}
