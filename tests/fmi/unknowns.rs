//! Outputs as hosts ask for them: all as Real, and the derivatives of each by all that it is declared to depend on.

use mcm::fmi::derivative_role::DerivativeRole;
use mcm::fmi::state::Ending;
use mcm::fmi::value::{DataType, Value};
use mcm::fmi::variable::{Causality, Variability, Variable};
use mcm::fmi::variables::Table;
use mcm::fmi::{Instance, Package};

use super::instance::{get, initialised, reference, set};
use super::{instance, last};

/// Bent out of the plane under its weight, beside magnets: no derivative vanishes for symmetry.
const HEAVY: &str = "[design]\nsegments = 1\n[field]\nuniform_mt = [2.0, 8.0, 1.0]\n[gravity]\n\
    acceleration_m_s2 = [3.0, -9.0, 2.0]\n[model]\ninteraction = \"rings\"\n[magnet]\n";

/// Three segments on a shaft that a field presses against the wall of a tube.
const PUSHED: &str = "[design]\nsegments = 2\n[field]\nuniform_mt = [1.0, 5.0, 0.0]\n[model]\ninteraction = \"none\"\n\
    time_budget_s = 20.0\n[feed]\nmode = \"insertion\"\ninsertion_mm = 7.0\n[feed.shaft]\nouter_radius_mm = 0.75\n\
    inner_radius_mm = 0.25\nelastic_modulus_mpa = 1.0\npoisson = 0.45\n[vessel]\nfriction = 0.0\n[[vessel.branch]]\n\
    name = \"tube\"\npoints_mm = [[0, 0, -20], [0, 0, 40], [0, 0, 100]]\nradius_mm = 3.0\n";

/// Sources that pull at one another.
const SOURCES: &str = "[design]\nsegments = 1\n[[magnet]]\n[[magnet]]\nposition_mm = [150.0, 0.0, 0.0]\n[[coil]]\n\
    position_mm = [0.0, 90.0, 0.0]\ninner_radius_mm = 20.0\nouter_radius_mm = 40.0\nlength_mm = 60.0\nturns = 600\n\
    current_a = 1.0\n[model]\nmutual_wrenches = true\ninteraction = \"none\"";

fn rows(table: &Table, holds: impl Fn(&Variable) -> bool) -> Vec<&Variable> {
    table.variables().iter().filter(|variable| holds(variable)).collect()
}

fn is_real(variable: &Variable) -> bool {
    matches!(variable.data_type, DataType::Real(_))
}

fn real(variable: &Variable, package: &Package) -> f64 {
    variable.host_value(package.start()).and_then(Value::real).unwrap()
}

#[test]
fn every_output_is_a_real_with_derivatives_and_every_other_result_is_local() {
    for scene in [HEAVY, PUSHED, SOURCES] {
        let package = Package::new(scene, "test scene", 3).unwrap();
        for row in rows(package.table(), Variable::is_result) {
            let output = row.causality == Causality::Output;
            let fit = is_real(row) && row.variability == Variability::Continuous;
            assert_eq!(output, fit && row.derivative_role.is_unknown(), "{}", row.name);
            assert_eq!(
                row.causality == Causality::Local,
                row.variability == Variability::Discrete,
                "{}",
                row.name
            );
        }
        let local = |name: &str| {
            let row = package.table().find(package.table().reference(name).unwrap()).unwrap();
            row.causality == Causality::Local
        };
        for name in
            ["solver.status", "stability.margin", "stability.stable", "model.level", "model.error_estimate"]
        {
            assert!(local(name), "{name}");
        }
        if scene == PUSHED {
            assert!(local("contact.count") && !local("contact.force[1]") && !local("feed.length"));
        }
    }
}

/// An instance in initialisation mode, with one variable set.
fn initialising(scene: &str, changed: Option<(&str, f64)>) -> (Instance, Package, super::Told) {
    let (mut instance, package, told) = instance(scene);
    instance.enter_initialization();
    if let Some((name, value)) = changed {
        assert_eq!(set(&mut instance, package.table(), name, value), Ending::Ok, "{}", last(&told));
    }
    (instance, package, told)
}

/// Values of the outputs, sought from the unloaded shape.
fn values(scene: &str, unknowns: &[u32], changed: Option<(&str, f64)>) -> Vec<f64> {
    let (mut instance, _, told) = initialising(scene, changed);
    instance.get(unknowns, "Real", Value::real).unwrap_or_else(|_| panic!("{changed:?} {}", last(&told)))
}

#[test]
fn initial_unknowns_have_derivatives_by_all_that_they_are_declared_to_depend_on() {
    for scene in [HEAVY, PUSHED, SOURCES] {
        let (mut instance, package, told) = initialising(scene, None);
        let table = package.table();
        let unknowns = rows(table, |row| row.causality == Causality::Output);
        let mut asked = 0;
        for unknown in &unknowns {
            let by = |known: &&Variable| is_real(known) && unknown.depends_on(known).is_some();
            let settable = rows(table, |row| !row.is_result() && row.variability != Variability::Constant);
            // Friction depends on the way, and says so.
            let knowns = settable.into_iter().filter(by).filter(|known| known.name != "vessel.friction");
            let knowns: Vec<u32> = knowns.map(|known| reference(table, &known.name)).collect();
            let of = [reference(table, &unknown.name)];
            let seed = vec![1.0; knowns.len()];
            let found = instance.directional_derivative(&of, &knowns, &seed);
            assert!(found.is_ok(), "{}: {}", unknown.name, last(&told));
            asked += knowns.len();
        }
        assert!(asked > 30 * unknowns.len(), "{asked}");
    }
}

