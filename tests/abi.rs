//! The C interface, driven through the exported functions.
#![allow(unsafe_code, reason = "the functions under test take raw pointers")]

use std::ffi::{CStr, CString, c_void};
use std::ptr;

use mcm::fmi::Package;
use mcm::fmi::bindings::*;
use mcm::fmi::ffi::*;

use crate::hostile::host::logger::{callbacks, heard};
use crate::hostile::host::start::{self, initialise};
use crate::tolerance::EFFECT;

mod derivatives;

mod environment;

mod states;

mod strings;

const OK: fmi2Status = fmi2Status::fmi2OK;
const ERROR: fmi2Status = fmi2Status::fmi2Error;
const DISCARD: fmi2Status = fmi2Status::fmi2Discard;

/// An instance of the default design; `environment` names the test to its logger.
fn instantiate(environment: usize) -> fmi2Component {
    let guid = CString::new(Package::built_in().unwrap().guid()).unwrap();
    // SAFETY: null is allowed.
    unsafe { start::instantiate(&guid, ptr::null(), environment) }
}

fn reference(name: &str) -> fmi2ValueReference {
    Package::built_in().unwrap().table().reference(name).unwrap()
}

fn get(component: fmi2Component, name: &str) -> (fmi2Status, f64) {
    let (reference, mut value) = (reference(name), f64::NAN);
    // SAFETY: one reference, one value.
    let status = unsafe { fmi2GetReal(component, &raw const reference, 1, &raw mut value) };
    (status, value)
}

fn set(component: fmi2Component, name: &str, value: f64) -> fmi2Status {
    let reference = reference(name);
    // SAFETY: one reference, one value.
    unsafe { fmi2SetReal(component, &raw const reference, 1, &raw const value) }
}

#[test]
fn version_and_platform_are_the_headers_own() {
    // SAFETY: both functions return static texts.
    let (version, platform) =
        unsafe { (CStr::from_ptr(fmi2GetVersion()), CStr::from_ptr(fmi2GetTypesPlatform())) };
    assert_eq!((version, platform), (c"2.0", c"default"));
}

#[test]
fn a_run_from_instantiate_to_free() {
    let component = instantiate(101);
    initialise(component);
    let (status, still) = get(component, "tip.angle");
    assert_eq!(status, OK);
    assert_eq!(set(component, "magnet.position[2]", -0.115), OK);
    // SAFETY: no pointers but the handle.
    assert_eq!(unsafe { fmi2DoStep(component, 0.0, 0.1, 1) }, OK);
    let (_, closer) = get(component, "tip.angle");
    assert!((closer - still).abs() > EFFECT, "{still} {closer}");
    let (mut time, mut terminated) = (f64::NAN, 7);
    // SAFETY: each writes one value.
    unsafe {
        assert_eq!(fmi2GetRealStatus(component, fmi2StatusKind::fmi2LastSuccessfulTime, &raw mut time), OK);
        assert_eq!(fmi2GetBooleanStatus(component, fmi2StatusKind::fmi2Terminated, &raw mut terminated), OK);
        assert_eq!(fmi2GetRealStatus(component, fmi2StatusKind(99), &raw mut time), DISCARD);
        assert_eq!(fmi2Terminate(component), OK);
        assert_eq!(fmi2Terminate(component), ERROR, "mosaik does that");
        fmi2FreeInstance(component);
        fmi2FreeInstance(component);
    }
    assert_eq!((time, terminated), (0.1, 0));
    // SAFETY: an unknown handle is refused before anything is read.
    assert_eq!(unsafe { fmi2DoStep(component, 0.1, 0.1, 1) }, ERROR);
}

