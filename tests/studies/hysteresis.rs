//! The magnet that passes by and comes back.

use mcm::studies::hysteresis;

use super::{Counted, column, number, row};
use crate::tolerance::TWO_DECIMALS_DEG;

#[test]
fn the_ways_part_between_their_snaps_and_nowhere_else() {
    let parts = Counted::default();
    let study = hysteresis(&parts).unwrap();
    parts.assert_complete(80);
    let snap = |way: &str| {
        let quantity = format!("place of the magnet at which nine segments snap over, {way}");
        number(&row(&study, &quantity).exact)
    };
    let (forth, back) = (snap("forth"), snap("back"));
    assert!(forth - back > 3.0, "snaps at {forth} and {back} mm");
    let angles = column(&study, "alpha_forth_deg").iter().zip(column(&study, "alpha_back_deg"));
    for (place, (there, here)) in column(&study, "magnet_z_mm").iter().zip(angles) {
        let difference = (there - here).abs();
        if *place > back && *place < forth {
            assert!(difference > 1.0, "{place} mm: {there} and {here} deg within the loop");
        } else {
            assert!(difference < TWO_DECIMALS_DEG, "{place} mm: {there} and {here} deg outside the loop");
        }
    }
}
