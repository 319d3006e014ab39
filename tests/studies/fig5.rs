//! Fig. 5: relative magnetic moment.

use core::f64::consts::PI;

use mcm::studies::fig5;

use super::{column, number, row};
use crate::tolerance::{PRINTED_FOUR_DECIMALS, ROUNDING, assert_close};

#[test]
fn nine_segments_have_the_papers_moment() {
    let study = fig5().unwrap();
    let moment = row(&study, "mu_rel, S = 9");
    assert!((number(&moment.printed) - 0.1989).abs() <= PRINTED_FOUR_DECIMALS);
    assert!((number(&moment.exact) - 0.1957).abs() <= PRINTED_FOUR_DECIMALS);
    assert_eq!(format!("{:.1}", number(&moment.printed)), "0.2");
    assert!((number(&moment.exact) - column(&study, "mu_rel_open_exact")[8]).abs() <= ROUNDING);
}

#[test]
fn without_particles_only_the_rings_count() {
    // M_rel is the rings' share, V_rel is the same with and without particles.
    let study = fig5().unwrap();
    let ring = PI * (4.0 - 0.5625);
    for (index, moment) in column(&study, "mu_rel_plain_exact").iter().enumerate() {
        let segments = (index + 1) as f64;
        let whole = PI * 4.0 * (5.0 * segments + 1.0);
        // Ends 2 pi (R^2 - r_ic^2) h, core pi (r_oc^2 - r_ic^2) (L - 2h), spiral pi W h (R^2 - r_oc^2), with h of Eq. (3).
        let height = (4.0 - 2.0 * 40.0_f64.to_radians()) / 4.0;
        let helix = 2.0 * ring * height
            + PI * (0.9025 - 0.5625) * (4.0 - 2.0 * height)
            + 2.0 * PI * height * (4.0 - 0.9025);
        let rings = (segments + 1.0) * ring;
        let expected = rings / whole * (rings + segments * helix) / whole;
        assert_close(("S", segments), &[*moment], &[expected], ROUNDING);
    }
}

#[test]
fn more_material_is_more_moment() {
    let study = fig5().unwrap();
    for volume in ["exact", "printed"] {
        let of = |case: &str| column(&study, &format!("mu_rel_{case}_{volume}"));
        for ((closed, open), plain) in of("closed").iter().zip(of("open")).zip(of("plain")) {
            assert!(closed > open && open > plain);
        }
        for pair in of("open").windows(2) {
            assert!(pair[0] > pair[1], "the rings' share falls with S");
        }
    }
}
