//! A solved scene to scale: device, shaft, vessel, magnet, and what the wall does.

mod contour;
mod drawing;
mod outline;
mod sections;
mod view;

use mcm::error::Error;
use mcm::geometry::Pose;
use mcm::magnetics::{Drive, Part, Source};
use mcm::manipulator::{Outputs, PlacedSource, Scene};
use mcm::nalgebra::Vector3;
use svg::Document;

use crate::failure::Failure;
use contour::closed_lines;
use outline::{Grid, Outline};
pub(crate) use view::Plane;
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

/// Distance of a source from the plane of the picture, in parts of its own size, from which the picture says how far it is.
const OUT_OF_PLANE: f64 = 0.25;

/// Least force that an arrow of full length stands for, in parts of the largest force on the device as a whole, and N: what is far smaller
/// decides nothing.
const FORCE_SHARE: f64 = 0.01;
const LEAST_FORCE: f64 = 1e-6;

/// The picture of the shape found for a scene with this name, in a plane that is asked for or that of the bend.
pub(crate) fn draw(
    name: &str,
    scene: &Scene,
    outputs: &Outputs,
    plane: Option<Plane>,
) -> Result<Document, Failure> {
    Ok(Picture::new(name, scene, outputs, plane)?.draw())
}

/// A cylinder of a magnet.
struct Magnet {
    whole: Outline,
    northern: Outline,
    /// Places of the letters N and S.
    poles: [(f64, f64); 2],
    /// The one that is nearer to the viewer.
    front: usize,
}

/// Where a source stands that is not in the plane of the picture.
struct Remark {
    at: (f64, f64),
    words: String,
}

/// All that is drawn, in the plane, mm.
struct Picture {
    title: String,
    view: View,
    /// Corners of the plot.
    corners: [(f64, f64); 2],
    /// Outlines of the vessel and of what it leaves free.
    vessel: Vec<Outline>,
    /// Each cylinder of the magnets.
    magnet: Vec<Magnet>,
    remarks: Vec<Remark>,
    /// The coils that carry a current.
    coils: Vec<Outline>,
    shaft: Vec<Outline>,
    /// Spirals, or elastic parts.
    device: Vec<Outline>,
    /// Cores in spirals.
    cores: Vec<Outline>,
    rings: Vec<Outline>,
    /// Places of contacts and forces (N).
    forces: Vec<[(f64, f64); 2]>,
    /// The force that an arrow of full length stands for, N.
    full_force: f64,
    /// The uniform field, mT: its part in the plane, and its magnitude.
    field: Option<((f64, f64), f64)>,
}

impl Picture {
    fn new(name: &str, scene: &Scene, outputs: &Outputs, plane: Option<Plane>) -> Result<Self, Error> {
        let design = scene.design()?;
        let inputs = &scene.inputs;
        let placed = scene.sources.list().iter().zip(inputs.sources.iter().copied());
        let on: Vec<(&Source, PlacedSource)> = placed.filter(|(_, placed)| placed.strength != 0.0).collect();

        let lumen = scene.vessel.as_ref().map(|vessel| &vessel.lumen);
        let field = inputs.uniform_field;
        let beside =
            on.first().map(|(_, placed)| placed.pose.position).or((field != Vector3::zeros())
                .then(|| outputs.tip.position + field.normalize() * design.length()));

        let view = View::of(plane, &outputs.shape, lumen, beside, &inputs.base.axis());

        // Points up to the inserted length lie on the shaft, those behind it on the device.
        let inserted = outputs.feed_length.unwrap_or(0.0);
        let first = outputs.shape_arc_length.iter().position(|s| *s >= inserted).unwrap_or(0);
        let pushed = &outputs.shape[..=first];
        let shaft = scene.shaft.as_ref().map_or_else(Vec::new, |shaft| {
            let outside = [inputs.base.advanced(-OUTSIDE).position, inputs.base.position];
            [&outside[..], pushed]
                .map(|points| outline::of_rod(&view, points, [shaft.outer_radius; 2]))
                .into()
        });

        let (device, cores) = sections::of_elastic(&view, &design, outputs, inserted);
        let driven = |drive| {
            let own = on.iter().filter(move |(source, _)| source.drive() == drive);
            own.flat_map(|(source, placed)| source.parts().iter().map(move |part| (part, placed)))
        };

        let magnet = driven(Drive::Factor)
            .map(|(part, PlacedSource { pose, strength })| Magnet::of(&view, part, pose, *strength));

        let middle = outputs.shape.iter().sum::<Vector3<f64>>() / outputs.shape.len() as f64;
        let remarks =
            on.iter().filter_map(|(source, placed)| Remark::of(&view, &middle, source, &placed.pose));
        let coils = driven(Drive::Current).map(|(part, placed)| outline::of_part(&view, &placed.pose, part));

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
            remarks: remarks.collect(),
            coils: coils.collect(),
            shaft,
            device,
            cores,
            rings: sections::of_rigid(&view, &design, &outputs.rings),
            forces: walls.map(|[at, force]| [view.at(at), flat(force)]).collect(),
            full_force: 0.0,
            field: (field != Vector3::zeros()).then(|| (view.at(&field), 1e3 * field.norm())),
            view,
        };

        // Arrows are scaled by the largest force, unless that is tiny beside the loads on the whole.
        let whole = [outputs.base_reaction_force, outputs.magnetic_force, inputs.tip_force];
        let whole = whole.into_iter().map(|force| force.norm()).fold(0.0, f64::max);
        out.full_force = out.largest_force().max(FORCE_SHARE * whole).max(LEAST_FORCE);
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
        let magnet = self.magnet.iter().flat_map(|magnet| &magnet.whole);
        let all = self
            .shaft
            .iter()
            .chain(&self.device)
            .chain(&self.cores)
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

impl Magnet {
    /// A part of a magnet at this pose with this strength.
    fn of(view: &View, part: &Part, pose: &Pose, strength: f64) -> Self {
        let north = part.remanence * strength;
        let north = north.try_normalize(0.0).unwrap_or_else(Vector3::z);
        let letters = [north, -north].map(|side| {
            let half = part.outline.half_extents().dot(&side.abs());
            pose.transform(&(part.centre + side * (0.5 * half)))
        });
        let [ahead, behind] = letters.each_ref().map(|letter| view.towards.dot(letter));
        Self {
            whole: outline::of_part(view, pose, part),
            northern: outline::of_half(view, pose, part, &north),
            poles: letters.map(|letter| view.at(&letter)),
            front: usize::from(behind > ahead),
        }
    }
}

impl Remark {
    /// That of a source at this pose, at its lower edge; `None` where it stands in the plane through a place of the device.
    fn of(view: &View, device: &Vector3<f64>, source: &Source, pose: &Pose) -> Option<Self> {
        let depth = view.towards.dot(&(pose.position - device));
        let across = |part: &Part| part.outline.half_extents().xy().max();
        let size = source.parts().iter().map(across).fold(0.0, f64::max);
        let outlines = source.parts().iter().flat_map(|part| outline::of_part(view, pose, part));
        let lowest = outlines.map(|(_, y)| y).fold(f64::INFINITY, f64::min);
        let (side, away) = (if depth > 0.0 { "in front" } else { "behind" }, depth.abs());
        let words = format!("{:.0} mm {side}", 1e3 * away);
        (away > OUT_OF_PLANE * size).then(|| Self { at: (view.at(&pose.position).0, lowest), words })
    }
}
