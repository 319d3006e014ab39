//! Inputs of the model: what acts on the manipulator, world frame, SI units.

use nalgebra::Vector3;
use serde::{Deserialize, Serialize};

use crate::error::{Error, check};
use crate::geometry::{Pose, RotationVector};
use crate::magnetics::{Sources, Wrench};

/// Longest inserted part of a shaft, m.
pub(crate) const LONGEST_INSERTION: f64 = 1.0;

/// Largest arc length that a guidewire reaches, m: that of the longest shaft with the longest device.
pub(crate) const LONGEST_REACH: f64 = 2.0;

/// Maximum lateral deviation of an input step, relative to the previous step, for which extrapolation is used.
const ASIDE: f64 = 0.5;

/// Maximum length of an input step, relative to the previous step, for which extrapolation is used.
const FARTHEST: f64 = 4.0;

/// Pose and strength of a magnet or coil.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct PlacedSource {
    /// Its pose.
    pub pose: Pose,
    /// Factor on a magnet's field, or current through a coil, A; 0 switches it off.
    pub strength: f64,
}

/// Poses and strengths of magnets and coils, background field, base pose and loads.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Inputs {
    /// Magnets and coils, one for each in the order of [`Sources::list`].
    pub sources: Vec<PlacedSource>,
    /// Uniform background field, T.
    pub uniform_field: Vector3<f64>,
    /// Components `dBx/dx, dBx/dy, dBx/dz, dBy/dy, dBy/dz` of a linear field about the world origin, T/m.
    pub field_gradient: [f64; 5],
    /// Clamped base pose; of a device with a shaft, the pose of the port through which that is pushed.
    pub base: Pose,
    /// Length of shaft inside the port, m; without effect where there is no shaft.
    pub insertion: f64,
    /// Push on the shaft at its port, N: the inserted length then follows from it, and `insertion` is where the first solve begins.
    /// `None` where the length is given.
    pub feed_force: Option<f64>,
    /// Turn of what the base clamps, or of the shaft in its port, about its axis, rad.
    pub roll: f64,
    /// Arc length from the port, or from the base without a shaft, that the guidewire reaches, m; without effect where there is none.
    /// What is beyond the tip counts for nothing.
    pub guidewire_insertion: f64,
    /// Force on the tip, N.
    pub tip_force: Vector3<f64>,
    /// Moment on the tip, N m.
    pub tip_moment: Vector3<f64>,
    /// Force at each ring's centre, from base to tip, N; one for each ring of the design.
    pub ring_forces: Vec<Vector3<f64>>,
    /// Acceleration of gravity, m/s2.
    pub gravity: Vector3<f64>,
    /// Uniform widening of the vessel's lumen, m: 0, but for the way from a free shape into a narrow lumen.
    pub widening: f64,
    /// Natural logarithm of the ratio of the wall's modulus to the one that acts: 0, but on the way to a first shape.
    pub softening: f64,
}

impl Inputs {
    /// Inputs without magnet, coil, field or load, base at the origin; `rings` is the number of rings of the design.
    #[must_use]
    pub fn unloaded(rings: usize) -> Self {
        Self {
            sources: Vec::new(),
            uniform_field: Vector3::zeros(),
            field_gradient: [0.0; 5],
            base: Pose::identity(),
            insertion: 0.0,
            feed_force: None,
            roll: 0.0,
            guidewire_insertion: 0.0,
            tip_force: Vector3::zeros(),
            tip_moment: Vector3::zeros(),
            ring_forces: vec![Vector3::zeros(); rings],
            gravity: Vector3::zeros(),
            widening: 0.0,
            softening: 0.0,
        }
    }
}

impl Inputs {
    /// These poses without field, magnet, load or weight: the start of a first solve.
    #[must_use]
    pub fn without_loads(&self) -> Self {
        let Self { base, insertion, roll, guidewire_insertion, .. } = *self;
        let sources = self.sources.iter().map(|source| PlacedSource { strength: 0.0, ..*source }).collect();
        let unloaded = Self::unloaded(self.ring_forces.len());
        Self { sources, base, insertion, roll, guidewire_insertion, ..unloaded }
    }

