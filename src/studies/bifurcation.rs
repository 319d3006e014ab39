//! Bifurcation diagrams: stable and unstable branches, where they fold, and how early a snap is seen coming.

mod canvas;
mod case;
mod dipole;
mod spacing;

use nalgebra::Vector3;
use rayon::prelude::*;

use self::canvas::{Canvas, Drawing};
use self::case::{Case, turned};
use super::experiment::{SEGMENTS, magnet_pair};
use super::study::Study;
use crate::design::{Design, Specification};
use crate::equilibrium::{Equilibrium, Inputs, Interaction, Settings, Shape};
use crate::error::Error;
use crate::geometry::Pose;
use crate::numerics::continuation::PointKind;

/// Distances from a snap at which it is predicted, relative to the way up to there.
pub const DISTANCES: [f64; 6] = [0.2, 0.1, 0.05, 0.02, 0.01, 0.001];

/// Points of a branch at most.
const POINTS: usize = 300;

/// Points of that of three segments: after some more their rings touch.
const POINTS_OF_THREE: usize = 45;

/// What the diagrams say.
#[derive(Debug, Clone, PartialEq)]
pub struct Bifurcation {
    /// The diagrams.
    pub study: Study,
    /// Their folds and branching points.
    pub places: Vec<Place>,
    /// The snaps of slow loading.
    pub predictions: Vec<Prediction>,
}

/// A fold or branching point.
#[derive(Debug, Clone, PartialEq)]
pub struct Place {
    /// What happens there, with the unit of its value.
    pub what: String,
    /// Where continuation finds it.
    pub continuation: f64,
    /// Where slow loading snaps, if it does: in the middle of an interval of 1e-5 of the path.
    pub bisection: Option<f64>,
    /// Where it is in closed form.
    pub closed_form: Option<f64>,
}

/// A snap of slow loading, predicted before it happens.
#[derive(Debug, Clone, PartialEq)]
pub struct Prediction {
    /// What snaps.
    pub what: String,
    /// Errors of the predictions at [`DISTANCES`], relative to the distance, positive for one that is too early; `None`
    /// where none is made.
    pub errors: Vec<Option<f64>>,
}

/// One diagram and what it says.
struct Found {
    canvas: Canvas,
    places: Vec<Place>,
    predictions: Vec<Prediction>,
}

/// Turning, growing and nearing fields, rings nearer to each other: diagrams of branches with folds, slow loading with its
/// snaps, and how early these are predicted.
///
/// # Errors
/// None for the paper's designs; those of the solves are passed on.
pub fn bifurcation() -> Result<Bifurcation, Error> {
    let diagrams = [turning, growing, nearing, pulling, spacing::branches, spacing::critical];
    let found = diagrams.into_par_iter().map(|diagram| diagram()).collect::<Result<Vec<_>, Error>>()?;
    let rows = found.iter().map(|diagram| diagram.canvas.rows()).max().unwrap_or(0);
    let (mut columns, mut panels) = (Vec::new(), Vec::new());
    let (mut places, mut predictions) = (Vec::new(), Vec::new());
    for diagram in found {
        panels.push(diagram.canvas.finish(rows, &mut columns));
        places.extend(diagram.places);
        predictions.extend(diagram.predictions);
    }
    let title = "Where shapes end: equilibria, stable or not, and the way of slow loading";
    Ok(Bifurcation { study: Study { title, columns, panels, comparison: Vec::new() }, places, predictions })
}

