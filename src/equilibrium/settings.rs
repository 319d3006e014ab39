//! All knobs of the equilibrium, in one place.

/// What acts on what inside the manipulator.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Interaction {
    /// External field only.
    None,
    /// Every ring's field acts on all bodies after it, but not on the disc bonded to its face: the model of
    /// Richter et al., without reaction.
    Preceding,
    /// All pairs of rings, mutual.
    Rings,
}

/// Settings of the model and its solver.
#[derive(Debug, Clone, PartialEq)]
pub struct Settings {
    /// Level of local interaction; default [`Interaction::Rings`].
    pub interaction: Interaction,
}

impl Default for Settings {
    fn default() -> Self {
        Self { interaction: Interaction::Rings }
    }
}
