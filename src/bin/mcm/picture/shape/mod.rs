//! A solved scene to scale: device, shaft, vessel, magnet, and what the wall does.

mod drawing;
mod outline;
mod view;

use std::path::{Path, PathBuf};

use mcm::design::Specification;
use mcm::error::Error;
use mcm::geometry::Pose;
use mcm::magnetics::Assembly;
use mcm::manipulator::{Outputs, PlacedSource, Scene};
use mcm::nalgebra::Vector3;
use plotters::prelude::{BitMapBackend, IntoDrawingArea, SVGBackend};

use super::{OVERSAMPLING, WIDTH, write_png};
use crate::failure::Failure;
use crate::output::Output;
use outline::{LumenOutline, Outline};
use view::View;

/// Size of the plot's inside: its width, and the least and largest height, pixels.
const INSIDE: f64 = 790.0;
const HEIGHTS: [f64; 2] = [240.0, 900.0];

/// Height of all that is above and below it, pixels.
const AROUND: f64 = 168.0;

/// Space around what is drawn: relative to its size, at least this much (mm), and this much of a vessel (mm).
const AIR: f64 = 0.07;
const LEAST_AIR: f64 = 4.0;
const VESSEL_AIR: f64 = 15.0;

/// Length of shaft that is drawn before its port, m.
const OUTSIDE: f64 = 0.01;

/// The kind of picture that a file's name asks for.
#[derive(Clone, Copy, PartialEq)]
enum Kind {
    Svg,
    Png,
}

/// A file for the picture of a scene, which can be written.
pub(crate) struct ShapeFile {
    path: PathBuf,
    kind: Kind,
    output: Output,
}

impl ShapeFile {
    /// Begins the file.
    pub(crate) fn at(path: &Path) -> Result<Self, Failure> {
        let ending = path.extension().map(std::ffi::OsStr::to_ascii_lowercase);
        let kind = match ending.as_ref().and_then(|ending| ending.to_str()) {
            Some("svg") => Kind::Svg,
            Some("png") => Kind::Png,
            _ => {
                return Err(Failure(format!("--picture {} must end in .svg or .png", path.display())));
            }
        };
        Ok(Self { path: path.to_owned(), kind, output: Output::at(path)? })
    }

    /// Draws the shape found for a scene with this name.
    pub(crate) fn draw(self, name: &str, scene: &Scene, outputs: &Outputs) -> Result<(), Failure> {
        let failure = |reason: String| Failure(format!("cannot draw {}: {reason}", self.path.display()));
        let picture = Picture::new(name, scene, outputs).map_err(|error| failure(error.to_string()))?;
        let [width, height] = [WIDTH, picture.height()];
        let large = (width * OVERSAMPLING, height * OVERSAMPLING);
        if self.kind == Kind::Png {
            let mut pixels = vec![255; (large.0 * large.1 * 3) as usize];
            picture
                .draw(&BitMapBackend::with_buffer(&mut pixels, large).into_drawing_area())
                .map_err(|error| failure(error.to_string()))?;
            return write_png(self.output, &pixels, (width, height));
        }
        let mut drawn = String::new();
        picture
            .draw(&SVGBackend::with_string(&mut drawn, large).into_drawing_area())
            .map_err(|error| failure(error.to_string()))?;
        // The coordinates stay fine, the picture gets the size of the other one.
        let sizes = |(width, height): (u32, u32)| format!("width=\"{width}\" height=\"{height}\"");
        self.output.fill(drawn.replacen(&sizes(large), &sizes((width, height)), 1).as_bytes())
    }
}

/// All that is drawn, in the plane, mm.
struct Picture {
    title: String,
    view: View,
    /// Corners of the plot.
    corners: [(f64, f64); 2],
    vessel: LumenOutline,
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
            vessel: LumenOutline::default(),
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
            out.vessel = outline::of_lumen(lumen, &out.view, out.corners)
                .map_err(|error| Error::Unsupported(format!("the vessel's outline: {error}")))?;
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

    fn sides(&self) -> [f64; 2] {
        let [low, high] = self.corners;
        [high.0 - low.0, high.1 - low.1]
    }

    /// Height of the picture, pixels.
    #[allow(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "at most some hundred")]
    fn height(&self) -> u32 {
        let [across, up] = self.sides();
        (AROUND + INSIDE * up / across).round() as u32
    }
}
