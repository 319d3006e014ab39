//! What tests and recorded runs draw from: random numbers of a case, a random direction, and the paper's external magnet.

use core::f64::consts::TAU;

use mcm::geometry::Pose;
use mcm::magnetics::{AxialMagnet, Cylinders, Source};
use mcm::manipulator::{Inputs, PlacedSource};
use nalgebra::Vector3;
use rand::rngs::StdRng;
use rand::{RngExt, SeedableRng};

/// The random numbers of one case of a run, which is determined by the run's seed and its own number. Numbers are spread by the golden
/// ratio of 2^64, so that runs with neighbouring seeds share no case.
pub(crate) fn of_case(seed: u64, number: u64) -> StdRng {
    StdRng::seed_from_u64(seed ^ number.wrapping_mul(0x9E37_79B9_7F4A_7C15))
}

/// A unit vector, every direction as likely.
pub(crate) fn direction(random: &mut StdRng) -> Vector3<f64> {
    let height: f64 = random.random_range(-1.0..=1.0);
    let (sine, cosine) = random.random_range(0.0..TAU).sin_cos();
    let across = (1.0 - height * height).sqrt();
    Vector3::new(across * cosine, across * sine, height)
}

/// One cylinder of the paper's external magnet: 45 mm by 30 mm, 1.35 T.
pub(crate) fn cylinder() -> AxialMagnet {
    AxialMagnet { radius: 22.5e-3, inner_radius: 0.0, length: 30.0e-3, offset: 0.0, remanence: 1.35 }
}

/// That magnet (Richter et al., Fig. 7C): two cylinders with a gap of 10 mm.
pub(crate) fn pair() -> Source {
    let magnets =
        vec![AxialMagnet { offset: -20.0e-3, ..cylinder() }, AxialMagnet { offset: 20.0e-3, ..cylinder() }];
    Cylinders::new(magnets).expect("allowed").into()
}

/// Inputs without field or load beside that magnet, which is switched off.
pub(crate) fn unloaded_beside_pair(rings: usize) -> Inputs {
    let sources = vec![PlacedSource { pose: Pose::identity(), strength: 0.0 }];
    Inputs { sources, ..Inputs::unloaded(rings) }
}
