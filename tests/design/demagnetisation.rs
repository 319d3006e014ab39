//! The demagnetising factor of rings, and what it makes of their moment.

use core::f64::consts::{FRAC_PI_2, PI};

use mcm::design::{
    Design, Helix, RelativeMoment, RingMagnet, Segmented, Specification, SpiralVolume, demagnetising_factor,
};
use mcm::magnetics::AxialSource;
use mcm::numerics::quadrature::gauss_legendre;
use nalgebra::Vector3;

use crate::tolerance::{
    DEMAGNETISATION, MEAN_FIELD, PRINTED_NAGAOKA, ROUNDING, UNIFORM_MAGNETISATION, assert_close,
};

/// Demagnetising factor of a solid cylinder along its axis, from the self-inductance of a current sheet (L. Lorenz 1879, in the
/// form of H. Nagaoka 1909):
/// `1 - 4/(3 pi k') [(k'/k)^2 (K - E) + E - k]` with `k = 2R / sqrt(4 R^2 + L^2)`.
fn by_inductance(radius: f64, length: f64) -> f64 {
    let far = (4.0 * radius * radius + length * length).sqrt();
    let (k, complement) = (2.0 * radius / far, length / far);
    // K and E by the arithmetic-geometric mean, whose digits double with every step.
    let (mut a, mut g, mut c, mut power, mut sum) = (1.0, complement, k, 0.5, 0.0);
    for _ in 0..10 {
        sum += power * c * c;
        (a, g, c, power) = (0.5 * (a + g), (a * g).sqrt(), 0.5 * (a - g), 2.0 * power);
    }
    let first = FRAC_PI_2 / a;
    let second = first * (1.0 - sum);
    let bracket = (complement / k).powi(2) * (first - second) + second - k;
    1.0 - 4.0 / (3.0 * PI * complement) * bracket
}

#[test]
fn solid_cylinders_have_the_factor_of_their_inductance() {
    for exponent in -8..=8 {
        let ratio = 10.0_f64.powf(0.25 * f64::from(exponent)); // length over diameter, 0.01 to 100
        let got = demagnetising_factor(0.0, 1.5e-3, 3e-3 * ratio);
        let expected = by_inductance(1.5e-3, 3e-3 * ratio);
        // What is left of long cylinders is a small difference of the inductance from that of an infinite one.
        assert!((got - expected).abs() <= DEMAGNETISATION, "{ratio}: {got}, expected {expected}");
    }
}

/// Nagaoka's coefficients by diameter over length (H. Nagaoka, J. Coll. Sci. Tokyo 27 (1909), art. 6; F. W. Grover, Inductance
/// Calculations, table 36), of which 1 is 1 plus the factor: the way to the values of D.-X. Chen, J. A. Brug and R. B. Goldfarb,
/// IEEE Trans. Magn. 27 (1991) 3601, for a susceptibility of zero.
#[test]
fn solid_cylinders_have_the_printed_factor() {
    for (ratio, coefficient) in
        [(0.25, 0.901_649), (0.5, 0.818_136), (1.0, 0.688_423), (2.0, 0.525_510), (5.0, 0.319_825)]
    {
        let got = 1.0 - demagnetising_factor(0.0, 1.0, 2.0 / ratio);
        assert!((got - coefficient).abs() <= PRINTED_NAGAOKA, "{ratio}: {got}");
    }
}

#[test]
fn discs_and_tubes_have_their_limits() {
    for (bore, length) in [(0.0, 1e-4), (0.0, 1e-5), (0.5, 1e-5)] {
        let factor = demagnetising_factor(bore, 1.0, length);
        // Of first order in the length over the width, but for a logarithm.
        let missing = 1.0 - factor;
        assert!((length..30.0 * length).contains(&missing), "{bore}, {length}: {missing}");
    }
    // The ends of a long cylinder are two discs of charge: N = 8 R / (3 pi L).
    let long = demagnetising_factor(0.0, 1e-3, 10.0);
    assert!((long * 10.0 / 1e-3 * 3.0 * PI / 8.0 - 1.0).abs() < 1e-3, "{long}");
    // Only shape counts, and a bore takes charges away from the others.
    let ring = demagnetising_factor(0.75e-3, 2e-3, 1e-3);
    assert!((demagnetising_factor(0.75, 2.0, 1.0) / ring - 1.0).abs() <= 100.0 * ROUNDING);
    assert!(ring < demagnetising_factor(0.0, 2e-3, 1e-3));
    let pinhole = demagnetising_factor(1e-6, 2e-3, 1e-3);
    assert!((pinhole - demagnetising_factor(0.0, 2e-3, 1e-3)).abs() < 1e-5, "{pinhole}");
}

