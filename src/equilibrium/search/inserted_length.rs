//! Force that holds a shaft in its port, and what the inserted length changes.

use nalgebra::Vector3;

use super::solver::Equilibrium;
use crate::equilibrium::model::Inputs;
use crate::numerics::trust_region::Objective;
use crate::rod::{ElementLoads, Load, Order, START};

/// Number of the mode of constant extension among the amplitudes of an element: growth of an element is such an extension
/// without stress.
const EXTENSION: usize = 5;

/// Half the difference of inserted lengths from which derivatives are taken, m. No body moves between the two: only the shares of
/// line loads and of a guidewire, and the places that friction holds, change with the length itself.
const APART: f64 = 2e-7;

/// Part of a step of the inputs from which the derivatives along it are taken.
const NEARBY: f64 = 1e-3;

/// Derivatives with respect to the inserted length where every body stays in place: an element that grows is relaxed by as much.
#[derive(Debug, Clone)]
pub(crate) struct ByInsertion {
    /// Of the gradient.
    pub(crate) gradient: Vec<f64>,
    /// Of the force and the moment on the base.
    pub(crate) base: [f64; 6],
    /// Of the push, N/m.
    pub(crate) push: f64,
}

/// First derivatives of the energy, as [`Equilibrium::slopes`] gives them; the push is that where every body stays in place.
struct Slopes {
    gradient: Vec<f64>,
    base: [f64; 6],
    push: f64,
}

/// How a fed shaft responds at a solved shape.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct FeedResponse {
    /// Push that holds the shaft, N.
    pub(crate) push: f64,
    /// Its derivative with respect to the inserted length, N/m: positive where a constant push holds the shaft.
    pub(crate) stiffness: f64,
    /// Change of the push, N, along a step of the other inputs, to first order; 0 where none was asked for.
    pub(crate) along: f64,
    /// Axial stiffness of the shaft and what follows, were that all shaft, N/m.
    pub(crate) elastic: f64,
}

impl Equilibrium {
    /// Derivative of the potential energy with respect to the inserted length at the last solved shape, N: the push that holds the
    /// shaft. `None` without a shaft.
    ///
    /// It differs from the axial force in the port by the bending energy per length there (Bigoni et al., Int. J. Solids Struct.
    /// 2015, doi:10.1016/j.ijsolstr.2014.10.014). The unstressed shaft outside counts for nothing, and the weight of what comes in
    /// is that of the port.
    pub(crate) fn feed_push(&self, inputs: &Inputs) -> Option<f64> {
        (self.chain.shaft > 0).then(|| self.push_of(inputs, &self.branch.unknowns))
    }

    /// Push that holds the shaft at the equilibrium `unknowns`, evaluated last.
    fn push_of(&self, inputs: &Inputs, unknowns: &[f64]) -> f64 {
        let (chain, work) = (&self.chain, &self.work);
        let growth = chain.growth(inputs.insertion);
        let inserted = chain.inserted(growth);
        let port = inputs.gravity.dot(&inputs.base.position);
        let (mut extension, mut energy) = (0.0, 0.0);
        for (k, element) in chain.elements[..chain.shaft].iter().enumerate() {
            let amplitudes = chain.part(k, unknowns);
            extension += element.metric[EXTENSION] / growth * amplitudes[EXTENSION];
            energy -= work.configurations[k].elastic_energy(element, amplitudes);
            for (station, load) in element.stations.iter().zip(&work.station_loads[k]) {
                let material = &station.material;
                let mass = material.line_mass + material.density * material.moments.volume;
                energy += load.energy + growth * mass * port;
            }
            energy += work.placed_loads[k].loads.iter().map(|placed| placed.load.energy).sum::<f64>();
        }
        let friction = self.contact.as_ref().map_or(0.0, |contact| contact.friction_push(chain, work));
        energy / inserted - extension / chain.shaft as f64 + friction + work.lining_push(chain)
    }

    /// Derivatives of the energy without the elastic one of the bare shaft at any shape: the gradient, the wrench on the base, and the
    /// push.
    fn slopes(&mut self, inputs: &Inputs, unknowns: &[f64]) -> Option<Slopes> {
        let mut potential = self.potential(inputs, unknowns);
        potential.slope(unknowns)?;
        let mut gradient = potential.gradient().to_vec();
        let (elastic, energy) = self.elastic(unknowns);
        let stretching = self.growing().map(|(unknown, rate)| elastic[unknown] * rate).sum::<f64>();
        gradient.iter_mut().zip(&elastic).for_each(|(all, elastic)| *all -= elastic);
        let (force, moment) = self.work.base;
        let base = [force.x, force.y, force.z, moment.x, moment.y, moment.z];
        let push = self.push_of(inputs, unknowns) + stretching + energy / self.inserted(inputs);
        Some(Slopes { gradient, base, push })
    }

