//! A scene's manipulator, solved by the method that the scene names.

use super::{Compared, Method, Settings};
use crate::design::Specification;
use crate::error::Error;
use crate::manipulator::{Followed, Inputs, Jacobian, Manipulator, Outputs, POTENTIAL, Scene, Snapshot};

/// A manipulator solved by any method.
///
/// ```
/// use mcm::manipulator::{Followed, Scene};
/// use mcm::methods::Device;
/// let text = "[design]\nsegments = 1\n[field]\nuniform_mt = [0, 20, 0]\n[model]\ninteraction = \"rings\"\n";
/// let angle = |method: &str| {
///     let scene = Scene::parse(&format!("{text}method = \"{method}\""), "example")?;
///     Ok::<f64, mcm::error::Error>(Device::of(&scene, 2)?.solve(&scene.inputs)?.tip_angle)
/// };
/// assert!((angle("shooting")? - angle("potential")?).abs() < 1e-6);
/// # Ok::<(), mcm::error::Error>(())
/// ```
#[derive(Debug, Clone)]
pub enum Device {
    /// By the potential method.
    Potential(Box<Manipulator>),
    /// By another method, to compare with.
    Compared(Box<Compared>),
}

/// Calls a method on whichever manipulator there is.
macro_rules! on {
    ($device:expr, $manipulator:ident => $call:expr) => {
        match $device {
            Self::Potential($manipulator) => $call,
            Self::Compared($manipulator) => $call,
        }
    };
}

impl Device {
    /// The manipulator of a scene by the method that it names, unsolved; `shape_points` is the number of centreline points in its
    /// outputs.
    ///
    /// # Errors
    /// As [`Device::new`].
    pub fn of(scene: &Scene, shape_points: usize) -> Result<Self, Error> {
        let method = Method::named(&scene.method).unwrap_or(Method::Potential);
        Self::new(scene, Settings { method, ..Settings::default() }, shape_points)
    }

    /// The manipulator of a scene by the method of these settings, unsolved.
    ///
    /// # Errors
    /// As [`Scene::manipulator`] and [`Compared::new`]; [`Error::Unsupported`] for a vessel, a shaft or a way with another method than the
    /// potential method.
    pub fn new(scene: &Scene, settings: Settings, shape_points: usize) -> Result<Self, Error> {
        if settings.method == Method::Potential {
            return Ok(Self::Potential(Box::new(scene.manipulator(shape_points)?)));
        }

        let given = settings.method.name();
        if scene.vessel.is_some() || scene.shaft.is_some() {
            return Err(Error::Unsupported(format!(
                "a vessel and a shaft need method \"{POTENTIAL}\", not \"{given}\""
            )));
        }
        if let Some(what) = unknown_to_methods(&scene.specification) {
            return Err(Error::Unsupported(format!("{what} need method \"{POTENTIAL}\", not \"{given}\"")));
        }
        if !scene.way.is_empty() {
            return Err(Error::Unsupported(format!(
                "start.way needs method \"{POTENTIAL}\", not \"{given}\""
            )));
        }

        let compared =
            Compared::new(&scene.design()?, &scene.sources, scene.settings, settings, shape_points)?;
        Ok(Self::Compared(Box::new(compared)))
    }

    /// The method that solves.
    #[must_use]
    pub fn method(&self) -> Method {
        match self {
            Self::Potential(_) => Method::Potential,
            Self::Compared(compared) => compared.settings().method,
        }
    }

    /// Resets the shape and the count of snaps.
    pub fn reset(&mut self) {
        on!(self, own => own.reset());
    }

    /// Computes tangents and curvatures of the shape.
    pub fn measure_strains(&mut self) -> &Outputs {
        on!(self, own => own.measure_strains())
    }

    /// Derivatives of the outputs by the inputs.
    ///
    /// # Errors
    /// As [`Manipulator::jacobian`]; [`Error::NoDerivatives`] for any other method.
    pub fn jacobian(&self) -> Result<Jacobian, Error> {
        let own = self.method().name();
        self.manipulator().map_or_else(
            || {
                Err(Error::NoDerivatives(format!(
                    "method \"{own}\" has no derivatives: choose \"{POTENTIAL}\""
                )))
            },
            Manipulator::jacobian,
        )
    }

    /// The manipulator that solves by the potential method; `None` for any other.
    #[must_use]
    pub fn manipulator(&self) -> Option<&Manipulator> {
        match self {
            Self::Potential(manipulator) => Some(manipulator),
            Self::Compared(_) => None,
        }
    }
}

impl Followed for Device {
    fn solve(&mut self, inputs: &Inputs) -> Result<&Outputs, Error> {
        on!(self, own => own.solve(inputs))
    }

    fn outputs(&self) -> &Outputs {
        on!(self, own => own.outputs())
    }

    fn start_anew(&mut self) {
        on!(self, own => own.start_anew());
    }

    fn time_budget(&self) -> f64 {
        on!(self, own => own.time_budget())
    }

    fn set_time_budget(&mut self, seconds: f64) {
        on!(self, own => own.set_time_budget(seconds));
    }

    fn measure_margin(&mut self) -> &Outputs {
        on!(self, own => own.measure_margin())
    }

    fn snapshot(&self) -> Option<Snapshot> {
        on!(self, own => Followed::snapshot(own.as_ref()))
    }

    fn restore(&mut self, snapshot: &Snapshot) -> Result<(), Error> {
        on!(self, own => own.restore(snapshot))
    }
}

/// What the other methods do not know about a device; `None` where they know all of it.
fn unknown_to_methods(specification: &Specification) -> Option<&'static str> {
    match specification {
        Specification::Sections(_) => Some("devices of kind \"sections\""),
        Specification::Segmented(chain) => {
            let across = chain.ring.direction.is_some() || !chain.ring_directions.is_empty();
            across.then_some("rings with a direction")
        }
        Specification::Cylinder(_) => None,
    }
}
