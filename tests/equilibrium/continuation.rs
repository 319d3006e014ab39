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
}

#[test]
fn explore_magnet() {
    use crate::equilibrium::rows::pair;
    use mcm::geometry::Pose;
    use mcm::manipulator::{Branch, Manipulator};
    let design = Design::new(Specification::paper(9)).unwrap();
    for level in [Interaction::None, Interaction::Rings] {
        let settings = Settings { interaction: level, ..Settings::default() };
        let flip = [[1.0, 0.0, 0.0, 0.0], [0.0, 1.0, 0.0, 0.0]];
        type Way = (&'static str, Box<dyn Fn(f64) -> Pose>, f64, [f64; 2]);
        let ways: Vec<Way> = vec![(
            "approach +z at 0",
            Box::new(move |p: f64| Pose::new([0.0, -1e-3 * p, 0.0], flip[0]).unwrap()),
            300.0,
            [130.0, 300.0],
        )];
        for (name, pose, from, range) in ways {
            let inputs =
                |p: f64| Ok(Inputs { magnet: pose(p), magnet_strength: 1.0, ..Inputs::unloaded(10) });
            let mut equilibrium = Equilibrium::new(&design, Some(&pair()), settings, 2).unwrap();
            let clock = std::time::Instant::now();
            let report = equilibrium.solve(&inputs(from).unwrap()).unwrap();
            println!("{level:?} {name}: {report:?}");
            let walk = Walk { from, upwards: from == range[0], range, longest_step: 0.2, points: 150 };
            let diagram = equilibrium.trace(inputs, &walk).unwrap();
            println!("{} {:?} {:?}", diagram.shapes.len(), diagram.end, clock.elapsed());
            for (i, s) in diagram
                .shapes
                .iter()
                .enumerate()
                .filter(|(i, s)| i % 4 == 0 || s.kind != mcm::numerics::continuation::Kind::Regular)
            {
                println!("{i} {:.6} {:.4} {:.2e} {} {:?}", s.value, bent(s), s.margin, s.unstable, s.kind);
            }
            let m = Manipulator::new(&design, Some(&pair()), settings, 2).unwrap();
            let span = range[1] - range[0];
            let mut branch = Branch::new(m, inputs, span, span / 50.0).unwrap();
            let other = if from == range[0] { range[1] } else { range[0] };
            let clock = std::time::Instant::now();
            branch.to(from).unwrap();
            branch.to(other).unwrap();
            branch.to(from).unwrap();
            for f in branch.folds() {
                println!(
                    "branch {} {} {:?} -> {:?}",
                    f.value,
                    f.upwards,
                    f.before.tip_angle,
                    f.after.as_ref().map(|a| a.1.tip_angle)
                );
            }
            println!("{:?}", clock.elapsed());
        }
    }
}
