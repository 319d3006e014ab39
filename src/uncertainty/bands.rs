//! Bands of first order.

use nalgebra::{DMatrix, DVector};

use crate::error::Error;
use crate::manipulator::{Manipulator, Neighbours, Outputs, SceneFile, Sensitivities, Uncertainty};

/// Standard deviations on each side of the mean between which 95 % of a normal distribution lie.
pub const COVERAGE: f64 = 1.959_963_984_540_054;

/// Distance of a fold, in standard deviations, below which bands of first order are no ellipse: by the margin's own uncertainty the
/// device of one in seven hundred has snapped.
const NEAR: f64 = 3.0;

/// Bands of 95 % of all outputs at one equilibrium, of first order in the uncertainty of the scene's numbers.
///
/// With the sensitivities `S = dy/dp` of an output and the covariance `C` of the numbers, its variance is `S C S^T`.
///
/// ```
/// use mcm::manipulator::SceneFile;
/// use mcm::uncertainty::Bands;
/// let text = "[design]\nsegments = 1\n[field]\nuniform_mt = [0, 10, 0]\n[uncertainty]\n\"design.helix.shore_a\" = 1.0";
/// let file = SceneFile::parse(text, "example")?;
/// let scene = file.scene()?;
/// let mut manipulator = scene.manipulator(2)?;
/// manipulator.solve(&scene.inputs)?;
/// let bands = Bands::new(&file, &manipulator)?;
/// let band = bands.band(|outputs| outputs.tip_angle).to_degrees();
/// // A Shore degree is 5 to 6 % of the stiffness, and so of 23.3 deg; 95 % lie within 1.96 deviations.
/// assert!((band - 1.96 * 0.0565 * 23.3).abs() < 0.1, "{band}"); // deg, on each side
/// # Ok::<(), mcm::error::Error>(())
/// ```
#[derive(Debug, Clone, PartialEq)]
pub struct Bands {
    uncertainty: Uncertainty,
    covariance: DMatrix<f64>,
    sensitivities: Sensitivities,
    margin: f64,
    /// Derivatives of the stability margin.
    by_margin: Option<DVector<f64>>,
}

impl Bands {
    /// At the last solved shape of `manipulator`, which is one of the scene `file`.
    ///
    /// # Errors
    /// [`Error::Unsupported`] for a scene without `[uncertainty]`; as [`Neighbours::sensitivities`].
    pub fn new(file: &SceneFile, manipulator: &Manipulator) -> Result<Self, Error> {
        let uncertainty = stated(file)?;
        let mut neighbours = Neighbours::new(file, &uncertainty.keys)?;
        let sensitivities = neighbours.sensitivities(manipulator)?;
        let mut measured = manipulator.clone();
        let margin = measured.measure_margin().stability_margin;
        let (covariance, by_margin) = (uncertainty.covariance(), neighbours.margin_sensitivities());
        Ok(Self { uncertainty, covariance, sensitivities, margin, by_margin })
    }

    /// What the scene states about its numbers.
    #[must_use]
    pub fn uncertainty(&self) -> &Uncertainty {
        &self.uncertainty
    }

    /// Derivatives of all outputs by the uncertain numbers.
    #[must_use]
    pub fn sensitivities(&self) -> &Sensitivities {
        &self.sensitivities
    }

    /// Standard deviation of what `read` reads from the outputs.
    #[must_use]
    pub fn deviation(&self, read: impl Fn(&Outputs) -> f64) -> f64 {
        self.deviation_along(&self.sensitivities.of(read))
    }

    /// Half the width of its band: 95 % lie as near to the value.
    #[must_use]
    pub fn band(&self, read: impl Fn(&Outputs) -> f64) -> f64 {
        self.band_along(&self.sensitivities.of(read))
    }

    /// Half the width of the band of 95 % of a quantity with these derivatives by the uncertain numbers, in the order of the keys.
    #[must_use]
    pub fn band_along(&self, derivatives: &DVector<f64>) -> f64 {
        COVERAGE * self.deviation_along(derivatives)
    }

    /// Standard deviation of a quantity with these derivatives by the uncertain numbers.
    fn deviation_along(&self, derivatives: &DVector<f64>) -> f64 {
        (&self.covariance * derivatives).dot(derivatives).max(0.0).sqrt()
    }

    /// Distance of the nearest fold in standard deviations of the scene's numbers, as far as the derivative of the stability margin
    /// tells; `None` where there is no margin.
    ///
    /// Towards a fold the margin goes to zero as the square root of the distance, so that its square is followed.
    #[must_use]
    pub fn distance_of_fold(&self) -> Option<f64> {
        let deviation = self.deviation_along(self.by_margin.as_ref()?);
        Some(0.5 * self.margin / deviation)
    }

    /// Whether a fold is so near that the distribution of the outputs is no ellipse: only samples tell it then.
    #[must_use]
    pub fn near_fold(&self) -> bool {
        self.distance_of_fold().is_some_and(|distance| distance < NEAR)
    }
}

/// The uncertainty of a scene that states one.
pub(super) fn stated(file: &SceneFile) -> Result<Uncertainty, Error> {
    let uncertainty = file.uncertainty()?;
    if uncertainty.keys.is_empty() {
        return Err(Error::Unsupported(
            "the scene does not say how well its numbers are known: it has no table [uncertainty]".into(),
        ));
    }
    Ok(uncertainty)
}
