//! The wall of the vessel: loads of contact on rods, tips and the rims of rings.

use nalgebra::{Matrix3, Vector3, Vector6};

use crate::equilibrium::model::Inputs;
use crate::geometry::{Pose, hat};
use crate::rod::Load;
use crate::vessel::{Clearance, Lumen, Vessel, Wall};

/// Directions in which a rim in a narrow place is looked at for contact on other sides.
const SIDES: usize = 6;

/// Newton steps to the place of a rim that is the deepest in the wall.
const STEPS: usize = 25;

/// Step (rad) at which that place is found.
const FOUND: f64 = 1e-10;

/// Newton steps that the deepest place of a rim may still be away, counted generously.
const AWAY: f64 = 4.0;

/// Longest Newton step, rad.
const LONGEST: f64 = 0.5;

/// Angle (rad) within which two places of a rim are one.
const SAME: f64 = 0.1;

/// Least second derivative of a rim's clearance by its angle, relative to its radius: a face that lies flat against a wall
/// touches everywhere.
const FLAT: f64 = 0.02;

/// The wall, with the lumen as wide as the inputs say.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Walls<'a> {
    lumen: &'a Lumen,
    wall: Wall,
    /// Uniform widening of the lumen, m.
    widening: f64,
}

/// Contact at one place.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Touch {
    /// The load on the frame, in world axes.
    pub(crate) load: Load,
    /// The place on the wall, world axes, m.
    pub(crate) at: Vector3<f64>,
    /// Depth in the wall, m.
    pub(crate) depth: f64,
    /// Stiffness, N/m.
    pub(crate) stiffness: f64,
    /// From the frame's origin to where the wall is touched, m, world axes.
    pub(crate) arm: Vector3<f64>,
}

impl<'a> Walls<'a> {
    pub(super) fn new(vessel: &'a Vessel, inputs: &Inputs) -> Self {
        let wall = vessel.wall.softened(inputs.softening);
        Self { lumen: &vessel.lumen, wall, widening: inputs.widening }
    }

    /// Distance of a point from the wall.
    pub(crate) fn clearance(&self, point: &Vector3<f64>) -> Clearance {
        let own = self.lumen.clearance(point);
        Clearance { value: own.value + self.widening, ..own }
    }

    /// Depth at which contact has set in, m.
    pub(crate) fn onset(&self) -> f64 {
        self.wall.onset()
    }

    /// A length `weight` (m) of a rod of this radius with its centreline at `point`.
    pub(crate) fn rod(&self, point: &Vector3<f64>, radius: f64, weight: f64) -> Touch {
        let clearance = self.clearance(point);
        let depth = radius - clearance.value;
        let law = self.wall.line(depth).map(|value| weight * value);
        on_centre(point, &clearance, radius, law)
    }

    /// The round end of a rod of this radius at `point`.
    pub(crate) fn tip(&self, point: &Vector3<f64>, radius: f64) -> Touch {
        let clearance = self.clearance(point);
        let depth = radius - clearance.value;
        on_centre(point, &clearance, radius, self.wall.ball(radius, depth))
    }

    /// All contacts of a rim of this radius around the axis of `frame`, at `height` (m) from its origin.
    pub(crate) fn rim(&self, frame: &Pose, height: f64, radius: f64, found: &mut Vec<Touch>) {
        let centre = frame.advanced(height).position;
        let clearance = self.clearance(&centre);
        // Of a wider place nothing on the rim can touch.
        if clearance.value >= radius + self.lumen.rounding() {
            return;
        }
        let rim = Rim { walls: self, frame, height, radius };
        let [d1, d2]: [Vector3<f64>; 2] = core::array::from_fn(|i| frame.rotation.column(i).into_owned());
        let towards = f64::atan2(-clearance.gradient.dot(&d2), -clearance.gradient.dot(&d1));
        let mut places = vec![towards];
        // Elsewhere on the rim nothing is nearer than its distance from where the clearance is known.
        let around = |count: usize| {
            (1..count).map(move |i| towards + core::f64::consts::TAU * i as f64 / count as f64)
        };
        let free = |angle: f64| self.clearance(&rim.place(angle)).value > radius;
        if !around(3).all(free) {
            places.extend(around(SIDES));
        }
        let mut angles: Vec<f64> = Vec::new();
        for start in places {
            let Some((angle, clearance)) = rim.deepest(start) else { continue };
            let apart = |other: &f64| (angle - other).sin().abs() > SAME || (angle - other).cos() < 0.0;
            if clearance.value < 0.0 && angles.iter().all(apart) {
                angles.push(angle);
                let law = self.wall.ball(radius, -clearance.value);
                found.push(rim.touch(angle, &clearance, law));
            }
        }
    }
}

