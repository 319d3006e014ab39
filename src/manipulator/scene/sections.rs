//! Tables `[[design.section]]` and `[[design.group]]`: a device made of sections.

use serde::{Deserialize, Serialize};

use super::names::Unit;
use super::numbers::{self, Numbers};
use super::path::suggestion;
use super::ranges::REPEAT;
use super::units::PA_PER_MPA;
use crate::design::{
    MeasuredStiffness, Modulus, Section, SectionBody, SectionMagnet, Sections, quantities as of,
};
use crate::error::{Error, Quantity};

/// Poisson's ratio where none is given: that of the helices of Table 1 of Richter et al.
const POISSON: f64 = 0.4;

/// Remanence of particles where none is given, T: that of Table 1.
const PARTICLE_REMANENCE: f64 = 1.0;

#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[cfg_attr(test, derive(schemars::JsonSchema))]
#[serde(deny_unknown_fields)]
pub(super) struct SectionEntries {
    /// Name, by which a group finds it.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(super) name: Option<String>,
    /// Shape of the section.
    #[serde(default)]
    pub(super) shape: ShapeName,
    /// Length; of a ball its diameter, which may be left out.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(super) length_mm: Option<f64>,
    /// Outer radius, or `[start, end]`: a linear taper.
    #[serde(deserialize_with = "numbers::of_ends")]
    pub(super) outer_radius_mm: Numbers,
    /// Radius of the bore, or `[start, end]`; bores of balls are ignored.
    #[serde(deserialize_with = "numbers::of_ends", default = "solid")]
    pub(super) inner_radius_mm: Numbers,
    /// Whether it does not deform, as a magnet; balls never do.
    #[serde(default)]
    pub(super) rigid: bool,
    /// Shore A hardness of the rubber without particles.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(super) shore_a: Option<f64>,
    /// Young's modulus of the material as it is.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(super) elastic_modulus_mpa: Option<f64>,
    /// Poisson's ratio; left out: as of a helix.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(super) poisson: Option<f64>,
    /// Measured bending stiffness, in the place of a modulus.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(super) bending_stiffness_n_m2: Option<f64>,
    /// Measured torsional stiffness, beside that of bending.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(super) torsional_stiffness_n_m2: Option<f64>,
    /// Measured axial stiffness, beside that of bending.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(super) axial_stiffness_n: Option<f64>,
    /// Measured shear stiffness, beside that of bending; left out: no shear.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(super) shear_stiffness_n: Option<f64>,
    /// Density; left out: 1000, that of the mixture with particles, or 7000 of a rigid section.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(super) density_kg_m3: Option<f64>,
    /// Remanence; negative: reversed; left out: none.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(super) remanence_t: Option<f64>,
    /// Volume fraction of magnetic particles, in the place of a remanence.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(super) volume_fraction: Option<f64>,
    /// Remanence of these particles; left out: 1.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(super) particle_remanence_t: Option<f64>,
    /// Direction of the magnetisation at the section's start in the material frame, a unit vector.
    #[serde(default = "axial")]
    pub(super) direction: [f64; 3],
    /// Turn of that direction along the section, right-handed about the axis.
    #[serde(default)]
    pub(super) direction_turn_deg_per_mm: f64,
    /// Curvature about the first two directors and twist about the third, without loads.
    ///
    /// A positive first entry bends the tip towards -y.
    #[serde(default)]
    pub(super) rest_curvature_per_m: [f64; 3],
    /// How many of it follow one another.
    #[serde(default = "once")]
    pub(super) repeat: usize,
}

#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize)]
#[cfg_attr(test, derive(schemars::JsonSchema))]
#[serde(rename_all = "lowercase")]
pub(super) enum ShapeName {
    /// A tube or, without a bore, a rod.
    #[default]
    Tube,
    /// A rigid sphere.
    Ball,
}

#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[cfg_attr(test, derive(schemars::JsonSchema))]
#[serde(deny_unknown_fields)]
pub(super) struct GroupEntries {
    /// Names of its sections, proximal to distal.
    ///
    /// The group stands where the first of them stands in the list; sections of groups appear in these alone.
    pub(super) sections: Vec<String>,
    /// How many of it follow one another.
    #[serde(default = "once")]
    pub(super) repeat: usize,
}

