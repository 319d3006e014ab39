//! Centrelines and radii of the arteries, laid out from their measures.

use nalgebra::{Matrix3, Vector3};

use super::anatomy::{Aorta, Iliac, SideArtery};
use super::course::{Bend, CentrelinePoint, Course};
use crate::error::{Error, check};
use crate::numerics::bisection::bisect;
use crate::numerics::onset::smooth_step;
use crate::vessel::branch::Branch;

/// Length over which the common iliac arteries turn away from the aorta, m: a natural arc.
const PARTING: f64 = 20e-3;

/// Length over which the aorta narrows to the width of a common iliac artery, m.
const NARROWING: f64 = 38e-3;

/// Length of the bend from the common to the external iliac artery, m.
const ILIAC_BEND: f64 = 36e-3;

/// Length of the bend at the groin, m.
const GROIN_BEND: f64 = 44e-3;

/// Length over which a side artery's direction changes behind its mouth, relative to what is left of it.
const SIDE_BEND: f64 = 0.6;

/// Width of the right iliac artery at its beginning within the aorta, relative to the aorta: its wall stays inside.
const WITHIN: f64 = 0.9;

/// Distance below the centrelines' parting within which the common iliac arteries must part, m.
const PARTED: f64 = 50e-3;

/// Bisections that come to rounding.
const HALVINGS: usize = 50;

/// One artery: its name, where its measures are from, centreline and radii.
#[derive(Debug, Clone, PartialEq)]
pub struct Artery {
    /// Its name, which is also its branch's.
    pub name: &'static str,
    /// What it is and where its measures are from, a line.
    pub remark: String,
    /// Points of the centreline, m.
    pub points: Vec<Vector3<f64>>,
    /// Inner radius at each point, m.
    pub radii: Vec<f64>,
}

/// The centrelines that everything else follows, with their parting as origin.
pub(super) struct Layout {
    pub(super) left: Course,
    pub(super) right: Course,
    pub(super) aorta: Course,
    /// The port as seen from there, m.
    pub(super) port: Vector3<f64>,
    /// Length from there to the port along the left iliac artery, m.
    pub(super) to_port: f64,
    /// Length of the iliac arteries from there to the lumens' parting, m.
    parting: f64,
    /// How far that is below, m.
    below: f64,
}

/// A side artery's centreline.
pub(super) struct SideCourse {
    pub(super) course: Course,
    /// Where its straight beginning leaves the aorta's centreline, as a length along that, m.
    pub(super) start: f64,
    /// The middle of its mouth, with its direction there, and its length up to there, m.
    pub(super) mouth: CentrelinePoint,
    pub(super) to_mouth: f64,
}

impl Aorta {
    /// Name, side artery and source, from the head downwards.
    pub(super) fn side_arteries(&self) -> [(&'static str, &SideArtery, &'static str); 5] {
        let autopsies = "Songür et al. 2010";
        let renal = "Lauder et al. 2018, Hutchinson et al. 2013";
        [
            ("celiac trunk", &self.celiac, autopsies),
            ("superior mesenteric", &self.sma, autopsies),
            ("right renal", &self.right_renal, renal),
            ("left renal", &self.left_renal, renal),
            ("inferior mesenteric", &self.ima, autopsies),
        ]
    }