/// Contact of a body of this radius by the distance of the frame's origin alone: energy, force and stiffness of the law.
fn on_centre(
    centre: &Vector3<f64>,
    clearance: &Clearance,
    radius: f64,
    [energy, force, stiffness]: [f64; 3],
) -> Touch {
    let Clearance { value, gradient, hessian } = clearance;
    let load = Load {
        energy,
        force: gradient * -force,
        position_position: gradient * gradient.transpose() * stiffness - hessian * force,
        stiff: true,
        ..Load::zero()
    };
    Touch { load, at: centre - gradient * *value, depth: radius - value, stiffness, arm: gradient * -radius }
}

/// A rim in a vessel.
struct Rim<'a> {
    walls: &'a Walls<'a>,
    frame: &'a Pose,
    height: f64,
    radius: f64,
}

impl Rim<'_> {
    /// From the axis to the place at `angle`, and how that moves with the angle.
    fn arm(&self, angle: f64) -> [Vector3<f64>; 2] {
        let (sine, cosine) = angle.sin_cos();
        [Vector3::new(cosine, sine, 0.0), Vector3::new(-sine, cosine, 0.0)]
            .map(|local| self.frame.rotation * local * self.radius)
    }

    fn place(&self, angle: f64) -> Vector3<f64> {
        self.frame.advanced(self.height).position + self.arm(angle)[0]
    }

    /// The place near `start` where the rim is nearest to the wall, by Newton's method; where the wall is out of reach, a place
    /// on the way; `None` where there is none.
    fn deepest(&self, start: f64) -> Option<(f64, Clearance)> {
        let mut angle = start;
        for _ in 0..STEPS {
            let [out, along] = self.arm(angle);
            let clearance = self.walls.clearance(&self.place(angle));
            let slope = clearance.gradient.dot(&along);
            let bend = self.bend(&clearance, [&out, &along]);
            let step = (slope / bend).clamp(-LONGEST, LONGEST);
            // The clearance changes by no more than the distance.
            let free = step.abs() < LONGEST && clearance.value > AWAY * self.radius * step.abs();
            if step.abs() < FOUND || free {
                return Some((angle, clearance));
            }
            angle -= step;
        }
        None
    }

    /// Second derivative of the clearance by the angle, of a place from which it increases to both sides.
    fn bend(&self, clearance: &Clearance, [out, along]: [&Vector3<f64>; 2]) -> f64 {
        let bend = along.dot(&(clearance.hessian * along)) - clearance.gradient.dot(out);
        bend.max(FLAT * self.radius)
    }

    /// The load of contact at the place that is nearest to the wall: with the frame, that place moves along the rim.
    fn touch(&self, angle: f64, clearance: &Clearance, [energy, force, stiffness]: [f64; 3]) -> Touch {
        let [out, along] = self.arm(angle);
        let Clearance { gradient, hessian, value } = clearance;
        let arm = self.place(angle) - self.frame.position;
        let lever = hat(&arm);
        let twist = |force: &Vector3<f64>| -> Vector6<f64> {
            let moment = arm.cross(force);
            Vector6::new(force.x, force.y, force.z, moment.x, moment.y, moment.z)
        };

        // Of the clearance by the frame's motion; `moved` is what that changes in its slope along the rim.
        let slope = twist(gradient);
        let mut moved = twist(&(hessian * along));
        let turned = along.cross(gradient);
        (0..3).for_each(|i| moved[3 + i] += turned[i]);
        let bend = self.bend(clearance, [&out, &along]);

        let mut load = Load {
            energy,
            force: gradient * -force,
            couple: gradient * arm.transpose() * -force,
            ..Load::zero()
        };

        // The deepest place slides along the rim (Schur complement of its angle).
        let second = slope * slope.transpose() * stiffness + moved * moved.transpose() * (force / bend);
        let block =
            |i: usize, j: usize| -> Matrix3<f64> { second.fixed_view::<3, 3>(3 * i, 3 * j).into_owned() };
        load.position_position = block(0, 0) - hessian * force;
        load.position_rotation = block(0, 1) + hessian * lever * force;
        load.rotation_rotation = block(1, 1) + lever * hessian * lever * force;
        load.stiff = true;
        Touch { load, at: self.place(angle), depth: -value, stiffness, arm }
    }
}
