//! The C functions of FMI 2.0, with the only unsafe code of the project.
//!
//! Each is defined by the macro `export!`, which turns pointers into slices, and calls one method of an [`Instance`]. The
//! arguments have the names that they have in the official header.

#![allow(unsafe_code, reason = "C calls in with raw pointers and takes a logger's C function")]
#![allow(non_snake_case, reason = "names of the standard")]

mod export;

mod floating_point;

#[cfg(all(target_os = "linux", target_env = "gnu", any(target_arch = "x86_64", target_arch = "aarch64")))]
mod hypot;

mod instantiate;

mod logger;

mod memory;

mod saved_state;

use std::ffi::{c_char, c_int};
use std::ptr;

#[allow(clippy::wildcard_imports, reason = "types of the standard, named by its prefix")]
use super::bindings::*;
use super::guard::guarded;
use super::instance::Instance;
use super::registry;
use super::state::{Call, Ending};
use super::value::Value;
use export::export;
use floating_point::in_default_environment;
use instantiate::{Arguments, instantiate};
use logger::status;

type References = *const fmi2ValueReference;

export! { safe
    fmi2GetTypesPlatform: fmi2GetTypesPlatformTYPE = () -> *const c_char {
        fmi2TypesPlatform.as_ptr().cast()
    } else ptr::null();

    fmi2GetVersion: fmi2GetVersionTYPE = () -> *const c_char {
        fmi2Version.as_ptr().cast()
    } else ptr::null();

    // A handle that is null, unknown or already freed does nothing.
    fmi2FreeInstance: fmi2FreeInstanceTYPE = (c: fmi2Component) -> () { registry::leave(c.addr()) } else ();
}

export! { instantiate
    fmi2Instantiate: fmi2InstantiateTYPE =
        (instanceName: fmi2String, fmuType: fmi2Type, fmuGUID: fmi2String, fmuResourceLocation: fmi2String,
         functions: *const fmi2CallbackFunctions, _visible: fmi2Boolean, loggingOn: fmi2Boolean) -> fmi2Component
        where instance_name = text(instanceName), guid = text(fmuGUID),
              resource_location = text(fmuResourceLocation), callbacks = copied(functions);
        {
            let (fmu_type, logging_on) = (fmuType, loggingOn != 0);
            let arguments =
                Arguments { instance_name, fmu_type, guid, resource_location, callbacks, logging_on };
            instantiate(arguments).map_or(ptr::null_mut(), ptr::without_provenance_mut)
        },
        else ptr::null_mut();
}

export! { instance
    fmi2SetDebugLogging: fmi2SetDebugLoggingTYPE, SetDebugLogging =
        (loggingOn: fmi2Boolean, nCategories: usize, categories: *const fmi2String)
        where names = texts(categories, nCategories);
        |instance| instance.set_debug_logging(loggingOn != 0, &names);

    fmi2SetupExperiment: fmi2SetupExperimentTYPE, SetupExperiment =
        (_toleranceDefined: fmi2Boolean, _tolerance: fmi2Real, startTime: fmi2Real, stopTimeDefined: fmi2Boolean,
         stopTime: fmi2Real)
        |instance| instance.setup_experiment(startTime, (stopTimeDefined != 0).then_some(stopTime));

    fmi2EnterInitializationMode: fmi2EnterInitializationModeTYPE, EnterInitializationMode = ()
        |instance| instance.enter_initialization();

    fmi2ExitInitializationMode: fmi2ExitInitializationModeTYPE, ExitInitializationMode = ()
        |instance| instance.exit_initialization();

    fmi2Terminate: fmi2TerminateTYPE, Terminate = () |instance| instance.terminate();

    fmi2Reset: fmi2ResetTYPE, Reset = () |instance| instance.reset();
}

export! { instance
    fmi2GetReal: fmi2GetRealTYPE, Get = (vr: References, nvr: usize, value: *mut fmi2Real)
        where references = input(vr, nvr), values = output(value, nvr);
        |instance| values.write(instance.get(references, "Real", Value::real));

    fmi2GetInteger: fmi2GetIntegerTYPE, Get = (vr: References, nvr: usize, value: *mut fmi2Integer)
        where references = input(vr, nvr), values = output(value, nvr);
        |instance| values.write(instance.get(references, "Integer", Value::integer));

    fmi2GetBoolean: fmi2GetBooleanTYPE, Get = (vr: References, nvr: usize, value: *mut fmi2Boolean)
        where references = input(vr, nvr), values = output(value, nvr);
        |instance| values.write(instance.get(references, "Boolean", |value| value.boolean().map(c_int::from)));

    fmi2GetString: fmi2GetStringTYPE, Get = (vr: References, nvr: usize, value: *mut fmi2String)
        where references = input(vr, nvr), values = output(value, nvr);
        |instance| values.write(instance.get(references, "String", |_| None));

    fmi2SetReal: fmi2SetRealTYPE, Set = (vr: References, nvr: usize, value: *const fmi2Real)
        where references = input(vr, nvr), values = input(value, nvr);
        |instance| instance.set(references, values.iter().map(|&value| Value::Real(value)));

    fmi2SetInteger: fmi2SetIntegerTYPE, Set = (vr: References, nvr: usize, value: *const fmi2Integer)
        where references = input(vr, nvr), values = input(value, nvr);
        |instance| instance.set(references, values.iter().map(|&value| Value::Integer(value)));

    fmi2SetBoolean: fmi2SetBooleanTYPE, Set = (vr: References, nvr: usize, value: *const fmi2Boolean)
        where references = input(vr, nvr), values = input(value, nvr);
        |instance| instance.set(references, values.iter().map(|&value| Value::Boolean(value != 0)));

    fmi2SetString: fmi2SetStringTYPE, Set = (vr: References, nvr: usize, value: *const fmi2String)
        where references = input(vr, nvr), _values = texts(value, nvr);
        |instance| instance.set_strings(references);
}