    /// The arteries as centrelines with radii: first the left iliac artery, from behind the port, which goes on into the aorta.
    ///
    /// The others begin on the centreline of the artery that they leave, inside its lumen.
    ///
    /// # Errors
    /// [`Error::Range`] for a measure that is not possible.
    pub fn arteries(&self) -> Result<Vec<Artery>, Error> {
        let layout = self.layout()?;
        let artery =
            |name, remark, course: &Course, stations: Vec<f64>, radius: &dyn Fn(f64) -> f64| Artery {
                name,
                remark,
                points: stations.iter().map(|s| course.place(*s).point - layout.port).collect(),
                radii: stations.iter().map(|s| radius(*s)).collect(),
            };

        // The left iliac artery is listed from behind the port upwards, so that it goes on into the aorta as
        // one branch.
        let mut aorta = artery(
            "left iliac and aorta",
            format!(
                "{} mm wide, then {} to {} mm: Koziej et al. 2025, Joh et al. 2013",
                millimetres(self.left_iliac.common_width),
                millimetres(self.bottom_width),
                millimetres(self.top_width),
            ),
            &layout.left,
            layout.left.stations().into_iter().rev().collect(),
            &|s| layout.iliac_radius(&self.left_iliac, 0.5 * self.bottom_width, s),
        );

        // The first station of the aorta is the last of the iliac artery.
        for station in layout.aorta.stations().into_iter().skip(1) {
            aorta.points.push(layout.aorta.place(station).point - layout.port);
            aorta.radii.push(self.radius(&layout, station));
        }

        let start = 0.5 * WITHIN * self.bottom_width;
        let right = artery(
            "right iliac",
            format!("{} mm wide: Koziej et al. 2025", millimetres(self.right_iliac.common_width)),
            &layout.right,
            layout.right.stations(),
            &|s| layout.iliac_radius(&self.right_iliac, start, s),
        );

        let mut out = vec![aorta, right];
        let sides = [
            ("left internal iliac", &self.left_iliac, &layout.left),
            ("right internal iliac", &self.right_iliac, &layout.right),
        ];
        for (name, iliac, limb) in sides {
            let course = layout.internal(iliac, limb);
            let remark = format!("{} mm wide: Koziej et al. 2024", millimetres(iliac.internal_width));
            out.push(artery(name, remark, &course, course.stations(), &|_| 0.5 * iliac.internal_width));
        }

        for (name, side, source) in self.side_arteries() {
            let course = self.side_course(&layout, side)?.course;
            let remark = format!("{} mm wide: {source}", millimetres(side.width));
            out.push(artery(name, remark, &course, course.stations(), &|_| 0.5 * side.width));
        }
        Ok(out)
    }

    /// The arteries as branches of a lumen.
    ///
    /// # Errors
    /// [`Error::Range`] for a measure that is not possible.
    pub fn branches(&self) -> Result<Vec<Branch>, Error> {
        self.arteries()?.iter().map(|own| Branch::new(own.name, &own.points, &own.radii)).collect()
    }

    pub(super) fn layout(&self) -> Result<Layout, Error> {
        self.check()?;
        let from_here = |parting: f64| -> Result<[Course; 2], Error> {
            Ok([
                limb(-1.0, &self.left_iliac, parting, &[self.access_length, self.behind_port])?,
                limb(1.0, &self.right_iliac, parting, &[])?,
            ])
        };
        let mut layout = {
            let [left, right] = from_here(PARTED)?;
            let aorta = limb_axes(1.0, 1.0);
            Layout { left, right, aorta, port: Vector3::zeros(), to_port: 0.0, parting: 0.0, below: 0.0 }
        };
        let (parting, point) = layout.lumens_parting(self)?;
        [layout.left, layout.right] = from_here(parting)?;
        layout.aorta.bends = vec![Bend { length: self.length + point.z, turn: [0.0, -self.lordosis] }];
        layout.to_port = layout.left.length() - self.behind_port;
        layout.port = layout.left.place(layout.to_port).point;
        (layout.parting, layout.below) = (parting, -point.z);
        Ok(layout)
    }

    /// Radius (m) of the aorta at this length (m) above the centrelines' parting.
    fn radius(&self, layout: &Layout, station: f64) -> f64 {
        let share = station / (self.celiac.height - layout.below);
        0.5 * (self.bottom_width + (self.top_width - self.bottom_width) * smooth_step(share))
    }

