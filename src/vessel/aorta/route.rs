//! Ways through the arteries: mouths, and the route of a catheter from the port.

use core::f64::consts::PI;

use nalgebra::Vector3;

use super::anatomy::{Aorta, SideArtery};
use super::arteries::SideCourse;
use crate::error::{Error, check};
use crate::geometry::Pose;

/// Distance between the points of a route, m.
const STEP: f64 = 2e-3;

/// The mouth of an artery in the aorta's wall.
#[derive(Debug, Clone, PartialEq)]
pub struct Mouth {
    /// Name of the artery.
    pub name: &'static str,
    /// Its middle, on the aorta's wall, m.
    pub middle: Vector3<f64>,
    /// Direction in which the artery leaves.
    pub direction: Vector3<f64>,
    /// Turn of a device that comes up the aorta and enters it, rad.
    pub turn: f64,
}

/// A way along the arteries' centrelines.
#[derive(Debug, Clone, PartialEq)]
pub struct Route {
    /// Its points, from the port on, m.
    pub points: Vec<Vector3<f64>>,
    /// Its length, m.
    pub length: f64,
}

impl Aorta {
    /// Where the catheter enters: the origin, towards +z.
    #[must_use]
    pub fn port(&self) -> Pose {
        Pose::identity()
    }

    /// The mouths in the aorta's wall, from the head downwards.
    ///
    /// # Errors
    /// [`Error::Range`] for a measure that is not possible.
    pub fn mouths(&self) -> Result<Vec<Mouth>, Error> {
        let layout = self.layout()?;
        let mouth = |(name, side, _): (&'static str, &SideArtery, &str)| {
            let SideCourse { mouth, .. } = self.side_course(&layout, side)?;
            let middle = mouth.point - layout.port;
            Ok(Mouth { name, middle, direction: mouth.direction, turn: PI - side.angle })
        };
        self.side_arteries().into_iter().map(mouth).collect()
    }

    /// The way from the port into a side artery, `depth` (m) behind its mouth.
    ///
    /// It follows the centrelines, so that it has a corner where they meet, inside the aorta.
    ///
    /// ```
    /// use mcm::vessel::Aorta;
    /// let route = Aorta::planar().route("superior mesenteric", 0.0)?;
    /// assert!(route.length > 0.5); // as in the paper's phantom
    /// assert!(Aorta::planar().route("splenic", 0.0).is_err());
    /// # Ok::<(), mcm::error::Error>(())
    /// ```
    ///
    /// # Errors
    /// [`Error::Unsupported`] for a name that no side artery has, [`Error::Range`] for a depth beyond its end and for measures that
    /// are not possible.
    pub fn route(&self, artery: &str, depth: f64) -> Result<Route, Error> {
        let arteries = self.side_arteries();
        let Some((_, side, _)) = arteries.iter().find(|(name, ..)| *name == artery) else {
            let known = arteries.map(|(name, ..)| name).join(", ");
            return Err(Error::Unsupported(format!(
                "no artery \"{artery}\" leaves the aorta; there are {known}"
            )));
        };

        let length = side.length;
        check("depth (m) in the artery", depth, |v| (0.0..=length).contains(&v), "within its length")?;
        let layout = self.layout()?;
        let SideCourse { course, start, to_mouth, .. } = self.side_course(&layout, side)?;

        let lengths = [layout.to_port, start, to_mouth + depth];
        let mut points = Vec::new();

        // Points at equal distances, without the last: that is the next part's first.
        let mut add = |length: f64, place: &dyn Fn(f64) -> Vector3<f64>| {
            let count = (length / STEP).ceil();
            let mut step = 0.0;
            while step < count {
                points.push(place(length * step / count) - layout.port);
                step += 1.0;
            }
        };

        // The left iliac artery runs downwards from the parting, hence backwards here.
        add(lengths[0], &|at| layout.left.place(lengths[0] - at).point);
        add(lengths[1], &|at| layout.aorta.place(at).point);
        add(lengths[2], &|at| course.place(at).point);

        points.push(course.place(lengths[2]).point - layout.port);
        Ok(Route { points, length: lengths.iter().sum() })
    }
}
