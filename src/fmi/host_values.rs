//! Host values: the inputs and parameters as the host has set them.

use std::sync::Arc;

use nalgebra::Vector3;

use crate::design::{Backbone, Design, Guidewire, Specification};
use crate::equilibrium::{PlacedSource, Settings};
use crate::error::{Error, Interval};
use crate::geometry::Pose;
use crate::magnetics::{AxialMagnet, Cylinders, Drive, ShapedMagnet, Source, Sources};
use crate::manipulator::{FeedMode, Inputs, Manipulator, POTENTIAL, Scene, SceneFile, Variant, Way};
use crate::vessel::{Vessel, Wall};

/// A pose as the host sets it, one component at a time: until all are set, its quaternion need not have unit norm.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct UncheckedPose {
    /// Origin, m, world frame.
    pub position: [f64; 3],
    /// Quaternion w, x, y, z, body to world.
    pub orientation: [f64; 4],
    /// The start value of the quaternion, which holds while the host leaves it unconnected: four zeros.
    pub start: [f64; 4],
}

/// A magnet or coil as the host places it.
#[derive(Debug, Clone, PartialEq)]
pub struct SourceValues {
    /// What makes the field; of the first magnet with the cylinders that it starts with.
    pub kind: Source,
    /// Its pose.
    pub pose: UncheckedPose,
    /// Factor on a magnet's field, or current through a coil, A.
    pub strength: f64,
}

/// The value of every input and parameter, in SI units.
#[derive(Debug, Clone, PartialEq)]
pub struct HostValues {
    /// The magnets, of which the first is always there, then the coils.
    pub sources: Vec<SourceValues>,
    /// Uniform background field, T, world frame.
    pub uniform_field: [f64; 3],
    /// Gradient of the linear background field, T/m: dBx/dx, dBx/dy, dBx/dz, dBy/dy, dBy/dz.
    pub field_gradient: [f64; 5],
    /// Pose of the clamped base.
    pub base: UncheckedPose,
    /// Whether the shaft is pushed in, or the device clamped at its base.
    pub feed_mode: FeedMode,
    /// Length of shaft inside the port, m; under a given push, that at which the first solve begins.
    pub insertion: f64,
    /// Push on the shaft where that is given instead of the length, N.
    pub feed_force: f64,
    /// Turn about the axis of the base, rad.
    pub roll: f64,
    /// Arc length from the port that the guidewire reaches, m.
    pub guidewire_insertion: f64,
    /// Force on the tip, N, world frame.
    pub tip_force: [f64; 3],
    /// Moment on the tip, N.m, world frame.
    pub tip_moment: [f64; 3],
    /// Force at the centre of each ring magnet, N, world frame.
    pub ring_forces: Vec<[f64; 3]>,
    /// Acceleration of gravity, m/s2, world frame.
    pub gravity: [f64; 3],
    /// The design. The backbone of a segmented design is kept in `backbone` instead, so that it can be switched off and
    /// on without losing its values.
    pub specification: Specification,
    /// The backbone that a segmented design has if `backbone_present` is true.
    pub backbone: Backbone,
    /// Whether the design has a backbone.
    pub backbone_present: bool,
    /// The shaft of a scene that has one.
    pub shaft: Option<Backbone>,
    /// The guidewire of a scene that has one.
    pub guidewire: Option<Guidewire>,
    /// The vessel of a scene that has one; copies of the values, made in every step whose inputs move, share it.
    pub vessel: Option<Arc<Vessel>>,
    /// Young's modulus of its wall, Pa.
    pub wall_modulus: f64,
    /// Coefficient of friction between the device and the wall.
    pub friction: f64,
    /// The cylinders of the first magnet, which are parameters; none where it has a shape.
    pub magnets: Vec<AxialMagnet>,
    /// The first magnet where it is given by its shape, whose numbers are parameters; else empty.
    pub shaped: Vec<ShapedMagnet>,
    /// How the device comes to its first inputs.
    pub way: Way,
    /// Settings of model and solver.
    pub settings: Settings,
}

/// The magnet of a scene that states none: the usual assembly at its usual place, switched off.
const SWITCHED_OFF: &str = "[magnet]\nstrength = 0.0";

