//! Time saved and error caused by each simplification alone, relative to the level `rings` with default settings.

use serde::Serialize;

use super::fidelity::{SCENES, Walk};
use super::progress::Progress;
use crate::design::{Specification, SpiralKind};
use crate::equilibrium::{Interaction, Settings};
use crate::error::Error;
use crate::magnetics::{AxialMagnet, Cylinders, FieldSource, Source, Sources};
use crate::manipulator::Scene;
use crate::methods::Method;

/// Radius of a cylinder that represents a dipole, m. Its length is chosen such that its next multipole vanishes; its
/// field 10 cm away is that of a dipole to 1e-5.
const SMALL: f64 = 4e-3;

/// Time and error of one simplification along one path.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Omission {
    /// The scene.
    pub scene: &'static str,
    /// What is left out.
    pub what: &'static str,
    /// Mean time of a step, microseconds.
    pub time_us: f64,
    /// Mean time of a step, relative to the level without simplification.
    pub time_relative: f64,
    /// Largest error of the tip's position over the length, against the level without simplification.
    pub tip_over_length: f64,
    /// Largest error of the tip's angle, deg.
    pub angle_deg: f64,
}

/// What is left out, and the function that applies it to a scene.
type Simplification = (&'static str, fn(&mut Scene) -> Result<(), Error>);

/// All simplifications; the first leaves out nothing and is the reference.
const SIMPLIFICATIONS: [Simplification; 7] = [
    ("nothing", |_| Ok(())),
    ("strains that vary along a core (degree 0)", |scene| {
        scene.settings.degree = 0;
        Ok(())
    }),
    ("all but one quadrature node of a ring", |scene| {
        scene.settings.pair_accuracy = 9e-2;
        Ok(())
    }),
    ("the turning of the spiral (spread evenly)", |scene| {
        if let Specification::Segmented(chain) = &mut scene.specification {
            chain.spiral = SpiralKind::Axisymmetric;
        }
        Ok(())
    }),
    ("the extent of the magnets (a dipole)", |scene| {
        let dipoles = scene.sources.list().iter().map(dipole).collect::<Result<_, Error>>()?;
        scene.sources = Sources::new(dipoles)?;
        Ok(())
    }),
    ("everything out of the plane (method `planar`)", |scene| {
        scene.method = Method::Planar.name().into();
        Ok(())
    }),
    ("all strain except one curvature per core (method `constant-curvature`)", |scene| {
        scene.method = Method::ConstantCurvature.name().into();
        Ok(())
    }),
];

/// Every simplification along the paths of [`super::fidelity()`].
///
/// # Errors
/// None for these scenes; those of the solves are passed on.
pub fn omissions(progress: &dyn Progress) -> Result<Vec<Omission>, Error> {
    progress.more(SCENES.len() * SIMPLIFICATIONS.len());
    let mut out = Vec::new();

    for (name, segments, field) in SCENES {
        let mut exact = Scene::parse(&format!("{field}\n[design]\nsegments = {segments}"), name)?;
        exact.settings = Settings { interaction: Interaction::Rings, ..exact.settings.as_discretised() };

        let mut scenes = Vec::new();
        for (_, simplify) in SIMPLIFICATIONS {
            let mut scene = exact.clone();
            simplify(&mut scene)?;
            scenes.push(scene);
        }

        let shown = Walk::new(name, &exact)?.follow(&scenes, &exact, progress)?;
        let whole = shown.first().map_or(f64::NAN, |shown| shown.time);
        out.extend(SIMPLIFICATIONS.iter().zip(shown).map(|(&(what, _), shown)| Omission {
            scene: name,
            what,
            time_us: 1e6 * shown.time,
            time_relative: shown.time / whole,
            tip_over_length: shown.tip,
            angle_deg: shown.angle.to_degrees(),
        }));
    }
    Ok(out)
}

/// A cylinder with the moment of a magnet, so small that its field is that of a dipole.
fn dipole(magnet: &Source) -> Result<Source, Error> {
    let moment = magnet.moment().z;
    let unit = AxialMagnet {
        radius: SMALL,
        inner_radius: 0.0,
        length: 3.0_f64.sqrt() * SMALL,
        offset: 0.0,
        remanence: 1.0,
    };
    let remanence = moment / Cylinders::new(vec![unit])?.moment().z;
    Ok(Cylinders::new(vec![AxialMagnet { remanence, ..unit }])?.into())
}
