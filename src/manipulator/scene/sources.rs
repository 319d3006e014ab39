//! Tables `[magnet]` or `[[magnet]]`, and `[[coil]]`.

use core::fmt;

use serde::de::value::MapAccessDeserializer;
use serde::de::{MapAccess, SeqAccess, Visitor};
use serde::{Deserialize, Deserializer, Serialize, Serializer};

use super::SceneFile;
use super::magnet_shape;
use super::mesh::unplaced;
use super::pose::{TURN_AXIS, in_metres, pose, turn, turned};
use super::units::MM_PER_M;
use crate::equilibrium::PlacedSource;
use crate::error::Error;
use crate::magnetics::{
    AxialMagnet, Coil, Cylinders, MultipoleCoil, MultipoleTable, ShapedMagnet, Solenoid, Source,
};

/// The magnets of a scene: none, one table `[magnet]`, or several `[[magnet]]`.
#[derive(Debug, Clone, PartialEq, Default)]
pub(super) struct Magnets(pub(super) Vec<MagnetEntries>);

impl Magnets {
    pub(super) fn are_none(&self) -> bool {
        self.0.is_empty()
    }

    /// The key of a magnet's table, counted from 0.
    pub(super) fn key(&self, number: usize) -> String {
        if self.0.len() > 1 { format!("magnet[{}]", number + 1) } else { "magnet".into() }
    }
}

impl Serialize for Magnets {
    fn serialize<S: Serializer>(&self, out: S) -> Result<S::Ok, S::Error> {
        match &self.0[..] {
            [only] => only.serialize(out),
            several => several.serialize(out),
        }
    }
}

impl<'de> Deserialize<'de> for Magnets {
    fn deserialize<D: Deserializer<'de>>(input: D) -> Result<Self, D::Error> {
        input.deserialize_any(TableOrTables)
    }
}

/// Reads either form; a derived untagged enum would not say what is expected, nor where.
struct TableOrTables;

impl<'de> Visitor<'de> for TableOrTables {
    type Value = Magnets;

    fn expecting(&self, out: &mut fmt::Formatter<'_>) -> fmt::Result {
        out.write_str("a table [magnet], or several [[magnet]]")
    }

    fn visit_map<A: MapAccess<'de>>(self, table: A) -> Result<Magnets, A::Error> {
        Ok(Magnets(vec![MagnetEntries::deserialize(MapAccessDeserializer::new(table))?]))
    }

    fn visit_seq<A: SeqAccess<'de>>(self, mut tables: A) -> Result<Magnets, A::Error> {
        let mut magnets = Vec::new();
        while let Some(magnet) = tables.next_element()? {
            magnets.push(magnet);
        }
        Ok(Magnets(magnets))
    }
}

#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[cfg_attr(test, derive(schemars::JsonSchema))]
#[serde(deny_unknown_fields, default)]
pub(super) struct MagnetEntries {
    /// Position of its centre; left out: 120 mm below the middle of the device.
    ///
    /// Only the first magnet may leave it out.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(super) position_mm: Option<[f64; 3]>,
    /// Unit quaternion, scalar first, from its frame to the world's.
    pub(super) orientation_wxyz: [f64; 4],
    /// Right-handed turn of the magnet about `turn_axis` through its centre.
    pub(super) turn_deg: f64,
    /// Axis of that turn in the world frame; the default takes +z towards +y.
    ///
    /// It may have any length but 0.
    pub(super) turn_axis: [f64; 3],
    /// Factor on its field; 0 switches it off.
    pub(super) strength: f64,
    /// A cylinder or ring of the magnet, magnetised along the common axis. One table for each.
    ///
    /// They must not overlap. Left out without `shape`: the pair of the paper.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(super) cylinders: Option<Vec<MagnetCylinder>>,
    /// Shape of a magnet in one piece, magnetised in any direction; it takes the place of `cylinders`.
    #[serde(skip_serializing_if = "Option::is_none", deserialize_with = "magnet_shape::read")]
    #[cfg_attr(test, schemars(schema_with = "magnet_shape::names"))]
    pub(super) shape: Option<String>,
    /// Edges of a cuboid along the axes of its frame.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(super) size_mm: Option<[f64; 3]>,
    /// Radius of a sphere, outer radius of a cylinder.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(super) radius_mm: Option<f64>,
    /// Inner radius of a ring; left out: 0, a solid cylinder.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(super) inner_radius_mm: Option<f64>,
    /// Length of a cylinder along its axis.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(super) length_mm: Option<f64>,
    /// Direction of magnetisation in the magnet's frame, a unit vector; left out: its z.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(super) direction: Option<[f64; 3]>,
    /// Remanence along that direction; negative: against it.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(super) remanence_t: Option<f64>,
    /// Grade of sintered `NdFeB` instead of `remanence_t`: the middle of its range, four standard deviations wide.
    #[serde(skip_serializing_if = "Option::is_none")]
    #[cfg_attr(test, schemars(schema_with = "magnet_shape::grades"))]
    pub(super) grade: Option<String>,
}