fn solid() -> Numbers {
    Numbers::Same(0.0)
}

fn axial() -> [f64; 3] {
    [0.0, 0.0, 1.0]
}

fn once() -> usize {
    1
}

/// The sections of a list with groups, each with the number of its table in the list, from 1.
pub(super) fn listed(
    list: &[SectionEntries],
    groups: &[GroupEntries],
) -> Result<(Sections, Vec<usize>), Error> {
    if list.is_empty() {
        return Err(Error::Unsupported(
            "design.section is missing: kind = \"sections\" needs at least one".into(),
        ));
    }
    let order = order(list, groups)?;
    let made =
        list.iter().enumerate().map(|(index, own)| own.si(index + 1)).collect::<Result<Vec<_>, Error>>()?;
    let sections = order.iter().map(|number| made[number - 1]).collect();
    Ok((Sections { sections }, order))
}

/// Numbers of tables, from 1, in the order in which the sections follow one another.
fn order(list: &[SectionEntries], groups: &[GroupEntries]) -> Result<Vec<usize>, Error> {
    let members = (1..).zip(groups).map(|(number, group)| group.members(number, list));
    let members = members.collect::<Result<Vec<_>, Error>>()?;

    let mut out = Vec::new();
    for (index, own) in list.iter().enumerate() {
        REPEAT.check(&format!("design.section[{}].repeat", index + 1), own.repeat as f64)?;
        let of_group = members.iter().position(|members| members.iter().min() == Some(&index));
        if let Some(group) = of_group {
            for _ in 0..groups[group].repeat {
                for member in &members[group] {
                    out.extend(core::iter::repeat_n(member + 1, list[*member].repeat));
                }
            }
        } else if !members.iter().flatten().any(|member| *member == index) {
            out.extend(core::iter::repeat_n(index + 1, own.repeat));
        }
    }
    Ok(out)
}

impl GroupEntries {
    /// Indices of its sections in the list; `number` is its own, from 1.
    fn members(&self, number: usize, list: &[SectionEntries]) -> Result<Vec<usize>, Error> {
        let key = format!("design.group[{number}]");
        REPEAT.check(&format!("{key}.repeat"), self.repeat as f64)?;
        if self.sections.is_empty() {
            return Err(Error::Unsupported(format!(
                "{key}.sections is empty: a group needs at least one section"
            )));
        }
        let known: Vec<&str> = list.iter().filter_map(|own| own.name.as_deref()).collect();
        let member = |name: &String| {
            let mut found = list.iter().enumerate().filter(|(_, own)| own.name.as_ref() == Some(name));
            match (found.next(), found.next()) {
                (Some((index, _)), None) => Ok(index),
                (Some(_), Some(_)) => Err(Error::Unsupported(format!(
                    "{key}.sections: more than one section is named \"{name}\""
                ))),
                (None, _) => {
                    let near = suggestion(name, &known);
                    Err(Error::Unsupported(format!("{key}.sections: no section is named \"{name}\"{near}")))
                }
            }
        };
        self.sections.iter().map(member).collect()
    }
}

impl SectionEntries {
    /// The section of table number `number`, from 1, in SI units.
    fn si(&self, number: usize) -> Result<Section, Error> {
        let key = |name: &str| format!("design.section[{number}].{name}");
        let outer_radius = ends(&of::SECTION_OUTER, number, &self.outer_radius_mm)?;
        let body = self.body(&key)?;
        let length = match (self.length_mm, self.shape) {
            (Some(length), _) => Unit::Millimetre.in_si(length),
            (None, ShapeName::Ball) => 2.0 * outer_radius[0],
            (None, ShapeName::Tube) => {
                return Err(Error::Unsupported(format!("{} is missing", key("length_mm"))));
            }
        };
        Ok(Section {
            length,
            outer_radius,
            inner_radius: ends(&of::SECTION_INNER, number, &self.inner_radius_mm)?,
            body,
            density: self.density_kg_m3,
            magnet: self.magnet(&key)?,
            direction: self.direction,
            turn: Unit::DegreePerMillimetre.in_si(self.direction_turn_deg_per_mm),
            rest_curvature: self.rest_curvature_per_m,
        })
    }