/// Norm below which a quaternion counts as one that nothing is connected to: hosts give four zeros, and some vary these by 1e-8 for
/// differences.
const UNCONNECTED_NORM: f64 = 1e-3;

/// Strength of a magnet below which it is switched off, and no body to be touched: some hosts vary zeros by 1e-8 for differences. The
/// field of such a magnet is less than a hundredth of the earth's.
const SWITCHED_OFF_BELOW: f64 = 1e-7;

/// Norms of quaternions that are normalised. Hosts interpolate components: half-way between orientations that are 15 degrees apart
/// the norm is 0.998, between opposite directions 0.707.
const NORMALISED: Interval = Interval::at_least(0.5).at_most(2.0);

/// Deviation from unit norm of which the log tells: more than components rounded to three decimals.
const NORM_SLACK: f64 = 1e-3;

impl HostValues {
    /// The start values that a scene states.
    ///
    /// A scene without an external magnet gets the usual one with strength 0, so that a host can switch it on.
    ///
    /// # Errors
    /// Those of [`SceneFile::scene`]; [`Error::Unsupported`] for a method other than the potential method, which alone
    /// has derivatives and a state that can be saved.
    pub fn start(file: &SceneFile) -> Result<Self, Error> {
        let scene = file.scene()?;
        if scene.method != POTENTIAL {
            return Err(Error::Unsupported(format!(
                "an FMU solves by method \"{POTENTIAL}\", not \"{}\"",
                scene.method
            )));
        }

        let inputs = &scene.inputs;
        let mut sources = placed(&scene);
        let mut magnets = file.magnet_cylinders();
        if scene.sources.magnet().is_none() {
            let usual = SceneFile::parse(SWITCHED_OFF, "usual magnet")?;
            magnets = usual.magnet_cylinders();
            sources.splice(0..0, placed(&usual.scene()?));
        }

        let backbone = match &scene.specification {
            Specification::Segmented(segmented) => segmented.backbone,
            Specification::Cylinder(_) | Specification::Sections(_) => None,
        };

        Ok(Self {
            sources,
            uniform_field: inputs.uniform_field.into(),
            field_gradient: inputs.field_gradient,
            base: inputs.base.into(),
            feed_mode: match (&scene.shaft, inputs.feed_force) {
                (None, _) => FeedMode::Clamped,
                (Some(_), None) => FeedMode::Insertion,
                (Some(_), Some(_)) => FeedMode::Force,
            },
            insertion: inputs.insertion,
            feed_force: inputs.feed_force.unwrap_or(0.0),
            roll: inputs.roll,
            guidewire_insertion: inputs.guidewire_insertion,
            shaft: scene.shaft,
            guidewire: scene.guidewire,
            wall_modulus: scene.vessel.as_ref().map_or(0.0, |vessel| vessel.wall.modulus()),
            friction: scene.vessel.as_ref().map_or(0.0, |vessel| vessel.wall.friction()),
            tip_force: inputs.tip_force.into(),
            tip_moment: inputs.tip_moment.into(),
            ring_forces: inputs.ring_forces.iter().map(|&force| force.into()).collect(),
            gravity: inputs.gravity.into(),
            backbone: backbone.unwrap_or_else(Backbone::silicone),
            backbone_present: backbone.is_some(),
            specification: scene.specification,
            vessel: scene.vessel.map(Arc::new),
            magnets,
            shaped: file.shaped_magnet()?.into_iter().collect(),
            way: scene.way,
            settings: scene.settings,
        })
    }

    /// All poses that a host sets.
    fn poses(&self) -> impl Iterator<Item = &UncheckedPose> {
        self.sources.iter().map(|source| &source.pose).chain([&self.base])
    }

    /// An orientation that is not of unit norm but normalised, and its norm.
    #[must_use]
    pub fn off_unit_norm(&self) -> Option<(String, f64)> {
        let is_off = |norm: f64| norm >= UNCONNECTED_NORM && (norm - 1.0).abs() > NORM_SLACK;
        let mut norms = self.poses().map(UncheckedPose::norm).enumerate();
        let (number, norm) = norms.find(|(_, norm)| is_off(*norm))?;
        Some((self.orientation(Some(number)), norm))
    }

