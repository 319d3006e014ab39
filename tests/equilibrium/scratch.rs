use super::rows::*;
use mcm::equilibrium::*;
use nalgebra::*;
#[test]
fn scratch() {
    println!("C");
    for id in ["c5_crit_antiparallel_S1_rings", "c5_crit_antiparallel_S3_none"] {
        let row = row(id);
        let b = number(&row.outputs, "critical_B_T");
        for f in [1.001, 1.01, 1.05, 1.1] { for off in [0.0, 1e-6, 1e-3, 1e-2, 0.1] {
            let mut eq = row.equilibrium();
            let i = Inputs { uniform_field: Vector3::new(0.0, off * b * f, -b * f), ..row.inputs.clone() };
            let r = eq.solve(&i).unwrap();
            println!("{id} {f} off {off} {} snaps {} it {} res {:.1e} margin {:.4} tip {:?}", r.solved, r.snaps, r.iterations, r.residual, r.margin, eq.tip().position.as_slice());
        }}
    }
}