    /// How the section deforms, from the one way in which that is stated.
    fn body(&self, key: &impl Fn(&str) -> String) -> Result<SectionBody, Error> {
        let Self { shore_a, elastic_modulus_mpa, bending_stiffness_n_m2, .. } = *self;
        let measured = [
            ("torsional_stiffness_n_m2", self.torsional_stiffness_n_m2),
            ("axial_stiffness_n", self.axial_stiffness_n),
            ("shear_stiffness_n", self.shear_stiffness_n),
        ];
        let elastic = [
            ("shore_a", shore_a),
            ("elastic_modulus_mpa", elastic_modulus_mpa),
            ("poisson", self.poisson),
            ("bending_stiffness_n_m2", bending_stiffness_n_m2),
        ];

        let refuse = |keys: &[(&str, Option<f64>)], why: &str| match keys.iter().find(|own| own.1.is_some()) {
            Some((name, _)) => Err(Error::Unsupported(format!("{} has no meaning {why}", key(name)))),
            None => Ok(()),
        };

        if self.rigid || self.shape == ShapeName::Ball {
            let why = if self.rigid { "in a rigid section" } else { "in a ball, which is rigid" };
            refuse(&elastic, why)?;
            refuse(&measured, why)?;
            return Ok(if self.shape == ShapeName::Ball { SectionBody::Ball } else { SectionBody::Rigid });
        }

        if let Some(bending) = bending_stiffness_n_m2 {
            refuse(&elastic[..3], "beside bending_stiffness_n_m2: give one or the other")?;
            let required = |(name, value): (&str, Option<f64>)| {
                value.ok_or_else(|| {
                    Error::Unsupported(format!("{} is missing beside bending_stiffness_n_m2", key(name)))
                })
            };
            let (torsion, axial) = (required(measured[0])?, required(measured[1])?);
            let stiffness = MeasuredStiffness { bending, torsion, axial, shear: self.shear_stiffness_n };
            return Ok(SectionBody::Measured(stiffness));
        }

        refuse(&measured, "without bending_stiffness_n_m2")?;
        let modulus = match (shore_a, elastic_modulus_mpa) {
            (Some(hardness), None) => Modulus::ShoreA(hardness),
            (None, Some(modulus)) => Modulus::Elastic(modulus * PA_PER_MPA),
            _ => {
                let table = key("");
                return Err(Error::Unsupported(format!(
                    "{} needs one of elastic_modulus_mpa, shore_a and bending_stiffness_n_m2, or rigid = true",
                    table.trim_end_matches('.')
                )));
            }
        };
        Ok(SectionBody::Elastic { modulus, poisson: self.poisson.unwrap_or(POISSON) })
    }

    /// The remanence, from the one way in which it is stated.
    fn magnet(&self, key: &impl Fn(&str) -> String) -> Result<SectionMagnet, Error> {
        match (self.remanence_t, self.volume_fraction, self.particle_remanence_t) {
            (remanence, None, None) => Ok(SectionMagnet::Bulk(remanence.unwrap_or(0.0))),
            (None, Some(volume_fraction), particles) => {
                let particle_remanence = particles.unwrap_or(PARTICLE_REMANENCE);
                Ok(SectionMagnet::Composite { volume_fraction, particle_remanence })
            }
            (None, None, Some(_)) => Err(Error::Unsupported(format!(
                "{} has no meaning without volume_fraction",
                key("particle_remanence_t")
            ))),
            (Some(_), ..) => Err(Error::Unsupported(format!(
                "{} has no meaning beside volume_fraction or particle_remanence_t: give one or the other",
                key("remanence_t")
            ))),
        }
    }
}

/// A radius at the start and at the end of section number `number`, m.
fn ends(quantity: &Quantity, number: usize, numbers: &Numbers) -> Result<[f64; 2], Error> {
    let si = |radius: f64| Unit::Millimetre.in_si(radius);
    match numbers.all() {
        [radius] => Ok([si(*radius); 2]),
        [start, end] => Ok([si(*start), si(*end)]),
        all => Err(Error::Count {
            quantity: quantity.key.replace('*', &number.to_string()),
            given: all.len(),
            expected: "one number, or two: at the start and at the end".into(),
        }),
    }
}