    /// The name of the orientation of a source, or of the base.
    pub(super) fn orientation(&self, source: Option<usize>) -> String {
        let source = source.and_then(|number| self.source_names().nth(number));
        source.map_or_else(|| "base".into(), |(name, _)| name) + ".orientation"
    }

    /// Whether an orientation counts as one that nothing is connected to.
    #[must_use]
    pub fn has_unconnected(&self) -> bool {
        self.poses().any(UncheckedPose::is_unconnected)
    }

    /// The structured name of each source, and what drives it: `magnet`, `magnet[2]`, ..., `coil[1]`, ....
    pub fn source_names(&self) -> impl Iterator<Item = (String, Drive)> {
        let (mut magnets, mut coils) = (0, 0);
        self.sources.iter().map(move |source| {
            let drive = source.kind.drive();
            let count = match drive {
                Drive::Factor => &mut magnets,
                Drive::Current => &mut coils,
            };
            *count += 1;
            let name = match (drive, *count) {
                (Drive::Factor, 1) => drive.noun().into(),
                (_, count) => format!("{}[{count}]", drive.noun()),
            };
            (name, drive)
        })
    }

    /// The inputs, and gravity, as the manipulator takes them.
    ///
    /// # Errors
    /// [`Error::Range`] naming the quaternion that does not have unit norm.
    pub fn inputs(&self) -> Result<Inputs, Error> {
        let sources = self.sources.iter().enumerate().map(|(number, source)| {
            let pose = source.pose.pose(|| self.orientation(Some(number)))?;
            let strength = match source.kind.drive() {
                Drive::Factor => switched(source.strength),
                Drive::Current => source.strength,
            };
            Ok(PlacedSource { pose, strength })
        });

        Ok(Inputs {
            sources: sources.collect::<Result<_, Error>>()?,
            uniform_field: self.uniform_field.into(),
            field_gradient: self.field_gradient,
            base: self.base.pose(|| self.orientation(None))?,
            insertion: self.insertion,
            feed_force: (self.feed_mode == FeedMode::Force).then_some(self.feed_force),
            roll: self.roll,
            guidewire_insertion: self.guidewire_insertion,
            tip_force: self.tip_force.into(),
            tip_moment: self.tip_moment.into(),
            ring_forces: self.ring_forces.iter().map(|&force| force.into()).collect(),
            gravity: self.gravity.into(),
            widening: 0.0,
            softening: 0.0,
        })
    }

    /// The design that the parameters describe, checked.
    ///
    /// # Errors
    /// [`Error::Range`] naming the first quantity that is out of range.
    pub fn design(&self) -> Result<Design, Error> {
        let mut specification = self.specification.clone();
        if let Specification::Segmented(segmented) = &mut specification {
            segmented.backbone = self.backbone_present.then_some(self.backbone);
        }
        let design = Design::new(specification)?;
        let shaft = self.shaft.as_ref().filter(|_| self.feed_mode != FeedMode::Clamped);
        design.with(shaft, self.guidewire.as_ref())
    }

    /// The checked magnets and coils.
    ///
    /// # Errors
    /// Those of [`Cylinders::new`].
    pub fn sources(&self) -> Result<Sources, Error> {
        let mut list: Vec<Source> = self.sources.iter().map(|source| source.kind.clone()).collect();
        if let Some(first) = list.first_mut() {
            if let Some(shaped) = self.shaped.first() {
                *first = shaped.source()?;
            } else if !self.magnets.is_empty() {
                *first = Cylinders::new(self.magnets.clone())?.into();
            }
        }
        Sources::new(list)
    }

    /// The vessel with the wall that the parameters describe, checked.
    fn in_wall(&self) -> Result<Option<Vessel>, Error> {
        let in_lumen = |vessel: &Arc<Vessel>| {
            let wall = Wall::new(self.wall_modulus)?.with_friction(self.friction)?;
            Ok::<_, Error>(Vessel { wall, lumen: vessel.lumen.clone() })
        };
        self.vessel.as_ref().map(in_lumen).transpose()
    }

