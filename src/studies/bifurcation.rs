//! Bifurcation diagrams: stable and unstable branches, their folds, and predictions of snaps.

mod branches;
mod case;
mod dipole;
mod spacing;

use nalgebra::Vector3;
use rayon::prelude::*;

use self::branches::Branches;
use self::case::{Case, turned};
use super::experiment::{SEGMENTS, magnet_pair};
use super::progress::Progress;
use super::study::Study;
use crate::design::{Design, Specification};
use crate::equilibrium::{Equilibrium, Inputs, Interaction, PlacedSource, Settings, Shape};
use crate::error::Error;
use crate::geometry::Pose;
use crate::numerics::continuation::PointKind;

/// Distances before a snap at which it is predicted, relative to the length of the path up to the snap.
pub const DISTANCES: [f64; 6] = [0.2, 0.1, 0.05, 0.02, 0.01, 0.001];

/// Maximum number of points of a branch.
const POINTS: usize = 300;

/// Maximum number of points of a branch of three segments, whose rings touch some points later.
const POINTS_OF_THREE: usize = 45;

/// Bifurcation diagrams and their tables.
#[derive(Debug, Clone, PartialEq)]
pub struct Bifurcation {
    /// The diagrams.
    pub study: Study,
    /// Their folds and branching points.
    pub places: Vec<Place>,
    /// Predictions of the snaps under quasi-static loading.
    pub predictions: Vec<Prediction>,
}

/// A fold or branching point.
#[derive(Debug, Clone, PartialEq)]
pub struct Place {
    /// Description, with the unit of the values.
    pub what: String,
    /// Value found by continuation.
    pub continuation: f64,
    /// Value at which quasi-static loading snaps, if it does: the middle of an interval of 1e-5 of the path.
    pub bisection: Option<f64>,
    /// Value in closed form, if known.
    pub closed_form: Option<f64>,
}

/// Predictions of a snap under quasi-static loading.
#[derive(Debug, Clone, PartialEq)]
pub struct Prediction {
    /// Description of the snap.
    pub what: String,
    /// Errors of the predictions at [`DISTANCES`], relative to the distance, positive if too early; `None` where there
    /// is no prediction.
    pub errors: Vec<Option<f64>>,
}

/// One diagram with its folds and predictions.
struct Found {
    branches: Branches,
    places: Vec<Place>,
    predictions: Vec<Prediction>,
}

/// Bifurcation diagrams for a turning field, growing fields, an approaching magnet and smaller gaps between the rings:
/// branches with folds, quasi-static loading with its snaps, and predictions of these.
///
/// # Errors
/// None for the paper's designs; those of the solves are passed on.
pub fn bifurcation(progress: &dyn Progress) -> Result<Bifurcation, Error> {
    type Diagram = fn(&dyn Progress) -> Result<Found, Error>;
    let diagrams: [Diagram; 6] = [
        |_| turning(),
        |_| growing(),
        |_| nearing(),
        |_| pulling(),
        |_| spacing::branches(),
        spacing::critical,
    ];

    progress.more(diagrams.len());
    let found = diagrams.into_par_iter().map(|diagram| {
        let found = diagram(progress);
        progress.done();
        found
    });

    let found = found.collect::<Result<Vec<_>, Error>>()?;
    let rows = found.iter().map(|diagram| diagram.branches.rows()).max().unwrap_or(0);
    let (mut columns, mut marks) = (Vec::new(), Vec::new());
    let (mut places, mut predictions) = (Vec::new(), Vec::new());

    for diagram in found {
        diagram.branches.finish(rows, &mut columns, &mut marks);
        places.extend(diagram.places);
        predictions.extend(diagram.predictions);
    }
    Ok(Bifurcation { study: Study { columns, marks, comparison: Vec::new() }, places, predictions })
}

/// One core with a dipole at its tip in a field that turns.
fn turning() -> Result<Found, Error> {
    let case = dipole::turning()?;
    let mut found = Found::new("turning", ["deg", "deg"], 1);
    let (diagram, loading) = (case.trace(case.path[0])?, case.load(true)?);
    found.branches.add(0, &case, &diagram);
    found.branches.add_loading(&loading);
    let plane = dipole::fold_of_turning();
    for shape in diagram.shapes.iter().filter(|shape| shape.kind != PointKind::Regular) {
        let (what, closed_form, snap) = match (shape.kind, shape.tip.axis().y > 0.0) {
            (PointKind::Fold, true) => ("dipole turned: folds in the plane (deg)", plane, None),
            (PointKind::Fold, false) => ("dipole turned: the far side folds (deg)", 360.0 - plane, None),
            (_, true) => ("dipole turned: swings out of the plane (deg)", 180.0, Some(0)),
            (_, false) => ("dipole turned back: swings out (deg)", 180.0, Some(1)),
        };
        let bisection = snap.and_then(|snap: usize| loading.snaps.get(snap).copied());
        found.add(what, shape, bisection, Some(closed_form));
        if let Some(snap) = snap {
            found.predict(&case, what, shape, snap == 0)?;
        }
    }
    Ok(found)
}

