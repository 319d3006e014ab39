//! Bifurcation diagrams: stable and unstable branches, where they fold, and how early a snap is seen coming.

mod case;
mod dipole;

use nalgebra::Vector3;
use rayon::prelude::*;

use self::case::{Case, Loading, turned};
use super::experiment::{SEGMENTS, magnet_pair};
use super::study::{Column, Curve, Mark, Panel, Stroke, Study};
use crate::design::{Design, Specification};
use crate::equilibrium::{Diagram, Equilibrium, Inputs, Interaction, Settings, Shape};
use crate::error::Error;
use crate::geometry::Pose;
use crate::manipulator::Fold;
use crate::numerics::continuation::Kind;

/// Distances from a snap at which it is predicted, relative to the way up to there.
pub const DISTANCES: [f64; 6] = [0.2, 0.1, 0.05, 0.02, 0.01, 0.005];

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
    /// Where slow loading is located to snap, if it does.
    pub bisection: Option<f64>,
    /// Where it is in closed form.
    pub closed_form: Option<f64>,
    /// Length of the path on which it lies.
    pub span: f64,
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

/// Where a diagram is drawn.
struct Drawing {
    name: &'static str,
    title: &'static str,
    /// What the abscissa is, and its unit.
    x: [&'static str; 2],
    y: &'static str,
    /// What is drawn, one colour each.
    devices: &'static [&'static str],
}

/// A panel under way: its places on the abscissa, and a column for each curve.
struct Canvas {
    drawing: Drawing,
    x: Vec<f64>,
    curves: Vec<(Curve, Vec<f64>)>,
    marks: Vec<Mark>,
}

/// Turning, growing and nearing fields: diagrams of all branches with folds, of slow loading with snaps, and how early the
/// snaps are predicted.
///
/// # Errors
/// None for the paper's designs; those of the solves are passed on.
pub fn bifurcation() -> Result<Bifurcation, Error> {
    let panels = [turning, growing, nearing, pulling];
    let found = panels.into_par_iter().map(|panel| panel()).collect::<Result<Vec<_>, Error>>()?;
    let (mut columns, mut panels) = (Vec::new(), Vec::new());
    let (mut places, mut predictions) = (Vec::new(), Vec::new());
    let rows = found.iter().map(|(canvas, ..)| canvas.x.len()).max().unwrap_or(0);
    for (canvas, own, snaps) in found {
        panels.push(canvas.finish(rows, &mut columns));
        places.extend(own);
        predictions.extend(snaps);
    }
    let title = "Where shapes end: all equilibria, stable or not, and the way of slow loading";
    let study = Study { title, columns, panels, comparison: Vec::new() };
    Ok(Bifurcation { study, places, predictions })
}

type Found = Result<(Canvas, Vec<Place>, Vec<Prediction>), Error>;

/// A dipole on one core in a field that turns.
fn turning() -> Found {
    let case = dipole::turning()?;
    let mut canvas = Canvas::new(Drawing {
        name: "turning",
        title: "a dipole on one core; 62 mT, turning",
        x: ["direction of the field", "deg"],
        y: "tip angle in the plane (deg)",
        devices: &["equilibria"],
    });
    let diagram = case.trace(case.path[0])?;
    let loading = case.load(true)?;
    canvas.draw(0, &case, &diagram);
    canvas.draw_loading(&loading);
    let plane = dipole::fold_of_turning();
    let swing = loading.folds.first().map(|fold| fold.value);
    let mut places = Vec::new();
    for shape in special(&diagram) {
        let (what, bisection, closed_form) = match shape.kind {
            Kind::Fold if shape.value > 180.0 => {
                ("folds in the plane, already unstable out of it", None, plane)
            }
            Kind::Fold => ("the same on its other side", None, 360.0 - plane),
            _ if shape.tip.axis().y > 0.0 => ("swings out of the plane", swing, 180.0),
            _ => ("swings back", loading.folds.get(1).map(|fold| fold.value), 180.0),
        };
        places.push(place(
            &case,
            format!("dipole, 62 mT turned: {what} (deg)"),
            shape,
            bisection,
            Some(closed_form),
        ));
    }
    let predictions = predictions(&case, &loading, &["dipole swings over"])?;
    Ok((canvas, places, predictions))
}

