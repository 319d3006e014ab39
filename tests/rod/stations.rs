//! The material that an element's stations stand for, against a brute-force sum over its volume.

use core::f64::consts::TAU;

use mcm::design::{Design, Helix, SectorKind, Segmented, Span, Specification, SpiralKind};
use mcm::rod::{Element, Piece, Resolution, SectionMaterial, SourceGeometry};
use nalgebra::{Matrix2, Vector2};

use crate::tolerance::{BRUTE_FORCE, FIRST_MOMENT, LAW, assert_close};

/// Cubic modes without rings close by.
const PLAIN: Resolution = Resolution { degree: 3, nearest: None, bending_stop: false, fine: false };

fn spans(spiral: SpiralKind) -> Vec<Span> {
    let Specification::Segmented(paper) = Specification::paper(1) else { unreachable!() };
    let chain = Segmented { spiral, ..paper };
    Design::new(Specification::Segmented(chain)).expect("allowed").segments()[0].spans.clone()
}

/// Volume, first and second moments of a span by midpoints in radius, angle and arc length, weighted with `s^power`.
fn by_cells(span: &Span, power: i32) -> (f64, Vector2<f64>, Matrix2<f64>) {
    let (radii, angles, slices) = (60, 240, 240);
    let mut sum = (0.0, Vector2::zeros(), Matrix2::zeros());
    let mut add = |inner: f64, outer: f64, from: f64, width: f64, s: f64, ds: f64| {
        for i in 0..radii {
            let dr = (outer - inner) / f64::from(radii);
            let r = inner + dr * (f64::from(i) + 0.5);
            for j in 0..angles {
                let da = width / f64::from(angles);
                let a = from + da * (f64::from(j) + 0.5);
                let point = Vector2::new(a.cos(), a.sin()) * r;
                let volume = r * dr * da * ds * s.powi(power);
                sum.0 += volume;
                sum.1 += point * volume;
                sum.2 += point * point.transpose() * volume;
            }
        }
    };
    for k in 0..slices {
        let ds = span.length / f64::from(slices);
        let s = ds * (f64::from(k) + 0.5);
        add(span.inner_radius, span.outer_radius, 0.0, TAU, s, ds);
        if let Some(spiral) = &span.spiral {
            let from = TAU * spiral.windings * s / span.length;
            add(spiral.inner_radius, spiral.outer_radius, from, spiral.sector_angle, s, ds);
        }
    }
    sum
}

#[test]
fn the_stations_stand_for_all_of_the_material() {
    let spans = spans(SpiralKind::Helical);
    let pieces: Vec<Piece<'_>> = spans.iter().map(Piece::whole).collect();
    let element = Element::new(0.0, &pieces, &PLAIN);
    let mut start = 0.0;
    for (number, span) in spans.iter().enumerate() {
        let end = start + span.length;
        let own = || {
            element
                .stations
                .iter()
                .filter(|station| station.row.arc_length > start && station.row.arc_length < end)
        };
        assert!(own().count() >= 2, "span {number}");
        for power in 0..2 {
            let (volume, first, second) = by_cells(span, power);
            let weight = |s: f64| (s - start).powi(power);
            let got = own().fold((0.0, Vector2::zeros(), Matrix2::zeros()), |sum, station| {
                let w = weight(station.row.arc_length);
                let m = &station.material.moments;
                (sum.0 + m.volume * w, sum.1 + m.first * w, sum.2 + m.second * w)
            });
            let case = (number, power);
            assert_close((case, "volume"), &[got.0], &[volume], BRUTE_FORCE);
            assert_close((case, "second"), got.2.as_slice(), second.as_slice(), BRUTE_FORCE);
            let radius = volume * 2e-3;
            assert!((got.1 - first).norm() <= BRUTE_FORCE * radius, "{case:?}: first {} {first}", got.1);
        }
        start = end;
    }
}

