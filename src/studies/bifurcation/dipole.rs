//! One core with a dipole at its tip, whose folds are known in closed form.
//!
//! The field's torque bends the core to an arc: `theta = Lam sin(phi - theta)`. `Lam` is the field in units of the
//! core's bending stiffness (N m/rad) over the dipole's moment, `phi` the field's angle from the base's axis.

use core::f64::consts::PI;

use nalgebra::Vector3;

use super::case::{Case, turned_in_plane};
use crate::design::{Design, Ring, Segmented, Specification};
use crate::equilibrium::{Inputs, Interaction, Settings};
use crate::error::Error;
use crate::numerics::bisection::bisect;

/// Strength `Lam` of the turning field.
const LAM: f64 = 1.5;

/// Direction of the growing field, deg: one degree off antiparallel.
pub(super) const ASIDE: f64 = 179.0;

/// Largest strength of the growing field, mT.
const LARGEST: f64 = 75.0;

/// The field of `Lam = 1`, T, and the device.
fn device() -> Result<(f64, Design), Error> {
    let Specification::Segmented(paper) = Specification::paper(1) else {
        return Err(Error::Unsupported("the paper's design has no segments".into()));
    };
    let mut bare = Segmented { base_magnet: false, ..paper };
    bare.helix.particle_remanence = 0.0;
    let design = Design::new(Specification::Segmented(bare))?;
    let spans = design.segments().iter().flat_map(|segment| &segment.spans);
    let compliance: f64 = spans.map(|span| span.length / span.stiffness.bending).sum();
    let moment: f64 = design.rings().map(Ring::moment).sum();
    Ok((1.0 / (moment * compliance), design))
}

/// Inputs with a field (T) at `degrees` from the base's axis towards +y.
fn field(size: f64, degrees: f64) -> Inputs {
    let (sine, cosine) = degrees.to_radians().sin_cos();
    Inputs { uniform_field: Vector3::new(0.0, sine, cosine) * size, ..Inputs::unloaded(1) }
}

fn case(design: Design, way: super::case::Way, path: [f64; 2]) -> Case {
    let settings = Settings { interaction: Interaction::None, ..Settings::default() };
    Case { design, magnet: None, settings, way, path, angle: turned_in_plane, points: 300 }
}

/// A turning field of `Lam` 1.5; the path parameter is its direction, deg.
pub(super) fn turning() -> Result<Case, Error> {
    let (unit, design) = device()?;
    Ok(case(design, Box::new(move |degrees| field(LAM * unit, degrees)), [60.0, 300.0]))
}

/// A growing field in the given direction (deg); the path parameter is its strength, mT.
pub(super) fn growing(degrees: f64) -> Result<Case, Error> {
    let (_, design) = device()?;
    Ok(case(design, Box::new(move |millitesla| field(1e-3 * millitesla, degrees)), [0.0, LARGEST]))
}

/// Direction of the field at which the arc folds in its plane, deg: `cos(phi - theta) = -1/Lam`.
pub(super) fn fold_of_turning() -> f64 {
    ((LAM * LAM - 1.0).sqrt() + (-1.0 / LAM).acos()).to_degrees()
}

/// The antiparallel field that buckles the straight core, mT: `Lam = 1`.
pub(super) fn critical_field() -> Result<f64, Error> {
    Ok(1e3 * device()?.0)
}

/// Smallest field in the direction [`ASIDE`] that holds an arc bent to the other side, mT:
/// `Lam = theta/sin(phi - theta)` is smallest where `tan(phi - theta) = -theta`.
pub(super) fn fold_aside() -> Result<f64, Error> {
    let phi = ASIDE.to_radians();
    // On the other side theta is negative; the function rises through its only zero.
    let slope = |theta: f64| (phi - theta - PI).tan() + theta;
    let [low, _] = bisect([-1.0, 0.0], 60, |theta| slope(theta) > 0.0);
    Ok(critical_field()? * low / (phi - low).sin())
}
