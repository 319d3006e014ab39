//! The exact magnetic field of one ring magnet on a line of points, beside that of a dipole of the same moment.
//! `cargo run --release --example ring_field`
#![allow(clippy::print_stdout, reason = "a program that prints a table")]

use mcm::error::Error;
use mcm::magnetics::{AxialSource, Dipole};
use mcm::nalgebra::Vector3;

fn main() -> Result<(), Error> {
    // Inner and outer radius and length in m, remanence in T: the paper's ring, magnetised along z.
    let ring = AxialSource::new(0.75e-3, 2.0e-3, 1.0e-3, 1.35)?;
    let dipole = Dipole::new(Vector3::z() * ring.moment())?;
    println!("magnetic moment {:.3e} A m2", ring.moment());

    println!("   z (mm)   B_x (mT)   B_z (mT)   dB_z/dz (T/m)   B_z of the dipole (mT)");
    for z in [2.0, 3.0, 5.0, 10.0, 20.0] {
        let point = Vector3::new(1.0, 0.0, z) * 1e-3; // 1 mm beside the axis
        let (field, gradient) = ring.field_gradient(&point)?;
        let far = dipole.field(&point)?;
        println!(
            "{z:9.1} {:10.3} {:10.3} {:15.4} {:24.3}",
            1e3 * field.x,
            1e3 * field.z,
            gradient[(2, 2)],
            1e3 * far.z
        );
    }
    Ok(())
}