    /// The centreline of a side artery: from the aorta's straight through the middle of the mouth, then bending.
    pub(super) fn side_course(&self, layout: &Layout, side: &SideArtery) -> Result<SideCourse, Error> {
        let station = side.height - layout.below;
        check("height (m) of an artery's mouth above the iliac arteries", station, |v| v > 0.0, "> 0")?;
        let foot = layout.aorta.place(station);
        let right = (Vector3::x() - foot.direction * foot.direction.x).normalize();
        let ventral = foot.direction.cross(&right);
        let outwards = ventral * side.azimuth.cos() + right * side.azimuth.sin();
        let radius = self.radius(layout, station);
        let mouth = foot.point + outwards * radius;
        let down = -foot.direction;
        // The farther up the centreline, the steeper is the straight way to the mouth.
        let start = |at: f64| mouth - layout.aorta.place(at).point;
        let flatter = |at: f64| start(at).angle(&down) > side.angle;
        let [start_at, _] = bisect([station - 2.0 * radius, station + 3.0 * radius], HALVINGS, flatter);
        check(
            "place (m) where an artery's centreline leaves the aorta's",
            start_at,
            |v| (0.0..=layout.aorta.length()).contains(&v),
            "on the aorta's centreline",
        )?;
        let way = start(start_at);
        let (to_mouth, direction) = (way.norm(), way.normalize());
        let aside = down.cross(&direction).normalize();
        let straight = to_mouth + 0.5 * side.width;
        let rest = side.length - 0.5 * side.width;
        let course = Course {
            origin: layout.aorta.place(start_at).point,
            axes: Matrix3::from_columns(&[aside.cross(&down), aside, down]),
            heading: [direction.angle(&down), 0.0],
            bends: vec![
                Bend::straight(straight),
                Bend { length: SIDE_BEND * rest, turn: side.turn },
                Bend::straight((1.0 - SIDE_BEND) * rest),
            ],
        };
        Ok(SideCourse {
            course,
            start: start_at,
            mouth: CentrelinePoint { point: mouth, direction },
            to_mouth,
        })
    }

    fn check(&self) -> Result<(), Error> {
        let mut positive = vec![
            ("width of the aorta's top", self.top_width),
            ("width of the aorta's bottom", self.bottom_width),
            ("length behind the port", self.behind_port),
        ];

        let mut angles = vec![("the lordosis", self.lordosis)];
        for (name, side, _) in self.side_arteries() {
            positive.extend([(name, side.width), (name, side.length - 0.5 * side.width)]);
            angles.extend([side.azimuth, side.turn[0], side.turn[1]].map(|angle| (name, angle)));
            let angle = side.angle.to_degrees();
            let quantity = format!("angle (deg) of the artery \"{name}\"");
            check(&quantity, angle, |v| (20.0..=150.0).contains(&v), "between 20 and 150")?;
        }

        for iliac in [&self.left_iliac, &self.right_iliac] {
            let directions = [iliac.common_direction, iliac.external_direction, iliac.internal_direction];
            angles.extend(directions.into_iter().flatten().map(|angle| ("an iliac artery", angle)));
            positive.extend([
                ("width of a common iliac artery", iliac.common_width),
                ("length of a common iliac artery", iliac.common_length),
                ("width of an external iliac artery", iliac.external_width),
                ("width of an internal iliac artery", iliac.internal_width),
                (
                    "length of an internal iliac artery behind its bend",
                    iliac.internal_length - 0.5 * ILIAC_BEND,
                ),
            ]);
        }

        for (name, value) in positive {
            check(&format!("{name} (m)"), value, |v| v > 0.0, "> 0")?;
        }
        for (name, angle) in angles {
            let quantity = format!("angle (deg) of {name}");
            check(&quantity, angle.to_degrees(), |v| v.abs() <= 180.0, "between -180 and 180")?;
        }

        check("access length (m)", self.access_length, |v| v >= 0.0, ">= 0")?;
        let celiac = self.celiac.height;
        check("length of the aorta (m)", self.length, |v| v > celiac, "beyond the celiac trunk")?;
        Ok(())
    }
}

impl Layout {
    /// Radius (m) of an iliac artery at this length (m) from the centrelines' parting, with this radius (m) there.
    fn iliac_radius(&self, iliac: &Iliac, start: f64, station: f64) -> f64 {
        let (common, external) = (0.5 * iliac.common_width, 0.5 * iliac.external_width);
        let at_fork = (station - self.parting - iliac.common_length) / ILIAC_BEND + 0.5;
        start
            + (common - start) * smooth_step(station / NARROWING)
            + (external - common) * smooth_step(at_fork)
    }

