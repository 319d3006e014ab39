//! Conversion of a scene file to SI units and to the quantities that its names stand for.

use nalgebra::Vector3;
use toml::Value;

use super::file::{FieldEntries, ModelEntries, SceneFile};
use super::names::without_index;
use super::pose::{in_metres, pose, turn, turned};
use super::ranges::{GUIDEWIRE_INSERTION, INSERTION, TURN};
use super::tube::GuidewireEntries;
use super::units::{MM_PER_M, MT_PER_T};
use super::vessel::{FeedMode, VesselEntries};
use super::{Scene, names};
use crate::design::{Backbone, Design, Segmented, Specification};
use crate::equilibrium::Settings;
use crate::error::{Error, check};
use crate::magnetics::Sources;
use crate::manipulator::Inputs;
use crate::manipulator::way::{Counts, Way};
use crate::vessel::Vessel;

/// Relative depth in the wall that a device at rest on it may have by rounding of its numbers.
const ROUNDED: f64 = 1e-6;

/// Distance of the magnet's axis below the manipulator's middle when no position is given, m.
const MAGNET_DISTANCE: f64 = 0.12;

fn beside(design: &Design) -> [f64; 3] {
    [0.0, -MAGNET_DISTANCE, design.length() / 2.0]
}

impl SceneFile {
    /// The scene in SI units.
    ///
    /// # Errors
    /// See [`Scene::parse`].
    pub fn scene(&self) -> Result<Scene, Error> {
        self.as_written(self.in_si(|vessel| vessel.si(self.mesh.as_ref()).map(Some)))
    }

    /// Checks all that does not depend on the mesh of a vessel, before that is sampled.
    pub(super) fn check_before_mesh(&self) -> Result<(), Error> {
        self.as_written(self.in_si(|vessel| vessel.check_before_mesh().map(|()| None))).map(|_| ())
    }

    /// What was found, with errors as the file writes its keys and numbers.
    fn as_written<T>(&self, found: Result<T, Error>) -> Result<T, Error> {
        found.map_err(|error| match self.table() {
            Ok(table) => names::as_written(error, &Value::Table(table)),
            Err(_) => error,
        })
    }

    /// The scene with the vessel that `vessel_of` makes of its table.
    fn in_si(
        &self,
        vessel_of: impl FnOnce(&VesselEntries) -> Result<Option<Vessel>, Error>,
    ) -> Result<Scene, Error> {
        let (specification, design) = self.design.design()?;
        let inputs = self.inputs(&design)?;
        let sources = self.sources()?;

        let vessel = self.vessel.as_ref().map(vessel_of).transpose()?.flatten();
        let shaft = self.shaft(&specification)?;
        let guidewire = self.guidewire.map(GuidewireEntries::si);

        design.clone().with(shaft.as_ref(), guidewire.as_ref())?;
        if let Some(vessel) = &vessel {
            fits(&design, vessel, &inputs)?;
        }

        let settings = self.settings()?;
        self.uncertainty()?;
        let way = Way::new(
            &self.start.way,
            Counts {
                rings: design.rings().count(),
                magnets: self.magnet.0.len(),
                coils: self.coil.len(),
                shaft: shaft.is_some(),
                guidewire: guidewire.is_some(),
            },
            &inputs,
        )?;

        let scene = Scene {
            specification,
            sources: Sources::new(sources)?,
            vessel,
            shaft,
            guidewire,
            inputs,
            way,
            settings,
            method: self.model.method.clone(),
        };

        scene.sources.check_apart(|number| {
            let placed = scene.inputs.sources.get(number)?;
            scene.sources.is_there(number, placed.strength).then_some((placed.pose, true))
        })?;
        Ok(scene)
    }

    /// Fills in the defaults that depend on other entries.
    pub(super) fn complete(&mut self) {
        self.design.complete();
        let uncertainty = &mut self.uncertainty;
        self.magnet.complete(|key, deviation| {
            uncertainty.entry(key).or_insert(deviation);
        });
    }

    /// Fills in the entry that `key` names if it was omitted because it follows from the design.
    pub(super) fn complete_for(&mut self, key: &str) -> Result<(), Error> {
        let design = || Ok::<_, Error>(self.design.design()?.1);
        if key.starts_with("load.ring_force_n") && self.load.ring_force_n.is_none() {
            self.load.ring_force_n = Some(vec![[0.0; 3]; design()?.rings().count()]);
        } else if let Some(magnet) = self.magnet.0.first_mut().filter(|m| m.position_mm.is_none())
            && ["magnet.position_mm", "magnet[1].position_mm"].iter().any(|start| key.starts_with(start))
        {
            magnet.position_mm = Some(beside(&design()?).map(|x| x * MM_PER_M));
        } else if key.ends_with(']') && key.starts_with("design.") && !key.starts_with("design.section") {
            let design = design()?;
            let counts = [design.segments().len(), design.rings().count()];
            self.design.spread(without_index(key), counts);
        }
        Ok(())
    }