    /// The device that the parameters describe in its surroundings, checked, with its inputs.
    ///
    /// # Errors
    /// Those of [`HostValues::design`], [`Cylinders::new`], [`Wall::new`] and [`HostValues::inputs`].
    pub fn variant(&self) -> Result<Variant, Error> {
        let (design, sources) = (self.design()?, self.sources()?);
        Ok(Variant { design, sources, vessel: self.in_wall()?, inputs: self.inputs()? })
    }

    /// The manipulator that the parameters describe, not yet solved.
    ///
    /// # Errors
    /// Those of [`HostValues::design`], [`Cylinders::new`], [`Wall::new`] and [`Manipulator::new`].
    pub fn manipulator(&self, shape_points: usize) -> Result<Manipulator, Error> {
        let (design, vessel) = (self.design()?, self.in_wall()?);
        let made = Manipulator::new(&design, self.sources()?, self.settings, shape_points)?;
        let made = made.on_way(self.way.clone());
        Ok(match &vessel {
            Some(vessel) => made.in_vessel(vessel),
            None => made,
        })
    }

    /// These values with those of the tunable parameters that a manipulator is built with, and that each solve sets anew, as at the
    /// start: the present ones may be refused.
    pub(super) fn with_tunables_of(&self, start: &Self) -> Self {
        let Settings { tolerance_position, tolerance_angle, tolerance_relative, .. } = start.settings;
        let settings = Settings { tolerance_position, tolerance_angle, tolerance_relative, ..self.settings };
        Self { settings, friction: start.friction, ..self.clone() }
    }
}

/// The sources of a scene where it places them.
fn placed(scene: &Scene) -> Vec<SourceValues> {
    let each = scene.sources.list().iter().zip(&scene.inputs.sources);
    let values = each.map(|(kind, placed)| SourceValues {
        kind: kind.clone(),
        pose: placed.pose.into(),
        strength: placed.strength,
    });
    values.collect()
}

/// The strength of a magnet as it acts.
fn switched(strength: f64) -> f64 {
    if strength.abs() < SWITCHED_OFF_BELOW { 0.0 } else { strength }
}

impl From<Pose> for UncheckedPose {
    fn from(pose: Pose) -> Self {
        let orientation = pose.quaternion();
        Self { position: pose.position.into(), orientation, start: orientation }
    }
}

impl UncheckedPose {
    fn norm(&self) -> f64 {
        self.orientation.iter().map(|component| component * component).sum::<f64>().sqrt()
    }

    /// Scales the quaternion to unit norm, unless it is too short to determine an orientation.
    pub(super) fn normalise(&mut self) {
        let norm = self.norm();
        if norm > UNCONNECTED_NORM {
            self.orientation = self.orientation.map(|component| component / norm);
        }
    }

    /// Whether its quaternion is zero, or as good as zero, as an input that the host leaves unconnected.
    pub(super) fn is_unconnected(&self) -> bool {
        self.norm() < UNCONNECTED_NORM
    }

    /// Angular velocity (rad per unit of the rate, world axes) of the orientation of its quaternion, when that changes at a rate; zero
    /// where it is not connected, so that its start value holds.
    pub(super) fn spin(&self, rate: [f64; 4]) -> Vector3<f64> {
        if self.is_unconnected() { Vector3::zeros() } else { Pose::rotation_rate(self.orientation, rate) }
    }

    /// # Errors
    /// [`Error::Range`] for a quaternion whose norm is from 0.001 to 0.5, or above 2.
    fn pose(&self, orientation: impl Fn() -> String) -> Result<Pose, Error> {
        if self.is_unconnected() {
            return Pose::new(self.position, self.start);
        }
        let norm = self.norm();
        if !NORMALISED.contains(norm) {
            let allowed =
                "from 0.5 to 2, as an orientation is normalised, or below 0.001, where it is not connected";
            return Err(Error::range(format!("norm of {}", orientation()), norm, allowed));
        }
        Pose::new(self.position, self.orientation.map(|component| component / norm))
    }
}
