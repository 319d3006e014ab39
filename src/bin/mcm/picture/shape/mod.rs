//! A solved scene to scale: device, shaft, vessel, magnet, and what the wall does.

mod contour;
mod drawing;
mod outline;
mod view;

use mcm::design::Specification;
use mcm::error::Error;
use mcm::geometry::Pose;
use mcm::magnetics::Assembly;
use mcm::manipulator::{Outputs, PlacedSource, Scene};
use mcm::nalgebra::Vector3;
use svg::Document;

use crate::failure::Failure;
use contour::closed_lines;
use outline::{Grid, Outline};
use view::View;

/// Size of the plot's inside: its width, and the least and largest height, pixels.
const INSIDE: f64 = 790.0;
const HEIGHTS: [f64; 2] = [240.0, 900.0];

/// Space around what is drawn: relative to its size, at least this much (mm), and this much of a vessel (mm).
const AIR: f64 = 0.07;
const LEAST_AIR: f64 = 4.0;
const VESSEL_AIR: f64 = 15.0;

/// Length of shaft that is drawn before its port, m.
const OUTSIDE: f64 = 0.01;

/// The picture of the shape found for a scene with this name.
pub(crate) fn draw(name: &str, scene: &Scene, outputs: &Outputs) -> Result<Document, Failure> {
    Ok(Picture::new(name, scene, outputs)?.draw())
}

/// All that is drawn, in the plane, mm.
struct Picture {
    title: String,
    view: View,
    /// Corners of the plot.
    corners: [(f64, f64); 2],
    /// Outlines of the vessel and of what it leaves free.
    vessel: Vec<Outline>,
    /// Each cylinder of the magnets, its northern half, and where that ends.
    magnet: Vec<(Outline, Outline, (f64, f64))>,
    /// The coils that carry a current.
    coils: Vec<Outline>,
    shaft: Vec<Outline>,
    /// Spirals or body, and core.
    device: [Outline; 2],
    rings: Vec<Outline>,
    /// Places of contacts and forces (N).
    forces: Vec<[(f64, f64); 2]>,
    /// The uniform field, mT: its part in the plane, and its magnitude.
    field: Option<((f64, f64), f64)>,
}

impl Picture {
    fn new(name: &str, scene: &Scene, outputs: &Outputs) -> Result<Self, Error> {
        let design = scene.design()?;
        let inputs = &scene.inputs;
        let sources = scene.sources()?;
        let placed = |(number, source)| Some((source, inputs.source(number)?));
        let on: Vec<(&Assembly, PlacedSource)> =
            sources.numbered().filter_map(placed).filter(|(_, placed)| placed.strength != 0.0).collect();
        let lumen = scene.vessel.as_ref().map(|vessel| &vessel.lumen);
        let field = inputs.uniform_field;
        let beside =
            on.first().map(|(_, placed)| placed.pose.position).or((field != Vector3::zeros())
                .then(|| outputs.tip.position + field.normalize() * design.length()));
        let view = View::of(&outputs.shape, lumen, beside, &inputs.base.axis());
        let inserted = outputs.feed_length.unwrap_or(0.0);
        let first = outputs.shape_arc_length.iter().position(|s| *s >= inserted).unwrap_or(0);
        let (pushed, device) = (&outputs.shape[..=first], &outputs.shape[first..]);
        let shaft = scene.shaft.as_ref().map_or_else(Vec::new, |shaft| {
            let outside = [inputs.base.advanced(-OUTSIDE).position, inputs.base.position];
            [&outside[..], pushed].map(|points| outline::of_rod(&view, points, shaft.outer_radius)).into()
        });
        let (radius, core, ring) = match &scene.specification {
            Specification::Segmented(own) => (own.helix.radius, own.helix.core_outer_radius, own.ring.length),
            Specification::Cylinder(own) => (own.radius, 0.0, 0.0),
        };
        let cylinders =
            on.iter().flat_map(|(source, placed)| source.magnets().iter().map(move |own| (own, placed)));
        let magnet = cylinders.map(|(cylinder, PlacedSource { pose, strength })| {
            let ends = [-0.5, 0.5].map(|share| cylinder.offset + share * cylinder.length);
            let north = if cylinder.remanence * strength > 0.0 { ends[1] } else { ends[0] };
            let outline = |ends| outline::of_cylinder(&view, pose, ends, cylinder.radius);
            let letter = pose.advanced(0.5 * (north + cylinder.offset)).position;
            (outline(ends), outline([cylinder.offset, north]), view.at(&letter))
        });
        let coils = on.iter().filter_map(|(source, placed)| {
            let coil = source.coil()?;
            let ends = [-0.5, 0.5].map(|share| share * coil.length);
            Some(outline::of_cylinder(&view, &placed.pose, ends, coil.outer_radius))
        });
        let body = |pose: &Pose| outline::of_cylinder(&view, pose, [-0.5 * ring, 0.5 * ring], radius);
        let walls = outputs.wall.iter().flat_map(|wall| &wall.places);
        let flat = |force: &Vector3<f64>| {
            let (x, y) = view.at(force);
            (1e-3 * x, 1e-3 * y)
        };
        let mut out = Self {
            title: format!("{name}: tip angle {:.2} deg", outputs.tip_angle.to_degrees()),
            corners: [(0.0, 0.0); 2],
            vessel: Vec::new(),
            magnet: magnet.collect(),
            coils: coils.collect(),
            shaft,
            device: [radius, core].map(|radius| outline::of_rod(&view, device, radius)),
            rings: outputs.rings.iter().map(body).collect(),
            forces: walls.map(|[at, force]| [view.at(at), flat(force)]).collect(),
            field: (field != Vector3::zeros()).then(|| (view.at(&field), 1e3 * field.norm())),
            view,
        };
        out.corners = out.corners_around(lumen.is_some());
        if let Some(lumen) = lumen {
            let Grid { first, step, columns, values } =
                outline::depth_in_lumen(lumen, &out.view, out.corners);
            let place = |(x, y): (f64, f64)| (first.0 + step * x, first.1 + step * y);
            let lines = closed_lines(&values, columns).into_iter();
            out.vessel = lines.map(|line| line.into_iter().map(place).collect()).collect();
        }
        Ok(out)
    }

    /// Corners of a plot around all but the vessel, with the same scale along both axes.
    fn corners_around(&self, in_vessel: bool) -> [(f64, f64); 2] {
        let magnet = self.magnet.iter().flat_map(|(whole, ..)| whole);
        let all = self
            .shaft
            .iter()
            .chain(&self.device)
            .chain(&self.rings)
            .chain(&self.coils)
            .flatten()
            .chain(magnet);
        let start = [(f64::INFINITY, f64::INFINITY), (f64::NEG_INFINITY, f64::NEG_INFINITY)];
        let [low, high] = all.fold(start, |[low, high], point| {
            [(low.0.min(point.0), low.1.min(point.1)), (high.0.max(point.0), high.1.max(point.1))]
        });
        let sides = [high.0 - low.0, high.1 - low.1];
        let least = if in_vessel { VESSEL_AIR } else { LEAST_AIR };
        let air = 2.0 * least.max(AIR * sides[0].max(sides[1]));
        let [mut across, mut up] = sides.map(|side| side + air);
        across = across.max(up * INSIDE / HEIGHTS[1]);
        up = up.max(across * HEIGHTS[0] / INSIDE);
        let middle = (0.5 * (low.0 + high.0), 0.5 * (low.1 + high.1));
        [-0.5, 0.5].map(|share| (middle.0 + share * across, middle.1 + share * up))
    }
}
