//! The table: names, units, get and set.

use std::collections::BTreeSet;

use mcm::fmi::Package;
use mcm::fmi::derivative_role::DerivativeRole;
use mcm::fmi::units::{QUANTITIES, UNITS};
use mcm::fmi::value::{DataType, Value};
use mcm::fmi::variable::{Access, Availability, Causality, Variability, Variable};

const SCENES: [&str; 5] = [
    "",
    "[design]\nsegments = 2\nbase_magnet = false\n[design.backbone]\nouter_radius_mm = 0.74\ninner_radius_mm = 0.7\n\
     elastic_modulus_mpa = 500.0\npoisson = 0.46",
    "[design]\nkind = \"cylinder\"\nlength_mm = 10.0\nradius_mm = 1.0\nshore_a = 33.0",
    "[design]\nkind = \"cylinder\"\nlength_mm = 10.0\nradius_mm = 1.0\nelastic_modulus_mpa = 1.0\nremanence_t = 0.2",
    "[design]\nsegments = 1\n[feed]\nmode = \"insertion\"\n[feed.shaft]\nouter_radius_mm = 0.75\ninner_radius_mm = 0.25\n\
     elastic_modulus_mpa = 1.0\npoisson = 0.45\n[vessel]\n[[vessel.branch]]\nname = \"tube\"\n\
     points_mm = [[0, 0, -20], [0, 0, 40], [0, 0, 100]]\nradius_mm = 3.5",
];

fn packages() -> impl Iterator<Item = Package> {
    SCENES.iter().map(|scene| Package::new(scene, "test scene", 4).unwrap())
}

#[test]
fn names_are_unique_and_found_by_reference() {
    for package in packages() {
        let table = package.table();
        let names: BTreeSet<_> = table.variables().iter().map(|variable| &variable.name).collect();
        assert_eq!(names.len(), table.variables().len());
        for name in names {
            let reference = table.reference(name).unwrap();
            assert_eq!(&table.find(reference).unwrap().name, name);
        }
        assert!(table.find(u32::try_from(table.variables().len()).unwrap()).is_none());
        assert!(table.find(u32::MAX).is_none());
    }
}

#[test]
fn the_names_that_users_rely_on_are_there() {
    let package = Package::built_in().unwrap();
    let names = [
        "magnet.position[3]",
        "magnet.orientation[4]",
        "magnet.strength",
        "field.uniform[1]",
        "field.gradient[5]",
        "base.position[1]",
        "base.orientation[1]",
        "tip.load_force[3]",
        "tip.load_moment[3]",
        "ring[10].load_force[3]",
        "gravity[3]",
        "model.interaction",
        "model.tolerance_position",
        "model.tolerance_angle",
        "model.tolerance_relative",
        "design.ring.recoil_permeability",
        "design.spiral_start[9]",
        "magnet.design.cylinder[2].remanence",
        "tip.angle",
        "tip.position[3]",
        "tip.orientation[4]",
        "force.magnetic[3]",
        "torque.magnetic[3]",
        "base.reaction_force[3]",
        "base.reaction_moment[3]",
        "magnet.reaction_force[3]",
        "magnet.reaction_torque[3]",
        "field.tip[3]",
        "shape.position[21,3]",
        "shape.arc_length[21]",
        "shape.tangent[21,3]",
        "shape.curvature[21,3]",
        "ring[10].position[3]",
        "ring[10].axis[3]",
        "core[9].angle",
        "stability.stable",
        "stability.margin",
        "stability.snaps",
        "stability.neutral",
        "solver.outcome",
        "solver.progress",
        "model.time_budget",
        "solver.status",
        "solver.iterations",
        "solver.residual",
        "model.level",
    ];
    for name in names {
        assert!(package.table().reference(name).is_some(), "{name}");
    }
    let start = |name: &str| {
        let variable = package.table().find(package.table().reference(name).unwrap()).unwrap();
        variable.host_value(package.start()).unwrap()
    };
    let magnet = [1, 2, 3, 4].map(|k| start(&format!("magnet.orientation[{k}]")));
    assert_eq!(magnet, [0.0, 1.0, 0.0, 0.0].map(Value::Real));
    assert_eq!(start("design.ring.recoil_permeability"), Value::Real(1.0));
    assert_eq!(start("magnet.position[2]"), Value::Real(-0.12));
    assert_eq!(start("magnet.design.cylinder[1].radius"), Value::Real(0.0225));
}