impl Default for MagnetEntries {
    /// Below the manipulator's middle its field is parallel to the manipulator's magnetisation.
    fn default() -> Self {
        Self {
            position_mm: None,
            orientation_wxyz: [0.0, 1.0, 0.0, 0.0],
            turn_deg: 0.0,
            turn_axis: TURN_AXIS,
            strength: 1.0,
            cylinders: None,
            shape: None,
            size_mm: None,
            radius_mm: None,
            inner_radius_mm: None,
            length_mm: None,
            direction: None,
            remanence_t: None,
            grade: None,
        }
    }
}

#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
#[cfg_attr(test, derive(schemars::JsonSchema))]
#[serde(deny_unknown_fields)]
pub(super) struct MagnetCylinder {
    /// Outer radius.
    pub(super) radius_mm: f64,
    /// Inner radius of a ring; 0: a solid cylinder.
    #[serde(default)]
    pub(super) inner_radius_mm: f64,
    /// Length along the axis.
    pub(super) length_mm: f64,
    /// Position of its centre along the axis.
    #[serde(default)]
    pub(super) offset_mm: f64,
    /// Remanence along the axis; negative: against it.
    pub(super) remanence_t: f64,
}

impl MagnetCylinder {
    /// The paper's pair.
    pub(super) fn pair() -> Vec<Self> {
        let cylinder = |offset_mm| Self {
            radius_mm: 22.5,
            inner_radius_mm: 0.0,
            length_mm: 30.0,
            offset_mm,
            remanence_t: 1.35,
        };
        vec![cylinder(-20.0), cylinder(20.0)]
    }

    pub(super) fn si(&self) -> AxialMagnet {
        AxialMagnet {
            radius: self.radius_mm / MM_PER_M,
            inner_radius: self.inner_radius_mm / MM_PER_M,
            length: self.length_mm / MM_PER_M,
            offset: self.offset_mm / MM_PER_M,
            remanence: self.remanence_t,
        }
    }
}

/// Table `[[coil]]`.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[cfg_attr(test, derive(schemars::JsonSchema))]
#[serde(deny_unknown_fields)]
pub(super) struct CoilEntries {
    /// Position of its centre.
    #[serde(default)]
    pub(super) position_mm: [f64; 3],
    /// Unit quaternion, scalar first, from its frame to the world's.
    #[serde(default = "upright")]
    pub(super) orientation_wxyz: [f64; 4],
    /// Inner radius of the winding.
    pub(super) inner_radius_mm: f64,
    /// Outer radius of the winding.
    pub(super) outer_radius_mm: f64,
    /// Length of the winding along its axis.
    pub(super) length_mm: f64,
    /// Number of turns.
    pub(super) turns: f64,
    /// Current through every turn; positive: the field in the bore is along +z.
    #[serde(default)]
    pub(super) current_a: f64,
    /// For an iron core: CSV file with the columns `degree` and `t_m_per_a`; its path is relative to the scene.
    ///
    /// It takes the place of `multipoles`. The field is then that of the multipoles alone.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub(super) multipoles_csv: Option<String>,
    /// For an iron core: axial multipoles of one ampere, T m^(degree + 2) / A, from degree 1 on.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub(super) multipoles: Option<Vec<f64>>,
    /// Radius of the sphere outside which the multipoles hold; left out: about the winding.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub(super) reach_mm: Option<f64>,
}

fn upright() -> [f64; 4] {
    [1.0, 0.0, 0.0, 0.0]
}

