//! The way on which a device comes to its first inputs: where several equilibria exist there, it decides which one is found.

use std::collections::BTreeMap;

use super::Inputs;
use crate::equilibrium::PlacedSource;
use crate::error::{Error, Interval};
use crate::geometry::Pose;

/// A row of inputs by their names in the FMU, in SI units.
pub type WayRow = BTreeMap<String, f64>;

/// Norms of orientations that are normalised, as the FMU does.
const NORMALISED: Interval = Interval::at_least(0.5).at_most(2.0);

/// Similarity (1: equal) from which another name is suggested as a correction.
const PLAUSIBLE: f64 = 0.5;

/// Rows of inputs that are solved one after the other, the first from the unloaded shape, before the device's own first inputs.
///
/// A row names the inputs that differ from the device's own, as the FMU does and in SI units: `magnet.position[3]`, `field.uniform[2]`.
///
/// ```
/// use mcm::manipulator::Scene;
/// let text = "[design]\nsegments = 1\n[[start.way]]\n\"field.uniform[2]\" = 0.01";
/// assert_eq!(Scene::parse(text, "example")?.way.rows().len(), 1);
/// let refused = Scene::parse(&text.replace("uniform", "unifrom"), "example").unwrap_err();
/// assert!(refused.to_string().contains("did you mean `field.uniform[2]`?"));
/// # Ok::<(), mcm::error::Error>(())
/// ```
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Way {
    rows: Vec<WayRow>,
    /// Number of coils, which stand behind all magnets among the sources.
    coils: usize,
}

impl Way {
    /// Most rows: each costs a solve before the first answer.
    pub const MOST: usize = 200;

    /// The way of these rows for a device that has these parts, and these inputs of its own.
    ///
    /// # Errors
    /// [`Error::Count`] for too many rows; [`Error::Unsupported`] for a name that is no input of the device, with the row's number, and for
    /// an orientation of which only some components are named; [`Error::Range`] for a number that is not finite or no orientation.
    pub(super) fn new(rows: &[WayRow], counts: Counts, own: &Inputs) -> Result<Self, Error> {
        let coils = counts.coils;
        if rows.is_empty() {
            return Ok(Self { rows: Vec::new(), coils }); // most scenes: the names cost more than the rest of the scene
        }
        let names = counts.names();
        if rows.len() > Self::MOST {
            let expected = format!("at most {}", Self::MOST);
            return Err(Error::Count { quantity: "start.way".into(), given: rows.len(), expected });
        }
        for (number, row) in (1..).zip(rows) {
            if let Some(name) = row.keys().find(|name| !names.contains(name)) {
                return Err(Error::Unsupported(format!(
                    "start.way[{number}]: `{name}` is no input of this device{}",
                    nearest(name, &names)
                )));
            }
        }
        let way = Self { rows: rows.to_vec(), coils };
        way.points(own)?;
        Ok(way)
    }

    /// Its rows.
    #[must_use]
    pub fn rows(&self) -> &[WayRow] {
        &self.rows
    }

    /// Whether it has no rows: the device's own inputs are solved from the unloaded shape.
    #[must_use]
    pub fn is_empty(&self) -> bool {
        self.rows.is_empty()
    }

    /// The inputs of each row; those that it does not name are as in `own`.
    ///
    /// # Errors
    /// As [`Scene::parse`](super::Scene::parse).
    pub fn points(&self, own: &Inputs) -> Result<Vec<Inputs>, Error> {
        let point = |(number, row): (usize, &WayRow)| {
            let mut draft = Draft::of(own);
            for (name, value) in row {
                let slot = draft.slot(name, self.coils);
                let refused = || {
                    Error::Unsupported(format!("start.way[{number}]: `{name}` is no input of this device"))
                };
                *slot.ok_or_else(refused)? = Interval::FINITE.check(name, *value)?;
                whole_orientation(number, name, row)?;
            }
            draft.inputs(own)
        };
        (1..).zip(&self.rows).map(point).collect()
    }
}

/// # Errors
/// [`Error::Unsupported`] for a component of an orientation that stands without the other three.
fn whole_orientation(number: usize, name: &str, row: &WayRow) -> Result<(), Error> {
    let Some((stem, _)) = name.split_once(".orientation[") else { return Ok(()) };
    let whole = (1..=4).all(|k| row.contains_key(&format!("{stem}.orientation[{k}]")));
    if whole {
        return Ok(());
    }
    Err(Error::Unsupported(format!("start.way[{number}]: {stem}.orientation needs all four components")))
}

/// The name that was probably meant, in words; empty if none is similar.
fn nearest(name: &str, names: &[String]) -> String {
    let similarity = |known: &str| strsim::normalized_damerau_levenshtein(name, known);
    let found = names.iter().max_by(|a, b| similarity(a).total_cmp(&similarity(b)));
    let found = found.filter(|known| similarity(known) >= PLAUSIBLE);
    found.map_or_else(String::new, |known| format!("; did you mean `{known}`?"))
}

/// A pose of which single components are set.
struct DraftPose {
    position: [f64; 3],
    orientation: [f64; 4],
}

impl DraftPose {
    fn of(pose: &Pose) -> Self {
        Self { position: pose.position.into(), orientation: pose.quaternion() }
    }

    fn slot(&mut self, part: &str, component: usize) -> Option<&mut f64> {
        match part {
            "position" => self.position.get_mut(component),
            "orientation" => self.orientation.get_mut(component),
            _ => None,
        }
    }

