//! Devices that a magnet leads through the aorta, beside Coulomb's law.

use mcm::studies::{Study, fig9};

use super::{Counted, column};

/// Communication points on the way: the devices are in the straight iliac artery.
const POINTS: usize = 12;

/// Share of the friction by which the pull on a sliding device may differ: the port bends the shaft.
const BENT: f64 = 0.05;

/// The last value of a column.
fn last(study: &Study, name: &str) -> f64 {
    column(study, name)[POINTS - 1]
}

#[test]
fn a_magnet_pulls_as_hard_as_friction_holds_and_no_harder() {
    let parts = Counted::default();
    let study = fig9(POINTS, &parts).unwrap();
    parts.assert_complete(8 * POINTS);
    for device in ["mcm", "cylinder"] {
        let pull = |case: &str| last(&study, &format!("{device}{case}_axial_n"));
        let wall = |case: &str| last(&study, &format!("{device}{case}_wall_n"));
        // A straight wall without friction holds nothing along itself, nor does a shaft that hangs free.
        assert!(pull("").abs() < 0.01 * wall(""), "{device}: {} N of {} N", pull(""), wall(""));
        let sliding = (pull("_oiled") - pull("")) / (0.04 * wall("_oiled"));
        assert!((sliding - 1.0).abs() < BENT, "{device}: {sliding} of the friction");
        let [free, oiled, dry] =
            ["", "_oiled", "_dry"].map(|case| last(&study, &format!("{device}{case}_inside_mm")));
        assert!(pull("_dry") > 0.3 * wall("_dry") && pull("_dry") < wall("_dry"), "{device} is held");
        assert!(
            free > oiled && oiled > 0.9 * free && dry < 0.5 * free,
            "{device}: {free}, {oiled}, {dry} mm"
        );
    }
    for row in &study.comparison {
        assert!(row.remark.starts_with("the end of the path"), "{}: {}", row.quantity, row.remark);
    }
}