/// Branches in a growing field, antiparallel and one degree off.
fn growing() -> Result<Found, Error> {
    let (straight, aside) = (dipole::growing(180.0)?, dipole::growing(dipole::ASIDE)?);
    let mut found = Found::new("growing", ["mt", "deg"], 2);
    let (perfect, near) = (straight.trace(0.0)?, aside.trace(0.0)?);
    // The shape bent to the other side is close to the one in the mirrored field.
    let mirrored = dipole::growing(360.0 - dipole::ASIDE)?;
    let mut model = Equilibrium::new(&mirrored.design, None, mirrored.settings, 2)?;
    let largest = mirrored.path[1];
    model.solve(&(mirrored.way)(largest))?;
    let far = aside.trace_from(&model, largest)?;
    for (branch, case, diagram) in [(0, &straight, &perfect), (1, &aside, &near), (1, &aside, &far)] {
        found.branches.add(branch, case, diagram);
    }
    found.branches.add_loading(&aside.load(false)?);
    let critical = dipole::critical_field()?;
    for shape in perfect.shapes.iter().filter(|shape| shape.kind != PointKind::Regular) {
        found.add("dipole, antiparallel: buckles (mT)", shape, None, Some(critical));
    }
    let least = dipole::fold_aside()?;
    for shape in far.folds() {
        found.add("dipole, 1 deg aside: the far side folds (mT)", shape, None, Some(least));
    }
    Ok(found)
}

/// Nine segments and the magnet pair, magnetised along them, which approaches their base from the side and retreats.
fn nearing() -> Result<Found, Error> {
    let design = Design::new(Specification::paper(SEGMENTS))?;
    let rings = design.rings().count();

    let way = move |millimetres: f64| Inputs {
        sources: vec![PlacedSource {
            pose: Pose { position: Vector3::new(0.0, -1e-3 * millimetres, 0.0), ..Pose::identity() },
            strength: 1.0,
        }],
        ..Inputs::unloaded(rings)
    };

    let case = Case {
        design,
        magnet: Some(magnet_pair()?),
        settings: Settings { interaction: Interaction::Rings, ..Settings::default() },
        way: Box::new(way),
        path: [300.0, 140.0],
        angle: turned,
        points: POINTS,
    };

    let mut found = Found::new("nearing", ["mm", "deg"], 1);
    let loading = case.load(true)?;
    found.branches.add_loading(&loading);

    for (number, what) in
        ["nine segments: snap as the magnet comes (mm)", "nine segments: snap as it goes (mm)"]
            .into_iter()
            .enumerate()
    {
        let diagram = case.trace(case.path[number])?;
        found.branches.add(0, &case, &diagram);
        if let Some(shape) = diagram.folds().next() {
            found.add(what, shape, loading.snaps.get(number).copied(), None);
            found.predict(&case, what, shape, number == 0)?;
        }
    }
    Ok(found)
}

/// One and three segments whose rings snap together in a growing transverse field.
fn pulling() -> Result<Found, Error> {
    let mut found = Found::new("pulling", ["mt", "deg"], 2);
    for (branch, segments, points, what) in [
        (0, 1, POINTS, "one segment, `full`: pulled shut (mT)"),
        (1, 3, POINTS_OF_THREE, "three segments, `full`: pulled shut (mT)"),
    ] {
        let case = pulled(Specification::paper(segments), [0.0, 40.0], points)?;
        let (diagram, loading) = (case.trace(0.0)?, case.load(false)?);
        found.branches.add(branch, &case, &diagram);
        found.branches.add_loading(&loading);
        if let Some(shape) = diagram.folds().next() {
            found.add(what, shape, loading.snaps.first().copied(), None);
            found.predict(&case, what, shape, true)?;
        }
    }
    Ok(found)
}

/// A device at the level `full` in a transverse field; the path parameter is its strength, mT.
fn pulled(specification: Specification, path: [f64; 2], points: usize) -> Result<Case, Error> {
    let design = Design::new(specification)?;
    let rings = design.rings().count();
    let way = move |millitesla: f64| Inputs {
        uniform_field: Vector3::new(0.0, 1e-3 * millitesla, 0.0),
        ..Inputs::unloaded(rings)
    };
    let settings = Settings { interaction: Interaction::Full, ..Settings::default() };
    Ok(Case { design, magnet: None, settings, way: Box::new(way), path, angle: turned, points })
}

impl Found {
    fn new(name: &'static str, units: [&'static str; 2], branches: usize) -> Self {
        Self { branches: Branches::new(name, units, branches), places: Vec::new(), predictions: Vec::new() }
    }

    /// Adds the fold or branching point that continuation has found at `shape`.
    fn add(&mut self, what: &str, shape: &Shape, bisection: Option<f64>, closed_form: Option<f64>) {
        self.places.push(Place { what: what.into(), continuation: shape.value, bisection, closed_form });
    }

    /// Adds predictions of the snap at `shape`, on the path (`forth`) or on the way back.
    fn predict(&mut self, case: &Case, what: &str, shape: &Shape, forth: bool) -> Result<(), Error> {
        let errors = case.predict(shape.value, forth, &DISTANCES)?;
        self.predictions.push(Prediction { what: what.into(), errors });
        Ok(())
    }
}