    fn inputs(&self, design: &Design) -> Result<Inputs, Error> {
        let rings = design.rings().count();
        let mut inputs = Inputs::unloaded(rings);

        inputs.sources = self.placed_sources(beside(design))?;
        let FieldEntries { uniform_mt, turn_axis, turn_deg, gradient_t_per_m } = self.field;
        inputs.uniform_field =
            turn("field", turn_axis, turn_deg)? * Vector3::from(uniform_mt.map(|b| b / MT_PER_T));
        inputs.field_gradient = gradient_t_per_m;
        let base = pose("base", in_metres(self.base.position_mm), self.base.orientation_wxyz)?;
        inputs.base = turned(&turn("base", self.base.turn_axis, self.base.turn_deg)?, base);

        if let Some(feed) = &self.feed {
            (inputs.insertion, inputs.roll) = (feed.insertion_mm / MM_PER_M, feed.roll_deg.to_radians());
            inputs.feed_force = (feed.mode == FeedMode::Force).then(|| feed.force_n.unwrap_or(0.0));
        }

        if let Some(wire) = &self.guidewire {
            let insertion = GUIDEWIRE_INSERTION.check("guidewire.insertion_mm", wire.insertion_mm)?;
            inputs.guidewire_insertion = insertion / MM_PER_M;
        }

        inputs.tip_force = self.load.tip_force_n.into();
        inputs.tip_moment = self.load.tip_moment_nm.into();
        inputs.gravity = self.gravity.acceleration_m_s2.into();

        if let Some(forces) = &self.load.ring_force_n {
            if forces.len() != rings {
                return Err(Error::Count {
                    quantity: "load.ring_force_n".into(),
                    given: forces.len(),
                    expected: format!("{rings}, one for each ring of the design"),
                });
            }
            inputs.ring_forces = forces.iter().map(|&force| force.into()).collect();
        }

        Ok(inputs)
    }

    /// The shaft that is pushed in: its own table, or the backbone that goes on behind the base.
    fn shaft(&self, specification: &Specification) -> Result<Option<Backbone>, Error> {
        let Some(feed) = &self.feed else { return Ok(None) };

        TURN.check("feed.roll_deg", feed.roll_deg)?;
        if let Some(force) = feed.force_n.filter(|_| feed.mode != FeedMode::Force) {
            check("feed.force_n", force, |v| v == 0.0, "0 unless feed.mode = \"force\"")?;
        }

        if feed.mode == FeedMode::Clamped {
            check(
                "feed.insertion_mm",
                feed.insertion_mm,
                |v| v == 0.0,
                "0 unless feed.mode = \"insertion\" or \"force\"",
            )?;
            return match feed.shaft {
                Some(_) => {
                    Err(Error::Unsupported("feed.shaft needs feed.mode = \"insertion\" or \"force\"".into()))
                }
                None => Ok(None),
            };
        }

        INSERTION.check("feed.insertion_mm", feed.insertion_mm)?;
        if let Some(shaft) = feed.shaft {
            return Ok(Some(shaft.si("feed.shaft")?));
        }

        match specification {
            Specification::Segmented(Segmented { backbone: Some(backbone), .. }) => Ok(Some(*backbone)),
            _ => Err(Error::Unsupported(
                "feed.shaft is missing: without design.backbone, there is no tube that goes on behind the base".into(),
            )),
        }
    }

    fn settings(&self) -> Result<Settings, Error> {
        let ModelEntries { interaction, method: _, bending_stop, mutual_wrenches, .. } = self.model;
        let settings = Settings {
            interaction,
            bending_stop,
            mutual_wrenches,
            tolerance_position: self.model.tolerance_position_mm / MM_PER_M,
            tolerance_angle: self.model.tolerance_angle_deg.to_radians(),
            tolerance_relative: self.model.tolerance_relative,
            time_budget: self.model.time_budget_s,
            iterations: u32::try_from(self.model.iterations).unwrap_or(u32::MAX),
            ..Settings::default()
        };
        settings.checked()
    }
}

/// Checks that a device fits into its vessel where it starts.
fn fits(design: &Design, vessel: &Vessel, inputs: &Inputs) -> Result<(), Error> {
    let radius = design.largest_radius();
    let clearance = vessel.lumen.clearance(&inputs.base.position).value;
    let place = vessel.lumen.grid().map_or_else(String::new, |grid| {
        let [low, high] = grid.bounds().map(|at| at.map(|v| (v * MM_PER_M).round()));
        format!(
            "; the mesh lies within ({}, {}, {}) to ({}, {}, {}) mm, its ends are walls",
            low.x, low.y, low.z, high.x, high.y, high.z
        )
    });
    let allowed = format!(
        ">= {:.4}, the radius of the device: it does not fit in where it starts{place}",
        radius * MM_PER_M
    );
    let fits = |v: f64| v >= radius * MM_PER_M * (1.0 - ROUNDED);
    check(
        "distance of base.position_mm from the wall of the vessel (mm)",
        clearance * MM_PER_M,
        fits,
        &allowed,
    )?;
    Ok(())
}
