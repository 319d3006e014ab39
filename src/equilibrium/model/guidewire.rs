//! A guidewire inside the device: the bending stiffness that it adds as far as it reaches.
//!
//! Covered and bare parts of the arc length that a station stands for bend in series: their compliances add up. The covered part
//! grows smoothly while the wire's end passes, from the middle of the share of the station before to that of the station behind;
//! at the port, where the shaft ends, and at the faces of rings it ends with the station's own share. So nothing jumps, and nothing
//! changes while the end is in a ring, which is rigid.

use crate::design::Guidewire;
use crate::numerics::onset::{smooth_step, smooth_step_slopes};
use crate::rod::{Element, Station};

/// Stiffness of the guidewire, and where it sets in at each station.
#[derive(Debug, Clone)]
pub(crate) struct Lining {
    /// Bending stiffness of the wire, N m2.
    stiffness: f64,
    /// Number of elements of the shaft.
    shaft: usize,
    /// Length of the shaft's tables, m.
    tables: f64,
    /// By element and station: arc lengths (m) of the wire's end between which the wire sets in, those of the shaft in its tables,
    /// the others from the end of the shaft.
    windows: Vec<Vec<[f64; 2]>>,
    /// By element and station: ratio of the wire's bending stiffness to that of the section.
    ratios: Vec<Vec<f64>>,
    /// By element and station: weight in the mean over the element, per its length, 1/m.
    pub(crate) rotational: Vec<Vec<f64>>,
}

/// Stiffness of the wire at a station, and its derivatives.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Share {
    pub(crate) value: f64,
    pub(crate) by_reach: f64,
    pub(crate) by_insertion: f64,
    pub(crate) by_both: f64,
}

impl Lining {
    pub(crate) fn new(wire: &Guidewire, elements: &[Element], shaft: usize) -> Self {
        let mut windows: Vec<Vec<[f64; 2]>> = Vec::new();
        let mut start = 0.0;
        let joined = |k: usize| k > 0 && k != shaft && elements[k].offset == 0.0;
        for (k, element) in elements.iter().enumerate().filter(|(k, _)| !joined(*k)) {
            let together = (k + 1..elements.len()).take_while(|next| joined(*next)).count() + 1;
            start = element.offset + if k == shaft { 0.0 } else { start };
            let run = &elements[k..k + together];
            let places = windows_of(&mut start, run.iter().flat_map(|element| &element.stations));
            let mut places = places.into_iter();
            windows.extend(run.iter().map(|element| places.by_ref().take(element.stations.len()).collect()));
        }
        let tables = elements[..shaft].iter().map(|element| element.length).sum();
        let rotational = elements.iter().map(|element| {
            let square = element.length * element.length;
            element.stations.iter().map(|station| station.weight / square).collect()
        });
        let rotational = rotational.collect();
        let stiffness = wire.bending_stiffness();
        let ratios = elements.iter().map(|element| {
            element.stations.iter().map(|station| stiffness / station.stiffness.bending).collect()
        });
        Self { stiffness, shaft, tables, windows, ratios: ratios.collect(), rotational }
    }

    /// The wire at the stations of an element, for the growth of the shaft and the reach of the wire (m).
    pub(crate) fn shares(
        &self,
        element: usize,
        [growth, reach]: [f64; 2],
    ) -> impl Iterator<Item = Share> + '_ {
        let in_shaft = element < self.shaft;
        self.windows[element].iter().zip(&self.ratios[element]).map(move |([from, to], ratio)| {
            let width = to - from;
            // Where the wire's end is on the scale of the window, and its derivatives.
            let (at, by_reach, by_insertion, by_both) = if in_shaft {
                let square = growth * growth * self.tables;
                (reach / growth, 1.0 / growth, -reach / square, -1.0 / square)
            } else {
                (reach - growth * self.tables, 1.0, -1.0, 0.0)
            };
            let t = (at - from) / width;
            let (covered, [slope, curve]) = (smooth_step(t), smooth_step_slopes(t));
            let bare = 1.0 + ratio * (1.0 - covered);
            // The stiffness by the covered part, then by where the end is.
            let rate = self.stiffness * (1.0 + ratio) / (bare * bare);
            let curve = rate * (curve + 2.0 * ratio / bare * slope * slope) / (width * width);
            let slope = rate * slope / width;
            Share {
                value: self.stiffness * covered / bare,
                by_reach: slope * by_reach,
                by_insertion: slope * by_insertion,
                by_both: curve * by_reach * by_insertion + slope * by_both,
            }
        })
    }
}

/// Windows of stations without a rigid part between them, the first share of which begins at `start`, which moves on to the end of
/// the last.
fn windows_of<'a>(start: &mut f64, stations: impl Iterator<Item = &'a Station>) -> Vec<[f64; 2]> {
    let mut ends = vec![*start];
    for station in stations {
        *start += station.weight;
        ends.push(*start);
    }
    let last = ends.len() - 1;
    let middle = |share: usize| 0.5 * (ends[share] + ends[share + 1]);
    let window = |own: usize| {
        let from = if own == 0 { ends[0] } else { middle(own - 1) };
        let to = if own + 1 == last { ends[last] } else { middle(own + 1) };
        [from, to]
    };
    (0..last).map(window).collect()
}