export! { instance
    fmi2GetFMUstate: fmi2GetFMUstateTYPE, GetFmuState = (FMUstate: *mut fmi2FMUstate)
        where known = input(FMUstate, 1), handle = output(FMUstate, 1);
        |instance| saved_state::save(instance, known.first().copied(), handle, Instance::save);

    fmi2SetFMUstate: fmi2SetFMUstateTYPE, SetFmuState = (FMUstate: fmi2FMUstate)
        |instance| instance.restore(FMUstate.addr());

    // To free null, or what a null pointer points to, does nothing.
    fmi2FreeFMUstate: fmi2FreeFMUstateTYPE, FreeFmuState = (FMUstate: *mut fmi2FMUstate)
        where known = input(FMUstate, usize::from(!FMUstate.is_null())),
              handle = output(FMUstate, usize::from(!FMUstate.is_null()));
        |instance| match known {
            [known] if !known.is_null() => handle.write_one(ptr::null_mut(), instance.forget(known.addr())),
            _ => Ending::Ok,
        };

    fmi2SerializedFMUstateSize: fmi2SerializedFMUstateSizeTYPE, SerializeFmuState =
        (FMUstate: fmi2FMUstate, size: *mut usize)
        where length = output(size, 1);
        |instance| length.write(instance.serialised(FMUstate.addr()).map(|bytes| vec![bytes.len()]));

    fmi2SerializeFMUstate: fmi2SerializeFMUstateTYPE, SerializeFmuState =
        (FMUstate: fmi2FMUstate, serializedState: *mut fmi2Byte, size: usize)
        where room = output(serializedState as u8, size);
        |instance| match instance.serialised(FMUstate.addr()) {
            Ok(bytes) if bytes.len() > size => {
                instance.refuse(&format!("the state has {} bytes, and there is room for {size}", bytes.len()))
            }
            bytes => room.write(bytes),
        };

    fmi2DeSerializeFMUstate: fmi2DeSerializeFMUstateTYPE, SerializeFmuState =
        (serializedState: *const fmi2Byte, size: usize, FMUstate: *mut fmi2FMUstate)
        where bytes = input(serializedState as u8, size), known = input(FMUstate, 1),
              handle = output(FMUstate, 1);
        |instance| saved_state::save(instance, known.first().copied(), handle, |instance, number| {
            instance.deserialise(number, bytes)
        });
}

export! { instance
    fmi2GetDirectionalDerivative: fmi2GetDirectionalDerivativeTYPE, GetDirectionalDerivative =
        (vUnknown_ref: References, nUnknown: usize, vKnown_ref: References, nKnown: usize, dvKnown: *const fmi2Real,
         dvUnknown: *mut fmi2Real)
        where unknowns = input(vUnknown_ref, nUnknown), knowns = input(vKnown_ref, nKnown),
              seed = input(dvKnown, nKnown), derivatives = output(dvUnknown, nUnknown);
        |instance| derivatives.write(instance.directional_derivative(unknowns, knowns, seed));

    fmi2SetRealInputDerivatives: fmi2SetRealInputDerivativesTYPE, SetRealInputDerivatives =
        (vr: References, nvr: usize, order: *const fmi2Integer, value: *const fmi2Real)
        where references = input(vr, nvr), orders = input(order, nvr), values = input(value, nvr);
        |instance| instance.set_input_derivatives(references, orders, values);

    fmi2GetRealOutputDerivatives: fmi2GetRealOutputDerivativesTYPE, GetRealOutputDerivatives =
        (vr: References, nvr: usize, order: *const fmi2Integer, value: *mut fmi2Real)
        where references = input(vr, nvr), orders = input(order, nvr), derivatives = output(value, nvr);
        |instance| derivatives.write(instance.output_derivatives(references, orders));

    fmi2DoStep: fmi2DoStepTYPE, DoStep =
        (currentCommunicationPoint: fmi2Real, communicationStepSize: fmi2Real,
         _noSetFMUStatePriorToCurrentPoint: fmi2Boolean)
        |instance| instance.do_step(currentCommunicationPoint, communicationStepSize);
}

