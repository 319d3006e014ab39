//! Tangents and curvatures of the shape, which are computed only when they are asked for.

use super::{Manipulator, Outputs};

impl Manipulator {
    /// Computes tangents and curvatures at the points of the last solved shape and stores them in the outputs, unless they are there
    /// already.
    ///
    /// ```
    /// use mcm::manipulator::Scene;
    /// let scene = Scene::parse("[design]\nsegments = 1\n[field]\nuniform_mt = [0.0, 10.0, 0.0]", "example")?;
    /// let mut manipulator = scene.manipulator(5)?;
    /// manipulator.solve(&scene.inputs)?;
    /// let outputs = manipulator.measure_strains();
    /// // Straight in the rings at both ends, bent about the same axis in the core between them.
    /// assert_eq!(outputs.shape_curvatures[0].norm(), 0.0);
    /// assert!(outputs.shape_curvatures[2].x < -10.0);
    /// assert!((outputs.shape_tangents[4] - outputs.tip.axis()).norm() < 1e-12);
    /// # Ok::<(), mcm::error::Error>(())
    /// ```
    pub fn measure_strains(&mut self) -> &Outputs {
        let Self { hierarchy, outputs, .. } = self;
        outputs.read_strains(hierarchy.present());
        outputs
    }
}
