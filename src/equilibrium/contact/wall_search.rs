//! Search for the arcs along which the chain touches the wall of a vessel.

use super::loading::Loading;
use super::surface::Skin;
use super::wall_contacts::ArcPart;
use crate::numerics::hermite::Cubic;

/// Upper bound of the stretch of an element: soft helices extend by several percent.
const STRETCHED: f64 = 1.25;

/// What is known of the clearance along the chain, from the last place looked at.
#[derive(Debug, Clone, Copy)]
struct Seen {
    clearance: f64,
    /// Of that place, along the whole chain, m.
    arc_length: f64,
}

impl Seen {
    /// Lower bound further along the chain: the clearance changes by no more than the distance.
    fn least(&self, arc_length: f64) -> f64 {
        self.clearance - STRETCHED * (arc_length - self.arc_length)
    }
}

impl Loading<'_> {
    /// Finds the arcs in contact at the shape placed last.
    ///
    /// Between two neighbouring places the clearance is taken as the cubic through both values and slopes. Places that are too
    /// near to the last one for the wall to be in reach are passed over.
    pub(crate) fn find_arcs(&self, found: &mut Vec<ArcPart>) {
        found.clear();
        let mut start = 0.0;
        let mut seen = Seen { clearance: f64::NEG_INFINITY, arc_length: 0.0 };
        for (k, own) in self.surface.elements.iter().enumerate() {
            start += self.chain.elements[k].offset;
            for (piece, skin) in own.iter().enumerate() {
                self.find_arcs_on((k, piece), (start, skin), &mut seen, found);
            }
            start += self.chain.elements[k].length * self.work.configurations[k].growth;
        }
        for number in 1..found.len() {
            let [before, own] = [found[number - 1], found[number]];
            let goes_on = before.on.0 == own.on.0 && before.ends[1] >= own.ends[0];
            found[number].arc = before.arc + usize::from(!goes_on);
        }
    }

    /// The widening (m) of the lumen with which the chain would nowhere touch the wall.
    pub(crate) fn missing_width(&self) -> f64 {
        let mut missing = 0.0_f64;
        for (k, own) in self.surface.elements.iter().enumerate() {
            for skin in own {
                for row in &skin.places {
                    let amplitudes = self.chain.part(k, self.unknowns);
                    let (position, _) =
                        self.work.configurations[k].curve_at(&self.chain.elements[k], row, amplitudes);
                    let clearance = self.wall.clearance(&self.work.nodes[k].transform(&position));
                    let radius = skin.radius_at(row.arc_length);
                    missing = missing.max(radius - clearance.value);
                }
            }
        }
        missing
    }

    /// Finds the arcs on a piece of an element that starts at `start` along the chain.
    fn find_arcs_on(
        &self,
        (k, piece): (usize, usize),
        (start, skin): (f64, &Skin),
        seen: &mut Seen,
        found: &mut Vec<ArcPart>,
    ) {
        let (element, amplitudes) = (&self.chain.elements[k], self.chain.part(k, self.unknowns));
        let configuration = &self.work.configurations[k];
        let growth = configuration.growth;
        let mut before: Option<[f64; 3]> = None;
        for (number, row) in skin.places.iter().enumerate() {
            let place = |number: usize| skin.places.get(number).map(|row| row.arc_length);
            let next = place(number + 1).unwrap_or(row.arc_length);
            if seen.least(start + next * growth) > skin.widest() {
                before = None;
                continue;
            }

            let (position, tangent) = configuration.curve_at(element, row, amplitudes);
            let node = &self.work.nodes[k];
            let clearance = self.wall.clearance(&node.transform(&position));
            *seen = Seen { clearance: clearance.value, arc_length: start + row.arc_length * growth };
            let gap = clearance.value - skin.radius_at(row.arc_length);
            let slope = clearance.gradient.dot(&(node.rotation * tangent)) - skin.slope();
            if let Some([from, first, rise]) = before {
                let length = row.arc_length - from;
                if first + gap <= STRETCHED * length * growth {
                    let cubic = Cubic::through([first, gap], [rise * length, slope * length]);
                    let parts = negative(&cubic, self.wall.onset());
                    found.extend(parts.map(|ends| ArcPart {
                        on: (k, piece),
                        ends: ends.map(|x| from + x * length),
                        deepest: -cubic.least(ends),
                        arc: 0,
                    }));
                }
            }
            before = Some([row.arc_length, gap, slope]);
        }
    }
}

/// The parts of `[0, 1]` in which the cubic is negative, divided where it is as low as `-onset`.
fn negative(cubic: &Cubic, onset: f64) -> impl Iterator<Item = [f64; 2]> {
    let mut ends = vec![0.0];
    ends.extend(cubic.crossings(0.0));
    ends.extend(cubic.crossings(-onset));
    ends.push(1.0);
    ends.sort_by(f64::total_cmp);
    let cubic = *cubic;
    let parts: Vec<[f64; 2]> = ends.windows(2).map(|pair| [pair[0], pair[1]]).collect();
    parts.into_iter().filter(move |[from, to]| to > from && cubic.at(0.5 * (from + to)) < 0.0)
}