#[test]
fn model_exchange_from_instantiate_to_free() {
    let (guid, functions) = (CString::new(Package::built_in().unwrap().guid()).unwrap(), callbacks(107));
    let (name, kind) = (c"exchange".as_ptr(), fmi2Type::fmi2ModelExchange);
    let mut event = fmi2EventInfo {
        newDiscreteStatesNeeded: 7,
        terminateSimulation: 7,
        nominalsOfContinuousStatesChanged: 7,
        valuesOfContinuousStatesChanged: 7,
        nextEventTimeDefined: 7,
        nextEventTime: 7.0,
    };
    let (mut enter, mut end, mut none) = (7, 7, [7.0]);
    let empty: *mut fmi2Real = ptr::null_mut();
    // SAFETY: texts are zero-terminated, arrays are as long as said, or null.
    unsafe {
        let component = fmi2Instantiate(name, kind, guid.as_ptr(), ptr::null(), &raw const functions, 0, 0);
        initialise(component);
        assert_eq!(fmi2DoStep(component, 0.0, 0.1, 1), ERROR, "a function of co-simulation");
        assert_eq!(fmi2EnterEventMode(component), ERROR, "it is there");
        assert_eq!(fmi2NewDiscreteStates(component, ptr::null_mut()), ERROR);
        assert_eq!(fmi2NewDiscreteStates(component, &raw mut event), OK);
        assert_eq!(fmi2EnterContinuousTimeMode(component), OK);
        assert_eq!(fmi2SetTime(component, 0.1), OK);
        let (_, still) = get(component, "tip.angle");
        assert_eq!(set(component, "magnet.position[2]", -0.115), OK);
        assert_eq!(fmi2GetDerivatives(component, empty, 0), OK);
        assert_eq!(fmi2GetContinuousStates(component, empty, 0), OK);
        assert_eq!(fmi2SetContinuousStates(component, ptr::null(), 0), OK);
        assert_eq!(fmi2GetNominalsOfContinuousStates(component, empty, 0), OK);
        assert_eq!(fmi2GetEventIndicators(component, empty, 0), OK);
        assert_eq!(fmi2GetContinuousStates(component, none.as_mut_ptr(), 1), ERROR);
        assert!(heard(107).pop().unwrap().contains("there are no continuous states"));
        assert_eq!(fmi2CompletedIntegratorStep(component, 1, ptr::null_mut(), &raw mut end), ERROR);
        assert_eq!(fmi2CompletedIntegratorStep(component, 1, &raw mut enter, &raw mut end), OK);
        assert!((get(component, "tip.angle").1 - still).abs() > EFFECT);
        assert_eq!(fmi2EnterEventMode(component), OK);
        assert_eq!(fmi2Terminate(component), OK);
        fmi2FreeInstance(component);
        none[0] -= 7.0;
    }
    assert_eq!((enter, end, event.newDiscreteStatesNeeded, event.nextEventTimeDefined), (0, 0, 0, 0));
    assert_eq!((event.terminateSimulation, event.valuesOfContinuousStatesChanged), (0, 0));
    assert!(none[0].to_bits() == 0, "nothing is written where there is nothing");
}

#[test]
fn handles_that_are_none_are_errors() {
    for handle in [0, 1_000_000_007, usize::MAX] {
        let component: *mut c_void = ptr::without_provenance_mut(handle);
        // SAFETY: an unknown handle is refused before anything is read.
        unsafe {
            assert_eq!(fmi2Reset(component), ERROR);
            assert_eq!(fmi2GetReal(component, ptr::null(), 1, ptr::null_mut()), ERROR);
            fmi2FreeInstance(component);
        }
    }
}

#[test]
fn null_is_survived_and_length_zero_may_come_with_it() {
    let component = instantiate(102);
    initialise(component);
    let reference = reference("tip.angle");
    // SAFETY: null is what is tested; the reference is one.
    unsafe {
        assert_eq!(fmi2GetReal(component, ptr::null(), 0, ptr::null_mut()), OK);
        assert_eq!(fmi2SetReal(component, ptr::null(), 0, ptr::null()), OK);
        assert_eq!(fmi2GetString(component, ptr::null(), 0, ptr::null_mut()), OK);
        assert_eq!(fmi2SetString(component, ptr::null(), 0, ptr::null()), OK);
        assert_eq!(fmi2SetDebugLogging(component, 1, 0, ptr::null()), OK);
        assert_eq!(fmi2GetReal(component, ptr::null(), 3, ptr::null_mut()), ERROR);
        assert!(heard(102).pop().unwrap().ends_with("vr is null"));
        assert_eq!(fmi2GetReal(component, &raw const reference, 1, ptr::null_mut()), ERROR);
        assert_eq!(fmi2SetReal(component, &raw const reference, 1, ptr::null()), ERROR);
        assert_eq!(fmi2SetDebugLogging(component, 1, 2, ptr::null()), ERROR);
        assert_eq!(fmi2GetFMUstate(component, ptr::null_mut()), ERROR);
        assert_eq!(fmi2FreeFMUstate(component, ptr::null_mut()), OK);
        assert_eq!(
            fmi2GetRealStatus(component, fmi2StatusKind::fmi2LastSuccessfulTime, ptr::null_mut()),
            ERROR
        );
        fmi2FreeInstance(component);
    }
}

#[test]
fn refusals_are_told_with_category_and_format() {
    let component = instantiate(103);
    // SAFETY: no pointers but the handle.
    assert_eq!(unsafe { fmi2DoStep(component, 0.0, 0.1, 1) }, ERROR);
    let said = heard(103).pop().unwrap();
    assert_eq!(said, "one logStatusError: fmi2DoStep is not allowed before initialisation");
    initialise(component);
    assert_eq!(set(component, "magnet.strength", f64::NAN), ERROR);
    assert!(heard(103).pop().unwrap().contains("magnet.strength = NaN"));
    // SAFETY: no pointers but the handle.
    assert_eq!(unsafe { fmi2CancelStep(component) }, ERROR);
    assert!(heard(103).pop().unwrap().contains("no step is under way"));
    assert_eq!(get(component, "magnet.strength"), (OK, 1.0), "still usable");
    fmi2FreeInstance(component);
}

