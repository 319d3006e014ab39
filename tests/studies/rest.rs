//! The shape without any load.

use mcm::studies::rest;

use super::{column, number, row};
use crate::tolerance::{REFLECTED_DEG, TWO_DECIMALS_DEG};

#[test]
fn arranged_spirals_leave_less() {
    let study = rest().unwrap();
    let [helical, alternating, turned] =
        ["helical", "alternating", "turned"].map(|name| column(&study, &format!("alpha_{name}_deg")));
    // An independent model's angles of one, three and nine segments.
    for (segments, angle) in [(1, 0.969), (3, 3.33), (9, 11.06)] {
        assert!((helical[segments - 1] - angle).abs() <= TWO_DECIMALS_DEG, "{segments}: {helical:?}");
    }
    for segments in 2..=helical.len() {
        let k = segments - 1;
        if segments % 2 == 0 {
            assert!(alternating[k] <= REFLECTED_DEG, "{segments}: {}", alternating[k]);
        } else {
            assert!(alternating[k] < helical[0], "{segments}: {}", alternating[k]);
        }
        assert!(helical[k] > helical[k - 1], "{segments}: {helical:?}");
        assert!(turned[k] < 0.15, "{segments}: {}", turned[k]);
    }
    for (name, angles) in [("helical", helical), ("alternating", alternating), ("turned", turned)] {
        let quantity = format!("tip angle of nine segments without any load, {name}");
        assert_eq!(number(&row(&study, &quantity).exact).to_bits(), angles[8].to_bits());
    }
}
