//! What acts on the manipulator, world frame, SI units.

use nalgebra::Vector3;
use serde::{Deserialize, Serialize};

use crate::error::{Error, check};
use crate::geometry::Pose;

/// Pose and strength of the external magnet, background field, base pose and loads.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Inputs {
    /// Pose of the external magnet assembly.
    pub magnet: Pose,
    /// Factor on the assembly's field; 0 switches it off.
    pub magnet_strength: f64,
    /// Uniform background field, T.
    pub uniform_field: Vector3<f64>,
    /// `dBx/dx, dBx/dy, dBx/dz, dBy/dy, dBy/dz` of a linear field about the world origin, T/m.
    pub field_gradient: [f64; 5],
    /// Clamped base pose.
    pub base: Pose,
    /// Force on the tip, N.
    pub tip_force: Vector3<f64>,
    /// Moment on the tip, N m.
    pub tip_moment: Vector3<f64>,
    /// Force at each ring's centre, base to tip, N; as many as the design has rings.
    pub ring_forces: Vec<Vector3<f64>>,
    /// Acceleration of gravity, m/s2.
    pub gravity: Vector3<f64>,
}

impl Inputs {
    /// Nothing acts: no field, no load, base at the origin; `rings` is the number of rings of the design.
    #[must_use]
    pub fn unloaded(rings: usize) -> Self {
        Self {
            magnet: Pose::identity(),
            magnet_strength: 0.0,
            uniform_field: Vector3::zeros(),
            field_gradient: [0.0; 5],
            base: Pose::identity(),
            tip_force: Vector3::zeros(),
            tip_moment: Vector3::zeros(),
            ring_forces: vec![Vector3::zeros(); rings],
            gravity: Vector3::zeros(),
        }
    }
}

impl Inputs {
    /// The same poses without field, magnet, load or weight: where a first solve starts.
    #[must_use]
    pub fn without_loads(&self) -> Self {
        Self { magnet: self.magnet, base: self.base, ..Self::unloaded(self.ring_forces.len()) }
    }

    /// Takes over `other`, without allocating if it has as many rings.
    pub fn copy_from(&mut self, other: &Self) {
        let mut ring_forces = std::mem::take(&mut self.ring_forces);
        ring_forces.clone_from(&other.ring_forces);
        *self = Self { ring_forces, ..*other };
    }

    /// The inputs a fraction `t` of the way to `other`; orientations turn along the shortest arc.
    #[must_use]
    pub fn between(&self, other: &Self, t: f64) -> Self {
        let mix = |a: &Vector3<f64>, b: &Vector3<f64>| a.lerp(b, t);
        let number = |a: f64, b: f64| a + t * (b - a);
        Self {
            magnet: self.magnet.between(&other.magnet, t),
            magnet_strength: number(self.magnet_strength, other.magnet_strength),
            uniform_field: mix(&self.uniform_field, &other.uniform_field),
            field_gradient: core::array::from_fn(|i| number(self.field_gradient[i], other.field_gradient[i])),
            base: self.base.between(&other.base, t),
            tip_force: mix(&self.tip_force, &other.tip_force),
            tip_moment: mix(&self.tip_moment, &other.tip_moment),
            ring_forces: self.ring_forces.iter().zip(&other.ring_forces).map(|(a, b)| mix(a, b)).collect(),
            gravity: mix(&self.gravity, &other.gravity),
        }
    }

    /// Checks that every number is finite and that there is one force for each of `rings` rings.
    ///
    /// # Errors
    /// [`Error::Range`] naming the first quantity that is not finite, [`Error::Count`] for the forces.
    pub fn check(&self, rings: usize) -> Result<(), Error> {
        let vectors = [
            ("magnet position (m)", self.magnet.position),
            ("uniform field (T)", self.uniform_field),
            ("base position (m)", self.base.position),
            ("tip force (N)", self.tip_force),
            ("tip moment (N m)", self.tip_moment),
            ("gravity (m/s2)", self.gravity),
        ];
        let named = vectors.iter().map(|(name, vector)| (*name, vector));
        for (name, vector) in named.chain(self.ring_forces.iter().map(|force| ("ring force (N)", force))) {
            for value in vector.iter() {
                check(name, *value, |_| true, "finite")?;
            }
        }
        for (name, pose) in [("magnet orientation", &self.magnet), ("base orientation", &self.base)] {
            for value in pose.rotation.iter() {
                check(name, *value, |_| true, "finite")?;
            }
        }
        check("magnet strength", self.magnet_strength, |_| true, "finite")?;
        for value in self.field_gradient {
            check("field gradient (T/m)", value, |_| true, "finite")?;
        }
        if self.ring_forces.len() == rings {
            return Ok(());
        }
        let expected = format!("{rings}, one for each ring");
        Err(Error::Count { quantity: "ring forces".into(), given: self.ring_forces.len(), expected })
    }
}
