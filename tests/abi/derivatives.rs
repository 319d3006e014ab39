//! Derivatives through the C interface, against differences.

use mcm::fmi::variable::{Causality, Variable};

use nalgebra::DVector;

use super::*;
use crate::differences::{Compared, derivative, worst};
use crate::tolerance::{ABI_CURVATURE, ABI_DIFFERENCE};

fn references(holds: impl Fn(&Variable) -> bool) -> Vec<(fmi2ValueReference, Variable)> {
    let package = Package::built_in().unwrap();
    (0..).zip(package.table().variables().to_vec()).filter(|(_, variable)| holds(variable)).collect()
}

fn values(component: fmi2Component, unknowns: &[fmi2ValueReference]) -> Vec<f64> {
    let mut values = vec![f64::NAN; unknowns.len()];
    // SAFETY: as many values as references.
    assert_eq!(unsafe { fmi2GetReal(component, unknowns.as_ptr(), unknowns.len(), values.as_mut_ptr()) }, OK);
    values
}

fn along(component: fmi2Component, unknowns: &[fmi2ValueReference], known: fmi2ValueReference) -> Vec<f64> {
    let (mut values, seed, count) = (vec![f64::NAN; unknowns.len()], 1.0, unknowns.len());
    // SAFETY: as many values as references, one seed.
    let status = unsafe {
        fmi2GetDirectionalDerivative(
            component,
            unknowns.as_ptr(),
            count,
            &raw const known,
            1,
            &raw const seed,
            values.as_mut_ptr(),
        )
    };
    assert_eq!(status, OK);
    values
}

/// Step of the differences of fourth order in parts of each input's usual size.
const STEP: f64 = 1e-3;

/// Usual sizes of the inputs, by what their names begin with.
const SIZES: [(&str, f64); 9] = [
    ("magnet.position", 0.05),
    ("magnet.strength", 1.0),
    ("field.uniform", 0.01),
    ("field.gradient", 0.3),
    ("tip.load_force", 0.005),
    ("tip.load_moment", 1e-5),
    ("ring", 0.005),
    ("base.position", 0.05),
    ("", 0.1), // orientations, of unit norm within 1e-3
];

#[test]
fn every_output_by_every_input_is_what_differences_say() {
    let component = instantiate(301);
    initialise(component);
    let (unknowns, outputs): (Vec<_>, Vec<_>) =
        references(|variable| variable.derivative_role.is_unknown()).into_iter().unzip();
    let knowns = references(|variable| variable.causality == Causality::Input);
    assert!(unknowns.len() > 150 && knowns.len() == 59, "{} {}", unknowns.len(), knowns.len());
    // Bent out of the plane, so that no derivative vanishes for symmetry.
    for (name, value) in [("field.uniform[1]", 0.002), ("tip.load_force[3]", 0.002), ("gravity[2]", 3.0)] {
        assert_eq!(set(component, name, value), OK);
    }
    let mut state = ptr::null_mut();
    // SAFETY: a handle that the FMU writes.
    assert_eq!(unsafe { fmi2GetFMUstate(component, &raw mut state) }, OK);
    let at = |name: &str, value: f64| {
        // SAFETY: as above.
        assert_eq!(unsafe { fmi2SetFMUstate(component, state) }, OK);
        assert_eq!(set(component, name, value), OK);
        DVector::from_vec(values(component, &unknowns))
    };
    let mut compared = Vec::new();
    for (known, variable) in &knowns {
        let name = variable.name.as_str();
        let size = SIZES.iter().find(|(start, _)| name.starts_with(start)).unwrap().1;
        // SAFETY: as above.
        assert_eq!(unsafe { fmi2SetFMUstate(component, state) }, OK);
        let value = get(component, name).1;
        let exact = along(component, &unknowns, *known);
        let expected = derivative(STEP * size, |by| at(name, value + by));
        for ((output, got), expected) in outputs.iter().zip(exact).zip(&expected) {
            let kind = (output.derivative_role, output.name.starts_with("shape.curvature"));
            let name = format!("{} by {name}: {got:e} and {expected:e}", output.name);
            let (error, effect) = ((got - expected).abs() * size, expected.abs() * size);
            compared.push(Compared { kind, name, error, effect });
        }
    }
    // Relative to the largest effect of any input, of its usual size, on this kind of output.
    let allowed = |(_, is_curvature)| if is_curvature { ABI_CURVATURE } else { ABI_DIFFERENCE };
    let (error, place) = worst(&compared, allowed);
    println!("worst difference: {error:.1e} of what is allowed ({place})");
    assert!(error <= 1.0, "{place}: off by {error:e} times what is allowed");
    fmi2FreeInstance(component);
}

#[test]
fn a_step_with_input_derivatives_has_output_derivatives() {
    let component = instantiate(302);
    let (input, output, order, rate) = (reference("magnet.position[2]"), reference("tip.angle"), 1, 0.05);
    let mut slope = f64::NAN;
    // SAFETY: one reference, one order, one value each.
    unsafe {
        let (input, order) = (&raw const input, &raw const order);
        assert_eq!(
            fmi2SetRealInputDerivatives(component, input, 1, order, &raw const rate),
            OK,
            "before the start"
        );
        initialise(component);
        assert_eq!(fmi2GetRealOutputDerivatives(component, input, 1, order, &raw mut slope), ERROR);
        assert_eq!(fmi2DoStep(component, 0.0, 0.1, 1), OK);
        assert_eq!(get(component, "magnet.position[2]"), (OK, -0.12 + 0.05 * 0.1));
        assert_eq!(fmi2GetRealOutputDerivatives(component, &raw const output, 1, order, &raw mut slope), OK);
        let by_position = along(component, &[output], *input)[0];
        assert!((slope - rate * by_position).abs() <= 1e-12 * slope.abs() && slope.abs() > EFFECT);
        assert_eq!(fmi2SetRealInputDerivatives(component, ptr::null(), 1, order, &raw const rate), ERROR);
        assert_eq!(fmi2SetRealInputDerivatives(component, input, 1, ptr::null(), &raw const rate), ERROR);
        assert_eq!(fmi2SetRealInputDerivatives(component, input, 1, order, ptr::null()), ERROR);
        assert_eq!(fmi2GetRealOutputDerivatives(component, ptr::null(), 1, order, &raw mut slope), ERROR);
        assert_eq!(
            fmi2GetRealOutputDerivatives(component, &raw const output, 1, order, ptr::null_mut()),
            ERROR
        );
        let (none, seed) = (ptr::null(), &raw const rate);
        let target = &raw mut slope;
        assert_eq!(fmi2GetDirectionalDerivative(component, none, 1, input, 1, seed, target), ERROR);
        assert_eq!(
            fmi2GetDirectionalDerivative(component, &raw const output, 1, none, 1, seed, target),
            ERROR
        );
        assert_eq!(
            fmi2GetDirectionalDerivative(component, &raw const output, 1, input, 1, ptr::null(), target),
            ERROR
        );
        assert_eq!(
            fmi2GetDirectionalDerivative(component, none, 0, none, 0, ptr::null(), ptr::null_mut()),
            OK
        );
    }
    fmi2FreeInstance(component);
}
