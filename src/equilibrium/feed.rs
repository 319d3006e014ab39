//! Force that holds a shaft in its port.

use super::inputs::Inputs;
use super::solver::Equilibrium;

/// Number of the mode of constant extension among the amplitudes of an element: growth of an element is such an extension
/// without stress.
const EXTENSION: usize = 5;

impl Equilibrium {
    /// Derivative of the potential energy with respect to the inserted length at the last solved shape, N: the push that holds the
    /// shaft. `None` without a shaft.
    ///
    /// It differs from the axial force in the port by the bending energy per length there (Bigoni et al., Int. J. Solids Struct.
    /// 2015, doi:10.1016/j.ijsolstr.2014.10.014). The unstressed shaft outside counts for nothing, and the weight of what comes in
    /// is that of the port.
    pub(super) fn feed_push(&self, inputs: &Inputs) -> Option<f64> {
        let (chain, work) = (&self.chain, &self.work);
        let growth = chain.growth(inputs.insertion);
        let inserted = chain.inserted(growth);
        let port = inputs.gravity.dot(&inputs.base.position);
        let (mut extension, mut energy) = (0.0, 0.0);
        for (k, element) in chain.elements[..chain.shaft].iter().enumerate() {
            let amplitudes = chain.part(k, &self.branch.unknowns);
            extension += element.metric[EXTENSION] / growth * amplitudes[EXTENSION];
            energy -= work.configurations[k].elastic_energy(element, amplitudes);
            for (station, load) in element.stations.iter().zip(&work.station_loads[k]) {
                let material = &station.material;
                let mass = material.line_mass + material.density * material.moments.volume;
                energy += load.energy + growth * mass * port;
            }
            energy += work.placed_loads[k].loads.iter().map(|placed| placed.load.energy).sum::<f64>();
        }
        (chain.shaft > 0).then(|| energy / inserted - extension / chain.shaft as f64 + self.friction_push())
    }
}
