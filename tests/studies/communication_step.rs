//! A way of the magnet in few steps and in many leads to one shape, or the study says so.

use mcm::studies::communication_step;

use super::{Counted, column, number, row};
use crate::tolerance::SAME_TIP_MM;

/// Ways, the longest steps (mm) up to which they must not depend on the steps, and snaps.
const WAYS: [(&str, f64, f64); 4] =
    [("pass", 360.0, 0.0), ("half orbit", 190.0, 0.0), ("snap forth", 40.0, 1.0), ("snap back", 40.0, 1.0)];

#[test]
fn what_depends_on_the_step_is_told() {
    let parts = Counted::default();
    let study = communication_step(&parts).unwrap();
    parts.assert_complete(1000);
    let mut told = 0;
    for (way, limit, snaps) in WAYS {
        let key = way.replace(' ', "_");
        let get = |name: String| column(&study, &name);
        let steps = get(format!("{key}_step_mm")).iter().zip(get(format!("{key}_apart_mm")));
        let events = get(format!("snaps_{key}")).iter().zip(get(format!("refused_{key}")));
        for ((step, apart), (snapped, refused)) in steps.zip(events) {
            let same = *apart <= SAME_TIP_MM && (snapped - snaps).abs() < 0.5;
            assert!(
                same || *refused > 0.0,
                "{way}, {step} mm: tip {apart} mm off, {snapped} snaps, nothing said"
            );
            assert!(*step > limit || *refused == 0.0, "{way}, {step} mm: not solved");
            told += u32::from(!same);
        }
        let stated = number(&row(&study, &format!("{way}: longest step")).exact);
        assert!(stated >= limit, "{way}: {stated} mm");
    }
    assert_eq!(told, 1, "the jump through the manipulator");
}