/// What follows from an event: nothing.
pub const NO_EVENT: fmi2EventInfo = fmi2EventInfo {
    newDiscreteStatesNeeded: 0,
    terminateSimulation: 0,
    nominalsOfContinuousStatesChanged: 0,
    valuesOfContinuousStatesChanged: 0,
    nextEventTimeDefined: 0,
    nextEventTime: 0.0,
};

// Without continuous states and event indicators every array of model exchange has the length 0.
export! { instance
    fmi2EnterEventMode: fmi2EnterEventModeTYPE, EnterEventMode = () |instance| instance.enter_event_mode();

    fmi2NewDiscreteStates: fmi2NewDiscreteStatesTYPE, NewDiscreteStates = (fmi2eventInfo: *mut fmi2EventInfo)
        where information = output(fmi2eventInfo, 1);
        |instance| information.write_one(NO_EVENT, instance.new_discrete_states());

    fmi2EnterContinuousTimeMode: fmi2EnterContinuousTimeModeTYPE, EnterContinuousTimeMode = ()
        |instance| instance.enter_continuous_time_mode();

    fmi2CompletedIntegratorStep: fmi2CompletedIntegratorStepTYPE, CompletedIntegratorStep =
        (_noSetFMUStatePriorToCurrentPoint: fmi2Boolean, enterEventMode: *mut fmi2Boolean,
         terminateSimulation: *mut fmi2Boolean)
        where event = output(enterEventMode, 1), end = output(terminateSimulation, 1);
        |instance| {
            let snapped = instance.completed_integrator_step();
            match end.write(snapped.map(|_| vec![0])) {
                Ending::Ok => event.write(snapped.map(|snapped| vec![c_int::from(snapped)])),
                failed => failed,
            }
        };

    fmi2SetTime: fmi2SetTimeTYPE, SetTime = (time: fmi2Real) |instance| instance.set_time(time);

    fmi2SetContinuousStates: fmi2SetContinuousStatesTYPE, SetContinuousStates = (_x: *const fmi2Real, nx: usize)
        |instance| instance.expect_none("continuous states", nx);

    fmi2GetContinuousStates: fmi2GetContinuousStatesTYPE, GetContinuousStates = (_x: *mut fmi2Real, nx: usize)
        |instance| instance.expect_none("continuous states", nx);

    fmi2GetDerivatives: fmi2GetDerivativesTYPE, GetContinuousStates = (_derivatives: *mut fmi2Real, nx: usize)
        |instance| instance.expect_none("continuous states", nx);

    fmi2GetNominalsOfContinuousStates: fmi2GetNominalsOfContinuousStatesTYPE, GetContinuousStates =
        (_x_nominal: *mut fmi2Real, nx: usize)
        |instance| instance.expect_none("continuous states", nx);

    fmi2GetEventIndicators: fmi2GetEventIndicatorsTYPE, GetContinuousStates =
        (_eventIndicators: *mut fmi2Real, ni: usize)
        |instance| instance.expect_none("event indicators", ni);
}

// Every step is finished when `fmi2DoStep` returns: there is none to cancel, and no status of a pending one.
export! { instance
    fmi2CancelStep: fmi2CancelStepTYPE, CancelStep = () |_instance| Ending::Error;

    fmi2GetStatus: fmi2GetStatusTYPE, GetStatus = (_s: fmi2StatusKind, _value: *mut fmi2Status)
        |_instance| Ending::Discard;

    fmi2GetRealStatus: fmi2GetRealStatusTYPE, GetStatus = (s: fmi2StatusKind, value: *mut fmi2Real)
        where time = output(value, 1);
        |instance| match s {
            fmi2StatusKind::fmi2LastSuccessfulTime => time.write(Ok(vec![instance.time()])),
            _ => Ending::Discard,
        };

    fmi2GetIntegerStatus: fmi2GetIntegerStatusTYPE, GetStatus = (_s: fmi2StatusKind, _value: *mut fmi2Integer)
        |_instance| Ending::Discard;

    fmi2GetBooleanStatus: fmi2GetBooleanStatusTYPE, GetStatus = (s: fmi2StatusKind, value: *mut fmi2Boolean)
        where terminated = output(value, 1);
        |instance| match s {
            fmi2StatusKind::fmi2Terminated => terminated.write(Ok(vec![0])),
            _ => Ending::Discard,
        };

    fmi2GetStringStatus: fmi2GetStringStatusTYPE, GetStatus = (_s: fmi2StatusKind, _value: *mut fmi2String)
        |_instance| Ending::Discard;
}
