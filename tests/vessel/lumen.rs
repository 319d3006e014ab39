//! Several vessels: where they meet, their walls merge smoothly.

use mcm::vessel::{Branch, Lumen};
use nalgebra::Vector3;

use super::{NEAR_AXIS, STEP, errors_of_derivatives, points_near, winding};
use crate::tolerance::{CLEARANCE, CLEARANCE_SLOPE};

fn straight(name: &str, from: [f64; 3], to: [f64; 3], radius: f64) -> Branch {
    Branch::new(name, &[from.into(), to.into()], &[radius; 2]).unwrap()
}

#[test]
fn one_branch_is_itself() {
    let branch = winding(1);
    let lumen = Lumen::new(vec![branch.clone()]).unwrap();
    for point in points_near(&branch, 1, 20) {
        assert_eq!(lumen.clearance(&point), branch.clearance(&point));
    }
}

#[test]
fn far_from_a_mouth_each_branch_counts_alone() {
    let main = straight("main", [0.0; 3], [0.0, 0.0, 0.1], 5e-3);
    let side = straight("side", [0.0, 0.0, 0.03], [0.05, 0.0, 0.09], 3e-3);
    let lumen = Lumen::new(vec![main.clone(), side.clone()]).unwrap();
    for (point, alone) in [([0.0, 3e-3, 0.002], &main), ([0.045, 1e-3, 0.083], &side)] {
        let (own, whole) = (alone.clearance(&point.into()), lumen.clearance(&point.into()));
        assert!((own.value - whole.value).abs() < CLEARANCE, "{:e}", own.value - whole.value);
        assert!((own.gradient - whole.gradient).norm() < 1e-12);
    }
}

#[test]
fn a_mouth_is_widened_by_at_most_the_merging_length_times_ln_2() {
    let main = straight("main", [0.0; 3], [0.0, 0.0, 0.1], 5e-3);
    let side = straight("side", [0.0, 0.0, 0.03], [0.05, 0.0, 0.09], 3e-3);
    let mut widest: f64 = 0.0;
    for length in [1e-4, 5e-4] {
        let lumen = Lumen::new(vec![main.clone(), side.clone()]).unwrap().merged_over(length).unwrap();
        for point in points_near(&side, 3, 400) {
            let sharp = [&main, &side].map(|branch| branch.clearance(&point).value);
            let excess = lumen.clearance(&point).value - sharp[0].max(sharp[1]);
            assert!((-1e-17..=length * 2.0_f64.ln() * (1.0 + 1e-12)).contains(&excess), "{excess:e}");
            widest = widest.max(excess / length);
        }
    }
    assert!(widest > 0.5, "no point near the mouth: {widest}");
}

#[test]
fn derivatives_are_those_of_differences_through_mouths() {
    let (mut slopes, mut curves) = (0.0_f64, 0.0_f64);
    for number in 0..10 {
        let branches = [winding(2 * number), winding(2 * number + 1)];
        let lumen = Lumen::new(branches.to_vec()).unwrap();
        for branch in &branches {
            for point in points_near(branch, number, 40) {
                if branches.iter().any(|branch| branch.clearance(&point).hessian.norm() > NEAR_AXIS) {
                    continue;
                }
                let [slope, curve] = errors_of_derivatives(|x| lumen.clearance(x), &point, STEP);
                (slopes, curves) = (slopes.max(slope), curves.max(curve));
            }
        }
    }
    println!("gradients to {slopes:.1e}, second derivatives to {curves:.1e}");
    assert!(slopes < CLEARANCE_SLOPE && curves < CLEARANCE_SLOPE, "{slopes:e}, {curves:e}");
}

#[test]
fn what_is_no_lumen_is_refused() {
    let refused = |lumen: Result<Lumen, mcm::error::Error>| lumen.unwrap_err().to_string();
    assert!(refused(Lumen::new(Vec::new())).contains("list of vessel branches has 0 entries"));
    let branch = straight("aorta", [0.0; 3], [0.0, 0.0, 0.1], 9e-3);
    let twice = Lumen::new(vec![branch.clone(), branch.clone()]);
    assert_eq!(refused(twice), "two vessel branches are called \"aorta\"");
    let lumen = Lumen::new(vec![branch]).unwrap();
    assert!(refused(lumen.clone().merged_over(0.0)).contains("length over which vessel walls merge (m) = 0"));
    assert!(lumen.merged_over(f64::NAN).is_err());
}

#[test]
fn a_point_far_away_is_outside_and_finite() {
    let lumen = Lumen::new(vec![winding(8), straight("side", [0.0; 3], [0.05, 0.0, 0.0], 3e-3)]).unwrap();
    let clearance = lumen.clearance(&Vector3::new(10.0, -7.0, 3.0));
    assert!(clearance.value < -10.0 && clearance.hessian.iter().all(|entry| entry.is_finite()));
}
