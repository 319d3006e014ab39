//! Conversion of a scene file to SI units and to the quantities that its names stand for.

use nalgebra::Vector3;
use toml::Value;

use super::file::{
    DesignEntries, DesignKind, FieldEntries, HelixEntries, ModelEntries, RingEntries, SceneFile, SpiralName,
};
use super::pose::{in_metres, pose, turn, turned};
use super::ranges::{GUIDEWIRE_INSERTION, INSERTION, TIME_BUDGET, TURN};
use super::spiral_start::SpiralStartEntry;
use super::tube::GuidewireEntries;
use super::units::{MM_PER_M, MT_PER_T, PA_PER_MPA};
use super::vessel::FeedMode;
use super::{Scene, names};
use crate::design::{
    Backbone, Cylinder, CylinderMaterial, Design, Helix, RingMagnet, Segmented, Specification, SpiralKind,
    SpiralStart,
};
use crate::equilibrium::Settings;
use crate::error::{Error, check};
use crate::magnetics::Assembly;
use crate::manipulator::Inputs;
use crate::methods;
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
        self.in_si().map_err(|error| match self.table() {
            Ok(table) => names::as_written(error, &Value::Table(table)),
            Err(_) => error,
        })
    }

    fn in_si(&self) -> Result<Scene, Error> {
        let specification = self.design.specification()?;
        let design = Design::new(specification.clone())?;
        let inputs = self.inputs(&design)?;
        let mut all = Vec::new();
        for (number, magnet) in self.magnet.0.iter().enumerate() {
            let cylinders = magnet.cylinders();
            Assembly::new(cylinders.clone()).map_err(|error| match error {
                Error::Range { .. } => error,
                of_the_list => {
                    Error::Unsupported(format!("{}.cylinders: {of_the_list}", self.magnet.key(number)))
                }
            })?;
            all.push(cylinders);
        }
        let mut all = all.into_iter();
        let (magnets, further_magnets) = (all.next(), all.collect());
        let coils = (1..).zip(&self.coil).map(|(number, coil)| coil.si(&format!("coil[{number}]")));
        let coils = coils.collect::<Result<_, _>>()?;
        let vessel = self.vessel.as_ref().map(|entries| entries.si(self.mesh.as_ref())).transpose()?;
        let shaft = self.shaft(&specification)?;
        let guidewire = self.guidewire.map(GuidewireEntries::si);
        design.clone().with(shaft.as_ref(), guidewire.as_ref())?;
        if let Some(vessel) = &vessel {
            fits(&design, vessel, &inputs)?;
        }
        let solver = methods::Settings { method: self.model.method, ..methods::Settings::default() };
        let settings = self.settings()?;
        self.uncertainty()?;
        let scene = Scene {
            specification,
            magnets,
            further_magnets,
            coils,
            vessel,
            shaft,
            guidewire,
            inputs,
            settings,
            solver,
        };
        let sources = scene.sources()?;
        sources.check_apart(|number| {
            let placed = scene.inputs.source(number);
            placed
                .filter(|placed| sources.is_there(number, placed.strength))
                .map(|placed| (placed.pose, true))
        })?;
        Ok(scene)
    }

    /// Fills in the entry that `key` names if it was omitted because it follows from the design.
    pub(super) fn complete_for(&mut self, key: &str) -> Result<(), Error> {
        let design = || Design::new(self.design.specification()?);
        if key.starts_with("load.ring_force_n") && self.load.ring_force_n.is_none() {
            self.load.ring_force_n = Some(vec![[0.0; 3]; design()?.rings().count()]);
        } else if let Some(magnet) = self.magnet.0.first_mut().filter(|m| m.position_mm.is_none())
            && ["magnet.position_mm", "magnet[1].position_mm"].iter().any(|start| key.starts_with(start))
        {
            magnet.position_mm = Some(beside(&design()?).map(|x| x * MM_PER_M));
        } else if let Some(SpiralStartEntry::Same(degrees)) = self.design.spiral_start_deg
            && key.starts_with("design.spiral_start_deg[")
        {
            let segments = design()?.segments().len();
            self.design.spiral_start_deg = Some(SpiralStartEntry::Each(vec![degrees; segments]));
        }
        Ok(())
    }

    fn inputs(&self, design: &Design) -> Result<Inputs, Error> {
        let rings = design.rings().count();
        let mut inputs = Inputs::unloaded(rings);
        if let Some(magnet) = self.magnet.0.first() {
            let placed = magnet.placed(&self.magnet.key(0), Some(beside(design)))?;
            (inputs.magnet, inputs.magnet_strength) = (placed.pose, placed.strength);
        }
        inputs.further = self.further()?;
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
            let reach = GUIDEWIRE_INSERTION.check("guidewire.insertion_mm", wire.insertion_mm)?;
            inputs.guidewire_insertion = reach / MM_PER_M;
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
        let ModelEntries { interaction, method: _, bending_stop, time_budget_s, mutual_wrenches } =
            self.model;
        let time_budget = TIME_BUDGET.check("model.time_budget_s", time_budget_s)?;
        Ok(Settings { interaction, bending_stop, time_budget, mutual_wrenches, ..Settings::default() })
    }
}

