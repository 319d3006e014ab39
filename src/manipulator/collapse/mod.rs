//! Devices that the attraction of their own rings pulls shut, and from which number of the design on they stand.

mod bracket;
mod remedy;

use core::f64::consts::FRAC_PI_2;
use core::fmt;

pub use remedy::Remedy;

use self::remedy::{Search, at_rest};
use super::scene::{POTENTIAL, Scene, SceneFile};
use super::{Outputs, Status};
use crate::design::Specification;
use crate::equilibrium::{Body, Contact, Deadline, Interaction, Outcome};
use crate::error::Error;
use crate::geometry::Pose;

/// Largest angle between the base's axis and that of any ring or the tip at which an unloaded device stands, rad.
const UPRIGHT: f64 = FRAC_PI_2;

/// That the rings of an unloaded device pull it shut, and what lets it stand.
///
/// A sentence without a full stop, with the remedy as `KEY = VALUE` of the scene:
///
/// ```
/// use mcm::manipulator::{Collapse, SceneFile};
/// let text = "[design]\nsegments = 2\n[design.helix]\nshore_a = 3.0\n[model]\ninteraction = \"full\"\ntime_budget_s = 60.0";
/// let file = SceneFile::parse(text, "soft")?;
/// let scene = file.scene()?;
/// let outputs = scene.manipulator(2)?.solve(&scene.inputs)?.clone();
/// let shut = Collapse::of(&file, &scene, &outputs)?.expect("two soft segments close").to_string();
/// assert!(shut.contains("the rings pull this device shut (level full)"), "{shut}");
/// assert!(shut.contains("it stands from design.helix.shore_a = "), "{shut}");
/// # Ok::<(), mcm::error::Error>(())
/// ```
#[derive(Debug, Clone, PartialEq)]
pub struct Collapse {
    /// Largest angle between the base's axis and that of any ring or the tip at rest, rad; `None` where no shape was found.
    pub bend: Option<f64>,
    /// Level of interaction at which it closes: of `auto` the richest.
    pub level: Interaction,
    /// What lets it stand.
    pub remedy: Remedy,
}

impl Collapse {
    /// Why a cold solve of a scene, which ended with `outputs`, found no shape or one that is bent by more than 90 deg at rest: that
    /// the rings pull the device shut without any load. `None` where this is not so, or not known.
    ///
    /// Other shapes cost nothing. Where a loaded scene has no shape, the unloaded device is solved first. The search for a remedy ends
    /// after one more time budget of the scene, and with it the last solve that it began. Devices in a vessel, whose wall may hold
    /// them, or in whose way a magnet or coil stands, devices whose segments differ in hardness or rings in remanence, and methods other than the potential method are not judged.
    ///
    /// # Errors
    /// As [`Scene::manipulator`] and [`super::Manipulator::solve`].
    pub fn of(file: &SceneFile, scene: &Scene, outputs: &Outputs) -> Result<Option<Self>, Error> {
        let level = richest(scene.settings.interaction);
        let judged =
            scene.method == POTENTIAL && scene.vessel.is_none() && remedy::has_keys(&scene.specification);
        if !judged || !rings_attract(&scene.specification, level) {
            return Ok(None);
        }

        let loaded = scene.inputs != scene.inputs.without_loads();
        let late = matches!(outputs.outcome, Outcome::OutOfBudget(_));
        if loaded && (late || outputs.status != Status::NotSolved) || stands(scene, outputs) {
            return Ok(None); // of a loaded shape, that at rest is not known
        }

        let deadline = Deadline::new(scene.settings.time_budget);
        let mut search = Search { file, deadline: &deadline, loaded, shut: true };
        let solved;
        let rest = if loaded {
            solved = Search::solve(&at_rest(scene.clone()))?;
            &solved
        } else {
            outputs
        };
        if stands(scene, rest) || held_by_a_source(rest) {
            return Ok(None);
        }

        // Where the budget ended, the continuation tells.
        search.shut = !matches!(rest.outcome, Outcome::OutOfBudget(_));
        let remedy = search.remedy()?;
        let bend = (rest.status != Status::NotSolved).then(|| bend_of(scene, rest));
        let told = search.shut || matches!(remedy, Remedy::From { .. });
        Ok(told.then_some(Self { bend, level, remedy }))
    }
}

impl fmt::Display for Collapse {
    fn fmt(&self, out: &mut fmt::Formatter<'_>) -> fmt::Result {
        if let Some(bend) = self.bend {
            write!(out, "bent by {:.0} deg at rest: ", bend.to_degrees())?;
        }
        let level = self.level.name();
        write!(out, "unloaded, the rings pull this device shut (level {level}); {}", self.remedy)
    }
}

/// Whether rings of the device act on one another or on its helices at a level.
#[must_use]
pub fn rings_attract(specification: &Specification, level: Interaction) -> bool {
    let Specification::Segmented(chain) = specification else { return false };
    level != Interaction::None && chain.ring_magnets().any(|(ring, _)| ring.remanence != 0.0)
}

/// The level that decides whether a device stands.
fn richest(level: Interaction) -> Interaction {
    if level == Interaction::Auto { Interaction::Full } else { level }
}

/// Whether a shape was found that is bent by 90 deg at most.
fn stands(scene: &Scene, outputs: &Outputs) -> bool {
    outputs.status != Status::NotSolved && bend_of(scene, outputs) <= UPRIGHT
}

/// Whether what ends the solve is a magnet or coil in the way, whatever the rings do.
fn held_by_a_source(outputs: &Outputs) -> bool {
    matches!(outputs.outcome, Outcome::Contact(Contact { second: Body::Source(..), .. }))
}

fn bend_of(scene: &Scene, outputs: &Outputs) -> f64 {
    largest_turn(&scene.inputs.base, outputs.rings.iter().copied().chain([outputs.tip]))
}

/// Largest angle between the axis of the base and those of bodies, rad: that of the tip alone is small where a device is curled round.
fn largest_turn(base: &Pose, bodies: impl Iterator<Item = Pose>) -> f64 {
    bodies.map(|body| base.axis().angle(&body.axis())).fold(0.0, f64::max)
}
