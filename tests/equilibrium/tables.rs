//! Tables that models of one process share.

use std::thread;

use mcm::equilibrium::{Equilibrium, Inputs, Interaction, Settings, Solution};
use mcm::manipulator::Scene;

fn model(segments: usize, settings: Settings) -> Equilibrium {
    let scene = Scene::parse(&format!("[design]\nsegments = {segments}"), "shared").expect("allowed");
    Equilibrium::new(&scene.design().expect("allowed"), None, settings, 5).expect("allowed")
}

fn tip(model: &mut Equilibrium, field: f64) -> [f64; 3] {
    let inputs = Inputs { uniform_field: [0.0, field, 0.0].into(), ..Inputs::unloaded(3) };
    assert!(model.solve(&inputs).expect("allowed").outcome.is_solved());
    model.tip().position.into()
}

#[test]
fn only_models_of_one_design_and_discretisation_share_them() {
    let usual = Settings { interaction: Interaction::Full, ..Settings::default() };
    let one = model(2, usual);
    let alike = [
        usual,
        Settings { tolerance: 1e-9, time_budget: 5.0, ..usual },
        Settings { tolerance_position: 1e-6, fold_margin: 0.1, ..usual },
    ];
    for settings in alike {
        assert!(one.shares_tables_with(&model(2, settings)), "{settings:?}");
    }
    let others = [
        Settings { interaction: Interaction::Rings, ..usual },
        Settings { degree: 3, ..usual },
        Settings { pair_accuracy: 1e-4, ..usual },
        Settings { cylinder_elements: 4, ..usual },
        Settings { bending_stop: Some(true), ..usual },
    ];
    for settings in others {
        assert!(!one.shares_tables_with(&model(2, settings)), "{settings:?}");
    }
    assert!(!one.shares_tables_with(&model(3, usual)));
}

#[test]
fn sixteen_threads_that_make_and_drop_them_answer_as_one() {
    let usual = Settings { interaction: Interaction::Rings, ..Settings::default() };
    let fields = [2e-3, 5e-3, 8e-3];
    let expected = fields.map(|field| tip(&mut model(2, usual), field));
    let answers: Vec<_> = thread::scope(|scope| {
        let one =
            || (0..10).map(|_| fields.map(|field| tip(&mut model(2, usual), field))).collect::<Vec<_>>();
        let all: Vec<_> = (0..16).map(|_| scope.spawn(one)).collect();
        all.into_iter().flat_map(|thread| thread.join().expect("no panic")).collect()
    });
    assert_eq!(answers.len(), 160);
    assert!(answers.iter().all(|answer| *answer == expected));
}