/// A key of the table `[design]`, and whether it is there.
pub(super) type DesignKey = (&'static str, fn(&DesignEntries) -> bool);

impl DesignEntries {
    const SEGMENTS: usize = 9;

    /// Fills in the defaults that do not depend on other entries.
    pub(super) fn complete(&mut self) {
        if self.kind == DesignKind::Segments {
            self.segments.get_or_insert(Self::SEGMENTS);
            self.base_magnet.get_or_insert(true);
            self.tip_magnet.get_or_insert(true);
            self.spiral.get_or_insert(SpiralName::Helical);
            self.spiral_start_deg.get_or_insert(SpiralStartEntry::Same(0.0));
            self.helix.get_or_insert_default();
            self.ring.get_or_insert_default();
        } else {
            self.inner_radius_mm.get_or_insert(0.0);
        }
    }

    fn specification(&self) -> Result<Specification, Error> {
        self.refuse_keys_of_other_kind()?;
        let segments = self.segments.unwrap_or(Self::SEGMENTS);
        Ok(match self.kind {
            DesignKind::Segments => Specification::Segmented(Segmented {
                segments,
                base_magnet: self.base_magnet.unwrap_or(true),
                tip_magnet: self.tip_magnet.unwrap_or(true),
                spiral: match self.spiral {
                    Some(SpiralName::Axisymmetric) => SpiralKind::Axisymmetric,
                    Some(SpiralName::Alternating) => SpiralKind::Alternating,
                    Some(SpiralName::Helical) | None => SpiralKind::Helical,
                },
                spiral_start: match &self.spiral_start_deg {
                    Some(start) => start.si(segments)?,
                    None => SpiralStart::Same(0.0),
                },
                helix: self.helix.unwrap_or_default().si(),
                ring: self.ring.unwrap_or_default().si(),
                backbone: self.backbone.map(|entries| entries.si("design.backbone")).transpose()?,
            }),
            DesignKind::Cylinder => Specification::Cylinder(Cylinder {
                length: required("design.length_mm", self.length_mm)? / MM_PER_M,
                radius: required("design.radius_mm", self.radius_mm)? / MM_PER_M,
                inner_radius: self.inner_radius_mm.unwrap_or(0.0) / MM_PER_M,
                material: self.cylinder_material()?,
                density: self.density_kg_m3,
            }),
        })
    }

    /// A composite as in Table 1 by default, or a bulk material when its modulus or remanence is given directly.
    fn cylinder_material(&self) -> Result<CylinderMaterial, Error> {
        let table_1 = HelixEntries::default();
        let poisson = self.poisson.unwrap_or(table_1.poisson);
        if self.elastic_modulus_mpa.is_none() && self.remanence_t.is_none() {
            return Ok(CylinderMaterial::Composite {
                shore_a: self.shore_a.unwrap_or(table_1.shore_a),
                poisson,
                volume_fraction: self.volume_fraction.unwrap_or(table_1.volume_fraction),
                particle_remanence: self.particle_remanence_t.unwrap_or(table_1.particle_remanence_t),
            });
        }
        self.refuse(
            &Self::OF_COMPOSITE,
            "has no meaning beside elastic_modulus_mpa and remanence_t: give one or the other",
        )?;
        Ok(CylinderMaterial::Bulk {
            elastic_modulus: required("design.elastic_modulus_mpa", self.elastic_modulus_mpa)? * PA_PER_MPA,
            poisson,
            remanence: required("design.remanence_t", self.remanence_t)?,
        })
    }

    /// Keys of a chain of segments, and whether they are there.
    pub(super) const OF_SEGMENTS: [DesignKey; 8] = [
        ("segments", |design| design.segments.is_some()),
        ("base_magnet", |design| design.base_magnet.is_some()),
        ("tip_magnet", |design| design.tip_magnet.is_some()),
        ("spiral", |design| design.spiral.is_some()),
        ("spiral_start_deg", |design| design.spiral_start_deg.is_some()),
        ("helix", |design| design.helix.is_some()),
        ("ring", |design| design.ring.is_some()),
        ("backbone", |design| design.backbone.is_some()),
    ];

    /// The same of a plain rod.
    pub(super) const OF_CYLINDER: [DesignKey; 10] = [
        ("length_mm", |design| design.length_mm.is_some()),
        ("radius_mm", |design| design.radius_mm.is_some()),
        ("inner_radius_mm", |design| design.inner_radius_mm.is_some()),
        ("shore_a", |design| design.shore_a.is_some()),
        ("elastic_modulus_mpa", |design| design.elastic_modulus_mpa.is_some()),
        ("poisson", |design| design.poisson.is_some()),
        ("volume_fraction", |design| design.volume_fraction.is_some()),
        ("particle_remanence_t", |design| design.particle_remanence_t.is_some()),
        ("remanence_t", |design| design.remanence_t.is_some()),
        ("density_kg_m3", |design| design.density_kg_m3.is_some()),
    ];

    /// The same of a rod of rubber with particles, which have no meaning where modulus and remanence are given.
    pub(super) const OF_COMPOSITE: [DesignKey; 3] = [
        ("shore_a", |design| design.shore_a.is_some()),
        ("volume_fraction", |design| design.volume_fraction.is_some()),
        ("particle_remanence_t", |design| design.particle_remanence_t.is_some()),
    ];

    fn refuse_keys_of_other_kind(&self) -> Result<(), Error> {
        match self.kind {
            DesignKind::Segments => self.refuse(
                &Self::OF_CYLINDER,
                "belongs to kind = \"cylinder\"; the segments' dimensions are in design.helix and design.ring",
            ),
            DesignKind::Cylinder => self.refuse(&Self::OF_SEGMENTS, "belongs to kind = \"segments\""),
        }
    }

    /// Refuses the first of these keys that is there.
    fn refuse(&self, keys: &[DesignKey], reason: &str) -> Result<(), Error> {
        match keys.iter().find(|(_, is_there)| is_there(self)) {
            Some((key, _)) => Err(Error::Unsupported(format!("design.{key} {reason}"))),
            None => Ok(()),
        }
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

fn required(key: &str, value: Option<f64>) -> Result<f64, Error> {
    value.ok_or_else(|| Error::Unsupported(format!("{key} is missing")))
}

impl HelixEntries {
    fn si(self) -> Helix {
        Helix {
            length: self.length_mm / MM_PER_M,
            boundary_angle: self.boundary_angle_deg.to_radians(),
            radius: self.radius_mm / MM_PER_M,
            windings: self.windings,
            core_outer_radius: self.core_outer_radius_mm / MM_PER_M,
            core_inner_radius: self.core_inner_radius_mm / MM_PER_M,
            shore_a: self.shore_a,
            poisson: self.poisson,
            volume_fraction: self.volume_fraction,
            particle_remanence: self.particle_remanence_t,
            density: self.density_kg_m3,
        }
    }
}

impl RingEntries {
    fn si(self) -> RingMagnet {
        RingMagnet {
            length: self.length_mm / MM_PER_M,
            remanence: self.remanence_t,
            recoil_permeability: self.recoil_permeability,
            density: self.density_kg_m3,
        }
    }
}
