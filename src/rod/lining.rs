//! Energy of a lining that slides freely in an element: of bending alone.

use super::bending;
use super::element::Element;
use super::kinematics::Configuration;
use super::row::ROTATIONS;
use crate::design::Stiffness;

impl Configuration {
    /// Bending energy (J) of linings of these stiffnesses (N m2), one for each station.
    pub fn lining_energy(&self, element: &Element, stiffness: impl Iterator<Item = f64>) -> f64 {
        let stations = self.stations.iter().zip(&element.stations).zip(stiffness);
        let energy = stations.map(|((state, station), stiffness)| {
            0.5 * stiffness * station.weight * state.curvature().xy().norm_squared()
        });
        energy.sum::<f64>() / self.growth
    }

    /// Its derivatives with respect to the amplitudes.
    pub fn lining_gradient(&self, element: &Element, stiffness: impl Iterator<Item = f64>) -> Vec<f64> {
        let mut out = vec![0.0; element.freedoms()];
        let none = Stiffness { bending: 0.0, torsion: 0.0, shear: 0.0, axial: 0.0 };
        for ((state, station), stiffness) in self.stations.iter().zip(&element.stations).zip(stiffness) {
            let (slope, rate) =
                bending::gradient(state, [&none.lined(stiffness), &none], station.weight / self.growth);
            for (i, component) in element.component.iter().enumerate().filter(|(_, c)| **c < ROTATIONS) {
                out[i] +=
                    slope[*component] * station.row.integral[i] + rate[*component] * station.row.rate[i];
            }
        }
        out
    }
}
