//! Table `[design]` in SI units, and which keys a device of each kind has.

use toml::Value;

use super::SceneFile;
use super::file::{DesignEntries, DesignKind, SpiralName};
use super::numbers::Numbers;
use super::units::{MM_PER_M, PA_PER_MPA};
use super::{sections, spiral_start};
use crate::design::{
    Cylinder, CylinderMaterial, Design, Helix, Segmented, Specification, SpiralKind, SpiralStart,
};
use crate::error::Error;

impl SceneFile {
    /// All keys that the table `[design]` of a device of this kind may have; of any other name, those of the default kind.
    pub(super) fn keys_of_device(kind: &str) -> Vec<&'static str> {
        let own = match Value::from(kind).try_into().unwrap_or_default() {
            DesignKind::Segments => &DesignEntries::OF_SEGMENTS[..],
            DesignKind::Cylinder => &DesignEntries::OF_CYLINDER[..],
            DesignKind::Sections => &DesignEntries::OF_SECTIONS[..],
        };
        std::iter::once("kind").chain(own.iter().map(|(key, _)| *key)).collect()
    }
}

/// A key of the table `[design]`, and whether it is there.
pub(super) type DesignKey = (&'static str, fn(&DesignEntries) -> bool);

impl DesignEntries {
    const SEGMENTS: usize = 9;

    /// Fills in the defaults that do not depend on other entries.
    pub(super) fn complete(&mut self) {
        match self.kind {
            DesignKind::Segments => self.complete_segments(),
            DesignKind::Cylinder => {
                self.inner_radius_mm.get_or_insert(0.0);
            }
            DesignKind::Sections => {}
        }
    }

    fn complete_segments(&mut self) {
        self.segments.get_or_insert(Self::SEGMENTS);
        self.base_magnet.get_or_insert(true);
        self.tip_magnet.get_or_insert(true);
        self.spiral.get_or_insert(SpiralName::Helical);
        self.spiral_start_deg.get_or_insert(Numbers::Same(0.0));
        self.helix.get_or_insert_default();
        self.ring.get_or_insert_default();
    }

    /// Makes a number for all, under this key, a list with one for each of so many segments or rings.
    pub(super) fn spread(&mut self, key: &str, [segments, rings]: [usize; 2]) {
        if let Some(start) = self.spiral_start_deg.as_mut().filter(|_| key == "design.spiral_start_deg") {
            start.spread(segments);
        }
        if let Some(helix) = &mut self.helix {
            helix.spread(key, segments);
        }
        if let Some(ring) = &mut self.ring {
            ring.spread(key, rings);
        }
    }

    /// The device with its specification.
    pub(super) fn design(&self) -> Result<(Specification, Design), Error> {
        let specification = self.specification()?;
        let design = Design::new(specification.clone()).map_err(|error| {
            // The tables of the file come before what is repeated.
            match sections::listed(&self.section, &self.group) {
                Ok((_, order)) if self.kind == DesignKind::Sections => {
                    error.renumbered(|number| order.get(number - 1).copied().unwrap_or(number))
                }
                _ => error,
            }
        })?;
        Ok((specification, design))
    }

    pub(super) fn specification(&self) -> Result<Specification, Error> {
        self.refuse_keys_of_other_kind()?;

        Ok(match self.kind {
            DesignKind::Segments => Specification::Segmented(self.segmented()?),
            DesignKind::Cylinder => Specification::Cylinder(Cylinder {
                length: required("design.length_mm", self.length_mm)? / MM_PER_M,
                radius: required("design.radius_mm", self.radius_mm)? / MM_PER_M,
                inner_radius: self.inner_radius_mm.unwrap_or(0.0) / MM_PER_M,
                material: self.cylinder_material()?,
                density: self.density_kg_m3,
            }),
            DesignKind::Sections => Specification::Sections(sections::listed(&self.section, &self.group)?.0),
        })
    }

    fn segmented(&self) -> Result<Segmented, Error> {
        let segments = self.segments.unwrap_or(Self::SEGMENTS);
        let (helix, mut lists) = self.helix.clone().unwrap_or_default().si();
        let (ring, of_rings, ring_directions) = self.ring.clone().unwrap_or_default().si();
        lists.extend(of_rings);
        Ok(Segmented {
            segments,
            base_magnet: self.base_magnet.unwrap_or(true),
            tip_magnet: self.tip_magnet.unwrap_or(true),
            spiral: match self.spiral {
                Some(SpiralName::Axisymmetric) => SpiralKind::Axisymmetric,
                Some(SpiralName::Alternating) => SpiralKind::Alternating,
                Some(SpiralName::Helical) | None => SpiralKind::Helical,
            },
            spiral_start: match &self.spiral_start_deg {
                Some(start) => spiral_start::si(start, segments)?,
                None => SpiralStart::Same(0.0),
            },
            helix,
            ring,
            lists,
            ring_directions,
            backbone: self.backbone.map(|entries| entries.si("design.backbone")).transpose()?,
        })
    }

    /// A composite as in Table 1 by default, or a bulk material when its modulus or remanence is given directly.
    fn cylinder_material(&self) -> Result<CylinderMaterial, Error> {
        let table_1 = Helix::paper();
        let poisson = self.poisson.unwrap_or(table_1.poisson);
        if self.elastic_modulus_mpa.is_none() && self.remanence_t.is_none() {
            return Ok(CylinderMaterial::Composite {
                shore_a: self.shore_a.unwrap_or(table_1.shore_a),
                poisson,
                volume_fraction: self.volume_fraction.unwrap_or(table_1.volume_fraction),
                particle_remanence: self.particle_remanence_t.unwrap_or(table_1.particle_remanence),
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

    /// Keys that a plain rod has alone.
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

    /// Keys of a device made of sections.
    pub(super) const OF_SECTIONS: [DesignKey; 2] =
        [("section", |design| !design.section.is_empty()), ("group", |design| !design.group.is_empty())];

    /// Keys of a rod of rubber with particles, which have no meaning where modulus and remanence are given.
    pub(super) const OF_COMPOSITE: [DesignKey; 3] = [
        ("shore_a", |design| design.shore_a.is_some()),
        ("volume_fraction", |design| design.volume_fraction.is_some()),
        ("particle_remanence_t", |design| design.particle_remanence_t.is_some()),
    ];

    fn refuse_keys_of_other_kind(&self) -> Result<(), Error> {
        let of_segments = "belongs to kind = \"segments\"";
        let of_sections = "belongs to kind = \"sections\"";
        match self.kind {
            DesignKind::Segments => {
                self.refuse(
                    &Self::OF_CYLINDER,
                    "belongs to kind = \"cylinder\"; the segments' dimensions are in design.helix and design.ring",
                )?;
                self.refuse(&Self::OF_SECTIONS, of_sections)
            }
            DesignKind::Cylinder => {
                self.refuse(&Self::OF_SEGMENTS, of_segments)?;
                self.refuse(&Self::OF_SECTIONS, of_sections)
            }
            DesignKind::Sections => {
                self.refuse(&Self::OF_SEGMENTS, of_segments)?;
                self.refuse(
                    &Self::OF_CYLINDER,
                    "belongs to kind = \"cylinder\"; what a section is made of is in its table [[design.section]]",
                )
            }
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

fn required(key: &str, value: Option<f64>) -> Result<f64, Error> {
    value.ok_or_else(|| Error::Unsupported(format!("{key} is missing")))
}
