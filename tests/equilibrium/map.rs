//! Thousands of fields in all directions: what is called solved is in balance and stable, what is not is said, and the
//! last good shape is kept.

use mcm::design::{Design, Specification};
use mcm::equilibrium::{Equilibrium, Inputs, Interaction, Report, Settings, Solution};
use nalgebra::{DMatrix, SymmetricEigen, Vector3};
use rand::rngs::StdRng;
use rand::{RngExt, SeedableRng};
use rayon::prelude::*;

use crate::given::direction;
use crate::tolerance::{BALANCED, NEUTRAL_SHAPE};

/// Cells of the map, each from its own seed.
const CELLS: u64 = 2400;

/// Strongest field, T: twice what closes the paper's segments.
const STRONGEST: f64 = 0.04;

/// Steps of the differences of energies and of gradients, in radians of the first mode.
const LONG_STEPS: [f64; 5] = [1e-3, 3e-4, 1e-4, 3e-5, 1e-5];
const STEP: f64 = 1e-5;

/// A manipulator and the fields that it is led through.
struct Cell {
    equilibrium: Equilibrium,
    fields: Vec<Vector3<f64>>,
    name: String,
}

/// What came of a cell.
enum Outcome {
    /// Solved: what is left of the slope of the energy, and smallest eigenvalue of the Hessian.
    Solved {
        slope: f64,
        eigenvalue: f64,
        told: Option<bool>,
    },
    Refused,
}

impl Cell {
    fn random(number: u64) -> Self {
        let mut random = StdRng::seed_from_u64(number);
        let segments = if random.random_bool(0.03) { 9 } else { random.random_range(1..=3) };
        let level = match random.random_range(0..10) {
            0 if segments < 3 => Interaction::Full,
            1..=5 => Interaction::Rings,
            _ => Interaction::None,
        };
        let mut field = || direction(&mut random) * random.random_range(0.0..=STRONGEST);
        // Cold, along the growing field, or from a field elsewhere.
        let (first, last) = (field(), field());
        let fields = match number % 3 {
            0 => vec![last],
            1 => (1..=8).map(|part| last * (f64::from(part) / 8.0)).collect(),
            _ => vec![first, last],
        };
        let design = Design::new(Specification::paper(segments)).unwrap();
        let settings = Settings { interaction: level, ..Settings::default() };
        let equilibrium = Equilibrium::new(&design, None, settings, 2).unwrap();
        let name = format!("cell {number}: S = {segments}, {}, {fields:?} T", level.name());
        Self { equilibrium, fields, name }
    }

    fn inputs(&self, field: Vector3<f64>) -> Inputs {
        Inputs { uniform_field: field, ..Inputs::unloaded(self.equilibrium.rings().count()) }
    }

    fn solve(&mut self, inputs: &Inputs) -> Report {
        let before = (self.equilibrium.unknowns().to_vec(), self.equilibrium.inputs().cloned());
        let report = self.equilibrium.solve(inputs).unwrap();
        let after = (self.equilibrium.unknowns().to_vec(), self.equilibrium.inputs().cloned());
        if report.solved() {
            assert_eq!(after.1.as_ref(), Some(inputs), "{}", self.name);
        } else {
            assert_eq!(after, before, "{}: not solved, and the last shape is lost", self.name);
        }
        report
    }

    fn outcome(mut self) -> Outcome {
        let mut last = None;
        for field in self.fields.clone() {
            let inputs = self.inputs(field);
            last = Some((self.solve(&inputs), inputs));
        }
        let (report, inputs) = last.unwrap();
        if !report.solved() {
            return Outcome::Refused;
        }
        let shape = self.equilibrium.unknowns().to_vec();
        let slope = slope_of_energy(&mut self.equilibrium, &inputs, &shape);
        let eigenvalue = smallest_eigenvalue(&mut self.equilibrium, &inputs, &shape);
        Outcome::Solved { slope, eigenvalue, told: report.stable }
    }
}

/// Roots of the metric, and the first: what turns one element by a radian.
fn weights(equilibrium: &Equilibrium) -> (Vec<f64>, f64) {
    let roots: Vec<f64> = equilibrium.metric().iter().map(|k| k.sqrt()).collect();
    let unit = roots[0];
    (roots, unit)
}

/// Norm of the slope of the energy by differences, in turns of one element by a radian.
///
/// Where a pair of rings changes its quadrature within a step the energy jumps; shorter steps, whose noise is larger, then tell.
/// A slope that is there is seen by all.
fn slope_of_energy(equilibrium: &mut Equilibrium, inputs: &Inputs, shape: &[f64]) -> f64 {
    let slopes = LONG_STEPS.iter().map(|step| slope_by_steps(equilibrium, inputs, shape, *step));
    let mut least = f64::INFINITY;
    for slope in slopes {
        least = least.min(slope);
        if least <= BALANCED {
            break;
        }
    }
    least
}