/// A dipole on one core in a field that turns.
fn turning() -> Result<Found, Error> {
    let case = dipole::turning()?;
    let mut found = Found::new(Drawing {
        name: "turning",
        title: "dipole on one core; 61 mT, turning",
        x: ["direction of the field", "deg"],
        y: ["tip angle", "deg"],
        branches: &["stable"],
        explained: true,
    });
    let (diagram, loading) = (case.trace(case.path[0])?, case.load(true)?);
    found.canvas.draw(0, &case, &diagram);
    found.canvas.draw_loading(&loading);
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

/// The same in an antiparallel field that grows, and a degree aside.
fn growing() -> Result<Found, Error> {
    let (straight, aside) = (dipole::growing(180.0)?, dipole::growing(dipole::ASIDE)?);
    let mut found = Found::new(Drawing {
        name: "growing",
        title: "the same; antiparallel field, growing",
        x: ["field", "mT"],
        y: ["tip angle", "deg"],
        branches: &["exactly", "1 deg aside"],
        explained: false,
    });
    let (perfect, near) = (straight.trace(0.0)?, aside.trace(0.0)?);
    // The shape on the far side is close to that in the mirrored field.
    let mirrored = dipole::growing(360.0 - dipole::ASIDE)?;
    let mut model = Equilibrium::new(&mirrored.design, None, mirrored.settings, 2)?;
    let largest = mirrored.path[1];
    model.solve(&(mirrored.way)(largest))?;
    let far = aside.trace_from(&model, largest)?;
    for (branch, case, diagram) in [(0, &straight, &perfect), (1, &aside, &near), (1, &aside, &far)] {
        found.canvas.draw(branch, case, diagram);
    }
    found.canvas.draw_loading(&aside.load(false)?);
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

/// Nine segments and the magnet pair, beside their base and magnetised along them, which comes near and goes away.
fn nearing() -> Result<Found, Error> {
    let design = Design::new(Specification::paper(SEGMENTS))?;
    let rings = design.rings().count();
    let way = move |millimetres: f64| Inputs {
        magnet: Pose { position: Vector3::new(0.0, -1e-3 * millimetres, 0.0), ..Pose::identity() },
        magnet_strength: 1.0,
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
    let mut found = Found::new(Drawing {
        name: "nearing",
        title: "nine segments; magnet pair comes, goes",
        x: ["distance of the axes", "mm"],
        y: ["tip angle", "deg"],
        branches: &[""],
        explained: false,
    });
    let loading = case.load(true)?;
    found.canvas.draw_loading(&loading);
    for (number, what) in
        ["nine segments: snap as the magnet comes (mm)", "nine segments: snap as it goes (mm)"]
            .into_iter()
            .enumerate()
    {
        let diagram = case.trace(case.path[number])?;
        found.canvas.draw(0, &case, &diagram);
        if let Some(shape) = diagram.folds().next() {
            found.add(what, shape, loading.snaps.get(number).copied(), None);
            found.predict(&case, what, shape, number == 0)?;
        }
    }
    Ok(found)
}

/// One and three segments that are pulled shut in a field across.
fn pulling() -> Result<Found, Error> {
    let mut found = Found::new(Drawing {
        name: "pulling",
        title: "level full; field across, growing",
        x: ["field", "mT"],
        y: ["tip angle", "deg"],
        branches: &["one segment", "three segments"],
        explained: false,
    });
    for (branch, segments, points, what) in [
        (0, 1, POINTS, "one segment, `full`: pulled shut (mT)"),
        (1, 3, POINTS_OF_THREE, "three segments, `full`: pulled shut (mT)"),
    ] {
        let case = pulled(Specification::paper(segments), [0.0, 40.0], points)?;
        let (diagram, loading) = (case.trace(0.0)?, case.load(false)?);
        found.canvas.draw(branch, &case, &diagram);
        found.canvas.draw_loading(&loading);
        if let Some(shape) = diagram.folds().next() {
            found.add(what, shape, loading.snaps.first().copied(), None);
            found.predict(&case, what, shape, true)?;
        }
    }
    Ok(found)
}

/// A device with all attraction in a field across, mT.
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
    fn new(drawing: Drawing) -> Self {
        Self { canvas: Canvas::new(drawing), places: Vec::new(), predictions: Vec::new() }
    }

    /// Adds a place that continuation has found at `shape`.
    fn add(&mut self, what: &str, shape: &Shape, bisection: Option<f64>, closed_form: Option<f64>) {
        self.places.push(Place { what: what.into(), continuation: shape.value, bisection, closed_form });
    }

    /// Adds predictions of the snap at `shape`, on the way forth or back.
    fn predict(&mut self, case: &Case, what: &str, shape: &Shape, forth: bool) -> Result<(), Error> {
        let errors = case.predict(shape.value, forth, &DISTANCES)?;
        self.predictions.push(Prediction { what: what.into(), errors });
        Ok(())
    }
}