/// `<B> = (1 - N) B_r` within a ring, its field by elliptic integrals.
#[test]
fn it_is_the_mean_of_the_exact_field() {
    let (nodes, weights) = gauss_legendre(96);
    for (inner, outer, length) in [(0.75e-3, 2e-3, 1e-3), (1.6e-3, 2e-3, 1e-3), (0.5e-3, 1e-3, 5e-3)] {
        let ring = AxialSource::new(inner, outer, length, 1.0).unwrap();
        let mut mean = 0.0;
        for (x, weight) in nodes.iter().zip(&weights) {
            for (y, other) in nodes.iter().zip(&weights) {
                let square = 0.5 * (outer * outer * (1.0 + x) + inner * inner * (1.0 - x));
                let at = Vector3::new(square.sqrt(), 0.0, 0.5 * length * y);
                mean += 0.25 * weight * other * ring.field(&at).unwrap().z;
            }
        }
        let got = 1.0 - demagnetising_factor(inner, outer, length);
        assert_close((inner, outer, length), &[got], &[mean], MEAN_FIELD);
    }
}

fn chain(ring: RingMagnet) -> Segmented {
    Segmented { ring, ..Segmented::paper(1) }
}

/// `tests/bench/recoil_permeability.csv`: an integral equation that lets the magnetisation vary.
#[test]
fn recoil_permeability_weakens_rings_as_the_integral_equation_says() {
    let path = concat!(env!("CARGO_MANIFEST_DIR"), "/tests/bench/recoil_permeability.csv");
    let mut table = csv::ReaderBuilder::new().comment(Some(b'#')).from_path(path).unwrap();
    let rows: Vec<[f64; 7]> = table.deserialize().collect::<Result<_, _>>().unwrap();
    assert!(rows.len() >= 12);
    for [inner, outer, length, recoil_permeability, mean, mesh_error, _] in rows {
        let ring = RingMagnet { length: 1e-3 * length, recoil_permeability, ..RingMagnet::paper() };
        let helix = Helix {
            radius: 1e-3 * outer,
            core_inner_radius: 1e-3 * inner,
            core_outer_radius: 0.5e-3 * (inner + outer),
            ..Helix::paper()
        };
        let design = Design::new(Specification::Segmented(Segmented { helix, ..chain(ring) })).unwrap();
        let got = design.rings().next().unwrap().remanence / ring.remanence;
        let allowed = UNIFORM_MAGNETISATION * (recoil_permeability - 1.0).powi(2);
        println!("{inner}/{outer} x {length} mm, mu_r {recoil_permeability}: {:.1e}", got / mean - 1.0);
        assert!(mesh_error < 0.5 * allowed, "{inner}, {outer}, {length}: mesh");
        assert!((got / mean - 1.0).abs() <= allowed, "{inner}, {outer}, {length}: {got}, {mean}");
    }
}

#[test]
#[allow(clippy::float_cmp, reason = "by default no bit changes")]
fn every_moment_takes_it_and_by_default_none_changes() {
    let of = |recoil_permeability| chain(RingMagnet { recoil_permeability, ..RingMagnet::paper() });
    let ring = |chain: &Segmented| {
        let design = Design::new(Specification::Segmented(chain.clone())).unwrap();
        *design.rings().next().unwrap()
    };
    assert_eq!(ring(&of(1.0)).remanence, 1.35);
    let (plain, sintered) = (of(1.0), of(1.05));
    let weakened = ring(&sintered).remanence / 1.35;
    assert!((0.972..0.974).contains(&weakened), "{weakened}");
    assert_close("moment", &[ring(&sintered).moment()], &[weakened * ring(&plain).moment()], ROUNDING);
    assert_eq!(ring(&sintered).mass, ring(&plain).mass);
    // Without particles all of the moment is the rings'.
    let bare = |chain: &Segmented| -> RelativeMoment {
        let helix = Helix { particle_remanence: 0.0, ..chain.helix };
        Segmented { helix, ..chain.clone() }.relative_moment(SpiralVolume::Exact).unwrap()
    };
    let (before, after) = (bare(&plain), bare(&sintered));
    assert_close("ratio", &[after.remanent_moment], &[weakened * before.remanent_moment], ROUNDING);
    assert_eq!(after.moment, before.moment, "Eq. (6) counts volumes");
}