#[test]
fn what_is_set_is_read_back_and_touches_nothing_else() {
    for package in packages() {
        let table = package.table();
        let settable = || {
            (table.variables().iter())
                .filter(|v| matches!(v.causality, Causality::Input | Causality::Parameter))
        };
        for (row, variable) in settable().enumerate() {
            let mut values = package.start().clone();
            let value = match variable.access {
                Access::Real { .. } => Value::Real(0.125 + row as f64),
                Access::Boolean { get, .. } => Value::Boolean(!get(&values)),
                Access::Enumeration { .. } => Value::Integer(1),
                _ => panic!("{} has no place", variable.name),
            };
            assert_eq!(variable.set(&mut values, value), Ok(()), "{}", variable.name);
            assert_eq!(variable.host_value(&values), Some(value), "{}", variable.name);
            // Which level it is decides about the stop that is not set.
            let follows =
                |other: &str| [&variable.name, other] == ["model.interaction", "model.bending_stop"];
            for other in settable().filter(|other| other.name != variable.name && !follows(&other.name)) {
                assert_eq!(
                    other.host_value(&values),
                    other.host_value(package.start()),
                    "{} by {}",
                    other.name,
                    variable.name
                );
            }
        }
    }
}

#[test]
fn tags_of_a_variable_fit_together() {
    let count = |holds: &dyn Fn(&Variable) -> bool| {
        packages().map(|package| package.table().variables().iter().filter(|row| holds(row)).count()).sum()
    };
    for package in packages() {
        for row in package.table().variables() {
            let (name, role) = (&row.name, row.derivative_role);
            let fits = match (row.causality, row.variability) {
                (Causality::Input, Variability::Continuous) => role.is_known(),
                (Causality::Output, Variability::Continuous) => role.is_unknown(),
                (Causality::Local, Variability::Discrete) | (Causality::Parameter, Variability::Fixed) => {
                    role == DerivativeRole::None
                }
                (Causality::Parameter, Variability::Tunable) => !role.is_unknown(),
                (Causality::Local, Variability::Constant) => matches!(row.access, Access::Constant(_)),
                _ => false,
            };
            assert!(fits, "{name}: {:?} {:?} {role:?}", row.causality, row.variability);
            let continuous = row.variability == Variability::Continuous;
            assert!(!continuous || matches!(row.data_type, DataType::Real(_)), "{name}");
            let by_host = row.host_value(package.start()).is_some();
            assert_eq!(by_host, !row.is_result(), "{name}");
        }
    }
    // Six outputs describe the search for an equilibrium; the margin, and tangent and curvature at four points, are computed when read.
    let always: usize = count(&|row| row.availability == Availability::Always);
    let on_request: usize = count(&|row| matches!(row.availability, Availability::OnRequest(_)));
    assert_eq!((always, on_request), (6 * SCENES.len(), (1 + 4 * 6) * SCENES.len()));
}

#[test]
fn start_values_lie_within_their_bounds() {
    for package in packages() {
        for variable in package.table().variables() {
            let Some(Value::Real(start)) = variable.host_value(package.start()) else { continue };
            let within =
                variable.min.is_none_or(|min| start >= min) && variable.max.is_none_or(|max| start <= max);
            assert!(start.is_finite() && within, "{} = {start}", variable.name);
        }
    }
}

#[test]
fn values_that_are_none_are_refused() {
    let package = Package::built_in().unwrap();
    let mut values = package.start().clone();
    for variable in package.table().variables() {
        for value in [f64::NAN, f64::INFINITY, f64::NEG_INFINITY] {
            assert!(variable.set(&mut values, Value::Real(value)).is_err(), "{}", variable.name);
        }
        if let Access::Enumeration { .. } = variable.access {
            assert!(variable.set(&mut values, Value::Integer(99)).is_err(), "{}", variable.name);
        }
    }
    assert_eq!(&values, package.start());
}

#[test]
fn every_real_has_a_known_quantity_and_unit() {
    for variable in Package::built_in().unwrap().table().variables() {
        if let DataType::Real(quantity) = variable.data_type {
            assert!(QUANTITIES.contains(&quantity), "{}", variable.name);
            assert!(UNITS.iter().any(|unit| unit.name == quantity.unit), "{}", variable.name);
        }
    }
}

#[test]
fn shape_points_have_bounds() {
    for points in [0, 1, 1001] {
        assert!(Package::new("", "test scene", points).is_err(), "{points}");
    }
}
