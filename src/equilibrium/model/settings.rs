//! Settings of the model and its solver, in one place.

use serde::{Deserialize, Serialize};

use super::quantities;
use crate::error::{Error, check};

/// Level of magnetic interaction inside the manipulator. Its number is that of the FMU's enumeration.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
pub enum Interaction {
    /// External field only.
    None = 0,
    /// The field of every ring acts on all bodies distal to it, except the disc bonded to its face, without reaction: the
    /// model of Richter et al.
    Preceding = 1,
    /// Mutual interaction of all pairs of rings.
    Rings = 2,
    /// Mutual interaction of all pairs of rings, and of every ring with every span except the disc bonded to its face.
    /// The interaction of spans with one another is neglected.
    Full = 3,
    /// The cheapest of several models that agrees within the tolerances with the richest one: [`Self::Full`] with bending
    /// stop.
    Auto = 4,
}

impl Interaction {
    /// Every level, with its name in scene files and in the FMU and its description in the FMU. A level that is not in
    /// this table is not available to users.
    pub const ALL: &[(Self, &str, &str)] = &[
        (Self::None, "none", "External field only"),
        (Self::Preceding, "preceding", "Every ring's field acts on all bodies after it, without reaction"),
        (Self::Rings, "rings", "All pairs of rings, mutual"),
        (Self::Full, "full", "All pairs of rings, and every ring with every span, mutual"),
        (Self::Auto, "auto", "As much as the tolerances need, up to full with bending stop"),
    ];

    /// Whether rings act on spans.
    #[must_use]
    pub fn acts_on_spans(self) -> bool {
        matches!(self, Self::Preceding | Self::Full)
    }

    /// The level with this name.
    ///
    /// ```
    /// use mcm::equilibrium::Interaction;
    /// assert_eq!(Interaction::named("rings"), Some(Interaction::Rings));
    /// assert_eq!(Interaction::named("rigns"), None);
    /// ```
    #[must_use]
    pub fn named(name: &str) -> Option<Self> {
        Self::ALL.iter().find(|row| row.1 == name).map(|row| row.0)
    }

    /// The name of the level in scene files, on the command line and in the FMU.
    #[must_use]
    pub fn name(self) -> &'static str {
        Self::ALL.iter().find(|row| row.0 == self).map_or("", |row| row.1)
    }
}

/// Settings of the model and its solver.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Settings {
    /// Level of local interaction; default [`Interaction::Rings`].
    pub interaction: Interaction,
    /// Largest deviation of a manipulator's tip position from the converged solution of the model, m; default 5e-5, a
    /// thousandth of the length of nine segments like the paper's: a twentieth of what the model itself is uncertain by. Where
    /// the deviation is larger, a finer discretisation is solved; [`Interaction::Auto`] also chooses the interaction by
    /// it.
    pub tolerance_position: f64,
    /// Largest rotation of the tip relative to the converged solution, rad; default 0.1 deg.
    pub tolerance_angle: f64,
    /// Largest deviation of a manipulator's tip position, relative to the tip's distance from its unloaded place; default 1e-3; 0: none.
    /// The smaller of this and [`Settings::tolerance_position`] holds, where this is never less than 1e-8 m.
    pub tolerance_relative: f64,
    /// Whether a core is as stiff as its closed section once it has bent by its boundary angle, because adjacent windings
    /// touch. By default (`None`) the level decides, see [`Settings::has_bending_stop`].
    pub bending_stop: Option<bool>,
    /// Highest polynomial degree of the strain modes of a segment, 0 to 8; default 2. Four degrees are added where rings
    /// act on spans, and a manipulator adds two or four where its tolerances need them.
    pub degree: usize,
    /// Number of elements of a plain cylinder, 1 to 64; default 8.
    pub cylinder_elements: usize,
    /// Largest quadrature error of magnetic energies, relative; default 1e-5. For a ring or a span in a field, it is
    /// relative to that energy; for two rings, to the energy of two dipoles one ring width apart.
    ///
    /// Force, torque and energy of two rings like the paper's are good to a tenth of it, down to gaps of a fortieth of
    /// the outer radius: by default to 1e-6 at every gap from 0.1 mm to 40 mm (worst measured 7e-7). The quadrature uses
    /// nodes on the axis, at most 15, from 3.9 mm between the faces of the paper's rings on, and the magnetic charges on
    /// the faces where they are closer. The smallest error that can be reached is 1e-10.
    pub pair_accuracy: f64,
    /// Whether spans have as many stations as a reference in a field that is not uniform needs; default no. Nine segments beside the
    /// magnet pair: the tip is within 4e-7 of the length without, within 5e-10 with them.
    pub fine_stations: bool,
    /// Residual at which a shape counts as solved, in the radian norm (1: one element turned by a radian); default 1e-11.
    /// The cheaper models of the level `auto` stop at up to 1e4 times as much, as their errors allow.
    pub tolerance: f64,
    /// Largest first Newton step when a branch is followed, in the radian norm; default 0.5.
    pub follow_step: f64,
    /// Smallest fraction of an input change that is tried before a fold is assumed; default 1/4096.
    pub smallest_part: f64,
    /// Stability margin below which a shape counts as close to a fold; default 0.05.
    pub fold_margin: f64,
    /// Maximum number of iterations of one solve, beyond which it fails; default 1500. Most solves are limited by their
    /// time instead.
    pub iterations: u32,
    /// Processor time that one solve may take, s; default 1. A solve that needs more ends as
    /// [`crate::equilibrium::Outcome::OutOfBudget`]; the last good shape is kept.
    pub time_budget: f64,
    /// Whether the wrench of magnets and coils on one another is an output; default no. It has no influence on the equilibrium.
    pub mutual_wrenches: bool,
}