/// Relative to the largest derivative of an output of its kind, where that counts.
fn assert_column(
    scene: &str,
    name: &str,
    unknowns: &[&Variable],
    exact: &[f64],
    differences: &[f64],
    slack: f64,
) {
    for (row, unknown) in unknowns.iter().enumerate() {
        let kind = unknown.name.trim_end_matches(|c: char| c.is_ascii_digit() || "[],".contains(c));
        let alike = |other: &&Variable| other.name.starts_with(kind);
        let largest = unknowns.iter().zip(differences).filter(|(other, _)| alike(other));
        let largest = largest.map(|(_, value)| value.abs()).fold(0.0, f64::max);
        let error = (exact[row] - differences[row]).abs();
        let here = &scene[..30];
        assert!(
            error <= slack * largest + 1e-9,
            "{here}: {} by {name}: {}, by differences {}",
            unknown.name,
            exact[row],
            differences[row]
        );
    }
}

#[test]
fn derivatives_by_parameters_are_those_of_solves_beside_and_zero_by_tolerances() {
    let parameters = [
        ("design.helix.density", 1900.0),
        ("design.ring.density", 7600.0),
        ("gravity[2]", -9.0),
        ("design.helix.volume_fraction", 0.25),
        ("magnet.design.cylinder[2].offset", 0.02),
    ];
    let (mut instance, package, told) = initialising(HEAVY, None);
    let table = package.table();
    let unknowns = rows(table, |row| row.causality == Causality::Output);
    let references: Vec<u32> = unknowns.iter().map(|row| reference(table, &row.name)).collect();
    for (name, size) in parameters {
        let by = [reference(table, name)];
        let exact = instance.directional_derivative(&references, &by, &[size]);
        let exact = exact.unwrap_or_else(|_| panic!("{name}: {}", last(&told)));
        // A density of 0 stands for the one of the composition, about which the derivative is taken.
        let value = get(&mut instance, table, name);
        let value = if value == 0.0 { mcm::design::composite_density(0.25) } else { value };
        let ends = [-1e-3, 1e-3].map(|part| values(HEAVY, &references, Some((name, value + part * size))));
        let differences: Vec<f64> = ends[0].iter().zip(&ends[1]).map(|(a, b)| (b - a) / 2e-3).collect();
        assert_column(HEAVY, name, &unknowns, &exact, &differences, 1e-3);
        assert!(differences.iter().any(|value| value.abs() > 1e-9), "{name} has an effect");
    }
    let accuracies = [
        "model.tolerance_position",
        "model.tolerance_angle",
        "model.tolerance_relative",
        "model.time_budget",
    ];
    for name in accuracies {
        let found = instance.directional_derivative(&references, &[reference(table, name)], &[1.0]);
        assert_eq!(found, Ok(vec![0.0; references.len()]), "{name}: {}", last(&told));
    }
    let level = [reference(table, "model.interaction")];
    assert_eq!(instance.directional_derivative(&references, &level, &[1.0]), Err(Ending::Error));
    assert!(last(&told).contains("by model.interaction: it is not a Real"), "{}", last(&told));
}

#[test]
fn outputs_without_a_row_in_the_jacobian_have_the_derivatives_of_solves_beside() {
    for (scene, names, outputs) in [
        (
            PUSHED,
            &["field.uniform[2]", "tip.load_force[1]", "feed.insertion", "base.orientation[2]", "gravity[1]"]
                [..],
            &["contact.", "ring[", "feed.", "tip."][..],
        ),
        (
            SOURCES,
            &[
                "magnet.position[2]",
                "magnet[2].orientation[2]",
                "coil[1].current",
                "magnet.strength",
                "base.position[1]",
            ],
            &["magnet.mutual", "magnet[2].mutual", "coil[1].mutual"],
        ),
    ] {
        let (mut instance, table, told) = initialised(scene);
        let named = |row: &Variable| outputs.iter().any(|start| row.name.starts_with(start));
        let unknowns = rows(&table, |row| row.causality == Causality::Output && named(row));
        let by_neighbours = |row: &&Variable| {
            matches!(row.derivative_role, DerivativeRole::Neighbours | DerivativeRole::MutualWrench(_))
        };
        assert!(unknowns.iter().filter(|row| by_neighbours(row)).count() >= 9);
        let references: Vec<u32> = unknowns.iter().map(|row| reference(&table, &row.name)).collect();
        let package = Package::new(scene, "test scene", 5).unwrap();
        for name in names {
            let row = table.find(reference(&table, name)).unwrap();
            let (here, DataType::Real(quantity)) = (real(row, &package), row.data_type) else { panic!() };
            let size = quantity.nominal;
            let exact = instance.directional_derivative(&references, &[reference(&table, name)], &[size]);
            let exact = exact.unwrap_or_else(|_| panic!("{name}: {}", last(&told)));
            let step = 1e-3;
            let mut at = |part: f64| {
                assert_eq!(set(&mut instance, &table, name, here + part * size), Ending::Ok);
                instance.get(&references, "Real", Value::real).unwrap()
            };
            let (before, after) = (at(-step), at(step));
            at(0.0);
            let differences: Vec<f64> =
                before.iter().zip(&after).map(|(a, b)| (b - a) / (2.0 * step)).collect();
            assert_column(scene, name, &unknowns, &exact, &differences, 2e-3);
        }
    }
}
