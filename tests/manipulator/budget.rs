//! The time budget of a step along a branch covers all that the step does, and what it leaves out is said.

use std::time::Duration;

use cpu_time::ThreadTime;
use mcm::error::Error;
use mcm::manipulator::{Branch, Budget, Followed, Inputs, Outcome, Outputs, Scene, Snapshot, Status};
use nalgebra::Vector3;

/// Processor time of each solve of the stand-in, and its budget.
const SOLVE: Duration = Duration::from_millis(2);
const BUDGET: f64 = 0.01;

/// A device that snaps where the field exceeds 1 T, and takes its time.
#[derive(Debug, Clone)]
struct Slow {
    outputs: Outputs,
}

impl Followed for Slow {
    fn solve(&mut self, inputs: &Inputs) -> Result<&Outputs, Error> {
        let start = ThreadTime::now();
        while start.elapsed() < SOLVE {}
        let snaps = u32::from(inputs.uniform_field.y > 1.0);
        self.outputs.status = if snaps > self.outputs.snaps { Status::Snapped } else { Status::Solved };
        self.outputs.snaps = snaps;
        self.outputs.iterations += 1;
        Ok(&self.outputs)
    }

    fn outputs(&self) -> &Outputs {
        &self.outputs
    }

    fn start_anew(&mut self) {}

    fn time_budget(&self) -> f64 {
        BUDGET
    }

    fn measure_margin(&mut self) -> &Outputs {
        &self.outputs
    }

    fn set_time_budget(&mut self, _: f64) {}

    fn snapshot(&self) -> Option<Snapshot> {
        None
    }

    fn restore(&mut self, _: &Snapshot) -> Result<(), Error> {
        Err(Error::Unsupported("a stand-in".into()))
    }
}

fn one_segment(settings: &str) -> Scene {
    Scene::parse(&format!("[design]\nsegments = 1\n[model]\ntime_budget_s = 60\n{settings}"), "one segment")
        .unwrap()
}

fn across(field: f64) -> Inputs {
    Inputs { uniform_field: Vector3::new(0.0, field, 0.0), ..Inputs::unloaded(2) }
}

#[test]
fn the_search_for_a_fold_ends_with_the_budget_and_says_so() {
    let outputs = one_segment("").manipulator(2).unwrap().outputs().clone();
    let slow = Slow { outputs };
    let unsnapped = slow.clone();
    let mut branch = Branch::new(slow, |field| Ok(across(field)), 1.6, 1.6).unwrap();
    branch.to(0.0).unwrap();
    assert_eq!(branch.left_out(), None);
    branch.to(1.6).unwrap();

    let [fold] = branch.folds() else { panic!("{:?}", branch.folds()) };
    assert!(!fold.located && fold.width > 0.01, "{fold:?}");
    assert!((fold.value - 1.0).abs() <= 0.5 * fold.width, "{fold:?}");
    let said = branch.left_out().expect("a search that was cut off");
    assert!(said.contains("between") && said.contains("model.time_budget_s"), "{said}");
    assert_eq!(branch.outputs().snaps, 1);

    // Of many short steps the rest is one.
    let mut branch = Branch::new(unsnapped, |field| Ok(across(field)), 0.9, 0.01).unwrap();
    branch.to(0.0).unwrap();
    let steps = branch.to(0.9).unwrap().iterations;
    assert!(steps < 20, "{steps} steps of {SOLVE:?} in {BUDGET} s");
    assert!(branch.left_out().is_some_and(|said| said.contains("one step")), "{:?}", branch.left_out());
    branch.to(0.0).unwrap();
}

#[test]
fn after_a_failure_the_next_step_starts_anew() {
    let scene = one_segment("interaction = \"full\"");
    let mut branch =
        Branch::new(scene.manipulator(2).unwrap(), |field| Ok(across(field)), 0.06, 0.001).unwrap();
    branch.to(0.0).unwrap();
    branch.to(0.04).unwrap();
    assert_eq!(branch.folds().len(), 1, "one segment is pulled shut");
    assert_eq!(branch.outputs().status, Status::NotSolved);

    for field in [0.05, 0.06] {
        let mut fresh = scene.manipulator(2).unwrap();
        let alone = fresh.solve(&across(field)).unwrap();
        let found = branch.to(field).unwrap();
        assert_eq!((found.outcome, found.iterations), (alone.outcome, alone.iterations), "{field} T");
    }
    // The other way leads on from the last shape.
    branch.to(0.03).unwrap();
    let mut fresh = scene.manipulator(2).unwrap();
    let expected = fresh.solve(&across(0.03)).unwrap().tip_angle;
    assert!((branch.outputs().tip_angle - expected).abs() < 1e-7);
}

#[test]
fn a_budget_that_is_used_up_is_named_and_no_fold() {
    let mut scene = one_segment("interaction = \"full\"");
    scene.settings.iterations = 2;
    let mut branch =
        Branch::new(scene.manipulator(2).unwrap(), |field| Ok(across(field)), 0.03, 0.03).unwrap();
    branch.to(0.0).unwrap();
    let found = branch.to(0.03).unwrap();
    assert_eq!(found.outcome, Outcome::OutOfBudget(Budget::Iterations));
    assert!(found.outcome.to_string().contains("model.iterations"));
    assert!(branch.folds().is_empty());

    let mut hurried = one_segment("interaction = \"full\"").manipulator(2).unwrap();
    hurried.set_time_budget(0.0);
    let found = hurried.solve(&across(0.03)).unwrap();
    assert_eq!(found.outcome, Outcome::OutOfBudget(Budget::Time));
    assert!(found.outcome.to_string().contains("model.time_budget_s"));
}
