//! The same way of the magnet in few steps and in many.

use mcm::studies::communication_step;

use super::column;

#[test]
fn what_depends_on_the_step_is_told() {
    let study = communication_step().unwrap();
    for way in ["pass", "half_orbit", "snap_forth", "snap_back"] {
        let get = |name: &str| column(&study, name).to_vec();
        println!("{way}");
        for (((n, step), apart), snaps) in get("steps")
            .iter()
            .zip(get(&format!("{way}_step_mm")))
            .zip(get(&format!("{way}_apart_mm")))
            .zip(get(&format!("snaps_{way}")))
        {
            println!("  {n} {step:.2} mm: {apart:e} mm, {snaps}");
        }
    }
    println!("{:#?}", study.comparison);
}