    /// The internal iliac artery: it goes on with the common one and turns away where that forks.
    fn internal(&self, iliac: &Iliac, limb: &Course) -> Course {
        let start = self.parting + iliac.common_length - 0.5 * ILIAC_BEND;
        let [[a, b], [to_a, to_b]] = [iliac.common_direction, iliac.internal_direction];
        Course {
            origin: limb.place(start).point,
            heading: iliac.common_direction,
            bends: vec![
                Bend { length: ILIAC_BEND, turn: [to_a - a, to_b - b] },
                Bend::straight(iliac.internal_length - 0.5 * ILIAC_BEND),
            ],
            ..limb.clone()
        }
    }

    /// Where the lumens of the common iliac arteries part: the length (m) along their centrelines, and the point.
    fn lumens_parting(&self, aorta: &Aorta) -> Result<(f64, Vector3<f64>), Error> {
        let radii = [0.5 * aorta.bottom_width, 0.5 * WITHIN * aorta.bottom_width];
        let iliacs = [&aorta.left_iliac, &aorta.right_iliac];
        let limbs = [&self.left, &self.right];
        let mut branches = Vec::new();
        for side in 0..2 {
            let stations = limbs[side].stations();
            let points: Vec<_> = stations.iter().map(|s| limbs[side].place(*s).point).collect();
            // How long the common iliac artery is follows from here: it goes on.
            let common = Iliac { external_width: iliacs[side].common_width, ..iliacs[side].clone() };
            let radii: Vec<_> =
                stations.iter().map(|s| self.iliac_radius(&common, radii[side], *s)).collect();
            branches.push(Branch::new("common iliac", &points, &radii)?);
        }
        let clearance = |branch: usize, point: &Vector3<f64>| branches[branch].clearance(point).value;
        // Between the centrelines, where both walls are equally near.
        let between = |station: f64| {
            let [left, right] = limbs.map(|limb| limb.place(station).point);
            let at = |share: f64| left + (right - left) * share;
            let nearer_left = |share: f64| clearance(0, &at(share)) > clearance(1, &at(share));
            at(bisect([0.0, 1.0], HALVINGS, nearer_left)[0])
        };
        let open = |station: f64| clearance(0, &between(station)) > 0.0;
        if open(PARTED) {
            let angle = [0, 1].map(|side| iliacs[side].common_direction[0]).iter().sum::<f64>().to_degrees();
            let quantity = "angle (deg) between the common iliac arteries";
            return Err(Error::range(quantity, angle, "so large that they part within 50 mm"));
        }
        let [station, _] = bisect([0.0, PARTED], HALVINGS, open);
        Ok((station, between(station)))
    }
}

/// The iliac artery of one side, from the centrelines' parting downwards; `parting` (m) is its length to that of the lumens.
fn limb(side: f64, iliac: &Iliac, parting: f64, tail: &[f64]) -> Result<Course, Error> {
    let [common, external] = [iliac.common_direction, iliac.external_direction];
    let straight = |name: &str, length: f64| {
        let quantity = format!("straight length (m) of the {name} iliac artery, besides its bends");
        check(&quantity, length, |v| v > 0.0, "> 0").map(Bend::straight)
    };
    let mut course = limb_axes(side, -1.0);
    course.bends = vec![
        Bend { length: PARTING, turn: common },
        straight("common", parting + iliac.common_length - PARTING - 0.5 * ILIAC_BEND)?,
        Bend { length: ILIAC_BEND, turn: [external[0] - common[0], external[1] - common[1]] },
        straight("external", iliac.external_length - 0.5 * ILIAC_BEND - GROIN_BEND)?,
        Bend { length: GROIN_BEND, turn: external.map(|angle| -angle) },
    ];
    course.bends.extend(tail.iter().filter(|length| **length > 0.0).map(|length| Bend::straight(*length)));
    Ok(course)
}

/// No course yet, from the centrelines' parting towards `along` z; angles count to `side` x, and to ventral.
fn limb_axes(side: f64, along: f64) -> Course {
    let axes = Matrix3::from_columns(&[Vector3::x() * side, Vector3::y(), Vector3::z() * along]);
    Course { origin: Vector3::zeros(), axes, heading: [0.0; 2], bends: Vec::new() }
}

/// A length for people.
fn millimetres(length: f64) -> String {
    let rounded = (length * 1e6).round() / 1e3;
    format!("{rounded}")
}