impl Default for Settings {
    fn default() -> Self {
        Self {
            interaction: Interaction::Rings,
            tolerance_position: 5e-5,
            tolerance_angle: 0.1 * core::f64::consts::PI / 180.0,
            tolerance_relative: 1e-3,
            bending_stop: None,
            degree: 2,
            cylinder_elements: 8,
            pair_accuracy: 1e-5,
            fine_stations: false,
            tolerance: 1e-11,
            follow_step: 0.5,
            smallest_part: 1.0 / 4096.0,
            fold_margin: 0.05,
            iterations: 1500,
            time_budget: 1.0,
            mutual_wrenches: false,
        }
    }
}

impl Settings {
    /// Whether the model has the bending stop: as told or, if nothing is told, at the level [`Interaction::Auto`] alone, as the
    /// paper's model has none.
    #[must_use]
    pub fn has_bending_stop(&self) -> bool {
        self.bending_stop.unwrap_or(self.interaction == Interaction::Auto)
    }

    /// These settings without tolerances of the tip: the discretisation is exactly the one that the settings specify.
    #[must_use]
    pub fn as_discretised(&self) -> Self {
        Self { tolerance_position: f64::MAX, tolerance_angle: f64::MAX, tolerance_relative: 0.0, ..*self }
    }

    /// Checks all settings and returns them.
    ///
    /// # Errors
    /// [`Error::Range`] naming the first setting out of range.
    pub fn checked(self) -> Result<Self, Error> {
        let positive = |value: f64| value > 0.0;
        quantities::TOLERANCE_POSITION.check(self.tolerance_position)?;
        quantities::TOLERANCE_ANGLE.check(self.tolerance_angle)?;
        quantities::TOLERANCE_RELATIVE.check(self.tolerance_relative)?;
        quantities::ITERATIONS.check(f64::from(self.iterations))?;
        quantities::TIME_BUDGET.check(self.time_budget)?;

        check("degree of the strain modes", self.degree as f64, |v| v <= 8.0, "from 0 to 8")?;
        check(
            "number of cylinder elements",
            self.cylinder_elements as f64,
            |v| (1.0..=64.0).contains(&v),
            "from 1 to 64",
        )?;
        check(
            "accuracy of the ring pairs",
            self.pair_accuracy,
            |v| (1e-14..0.1).contains(&v),
            "from 1e-14 to 0.1",
        )?;
        check(
            "tolerance of the residual",
            self.tolerance,
            |v| (1e-13..1e-3).contains(&v),
            "from 1e-13 to 1e-3",
        )?;
        check("largest step of the branch following", self.follow_step, positive, "> 0")?;
        check("smallest part of an input change", self.smallest_part, |v| v > 0.0 && v <= 1.0, "in (0, 1]")?;
        check(
            "margin that counts as close to a fold",
            self.fold_margin,
            |v| (0.0..1.0).contains(&v),
            "in [0, 1)",
        )?;
        Ok(self)
    }
}