    /// These inputs without the fixed moment on the tip, the only non-conservative load among them.
    #[must_use]
    pub fn without_moment(&self) -> Self {
        Self { tip_moment: Vector3::zeros(), ..self.clone() }
    }

    /// Pose of what the base clamps, or of the shaft where it enters: the base, rolled about its axis.
    #[must_use]
    pub fn root(&self) -> Pose {
        if self.roll == 0.0 {
            return self.base;
        }
        let turn = RotationVector::new(Vector3::z() * self.roll).matrix();
        Pose { rotation: self.base.rotation * turn, ..self.base }
    }

    /// Wrench of all other sources on each where these inputs place them; see [`Sources::mutual_wrenches`].
    ///
    /// # Errors
    /// As [`Sources::mutual_wrenches`].
    pub fn mutual_wrenches(&self, sources: &Sources) -> Result<Vec<Wrench>, Error> {
        sources
            .mutual_wrenches(|number| self.sources.get(number).map(|placed| (placed.pose, placed.strength)))
    }

    /// Copies `other`, without allocation if it has the same numbers of rings and sources.
    pub fn copy_from(&mut self, other: &Self) {
        let (mut ring_forces, mut sources) =
            (std::mem::take(&mut self.ring_forces), std::mem::take(&mut self.sources));
        ring_forces.clone_from(&other.ring_forces);
        sources.clone_from(&other.sources);
        *self = Self { sources, ring_forces, ..*other };
    }

    /// Interpolates by the fraction `t` towards `other`; orientations turn along the shortest arc.
    #[must_use]
    pub fn between(&self, other: &Self, t: f64) -> Self {
        let mix = |a: &Vector3<f64>, b: &Vector3<f64>| a.lerp(b, t);
        let number = |a: f64, b: f64| a + t * (b - a);
        Self {
            sources: (self.sources.iter().zip(&other.sources))
                .map(|(a, b)| PlacedSource {
                    pose: a.pose.between(&b.pose, t),
                    strength: number(a.strength, b.strength),
                })
                .collect(),
            uniform_field: mix(&self.uniform_field, &other.uniform_field),
            field_gradient: core::array::from_fn(|i| number(self.field_gradient[i], other.field_gradient[i])),
            base: self.base.between(&other.base, t),
            insertion: number(self.insertion, other.insertion),
            feed_force: self.feed_force.zip(other.feed_force).map(|(a, b)| number(a, b)).or(other.feed_force),
            roll: number(self.roll, other.roll),
            guidewire_insertion: number(self.guidewire_insertion, other.guidewire_insertion),
            tip_force: mix(&self.tip_force, &other.tip_force),
            tip_moment: mix(&self.tip_moment, &other.tip_moment),
            ring_forces: self.ring_forces.iter().zip(&other.ring_forces).map(|(a, b)| mix(a, b)).collect(),
            gravity: mix(&self.gravity, &other.gravity),
            widening: number(self.widening, other.widening),
            softening: number(self.softening, other.softening),
        }
    }

    /// Length of the step from `here` to these inputs in units of the previous step, from `before` to `here`. `None` if
    /// it points in another direction or is much longer.
    pub(crate) fn pace(&self, here: &Self, before: &Self) -> Option<f64> {
        let (mut sum, mut moving) = (0.0, 0.0);
        let earlier = here.quantities().zip(before.quantities());
        for ((_, now), ((_, here), (_, before))) in self.quantities().zip(earlier) {
            let (mut last, mut along, mut next) = (0.0, 0.0, 0.0);
            for ((now, here), before) in now.iter().zip(here).zip(before) {
                let (step, then) = (now - here, here - before);
                (last, along, next) = (last + then * then, along + step * then, next + step * step);
            }
            if last + next == 0.0 {
                continue;
            }
            let pace = along / last;
            let ahead = next - pace * along <= ASIDE * ASIDE * last && pace.abs() <= FARTHEST;
            if !ahead {
                return None;
            }
            (sum, moving) = (sum + pace, moving + 1.0);
        }
        (moving > 0.0).then(|| sum / moving)
    }

