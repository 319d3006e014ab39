//! Branches through folds, beside closed forms, the followed branch, and the energy.

use mcm::design::{Design, Specification};
use mcm::equilibrium::{Equilibrium, Inputs, Interaction, Settings, Shape};
use mcm::numerics::continuation::Walk;
use nalgebra::Vector3;

use crate::rod::table::Chain;

fn field(rings: usize, size: f64, degrees: f64) -> Inputs {
    let (sine, cosine) = degrees.to_radians().sin_cos();
    Inputs { uniform_field: Vector3::new(0.0, sine, cosine) * size, ..Inputs::unloaded(rings) }
}

fn bent(shape: &Shape) -> f64 {
    shape.tip.axis().y.atan2(shape.tip.axis().z)
}

#[test]
fn explore() {
    let mut chain = Chain::new(1);
    let size = 1.5 * chain.unit_field;
    chain.equilibrium.solve(&field(1, size, 0.0)).unwrap();
    let walk = Walk { from: 0.0, upwards: true, range: [0.0, 360.0], longest_step: 0.1, points: 400 };
    let clock = std::time::Instant::now();
    let diagram = chain.equilibrium.trace(|turn| Ok(field(1, size, turn)), &walk).unwrap();
    println!("{} {:?} {:?}", diagram.shapes.len(), diagram.end, clock.elapsed());
    for s in &diagram.shapes {
        println!("{:.8} {:.4} {:.2e} {} {:?}", s.value, bent(s), s.margin, s.unstable, s.kind);
    }
    for (segments, level) in [(1, Interaction::Full), (3, Interaction::Full), (3, Interaction::Rings)] {
        let design = Design::new(Specification::paper(segments)).unwrap();
        let settings = Settings { interaction: level, ..Settings::default() };
        let mut equilibrium = Equilibrium::new(&design, None, settings, 2).unwrap();
        let inputs = |b: f64| Ok(field(segments + 1, b, 90.0));
        let turned = |b: f64| Ok(field(segments + 1, 0.02, b));
        equilibrium.solve(&inputs(0.0).unwrap()).unwrap();
        let walk = Walk { from: 0.0, upwards: true, range: [0.0, 0.04], longest_step: 0.1, points: 60 };
        let clock = std::time::Instant::now();
        let diagram = if level == Interaction::Full {
            equilibrium.trace(inputs, &walk).unwrap()
        } else {
            equilibrium.trace(turned, &Walk { range: [0.0, 180.0], ..walk }).unwrap()
        };
        println!("{segments} {level:?} {} {:?} {:?}", diagram.shapes.len(), diagram.end, clock.elapsed());
        for s in &diagram.shapes {
            println!("{:.8} {:.4} {:.2e} {} {:?}", s.value, bent(s), s.margin, s.unstable, s.kind);
        }
    }
}
