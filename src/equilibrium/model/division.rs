//! Division of the spans between two rigid bodies into elements.
//!
//! It depends on the design and the number of elements of a rod alone, so that all models of a device have the same elements.

use crate::design::{Ring, Segment, Span, SpanKind};
use crate::rod::Piece;

/// Ratio of length to outer radius of an elastic section that one element resolves: with quadratic strains a section six diameters
/// long that is bent by a right angle errs by 1e-5 of its length.
const SLENDER: f64 = 12.0;

/// Angle (rad) by which the unloaded section is bent and twisted, and the direction of its magnetisation turns, in one element.
const TURNED: f64 = 0.8;

/// Logarithm of the ratio of the bending stiffnesses at the ends of an element of a tapered section.
const STIFFENED: f64 = 1.0;

/// Bending compliance of a short stiff section, relative to that of the section beside it, up to which it is part of that one's element.
const SHORT: f64 = 0.03;

/// The pieces of each element of a segment, base to tip; `before` is the rigid body in front of it. Rods are divided into `rods`
/// elements, sections into as many at most, unless their shape needs more.
pub(crate) fn divide<'a>(segment: &'a Segment, before: Option<&Ring>, rods: usize) -> Vec<Vec<Piece<'a>>> {
    let spans = &segment.spans;
    match spans.first().map(|span| span.kind) {
        Some(SpanKind::Section) => of_sections(spans, [before, segment.rings.first()], rods),
        Some(SpanKind::Rod) => {
            let part = |span: &'a Span| Piece::part(span, 0.0, span.length / rods as f64);
            vec![spans.iter().map(part).collect(); rods]
        }
        // A disc, the core and the other disc.
        _ => {
            let mut pieces: Vec<Piece<'a>> = spans.iter().map(Piece::whole).collect();
            let last = pieces.len().saturating_sub(1);
            for (number, piece) in pieces.iter_mut().enumerate() {
                let disc = piece.span.kind == SpanKind::Disc;
                piece.bonded = [disc && number == 0, disc && number == last];
            }
            vec![pieces]
        }
    }
}

/// Elements of elastic sections in a row between the rigid bodies `ends`.
fn of_sections<'a>(spans: &'a [Span], ends: [Option<&Ring>; 2], rods: usize) -> Vec<Vec<Piece<'a>>> {
    let last = spans.len() - 1;
    let compliance = |span: &Span| span.length / span.stiffness.bending;
    // Short ones are pieces of the element of the softer neighbour.
    let joins = |number: usize| {
        let beside = [number.checked_sub(1), Some(number + 1).filter(|next| *next <= last)];
        let [before, behind] = beside.map(|other| other.map_or(0.0, |other| compliance(&spans[other])));
        let short = compliance(&spans[number]) < SHORT * before.max(behind) && !spans[number].varies();
        short.then_some(if behind >= before { Joins::Next } else { Joins::Previous })
    };

    let mut elements: Vec<Vec<Piece<'a>>> = Vec::new();
    let mut waiting: Vec<Piece<'a>> = Vec::new();
    for (number, span) in spans.iter().enumerate() {
        let beside = [ends[0].filter(|_| number == 0), ends[1].filter(|_| number == last)];
        let parts = parts(span, beside, rods);
        match joins(number) {
            Some(Joins::Next) => waiting.extend(parts),
            Some(Joins::Previous) if waiting.is_empty() && !elements.is_empty() => {
                elements.last_mut().into_iter().for_each(|own| own.extend(&parts));
            }
            _ => {
                let first = elements.len();
                elements.extend(parts.into_iter().map(|piece| vec![piece]));
                let own = &mut elements[first];
                own.splice(0..0, waiting.drain(..));
            }
        }
    }
    elements
}

/// The element that a short section is part of.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Joins {
    Previous,
    Next,
}

/// The parts of an elastic section between these rigid bodies, each short enough for one element.
///
/// Of a magnetised section, what is within the radius of a magnet that it is bonded to is a part of its own: that magnet does not act
/// on it, as it does not on a disc bonded to its face.
fn parts<'a>(span: &'a Span, beside: [Option<&Ring>; 2], rods: usize) -> Vec<Piece<'a>> {
    let reach = beside.map(|ring| {
        let magnet = ring.filter(|ring| ring.remanence != 0.0 && span.magnetisation != 0.0);
        magnet.map_or(0.0, |ring| ring.outer_radius.min(span.length))
    });
    let [near, far] = [reach[0], span.length - reach[1]];
    let mut cuts = vec![0.0, near.min(far), near.max(far), span.length];
    cuts.dedup();

    let mut parts = Vec::new();
    for ends in cuts.windows(2) {
        let [from, to] = [ends[0], ends[1]];
        let count = count(span, [from, to], rods);
        let length = (to - from) / count as f64;
        parts.extend((0..count).map(|i| Piece {
            bonded: [to <= near, from >= far],
            ..Piece::part(span, from + i as f64 * length, length)
        }));
    }
    parts
}

/// Number of elements of a part of a section between these arc lengths (m).
#[expect(
    clippy::cast_possible_truncation,
    clippy::cast_sign_loss,
    reason = "limited by what a design may be"
)]
fn count(span: &Span, [from, to]: [f64; 2], rods: usize) -> usize {
    let whole = |number: f64| (number.ceil() as usize).max(1);
    let [start, end] = [from, to].map(|s| span.stiffness_at(s).bending);
    let turn = if span.direction.is_axial() { 0.0 } else { span.turn };
    let turned = (span.rest_curvature.norm() + turn.abs()) * (to - from) / TURNED;
    let slender = whole((to - from) / (SLENDER * span.widest_radius())).min(rods);
    slender.max(whole(turned)).max(whole((end / start).ln().abs() / STIFFENED))
}