impl CoilEntries {
    /// The checked coil; `table` is the key of its table.
    pub(super) fn source(&self, table: &str) -> Result<Source, Error> {
        let (outer_radius, length) = (self.outer_radius_mm / MM_PER_M, self.length_mm / MM_PER_M);
        let around = outer_radius.hypot(0.5 * length);
        let multipoles = match (&self.multipoles_csv, &self.multipoles) {
            (Some(_), Some(_)) => {
                return Err(Error::Unsupported(format!(
                    "{table}.multipoles_csv has no meaning beside {table}.multipoles: give one or the other"
                )));
            }
            (Some(name), None) => return Err(unplaced(name)),
            (None, Some(multipoles)) => {
                let reach = self.reach_mm.map_or(around, |reach| reach / MM_PER_M);
                Some(MultipoleTable::new(reach, multipoles)?)
            }
            (None, None) if self.reach_mm.is_some() => {
                return Err(Error::Unsupported(format!("{table}.reach_mm needs {table}.multipoles")));
            }
            (None, None) => None,
        };

        let inner_radius = self.inner_radius_mm / MM_PER_M;
        let coil = Coil { inner_radius, outer_radius, length, turns: self.turns };
        Ok(match multipoles {
            Some(table) => MultipoleCoil::new(coil, table)?.into(),
            None => Solenoid::new(coil)?.into(),
        })
    }
}

impl MagnetEntries {
    /// The cylinders in SI units.
    fn cylinders(&self) -> Vec<AxialMagnet> {
        self.cylinders.iter().flatten().map(MagnetCylinder::si).collect()
    }

    /// The checked source; `key` is that of the table.
    fn source(&self, key: &str) -> Result<Source, Error> {
        if let Some(magnet) = self.shaped(key)? {
            return magnet.source();
        }
        let made = Cylinders::new(self.cylinders()).map_err(|error| match error {
            Error::Range { .. } => error,
            of_the_list => Error::Unsupported(format!("{key}.cylinders: {of_the_list}")),
        });
        Ok(made?.into())
    }

    /// Pose and strength; `key` is that of the table, and `place` where the magnet is unless it says so.
    pub(super) fn placed(&self, key: &str, place: Option<[f64; 3]>) -> Result<PlacedSource, Error> {
        let missing = || {
            Error::Unsupported(format!(
                "{key}.position_mm is missing: only the first magnet has a usual place"
            ))
        };
        let position = self.position_mm.map(in_metres).or(place).ok_or_else(missing)?;
        let turn = turn(key, self.turn_axis, self.turn_deg)?;
        let pose = turned(&turn, pose(key, position, self.orientation_wxyz)?);
        Ok(PlacedSource { pose, strength: self.strength })
    }
}

impl SceneFile {
    /// The checked magnets, then the coils.
    pub(super) fn sources(&self) -> Result<Vec<Source>, Error> {
        let mut out = Vec::new();
        for (number, magnet) in self.magnet.0.iter().enumerate() {
            let made = magnet.source(&self.magnet.key(number));
            out.push(made.map_err(|error| error.of_item(number + 1))?);
        }
        for (number, coil) in (1..).zip(&self.coil) {
            out.push(coil.source(&format!("coil[{number}]")).map_err(|error| error.of_item(number))?);
        }
        Ok(out)
    }

    /// The cylinders of the external magnet; none without one.
    pub(crate) fn magnet_cylinders(&self) -> Vec<AxialMagnet> {
        self.magnet.0.first().map_or_else(Vec::new, MagnetEntries::cylinders)
    }

    /// The external magnet where it is given by its shape.
    ///
    /// # Errors
    /// [`Error::Unsupported`] for keys that do not belong to the shape, or are missing.
    pub(crate) fn shaped_magnet(&self) -> Result<Option<ShapedMagnet>, Error> {
        self.magnet.0.first().map_or(Ok(None), |first| first.shaped(&self.magnet.key(0)))
    }

    /// Poses and strengths of the magnets, of which the first may leave out its place, then of the coils.
    pub(super) fn placed_sources(&self, place: [f64; 3]) -> Result<Vec<PlacedSource>, Error> {
        let magnets = self.magnet.0.iter().enumerate();
        let magnets = magnets
            .map(|(number, magnet)| magnet.placed(&self.magnet.key(number), (number == 0).then_some(place)));
        let coils = (1..).zip(&self.coil).map(|(number, coil)| {
            let table = format!("coil[{number}]");
            let pose = pose(&table, in_metres(coil.position_mm), coil.orientation_wxyz)?;
            Ok(PlacedSource { pose, strength: coil.current_a })
        });
        magnets.chain(coils).collect()
    }
}
