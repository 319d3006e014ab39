//! A scene at other inputs than its own, and with the way to them.

use super::SceneFile;
use super::pose::TURN_AXIS;
use super::sources::{CoilEntries, MagnetEntries};
use super::units::{MM_PER_M, MT_PER_T};
use crate::equilibrium::PlacedSource;
use crate::error::Error;
use crate::geometry::Pose;
use crate::manipulator::Inputs;
use crate::manipulator::way::WayRow;

/// The entries of a table that hold a pose, in the order position, orientation, turn and its axis.
type PoseEntries<'a> = (&'a mut [f64; 3], &'a mut [f64; 4], &'a mut f64, &'a mut [f64; 3]);

fn in_millimetres(pose: &Pose) -> [f64; 3] {
    (pose.position * MM_PER_M).into()
}

/// Writes a pose, whose turn is then part of its orientation.
fn place((position_mm, orientation_wxyz, turn_deg, turn_axis): PoseEntries, pose: &Pose) {
    (*position_mm, *orientation_wxyz) = (in_millimetres(pose), pose.quaternion());
    (*turn_deg, *turn_axis) = (0.0, TURN_AXIS);
}

impl SceneFile {
    /// This scene at these inputs, to which a device comes along the rows of this scene and then along `rows`. What does not differ stays
    /// as it is written.
    ///
    /// ```
    /// use mcm::manipulator::SceneFile;
    /// let file = SceneFile::parse("[design]\nsegments = 1\n[magnet]\nturn_deg = 20", "example")?;
    /// let mut inputs = file.scene()?.inputs;
    /// inputs.sources[0].pose.position.z += 0.01;
    /// let moved = SceneFile::parse(&file.at(&inputs, &[])?.to_toml()?, "moved")?.scene()?.inputs;
    /// let [pose, expected] = [&moved, &inputs].map(|inputs| inputs.sources[0].pose);
    /// assert!((pose.position - expected.position).norm() < 1e-15);
    /// assert!((pose.rotation - expected.rotation).norm() < 1e-15);
    /// # Ok::<(), mcm::error::Error>(())
    /// ```
    ///
    /// # Errors
    /// As [`SceneFile::scene`].
    pub fn at(&self, inputs: &Inputs, rows: &[WayRow]) -> Result<Self, Error> {
        let own = self.scene()?.inputs;
        let mut file = self.clone();
        file.place_sources(&own, inputs);
        file.write_field(&own, inputs);
        if inputs.base != own.base {
            let base = &mut file.base;
            let entries =
                (&mut base.position_mm, &mut base.orientation_wxyz, &mut base.turn_deg, &mut base.turn_axis);
            place(entries, &inputs.base);
        }
        file.write_loads(&own, inputs);
        file.write_feed(&own, inputs);
        file.start.way.extend_from_slice(rows);
        Ok(file)
    }

    /// Writes the magnets and coils that are not where the scene has them.
    fn place_sources(&mut self, own: &Inputs, inputs: &Inputs) {
        let magnets = self.magnet.0.len();

        // An FMU has an external magnet also where the scene has none; while it is off, it has no effect.
        let added = inputs.sources.len().saturating_sub(own.sources.len());
        for placed in inputs.sources.iter().take(added).filter(|placed| placed.strength != 0.0) {
            let mut magnet = MagnetEntries::default();
            magnet.put(placed);
            self.magnet.0.push(magnet);
            self.complete();
        }

        let placed = inputs.sources.iter().skip(added).zip(&own.sources).enumerate();
        for (number, (placed, _)) in placed.filter(|(_, (placed, own))| placed != own) {
            match number.checked_sub(magnets) {
                None => self.magnet.0[number].put(placed),
                Some(coil) => self.coil[coil].put(placed),
            }
        }
    }

    fn write_field(&mut self, own: &Inputs, inputs: &Inputs) {
        if inputs.uniform_field != own.uniform_field {
            self.field.uniform_mt = (inputs.uniform_field * MT_PER_T).into();
            (self.field.turn_deg, self.field.turn_axis) = (0.0, TURN_AXIS);
        }
        self.field.gradient_t_per_m = inputs.field_gradient;
    }

    fn write_loads(&mut self, own: &Inputs, inputs: &Inputs) {
        self.load.tip_force_n = inputs.tip_force.into();
        self.load.tip_moment_nm = inputs.tip_moment.into();
        if inputs.ring_forces != own.ring_forces {
            self.load.ring_force_n = Some(inputs.ring_forces.iter().map(|force| (*force).into()).collect());
        }
    }

    fn write_feed(&mut self, own: &Inputs, inputs: &Inputs) {
        if let Some(feed) = &mut self.feed {
            if inputs.insertion.to_bits() != own.insertion.to_bits() {
                feed.insertion_mm = inputs.insertion * MM_PER_M;
            }
            if inputs.roll.to_bits() != own.roll.to_bits() {
                feed.roll_deg = inputs.roll.to_degrees();
            }
            if inputs.feed_force != own.feed_force {
                feed.force_n = inputs.feed_force;
            }
        }
        if let Some(wire) = &mut self.guidewire
            && inputs.guidewire_insertion.to_bits() != own.guidewire_insertion.to_bits()
        {
            wire.insertion_mm = inputs.guidewire_insertion * MM_PER_M;
        }
    }
}

impl MagnetEntries {
    fn put(&mut self, placed: &PlacedSource) {
        let mut position_mm = [0.0; 3];
        let entries = (&mut position_mm, &mut self.orientation_wxyz, &mut self.turn_deg, &mut self.turn_axis);
        place(entries, &placed.pose);
        (self.position_mm, self.strength) = (Some(position_mm), placed.strength);
    }
}

impl CoilEntries {
    fn put(&mut self, placed: &PlacedSource) {
        self.position_mm = in_millimetres(&placed.pose);
        (self.orientation_wxyz, self.current_a) = (placed.pose.quaternion(), placed.strength);
    }
}