    /// The pose, or the present one to the last bit where nothing has turned or moved it.
    fn pose(self, own: &Pose) -> Result<Pose, Error> {
        let Self { position, orientation } = self;
        if orientation.map(f64::to_bits) == own.quaternion().map(f64::to_bits) {
            return Ok(Pose { position: position.into(), rotation: own.rotation });
        }
        let norm = orientation.iter().map(|component| component * component).sum::<f64>().sqrt();
        NORMALISED.check("norm of an orientation of start.way", norm)?;
        Pose::new(position, orientation.map(|component| component / norm))
    }
}

/// Inputs of which single numbers are set by their names.
struct Draft {
    base: DraftPose,
    sources: Vec<(DraftPose, f64)>,
    /// The external magnet of a device that has none: it is an input of the FMU.
    absent: (DraftPose, f64),
    inputs: Inputs,
    /// The push on a shaft whose length is given instead.
    idle: f64,
}

impl Draft {
    fn of(own: &Inputs) -> Self {
        let sources = own.sources.iter().map(|source| (DraftPose::of(&source.pose), source.strength));
        Self {
            base: DraftPose::of(&own.base),
            sources: sources.collect(),
            absent: (DraftPose::of(&Pose::identity()), 0.0),
            inputs: own.clone(),
            idle: 0.0,
        }
    }

    /// The place of the number with this name.
    fn slot(&mut self, name: &str, coils: usize) -> Option<&mut f64> {
        let (stem, component) = indexed(name);
        let (body, part) = stem.split_once('.')?;
        let (kind, number) = indexed(body);
        match kind {
            "magnet" | "coil" => {
                let (pose, strength) = self.source(kind, number, coils)?;
                match part {
                    "strength" | "current" => Some(strength),
                    _ => pose.slot(part, component?),
                }
            }
            "base" => self.base.slot(part, component?),
            "ring" if part == "load_force" => self.inputs.ring_forces.get_mut(number?)?.get_mut(component?),
            _ => self.load(stem, component),
        }
    }

    /// The place of a number of the field, the feed or the tip's loads.
    fn load(&mut self, stem: &str, component: Option<usize>) -> Option<&mut f64> {
        let inputs = &mut self.inputs;
        match stem {
            "feed.insertion" => Some(&mut inputs.insertion),
            "feed.roll" => Some(&mut inputs.roll),
            "feed.force" => Some(inputs.feed_force.as_mut().unwrap_or(&mut self.idle)),
            "guidewire.insertion" => Some(&mut inputs.guidewire_insertion),
            "field.uniform" => inputs.uniform_field.get_mut(component?),
            "field.gradient" => inputs.field_gradient.get_mut(component?),
            "tip.load_force" => inputs.tip_force.get_mut(component?),
            "tip.load_moment" => inputs.tip_moment.get_mut(component?),
            _ => None,
        }
    }

    /// The source of this kind and number; the first magnet has no number, and coils stand behind all magnets.
    fn source(&mut self, kind: &str, number: Option<usize>, coils: usize) -> Option<&mut (DraftPose, f64)> {
        let magnets = self.sources.len().checked_sub(coils)?;
        match (kind, number) {
            ("coil", number) => self.sources.get_mut(magnets + number?),
            (_, None) if magnets == 0 => Some(&mut self.absent),
            (_, number) => self.sources[..magnets].get_mut(number.unwrap_or(0)),
        }
    }

    fn inputs(self, own: &Inputs) -> Result<Inputs, Error> {
        let sources = self
            .sources
            .into_iter()
            .zip(&own.sources)
            .map(|((pose, strength), own)| Ok(PlacedSource { pose: pose.pose(&own.pose)?, strength }));
        Ok(Inputs {
            base: self.base.pose(&own.base)?,
            sources: sources.collect::<Result<_, Error>>()?,
            ..self.inputs
        })
    }
}

/// A name without the index at its end, and that index counted from 0.
fn indexed(name: &str) -> (&str, Option<usize>) {
    let split = name.strip_suffix(']').and_then(|rest| rest.rsplit_once('['));
    let found = split.and_then(|(stem, digits)| Some((stem, digits.parse::<usize>().ok()?.checked_sub(1)?)));
    found.map_or((name, None), |(stem, index)| (stem, Some(index)))
}

/// What of a device has inputs of its own.
#[derive(Debug, Clone, Copy)]
pub(super) struct Counts {
    pub(super) rings: usize,
    pub(super) magnets: usize,
    pub(super) coils: usize,
    pub(super) shaft: bool,
    pub(super) guidewire: bool,
}

impl Counts {
    /// The names of all inputs.
    fn names(self) -> Vec<String> {
        let mut names = Vec::new();
        let mut add = |stem: &str, count: usize| match count {
            0 => names.push(stem.to_owned()),
            _ => names.extend((1..=count).map(|k| format!("{stem}[{k}]"))),
        };

        let magnets = (2..=self.magnets).map(|k| (format!("magnet[{k}]"), "strength"));
        let coils = (1..=self.coils).map(|k| (format!("coil[{k}]"), "current"));
        for (source, strength) in [("magnet".to_owned(), "strength")].into_iter().chain(magnets).chain(coils)
        {
            add(&format!("{source}.position"), 3);
            add(&format!("{source}.orientation"), 4);
            add(&format!("{source}.{strength}"), 0);
        }

        for (stem, count) in [
            ("field.uniform", 3),
            ("field.gradient", 5),
            ("base.position", 3),
            ("base.orientation", 4),
            ("tip.load_force", 3),
            ("tip.load_moment", 3),
        ] {
            add(stem, count);
        }
        (1..=self.rings).for_each(|k| add(&format!("ring[{k}].load_force"), 3));

        let optional = [
            ("feed.insertion", self.shaft),
            ("feed.roll", self.shaft),
            ("feed.force", self.shaft),
            ("guidewire.insertion", self.guidewire),
        ];
        optional.into_iter().filter(|(_, there)| *there).for_each(|(name, _)| add(name, 0));
        names
    }
}
