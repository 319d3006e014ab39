//! Fig. 7B: three segments and a solid cylinder.

use core::f64::consts::PI;

use mcm::studies::fig7b;

use super::{Counted, column};
use crate::equilibrium::rows;
use crate::tolerance::{COLLAPSE_MT, FOLD_ANGLE_DEG, PAPER_STOP_DEG, TWO_DECIMALS_DEG};

#[test]
fn branches_end_where_the_independent_model_loses_them() {
    let parts = Counted::default();
    let study = fig7b(&parts).unwrap();
    parts.assert_complete(12);
    let end = |way: &str, name: &str| {
        let mark = study.marks.iter().find(|mark| mark.name == format!("end {way} {name}"))?;
        Some([mark.x.unwrap(), mark.y.unwrap()])
    };
    let (full, rings) = (end("across", "full").unwrap(), end("turned", "rings").unwrap());
    assert!((full[0] - 17.82).abs() <= COLLAPSE_MT, "full, across: {full:?} mT");
    let expected = rows::list(&rows::row("c2_S3_rings_B20_th170").outputs["fold_theta_deg"]);
    assert!((rings[0] - expected[0]).abs() <= FOLD_ANGLE_DEG, "rings, turned: {rings:?}, {expected:?} deg");
    for (way, place, name, end) in
        [("across", "field_mt", "full", full), ("turned", "turn_deg", "rings", rings)]
    {
        let angles = column(&study, &format!("alpha_{way}_{name}_deg"));
        for (place, angle) in column(&study, place).iter().zip(angles) {
            assert_eq!(angle.is_nan(), *place > end[0], "{way} {name}: {angle} deg at {place}, end {end:?}");
        }
    }
    for name in ["rings_stop", "full_stop", "cylinder"] {
        assert!(end("across", name).is_none() && end("turned", name).is_none(), "{name} must not end");
    }
    for name in ["rings_stop", "full_stop"] {
        let last = column(&study, &format!("alpha_turned_{name}_deg"))[20];
        assert!((last - 119.0).abs() <= PAPER_STOP_DEG, "{name}: {last} deg");
    }
}

/// The couple on a uniformly magnetised rod turns its sections by `EI theta'' = -m B sin(phi - theta)`, whatever shear does:
/// by shooting with RK4 here.
#[test]
fn the_cylinder_bends_as_a_hard_magnetic_elastica() {
    let study = fig7b(&()).unwrap();
    let (length, radius, fraction) = (16e-3, 2e-3_f64, 0.2_f64);
    let young = 0.0981e6 * (56.0 + 7.66 * 33.0) / (0.137_505 * (254.0 - 2.54 * 33.0))
        * (2.5 * fraction / (1.0 - 1.35 * fraction)).exp();
    let line_moment = fraction / (4e-7 * PI) * PI * radius * radius;
    let load = line_moment * 0.02 * length * length / (young * PI * radius.powi(4) / 4.0);
    for (turn, got) in column(&study, "turn_deg").iter().zip(column(&study, "alpha_turned_cylinder_deg")) {
        let expected = elastica(load, turn.to_radians()).to_degrees();
        assert!((got - expected).abs() <= TWO_DECIMALS_DEG, "{turn} deg: {got}, expected {expected}");
    }
}

/// Tip angle of the elastica `theta'' = -load sin(phi - theta)`, clamped at 0, free at 1.
fn elastica(load: f64, phi: f64) -> f64 {
    const STEPS: u32 = 100;
    let shoot = |start: f64| {
        let slope = |[theta, rate]: [f64; 2]| [rate, -load * (phi - theta).sin()];
        let ahead = |y: [f64; 2], k: [f64; 2], h: f64| [y[0] + h * k[0], y[1] + h * k[1]];
        let (mut y, h) = ([0.0, start], 1.0 / f64::from(STEPS));
        for _ in 0..STEPS {
            let first = slope(y);
            let second = slope(ahead(y, first, 0.5 * h));
            let third = slope(ahead(y, second, 0.5 * h));
            let fourth = slope(ahead(y, third, h));
            for i in 0..2 {
                y[i] += h / 6.0 * (first[i] + 2.0 * second[i] + 2.0 * third[i] + fourth[i]);
            }
        }
        y
    };
    let (mut low, mut high) = (0.0, load);
    for _ in 0..60 {
        let middle = 0.5 * (low + high);
        if shoot(middle)[1] < 0.0 { low = middle } else { high = middle }
    }
    shoot(0.5 * (low + high))[0]
}