/// The same in an antiparallel field that grows, and a degree aside.
fn growing() -> Found {
    let (straight, aside) = (dipole::growing(180.0)?, dipole::growing(dipole::ASIDE)?);
    let mut canvas = Canvas::new(Drawing {
        name: "growing",
        title: "the same; antiparallel field, growing",
        x: ["field", "mT"],
        y: "tip angle in the plane (deg)",
        devices: &["exactly antiparallel", "1 deg aside"],
    });
    let (perfect, near) = (straight.trace(0.0)?, aside.trace(0.0)?);
    // The shape on the far side is close to that in the mirrored field.
    let mirrored = dipole::growing(360.0 - dipole::ASIDE)?;
    let mut model = Equilibrium::new(&mirrored.design, None, mirrored.settings, 2)?;
    let largest = mirrored.path[1];
    model.solve(&(mirrored.way)(largest))?;
    let far = aside.trace_from(&model, largest)?;
    canvas.draw(0, &straight, &perfect);
    canvas.draw(1, &aside, &near);
    canvas.draw(1, &aside, &far);
    canvas.draw_loading(&aside.load(false)?);
    let mut places = Vec::new();
    for (diagram, what, closed_form) in [
        (&perfect, "the straight shape buckles", dipole::critical_field()?),
        (&far, "1 deg aside, the far side folds", dipole::fold_aside()?),
    ] {
        for shape in special(diagram) {
            let what = format!("dipole, antiparallel: {what} (mT)");
            places.push(place(&aside, what, shape, None, Some(closed_form)));
        }
    }
    Ok((canvas, places, Vec::new()))
}

/// Nine segments and the magnet pair, beside their base and magnetised along them, which comes near and goes away.
fn nearing() -> Found {
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
        points: 300,
    };
    let mut canvas = Canvas::new(Drawing {
        name: "nearing",
        title: "nine segments, magnet pair comes and goes",
        x: ["distance of the axes", "mm"],
        y: "tip angle (deg)",
        devices: &["equilibria"],
    });
    let loading = case.load(true)?;
    let mut places = Vec::new();
    for (number, way) in ["comes", "goes"].into_iter().enumerate() {
        let diagram = case.trace(case.path[number])?;
        canvas.draw(0, &case, &diagram);
        // What follows the first fold is not met.
        let snap = loading.folds.get(number).map(|fold| fold.value);
        let first = special(&diagram).next();
        places.extend(first.map(|shape| {
            let what = format!("nine segments, `rings`: snaps over as the magnet {way} (mm)");
            place(&case, what, shape, snap, None)
        }));
    }
    canvas.draw_loading(&loading);
    let snaps = ["nine segments, magnet comes", "nine segments, magnet goes"];
    let predictions = predictions(&case, &loading, &snaps)?;
    Ok((canvas, places, predictions))
}

/// One and three segments that are pulled shut in a field across.
fn pulling() -> Found {
    let mut canvas = Canvas::new(Drawing {
        name: "pulling",
        title: "`full`; field across, growing",
        x: ["field", "mT"],
        y: "tip angle (deg)",
        devices: &["one segment", "three"],
    });
    let (mut places, mut predicted) = (Vec::new(), Vec::new());
    for (device, segments, points) in [(0, 1, 300), (1, 3, 45)] {
        let design = Design::new(Specification::paper(segments))?;
        let rings = design.rings().count();
        let way = move |millitesla: f64| Inputs {
            uniform_field: Vector3::new(0.0, 1e-3 * millitesla, 0.0),
            ..Inputs::unloaded(rings)
        };
        let settings = Settings { interaction: Interaction::Full, ..Settings::default() };
        let path = [0.0, 40.0];
        let case = Case { design, magnet: None, settings, way: Box::new(way), path, angle: turned, points };
        let (diagram, loading) = (case.trace(case.path[0])?, case.load(false)?);
        canvas.draw(device, &case, &diagram);
        canvas.draw_loading(&loading);
        let snap = loading.folds.first().map(|fold| fold.value);
        let name = if segments == 1 { "one segment" } else { "three segments" };
        let first = diagram.folds().next();
        places.extend(
            first.map(|shape| place(&case, format!("{name}, `full`: pulled shut (mT)"), shape, snap, None)),
        );
        predicted.extend(predictions(&case, &loading, &[&format!("{name} pulled shut")])?);
    }
    Ok((canvas, places, predicted))
}