    /// The components of each quantity, with its name and unit.
    fn quantities(&self) -> impl Iterator<Item = (&'static str, &[f64])> {
        let Self {
            sources,
            uniform_field,
            field_gradient,
            base,
            insertion,
            feed_force,
            roll,
            guidewire_insertion,
            tip_force,
            tip_moment,
            ring_forces,
            gravity,
            widening,
            softening,
        } = self;

        let named = [
            ("uniform field (T)", uniform_field.as_slice()),
            ("field gradient (T/m)", field_gradient),
            ("base position (m)", base.position.as_slice()),
            ("base orientation", base.rotation.as_slice()),
            ("insertion (m)", std::slice::from_ref(insertion)),
            ("feed force (N)", feed_force.as_slice()),
            ("roll (rad)", std::slice::from_ref(roll)),
            ("guidewire insertion (m)", std::slice::from_ref(guidewire_insertion)),
            ("tip force (N)", tip_force.as_slice()),
            ("tip moment (N m)", tip_moment.as_slice()),
            ("gravity (m/s2)", gravity.as_slice()),
            ("widening of the lumen (m)", std::slice::from_ref(widening)),
            ("softening of the wall", std::slice::from_ref(softening)),
        ];

        // Sources come first, in the order of their numbers.
        let sources = sources.iter().flat_map(|source| {
            [
                ("magnet or coil position (m)", source.pose.position.as_slice()),
                ("magnet or coil orientation", source.pose.rotation.as_slice()),
                ("magnet strength or coil current (A)", std::slice::from_ref(&source.strength)),
            ]
        });
        let forces = ring_forces.iter().map(|force| ("ring force (N)", force.as_slice()));
        sources.chain(named).chain(forces)
    }

    /// Checks that every source has its pose and strength, and that no two sources overlap; those that are where they were
    /// in `before` are known to be apart.
    ///
    /// # Errors
    /// [`Error::Count`] where there are more or fewer, [`Error::Unsupported`] for two that overlap.
    pub(crate) fn check_sources(&self, sources: &Sources, before: Option<&Self>) -> Result<(), Error> {
        let (given, needed) = (self.sources.len(), sources.list().len());
        if given == needed {
            return sources.check_apart(|number| {
                let here = |inputs: &Self| {
                    let source = inputs.sources.get(number)?;
                    sources.is_there(number, source.strength).then_some(source.pose)
                };
                let pose = here(self)?;
                Some((pose, before.and_then(here) != Some(pose)))
            });
        }
        let expected = format!("{needed}, one for each magnet and coil");
        Err(Error::Count { quantity: "list of placed sources".into(), given, expected })
    }

    /// Checks that every number is finite and that there is one force for each of `rings` rings.
    ///
    /// # Errors
    /// [`Error::Range`] naming the first quantity that is not finite, [`Error::Count`] for the forces.
    pub fn check(&self, rings: usize) -> Result<(), Error> {
        for (name, values) in self.quantities() {
            for value in values {
                check(name, *value, |_| true, "finite")?;
            }
        }
        check("insertion (m)", self.insertion, |v| (0.0..=LONGEST_INSERTION).contains(&v), "from 0 to 1")?;
        let reach = |v| (0.0..=LONGEST_REACH).contains(&v);
        check("guidewire insertion (m)", self.guidewire_insertion, reach, "from 0 to 2")?;
        let given = self.ring_forces.len();
        if given == rings {
            return Ok(());
        }
        let expected = format!("{rings}, one for each ring");
        Err(Error::Count { quantity: "ring forces".into(), given, expected })
    }
}