#[test]
fn four_points_carry_the_moments() {
    for kind in [SpiralKind::Helical, SpiralKind::Axisymmetric] {
        let spans = spans(kind);
        let pieces: Vec<Piece<'_>> = spans.iter().map(Piece::whole).collect();
        for station in &Element::new(0.0, &pieces, &PLAIN).stations {
            let (moments, points) = (&station.material.moments, station.material.moments.points());
            let quarter = moments.volume / 4.0;
            let first: Vector2<f64> = points.iter().map(|point| point * quarter).sum();
            let second: Matrix2<f64> = points.iter().map(|point| point * point.transpose() * quarter).sum();
            assert!((first - moments.first).norm() <= LAW * moments.volume * 1e-3, "{kind:?}: {first}");
            assert_close(kind, second.as_slice(), moments.second.as_slice(), LAW);
        }
    }
}

/// Of two alternating segments each section is the point reflection of the one as far from the ring between them.
#[test]
fn alternating_spirals_are_point_reflections() {
    let Specification::Segmented(paper) = Specification::paper(3) else { unreachable!() };
    let helix = Helix { windings: 2.3, ..paper.helix };
    let chain = Segmented { spiral: SpiralKind::Alternating, helix, ..paper };
    let design = Design::new(Specification::Segmented(chain)).expect("allowed");
    let cores: Vec<&Span> = design.segments().iter().map(|segment| &segment.spans[1]).collect();
    let kinds: Vec<_> = cores.iter().map(|core| core.spiral.map(|spiral| spiral.kind)).collect();
    assert_eq!(kinds, [SectorKind::RightHanded, SectorKind::LeftHanded, SectorKind::RightHanded].map(Some));
    for pair in cores.windows(2) {
        for s in [0.0, 0.3e-3, 1.1e-3, 2.6e-3] {
            let own = SectionMaterial::section(pair[0], pair[0].length - s).moments;
            let other = SectionMaterial::section(pair[1], s).moments;
            assert!(own.first.norm() > 0.1 * own.volume * helix.radius, "off the centreline at {s} m");
            assert_close(s, (-other.first).as_slice(), own.first.as_slice(), LAW);
            assert_close(s, other.second.as_slice(), own.second.as_slice(), LAW);
        }
    }
}

#[test]
fn an_even_spiral_has_the_volume_of_the_turning_one() {
    let volume = |kind| spans(kind).iter().map(Span::volume).sum::<f64>();
    assert_close("volume", &[volume(SpiralKind::Axisymmetric)], &[volume(SpiralKind::Helical)], LAW);
}

/// For the field of a ring, too, whose distance and accuracy choose points for each station.
#[test]
fn the_samples_for_a_ring_stand_for_all_of_the_material() {
    const RADIUS: f64 = 2e-3;
    let spans = spans(SpiralKind::Helical);
    let pieces: Vec<Piece<'_>> = spans.iter().map(Piece::whole).collect();
    let cells = spans.iter().map(|span| by_cells(span, 0));
    let (volume, first) = cells.fold((0.0, Vector2::zeros()), |sum, own| (sum.0 + own.0, sum.1 + own.1));
    let mut worst = 0.0_f64;
    for accuracy in [1e-3, 3e-4, 1e-4, 6e-5, 4e-5, 3e-5, 2e-5, 1e-5, 1e-6] {
        for bend in [0.08, 0.32] {
            for (distance, beyond) in [(2e-3, false), (5e-3, false), (5e-3, true), (2e-2, true)] {
                let sight =
                    SourceGeometry { distance, beyond, bonded: false, radius: RADIUS, bend, accuracy };
                let nearest = Some(SourceGeometry { distance: 0.0, bonded: true, bend: 0.0, ..sight });
                let element = Element::new(0.0, &pieces, &Resolution { degree: 6, nearest, ..PLAIN });
                let samples = element.samples(&pieces, &sight);
                let points = || samples.iter().flat_map(|sample| &sample.points);
                let own_volume: f64 = points().map(|point| point.volume).sum();
                let own_first: Vector2<f64> = points().map(|point| point.position * point.volume).sum();
                let case = format!("accuracy {accuracy:e}, bend {bend}, {distance} m, beyond {beyond}");
                assert_close(&case, &[own_volume / volume], &[1.0], BRUTE_FORCE);
                let off = (own_first - first).norm() / (volume * RADIUS);
                worst = worst.max(off);
                assert!(off <= FIRST_MOMENT, "{case}: first moment off by {off:.1e}");
            }
        }
    }
    println!("first moment within {worst:.1e} of volume times radius");
}