#[test]
fn instantiation_is_refused_with_a_reason() {
    let guid = CString::new(Package::built_in().unwrap().guid()).unwrap();
    let functions = callbacks(104);
    let attempt = |name: fmi2String, kind, guid: fmi2String, location: fmi2String, functions| {
        // SAFETY: texts are null or zero-terminated, `functions` is null or the callbacks above.
        unsafe { fmi2Instantiate(name, kind, guid, location, functions, 0, 1) }
    };
    let (own, one, kind) = (guid.as_ptr(), c"one".as_ptr(), fmi2Type::fmi2CoSimulation);
    let refused: [(_, _, _, _, &str); 6] = [
        (ptr::null(), kind, own, ptr::null(), "instance name"),
        (c"".as_ptr(), kind, own, ptr::null(), "instance name"),
        (one, fmi2Type(7), own, ptr::null(), "no FMU type 7"),
        (one, kind, ptr::null(), ptr::null(), "GUID is null"),
        (one, kind, c"{wrong}".as_ptr(), ptr::null(), "{wrong}"),
        (one, kind, own, c"http://example.org/".as_ptr(), "file:"),
    ];
    for (name, kind, guid, location, reason) in refused {
        assert!(attempt(name, kind, guid, location, &raw const functions).is_null(), "{reason}");
        let said = heard(104).pop().unwrap();
        assert!(said.contains(reason), "{said}");
    }
    // A relative path behind two slashes names a host.
    let own_scene = CString::new(Package::new("", "scene", 5).unwrap().guid()).unwrap();
    let relative = c"file://unpacked/resources".as_ptr();
    assert!(attempt(one, kind, own_scene.as_ptr(), relative, &raw const functions).is_null());
    let said = heard(104).pop().unwrap();
    assert!(said.contains("/resources is no folder"), "{said}");
    assert!(said.contains("in file://unpacked/resources, unpacked is the name of a host"), "{said}");
    for location in [c"", c"file:///nowhere/at%20all/", c"file:////nowhere/at all"] {
        let silent = attempt(one, kind, own, location.as_ptr(), ptr::null());
        assert!(!silent.is_null(), "no callbacks, no resources: {location:?}");
        fmi2FreeInstance(silent);
    }
}

#[test]
fn saved_states_belong_to_their_instance() {
    let (first, second) = (instantiate(105), instantiate(105));
    initialise(first);
    initialise(second);
    let (mut state, unmoved) = (ptr::null_mut(), get(first, "tip.angle").1);
    // SAFETY: `state` is one handle that the FMU wrote, or null.
    unsafe {
        assert_eq!(fmi2GetFMUstate(first, &raw mut state), OK);
        assert_eq!(set(first, "magnet.strength", 0.5), OK);
        assert_eq!(fmi2DoStep(first, 0.0, 1.0, 0), OK);
        assert_ne!(get(first, "tip.angle").1.to_bits(), unmoved.to_bits());
        assert_eq!(fmi2SetFMUstate(second, state), ERROR, "of another instance");
        assert_eq!(fmi2SetFMUstate(first, state), OK);
        assert_eq!(get(first, "tip.angle").1.to_bits(), unmoved.to_bits());
        let kept = state;
        assert_eq!(fmi2GetFMUstate(first, &raw mut state), OK, "overwritten");
        assert_eq!(state, kept);
        assert_eq!(fmi2FreeFMUstate(first, &raw mut state), OK);
        assert!(state.is_null());
        assert_eq!(fmi2FreeFMUstate(first, &raw mut state), OK, "null is nothing to free");
        assert_eq!(fmi2SetFMUstate(first, kept), ERROR);
        let mut size = 0;
        assert_eq!(fmi2SerializedFMUstateSize(first, kept, &raw mut size), ERROR, "forgotten");
    }
    fmi2FreeInstance(first);
    fmi2FreeInstance(second);
}

#[test]
fn sixteen_threads_step_instances_of_their_own() {
    let run = |row: u32| {
        let component = instantiate(106);
        initialise(component);
        assert_eq!(set(component, "magnet.strength", 0.5 + 0.1 * f64::from(row % 4)), OK);
        let mut angles = Vec::new();
        for step in 0..5 {
            let time = 0.1 * f64::from(step);
            assert_eq!(set(component, "magnet.position[3]", 0.02 + 0.1 * time), OK);
            // SAFETY: no pointers but the handle.
            assert_eq!(unsafe { fmi2DoStep(component, time, 0.1, 1) }, OK);
            angles.push(get(component, "tip.angle").1.to_bits());
        }
        fmi2FreeInstance(component);
        angles
    };
    let alone: Vec<_> = (0..4).map(run).collect();
    let threads: Vec<_> = (0..16).map(|row| std::thread::spawn(move || run(row))).collect();
    for (thread, angles) in threads.into_iter().map(|thread| thread.join().unwrap()).enumerate() {
        assert_eq!(angles, alone[thread % 4], "thread {thread}");
    }
    assert_ne!(alone[0], alone[1]);
}