/// Norm of the slope of the energy by differences of fourth order with steps of one length: to both sides, or, where that shows a
/// slope and one side a lesser one, to one.
fn slope_by_steps(equilibrium: &mut Equilibrium, inputs: &Inputs, shape: &[f64], step: f64) -> f64 {
    let (roots, unit) = weights(equilibrium);
    let slope = |i: usize| {
        let mut at = |steps: f64| {
            let mut moved = shape.to_vec();
            moved[i] += steps * step * unit / roots[i];
            equilibrium.gradient(inputs, &moved).unwrap().0
        };
        let scale = 12.0 * step * unit * unit;
        let both = (8.0 * (at(1.0) - at(-1.0)) - (at(2.0) - at(-2.0))) / scale;
        if both.abs() <= BALANCED {
            return both;
        }
        let one = [1.0, -1.0].map(|side| {
            let weighted = [(0.0, -25.0), (1.0, 48.0), (2.0, -36.0), (3.0, 16.0), (4.0, -3.0)];
            weighted.into_iter().map(|(steps, weight)| weight * at(side * steps)).sum::<f64>() / scale
        });
        one.iter().fold(both.abs(), |least, one| least.min(one.abs()))
    };
    (0..shape.len()).map(slope).map(|slope| slope * slope).sum::<f64>().sqrt()
}

/// Smallest eigenvalue of the Hessian, as a full matrix by differences of gradients, relative to the elastic energy.
fn smallest_eigenvalue(equilibrium: &mut Equilibrium, inputs: &Inputs, shape: &[f64]) -> f64 {
    let (roots, unit) = weights(equilibrium);
    let size = shape.len();
    let mut hessian = DMatrix::zeros(size, size);
    for i in 0..size {
        let mut at = |side: f64| {
            let mut moved = shape.to_vec();
            moved[i] += side * STEP * unit / roots[i];
            equilibrium.gradient(inputs, &moved).unwrap().1
        };
        let sides = [at(1.0), at(-1.0)];
        for j in 0..size {
            hessian[(j, i)] = (sides[0][j] - sides[1][j]) / (2.0 * STEP * unit * roots[j]);
        }
    }
    SymmetricEigen::new((&hessian + hessian.transpose()) * 0.5).eigenvalues.min()
}

#[test]
fn what_is_called_solved_is_in_balance_and_stable_and_the_rest_is_said() {
    let outcomes: Vec<(String, Outcome)> = (0..CELLS)
        .into_par_iter()
        .map(|number| {
            let cell = Cell::random(number);
            (cell.name.clone(), cell.outcome())
        })
        .collect();
    let (mut refused, mut neutral, mut steepest, mut softest) = (0, 0, 0.0_f64, f64::INFINITY);
    let mut wrong = Vec::new();
    for (name, outcome) in &outcomes {
        let Outcome::Solved { slope, eigenvalue, told } = outcome else {
            refused += 1;
            continue;
        };
        let verdict_holds = match told {
            Some(true) => *eigenvalue > 0.0,
            _ => eigenvalue.abs() <= NEUTRAL_SHAPE,
        };
        if *slope > BALANCED || !verdict_holds {
            wrong.push(format!("{name}: slope {slope:e}, told {told:?}, eigenvalue {eigenvalue:e}"));
        }
        (neutral, steepest) = (neutral + u64::from(*told != Some(true)), steepest.max(*slope));
        softest = softest.min(*eigenvalue);
    }
    let solved = CELLS - refused;
    println!(
        "{solved} solved ({neutral} neutral, and said so), {refused} refused; slope at most {steepest:.1e}, eigenvalue at least \
         {softest:.1e}"
    );
    assert!(wrong.is_empty(), "{} of {solved}:\n{}", wrong.len(), wrong.join("\n"));
    assert!(solved > CELLS / 2 && refused > CELLS / 50, "{solved} solved, {refused} refused");
}

#[test]
fn the_verification_sees_what_is_unstable_and_what_is_out_of_balance() {
    let mut cell = Cell::random(0);
    let settings = Settings { interaction: Interaction::Rings, ..Settings::default() };
    let design = Design::new(Specification::paper(3)).unwrap();
    cell.equilibrium = Equilibrium::new(&design, None, settings, 2).unwrap();
    let unloaded = cell.inputs(Vector3::zeros());
    assert!(cell.solve(&unloaded).solved());
    let mut straight = cell.equilibrium.unknowns().to_vec();
    // Straight in a field against it: in balance, but not for long.
    let against = cell.inputs(Vector3::new(0.0, 0.0, -0.02));
    assert!(slope_of_energy(&mut cell.equilibrium, &against, &straight) <= BALANCED);
    assert!(smallest_eigenvalue(&mut cell.equilibrium, &against, &straight) < -NEUTRAL_SHAPE);
    straight[0] += 1e-3;
    assert!(slope_of_energy(&mut cell.equilibrium, &unloaded, &straight) > BALANCED);
}
