//! The map of failures: its verification tells shapes apart, the potential method is right or says that it has none.

use std::collections::BTreeSet;

use mcm::design::{Design, Specification};
use mcm::equilibrium::{Equilibrium, Inputs, Interaction, Settings, Solution};
use mcm::methods::Method;
use mcm::studies::{Attempt, Ray, Verdict, stability_rays};

use crate::tolerance::INTERPOLATED;

fn attempts(segments: usize, interaction: Interaction, direction_deg: f64) -> Vec<Attempt> {
    Ray { segments, interaction, direction_deg }.attempts().unwrap()
}

#[test]
fn across_one_segment_everyone_is_on_the_branch() {
    let attempts = attempts(1, Interaction::Rings, 90.0);
    let methods: BTreeSet<&str> = attempts.iter().map(|attempt| attempt.method).collect();
    assert_eq!(methods.len(), Method::ALL.len());
    for attempt in &attempts {
        assert_eq!(attempt.verdict, Verdict::Branch, "{attempt:?}");
        assert!(attempt.margin.unwrap() > 0.0, "{attempt:?}");
    }
}

#[test]
fn against_the_field_the_blind_stay_straight_and_the_potential_method_does_not() {
    let attempts = attempts(1, Interaction::None, 180.0);
    let strong = |attempt: &&Attempt| attempt.field_mt >= 35.0;
    let (own, others): (Vec<&Attempt>, _) =
        attempts.iter().filter(strong).partition(|attempt| attempt.method == Method::Potential.name());
    assert!(!own.is_empty() && !others.is_empty());
    for attempt in own {
        assert!(!matches!(attempt.verdict, Verdict::Unstable | Verdict::Wrong), "{attempt:?}");
    }
    for attempt in others {
        assert_eq!(attempt.verdict, Verdict::Unstable, "{attempt:?}");
        assert!(attempt.margin.unwrap() < 0.0, "{attempt:?}");
    }
}

#[test]
fn where_the_rings_have_closed_the_potential_method_says_that_there_is_no_shape() {
    let attempts = attempts(1, Interaction::Rings, 150.0);
    let of = |method: &str, verdict| {
        attempts.iter().filter(|attempt| attempt.method == method && attempt.verdict == verdict).count()
    };
    assert!(of("potential", Verdict::Branch) > 0 && of("potential", Verdict::Stalled) > 0);
    assert_eq!(of("potential", Verdict::Unstable) + of("potential", Verdict::Wrong), 0);
    assert!(of("constant-curvature", Verdict::Unstable) + of("constant-curvature", Verdict::Wrong) > 0);
}

#[test]
fn a_shape_goes_through_the_rings_of_another_resolution() {
    let design = Design::new(Specification::paper(3)).unwrap();
    let with =
        |degree| Equilibrium::new(&design, None, Settings { degree, ..Settings::default() }, 2).unwrap();
    let (mut coarse, fine) = (with(1), with(4));
    let inputs = Inputs { uniform_field: [0.002, 0.008, -0.001].into(), ..Inputs::unloaded(4) };
    assert!(coarse.solve(&inputs).unwrap().solved());
    let rings: Vec<_> = coarse.rings().collect();
    let amplitudes = fine.amplitudes_through(&rings).unwrap();
    for (number, (got, expected)) in fine.rings_at(&inputs.base, &amplitudes).iter().zip(&rings).enumerate() {
        let apart = (got.position - expected.position).norm() / design.length();
        let turned = (got.rotation - expected.rotation).norm();
        assert!(apart.max(turned) <= INTERPOLATED, "ring {number}: {apart:e} of the length, {turned:e} rad");
    }
    assert!(fine.amplitudes_through(&rings[1..]).is_none(), "a ring is missing");
}

#[test]
fn every_method_is_tried_at_every_strength_cold_and_warm() {
    let attempts = attempts(1, Interaction::None, 0.0);
    for (_, method) in Method::ALL {
        for start in ["cold", "warm"] {
            let own = attempts.iter().filter(|attempt| (attempt.method, attempt.start) == (method, start));
            assert_eq!(own.count(), 8, "{method}, {start}");
        }
    }
    assert_eq!(stability_rays().len(), 3 * 3 * 13);
}