fn special(diagram: &Diagram) -> impl Iterator<Item = &Shape> {
    diagram.shapes.iter().filter(|shape| shape.kind != Kind::Regular)
}

fn place(
    case: &Case,
    what: String,
    shape: &Shape,
    bisection: Option<f64>,
    closed_form: Option<f64>,
) -> Place {
    let span = (case.path[1] - case.path[0]).abs();
    Place { what, continuation: shape.value, bisection, closed_form, span }
}

fn predictions(case: &Case, loading: &Loading, names: &[&str]) -> Result<Vec<Prediction>, Error> {
    let of = |(fold, name): (&Fold, &&str)| {
        let errors = case.predict(fold, &DISTANCES)?;
        Ok(Prediction { what: (*name).into(), errors })
    };
    loading.folds.iter().zip(names).map(of).collect()
}

impl Canvas {
    fn new(drawing: Drawing) -> Self {
        let column = |part: String| format!("{}_{part}_deg", drawing.name);
        let mut curves = Vec::new();
        for (device, label) in drawing.devices.iter().enumerate() {
            let colour = 2 * device;
            let stable = Curve::new(
                format!("{label}, stable"),
                column(format!("{device}_stable")),
                colour,
                Stroke::Solid,
            );
            let unstable =
                Curve::new("unstable", column(format!("{device}_unstable")), colour, Stroke::Dashed);
            curves.extend([(stable, Vec::new()), (unstable, Vec::new())]);
        }
        let loading = Curve::new("slow loading", column("loading".into()), 1, Stroke::Dots);
        curves.push((loading, Vec::new()));
        Self { drawing, x: Vec::new(), curves, marks: Vec::new() }
    }

    /// Adds a row with these values in these curves.
    fn push(&mut self, x: f64, values: &[(usize, f64)]) {
        self.x.push(x);
        for (index, (_, column)) in self.curves.iter_mut().enumerate() {
            column
                .push(values.iter().find(|(curve, _)| *curve == index).map_or(f64::NAN, |(_, value)| *value));
        }
    }

    /// Adds a branch: what is stable, what is not, and where it folds.
    fn draw(&mut self, device: usize, case: &Case, diagram: &Diagram) {
        let shapes = &diagram.shapes;
        let regular = |index: Option<usize>, stable: bool| {
            let shape = index.and_then(|index| shapes.get(index));
            shape.is_some_and(|shape| shape.kind == Kind::Regular && (shape.unstable == 0) == stable)
        };
        for (index, shape) in shapes.iter().enumerate() {
            let angle = (case.angle)(&shape.tip);
            // Between two regular shapes a special one belongs to both, so that their curves meet.
            let near = [Some(index), index.checked_sub(1), Some(index + 1)];
            let near = if shape.kind == Kind::Regular { &near[..1] } else { &near[1..] };
            let mut values = Vec::new();
            for (curve, stable) in [(2 * device, true), (2 * device + 1, false)] {
                if near.iter().any(|index| regular(*index, stable)) {
                    values.push((curve, angle));
                }
            }
            self.push(shape.value, &values);
            if shape.kind != Kind::Regular {
                let label = if self.marks.is_empty() { "fold or branching" } else { "" };
                self.marks.push(Mark::Point(label.into(), [shape.value, angle]));
            }
        }
        self.push(f64::NAN, &[]);
    }

    fn draw_loading(&mut self, loading: &Loading) {
        let curve = self.curves.len() - 1;
        for [value, angle] in &loading.shapes {
            self.push(*value, &[(curve, *angle)]);
        }
    }

    /// The panel; its columns, filled up to so many rows, go to `columns`.
    fn finish(self, rows: usize, columns: &mut Vec<Column>) -> Panel {
        let Self { drawing, x, curves, marks } = self;
        let [quantity, unit] = drawing.x;
        let abscissa = format!("{}_{}", drawing.name, unit.to_lowercase());
        let mut drawn = Vec::new();
        let mut add = |name: String, mut values: Vec<f64>| {
            values.resize(rows, f64::NAN);
            columns.push(Column::new(name, values));
        };
        add(abscissa.clone(), x);
        for (curve, values) in curves {
            add(curve.column.clone(), values);
            drawn.push(curve);
        }
        Panel::Curves {
            title: drawing.title.into(),
            x: (format!("{quantity} ({unit})"), abscissa),
            y: drawing.y.into(),
            curves: drawn,
            marks,
        }
    }
}
