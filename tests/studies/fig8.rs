//! Fig. 8: torques on the last of several rings.

use core::f64::consts::TAU;

use mcm::constants::VACUUM_PERMEABILITY;
use mcm::magnetics::AxialSource;
use mcm::studies::fig8;
use nalgebra::{Rotation3, Vector3};

use super::column;
use crate::tolerance::{CELLS, assert_close};

/// Torques about x on the second ring at 40 deg by field and gradient (uN m), summed over small cells.
fn summed() -> [f64; 2] {
    const CELLS: [u32; 3] = [24, 24, 72];
    let ring = AxialSource::new(0.75e-3, 2e-3, 1e-3, 1.35).unwrap();
    let bent = 40.0_f64.to_radians();
    let turn = Rotation3::from_axis_angle(&Vector3::x_axis(), bent).into_inner();
    let axis = turn.column(2).into_owned();
    let radius = 4e-3 / bent;
    let arc = Vector3::new(0.0, -radius * (1.0 - bent.cos()), radius * bent.sin());
    let centre = Vector3::z() * 0.5e-3 + arc + axis * 0.5e-3;
    let middle = |index: u32, count: u32| (f64::from(index) + 0.5) / f64::from(count);
    let mut sums = [0.0; 2];
    for (i, j, k) in
        (0..CELLS[0]).flat_map(|i| (0..CELLS[1]).flat_map(move |j| (0..CELLS[2]).map(move |k| (i, j, k))))
    {
        let rho = 0.75e-3 + 1.25e-3 * middle(i, CELLS[0]);
        let height = 1e-3 * (middle(j, CELLS[1]) - 0.5);
        let (sine, cosine) = (TAU * middle(k, CELLS[2])).sin_cos();
        let arm = turn * Vector3::new(rho * cosine, rho * sine, height);
        let cell =
            1.25e-3 / f64::from(CELLS[0]) * 1e-3 / f64::from(CELLS[1]) * rho * TAU / f64::from(CELLS[2]);
        let moment = axis * (1.35 / VACUUM_PERMEABILITY * cell);
        let (field, gradient) = ring.field_gradient(&(centre + arm)).unwrap();
        sums[0] += 1e6 * moment.cross(&field).x;
        sums[1] += 1e6 * arm.cross(&(gradient * moment)).x;
    }
    sums
}

#[test]
fn torques_of_two_rings_are_those_of_a_sum_over_cells() {
    let study = fig8().unwrap();
    let got =
        ["field_torque_2_rings_unm", "gradient_torque_2_rings_unm"].map(|name| column(&study, name)[39]);
    assert_close("40 deg", &got, &summed(), CELLS);
    // The same by another implementation.
    assert_close("40 deg", &got, &[-25.93, 34.48], CELLS);
}

#[test]
fn every_ring_more_shifts_the_torque_to_the_field() {
    let study = fig8().unwrap();
    let sums = |count: usize| column(&study, &format!("torque_{count}_rings_unm"));
    assert!(sums(2).iter().all(|sum| *sum > 0.0), "two rings: the gradient wins");
    for count in 3..=5 {
        assert!(sums(count).iter().zip(sums(count - 1)).all(|(more, fewer)| more < fewer), "{count} rings");
    }
    assert!(sums(5)[19] < 0.0, "five rings at 20 deg: the field wins");
}

#[test]
fn the_sum_changes_sign_at_the_spacing_of_balance() {
    let study = fig8().unwrap();
    for count in 2..=5 {
        let balance = column(&study, &format!("balance_spacing_{count}_rings_mm"))[19];
        let sums = column(&study, &format!("torque_at_20_deg_{count}_rings_unm"));
        for (spacing, sum) in column(&study, "spacing_mm").iter().zip(sums) {
            assert_eq!(*sum > 0.0, *spacing < balance, "{count} rings at {spacing} mm");
        }
    }
}