    /// Elastic gradient, of the shaft's unknowns alone, and elastic energy (J) of the shaft without a guidewire at the shape evaluated
    /// last. Both are inversely proportional to the inserted length.
    fn elastic(&mut self, unknowns: &[f64]) -> (Vec<f64>, f64) {
        let (chain, work) = (&self.chain, &mut self.work);
        let (mut gradient, mut energy) = (Vec::new(), 0.0);
        for (k, element) in chain.elements[..chain.shaft].iter().enumerate() {
            let unlined = chain.lining.as_ref().map(|_| work.configurations[k].unlined());
            let configuration = unlined.as_ref().unwrap_or(&work.configurations[k]);
            let amplitudes = chain.part(k, unknowns);
            let unloaded = ElementLoads {
                stations: &vec![Load::zero(); element.stations.len()],
                placed: &[],
                couplings: &[],
                end: (Vector3::zeros(), Vector3::zeros()),
            };
            work.derivatives[k].assemble(element, configuration, amplitudes, &unloaded, Order::Gradient);
            gradient.extend_from_slice(&work.derivatives[k].gradient[START..]);
            energy += configuration.elastic_energy(element, amplitudes);
        }
        (gradient, energy)
    }

    /// Length (m) that counts as inserted.
    pub(crate) fn inserted(&self, inputs: &Inputs) -> f64 {
        self.chain.inserted(self.chain.growth(inputs.insertion))
    }

    /// The unknowns whose change moves a shape as a growing inserted length does, and their rates.
    pub(crate) fn growing(&self) -> impl Iterator<Item = (usize, f64)> + use<> {
        let shaft = self.chain.shaft;
        let first = self.chain.first[..shaft].to_vec();
        first.into_iter().map(move |first| (first + EXTENSION, 1.0 / shaft as f64))
    }

    /// Derivatives by the inserted length where every body stays in place, by central differences of exact ones; `None` without a
    /// shaft and where bodies touch.
    pub(crate) fn by_insertion(&mut self, inputs: &Inputs, unknowns: &[f64]) -> Option<ByInsertion> {
        if self.chain.shaft == 0 {
            return None;
        }
        let (middle, length) = (inputs.insertion.max(APART), self.inserted(inputs));
        let mut at = |insertion| {
            let inputs = Inputs { insertion, ..inputs.clone() };
            let (mut still, grown) = (unknowns.to_vec(), self.inserted(&inputs) - length);
            self.growing().for_each(|(unknown, rate)| still[unknown] -= grown * rate);
            self.slopes(&inputs, &still)
        };
        let (before, after) = (at(middle - APART)?, at(middle + APART)?);

        let rate = |(a, b): (&f64, &f64)| (b - a) / (2.0 * APART);
        let mut gradient: Vec<f64> = before.gradient.iter().zip(&after.gradient).map(rate).collect();

        // The elastic part is inversely proportional to the length: its rates are exact.
        self.potential(inputs, unknowns).slope(unknowns)?;
        let (elastic, energy) = self.elastic(unknowns);
        gradient.iter_mut().zip(&elastic).for_each(|(all, elastic)| *all -= elastic / length);
        let mut push = rate((&before.push, &after.push)) + 2.0 * energy / (length * length);
        for (unknown, rate) in self.growing() {
            let relaxing = self.metric[unknown] * rate;
            gradient[unknown] -= relaxing;
            push += rate * (2.0 * elastic[unknown] / length + relaxing);
        }
        Some(ByInsertion {
            gradient,
            base: core::array::from_fn(|i| rate((&before.base[i], &after.base[i]))),
            push,
        })
    }

    /// How the shaft responds at the last solved shape, and along a step from its inputs towards `toward`, if that is given, at a
    /// constant inserted length; `None` without a shaft, before the first solve and at a fold.
    pub(crate) fn feed_response(&self, toward: Option<&Inputs>) -> Option<FeedResponse> {
        let inputs = self.branch.inputs.as_ref()?;
        let unknowns = &self.branch.unknowns;
        let mut apart = self.apart();
        let by_insertion = apart.by_insertion(inputs, unknowns)?;

        let mut slopes = None;
        if let Some(toward) = toward {
            let here = apart.slopes(inputs, unknowns)?;
            let level = Inputs { insertion: inputs.insertion, ..toward.clone() };
            slopes = Some([here, apart.slopes(&inputs.between(&level, NEARBY), unknowns)?]);
        }
        let push = self.push_of(inputs, unknowns);
        let mut potential = apart.potential(inputs, unknowns);
        potential.linearise(unknowns)?;
        let regular = potential.factorise(0.0);

        // What the shape, which yields to a load, changes in the push.
        let mut yielding = |load: Vec<f64>| {
            let mut shape = load;
            potential.solve(&mut shape);
            by_insertion.gradient.iter().zip(&shape).map(|(rate, by)| rate * by).sum::<f64>()
        };
        let along = slopes.map_or(0.0, |[here, near]| {
            let moved =
                near.gradient.iter().zip(&here.gradient).map(|(after, before)| after - before).collect();
            (near.push - here.push - yielding(moved)) / NEARBY
        });

        let stiffness = by_insertion.push - yielding(by_insertion.gradient.clone());
        let first = self.chain.elements.first()?;
        let tension = first.metric[EXTENSION] * first.length;
        Some(FeedResponse {
            push,
            stiffness,
            along,
            elastic: tension / (inputs.insertion + self.chain.length()),
        })
        .filter(|_| regular)
    }
}
